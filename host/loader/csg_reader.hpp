// Reads CSG objects, and the shapes that stand in them. Private to scene_builder.cpp.
#pragma once

#include <fmt/format.h>

#include <algorithm>
#include <optional>

#include "host/core/diagnostic_log.hpp"
#include "host/loader/csg_parts.hpp"
#include "host/loader/tables.hpp"
#include "host/reading/source_position.hpp"
#include "host/reading/table.hpp"

namespace eyeray::engine::loader {

// A part of the scene's builder, which is `Host` and reads tables, materials and shapes. It is a class of its
// own only because these functions are many.
template <typename Host>
class CsgReader {
 public:
  CsgReader(Host& host, DiagnosticLog& log) : host_(host), log_(log) {}

  // Reads a CSG object; null after an error. `material`: that of the CSG object around it.
  template <typename Placing>
  std::unique_ptr<Shape> read(const Section& section, const toml::table& table, reading::TableReader& reader,
                              const Placing& placing, std::optional<int> material) {
    if (reader.has("material")) material = host_.materials_.find(reader);
    shapes::ShapeType::Shapes operands, removed;
    bool ok = read_parts(table, placing, material, operands);
    if (const toml::node* minus = table.get(minus_key)) {
      if (const toml::table* held = minus->as_table()) {
        for (const auto& [key, node] : *held) {
          if (std::ranges::find(placed_names(), key.str()) != placed_names().end()) continue;
          log_.error(reading::position_of(key.source()),
                     fmt::format("unknown key `{}` in `minus`, which can contain only shapes", key.str()));
          ok = false;
        }
        ok = read_parts(*held, placing, material, removed) && ok;
      } else {
        log_.error(reading::position_of(minus->source()),
                   "`minus` must be a table, written [[csg.minus.sphere]]");
        ok = false;
      }
    }
    if (!ok) return nullptr;
    auto csg = section.shape->combine(reader, std::move(operands), std::move(removed));
    if (!csg) return nullptr;
    if (const std::string why = why_two_media(*csg, host_.scene_.materials); !why.empty())
      reader.error("material", why);
    csg->material = material.value_or(0);
    csg->type = section.shape->name;
    csg->name = placing.name;
    csg->position = reader.position();
    return csg;
  }

 private:
  // Adds the shapes that stand in a CSG object's table to `parts`. Returns whether all of them are right.
  template <typename Placing>
  bool read_parts(const toml::table& holder, const Placing& csg, std::optional<int> material,
                  shapes::ShapeType::Shapes& parts) {
    bool ok = true;
    for (const std::string_view name : placed_names()) {
      const auto add_part = [&](const Section& written, const toml::table& table) {
        if (const std::string why = why_no_part(written); !why.empty()) {
          log_.error(reading::position_of(table.source()), why);
          ok = false;
          return;
        }
        Section section = written;
        section.keys = part_keys();
        size_t added = 0;
        const size_t wanted = host_.for_each_placed(
            section, table, csg, [&](reading::TableReader& reader, const Placing& placed) {
              auto part = section.is_combined() ? read(section, table, reader, placed, material)
                                                : read_part(section, reader, placed, material);
              if (!part) return;
              parts.push_back(std::move(part));
              ++added;
            });
        ok = ok && wanted > 0 && added == wanted;
      };
      ok = for_each_table(holder, name, log_, add_part, "csg") && ok;
    }
    return ok;
  }

  // Reads a shape of a CSG object; null after an error. `material`: that of the CSG object around it.
  template <typename Placing>
  std::unique_ptr<Shape> read_part(const Section& section, reading::TableReader& reader,
                                   const Placing& placing, std::optional<int> material) {
    if (reader.has("material")) material = host_.materials_.find(reader);
    std::unique_ptr<Shape> part = host_.parse_shape(section, reader, placing, material.value_or(0));
    if (part && !part->is_closed()) {
      const auto& [key, why] = why_not_closed(*section.shape);
      reader.error(key, why);
      return nullptr;
    }
    if (!material)
      reader.error("material", fmt::format("no material: neither this {} nor a CSG object around it has one",
                                           section.title));
    return material ? std::move(part) : nullptr;
  }

  Host& host_;
  DiagnosticLog& log_;
};

}  // namespace eyeray::engine::loader
