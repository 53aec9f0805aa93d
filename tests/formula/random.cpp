// Random formulas: each is refused with a message, or runs to an end, twice to the same bits.
// EYERAY_FULL_TESTS=1 draws a million, EYERAY_SEED other ones.
#include <cstring>

#include "host/formula/formula.hpp"
#include "tests/support/amount.hpp"
#include "tests/support/random_formula.hpp"
//
#include "tests/support/doctest.hpp"

using namespace eyeray::engine;

namespace {

// The bits of the formula's value; all ones if it did not end.
template <typename T>
uint64_t bits_at(const formula::Formula& formula, const Vec3& p) {
  try {
    const T value = formula.value(std::array{T(p.x), T(p.y), T(p.z)});
    uint64_t bits = 0;
    std::memcpy(&bits, &value, sizeof value);
    return bits;
  } catch (const Error& error) {
    CHECK(error.code() == ExitCode::timed_out);
    return ~uint64_t{0};
  }
}

}  // namespace

TEST_CASE("random formulas are refused with a message, or end each time with the same bits") {
  const int count = test::amount(1'000, 10'000, 1'000'000);
  int accepted = 0;
  for (int i = 0; i < count; ++i) {
    const uint64_t seed = test::seed() * 10'000'000 + uint64_t(i);
    const std::string text = test::RandomFormula(seed, i % 4 == 0).text();
    try {
      const formula::Formula formula({text, {"f.glsl", 1, 1}}, {}, "it");
      ++accepted;
      test::Random random(seed);
      for (int k = 0; k < 4; ++k) {
        const Vec3 p = random.point(k == 3 ? 1e9 : 2);
        const uint64_t single = bits_at<float>(formula, p), full = bits_at<double>(formula, p);
        if (bits_at<float>(formula, p) != single || bits_at<double>(formula, p) != full)
          FAIL(std::string("the second time it gives something else:\n"), text);
      }
      if (formula.kernel("k_").empty()) FAIL("no kernel");
    } catch (const InputError& refused) {
      const Diagnostic& why = refused.diagnostics()[0];
      if (why.message.empty() || why.position.line < 1) FAIL(std::string(refused.what()), "\n", text);
    }
  }
  MESSAGE(accepted, " of ", count, " accepted");
  CHECK(accepted > count * 7 / 10);
}
