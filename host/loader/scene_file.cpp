#include "host/loader/scene_file.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <iterator>
#include <optional>
#include <vector>

#include "host/core/error.hpp"
#include "host/loader/animation.hpp"
#include "host/loader/document.hpp"
#include "host/loader/font_files.hpp"
#include "host/loader/formula_files.hpp"
#include "host/loader/formula_refusal.hpp"
#include "host/loader/image_files.hpp"
#include "host/loader/mesh_imports.hpp"
#include "host/loader/mesh_scene.hpp"
#include "host/loader/mesh_view.hpp"
#include "host/loader/named_files.hpp"
#include "host/loader/overrides.hpp"
#include "host/loader/scene_builder.hpp"
#include "host/scene/integrator.hpp"

namespace eyeray::engine::loader {

namespace {

namespace fs = std::filesystem;

// Makes the scene of a document. `sources`: the files that it may use; `named` has those of `sources` that
// are no meshes, or is null for none. `trusted`: true if it may define functions.
Scene finish(Document document, const fs::path& file, std::span<const Override> overrides,
             const SceneSources& sources, const NamedFiles* named, bool trusted, DiagnosticLog& log) {
  MeshImports* const meshes = sources.meshes;
  apply_overrides(document.root, overrides, log);
  Animation animation = apply_animation(document.root, log);
  if (!trusted) refuse_formulas(document.root, log);
  if (meshes) meshes->show(seconds(animation));
  Scene scene = build_scene(document.root, sources, log);
  if (log.has_errors()) throw InputError(log.sorted());
  if (meshes) {
    const double rate = animation.frames_per_second;
    for (const auto& [values, first, last] : meshes->played())
      add_moving(values, first * rate, last * rate, animation);
  }
  scene.animation = animation;
  scene.file = file;
  scene.files = std::move(document.files);
  if (named) scene.files.insert(scene.files.end(), named->files().begin(), named->files().end());
  if (meshes) scene.files.insert(scene.files.end(), meshes->files().begin(), meshes->files().end());
  scene.warnings = log.sorted();
  return scene;
}

// The values that overrides of keys that begin with `key` set. Faults in the overrides are reported later.
toml::table overridden(std::span<const Override> overrides, std::string_view key) {
  std::vector<Override> about;
  std::ranges::copy_if(overrides, std::back_inserter(about),
                       [&](const Override& each) { return each.text.starts_with(key); });
  toml::table root;
  DiagnosticLog unheard;
  apply_overrides(root, about, unheard);
  return root;
}

// The moment in seconds that the overrides set.
double requested_seconds(std::span<const Override> overrides) {
  toml::table root = overridden(overrides, "animation");
  DiagnosticLog unheard;
  return seconds(apply_animation(root, unheard));
}

// The look of a mesh alone unless an override chooses one: `studio`, but `plain`, which is made for them,
// under integrators without random paths.
MeshLook usual_look(std::span<const Override> overrides) {
  const toml::table root = overridden(overrides, "render.integrator");
  const auto name = root["render"]["integrator"].value<std::string_view>();
  const auto found = std::ranges::find(integrator_names, name.value_or(""));
  const bool plain =
      found != std::end(integrator_names) && !walks_at_random(IntegratorType(found - integrator_names));
  return plain ? MeshLook::plain : MeshLook::studio;
}

// The document of a scene that shows the mesh file. Takes the overrides for its view out.
Document read_mesh(const fs::path& file, std::vector<Override>& overrides, bool formulas, MeshImports& meshes,
                   DiagnosticLog& log) {
  const MeshChoices choices = take_mesh_choices(overrides);
  MeshLook look = choices.look.value_or(usual_look(overrides));
  log.add_source(file.string(), "");
  meshes.show(requested_seconds(overrides));
  const MeshImports::Loaded loaded = meshes.load_alone(file, choices.reading);
  // Frame the file at rest, so that the camera does not move during an animation.
  std::optional<importers::ImportedScene> rest;
  if (loaded.scene->played && loaded.scene->cameras.empty()) {
    try {
      rest = meshes.rest(file, choices.reading);
    } catch (const InputError&) {
      // There is nothing to see at rest, so frame the file at this moment.
      if (loaded.scene->instances.empty()) throw;
    }
  }
  for (const std::string& warning : loaded.scene->warnings) log.warning({}, warning);
  if (choices.reading.point_shape != importers::PointShape::sphere && loaded.scene->clouds.empty())
    log.warning({}, "has no points, so --point-shape changes nothing");
  if (choices.reading.point_size && loaded.scene->clouds.empty())
    log.warning({}, "has no points, so --point-size changes nothing");
  if (choices.reading.line_width && loaded.scene->lines.empty())
    log.warning({}, "has no lines, so --line-width changes nothing");
  choose_camera(loaded.scene->cameras, choices.camera, file, log);
  const auto overrides_any = [&](std::initializer_list<std::string_view> keys) {
    return std::ranges::any_of(overrides, [&](const Override& each) {
      return std::ranges::any_of(keys, [&](std::string_view key) { return each.text.starts_with(key); });
    });
  };
  const bool around = overrides_any({"environment"});
  const bool usual_paths = !overrides_any({"render.integrator", "render.background", "medium"});
  const toml::table image = overridden(overrides, "image.transparent");
  const bool transparent = image["image"]["transparent"].value_or(false);
  const importers::ImportedScene& framed = rest ? *rest : *loaded.scene;
  if (look != MeshLook::plain && !has_room_for_studio(framed)) {
    look = MeshLook::plain;
    log.warning({},
                "reaches beyond 1e10, where a floor and lights around it have no room: it is shown plain");
  }
  return {mesh_scene(file, *loaded.scene, framed,
                     {around, usual_paths, look, formulas, transparent, choices.turntable, choices.reading}),
          {}};
}

// If the scene moves while its shutter is open, sets the function that makes the scene at another moment. It
// calls `load` with one more override.
template <typename Load>
Scene with_moments(Scene scene, std::span<const Override> overrides, const Load& load) {
  if (scene.animation.tracks == 0 || scene.animation.shutter == 0) return scene;
  scene.animation.at = [load, all = std::vector(overrides.begin(), overrides.end())](double frame) {
    std::vector<Override> with_frame = all;
    with_frame.push_back({fmt::format("animation.frame={}", frame)});
    return load(with_frame);
  };
  return scene;
}

Scene load_moment(const fs::path& file, std::span<const Override> overrides, const Trust& trust) {
  DiagnosticLog log;
  const AllowedFolders folders(file, trust.folders);
  image::PixelBudget pixels;
  std::vector<fs::path> trees = trust.folders;
  trees.push_back(file.parent_path());
  if (importers::is_mesh_file(file)) {
    MeshImports meshes(folders, std::move(trees), {file}, pixels);
    std::vector<Override> others(overrides.begin(), overrides.end());
    Document document = read_mesh(file, others, trust.formulas, meshes, log);
    NamedFiles named(folders, document.files);
    ImageFiles images(named, pixels, log);
    Scene scene = finish(std::move(document), file, others, {.images = &images, .meshes = &meshes}, &named,
                         trust.formulas, log);
    scene.is_mesh_alone = true;
    return scene;
  }
  refuse_mesh_choices(overrides, file);
  Document document = read_document(file, folders, log);
  NamedFiles named(folders, document.files);
  ImageFiles images(named, pixels, log);
  MeshImports meshes(folders, std::move(trees), document.files, pixels);
  FormulaFiles formulas(named, log);
  FontFiles fonts(named, log);
  return finish(std::move(document), file, overrides, {&images, &meshes, &formulas, &fonts}, &named,
                trust.formulas, log);
}

Scene parse_moment(std::string_view text, const std::string& name, std::span<const Override> overrides,
                   const MemoryFiles& files, bool formulas) {
  DiagnosticLog log;
  image::PixelBudget pixels;
  MeshImports meshes(files, pixels);
  Document document = parse_document(text, name, log);
  return finish(std::move(document), name, overrides, {.meshes = files.empty() ? nullptr : &meshes}, nullptr,
                formulas, log);
}

}  // namespace

Scene load_scene(const fs::path& file, std::span<const Override> overrides, const Trust& trust) {
  return with_moments(load_moment(file, overrides, trust), overrides,
                      [file, trust](std::span<const Override> all) { return load_moment(file, all, trust); });
}

Scene parse_scene(std::string_view text, const std::string& name, std::span<const Override> overrides,
                  const MemoryFiles& files, bool formulas) {
  return with_moments(parse_moment(text, name, overrides, files, formulas), overrides,
                      [text = std::string(text), name, files, formulas](std::span<const Override> all) {
                        return parse_moment(text, name, all, files, formulas);
                      });
}

}  // namespace eyeray::engine::loader
