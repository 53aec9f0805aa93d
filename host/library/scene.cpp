// Scenes of the library: read, parsed, built.
#include "host/library/scene.hpp"

#include "host/core/option_text.hpp"
#include "host/library/engine_call.hpp"
#include "host/loader/scene_file.hpp"
#include "host/session/request.hpp"

namespace eyeray::engine::library {
namespace {

std::vector<loader::Override> overrides_of(const v0::SceneOptions& options) {
  std::vector<loader::Override> overrides;
  for (const std::string& define : options.defines)
    overrides.push_back({define, option_text("defines", define)});
  return overrides;
}

}  // namespace

v0::Scene parse(std::string_view toml, std::string_view name, const v0::SceneOptions& options,
                const loader::MemoryFiles& files) {
  return run_engine([&] {
    return v0::Scene::Data::checked(
        loader::parse_scene(toml, std::string(name), overrides_of(options), files, options.formulas));
  });
}

}  // namespace eyeray::engine::library

namespace eyeray::inline v0 {

Scene Scene::Data::checked(engine::Scene read) {
  engine::Scene scene = engine::session::checked(std::move(read));
  std::vector<Diagnostic> warnings = engine::library::to_public(scene.warnings);
  return Scene(std::make_shared<const Data>(Data{std::move(scene), std::move(warnings)}));
}

Scene Scene::read(const std::filesystem::path& file, const SceneOptions& options) {
  return engine::library::run_engine([&] {
    return Data::checked(engine::loader::load_scene(file, engine::library::overrides_of(options),
                                                    {options.allowed_folders, options.formulas}));
  });
}

Scene Scene::parse(std::string_view toml, std::string_view name, const SceneOptions& options) {
  return engine::library::parse(toml, name, options, {});
}

int Scene::width() const noexcept {
  return data_->scene.image.width;
}
int Scene::height() const noexcept {
  return data_->scene.image.height;
}
int Scene::samples() const noexcept {
  return data_->scene.image.samples;
}
const std::vector<Diagnostic>& Scene::warnings() const noexcept {
  return data_->warnings;
}

}  // namespace eyeray::inline v0
