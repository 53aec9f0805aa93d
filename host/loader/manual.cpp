#include <fmt/format.h>

#include "host/cameras/registry.hpp"
#include "host/lights/registry.hpp"
#include "host/loader/area_lights.hpp"
#include "host/loader/environments.hpp"
#include "host/loader/scene_file.hpp"
#include "host/loader/sections.hpp"
#include "host/loader/variables.hpp"
#include "host/materials/registry.hpp"
#include "host/reading/table.hpp"
#include "host/reference/integrator.hpp"
#include "host/reference/sampler.hpp"
#include "host/scene/integrator.hpp"
#include "host/scene/sampler.hpp"
#include "host/textures/registry.hpp"

namespace eyeray::engine::loader {

namespace {

std::string default_of(const reading::Key& key) {
  if (!key.fallback.empty()) return fmt::format("`{}`", key.fallback);
  return key.optional ? "–" : "**required**";
}

// The keys as a Markdown table.
std::string key_table(std::initializer_list<std::span<const reading::Key>> groups) {
  std::string text = "| key | value | default | meaning |\n| --- | --- | --- | --- |\n";
  for (const std::span<const reading::Key> keys : groups) {
    for (const reading::Key& key : keys) {
      text += fmt::format("| `{}` | {} | {} | {} |\n", key.name, describe(key), default_of(key), key.doc);
    }
  }
  return text + "\n";
}

std::string trimmed(std::string_view text) {
  while (text.ends_with('\n')) text.remove_suffix(1);
  return std::string(text) + "\n\n";
}

template <typename Type>
std::string kinds_manual(std::span<const Type* const> types) {
  std::string text;
  for (const Type* type : types)
    text +=
        fmt::format("### `type = \"{}\"`\n\n", type->name) + trimmed(type->manual) + key_table({type->keys});
  return text;
}

std::string textures_manual() {
  std::string text;
  for (const reading::TextureType* type : textures::types())
    text += type->of_color ? "### `[r, g, b]`\n\n" + trimmed(type->manual)
                           : fmt::format("### `{{ {} = … }}`\n\n", type->name) + trimmed(type->manual) +
                                 key_table({type->keys});
  return text;
}

// The manual's text about the values of a key: each value has its own section.
template <typename Manual>
std::string values_manual(std::string_view key, std::span<const std::string_view> names,
                          const Manual& manual) {
  std::string text;
  for (uint32_t i = 0; i < names.size(); ++i)
    text += fmt::format("### `{} = \"{}\"`\n\n", key, names[i]) + trimmed(manual(i));
  return text;
}

}  // namespace

std::string scene_manual() {
  using enum Section::Kind;
  std::string text =
      "# Scene file: every table and key\n\n"
      "This page is generated from the keys by which eyeray checks scenes (`host/loader/manual.cpp`). A test "
      "compares the page with them. [scene-file.md](scene-file.md) is the introduction.\n\n";

  // Write each table, then the text about its types and values.
  for (const Section& section : sections()) {
    text += fmt::format("## `{}`\n\n", section.title);
    if (section.shape) {
      text += fmt::format("![{0}](images/shapes/{0}.png)\n\n", section.shape->name);
      text += trimmed(section.shape->manual) + key_table({section.shape->keys, section.keys});
      continue;
    }
    text += std::string(section.doc) + "\n\n";
    if (!section.manual.empty()) text += trimmed(section.manual);
    if (!section.keys.empty()) text += key_table({section.keys});
    if (section.kind == image)
      text += values_manual("pattern", sample_patterns,
                            [](uint32_t i) { return reference::sampler(SamplePattern(i)).manual; });
    if (section.kind == render)
      text += values_manual("integrator", integrator_names,
                            [](uint32_t i) { return reference::integrator(IntegratorType(i)).manual; });
    if (section.kind == camera) text += kinds_manual(cameras::types());
    if (section.kind == environment) text += kinds_manual(environment_types());
    if (section.kind == light) {
      text += kinds_manual(lights::types());
      text += fmt::format("### `type = \"{}\"`\n\n", lights::area_type) + trimmed(area_manual()) +
              key_table({area_keys()});
    }
    if (section.kind != material) continue;
    text += kinds_manual(materials::types());
    text += textures_manual();
  }
  text +=
      "## `transform`\n\nEach step is a table with one of these keys. Steps are applied in the order "
      "written.\n\n";
  text += key_table({reading::transform_step_keys()});
  text += "A rotation is a table with two keys:\n\n" + key_table({reading::rotation_keys()});
  text +=
      "## `batch`\n\nMany shapes, or instances of a mesh or a group, from one table. Each key of `batch` "
      "holds a list with one value for each of them, and all lists have the same length. The table's other "
      "keys apply to all.\n\n"
      "```toml\n[[sphere]]\nmaterial = \"glass\"\n"
      "batch = { center = [[0, 0, 0], [3, 0, 0]], radius = [1, 0.5] }\n```\n";
  text += fmt::format("\n## `repeat`\n\n{}\n", repeat_manual());
  text +=
      "\n## `include`\n\nA file name or a list of file names, before all tables. Names are relative to the "
      "file that contains them. See [scene-file.md](scene-file.md#several-files).\n";
  return text;
}

}  // namespace eyeray::engine::loader
