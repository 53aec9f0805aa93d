#include "host/loader/scene_file.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <iterator>
#include <optional>
#include <vector>

#include "host/core/error.hpp"
#include "host/loader/animation.hpp"
#include "host/loader/document.hpp"
#include "host/loader/formula_files.hpp"
#include "host/loader/formula_refusal.hpp"
#include "host/loader/image_files.hpp"
#include "host/loader/mesh_imports.hpp"
#include "host/loader/mesh_scene.hpp"
#include "host/loader/overrides.hpp"
#include "host/loader/scene_builder.hpp"

namespace eyeray::engine::loader {

namespace {

namespace fs = std::filesystem;

// Makes the scene of a document. `images`, `meshes` and `formulas`: the files that it may use, or null for
// none. `trusted`: true if it may define functions.
Scene finish(Document document, const fs::path& file, std::span<const Override> overrides, ImageFiles* images,
             MeshImports* meshes, FormulaFiles* formulas, bool trusted, DiagnosticLog& log) {
  apply_overrides(document.root, overrides, log);
  Animation animation = apply_animation(document.root, log);
  if (!trusted) refuse_formulas(document.root, log);
  if (meshes) meshes->show(seconds(animation));
  Scene scene = build_scene(document.root, {images, meshes, formulas}, log);
  if (log.has_errors()) throw InputError(log.sorted());
  if (meshes) {
    const double rate = animation.frames_per_second;
    for (const auto& [values, first, last] : meshes->played())
      add_moving(values, first * rate, last * rate, animation);
  }
  scene.animation = animation;
  scene.file = file;
  scene.files = std::move(document.files);
  if (images) scene.files.insert(scene.files.end(), images->files().begin(), images->files().end());
  if (meshes) scene.files.insert(scene.files.end(), meshes->files().begin(), meshes->files().end());
  if (formulas) scene.files.insert(scene.files.end(), formulas->files().begin(), formulas->files().end());
  scene.warnings = log.sorted();
  return scene;
}

// The moment in seconds that the overrides set. Faults in the overrides are reported later.
double requested_seconds(std::span<const Override> overrides) {
  std::vector<Override> about;
  std::ranges::copy_if(overrides, std::back_inserter(about),
                       [](const Override& each) { return each.text.starts_with("animation"); });
  toml::table root;
  DiagnosticLog unheard;
  apply_overrides(root, about, unheard);
  return seconds(apply_animation(root, unheard));
}

constexpr std::string_view look_key = "look=";

// Takes the look out of the overrides.
MeshLook take_look(std::vector<Override>& overrides) {
  MeshLook look = MeshLook::plain;
  std::erase_if(overrides, [&](const Override& each) {
    if (!each.text.starts_with(look_key)) return false;
    std::string_view name = std::string_view(each.text).substr(look_key.size());
    if (name.size() > 1 && name.front() == '"' && name.back() == '"') name = name.substr(1, name.size() - 2);
    const auto found = std::ranges::find(look_names, name);
    if (found == std::end(look_names))
      throw Error(ExitCode::bad_input, "{}: a look is {}",
                  each.written.empty() ? "-D " + each.text : each.written, fmt::join(look_names, ", "));
    look = MeshLook(found - std::begin(look_names));
    return true;
  });
  return look;
}

// The document of a scene that shows the mesh file.
Document read_mesh(const fs::path& file, std::span<const Override> overrides, MeshLook look, bool formulas,
                   MeshImports& meshes, DiagnosticLog& log) {
  log.add_source(file.string(), "");
  meshes.show(requested_seconds(overrides));
  const MeshImports::Loaded loaded = meshes.load_alone(file);
  // Frame the file at rest, so that the camera does not move during an animation.
  std::optional<importers::ImportedScene> rest;
  if (loaded.scene->played && !loaded.scene->camera) {
    try {
      rest = meshes.rest(file);
    } catch (const InputError&) {
      // There is nothing to see at rest, so frame the file at this moment.
      if (loaded.scene->instances.empty()) throw;
    }
  }
  for (const std::string& warning : loaded.scene->warnings) log.warning({}, warning);
  const bool around = std::ranges::any_of(
      overrides, [](const Override& each) { return each.text.starts_with("environment"); });
  return {mesh_scene(file, *loaded.scene, rest ? *rest : *loaded.scene, {around, look, formulas}), {}};
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
    const MeshLook look = take_look(others);
    Document document = read_mesh(file, others, look, trust.formulas, meshes, log);
    ImageFiles images(folders, document.files, pixels, log);
    Scene scene = finish(std::move(document), file, others, &images, &meshes, nullptr, trust.formulas, log);
    scene.is_mesh_alone = true;
    return scene;
  }
  for (const Override& each : overrides) {
    if (each.text.starts_with(look_key))
      throw Error(ExitCode::bad_input,
                  "{}: {} is a scene, which has a look of its own; a look is for a mesh alone",
                  each.written.empty() ? "-D " + each.text : each.written, file.string());
  }
  Document document = read_document(file, folders, log);
  ImageFiles images(folders, document.files, pixels, log);
  MeshImports meshes(folders, std::move(trees), document.files, pixels);
  FormulaFiles formulas(folders, document.files, log);
  return finish(std::move(document), file, overrides, &images, &meshes, &formulas, trust.formulas, log);
}

Scene parse_moment(std::string_view text, const std::string& name, std::span<const Override> overrides,
                   const MemoryFiles& files, bool formulas) {
  DiagnosticLog log;
  image::PixelBudget pixels;
  MeshImports meshes(files, pixels);
  Document document = parse_document(text, name, log);
  return finish(std::move(document), name, overrides, nullptr, files.empty() ? nullptr : &meshes, nullptr,
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
