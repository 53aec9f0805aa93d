// Malicious texts: each is refused at the position of its fault, or does as GLSL requires and no more.
#include <fmt/format.h>

#include "host/formula/formula.hpp"
//
#include "tests/support/doctest.hpp"

using namespace eyeray::engine;

namespace {

std::string times(int count, const std::string& text) {
  std::string all;
  for (int i = 0; i < count; ++i) all += text;
  return all;
}

// Why the text is refused; "" where it is not.
std::string refusal(const std::string& text) {
  try {
    const formula::Formula formula({text, {"f.glsl", 1, 1}}, {}, "it");
  } catch (const InputError& error) {
    CHECK(error.diagnostics()[0].position.line >= 1);
    return error.diagnostics()[0].message;
  }
  return "";
}
std::string refusal_of_f(const std::string& body) {
  return refusal("float f(vec3 p) {\n" + body + "\n}\n");
}

bool is_endless(const std::string& body) {
  const formula::Formula formula({"float f(vec3 p) {\n" + body + "\n}\n", {"f.glsl", 1, 1}}, {}, "it");
  CHECK(formula.loops());
  try {
    (void)formula.value(std::array{0.5f, 0.5f, 0.5f});
  } catch (const Error& error) {
    return error.code() == ExitCode::timed_out;
  }
  return false;
}

const std::string too_long_a_chain = "a statement can have at most 500 operators: split it";
const std::string odd_size = "the size of an array must be a decimal number from 1 to 1024, written out";

}  // namespace

TEST_CASE("an array's size is a plain decimal number, or the array is refused") {
  for (const std::string size :
       {"0100", "0x10", "1u", "0", "1025", "4 + 4", "99999999999999999999", "-1", "n"}) {
    CAPTURE(size);
    CHECK(refusal_of_f("const int n = 4; int a[" + size + "]; return p.x;") == odd_size);
  }
  CHECK(refusal_of_f("int a[64]; return p.x;") == "");
  CHECK(refusal_of_f("float a[2][2]; return p.x;") == "arrays of arrays are not supported");
}

TEST_CASE("a loop whose counter is written to in any way ends by its iteration count") {
  for (const std::string store : {"i &= 0;", "i %= 1;", "(i) = 0;", "i |= 0; i = 0;", "i ^= i;", "i--;",
                                  "int k = i; i -= k;", "i <<= 31;", "i >>= 31;"}) {
    CAPTURE(store);
    CHECK(is_endless("for (int i = 0; i < 10; i++) { " + store + " p.y += p.x; }\nreturn p.y;"));
  }
  CHECK(is_endless("vec2 v = vec2(0.0); for (int i = 0; i < 10; v.yx = v + 1.0) p.y += p.x;\nreturn p.y;"));
  CHECK(is_endless("while (true) { if (p.x > 9.0) break; }\nreturn p.y;"));
  CHECK(is_endless("for (int i = 0; i <= 2147483647; i++) p.y += p.x;\nreturn p.y;"));
}

TEST_CASE("calls count with all the instructions that they expand to") {
  std::string chain = "float g0(float x) { return sin(x); }\n";
  for (int i = 1; i < 40; ++i)
    chain += fmt::format(
        "float g{0}(float x) {{ return g{1}(x) + g{1}(x + 1.0) + g{1}(x + 2.0) + g{1}(x + 3.0); }}\n", i,
        i - 1);
  CHECK(refusal(chain + "float f(vec3 p) { return g39(p.x); }\n").find("instructions; at most 16384") !=
        std::string::npos);
  CHECK(refusal("float g(float x);\nfloat h(float x) { return g(x); }\nfloat g(float x) { return h(x); "
                "}\nfloat f(vec3 p) { return g(p.x); }\n") != "");
  CHECK(refusal(times(300, "float g(float x);\n") + "float f(vec3 p) { return p.x; }\n") ==
        "a formula can have at most 256 functions");
}

