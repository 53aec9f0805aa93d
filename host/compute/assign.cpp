#include <fmt/format.h>

#include <algorithm>

#include "host/compute/contents.hpp"
#include "host/reading/source_position.hpp"

namespace eyeray::engine::compute {
namespace {

class Assigner {
 public:
  Assigner(std::span<std::byte> bytes, DiagnosticLog& log) : bytes_(bytes), log_(log) {}

  bool assign(const toml::node& node, const Type& type, uint64_t offset) {
    switch (type.form) {
      case Form::number:
        return assign_number(node, type.number, offset);
      case Form::structure:
        return assign_members(node, type, offset);
      default:
        return assign_list(node, type, offset);
    }
  }

 private:
  bool fail(const toml::node& node, const std::string& message) {
    log_.error(reading::position_of(node.source()), message);
    return false;
  }

  bool assign_number(const toml::node& node, const Number& number, uint64_t offset) {
    std::byte* const at = bytes_.data() + offset;
    bool written = false;
    if (const auto integer = node.as_integer()) written = write_number(number, integer->get(), at);
    if (const auto real = node.as_floating_point()) written = write_number(number, real->get(), at);
    if (const auto boolean = node.as_boolean()) written = write_number(number, int64_t{boolean->get()}, at);
    return written || fail(node, fmt::format("this must be a number that a {} holds", describe(number)));
  }

  bool assign_members(const toml::node& node, const Type& type, uint64_t offset) {
    const toml::table* const table = node.as_table();
    if (!table && type.members.size() == 1)
      return assign(node, *type.members[0].type, offset + type.members[0].offset);
    std::vector<std::string> names;
    for (const Member& member : type.members) names.push_back(member.name);
    if (!table)
      return fail(node, fmt::format("{} has several members: write {{ {} = … }}", type.name, names[0]));
    bool right = true;
    for (const auto& [key, value] : *table) {
      const auto member = std::ranges::find(type.members, key.str(), &Member::name);
      if (member == type.members.end()) {
        log_.error(reading::position_of(key.source()),
                   fmt::format("{} has no member `{}`{}", type.name, key.str(), suggest(key.str(), names)));
        right = false;
      } else {
        right = assign(value, *member->type, offset + member->offset) && right;
      }
    }
    return right;
  }

  bool assign_list(const toml::node& node, const Type& type, uint64_t offset) {
    const toml::array* const list = node.as_array();
    if (!list) return fail(node, fmt::format("this must be a list, for {}", describe(type)));
    const bool flat =
        type.element->form != Form::number && !list->empty() &&
        std::all_of(list->begin(), list->end(), [](const toml::node& n) { return n.is_value(); });
    const uint64_t count = flat ? count_numbers(type) : type.count;
    if (list->size() != count)
      return fail(node,
                  fmt::format("this list has {} values, but {} has {}", list->size(), describe(type), count));
    bool right = true;
    size_t i = 0;
    if (flat)
      for_each_number(type, offset, [&](const Number& number, uint64_t at) {
        right = right && assign_number(*list->get(i++), number, at);
      });
    else
      for (; right && i < list->size(); ++i)
        right = assign(*list->get(i), *type.element, offset + i * type.stride);
    return right;
  }

  std::span<std::byte> bytes_;
  DiagnosticLog& log_;
};

}  // namespace

bool assign(const toml::node& node, const Type& type, std::span<std::byte> bytes, DiagnosticLog& log) {
  return Assigner(bytes, log).assign(node, type, 0);
}

std::optional<uint64_t> elements_in(const toml::node& node, const Type& block) {
  const Member* const array = run_time_array(block);
  if (!array) return std::nullopt;
  const toml::node* value = &node;
  if (const toml::table* table = node.as_table()) value = table->get(array->name);
  const toml::array* const list = value ? value->as_array() : nullptr;
  if (!list || list->empty()) return std::nullopt;
  const uint64_t each = count_numbers(*array->type->element);
  return list->get(0)->is_value() && each > 1 ? list->size() / each : list->size();
}

}  // namespace eyeray::engine::compute
