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
constexpr std::array<std::string_view, 10> top_lists = {
    "groups", "invocations", "defines", "include_folders", "constants",
    "push",   "buffer",      "image",   "expect",          "same"};

constexpr Key file_key{
    .name = "file", .type = KeyType::string, .doc = "the file of its contents", .optional = true};
constexpr Key fill_key{
    .name = "fill", .type = KeyType::number, .doc = "the value of all its numbers", .optional = true};
constexpr Key output_key{.name = "output",
                         .type = KeyType::string,
                         .doc = "the file that gets it after the run",
                         .optional = true};
constexpr Key compare_key{"compare", KeyType::boolean, "whether verify compares it", "true"};

constexpr std::array buffer_keys = {file_key,
                                    fill_key,
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
                                    output_key,
                                    Key{.name = "width",
                                        .type = KeyType::integer,
                                        .doc = "the pixels of a row, if it is a picture",
                                        .min = 1,
                                        .max = 65536,
                                        .optional = true},
                                    compare_key};
constexpr std::array<std::string_view, 2> buffer_lists = {"values", "noise"};

constexpr std::array image_keys = {file_key, fill_key,
                                   Key{.name = "format",
                                       .type = KeyType::string,
                                       .doc = "the format of its texels, if the kernel declares none",
                                       .optional = true},
                                   output_key, compare_key};
constexpr std::array<std::string_view, 2> image_lists = {"size", "noise"};

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

constexpr std::array<KernelTable, 6> tables = {KernelTable{"the kernel file", top_keys, top_lists},
                                               KernelTable{"[buffer.NAME]", buffer_keys, buffer_lists},
                                               KernelTable{"[image.NAME]", image_keys, image_lists},
                                               KernelTable{"noise", noise_keys, {}},
                                               KernelTable{"[expect.NAME]", expect_keys, {}},
                                               KernelTable{"[same]", same_keys, same_lists}};

}  // namespace

const KernelTable& kernel_table(Table table) {
  return tables[size_t(table)];
}

std::span<const KernelTable> kernel_tables() {
  return tables;
}

}  // namespace eyeray::engine::compute
