// eyeray shaders: the shaders inside the program, listed, shown or written out for --shaders.
#include <fmt/ranges.h>
#include <CLI/CLI.hpp>
#include <algorithm>
#include <filesystem>
#include <nlohmann/json.hpp>

#include "host/cli/command.hpp"
#include "host/core/atomic_file.hpp"
#include "host/core/diagnostic.hpp"
#include "host/core/embedded_shaders.hpp"
#include "host/core/escaped_text.hpp"
#include "host/core/make_folder.hpp"
#include "host/core/standard_streams.hpp"
#include "host/program/json.hpp"

namespace fs = std::filesystem;

namespace eyeray::engine::cli {
namespace {

struct ShadersCommand {
  std::string folder;
  std::string name;
  bool listed = false;
  bool force = false;
  bool json = false;

  ExitCode run() const;
  void list() const;
  void print() const;
  void write() const;
};

void ShadersCommand::list() const {
  Json names = Json::array();
  for (const EmbeddedFile& shader : embedded_shaders()) {
    names.push_back(shader.name);
    if (!json) fmt::print("{}\n", shader.name);
  }
  if (json) print_json({{"shaders", names}});
}

void ShadersCommand::print() const {
  std::vector<std::string_view> names;
  for (const EmbeddedFile& shader : embedded_shaders()) {
    names.push_back(shader.name);
    if (shader.name != name) continue;
    if (json) {
      print_json({{"name", shader.name}, {"text", shader.text}});
    } else {
      fmt::print("{}", shader.text);
    }
    return;
  }
  const std::string nearest = nearest_name(name, names);
  throw Error(ExitCode::bad_input, "no shader '{}'{} (see eyeray shaders --list)", name,
              nearest.empty() ? "" : fmt::format("; did you mean '{}'?", nearest));
}

void ShadersCommand::write() const {
  // Check all files before writing any: a file that somebody has changed must not be lost.
  std::vector<std::string> changed;
  for (const EmbeddedFile& shader : embedded_shaders()) {
    const fs::path path = fs::path(folder) / shader.name;
    if (fs::exists(path) && read_file(path) != shader.text) changed.push_back(path.string());
  }
  if (!changed.empty() && !force)
    throw Error(ExitCode::file_io,
                "{} differ{} from the embedded shader{}; nothing was written (--force overwrites)",
                fmt::join(changed, ", "), changed.size() == 1 ? "s" : "", changed.size() == 1 ? "" : "s");

  size_t written = 0;
  for (const EmbeddedFile& shader : embedded_shaders()) {
    const fs::path path = fs::path(folder) / shader.name;
    make_folder(path.parent_path());
    write_file_atomically(path, shader.text);
    ++written;
  }
  print_lines(stderr, "{} shaders written to {}; render with --shaders {}\n", written, folder,
              shell_word(folder));
  if (json) print_json({{"folder", folder}, {"files", written}});
}

ExitCode ShadersCommand::run() const {
  if (!folder.empty()) {
    write();
  } else if (!name.empty()) {
    print();
  } else {
    list();
  }
  return ExitCode::ok;
}

}  // namespace

void add_shaders(CLI::App& app, Run& run) {
  CLI::App* const command =
      app.add_subcommand("shaders", "List, print or export the shaders inside the program.");
  const auto options = std::make_shared<ShadersCommand>();
  CLI::Option* const list = command->add_flag("--list", options->listed, "Print the names (the default).");
  CLI::Option* const print =
      command->add_option("--print", options->name, "Print one shader.")->option_text("NAME");
  command->add_option("--export", options->folder, "Write all shaders below this folder.")
      ->option_text("DIR")
      ->excludes(list)
      ->excludes(print);
  command->add_flag("--force", options->force, "Let --export overwrite files that differ.");
  command->add_flag("--json", options->json, "Answer as JSON on standard output.");
  command->footer(
      "Example: change a shader and see the result at once\n"
      "  eyeray shaders --export my-shaders\n"
      "  eyeray dev scenes/whitted.toml --shaders my-shaders");
  command->callback([options, &run] { run = [options] { return options->run(); }; });
}

}  // namespace eyeray::engine::cli
