// Loops of a user's shaders are counted in the text, line by line as it was.
#include "host/executors/loop_guard.hpp"

#include "host/records/packer.hpp"
#include "tests/support/doctest.hpp"

using namespace eyeray::engine;
using namespace eyeray::engine::executors;

namespace {

// The guarded text of a file that eyeray does not have, with its first bit as B and its second as C.
std::string guarded(const std::string& text) {
  std::string result = LoopGuard(7).guard("a.glsl", text, "");
  for (const auto& [bit, letter] : {std::pair("256u", "B"), std::pair("512u", "C")})
    for (size_t at; (at = result.find(bit)) != std::string::npos;) result.replace(at, 4, letter);
  return result;
}

std::string message(const LoopGuard& guard, uint32_t flags, bool ray_kinds = false) {
  try {
    guard.check(flags, ray_kinds);
  } catch (const Error& error) {
    CHECK(error.code() == ExitCode::timed_out);
    return error.what();
  }
  return "";
}

}  // namespace

TEST_CASE("each kind of loop counts its iterations where its condition is") {
  CHECK(guarded("void f() { while (a < b) c(); }") == "void f() { while (may_iterate(B) && (a < b)) c(); }");
  CHECK(guarded("void f() { do { c(); } while (a); }") ==
        "void f() { do { c(); } while (may_iterate(B) && (a)); }");
  CHECK(guarded("void f() { do c(); while (a); d(); }") ==
        "void f() { do c(); while (may_iterate(B) && (a)); d(); }");
  CHECK(guarded("void f() { for (;;) {} }") == "void f() { for (;may_iterate(B);) {} }");
  CHECK(guarded("void f() { for (int i = g(1, 2); i < h(3); i++) c(); }") ==
        "void f() { for (int i = g(1, 2);may_iterate(B) && ( i < h(3)); i++) c(); }");
}

TEST_CASE("nested loops share a bit, and later loops have another") {
  CHECK(
      guarded("void f() {\n  while (a) {\n    do { for (;b;) c(); } while (d);\n  }\n  while (e) {}\n}\n") ==
      "void f() {\n  while (may_iterate(B) && (a)) {\n    do { for (;may_iterate(B) && (b);) c(); } while "
      "(may_iterate(B) && (d));\n  }\n  while (may_iterate(C) && (e)) {}\n}\n");
  CHECK(guarded("void f() { do { while (a) {} } while (b);\n while (c) {} }") ==
        "void f() { do { while (may_iterate(B) && (a)) {} } while (may_iterate(B) && (b));\n while "
        "(may_iterate(C) "
        "&& (c)) {} }");
}

TEST_CASE("comments, directives and names that only look like loops stay as they are") {
  for (const std::string text :
       {"// while (a) {}\nvoid f() {}\n", "/* for (;;)\n while (a) */ void f() { int format = whiles(1); }\n",
        "#define LOOP \\\n  while (a)\nvoid f() { g(); }\n", "void f() { int do_it = 1; }\n",
        "void f() { while (", "void f() { for (a; b) }", "do", ""})
    CHECK(guarded(text) == text);
}

TEST_CASE("functions that equal eyeray's own cost nothing, whatever surrounds them") {
  const std::string own = "float f() {\n  while (a) b();\n}\nfloat g() { while (c) d(); }\n";
  LoopGuard guard(7);
  CHECK(guard.guard("a.glsl", own, own) == own);
  CHECK_FALSE(guard.active());
  const std::string changed = "// mine\nfloat h() { return 1.0f; }\n" + own;
  CHECK(guard.guard("a.glsl", changed, own) == changed);
  CHECK(guard.active());
  CHECK(guard.guard("a.glsl", "float f() {\n  while (a) b();\n}\nfloat g() { while (c) e(); }\n", own) ==
        "float f() {\n  while (a) b();\n}\nfloat g() { while (may_iterate(256u) && (c)) e(); }\n");
}

TEST_CASE("the error names the stopped loop, or the candidates") {
  LoopGuard guard(7);
  const uint32_t stopped = FLAG_ENDLESS_LOOP;
  guard.guard("mine/a.glsl", "void f() {}", "");
  CHECK(message(guard, 0) == "");
  CHECK(message(guard, stopped) ==
        "the driver stopped a loop after 65 535 iterations, in a kernel with your mine/a.glsl: look there "
        "for a "
        "loop that does not end");
  guard.guard("mine/b.glsl", "void f() {\n  while (a)\n    b();\n  for (;;) c();\n}", "");
  CHECK(message(guard, stopped | 512) ==
        "a loop of your shaders did not end within 7 iterations in one sample of a pixel; it is this one, or "
        "one "
        "inside of it:\nmine/b.glsl:4: for (;;) c();");
  const std::string both =
      "a loop of your shaders did not end within 7 iterations in one sample of a pixel; it is one of these, "
      "or "
      "one inside of them:\nmine/b.glsl:2: while (a)\nmine/b.glsl:4: for (;;) c();";
  CHECK(message(guard, stopped | 256 | 512) == both);
  // Bits of a kernel that counts rays by their kinds are no loops.
  CHECK(message(guard, stopped | 512, true) == both);
  CHECK(std::string(guard.explained(Error(ExitCode::timed_out, "too late")).what()) ==
        "too late; the loops of your shaders are:\nmine/b.glsl:2: while (a)\nmine/b.glsl:4: for (;;) c();");
}
