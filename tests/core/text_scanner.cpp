// Tests of texts that are read from front to back.
#include "host/core/text_scanner.hpp"

#include "tests/support/doctest.hpp"

using namespace eyeray::engine;

TEST_CASE("a scanner reads what comes next, or nothing") {
  TextScanner line("  const float a.b-2= -1_000.5e-1f; rest");
  CHECK_FALSE(line.skip("const"));
  line.skip_spaces();
  CHECK(line.one_of({"con", "float"}).empty());
  CHECK(line.one_of({"int", "const"}) == "const");
  CHECK(line.word().empty());
  line.skip_spaces();
  CHECK(line.word() == "float");
  line.skip_spaces();
  CHECK(line.word(".-") == "a.b-2");
  CHECK_FALSE(line.number());
  CHECK(line.before("=") == "");
  line.skip_spaces();
  CHECK(line.number() == -100.05);
  CHECK(line.rest() == "f; rest");
  CHECK_FALSE(line.before("?"));
  CHECK(line.before(";") == "f");
  CHECK(line.rest() == " rest");
}

TEST_CASE("a number is read in each form that scenes and shaders have") {
  const std::pair<const char*, double> numbers[] = {
      {"1", 1},      {"-2", -2},    {"+3", 3},    {".5", .5},       {"5.", 5},   {"1_000", 1000},
      {"+.25", .25}, {"2e3", 2000}, {"2E-1", .2}, {"1.5e+2", 150.}, {"0.1", 0.1}};
  for (const auto& each : numbers) {
    CAPTURE(each.first);
    CHECK(number_of(each.first) == each.second);
  }
  for (const char* text : {"", "-", ".", "e5", "1f", "_1", "1 ", "0x", "nan", "inf", "1e999", "--1"}) {
    CAPTURE(text);
    CHECK_FALSE(number_of(text));
  }
}

TEST_CASE("numbers are found between other text") {
  CHECK(numbers_in("vec3(1, 0.5f,-.25) 2e") == std::vector<double>{3, 1, 0.5, -0.25, 2});
  CHECK(numbers_in("1e999 7 - .") == std::vector<double>{7});
}
