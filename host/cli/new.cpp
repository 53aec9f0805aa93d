// eyeray new: creates a small project to start from. Its files are those of host/cli/project.
#include <CLI/CLI.hpp>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <span>

#include "host/cli/command.hpp"
#include "host/core/atomic_file.hpp"
#include "host/core/embedded_file.hpp"
#include "host/core/escaped_text.hpp"
#include "host/core/make_folder.hpp"
#include "host/core/standard_streams.hpp"
#include "host/program/json.hpp"

namespace fs = std::filesystem;

namespace eyeray::engine::cli {

std::span<const EmbeddedFile> project_files();

namespace {

struct NewCommand {
  std::string folder;
  bool json = false;

  ExitCode run() const;
  void write() const;
};

// Writes all files or none: an existing file is an error, and after a failure, such as a full disk, the
// written files are removed.
void NewCommand::write() const {
  for (const EmbeddedFile& file : project_files())
    if (const fs::path path = fs::path(folder) / file.name; fs::exists(path))
      throw Error(ExitCode::file_io, "{} exists already; nothing was written", path.string());
  std::vector<fs::path> written;
  try {
    for (const EmbeddedFile& file : project_files()) {
      const fs::path path = fs::path(folder) / file.name;
      make_folder(path.parent_path());
      write_file_atomically(path, file.text);
      written.push_back(path);
    }
  } catch (...) {
    std::error_code ignored;
    for (const fs::path& path : written) fs::remove(path, ignored);
    throw;
  }
}

ExitCode NewCommand::run() const {
  write();
  const std::string scene = (fs::path(folder) / "scene.toml").string();
  print_lines(stderr,
              "{} files written to {}; view the scene with\n"
              "  eyeray dev {}\n",
              project_files().size(), folder, shell_word(scene));
  if (json) {
    Json names = Json::array();
    for (const EmbeddedFile& file : project_files()) names.push_back(file.name);
    print_json({{"folder", folder}, {"scene", scene}, {"files", names}});
  }
  return ExitCode::ok;
}

}  // namespace

void add_new(CLI::App& app, Run& run) {
  CLI::App* const command = app.add_subcommand(
      "new", "Write a small project: a scene with a user-defined shape and pattern, and CI for it.");
  const auto options = std::make_shared<NewCommand>();
  command->add_option("DIR", options->folder, "The folder to write it to.")->required();
  command->add_flag("--json", options->json, "Answer as JSON on standard output.");
  command->footer(
      "Example: change a scene, and see the picture change\n"
      "  eyeray new my-scene\n"
      "  eyeray dev my-scene/scene.toml");
  command->callback([options, &run] { run = [options] { return options->run(); }; });
}

}  // namespace eyeray::engine::cli
