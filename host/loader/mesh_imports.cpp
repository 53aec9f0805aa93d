#include "host/loader/mesh_imports.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "host/core/diagnostic.hpp"

namespace eyeray::engine::loader {

namespace fs = std::filesystem;

namespace {

// The error as one sentence, "bunny.obj:12:3: message", without the frame of a list of diagnostics.
std::string one_sentence(const InputError& error) {
  const Diagnostic& first = error.diagnostics().front();
  const SourcePosition& at = first.position;
  if (at.line == 0) return fmt::format("{}: {}", at.file, first.message);
  return fmt::format("{}:{}:{}: {}", at.file, at.line, at.column, first.message);
}

// The warnings for a scene that shows the file.
std::vector<std::string> warnings_of(const importers::ImportedScene& scene, const fs::path& file) {
  std::vector<std::string> all = scene.warnings;
  const size_t lights = scene.lights.size();
  const size_t cameras = scene.cameras.size();
  if (lights > 0 || cameras > 0) {
    all.push_back(
        fmt::format("its {} not used: only those of the scene file count",
                    lights == 0 ? "camera is" : (cameras > 0 ? "camera and lights are" : "lights are")));
  }
  for (std::string& warning : all) warning = fmt::format("{}: {}", file.string(), warning);
  return all;
}

}  // namespace

std::string no_such(std::string_view kind, const std::string& wanted, std::span<const std::string> names) {
  if (names.empty()) return fmt::format("the file has no {}s", kind);
  return fmt::format("the file has no {} \"{}\"; it has {}", kind, printable(wanted),
                     importers::list_names(names));
}

void MeshImports::add_file(const fs::path& file) {
  if (std::ranges::find(files_, file) == files_.end()) files_.push_back(file);
}

AllowedFolders::File MeshImports::find(const std::string& name, const std::string& from) const {
  if (memory_) {
    if (!memory_->contains(name))
      throw Error(ExitCode::bad_input, "this scene came with no mesh \"{}\"", name);
    return {name, name};
  }
  return folders_->find("file", name, from, sources_);
}

importers::ImportedScene MeshImports::read(const fs::path& file, const Wanted& wanted) {
  if (memory_)
    return importers::import_bytes(memory_->find(file.string())->second, file.string(), wanted.reading,
                                   &budget_);
  add_file(file);
  return importers::import_file(file, wanted.reading, trees_, &budget_);
}

void MeshImports::import(Entry& entry, const fs::path& file, const Wanted& wanted) {
  try {
    entry.scene = read(file, wanted);
    if (!memory_)
      for (const fs::path& each : entry.scene.files) add_file(each);
    entry.scene.warnings = warnings_of(entry.scene, file);
    // Leave out warnings that were given before: the file may have been read for another animation or other
    // normals.
    std::erase_if(entry.scene.warnings,
                  [&](const std::string& each) { return !reported_.insert(each).second; });
  } catch (const InputError& wrong) {
    entry.refused = one_sentence(wrong);
    entry.code = wrong.code();
  } catch (const Error& unreadable) {
    entry.refused = unreadable.what();
    entry.code = unreadable.code();
  }
}

MeshImports::Loaded MeshImports::load(const std::string& name, Reading reading, const std::string& from) {
  const auto [path, whole] = find(name, from);
  reading.playing.seconds = seconds_;
  const Wanted wanted{whole, std::move(reading)};
  const auto [found, fresh] = entries_.try_emplace(wanted);
  Entry& entry = found->second;
  if (fresh) import(entry, path, wanted);
  if (!entry.refused.empty()) throw Error(entry.code, entry.refused);
  entry.shown = true;
  return {&entry.scene, fresh};
}

MeshImports::Loaded MeshImports::load_alone(const fs::path& file, Reading reading) {
  reading.playing.seconds = seconds_;
  const Wanted wanted{folders_->find("file", file.filename().string(), file).whole, std::move(reading)};
  importers::ImportedScene scene = read(file, wanted);
  for (const fs::path& each : scene.files) add_file(each);
  for (std::string& warning : warnings_of(scene, file)) reported_.insert(std::move(warning));
  Entry& entry = entries_[wanted];
  entry.scene = std::move(scene);
  return {&entry.scene, true};
}

importers::ImportedScene MeshImports::rest(const fs::path& file, Reading reading) const {
  reading.playing.animation = no_animation;
  return importers::import_file(file, reading, trees_);
}

std::vector<importers::PlayedAnimation> MeshImports::played() const {
  std::vector<importers::PlayedAnimation> all;
  for (const auto& [wanted, entry] : entries_)
    if (entry.shown && entry.scene.played) all.push_back(*entry.scene.played);
  return all;
}

}  // namespace eyeray::engine::loader
