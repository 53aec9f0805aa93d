#include "host/executors/formula_functions.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "host/expression/emit.hpp"
#include "host/formula/formula.hpp"

namespace eyeray::executors {

std::string formula_functions(const records::PackedScene& scene) {
  if (scene.formulas.empty()) return "#define FORMULAS(X)\n";
  std::string text = "#include \"shapes/implicit/search.glsl\"\n";
  const auto loops = [](const records::PackedFormula& f) { return !f.by_bounds && f.formula->loops(); };
  if (std::ranges::any_of(scene.formulas, loops))
    text +=
        "uint formula_turns = 0u;\nbool formula_overran = false;\n#define FORMULA_OVERRAN formula_overran\n"
        "bool formula_turn(uint turns) {\n  formula_turns = formula_turns + turns;\n"
        "  formula_overran = formula_overran || formula_turns > FORMULA_TURNS;\n  return "
        "!formula_overran;\n}\n";
  std::string rows;
  for (size_t i = 0; i < scene.formulas.size(); ++i) {
    const formula::Formula& formula = *scene.formulas[i].formula;
    const std::string name = fmt::format("f{}_", i);
    rows += fmt::format(" X({0}u, formula{0})", i);
    if (scene.formulas[i].by_bounds) {
      const expression::StraightLine& line = formula.straight_line();
      text += expression::bound_text(line, fmt::format("formula{}_bound", i)) +
              expression::gradient_text(line, fmt::format("formula{}_dual", i));
      text += fmt::format(
          "#define FORMULA_NAME(part) formula{0}_##part\n"
          "#define FORMULA_BOUND(it, x, y, z) formula{0}_bound(x, y, z)\n"
          "#define FORMULA_DUAL(it, p) formula{0}_dual(p)\n#include \"shapes/implicit/bounded_search.glsl\"\n"
          "#undef FORMULA_NAME\n#undef FORMULA_BOUND\n#undef FORMULA_DUAL\n",
          i);
      continue;
    }
    text += formula.kernel(name);
    const std::string restart = formula.loops() ? "formula_turns = 0u; " : "";
    text += fmt::format("float formula{}_value(vec3 p) {{ {}return {}f(p); }}\n", i, restart, name);
    text += fmt::format("vec3 formula{}_gradient(vec3 p) {{ {}return {}; }}\n", i, restart,
                        formula.has_gradient() ? name + "gradient(p)" : "vec3(0.0f, 0.0f, 0.0f)");
    text += fmt::format(
        "#define FORMULA_NAME(part) formula{0}_##part\n#define FORMULA_VALUE(it, p) formula{0}_value(p)\n"
        "#define FORMULA_HAS_GRADIENT(it) {1}\n#define FORMULA_GRADIENT(it, p) formula{0}_gradient(p)\n"
        "#include \"shapes/implicit/lipschitz_march.glsl\"\n"
        "#undef FORMULA_NAME\n#undef FORMULA_VALUE\n#undef FORMULA_HAS_GRADIENT\n#undef FORMULA_GRADIENT\n",
        i, formula.has_gradient());
  }
  return text + "#define FORMULAS(X)" + rows + "\n";
}

}  // namespace eyeray::executors
