#include "host/executors/formula_functions.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "host/expression/emit.hpp"
#include "host/formula/formula.hpp"

namespace eyeray::engine::executors {
namespace {

using expression::LoadedNumbers;
using formula::FormulaKind;
using records::PackedFormula;

// The functions with which rays find the surface of formula `i`.
std::string surface_functions(size_t i, const PackedFormula& packed, LoadedNumbers* numbers) {
  const formula::Formula& formula = *packed.formula;
  if (packed.by_bounds) {
    const expression::StraightLine& line = formula.straight_line();
    return expression::bound_text(line, fmt::format("formula{}_bound", i), numbers) +
           expression::gradient_text(line, fmt::format("formula{}_dual", i), numbers) +
           fmt::format(
               "#define FORMULA_NAME(part) formula{0}_##part\n"
               "#define FORMULA_BOUND(it, x, y, z) formula{0}_bound(x, y, z)\n"
               "#define FORMULA_DUAL(it, p) formula{0}_dual(p)\n"
               "#include \"shapes/implicit/bounded_search.glsl\"\n"
               "#undef FORMULA_NAME\n#undef FORMULA_BOUND\n#undef FORMULA_DUAL\n",
               i);
  }
  const std::string name = fmt::format("f{}_", i);
  const std::string restart = formula.loops() ? "formula_iterations = 0u; " : "";
  return formula.kernel(name, numbers) +
         fmt::format("float formula{}_value(vec3 p) {{ {}return {}f(p); }}\n", i, restart, name) +
         fmt::format("vec3 formula{}_gradient(vec3 p) {{ {}return {}; }}\n", i, restart,
                     formula.has_other() ? name + "gradient(p)" : "vec3(0.0f, 0.0f, 0.0f)") +
         fmt::format(
             "#define FORMULA_NAME(part) formula{0}_##part\n#define FORMULA_VALUE(it, p) "
             "formula{0}_value(p)\n"
             "#define FORMULA_HAS_GRADIENT(it) {1}\n#define FORMULA_GRADIENT(it, p) formula{0}_gradient(p)\n"
             "#include \"shapes/implicit/lipschitz_march.glsl\"\n"
             "#undef FORMULA_NAME\n#undef FORMULA_VALUE\n#undef FORMULA_HAS_GRADIENT\n"
             "#undef FORMULA_GRADIENT\n",
             i, formula.has_other());
}

// The function of each colour's formula, and a function that calls one of them by number.
std::string color_functions(const std::vector<PackedFormula>& formulas, LoadedNumbers* numbers) {
  std::string text, choice;
  for (size_t i = 0; i < formulas.size(); ++i) {
    const formula::Formula& formula = *formulas[i].formula;
    if (formula.kind() != FormulaKind::color) continue;
    const std::string name = fmt::format("f{}_", i);
    text += formula.kernel(name, numbers);
    choice += fmt::format("  if (number == {}u) {{ {}color = {}color(uv); }}\n", i,
                          formula.loops() ? "formula_iterations = 0u; " : "", name);
  }
  if (choice.empty()) return "";
  return text + "vec3 formula_color_of(uint number, vec2 uv) {\n  vec3 color = vec3(0.0f, 0.0f, 0.0f);\n" +
         choice + "  return color;\n}\n#define FORMULA_COLOR(number, uv) formula_color_of(number, uv)\n";
}

// The function of the camera's formula. A scene has one at most.
std::string camera_functions(const std::vector<PackedFormula>& formulas, LoadedNumbers* numbers) {
  std::string text;
  for (size_t i = 0; i < formulas.size(); ++i) {
    const formula::Formula& formula = *formulas[i].formula;
    if (formula.kind() != FormulaKind::camera) continue;
    const std::string name = fmt::format("f{}_", i),
                      restart = formula.loops() ? "formula_iterations = 0u; " : "";
    text = formula.kernel(name, numbers) +
           fmt::format("vec3 formula_direction(vec4 at) {{ {}return {}direction(at); }}\n", restart, name) +
           fmt::format("vec3 formula_origin(vec4 at) {{ {}return {}; }}\n", restart,
                       formula.has_other() ? name + "origin(at)" : "vec3(0.0f, 0.0f, 0.0f)") +
           "#define FORMULA_DIRECTION(number, at) formula_direction(at)\n"
           "#define FORMULA_ORIGIN(number, at) formula_origin(at)\n";
  }
  return text;
}

}  // namespace

std::string formula_functions(const records::PackedScene& scene, expression::LoadedNumbers* numbers) {
  const auto loops = [](const PackedFormula& f) { return !f.by_bounds && f.formula->loops(); };
  const auto is_surface = [](const PackedFormula& f) { return f.formula->kind() == FormulaKind::surface; };
  std::string text;
  if (!scene.formulas.empty()) text += "#include \"math/formula.glsl\"\n";
  if (std::ranges::any_of(scene.formulas, is_surface)) text += "#include \"shapes/implicit/search.glsl\"\n";
  if (std::ranges::any_of(scene.formulas, loops))
    text +=
        "uint formula_iterations = 0u;\nbool formula_overran = false;\n#define FORMULA_OVERRAN "
        "formula_overran\n"
        "bool formula_iterates(uint iterations) {\n  formula_iterations = formula_iterations + iterations;\n"
        "  formula_overran = formula_overran || formula_iterations > FORMULA_ITERATIONS;\n  return "
        "!formula_overran;\n}\n";
  std::string rows;
  for (size_t i = 0; i < scene.formulas.size(); ++i) {
    if (!is_surface(scene.formulas[i])) continue;
    rows += fmt::format(" X({0}u, formula{0})", i);
    text += surface_functions(i, scene.formulas[i], numbers);
  }
  return text + color_functions(scene.formulas, numbers) + camera_functions(scene.formulas, numbers) +
         "#define FORMULAS(X)" + rows + "\n";
}

}  // namespace eyeray::engine::executors