TEST_CASE("text that is too long or too deep is refused before a compiler sees it") {
  CHECK(refusal_of_f("return p.x" + times(30000, "+1") + ";") == too_long_a_chain);
  CHECK(refusal_of_f("float x; x = 0." + times(30000, ",1") + "; return x;") == too_long_a_chain);
  CHECK(refusal_of_f("vec2 v = p.xy" + times(15000, ".xy") + "; return v.x;") == too_long_a_chain);
  CHECK(refusal_of_f("return " + times(30000, "- ") + "p.x;") == too_long_a_chain);
  CHECK(refusal_of_f("return p.x > 0. ? 1. : " + times(6000, "p.x>0.?1.:") + "0.;") == too_long_a_chain);
  CHECK(refusal_of_f(times(6000, "if(p.x>0.)") + ";return 0.;") == too_long_a_chain);
  CHECK(refusal_of_f(times(4000, "if(p.x>.0);else ") + ";return 0.;") == too_long_a_chain);
  CHECK(refusal_of_f(times(3500, "if(p.x>.0){}else ") + ";return 0.;") == too_long_a_chain);
  CHECK(refusal_of_f("return " + times(20000, "(") + "p.x" + times(20000, ")") + ";") ==
        "brackets can be nested at most 64 deep: give a part of the expression a name");
  CHECK(refusal_of_f(times(20000, "{") + times(20000, "}") + "return p.x;") ==
        "brackets can be nested at most 64 deep: give a part of the expression a name");
  CHECK(refusal_of_f(times(1500, "for(int i=0;i<2;i++)p.x+=1.;\n") + "return p.x;")
            .find("branches and loops; at most 256") != std::string::npos);
  CHECK(refusal_of_f(times(1000, "if(p.x>1.)p.x-=.5;\n") + "return p.x;")
            .find("branches and loops; at most 256") != std::string::npos);
  CHECK(refusal_of_f(times(60, "vec4 a[1024];a[int(p.x)]=vec4(1.);p.x+=a[int(p.y)].x;{") + times(60, "}") +
                     "return p.x;")
            .find("numbers in arrays; at most 8192") != std::string::npos);
  CHECK(refusal_of_f("vec4 a[1024], b[1024];" + times(3000, "a==b;") + "return p.x;")
            .find("comparing arrays of 1024 elements 3000 times is too much") != std::string::npos);
  // Formulas written by people are far from that limit.
  CHECK(refusal_of_f("float s = 0.0;\n" + times(200, "s += sin(p.x * 3.0) * (p.y - 2.0) + s / 3.0;\n") +
                     "return s;") == "");
  std::string table = "const vec4 t[1000] = vec4[1000](";
  for (int i = 0; i < 1000; ++i) table += fmt::format("{}vec4(-{}.5, 1.0 + 2.0, .5, 1)", i ? "," : "", i);
  CHECK(refusal(table + ");\nfloat f(vec3 p) { return t[int(p.x)].y; }\n") == "");
}

TEST_CASE("of a fault that is repeated thousands of times only the first 20 are reported") {
  for (const std::string& text :
       {"float f(vec3 p) { " + times(8000, "float b;") + " return 1.0; }",
        "float f(vec3 p) { " + times(9000, "abs();") + " return 1.0; }",
        "float f(vec3 p) { " + times(8000, "nam();") + " return 1.0; }", times(60000, "@")}) {
    CAPTURE(text.substr(18, 20));
    try {
      const formula::Formula formula({text, {"f.glsl", 1, 1}}, {}, "it");
      FAIL("the text is accepted");
    } catch (const InputError& error) {
      CHECK(error.diagnostics().size() == 20);
      CHECK(error.diagnostics().back().message.ends_with(" more errors)"));
    }
  }
  const std::string many = "a type can have at most 2 qualifiers, such as `const in`";
  CHECK(refusal(times(10000, "const ") + "float a = 1.0;\nfloat f(vec3 p) { return a; }") == many);
  CHECK(refusal("float f(" + times(20000, "in ") + "vec3 p) { return 1.0; }") == many);
}

