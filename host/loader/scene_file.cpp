#include "loader/scene_file.hpp"

#include "loader/document.hpp"
#include "loader/image_files.hpp"
#include "loader/overrides.hpp"
#include "loader/scene_builder.hpp"

namespace eyeray {

namespace {

// `images`: null for a scene that is in no file.
Scene finish(Document document, const std::filesystem::path& file, std::span<const Override> overrides,
             ImageFiles* images, DiagnosticLog& log) {
  apply_overrides(document.root, overrides, log);
  Scene scene = build_scene(document.root, images, log);
  if (log.has_errors()) throw InputError(log.sorted());
  scene.file = file;
  scene.files = std::move(document.files);
  if (images) scene.files.insert(scene.files.end(), images->files().begin(), images->files().end());
  scene.warnings = log.sorted();
  return scene;
}

}  // namespace

Scene load_scene(const std::filesystem::path& file, std::span<const Override> overrides,
                 std::span<const std::filesystem::path> allowed_folders) {
  DiagnosticLog log;
  const AllowedFolders folders(file, allowed_folders);
  Document document = read_document(file, folders, log);
  ImageFiles images(folders, document.files, log);
  return finish(std::move(document), file, overrides, &images, log);
}

Scene parse_scene(std::string_view text, const std::string& name, std::span<const Override> overrides) {
  DiagnosticLog log;
  return finish(parse_document(text, name, log), name, overrides, nullptr, log);
}

}  // namespace eyeray
