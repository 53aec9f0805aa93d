#include "loader/scene_file.hpp"

#include "loader/document.hpp"
#include "loader/overrides.hpp"
#include "loader/scene_builder.hpp"

namespace eyeray {

namespace {

Scene finish(Document document, const std::filesystem::path& file, std::span<const Override> overrides,
             DiagnosticLog& log) {
  apply_overrides(document.root, overrides, log);
  Scene scene = build_scene(document.root, log);
  if (log.has_errors()) throw InputError(log.sorted());
  scene.file = file;
  scene.files = std::move(document.files);
  scene.warnings = log.sorted();
  return scene;
}

}  // namespace

Scene load_scene(const std::filesystem::path& file, std::span<const Override> overrides,
                 std::span<const std::filesystem::path> allowed_folders) {
  DiagnosticLog log;
  return finish(read_document(file, allowed_folders, log), file, overrides, log);
}

Scene parse_scene(std::string_view text, const std::string& name, std::span<const Override> overrides) {
  DiagnosticLog log;
  return finish(parse_document(text, name, log), name, overrides, log);
}

}  // namespace eyeray
