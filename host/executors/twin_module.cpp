#include "host/executors/twin_module.hpp"

#include <dlfcn.h>
#include <unistd.h>

#include <algorithm>
#include <cstdlib>
#include <fstream>
#include <limits>
#include <map>
#include <optional>
#include <sstream>

#include "host/core/atomic_file.hpp"
#include "host/core/content_hash.hpp"
#include "host/core/diagnostic.hpp"
#include "host/core/disk_cache.hpp"
#include "host/core/embedded_shaders.hpp"
#include "host/core/error.hpp"
#include "host/core/input_file.hpp"
#include "host/core/make_folder.hpp"
#include "host/core/private_folder.hpp"
#include "host/core/text_scanner.hpp"
#include "host/executors/cpp_compiler.hpp"
#include "host/executors/shader_files.hpp"

namespace fs = std::filesystem;

namespace eyeray::engine::executors {
namespace {

constexpr double longest_compilation = 300;  // seconds
constexpr size_t most_kept = 16;             // most kept of modules in the cache
constexpr size_t most_diagnostics = 20;

bool has_text(const fs::path& file, std::string_view text) {
  std::error_code failed;
  return fs::file_size(file, failed) == text.size() && !failed && read_file(file) == text;
}

template <typename Visit>
void for_each_source(const Visit& visit) {
  for (const EmbeddedFile& shader : embedded_shaders()) visit(fs::path("shaders") / shader.name, shader.text);
  for (const EmbeddedFile& source : twin_sources()) visit(fs::path(source.name), source.text);
}

bool has_sources(const fs::path& folder) {
  bool whole = true;
  for_each_source(
      [&](const fs::path& name, std::string_view text) { whole = whole && has_text(folder / name, text); });
  return whole;
}

// Writes the program's own part of the sources below `folder`, once for each version. Other processes see all
// of it or nothing.
fs::path write_sources(const fs::path& folder) {
  ContentHash hash;
  for_each_source([&](const fs::path& name, std::string_view text) { hash.add(name.string()).add(text); });
  fs::path sources = folder / ("sources-" + hash.hex());
  if (has_sources(sources)) return sources;

  const fs::path part = fmt::format("{}.part.{}", sources.string(), ::getpid());
  for_each_source([&](const fs::path& name, std::string_view text) {
    make_folder((part / name).parent_path());
    std::ofstream(part / name, std::ios::binary) << text;
  });
  if (!has_sources(part)) throw Error(ExitCode::file_io, "cannot write {}", sources.string());
  std::error_code failed;
  fs::rename(part, sources, failed);
  if (failed && !has_sources(sources)) {  // no other process was faster: the folder is damaged
    fs::remove_all(sources);
    fs::rename(part, sources);
  }
  fs::remove_all(part, failed);
  return sources;
}

std::vector<fs::path> shaders_in(const fs::path& folder) {
  std::vector<fs::path> files;
  std::error_code failed;
  for (fs::recursive_directory_iterator entry(folder, failed), end; !failed && entry != end;
       entry.increment(failed))
    if (const fs::path ending = entry->path().extension(); ending == ".glsl" || ending == ".h")
      files.push_back(entry->path());
  std::sort(files.begin(), files.end());
  return files;
}

// An empty path, which is no folder, stays empty.
fs::path absolute_or_empty(const fs::path& folder) {
  return folder.empty() ? folder : fs::absolute(folder).lexically_normal();
}

// `FILE:LINE:COLUMN: error: MESSAGE`, as compilers write it; `COLUMN:` may be missing, and `fatal` come
// before `error`.
struct CompilerError {
  std::string_view file;
  int line = 0, column = 0;
  std::string_view message;
};
std::optional<CompilerError> compiler_error(std::string_view text) {
  TextScanner scanner(text);
  auto position = scanner.before(": error: ");
  if (!position) position = scanner.before(": fatal error: ");
  if (!position) return std::nullopt;
  CompilerError error{.file = *position, .message = scanner.rest()};
  // The line, and the column after it.
  for (int i = 0; i < 2; ++i) {
    const size_t colon = error.file.rfind(':');
    const auto number =
        colon == std::string_view::npos ? std::nullopt : number_of(error.file.substr(colon + 1));
    if (!number || *number < 0 || *number > std::numeric_limits<int>::max()) break;
    error.column = error.line;
    error.line = int(*number);
    error.file = error.file.substr(0, colon);
  }
  return error.line > 0 ? std::optional(error) : std::nullopt;
}

// The compiler's errors, with the files' names as their owner knows them.
std::vector<Diagnostic> diagnostics_in(const std::string& log, const fs::path& folder,
                                       const fs::path& sources) {
  std::vector<Diagnostic> found;
  std::istringstream lines(log);
  for (std::string line; std::getline(lines, line) && found.size() < most_diagnostics;) {
    const std::optional<CompilerError> error = compiler_error(line);
    if (!error) continue;
    const fs::path file = error->file;
    const fs::path of_user = file.lexically_relative(absolute_or_empty(folder));
    Diagnostic diagnostic;
    diagnostic.position = {file.string(), error->line, error->column};
    if (!folder.empty() && !of_user.empty() && *of_user.begin() != "..")
      diagnostic.position.file = (folder / of_user).string();
    else if (const fs::path own = file.lexically_relative(sources / "shaders"); *own.begin() != "..")
      diagnostic.position.file = own.string();
    diagnostic.message = error->message;
    std::error_code failed;
    if (fs::is_regular_file(file, failed))
      show_source_line(diagnostic, line_of(read_file(file), diagnostic.position.line));
    found.push_back(std::move(diagnostic));
  }
  return found;
}

// Writes a copy of `file` with other text but the same lines. Compilers and debuggers show the file itself.
void write_copy(const fs::path& copy, const fs::path& file, std::string_view text) {
  make_folder(copy.parent_path());
  std::string quoted;
  for (const char c : file.string()) quoted += (c == '"' || c == '\\' ? "\\" : "") + std::string(1, c);
  std::ofstream stream(copy, std::ios::binary);
  stream << "#line 1 \"" << quoted << "\"\n" << text;
  if (!stream.flush()) throw Error(ExitCode::file_io, "cannot write {}", copy.string());
}

// Removes old modules and old sources, and keeps the newest of each.
void drop_old(const fs::path& folder) {
  std::error_code failed;
  std::vector<std::pair<fs::file_time_type, fs::path>> modules, sources;
  for (fs::directory_iterator entry(folder, failed), end; !failed && entry != end; entry.increment(failed))
    (entry->is_directory(failed) ? sources : modules)
        .emplace_back(entry->last_write_time(failed), entry->path());
  for (auto* const all : {&modules, &sources}) {
    std::sort(all->begin(), all->end());
    for (size_t i = 0; i + most_kept < all->size(); ++i) fs::remove_all((*all)[i].second, failed);
  }
}

}  // namespace

TwinModule::TwinModule(const fs::path& folder, const std::string& sanitizers) {
  const ShaderFiles checked(folder, "");  // throws if its records differ from ours
  std::vector<std::string> command = require_cpp_compiler();
  compiler_ = fs::path(command[0]).filename();
  for (const std::string& flag : module_flags(command, sanitizers)) command.push_back(flag);
  if (!folder.empty()) files_ = shaders_in(folder);

  fs::path cache_folder = DiskCache::of_user().folder();
  if (cache_folder.empty() || !make_private_folder(cache_folder) ||
      !make_private_folder(cache_folder /= "twin") || ::access(cache_folder.c_str(), W_OK) != 0)
    cache_folder = scratch_.emplace().path();
  const fs::path sources = write_sources(cache_folder);

  std::vector<std::string> inputs;
  if (!folder.empty()) inputs.push_back("-I" + absolute_or_empty(folder).string());
  for (const std::string& input : {"-I" + (sources / "shaders").string(), "-I" + sources.string(),
                                   (sources / "host/twin/twin.cpp").string()})
    inputs.push_back(input);
  ContentHash hash;
  for (const auto* const words : {&command, &inputs})
    for (const std::string& word : *words) hash.add(word);
  std::error_code failed;
  const auto made = fs::last_write_time(fs::canonical(command[0], failed), failed).time_since_epoch().count();
  hash.add(std::to_string(made));
  std::map<fs::path, std::string> counted;
  for (const fs::path& file : files_) {
    const fs::path name = file.lexically_relative(folder);
    std::string text = read_file(file);
    drop_byte_order_mark(text);
    std::string guarded =
        loops_.guard(checked.shown(name), text, checked.replaced(name.string()).value_or(""));
    hash.add(file.string()).add(guarded);
    if (guarded != text) counted.emplace(name, std::move(guarded));
  }
  const fs::path module = cache_folder / (hash.hex() + ".so");

  if (!is_private_file(module)) {
    const fs::path part = fmt::format("{}.part.{}", module.string(), ::getpid());
    inputs.insert(inputs.end(), {"-o", part.string()});
    const auto compile = [&](const std::vector<std::string>& before) {
      std::vector<std::string> words = command;
      words.insert(words.end(), before.begin(), before.end());
      words.insert(words.end(), inputs.begin(), inputs.end());
      return run_process(words, compiler_environment(), longest_compilation);
    };
    ProcessResult result;
    if (!counted.empty()) {
      const ScratchFolder copies;
      for (const auto& [name, text] : counted)
        write_copy(copies.path() / name, absolute_or_empty(folder / name), text);
      result = compile({"-I" + copies.path().string()});
    }
    // Compiles the author's own text, so that errors show it.
    if (counted.empty() || result.code != 0) result = compile({});
    if (result.code != 0) {
      fs::remove(part, failed);
      std::vector<Diagnostic> diagnostics = diagnostics_in(result.err, folder, sources);
      if (!diagnostics.empty()) throw InputError(std::move(diagnostics));
      throw Error(ExitCode::bad_input, "{} cannot compile the twin of the shaders (exit code {}): {}",
                  command[0], result.code, printable(result.err.substr(0, 2000)));
    }
    fs::rename(part, module);
    drop_old(cache_folder);
  }
  handle_ = ::dlopen(module.c_str(), RTLD_NOW | RTLD_LOCAL);
  if (!handle_) throw Error(ExitCode::file_io, "cannot load the twin of the shaders: {}", ::dlerror());
  functions_ = static_cast<const twin::Functions*>(::dlsym(handle_, "eyeray_twin"));
  if (!functions_) throw Error(ExitCode::file_io, "{} contains no twin", module.string());
}

TwinModule::~TwinModule() {
  if (handle_) ::dlclose(handle_);
}

}  // namespace eyeray::engine::executors
