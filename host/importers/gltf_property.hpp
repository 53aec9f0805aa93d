// The rows of the table of a glTF document's properties (gltf_properties.cpp).
#pragma once

#include <cstddef>
#include <limits>
#include <span>
#include <string_view>

namespace eyeray::engine::importers::gltf {

enum class Type { object, index, count, number, flag, text, word };

// A row of the table: a property of an object.
struct Property {
  std::string_view name;  // "*": any name that no other row has
  Type type;
  std::string_view of = {};           // the list that an index refers to, or the allowed words
  const Property* members = nullptr;  // the members of an object
  size_t member_count = 0;
  bool list = false;  // true: the property is a list of such values
  double least = 0;   // least and most: the limits of a count, or of a list's length
  double most = std::numeric_limits<double>::infinity();
  bool required = false;
  bool extension = false;  // true: the property stands in the object's `extensions`

  constexpr Property must() const {
    Property changed = *this;
    changed.required = true;
    return changed;
  }
  constexpr Property of_length(double shortest, double longest) const {
    Property changed = *this;
    changed.list = true;
    changed.least = shortest;
    changed.most = longest;
    return changed;
  }
  constexpr Property of_length(double length) const { return of_length(length, length); }
  constexpr Property listed() const { return of_length(1, std::numeric_limits<double>::infinity()); }
};
using Members = std::span<const Property>;

constexpr Property index(std::string_view name, std::string_view list) {
  return {.name = name, .type = Type::index, .of = list};
}
constexpr Property count(std::string_view name, double least = 0) {
  return {.name = name, .type = Type::count, .least = least};
}
constexpr Property number(std::string_view name) {
  return {.name = name, .type = Type::number};
}
constexpr Property flag(std::string_view name) {
  return {.name = name, .type = Type::flag};
}
constexpr Property text(std::string_view name) {
  return {.name = name, .type = Type::text};
}
// A property whose value, a text or an integer, must be one of `words`.
constexpr Property one_of(std::string_view name, std::string_view words) {
  return {.name = name, .type = Type::word, .of = words};
}
template <size_t N>
constexpr Property object(std::string_view name, const Property (&members)[N]) {
  return {.name = name, .type = Type::object, .members = members, .member_count = N};
}
template <size_t N>
constexpr Property objects(std::string_view name, const Property (&members)[N]) {
  return object(name, members).listed();
}
template <size_t N>
constexpr Property extension(std::string_view name, const Property (&members)[N]) {
  Property property = object(name, members);
  property.extension = true;
  return property;
}

}  // namespace eyeray::engine::importers::gltf
