#include "host/compute/kernel_keys.hpp"

#include <array>

namespace eyeray::engine::compute {
namespace {

using reading::Key;
using reading::KeyType;

constexpr Key kernel_key{"kernel", KeyType::string, "the kernel's file: .comp or .glsl, .hlsl, or .spv"};
constexpr Key entry_key{"entry", KeyType::string, "the entry point", "\"\""};
constexpr Key ulp_key{.name = "ulp",
                      .type = KeyType::integer,
                      .doc = "the distance of reals that is allowed, in units in the last place",
                      .fallback = "0",
                      .min = 0,
                      .max = 1 << 24};

constexpr std::array top_keys = {kernel_key, entry_key, ulp_key};
constexpr std::array<std::string_view, 9> top_lists = {
    "groups", "invocations", "defines", "include_folders", "constants", "push", "buffer", "expect", "same"};

constexpr std::array buffer_keys = {
    Key{.name = "file", .type = KeyType::string, .doc = "the file of its contents", .optional = true},
    Key{.name = "fill", .type = KeyType::number, .doc = "the value of all its numbers", .optional = true},
    Key{.name = "elements",
        .type = KeyType::integer,
        .doc = "the length of its run-time array",
        .min = 1,
        .max = 1 << 30,
        .optional = true},
    Key{.name = "bytes",
        .type = KeyType::integer,
        .doc = "its size, in place of `elements`",
        .min = 1,
        .max = 4294967296.0,
        .optional = true},
    Key{.name = "output",
        .type = KeyType::string,
        .doc = "the file that gets it after the run",
        .optional = true},
    Key{.name = "width",
        .type = KeyType::integer,
        .doc = "the pixels of a row, if it is a picture",
        .min = 1,
        .max = 65536,
        .optional = true},
    Key{"compare", KeyType::boolean, "whether verify compares it", "true"}};
constexpr std::array<std::string_view, 2> buffer_lists = {"values", "noise"};

constexpr std::array noise_keys = {
    Key{.name = "seed",
        .type = KeyType::integer,
        .doc = "another seed, other numbers",
        .min = 0,
        .max = 4294967295.0,
        .optional = true},
    Key{.name = "from", .type = KeyType::number, .doc = "the least number", .fallback = "0"},
    Key{.name = "to", .type = KeyType::number, .doc = "the greatest number", .optional = true}};

constexpr std::array expect_keys = {Key{"file", KeyType::string, "the file that the buffer must equal"},
                                    ulp_key,
                                    Key{.name = "absolute",
                                        .type = KeyType::number,
                                        .doc = "the difference of reals that is allowed, too",
                                        .fallback = "0",
                                        .min = 0}};

constexpr std::array same_keys = {kernel_key, entry_key, ulp_key};
constexpr std::array<std::string_view, 4> same_lists = {"groups", "invocations", "defines",
                                                        "include_folders"};

constexpr std::array<KernelTable, 5> tables = {
    KernelTable{"the kernel file", top_keys, top_lists},
    KernelTable{"[buffer.NAME]", buffer_keys, buffer_lists}, KernelTable{"noise", noise_keys, {}},
    KernelTable{"[expect.NAME]", expect_keys, {}}, KernelTable{"[same]", same_keys, same_lists}};

}  // namespace

const KernelTable& kernel_table(Table table) {
  return tables[size_t(table)];
}

std::span<const KernelTable> kernel_tables() {
  return tables;
}

}  // namespace eyeray::engine::compute
