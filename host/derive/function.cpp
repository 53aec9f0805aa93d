#include "derive/function.hpp"

#include "derive/execution.hpp"
#include "gpu/shader_compiler.hpp"

namespace eyeray::derive {
namespace {

constexpr const char* entry = "derived.comp.glsl";

gpu::ShaderSource shader_around(std::string_view text, const SourcePosition& where,
                                std::string_view prelude) {
  gpu::ShaderSource source{entry, {}};
  source.files[entry] = fmt::format(
      "layout(set = 0, binding = 0) buffer Derived {{ float derived_x; float derived_y; float derived_z; "
      "float derived_f; }};\n"
      "{}\n#line {} \"{}\"\n{}\n#line 1 \"{}\"\n"
      "void main() {{ derived_f = f(vec3(derived_x, derived_y, derived_z)); }}\n",
      prelude, where.line, where.file, text, entry);
  // For the lines that diagnostics show.
  source.files[where.file] = std::string(size_t(std::max(where.line, 1) - 1), '\n') + std::string(text);
  return source;
}

}  // namespace

calculus::StraightLine read_function(std::string_view text, const SourcePosition& where,
                                     std::string_view prelude) {
  const gpu::CompiledShader compiled =
      gpu::compile_shader(shader_around(text, where, prelude), "", gpu::Lines::kept);
  const Module module(compiled.spirv);
  Tape tape;
  Execution execution(module, tape);
  Value input;
  for (const int i : {0, 1, 2}) input.push_back(tape.input(i));
  return calculus::straight_line(tape, execution.run(input)[3]);
}

}  // namespace eyeray::derive
