#include "formula/cpp_language.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "core/embedded_shaders.hpp"
#include "core/error.hpp"

namespace eyeray::formula {

namespace {

constexpr std::string_view start = R"text(
#define EXPORT extern "C" __attribute__((visibility("default")))
#define SHADER_BEGIN
#define SHADER_END
#define OUT(T) T&
#define INOUT(T) T&
  namespace {
  typedef unsigned uint;
  thread_local uint turns;
)text";

// What math.glsl takes from the language.
constexpr std::string_view shader_basis = R"text(
  struct uvec4 {
    uint x, y, z, w;
  };
  inline float abs(float x) {
    return __builtin_fabsf(x);
  }
  inline float floor(float x) {
    return __builtin_floorf(x);
  }
  inline float sqrt(float x) {
    return __builtin_sqrtf(x);
  }
  inline uint floatBitsToUint(float x) {
    uint y;
    __builtin_memcpy(&y, &x, 4);
    return y;
  }
  inline float uintBitsToFloat(uint x) {
    float y;
    __builtin_memcpy(&y, &x, 4);
    return y;
  }
)text";

// A shader file without its #includes.
std::string shader(std::string_view name) {
  const auto shaders = embedded_shaders();
  const auto found = std::ranges::find(shaders, name, &EmbeddedShader::name);
  CHECK(found != shaders.end());
  std::string text;
  for (std::string_view rest = found->text; !rest.empty();) {
    const size_t end = std::min(rest.find('\n'), rest.size() - 1) + 1;
    if (!rest.starts_with("#include")) text += rest.substr(0, end);
    rest.remove_prefix(end);
  }
  return text;
}

}  // namespace

std::string cpp_unit(std::string_view constants32, std::string_view constants64, std::string_view program,
                     bool has_gradient) {
  const auto value = [](std::string_view scope, std::string_view real) {
    return fmt::format(
        "EXPORT int eyeray_{0}({1} x, {1} y, {1} z, {1}* value) {{\n  turns = 0;\n"
        "  *value = {0}::u_f({0}::vec3(x, y, z));\n  return turns > FORMULA_TURNS;\n}}\n",
        scope, real);
  };
  const std::string_view gradient = R"text(
    EXPORT int eyeray_gradient_f32(float x, float y, float z, float* gradient) {
      turns = 0;
      f32::vec3 g = f32::u_gradient(f32::vec3(x, y, z));
      gradient[0] = g.x;
      gradient[1] = g.y;
      gradient[2] = g.z;
      return turns > FORMULA_TURNS;
    }
  )text";
  const std::string functions = shader("math.glsl") + shader("formula.glsl");
  // The shaders' macros would stand in the way of nothing: what a formula names has a prefix.
  return fmt::format(
             "{}namespace f32 {{\ntypedef float real;\n{}{}{}inline bool turn() {{ return ++turns <= "
             "FORMULA_TURNS; "
             "}}\n"
             "{}{}}}\nnamespace f64 {{\ntypedef double real;\n{}{}"
             "inline bool turn() {{ return ++turns <= FORMULA_TURNS; }}\n{}{}}}\n}}\n{}{}",
             start, cpp_types(), shader_basis, functions, constants32, program, cpp_types(), cpp_functions(),
             constants64, program, value("f32", "float"), value("f64", "double")) +
         std::string(has_gradient ? gradient : "");
}

}  // namespace eyeray::formula
