#include "formula/cpp_library.hpp"

#include <dlfcn.h>
#include <fmt/format.h>
#include <sys/mman.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <optional>
#include <sstream>
#include <vector>

#include "core/atomic_file.hpp"
#include "core/content_hash.hpp"
#include "core/error.hpp"
#include "core/process.hpp"

namespace fs = std::filesystem;

namespace eyeray::formula {

namespace {

// Nothing may be contracted or reassociated: the bits are to be the GPU's.
constexpr std::array options = {
    "-std=c++20",      "-O2",       "-fPIC",           "-shared", "-ffp-contract=off",
    "-fno-exceptions", "-fno-rtti", "-fno-math-errno", "-w"};
constexpr double longest_compilation = 60;

// $CXX may be several words ("ccache g++"); none of them goes through a shell.
std::vector<std::string> words_of(const char* text) {
  std::istringstream stream{std::string(text)};
  std::vector<std::string> words;
  for (std::string word; stream >> word;) words.push_back(word);
  return words;
}

bool is_program(const fs::path& path) {
  std::error_code error;
  return fs::is_regular_file(path, error) && ::access(path.c_str(), X_OK) == 0;
}

bool is_in_path(const std::string& name) {
  if (name.find('/') != std::string::npos) return is_program(name);
  const char* path = std::getenv("PATH");
  std::istringstream folders{std::string(path ? path : "")};
  for (std::string folder; std::getline(folders, folder, ':');)
    if (is_program(fs::path(folder) / name)) return true;
  return false;
}

// The compiler's words; empty where there is none.
std::vector<std::string> find_compiler() {
  if (const char* chosen = std::getenv("CXX"); chosen && *chosen) {
    std::vector<std::string> words = words_of(chosen);
    if (!words.empty() && is_in_path(words[0])) return words;
  }
  for (const char* name : {"c++", "g++", "clang++"})
    if (is_in_path(name)) return {name};
  return {};
}

class ScratchFolder {
 public:
  ScratchFolder() {
    std::error_code error;
    std::string name = (fs::temp_directory_path(error) / "eyeray-XXXXXX").string();
    if (error || !::mkdtemp(name.data()))
      throw Error(ExitCode::file_io, "cannot make a folder for temporary files: {}", strerror(errno));
    path_ = name;
  }
  ~ScratchFolder() {
    std::error_code error;
    fs::remove_all(path_, error);
  }
  ScratchFolder(const ScratchFolder&) = delete;
  ScratchFolder& operator=(const ScratchFolder&) = delete;
  const fs::path& path() const { return path_; }

 private:
  fs::path path_;
};

std::string first_error(const std::string& messages) {
  std::istringstream lines(messages);
  for (std::string line; std::getline(lines, line);)
    if (const size_t at = line.find("error: "); at != std::string::npos) return line.substr(at + 7);
  return messages.substr(0, messages.find('\n'));
}

std::string compile(std::vector<std::string> command, const std::string& unit, const std::string& what) {
  const ScratchFolder folder;
  const fs::path source = folder.path() / "formula.cpp", object = folder.path() / "formula.so";
  write_file_atomically(source, unit);
  const std::string compiler = command[0];
  command.insert(command.end(), options.begin(), options.end());
  command.insert(command.end(), {"-o", object.string(), source.string(), "-lm"});
  const ProcessResult result = run_process(command, {}, longest_compilation);
  if (result.code == -1)
    throw Error(ExitCode::no_compiler, "{} took {} more than {:g} s to compile", what, compiler,
                longest_compilation);
  if (result.code != 0)
    throw Error(ExitCode::no_compiler, "{} is right as GLSL, but {} does not take it as C++: {}", what,
                compiler, first_error(result.err));
  return read_file(object);
}

}  // namespace

// Loaded from memory: neither the cache nor the folder for temporary files needs to be one that programs may
// run from. dlopen knows libraries by their names, and this one is the file's number: while the library is
// there, no other may get it.
CppLibrary::Opened CppLibrary::open(const std::string& bytes) {
  const int file = ::memfd_create("formula", MFD_CLOEXEC);
  if (file < 0) throw Error(ExitCode::file_io, "cannot make a file in memory: {}", strerror(errno));
  for (size_t done = 0; done < bytes.size();) {
    const ssize_t count = ::write(file, bytes.data() + done, bytes.size() - done);
    if (count < 0) {
      ::close(file);
      throw Error(ExitCode::file_io, "cannot write a file in memory: {}", strerror(errno));
    }
    done += size_t(count);
  }
  void* handle = ::dlopen(fmt::format("/proc/self/fd/{}", file).c_str(), RTLD_NOW | RTLD_LOCAL);
  if (!handle) {
    const std::string why = ::dlerror();
    ::close(file);
    throw Error(ExitCode::no_compiler, "what the C++ compiler made cannot be loaded: {}", why);
  }
  return {file, handle};
}

CppLibrary::~CppLibrary() {
  ::dlclose(opened_.handle);
  ::close(opened_.file);
}

std::shared_ptr<const CppLibrary> CppLibrary::load(const std::string& unit, const std::string& what,
                                                   const DiskCache& cache) {
  const std::vector<std::string> compiler = find_compiler();
  if (compiler.empty())
    throw Error(
        ExitCode::no_compiler,
        "the CPU runs {} as C++, and there is no C++ compiler: neither $CXX nor c++, g++ or clang++ in $PATH",
        what);
  ContentHash hash;
  for (const std::string& word : compiler) hash.add(word);
  for (const char* option : options) hash.add(option);
  const std::string name = "formula-" + hash.add(unit).hex();
  std::optional<std::string> bytes = cache.load(name);
  if (!bytes) {
    bytes = compile(compiler, unit, what);
    cache.store(name, *bytes);
  }
  return std::shared_ptr<const CppLibrary>(new CppLibrary(open(*bytes)));
}

void* CppLibrary::symbol(const char* name) const {
  void* address = ::dlsym(opened_.handle, name);
  CHECK(address != nullptr);
  return address;
}

bool has_cpp_compiler() {
  return !find_compiler().empty();
}

}  // namespace eyeray::formula
