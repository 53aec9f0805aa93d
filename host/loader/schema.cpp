#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

#include "host/cameras/registry.hpp"
#include "host/core/escaped_text.hpp"
#include "host/lights/registry.hpp"
#include "host/loader/area_lights.hpp"
#include "host/loader/environments.hpp"
#include "host/loader/scene_file.hpp"
#include "host/loader/sections.hpp"
#include "host/materials/registry.hpp"
#include "host/reading/table.hpp"
#include "host/textures/registry.hpp"

namespace eyeray::engine::loader {

using reading::Key, reading::KeyType;

namespace {

using Json = nlohmann::ordered_json;

Json from_toml(const toml::node& node) {
  if (const auto* text = node.as_string()) return text->get();
  if (const auto* integer = node.as_integer()) return integer->get();
  if (const auto* number = node.as_floating_point()) return number->get();
  if (const auto* boolean = node.as_boolean()) return boolean->get();
  Json list = Json::array();
  if (const auto* array = node.as_array()) {
    for (const toml::node& element : *array) list.push_back(from_toml(element));
  }
  return list;
}

Json reference_to(std::string_view definition) {
  return {{"$ref", fmt::format("#/$defs/{}", definition)}};
}

// The definitions of values for which an expression may stand.
constexpr std::string_view number_definition = "number", integer_definition = "integer",
                           list_definition = "list";
Json or_expression(std::string_view type) {
  return {{"type", {type, "string"}}, {"pattern", "^="}};
}

// The number as JSON: an integer if it is one, so that the schema contains 1 and not 1.0.
Json bound(double value) {
  if (std::fabs(value) < 1e15 && std::trunc(value) == value) return static_cast<int64_t>(value);
  return value;
}

Json number_schema(const Key& key, std::string_view definition = number_definition) {
  Json schema = reference_to(definition);
  if (std::isfinite(key.min)) schema[key.above_min ? "exclusiveMinimum" : "minimum"] = bound(key.min);
  if (std::isfinite(key.max)) schema[key.below_max ? "exclusiveMaximum" : "maximum"] = bound(key.max);
  return schema;
}

Json list_schema(Json items) {
  return {{"type", "array"}, {"items", std::move(items)}};
}

Json vector_schema(const Key& key, int size) {
  Json schema = reference_to(list_definition);
  schema["items"] = number_schema(key);
  schema["minItems"] = schema["maxItems"] = size;
  return schema;
}

Json either(Json a, Json b) {
  return {{"anyOf", {std::move(a), std::move(b)}}};
}

Json table_schema(std::span<const Key> keys);

// The names of definitions for values that many keys take.
constexpr std::string_view texture_definition = "texture", transform_definition = "transform";

Json texture_schema() {
  Json alternatives = Json::array();
  for (const reading::TextureType* type : textures::types()) {
    if (!type->parse) continue;
    Json table = table_schema(type->keys);
    if (!type->is_flat())
      table = {{"type", "object"},
               {"properties", {{std::string(type->name), std::move(table)}}},
               {"required", {type->name}},
               {"additionalProperties", false}};
    alternatives.push_back(std::move(table));
  }
  return {{"anyOf", std::move(alternatives)}};
}

Json transform_schema() {
  Json step = table_schema(reading::transform_step_keys());
  step["minProperties"] = step["maxProperties"] = 1;
  return list_schema(std::move(step));
}

// The schema of a key's value, without its description.
Json value_schema(const Key& key) {
  Key positive = key;
  positive.min = std::max(key.min, 0.0);
  switch (key.type) {
    case KeyType::boolean:
      return {{"type", "boolean"}};
    case KeyType::integer:
      return number_schema(key, integer_definition);
    case KeyType::number:
      if (!key.word.empty()) return either(number_schema(key), {{"const", key.word}});
      return number_schema(key);
    case KeyType::string:
      return {{"type", "string"}};
    case KeyType::choice:
      return {{"enum", key.choices}};
    case KeyType::choice2: {
      const Json one = {{"enum", key.choices}};
      Json two = list_schema(one);
      two["minItems"] = two["maxItems"] = 2;
      return either(one, std::move(two));
    }
    case KeyType::vec2:
      return vector_schema(key, 2);
    case KeyType::vec3:
      return vector_schema(key, 3);
    case KeyType::vec2_list:
      return list_schema(vector_schema(key, 2));
    case KeyType::vec3_list:
      return list_schema(vector_schema(key, 3));
    case KeyType::outlines:
      return list_schema(list_schema(vector_schema(key, 3)));
    case KeyType::rows: {
      Json row = list_schema(number_schema(key));
      row["minItems"] = row["maxItems"] = key.choices.size();
      return list_schema(std::move(row));
    }
    case KeyType::formula:
    case KeyType::formula_file:
      return {{"type", "string"}};
    case KeyType::parameters: {
      Json list = list_schema(reference_to(number_definition));
      list["minItems"] = 2;
      list["maxItems"] = 4;
      return {{"type", "object"},
              {"additionalProperties", either(reference_to(number_definition), std::move(list))}};
    }
    case KeyType::color_map: {
      Json pair = list_schema(either(number_schema(positive), vector_schema(positive, 3)));
      pair["minItems"] = pair["maxItems"] = 2;
      return list_schema(std::move(pair));
    }
    case KeyType::keyframes: {
      Json pair = list_schema(Json::object());
      pair["minItems"] = pair["maxItems"] = 2;
      Json list = list_schema(std::move(pair));
      list["minItems"] = 1;
      return list;
    }
    case KeyType::color:
      return either(number_schema(positive), vector_schema(positive, 3));
    case KeyType::scale2:
      return either(number_schema(key), vector_schema(key, 2));
    case KeyType::scale3:
      return either(number_schema(key), vector_schema(key, 3));
    case KeyType::rotation:
      return table_schema(reading::rotation_keys());
    case KeyType::transform:
      return reference_to(transform_definition);
    case KeyType::matrix: {
      Json rows = list_schema(vector_schema(key, 4));
      rows["minItems"] = rows["maxItems"] = 3;
      return rows;
    }
    case KeyType::texture: {
      Json schema = either(number_schema(positive), vector_schema(positive, 3));
      schema["anyOf"].push_back(reference_to(texture_definition));
      return schema;
    }
  }
  return {};
}

void add_keys(Json& schema, std::span<const Key> keys) {
  for (const Key& key : keys) {
    Json value = {{"description", key.doc}};
    value.update(value_schema(key));
    if (!key.fallback.empty()) value["default"] = from_toml(fallback_of(key));
    schema["properties"][std::string(key.name)] = std::move(value);
    if (key.fallback.empty() && !key.optional) schema["required"].push_back(key.name);
  }
}

Json table_schema(std::span<const Key> keys) {
  Json schema = {{"type", "object"}, {"properties", Json::object()}};
  add_keys(schema, keys);
  schema["additionalProperties"] = false;
  return schema;
}

// The schema of a table that has a `type`: one alternative a type, with that type's keys. `type` is required
// in all alternatives but the default's.
template <typename Type>
Json kinds_schema(const Section& section, std::span<const Type* const> types) {
  const Key& type_key = *std::ranges::find(section.keys, "type", &Key::name);
  const std::string default_name =
      type_key.fallback.empty() ? "" : fallback_of(type_key).value_or(std::string());
  Json alternatives = Json::array();
  for (const Type* type : types) {
    Json schema = table_schema(section.keys);
    add_keys(schema, type->keys);
    schema["properties"]["type"] = {{"const", type->name}};
    if (!default_name.empty() && default_name != type->name) schema["required"].push_back("type");
    alternatives.push_back(std::move(schema));
  }
  return {{"oneOf", std::move(alternatives)}};
}

// The schema of a shape or mesh in the world, or in a group. Unlike a part of a CSG object, a shape needs a
// material, in its table or its batch.
Json world_ray(const Section& section) {
  Json schema = reference_to(section.name);
  if (section.shape && !section.is_combined())
    schema["anyOf"] = {{{"required", {"material"}}}, {{"required", {batch_key}}}};
  return schema;
}

// The schema of `repeat`.
Json repeat_schema() {
  Json count = reference_to(integer_definition);
  count["minimum"] = 1;
  return {{"description", "Counters; the table is read once for each combination of their values."},
          {"type", "object"},
          {"minProperties", 1},
          {"additionalProperties", std::move(count)}};
}

Json let_schema() {
  Json list = list_schema(reference_to(number_definition));
  list["minItems"] = 1;
  return {{"type", "object"},
          {"additionalProperties", either(reference_to(number_definition), std::move(list))}};
}

Json shapes_of_csg() {
  Json shapes = Json::object();
  for (const std::string_view name : placed_names()) {
    const Section& section = *find_section(name);
    if (section.shape) shapes[std::string(name)] = list_schema(reference_to(section.name));
  }
  return shapes;
}

// The schema of a table that may have a batch, in which its required keys may stand instead. `keys`: its keys
// beside those of the shape.
Json placed_schema(const Section& section, std::span<const Key> keys) {
  Json schema = table_schema(keys);
  if (section.shape) add_keys(schema, section.shape->keys);
  Json lists = Json::object();
  for (const auto& [name, value] : schema["properties"].items()) {
    Json one = value;
    one.erase("default");
    one.erase("description");
    lists[name] = list_schema(std::move(one));
  }
  schema["properties"][std::string(batch_key)] = {
      {"description", fmt::format("Lists of values, one for each {}. The table's other keys apply to all.",
                                  section.shape ? "shape" : "instance")},
      {"type", "object"},
      {"properties", std::move(lists)},
      {"minProperties", 1},
      {"additionalProperties", false}};
  schema["properties"][std::string(repeat_key)] = reference_to(repeat_key);
  if (schema.contains("required")) {
    schema["anyOf"] = {{{"required", schema["required"]}}, {{"required", {batch_key}}}};
    schema.erase("required");
  }
  if (section.kind == Section::Kind::group) {
    for (const std::string_view name : placed_names())
      schema["properties"][std::string(name)] = list_schema(world_ray(*find_section(name)));
  }
  if (section.is_combined()) {
    schema["properties"].update(shapes_of_csg());
    schema["properties"][std::string(minus_key)] = {{"description", "The shapes to subtract."},
                                                    {"type", "object"},
                                                    {"properties", shapes_of_csg()},
                                                    {"additionalProperties", false}};
  }
  return schema;
}

Json lights_schema(const Section& section) {
  Json schema = kinds_schema(section, lights::types());
  for (Json& kind : schema["oneOf"]) kind["properties"][std::string(repeat_key)] = reference_to(repeat_key);
  for (const AreaShape& shape : area_shapes()) {
    Json one = placed_schema(shape.section, shape.section.keys);
    one["properties"]["type"] = {{"const", lights::area_type}};
    one["properties"]["shape"] = {{"const", shape.name}};
    schema["oneOf"].push_back(std::move(one));
  }
  return schema;
}

Json section_schema(const Section& section) {
  if (section.kind == Section::Kind::let) return let_schema();
  if (section.is_placed()) return list_schema(world_ray(section));
  if (section.kind == Section::Kind::material) return list_schema(kinds_schema(section, materials::types()));
  if (section.kind == Section::Kind::camera) return kinds_schema(section, cameras::types());
  if (section.kind == Section::Kind::environment) return kinds_schema(section, environment_types());
  if (section.kind == Section::Kind::light) return list_schema(lights_schema(section));
  return section.many() ? list_schema(table_schema(section.keys)) : table_schema(section.keys);
}

}  // namespace

std::string scene_schema() {
  const Json file_name = {{"type", "string"}};
  Json properties;
  Json definitions = {
      {number_definition, or_expression("number")}, {integer_definition, or_expression("integer")},
      {list_definition, or_expression("array")},    {repeat_key, repeat_schema()},
      {texture_definition, texture_schema()},       {transform_definition, transform_schema()}};
  properties[std::string(include_key)] = {{"description", "Scene files to include, relative to this one."},
                                          {"anyOf", {file_name, list_schema(file_name)}}};
  for (const Section& section : sections()) {
    Json described = section.doc.empty() ? Json::object() : Json{{"description", section.doc}};
    described.update(section_schema(section));
    properties[std::string(section.name)] = std::move(described);
    if (section.is_placed())
      definitions[std::string(section.name)] =
          placed_schema(section, section.shape ? part_keys() : section.keys);
  }
  const Json schema = {
      {"$schema", "https://json-schema.org/draft/2020-12/schema"},
      {"title", "eyeray scene"},
      {"description", "Generated from the keys by which eyeray checks scenes; docs/scene-file.md."},
      {"type", "object"},
      {"properties", std::move(properties)},
      {"additionalProperties", false},
      {"$defs", std::move(definitions)}};
  return json_text(schema, 2) + "\n";
}

}  // namespace eyeray::engine::loader
