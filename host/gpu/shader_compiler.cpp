#include "host/gpu/shader_compiler.hpp"

#define ENABLE_HLSL  // NOLINT: without it, glslang's header hides functions that its library has
#include <glslang/Public/ResourceLimits.h>
#include <glslang/Public/ShaderLang.h>
#include <glslang/SPIRV/GlslangToSpv.h>

#include <algorithm>
#include <memory>

#include "host/gpu/compiler_messages.hpp"

namespace eyeray::engine::gpu {
namespace {

// glslang's process-wide tables; they cost tens of milliseconds, so only a program that compiles pays for
// them.
void initialize_glslang() {
  struct Process {
    Process() { glslang::InitializeProcess(); }
    ~Process() { glslang::FinalizeProcess(); }
  };
  static const Process process;
}

// Serves #include "path" from the source's own files.
class Includer : public glslang::TShader::Includer {
 public:
  explicit Includer(const ShaderSource& source) : source_(source) {}

  IncludeResult* includeLocal(const char* path, const char*, size_t depth) override {
    const auto file = source_.files.find(std::string_view(path));
    if (file == source_.files.end() || depth > deepest) return nullptr;
    return keep(file->first, file->second);
  }
  // glslang calls this when includeLocal had no answer, and for #include <path>: so it reports the fault.
  IncludeResult* includeSystem(const char* path, const char*, size_t depth) override {
    reasons_.push_back(std::make_unique<std::string>(why_not(path, depth)));
    return keep("", *reasons_.back());
  }
  void releaseInclude(IncludeResult*) override {}  // they live as long as the includer

 private:
  static constexpr size_t deepest = 64;

  std::string why_not(const char* path, size_t depth) const {
    if (std::string why = why_not_includable(path); !why.empty()) return why + ",";
    if (!source_.files.contains(path)) return "there is no such file under the shader root,";
    return depth > deepest ? "includes nest too deep (does it include itself?)," : "write #include \"path\"";
  }
  IncludeResult* keep(const std::string& name, const std::string& text) {
    results_.push_back(std::make_unique<IncludeResult>(name, text.data(), text.size(), nullptr));
    return results_.back().get();
  }

  const ShaderSource& source_;
  std::vector<std::unique_ptr<IncludeResult>> results_;
  std::vector<std::unique_ptr<std::string>> reasons_;
};

// Throws the log's errors, or an error that states that glslang gave no reason.
[[noreturn]] void fail(std::string_view log, const ShaderSource& source) {
  std::vector<Diagnostic> diagnostics = parse_compiler_messages(log, source);
  const bool explained = std::any_of(diagnostics.begin(), diagnostics.end(),
                                     [](const Diagnostic& d) { return d.severity == Severity::error; });
  if (!explained)
    diagnostics.push_back({Severity::error, {source.entry, 0, 0}, "glslang failed without a reason", ""});
  throw InputError(std::move(diagnostics));
}

EShLanguage stage_of(std::string_view entry) {
  return entry.ends_with(".vert.glsl")   ? EShLangVertex
         : entry.ends_with(".frag.glsl") ? EShLangFragment
                                         : EShLangCompute;
}

}  // namespace

CompiledShader compile_shader(const ShaderSource& source, std::string_view preamble, Lines lines,
                              const std::string& entry_point) {
  initialize_glslang();
  const std::string& text = source.files.at(source.entry);
  const char* strings[] = {text.c_str()};
  const int lengths[] = {int(text.size())};
  const char* names[] = {source.entry.c_str()};
  const bool hlsl = source.entry.ends_with(".hlsl");
  const std::string before =
      (hlsl ? "" : "#extension GL_GOOGLE_include_directive : require\n") + std::string(preamble);

  // Parse. Errors cascade, so that all are seen at once.
  const auto messages = EShMessages(EShMsgSpvRules | EShMsgVulkanRules | EShMsgCascadingErrors |
                                    (hlsl ? EShMsgReadHlsl : EShMsgDefault));
  const EShLanguage stage = stage_of(source.entry);
  glslang::TShader shader(stage);
  shader.setStringsWithLengthsAndNames(strings, lengths, names, 1);
  shader.setPreamble(before.c_str());
  shader.setEnvInput(hlsl ? glslang::EShSourceHlsl : glslang::EShSourceGlsl, stage, glslang::EShClientVulkan,
                     100);
  if (hlsl) {
    // HLSL numbers each kind of resource from 0.
    shader.setEntryPoint(entry_point.c_str());
    shader.setSourceEntryPoint(entry_point.c_str());
    shader.setAutoMapBindings(true);
    shader.setHlslIoMapping(true);
    shader.setShiftBinding(glslang::EResTexture, 100);
    shader.setShiftBinding(glslang::EResUav, 200);
    shader.setShiftBinding(glslang::EResSampler, 300);
  }
  shader.setEnvClient(glslang::EShClientVulkan, glslang::EShTargetVulkan_1_1);
  shader.setEnvTarget(glslang::EShTargetSpv, glslang::EShTargetSpv_1_3);
  Includer includer(source);
  if (!shader.parse(GetDefaultResources(), 450, false, messages, includer)) fail(shader.getInfoLog(), source);

  // Link, and write the words. Optimisation comes later; names stay for reflection.
  glslang::TProgram program;
  program.addShader(&shader);
  if (!program.link(messages) || (hlsl && !program.mapIO())) fail(program.getInfoLog(), source);
  CompiledShader result;
  result.warnings = parse_compiler_messages(shader.getInfoLog(), source);
  glslang::SpvOptions options;
  options.disableOptimizer = true;
  options.generateDebugInfo = lines == Lines::kept;
  glslang::GlslangToSpv(*program.getIntermediate(stage), result.spirv, &options);
  return result;
}

std::string compiler_version() {
  const glslang::Version version = glslang::GetVersion();
  return fmt::format("glslang {}.{}.{} Vulkan 1.1 SPIR-V 1.3", version.major, version.minor, version.patch);
}

}  // namespace eyeray::engine::gpu
