#include "host/loader/mesh_imports.hpp"

#include <algorithm>

#include "host/core/diagnostic.hpp"

namespace eyeray::loader {

namespace fs = std::filesystem;

namespace {

// "bunny.obj:12:3: message", without what a list of diagnostics has around it.
std::string one_sentence(const InputError& error) {
  const Diagnostic& first = error.diagnostics().front();
  const SourcePosition& at = first.position;
  if (at.line == 0) return fmt::format("{}: {}", at.file, first.message);
  return fmt::format("{}:{}:{}: {}", at.file, at.line, at.column, first.message);
}

}  // namespace

void MeshImports::add_file(const fs::path& file) {
  if (std::ranges::find(files_, file) == files_.end()) files_.push_back(file);
}

void MeshImports::import(Entry& entry, const fs::path& file, std::optional<double> smooth) {
  add_file(file);
  try {
    entry.scene = importers::import_file(file, {smooth, trees_, &budget_});
    for (const fs::path& read : entry.scene.files) add_file(read);
    const size_t lights = entry.scene.lights.size();
    if (lights > 0 || entry.scene.camera) {
      entry.scene.warnings.push_back(fmt::format(
          "its {} not taken over: a scene says its own",
          lights == 0 ? "camera is" : (entry.scene.camera ? "camera and lights are" : "lights are")));
    }
    for (std::string& warning : entry.scene.warnings) warning = fmt::format("{}: {}", file.string(), warning);
  } catch (const InputError& wrong) {
    entry.refused = one_sentence(wrong);
    entry.code = wrong.code();
  } catch (const Error& unreadable) {
    entry.refused = unreadable.what();
    entry.code = unreadable.code();
  }
}

MeshImports::Loaded MeshImports::load(const std::string& name, std::optional<double> smooth,
                                      const std::string& from) {
  const auto source = std::ranges::find(sources_, fs::path(from));
  const auto [path, whole] =
      folders_.find("file", name, source != sources_.end() ? *source : sources_.front());
  const auto [entry, fresh] = entries_.try_emplace({whole, smooth});
  if (fresh) import(entry->second, path, smooth);
  if (!entry->second.refused.empty()) throw Error(entry->second.code, entry->second.refused);
  return {&entry->second.scene, fresh};
}

MeshImports::Loaded MeshImports::load_alone(const fs::path& file) {
  importers::ImportedScene scene = importers::import_file(file, {{}, trees_, &budget_});
  for (const fs::path& read : scene.files) add_file(read);
  Entry& entry = entries_[{folders_.find("file", file.filename().string(), file).whole, std::nullopt}];
  entry.scene = std::move(scene);
  return {&entry.scene, true};
}

}  // namespace eyeray::loader