TEST_CASE("a text that could be read as two different functions is refused") {
  CHECK(refusal_of_f("// \\\nreturn 1.0;\nreturn dot(p, p) - 0.64;") ==
        "a comment must not end in a backslash: in GLSL the next line would be part of it");
  CHECK(refusal_of_f("// \\\r\nreturn 1.0;") ==
        "a comment must not end in a backslash: in GLSL the next line would be part of it");
  CHECK(refusal_of_f("return p.x; // \\\n#define p q\n;") != "");
  CHECK(refusal_of_f("ret\\\nurn p.x;") == "'\\' has no meaning in a formula");
  CHECK(refusal_of_f("/* \\\n*/ return p.x; // a \\ b") == "");
  CHECK(refusal_of_f("return p.x; }\n#include \"math/math.glsl\"\nfloat g() { return 1.0;") ==
        "a formula has no preprocessor: write a const or a function");
}

TEST_CASE("indices reach nothing beyond their arrays") {
  const formula::Formula formula(
      {"float f(vec3 p) {\n  int a[64]; float b[3]; for (int i = 0; i < 3; i++) b[i] = float(i);\n"
       "  for (int i = -1000; i < 1000; i++) a[i * int(p.x)] = 0x41414141;\n"
       "  b[int(p.y)] = 7.0;\n  return b[0] + b[1] * 10.0 + b[2] * 100.0 + float(a[int(p.z)] - "
       "0x41414141);\n}\n",
       {"f.glsl", 1, 1}},
      {}, "it");
  for (const float far : {1e9f, -1e9f, 3e38f, -3e38f, 100000.0f})
    CHECK(formula.value(std::array{far, far, far}) == (far > 0 && far < 2e9f ? 710.0f : 217.0f));
}

TEST_CASE("a condition selects whole arrays") {
  for (const std::string index : {"1", "int(p.y)"}) {
    CAPTURE(index);
    const formula::Formula formula({"float f(vec3 p) {\n  vec2 a[2], b[2], c[2];\n"
                                    "  a[" +
                                        index + "].y = 3.0; b[" + index +
                                        "].y = 5.0;\n"
                                        "  c = p.x > 0.0 ? a : b; a[1].y = 9.0;\n"
                                        "  return c[" +
                                        index + "].y + (p.x > 0.0 ? b : a)[1].y * 10.0;\n}\n",
                                    {"f.glsl", 1, 1}},
                                   {}, "it");
    CHECK(formula.value(std::array{1.0f, 1.0f, 0.0f}) == 53.0f);
    CHECK(formula.value(std::array{-1.0f, 1.0f, 0.0f}) == 95.0f);
  }
}

TEST_CASE("a formula's straight-line code is limited to a length that drivers compile in seconds") {
  const auto why = [](int terms) -> std::string {
    const formula::Formula formula(
        {"float f(vec3 p) {\n float s = p.x;\n" + times(terms, "s = s * p.y + 0.5;\n") + "return s;\n}\n",
         {"f.glsl", 1, 1}},
        {}, "it");
    try {
      return formula.straight_line().size() > 100 ? "" : "too short";
    } catch (const InputError& error) {
      return error.diagnostics()[0].message;
    }
  };
  CHECK(why(200) == "");
  CHECK(why(400).starts_with("with loops, calls and branches expanded, the function has 80"));
  CHECK(why(400).ends_with(
      "; at most 512 are allowed; so no interval can be computed for it: declare a `lipschitz`"));
}

