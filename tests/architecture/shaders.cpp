// Checks the contents of shader files, so that they mean the same as GLSL and as C++, on every driver.
#include "sources.hpp"
#include "tests/support/doctest.hpp"

using namespace eyeray::engine::test;

namespace {

bool entry(const SourceFile& file) {
  return file.path.ends_with(".comp.glsl") || file.path.ends_with(".vert.glsl") ||
         file.path.ends_with(".frag.glsl");
}

// The self-test is no shader of pictures: it tests the driver's arithmetic.
bool self_test(const SourceFile& file) {
  return file.path == "shaders/kernels/selftest.comp.glsl";
}

// The lines of code that have `pattern` in them, of the files that `filter` picks.
template <typename Filter>
std::string find_code(const std::regex& pattern, const Filter& filter) {
  std::string found;
  for (const SourceFile& file : source_files("shaders")) {
    for (size_t i = 0; i < file.lines.size(); ++i) {
      if (filter(file) && std::regex_search(code(file.lines[i]), pattern))
        found += file.at(i) + ": " + file.lines[i] + "\n";
    }
  }
  return found;
}

}  // namespace

TEST_CASE("only entries and kernels/bindings.glsl hold pure GLSL: version, extensions, layouts, main") {
  const auto common = [](const SourceFile& file) {
    return !entry(file) && file.path != "shaders/kernels/bindings.glsl";
  };
  CHECK(find_code(std::regex(R"(#\s*(version|extension)\b)"), common) == "");
  CHECK(find_code(std::regex(R"(\blayout\s*\()"), common) == "");
  CHECK(find_code(std::regex(R"(\b(uniform|buffer|shared|gl_\w+)\b)"), common) == "");
  const auto no_entry = [](const SourceFile& file) { return !entry(file); };
  CHECK(find_code(std::regex(R"(\bvoid\s+main\b)"), no_entry) == "");
  CHECK(find_code(std::regex(R"(\bvoid\s+main\b)"), entry) != "");
}

TEST_CASE("shaders call no built-in function of the driver but abs, floor, sqrt and bit casts") {
  const std::regex loose(
      R"(\b(radians|degrees|sin|cos|tan|asin|acos|atan|sinh|cosh|tanh|asinh|acosh|atanh|pow|exp|log|exp2|log2|inversesqrt|)"
      R"(sign|trunc|round|roundEven|ceil|fract|mod|modf|min|max|clamp|mix|step|smoothstep|isnan|isinf|fma|frexp|ldexp|)"
      R"(length|distance|dot|cross|normalize|faceforward|reflect|refract|any|all|not|lessThan|greaterThan|equal|inverse|)"
      R"(transpose|determinant|outerProduct|matrixCompMult|bitCount|bitfieldExtract|findLSB|findMSB|umulExtended|dFdx|dFdy|)"
      R"(texture|packHalf\w+|packUnorm\w+|packSnorm\w+|unpack\w+)\s*\()");
  CHECK(find_code(loose, [](const SourceFile& file) { return !self_test(file); }) == "");
  // Only these shaders may use atomics, by which paths and photons enter themselves in lists, or subgroup
  // operations, by which lanes exchange values.
  const auto no_list = [](const SourceFile& file) {
    return file.path != "shaders/kernels/wavefront.comp.glsl" &&
           file.path != "shaders/kernels/photons.comp.glsl";
  };
  CHECK(find_code(std::regex(R"(\batomic\w+\s*\()"), no_list) == "");
  const auto alone = [](const SourceFile& file) {
    return !self_test(file) && file.path != "shaders/kernels/cooperative/subgroup.glsl" &&
           file.path != "shaders/kernels/cooperative/packet.glsl" &&
           file.path != "shaders/kernels/cooperative/bvh4.glsl";
  };
  CHECK(find_code(std::regex(R"(\bsubgroup\w+\s*\()"), alone) == "");
}

TEST_CASE("shaders use no double, half or swizzle, so both languages read them alike") {
  const auto pictures = [](const SourceFile& file) { return !entry(file) && file.name() != "language.h"; };
  CHECK(find_code(std::regex(R"(\b(double|dvec[234]|half|float16_t|precise|lowp|mediump|highp)\b)"),
                  pictures) == "");
  CHECK(find_code(std::regex(R"(\.([xyzw]{2,4}|[rgba]{2,4}|[stpq]{2,4})\b(?!\s*\())"), pictures) == "");
  // A float literal ends in f, or C++ computes in double.
  CHECK(find_code(std::regex(R"((^|[^\w.])(\d+\.\d*|\.\d+)(e[-+]?\d+)?(?![\w.]))"), pictures) == "");
}

TEST_CASE("only one-line functions that name their meaning read a, b and c of records") {
  const std::regex unnamed(R"(\b\w+\.[abc]\b)");
  const std::regex named(
      R"(^(INLINE )?\w+ \w+\((Primitive|Material|Texture|Light|Emitter) \w+\) \{ return [^;]*; \}\s*$)");
  const std::regex whole(R"(\bprimitive_of\(|^  primitive\.([abc]) = \1;|^\s*#\s*include\b)");
  std::string found;
  for (const SourceFile& file : source_files("shaders")) {
    for (size_t i = 0; i < file.lines.size(); ++i) {
      const std::string line = code(file.lines[i]);
      if (std::regex_search(line, unnamed) && !std::regex_match(line, named) &&
          !std::regex_search(line, whole))
        found += file.at(i) + ": " + line + "\n";
    }
  }
  CHECK(found == "");
}

TEST_CASE("includes are written from the shaders' root, and files guard themselves") {
  for (const SourceFile& file : source_files("shaders")) {
    CAPTURE(file.path);
    for (const Include& include : includes(file)) {
      CAPTURE(include.name);
      CHECK_FALSE(include.name.starts_with("."));
      CHECK(include.name.find("..") == std::string::npos);
    }
    const bool guarded =
        std::ranges::any_of(file.lines, [](const std::string& l) { return l.starts_with("#ifndef "); });
    CHECK((entry(file) || guarded));
  }
}
