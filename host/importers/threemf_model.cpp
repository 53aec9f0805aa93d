#include "host/importers/threemf_model.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cstdlib>
#include <limits>

#include "host/importers/malformed.hpp"
#include "host/importers/xml_reader.hpp"

namespace eyeray::engine::importers {

namespace {

// Names of elements, with their namespaces.
#define THREEMF_CORE "http://schemas.microsoft.com/3dmanufacturing/core/2015/02|"
#define THREEMF_MATERIAL "http://schemas.microsoft.com/3dmanufacturing/material/2015/02|"
#define THREEMF_PRODUCTION "http://schemas.microsoft.com/3dmanufacturing/production/2015/06|"

// Elements without a counterpart here, and the words for a warning.
struct LeftOut {
  std::string_view name, words;
};
constexpr LeftOut left_out_elements[] = {
    {THREEMF_MATERIAL "compositematerials", "groups of mixed materials (compositematerials) were left out"},
    {THREEMF_MATERIAL "multiproperties", "groups of layered properties (multiproperties) were left out"},
    {THREEMF_MATERIAL "pbspeculardisplayproperties", "groups of display properties were left out"},
    {THREEMF_MATERIAL "pbmetallicdisplayproperties", "groups of display properties were left out"},
    {THREEMF_MATERIAL "pbspeculartexturedisplayproperties", "groups of display properties were left out"},
    {THREEMF_MATERIAL "pbmetallictexturedisplayproperties", "groups of display properties were left out"},
    {THREEMF_MATERIAL "translucentdisplayproperties", "groups of display properties were left out"},
    {"http://schemas.microsoft.com/3dmanufacturing/beamlattice/2017/02|beam",
     "beams of lattices were left out"},
    {"http://schemas.microsoft.com/3dmanufacturing/slice/2015/07|slicestack",
     "stacks of slices were left out"},
    {"http://schemas.3mf.io/3dmanufacturing/booleanoperations/2023/07|booleanshape",
     "shapes by boolean operations were left out"},
    {"http://schemas.3mf.io/3dmanufacturing/displacement/2023/10|displacementmesh",
     "displaced meshes were left out"},
    {"http://schemas.3mf.io/3dmanufacturing/volumetric/2022/01|levelset", "level sets were left out"},
};

struct ThreeMfUnit {
  std::string_view name;
  double millimetres;
};
constexpr ThreeMfUnit threemf_units[] = {{"micron", 0.001}, {"millimeter", 1}, {"centimeter", 10},
                                         {"inch", 25.4},    {"foot", 304.8},   {"meter", 1000}};

class ModelReader : public XmlReader {
 public:
  explicit ModelReader(const std::string& name) : XmlReader(name) { model.name = name; }

  ThreeMfModel model;

 private:
  void start(std::string_view name, const XmlAttributes& attributes) override;
  void end(std::string_view name) override;

  void start_object(const XmlAttributes& attributes);
  void add_triangle(const XmlAttributes& attributes);
  void start_group(const XmlAttributes& attributes, ThreeMfGroup::Kind kind);
  void start_picture(const XmlAttributes& attributes);
  void add_color(const XmlAttributes& attributes, std::string_view key);
  ThreeMfPlacing placing(const XmlAttributes& attributes) const;
  Mat4 transform(std::string_view text) const;

  std::string_view needed(const XmlAttributes& attributes, std::string_view name) const {
    const auto value = attributes.find(name);
    if (!value) fail(fmt::format("`{}` is missing here", name));
    return *value;
  }
  double number(std::string_view text, std::string_view name) const;
  double number(const XmlAttributes& attributes, std::string_view name) const {
    return number(needed(attributes, name), name);
  }
  uint32_t whole(std::string_view text, std::string_view name) const;
  uint32_t whole(const XmlAttributes& attributes, std::string_view name) const {
    return whole(needed(attributes, name), name);
  }
  // A new id, which no other resource has.
  uint32_t new_id(const XmlAttributes& attributes) const {
    const uint32_t id = whole(attributes, "id");
    if (id == 0 || model.objects.contains(id) || model.groups.contains(id) || model.pictures.contains(id))
      fail(fmt::format("ids are above 0 and different, and this is {}", id));
    return id;
  }
  const ThreeMfGroup& group(uint32_t id) const {
    const auto found = model.groups.find(id);
    if (found == model.groups.end())
      fail(fmt::format("there is no group of properties {} before this line", id));
    return found->second;
  }
  void check_property(const ThreeMfProperty& property) const;

  ThreeMfObject* object_ = nullptr;  // the element that is open, if there is one
  ThreeMfGroup* group_ = nullptr;
};

double ModelReader::number(std::string_view text, std::string_view name) const {
  if (text.starts_with('+')) text.remove_prefix(1);
  double value = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error == std::errc::invalid_argument || end != text.data() + text.size())
    fail(fmt::format("`{}` is not a number", name));
  if (error == std::errc::result_out_of_range) value = std::strtod(text.data(), nullptr);  // 0 or ±inf
  return value;
}

uint32_t ModelReader::whole(std::string_view text, std::string_view name) const {
  uint32_t value = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error != std::errc() || end != text.data() + text.size() || value >= no_index)
    fail(fmt::format("`{}` is a whole number from 0 to 4294967294", name));
  return value;
}