TEST_CASE("an array's size is limited wherever it is declared") {
  for (const uint64_t size : {1025ull, 65536ull, 1ull << 28, 1ull << 29, 1ull << 30, 1ull << 31, 715827883ull,
                              1431655766ull, 4294967295ull, 1ull << 32, (1ull << 32) + 1, 1ull << 62}) {
    const std::string list = fmt::format("[{}]", size);
    CAPTURE(list);
    for (const std::string type : {"float", "int", "uint", "bool", "vec2", "vec3", "vec4"}) {
      CAPTURE(type);
      CHECK(refusal_of_f(type + " b" + list + "; return p.x;") == odd_size);
      CHECK(refusal_of_f(type + " a, b" + list + "; return p.x;") == odd_size);
      CHECK(refusal_of_f(type + " a[2], b[3], c, d" + list + "; return p.x;") == odd_size);
      CHECK(refusal_of_f(type + " a = " + type + "(p[int(p.x)]), b" + list + "; return p.x;") == odd_size);
      CHECK(refusal_of_f(type + " a[2] = {" + type + "(1), " + type + "(2)}, b" + list + "; return p.x;") ==
            odd_size);
      CHECK(refusal_of_f("for (" + type + " a, b" + list + "; p.x < 1.0;) p.x++; return p.x;") == odd_size);
      CHECK(refusal_of_f("for (int i = 0; i < 2; i++) { " + type + " a, b" + list + "; } return p.x;") ==
            odd_size);
      CHECK(refusal_of_f("const " + type + " a = " + type + "(1), b" + list + "; return p.x;") == odd_size);
      const std::string f = "float f(vec3 p) { return p.x; }\n";
      CHECK(refusal("float g(int k, " + type + " b" + list + ") { return 1.0; }\n" + f) == odd_size);
      CHECK(refusal("float g(" + type + " b" + list + ");\n" + f) == odd_size);
      CHECK(refusal("float g() { " + type + " a, b" + list + "; return 1.0; }\n" + f) == odd_size);
      CHECK(refusal("const " + type + " a = " + type + "(1), b" + list + ";\n" + f) == odd_size);
    }
  }
  // Commas that declare nothing.
  CHECK(refusal_of_f("float a[4], b[3], c = max(p.x, p[1]); b[0] = c, a[3] = c; return a[3] + b[0];") == "");
  // The limit on memory counts the variables after the first comma too.
  CHECK(refusal_of_f("vec4 a" + times(9, "_") +
                     ", b[1024], c[1024], d[1024]; int i = int(p.x);\n"
                     "b[i] = vec4(1); c[i] = b[i]; d[i] = c[i]; return d[i + 1].x;") != "");
}

TEST_CASE("all variables together are limited, whatever their use") {
  std::string names = "vec4 a0[1024]";
  for (int i = 1; i < 400; ++i) names += fmt::format(", a{}[1024]", i);
  std::string touched;
  for (int i = 0; i < 400; ++i) touched += fmt::format("a{}[1].x = p.x;\n", i);
  CHECK(refusal_of_f(names + ";\n" + touched + "return p.x;") ==
        "the formula's variables together have more than 1048576 numbers: use smaller arrays");
}

TEST_CASE("no repeated construct takes a compiler deeper than it can go") {
  const auto refused = [](const std::string& body) { return refusal_of_f(body) != ""; };
  // 600 and 10 000 repetitions fit in a text of 64 KiB; 100 000 do not.
  for (const int count : {600, 10000, 100000}) {
    CAPTURE(count);
    for (const std::string op : {"+",  "-", "*", "/", "<",  ">",  "<=", ">=", "==", "!=", "&&",   "||",
                                 "^^", "&", "|", "^", "<<", ">>", "%",  ",",  "=",  "+=", "?p.x:"}) {
      CAPTURE(op);
      CHECK(refused("return p.x" + times(count, op + "a") + ";"));
      CHECK(refused("return (p.x" + times(count, op + "a") + ");"));
      CHECK(refused("for (;;p.x" + times(count, op + "a") + ") ; return p.x;"));
      CHECK(refused("return p[(0" + times(count, op + "0") + ")];"));
    }
    for (const std::string sign : {"- ", "+ ", "!", "~", "++", "--"})
      CHECK(refused("return " + times(count, sign) + "p.x;"));
    for (const std::string suffix : {"[0]", "(0)", ".x", "++", "--"})
      CHECK(refused("return p" + times(count, suffix) + ";"));
    for (const std::string head :
         {"if(p.x>0.)", "for(;;)", "while(p.x>0.)", "if(p.x>0.);else ", "{", "(", "[", "sin(", "vec3(", "p["})
      CHECK(refused(times(count, head) + ";return 0.;"));
  }
  CHECK(refusal_of_f("float a=p.x; return (a" + times(10000, ",a") + ");") == too_long_a_chain);
  CHECK(refusal_of_f("return p" + times(10000, "[0]") + ";") == too_long_a_chain);
  // Statements that follow each other may fill the text.
  for (const std::string statement : {"float a;", ";", "{}", "p.x;"})
    (void)refusal_of_f(times(7000, statement));
  (void)refusal_of_f("p.x = max(p.x" + times(20000, ",1.") + ");return p.x;");
}
