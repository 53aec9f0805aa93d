#include "host/film/legend.hpp"

#include <nlohmann/json.hpp>

#include "host/core/atomic_file.hpp"
#include "host/core/escaped_text.hpp"
#include "host/image/false_color.hpp"
#include "host/image/image_file.hpp"
#include "host/scene/objects.hpp"

namespace eyeray::engine::film {
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
    // Every triangle of a mesh has its own colour.
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

// A legend as it is written, entry by entry.
class LegendFile {
 public:
  LegendFile(const std::filesystem::path& picture, uint64_t nothing)
      : name_(std::filesystem::path(picture).replace_extension(".json")), file_(name_) {
    text_ = fmt::format("{{\"nothing\": {},\n \"ids\": [",
                        json_text(Json{{"id", -1}, {"color", color_of(-1)}, {"pixels", nothing}}));
  }

  // `entry`: a JSON object, to which its number of pixels is added.
  void add(std::string_view entry, uint64_t pixels) {
    entry.remove_suffix(1);
    text_ += fmt::format("{}{},\"pixels\":{}}}", first_ ? "\n  " : ",\n  ", entry, pixels);
    first_ = false;
    if (text_.size() < piece) return;
    file_.write(text_);
    text_.clear();
  }

  // Writes the end of the file, and returns its path.
  std::filesystem::path finish() {
    file_.write(text_ + "]}\n");
    file_.commit();
    return name_;
  }

 private:
  std::filesystem::path name_;
  AtomicFile file_;
  std::string text_;
  bool first_ = true;
};

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
  LegendFile file(picture, nothing_);
  for (size_t i = 0; i < pixels_.size(); ++i)
    if (pixels_[i] > 0) file.add(json_text(entries_->entry(i)), pixels_[i]);
  return file.finish();
}

LegendTally Legend::tally() const {
  LegendTally tally{nothing_, {}};
  for (size_t i = 0; i < pixels_.size(); ++i)
    if (pixels_[i] > 0) tally.entries[i] = {json_text(entries_->entry(i)), pixels_[i]};
  return tally;
}

void LegendTally::add(const LegendTally& other) {
  nothing += other.nothing;
  for (const auto& [index, entry] : other.entries) {
    Entry& own = entries[index];
    own.text = entry.text;
    own.pixels += entry.pixels;
  }
}

std::filesystem::path write_legend(const LegendTally& tally, const std::filesystem::path& picture) {
  LegendFile file(picture, tally.nothing);
  for (const auto& [index, entry] : tally.entries) file.add(entry.text, entry.pixels);
  return file.finish();
}

}  // namespace eyeray::engine::film
