#include "host/cli/legend.hpp"

#include <nlohmann/json.hpp>

#include "host/cli/json.hpp"
#include "host/core/atomic_file.hpp"
#include "host/image/image_file.hpp"

namespace eyeray::cli {
namespace {

// Bytes to gather before they are written.
constexpr size_t piece = 1 << 20;

// The colour that the picture shows an id in, "#rrggbb".
std::string color_of(int64_t id) {
  Image data(1, 1, 1);
  data.samples()[0] = float(id);
  const Image shown = false_color(data, FalseColor::ids);
  const auto code = [&](int channel) { return unsigned{srgb8(shown.pixel(0, 0)[channel])}; };
  return fmt::format("#{:02x}{:02x}{:02x}", code(0), code(1), code(2));
}

Json entry(const Object& object, const Names& names, uint64_t pixels) {
  Json json{{"first", object.first}, {"last", object.first + object.count - 1}, {"kind", object.kind}};
  if (const std::string name = path(object, names); !name.empty())
    json[object.name.own ? "name" : "group"] = name;
  if (!object.mesh.empty()) json["mesh"] = object.mesh;
  if (object.position->line > 0) {
    json["file"] = object.position->file;
    json["line"] = object.position->line;
  }
  // Every triangle of a mesh has its own.
  if (object.count == 1) json["color"] = color_of(int64_t(object.first));
  json["pixels"] = pixels;
  return json;
}

Json entry(const Material& material, size_t index, uint64_t pixels) {
  Json json{{"first", index}, {"last", index}, {"kind", "material"}};
  if (!material.name.empty()) json["name"] = material.name;
  json["color"] = color_of(int64_t(index));
  json["pixels"] = pixels;
  return json;
}

// File names may hold any bytes; JSON may not.
std::string text_of(const Json& json) {
  return json.dump(-1, ' ', false, Json::error_handler_t::replace);
}

}  // namespace

bool has_legend(Aov aov) {
  return aov == Aov::primitive || aov == Aov::material;
}

Legend::Legend(Aov aov, const Scene& scene) : aov_(aov), scene_(scene), objects_(scene) {
  pixels_.resize(aov == Aov::material ? scene.materials.size() : objects_.size());
}

void Legend::see(std::span<const FirstHit> hits) {
  for (const FirstHit& hit : hits) {
    if (hit.primitive < 0)
      ++nothing_;
    else
      ++pixels_.at(aov_ == Aov::material ? size_t(hit.material) : objects_.of(uint64_t(hit.primitive)));
  }
}

std::filesystem::path Legend::write(const std::filesystem::path& picture) const {
  std::filesystem::path name = picture;
  AtomicFile file(name.replace_extension(".json"));
  std::string text = fmt::format("{{\"nothing\": {},\n \"ids\": [",
                                 text_of({{"id", -1}, {"color", color_of(-1)}, {"pixels", nothing_}}));
  bool first = true;
  for (size_t i = 0; i < pixels_.size(); ++i) {
    if (pixels_[i] == 0) continue;
    text += first ? "\n  " : ",\n  ";
    text += text_of(aov_ == Aov::material ? entry(*scene_.materials[i], i, pixels_[i])
                                          : entry(objects_[i], scene_.names, pixels_[i]));
    first = false;
    if (text.size() < piece) continue;
    file.write(text);
    text.clear();
  }
  file.write(text + "]}\n");
  file.commit();
  return name;
}

}  // namespace eyeray::cli
