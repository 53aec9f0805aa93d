#include "host/compute/source.hpp"

#include <cstring>
#include <map>

#include "host/compute/module.hpp"
#include "host/core/input_file.hpp"
#include "host/gpu/shader_compiler.hpp"

namespace fs = std::filesystem;

namespace eyeray::engine::compute {
namespace {

constexpr size_t most_kernel_bytes = size_t{64} << 20;

std::vector<uint32_t> read_spirv(const fs::path& file) {
  const std::string bytes = read_input_file(file, "the kernel", most_kernel_bytes);
  if (bytes.empty() || bytes.size() % 4 != 0)
    throw Error(ExitCode::bad_input, "{} is no SPIR-V: it has {} bytes, and SPIR-V consists of words of 4",
                file.string(), bytes.size());
  std::vector<uint32_t> words(bytes.size() / 4);
  std::memcpy(words.data(), bytes.data(), bytes.size());
  if (words[0] != 0x07230203u)
    throw Error(ExitCode::bad_input, "{} is no SPIR-V: it does not begin with 0x07230203", file.string());
  return words;
}

std::string preamble_of(const std::vector<std::string>& defines) {
  std::string text;
  for (const std::string& define : defines) {
    const size_t equals = define.find('=');
    text += "#define " + define.substr(0, equals);
    if (equals != std::string::npos) text += " " + define.substr(equals + 1);
    text += '\n';
  }
  return text;
}

// Compiles text. Names of files are shown as paths from the working folder.
LoadedKernel compile(const KernelSource& source) {
  std::vector<fs::path> folders{source.file.parent_path()};
  folders.insert(folders.end(), source.include_folders.begin(), source.include_folders.end());
  std::map<std::string, std::string> shown;
  const auto provide = [&](std::string_view name) -> std::optional<std::string> {
    const bool is_entry = shown.empty();
    for (const fs::path& folder : folders) {
      const fs::path path = folder / name;
      if (std::error_code none; !is_entry && !fs::is_regular_file(path, none)) continue;
      std::string text = read_input_file(path, is_entry ? "the kernel" : "the file", most_kernel_bytes);
      drop_byte_order_mark(text);
      shown[std::string(name)] = path.string();
      return text;
    }
    return std::nullopt;
  };
  const gpu::ShaderSource text = gpu::read_shader(provide, source.file.filename().string());
  const auto with_paths = [&](std::vector<Diagnostic> diagnostics) {
    for (Diagnostic& each : diagnostics)
      if (const auto path = shown.find(each.position.file); path != shown.end())
        each.position.file = path->second;
    return diagnostics;
  };
  try {
    gpu::CompiledShader compiled = gpu::compile_shader(text, preamble_of(source.defines), gpu::Lines::kept,
                                                       source.entry.empty() ? "main" : source.entry);
    if (source.file.extension() == ".hlsl") compiled.spirv = legalise(compiled.spirv);
    return {with_files(compiled.spirv, shown), with_paths(std::move(compiled.warnings))};
  } catch (const InputError& error) {
    for (const Diagnostic& each : error.diagnostics())
      if (each.message.find("Entry point not found") != std::string::npos)
        throw Error(ExitCode::bad_input, "{} has no function \"{}\": name the entry point by `entry`",
                    source.file.string(), source.entry.empty() ? "main" : source.entry);
    throw InputError(with_paths(error.diagnostics()));
  }
}

}  // namespace

bool is_kernel_source(const fs::path& file) {
  const fs::path ending = file.extension();
  return ending == ".comp" || ending == ".glsl" || ending == ".hlsl" || ending == ".spv";
}

LoadedKernel load_kernel(const KernelSource& source) {
  const bool binary = source.file.extension() == ".spv";
  LoadedKernel kernel = binary ? LoadedKernel{read_spirv(source.file), {}} : compile(source);
  validate(kernel.spirv, source.file.string());
  kernel.spirv = with_entry(kernel.spirv, source.entry, source.file.string());
  return kernel;
}

}  // namespace eyeray::engine::compute
