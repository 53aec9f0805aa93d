#include "host/compute/type.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>

#include "host/core/error.hpp"

namespace eyeray::engine::compute {

uint64_t size(const Type& type) {
  switch (type.form) {
    case Form::number:
      return type.number.bytes();
    case Form::structure: {
      uint64_t end = 0;
      for (const Member& member : type.members) end = std::max(end, member.offset + size(*member.type));
      return end;
    }
    case Form::array:
      return type.count * type.stride;
    case Form::vector:
    case Form::matrix:
      break;
  }
  return (type.count - 1) * type.stride + size(*type.element);
}

uint64_t count_numbers(const Type& type) {
  if (type.form == Form::number) return 1;
  uint64_t count = type.element ? type.count * count_numbers(*type.element) : 0;
  for (const Member& member : type.members) count += count_numbers(*member.type);
  return count;
}

std::optional<Number> only_number(const Type& type) {
  if (type.form == Form::number) return type.number;
  if (type.element) return only_number(*type.element);
  std::optional<Number> all;
  for (const Member& member : type.members) {
    const std::optional<Number> one = only_number(*member.type);
    if (!one || (all && *all != *one)) return std::nullopt;
    all = one;
  }
  return all;
}

const Member* run_time_array(const Type& block) {
  if (block.form != Form::structure || block.members.empty()) return nullptr;
  const Member& last = block.members.back();
  return last.type->form == Form::array && last.type->count == 0 ? &last : nullptr;
}

TypePtr with_elements(const TypePtr& block, uint64_t elements) {
  if (!run_time_array(*block)) return block;
  auto array = std::make_shared<Type>(*block->members.back().type);
  array->count = elements;
  auto sized = std::make_shared<Type>(*block);
  sized->members.back().type = array;
  return sized;
}

TypePtr with_extent(const Type& image, const std::vector<uint64_t>& extent) {
  auto sized = std::make_shared<Type>(image);
  sized->extent = extent;
  sized->count = 1;
  for (const uint64_t length : extent) {
    if (length > most_bytes / image.stride / std::max<uint64_t>(sized->count, 1))
      throw Error(ExitCode::bad_input, "an {} would have more than {} bytes, the most that eyeray runs with",
                  describe(*sized), most_bytes);
    sized->count *= length;
  }
  return sized;
}

const Type& unwrapped(const Type& block) {
  const Type* whole = &block;
  while (whole->form == Form::structure && whole->members.size() == 1) whole = whole->members[0].type.get();
  return *whole;
}

std::string describe(const Number& number) {
  const bool usual = number.bits == 32;
  switch (number.kind) {
    case NumberKind::signed_integer:
      return usual ? "int" : fmt::format("int{}", number.bits);
    case NumberKind::unsigned_integer:
      return usual ? "uint" : fmt::format("uint{}", number.bits);
    case NumberKind::real:
      break;
  }
  return usual ? "float" : number.bits == 64 ? "double" : fmt::format("float{}", number.bits);
}

std::string describe(const Type& type) {
  switch (type.form) {
    case Form::number:
      return describe(type.number);
    case Form::structure:
      return type.name;
    case Form::array:
      if (is_image(type)) return fmt::format("{} image of {}", type.name, fmt::join(type.extent, " × "));
      return fmt::format("{}[{}]", describe(*type.element), type.count ? std::to_string(type.count) : "");
    case Form::matrix:
      return fmt::format("mat{}x{}", type.count, type.element->count);
    case Form::vector:
      break;
  }
  const Number& number = type.element->number;
  const std::string prefix = number.kind == NumberKind::signed_integer     ? "i"
                             : number.kind == NumberKind::unsigned_integer ? "u"
                             : number.bits == 64                           ? "d"
                                                                           : "";
  const std::string vector = fmt::format("{}vec{}", prefix, type.count);
  return number.bits == 32 || prefix == "d" ? vector : fmt::format("{} of {} bits", vector, number.bits);
}

std::string path_of(const Type& type, uint64_t byte) {
  if (type.form == Form::structure) {
    const Member* found = nullptr;
    for (const Member& member : type.members)
      if (member.offset <= byte && (!found || member.offset >= found->offset)) found = &member;
    if (!found) return "";
    return "." + found->name + path_of(*found->type, byte - found->offset);
  }
  if (!type.element || type.stride == 0) return "";
  const uint64_t index = byte / type.stride;
  if (is_image(type)) {
    std::vector<uint64_t> texel;
    uint64_t rest = index;
    for (const uint64_t length : type.extent) {
      texel.push_back(rest % length);
      rest /= length;
    }
    return fmt::format("[{}].{}", fmt::join(texel, ", "),
                       "rgba"[byte % type.stride / only_number(type)->bytes()]);
  }
  const std::string here =
      type.form == Form::vector && index < 4 ? fmt::format(".{}", "xyzw"[index]) : fmt::format("[{}]", index);
  return here + path_of(*type.element, byte % type.stride);
}

}  // namespace eyeray::engine::compute
