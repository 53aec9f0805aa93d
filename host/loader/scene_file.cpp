#include "host/loader/scene_file.hpp"

#include <algorithm>

#include "host/loader/document.hpp"
#include "host/loader/formula_files.hpp"
#include "host/loader/formula_refusal.hpp"
#include "host/loader/image_files.hpp"
#include "host/loader/mesh_imports.hpp"
#include "host/loader/mesh_scene.hpp"
#include "host/loader/overrides.hpp"
#include "host/loader/scene_builder.hpp"

namespace eyeray::loader {

namespace {

namespace fs = std::filesystem;

// `images`, `meshes` and `formulas`: null for a scene that is in no file.
Scene finish(Document document, const fs::path& file, std::span<const Override> overrides, ImageFiles* images,
             MeshImports* meshes, FormulaFiles* formulas, DiagnosticLog& log) {
  apply_overrides(document.root, overrides, log);
  Scene scene = build_scene(document.root, {images, meshes, formulas}, log);
  if (log.has_errors()) throw InputError(log.sorted());
  scene.file = file;
  scene.files = std::move(document.files);
  if (images) scene.files.insert(scene.files.end(), images->files().begin(), images->files().end());
  if (meshes) scene.files.insert(scene.files.end(), meshes->files().begin(), meshes->files().end());
  if (formulas) scene.files.insert(scene.files.end(), formulas->files().begin(), formulas->files().end());
  scene.warnings = log.sorted();
  return scene;
}

// The mesh file as if a scene showed it.
Document read_mesh(const fs::path& file, std::span<const Override> overrides, MeshImports& meshes,
                   DiagnosticLog& log) {
  log.add_source(file.string(), "");
  const MeshImports::Loaded loaded = meshes.load_alone(file);
  for (const std::string& warning : loaded.scene->warnings) log.warning({}, warning);
  const bool around = std::ranges::any_of(
      overrides, [](const Override& each) { return each.text.starts_with("environment"); });
  return {mesh_scene(file, *loaded.scene, around), {}};
}

}  // namespace

Scene load_scene(const fs::path& file, std::span<const Override> overrides, const Trust& trust) {
  DiagnosticLog log;
  const AllowedFolders folders(file, trust.folders);
  image::PixelBudget pixels;
  std::vector<fs::path> trees = trust.folders;
  trees.push_back(file.parent_path());
  if (importers::is_mesh_file(file)) {
    MeshImports meshes(folders, std::move(trees), {file}, pixels);
    Document document = read_mesh(file, overrides, meshes, log);
    ImageFiles images(folders, document.files, pixels, log);
    return finish(std::move(document), file, overrides, &images, &meshes, nullptr, log);
  }
  Document document = read_document(file, folders, log);
  if (!trust.formulas) refuse_formulas(document.root, log);
  ImageFiles images(folders, document.files, pixels, log);
  MeshImports meshes(folders, std::move(trees), document.files, pixels);
  FormulaFiles formulas(folders, document.files, log);
  return finish(std::move(document), file, overrides, &images, &meshes, &formulas, log);
}

Scene parse_scene(std::string_view text, const std::string& name, std::span<const Override> overrides) {
  DiagnosticLog log;
  return finish(parse_document(text, name, log), name, overrides, nullptr, nullptr, nullptr, log);
}

}  // namespace eyeray::loader