// Reads the twelve numbers of a transform: rows that a row (x, y, z, 1) is multiplied by.
Mat4 ModelReader::transform(std::string_view text) const {
  Mat4 matrix(1.0);
  size_t at = 0;
  for (int i = 0; i < 12; ++i) {
    at = std::min(text.find_first_not_of(" \t\r\n", at), text.size());
    const size_t end = std::min(text.find_first_of(" \t\r\n", at), text.size());
    matrix[i / 3][i % 3] = number(text.substr(at, end - at), "transform");
    at = end;
  }
  if (text.find_first_not_of(" \t\r\n", at) != std::string_view::npos) fail("a transform has twelve numbers");
  return matrix;
}

ThreeMfPlacing ModelReader::placing(const XmlAttributes& attributes) const {
  ThreeMfPlacing placed;
  placed.object = whole(attributes, "objectid");
  if (const auto part = attributes.find(THREEMF_PRODUCTION "path")) placed.part = *part;
  if (const auto matrix = attributes.find("transform")) placed.transform = transform(*matrix);
  placed.line = line();
  placed.column = column();
  return placed;
}

void ModelReader::check_property(const ThreeMfProperty& property) const {
  const ThreeMfGroup& used = group(property.group);
  if (used.kind == ThreeMfGroup::Kind::other) return;
  for (const uint32_t corner : property.corners)
    if (corner >= used.size())
      fail(fmt::format("there is no property {}: group {} has {}, counted from 0", corner, property.group,
                       used.size()));
}

void ModelReader::start_object(const XmlAttributes& attributes) {
  object_ = &model.objects[new_id(attributes)];
  object_->name = attributes.find("name").value_or("");
  const auto id = attributes.find("pid");
  if (!id) return;
  const uint32_t index = whole(attributes.find("pindex").value_or("0"), "pindex");
  object_->whole = {whole(*id, "pid"), {index, index, index}};
  check_property(object_->whole);
}

void ModelReader::add_triangle(const XmlAttributes& attributes) {
  IndexTriangle triangle;
  const size_t vertices = object_->positions.size();
  constexpr std::string_view corner_names[] = {"v1", "v2", "v3"}, property_names[] = {"p1", "p2", "p3"};
  for (size_t i = 0; i < 3; ++i) {
    triangle[i] = whole(attributes, corner_names[i]);
    if (triangle[i] >= vertices)
      fail(fmt::format("there is no vertex {}: the mesh has {}, counted from 0", triangle[i], vertices));
  }
  ThreeMfProperty property = object_->whole;
  if (const auto first = attributes.find("p1")) {
    const auto id = attributes.find("pid");
    property.group = id ? whole(*id, "pid") : property.group;
    for (size_t i = 0; i < 3; ++i)
      property.corners[i] = whole(attributes.find(property_names[i]).value_or(*first), property_names[i]);
    if (property.group == ThreeMfProperty::no_group) fail("`p1` needs a `pid`, here or in the object");
    check_property(property);
    if (object_->properties.empty()) object_->properties.resize(object_->triangles.size(), object_->whole);
  }
  if (!object_->properties.empty() || attributes.find("p1")) object_->properties.push_back(property);
  object_->triangles.push_back(triangle);
}

void ModelReader::start_group(const XmlAttributes& attributes, ThreeMfGroup::Kind kind) {
  group_ = &model.groups[new_id(attributes)];
  group_->kind = kind;
  if (kind != ThreeMfGroup::Kind::texture) return;
  group_->texture = whole(attributes, "texid");
  if (!model.pictures.contains(group_->texture))
    fail(fmt::format("there is no picture {} before this line", group_->texture));
}

void ModelReader::start_picture(const XmlAttributes& attributes) {
  ThreeMfPicture& picture = model.pictures[new_id(attributes)];
  picture.part = needed(attributes, "path");
  const auto wrap = [&](std::string_view name) {
    const std::string_view style = attributes.find(name).value_or("wrap");
    if (style == "none") ++model.left_out["ends of pictures (tilestyle none) are shown as clamp"];
    return style == "wrap" ? Wrap::repeat : (style == "mirror" ? Wrap::mirror : Wrap::clamp);
  };
  picture.wrap_u = wrap("tilestyleu");
  picture.wrap_v = wrap("tilestylev");
  if (attributes.find("filter") == "nearest") picture.filter = Filter::nearest;
}

