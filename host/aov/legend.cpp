#include "host/aov/legend.hpp"

#include <nlohmann/json.hpp>

#include "host/core/atomic_file.hpp"
#include "host/image/false_color.hpp"
#include "host/image/image_file.hpp"
#include "host/scene/objects.hpp"

namespace eyeray::aov {
namespace {

// Bytes to gather before they are written.
constexpr size_t piece = 1 << 20;

// The colour that the picture shows an id in, "#rrggbb".
std::string color_of(int64_t id) {
  image::Image data(1, 1, 1);
  data.samples()[0] = float(id);
  const image::Image shown = image::false_color(data, image::FalseColor::ids);
  const auto code = [&](int channel) { return unsigned{image::srgb8(shown.pixel(0, 0)[channel])}; };
  return fmt::format("#{:02x}{:02x}{:02x}", code(0), code(1), code(2));
}

class ObjectEntries final : public LegendEntries {
 public:
  ObjectEntries(const Scene& scene, bool by_primitives)
      : scene_(scene), objects_(scene), by_primitives_(by_primitives) {}

  size_t size() const override { return objects_.size(); }
  size_t of(const FirstHit& hit) const override { return objects_.of(uint64_t(hit.primitive)); }

  Json entry(size_t index) const override {
    const Object object = objects_[index];
    const uint64_t first = by_primitives_ ? object.first : index, count = by_primitives_ ? object.count : 1;
    Json json{{"first", first}, {"last", first + count - 1}, {"kind", object.kind}};
    if (const std::string name = path(object, scene_.names); !name.empty())
      json[object.name.own ? "name" : "group"] = name;
    if (!object.mesh.empty()) json["mesh"] = object.mesh;
    if (object.position->line > 0) {
      json["file"] = object.position->file;
      json["line"] = object.position->line;
    }
    // Every triangle of a mesh has its own.
    if (count == 1) json["color"] = color_of(int64_t(first));
    return json;
  }

 private:
  const Scene& scene_;
  Objects objects_;
  bool by_primitives_;
};

class MaterialEntries final : public LegendEntries {
 public:
  explicit MaterialEntries(const Scene& scene) : scene_(scene) {}

  size_t size() const override { return scene_.materials.size(); }
  size_t of(const FirstHit& hit) const override { return size_t(hit.material); }

  Json entry(size_t index) const override {
    Json json{{"first", index}, {"last", index}, {"kind", "material"}};
    if (const std::string& name = scene_.materials[index]->name; !name.empty()) json["name"] = name;
    json["color"] = color_of(int64_t(index));
    return json;
  }

 private:
  const Scene& scene_;
};

// File names may hold any bytes; JSON may not.
std::string text_of(const Json& json) {
  return json.dump(-1, ' ', false, Json::error_handler_t::replace);
}

}  // namespace

std::unique_ptr<LegendEntries> legend_of_shapes(const Scene& scene) {
  return std::make_unique<ObjectEntries>(scene, false);
}

std::unique_ptr<LegendEntries> legend_of_primitives(const Scene& scene) {
  return std::make_unique<ObjectEntries>(scene, true);
}

std::unique_ptr<LegendEntries> legend_of_materials(const Scene& scene) {
  return std::make_unique<MaterialEntries>(scene);
}

Legend::Legend(std::unique_ptr<LegendEntries> entries) : entries_(std::move(entries)) {
  pixels_.resize(entries_->size());
}

void Legend::see(std::span<const FirstHit> hits) {
  for (const FirstHit& hit : hits) {
    if (hit.primitive < 0)
      ++nothing_;
    else
      ++pixels_.at(entries_->of(hit));
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
    Json entry = entries_->entry(i);
    entry["pixels"] = pixels_[i];
    text += text_of(entry);
    first = false;
    if (text.size() < piece) continue;
    file.write(text);
    text.clear();
  }
  file.write(text + "]}\n");
  file.commit();
  return name;
}

}  // namespace eyeray::aov