// Adds a colour, #RRGGBB or #RRGGBBAA, as a screen shows it.
void ModelReader::add_color(const XmlAttributes& attributes, std::string_view key) {
  const std::string_view text = needed(attributes, key);
  uint32_t code = 0;
  const bool starts = (text.size() == 7 || text.size() == 9) && text.starts_with('#');
  const auto [end, error] = starts ? std::from_chars(text.data() + 1, text.data() + text.size(), code, 16)
                                   : std::from_chars_result{text.data(), std::errc::invalid_argument};
  if (error != std::errc() || end != text.data() + text.size())
    fail(fmt::format("`{}` is a color such as #FF8000 or #FF8000FF", key));
  if (text.size() == 7) code = code << 8 | 255;
  if ((code & 255) != 255)
    ++model.left_out["transparent colors are shown as opaque; a `material` with `alpha` would count"];
  group_->colors.push_back(color_from_display(Vec3(code >> 24, code >> 16 & 255, code >> 8 & 255) / 255.0));
}

void ModelReader::start(std::string_view name, const XmlAttributes& attributes) {
  if (object_ && name == THREEMF_CORE "vertex") {
    if (object_->positions.size() + 1 >= no_index) fail("a mesh has at most 4294967294 vertices");
    object_->positions.emplace_back(number(attributes, "x"), number(attributes, "y"),
                                    number(attributes, "z"));
  } else if (object_ && name == THREEMF_CORE "triangle") {
    add_triangle(attributes);
  } else if (object_ && name == THREEMF_CORE "component") {
    object_->components.push_back(placing(attributes));
  } else if (name == THREEMF_CORE "object") {
    start_object(attributes);
  } else if (name == THREEMF_CORE "basematerials" || name == THREEMF_MATERIAL "colorgroup") {
    start_group(attributes, ThreeMfGroup::Kind::colors);
  } else if (group_ && name == THREEMF_CORE "base") {
    add_color(attributes, "displaycolor");
  } else if (group_ && name == THREEMF_MATERIAL "color") {
    add_color(attributes, "color");
  } else if (name == THREEMF_MATERIAL "texture2d") {
    start_picture(attributes);
  } else if (name == THREEMF_MATERIAL "texture2dgroup") {
    start_group(attributes, ThreeMfGroup::Kind::texture);
  } else if (group_ && name == THREEMF_MATERIAL "tex2coord") {
    group_->uv.emplace_back(number(attributes, "u"), number(attributes, "v"));
  } else if (name == THREEMF_CORE "item") {
    model.items.push_back(placing(attributes));
  } else if (name == THREEMF_CORE "model") {
    const std::string_view unit = attributes.find("unit").value_or("millimeter");
    const auto found = std::ranges::find(threemf_units, unit, &ThreeMfUnit::name);
    if (found == std::end(threemf_units))
      fail("`unit` is micron, millimeter, centimeter, inch, foot or meter");
    model.millimetres = found->millimetres;
  } else if (const auto found = std::ranges::find(left_out_elements, name, &LeftOut::name);
             found != std::end(left_out_elements)) {
    ++model.left_out[std::string(found->words)];
    if (name == THREEMF_MATERIAL "compositematerials" || name == THREEMF_MATERIAL "multiproperties") {
      start_group(attributes, ThreeMfGroup::Kind::other);
      group_ = nullptr;
    }
  }
}

void ModelReader::end(std::string_view name) {
  if (name == THREEMF_CORE "object") object_ = nullptr;
  if (name == THREEMF_CORE "basematerials" || name == THREEMF_MATERIAL "colorgroup" ||
      name == THREEMF_MATERIAL "texture2dgroup")
    group_ = nullptr;
}

// Reads the relationships of the package.
class RelationshipReader : public XmlReader {
 public:
  using XmlReader::XmlReader;
  std::string target;

 private:
  void start(std::string_view name, const XmlAttributes& attributes) override {
    if (name == "http://schemas.openxmlformats.org/package/2006/relationships|Relationship" &&
        attributes.find("Type") == "http://schemas.microsoft.com/3dmanufacturing/2013/01/3dmodel" &&
        target.empty())
      target = attributes.find("Target").value_or("");
  }
  void end(std::string_view) override {}
};

}  // namespace

ThreeMfModel read_threemf_model(ZipParts& parts, const std::string& part, const std::string& file) {
  ModelReader reader(fmt::format("{}, {}", file, parts.name(part)));
  parts.read(part, [&](std::string_view piece, bool last) { reader.feed(piece, last); });
  return std::move(reader.model);
}

std::string find_threemf_root(ZipParts& parts, const std::string& file) {
  constexpr std::string_view relationships = "_rels/.rels";
  RelationshipReader reader(fmt::format("{}, {}", file, relationships));
  parts.read(relationships, [&](std::string_view piece, bool last) { reader.feed(piece, last); });
  if (reader.target.empty())
    throw malformed(file, "it is no 3MF: its relationships (_rels/.rels) name no 3D model");
  return reader.target;
}

}  // namespace eyeray::engine::importers
