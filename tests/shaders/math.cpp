// The written-out functions of math/math.glsl against float64, over their whole range.
#include <fmt/format.h>

#include <cmath>

#include "host/twin/shader_functions.hpp"
#include "tests/support/random.hpp"

#include "tests/support/doctest.hpp"

using namespace eyeray::engine;
using test::Random;

namespace {

constexpr int trials = 2'000'000;

// The largest of error(i) over all trials.
template <typename Error>
double worst(const Error& error) {
  double most = 0;
  for (int i = 0; i < trials; ++i) {
    const double e = error(i);
    CHECK_FALSE(std::isnan(e));
    most = std::max(most, e);
  }
  return most;
}

}  // namespace

TEST_CASE("exp_negative is within 2.5e-7 of e^x, relative, and 0 from -87 down") {
  Random random(1);
  const double most = worst([&](int) {
    const auto x = float(random.uniform(-86.9, 0));
    const double exact = std::exp(double(x));
    return std::fabs(double(shader::exp_negative(x)) - exact) / exact;
  });
  MESSAGE(fmt::format("exp_negative: worst relative error {:.2e}", most));
  CHECK(most <= 2.5e-7);
  CHECK(shader::exp_negative(0.0f) == 1.0f);
  CHECK(shader::exp_negative(-0.0f) == 1.0f);
  CHECK(shader::exp_negative(-1e9f) == 0.0f);
  CHECK(shader::exp_negative(-std::numeric_limits<float>::infinity()) == 0.0f);
}

TEST_CASE("quotient is the quotient of integers, for numerators below 2^24") {
  Random random(8);
  int wrong = 0;
  for (int i = 0; i < trials; ++i) {
    const auto b = uint32_t(1 + random.below(1 << int(1 + random.below(23))));
    const auto many = uint32_t(random.below((1 << 24) / b + 1));
    // A multiple of b, the multiple's neighbours, and a random number.
    for (const uint32_t a : {many * b, many * b + 1, many * b - 1, uint32_t(random.below(1 << 24))})
      if (a < 1u << 24) wrong += shader::quotient(a, b) != a / b;
  }
  CHECK(wrong == 0);
}

TEST_CASE("log_positive is within 2e-7 of ln x, relative or absolute") {
  Random random(2);
  const double most = worst([&](int) {
    const auto x = float(random.log_uniform(1e-37, 1e37));
    const double exact = std::log(double(x));
    return std::fabs(double(shader::log_positive(x)) - exact) / std::max(1.0, std::fabs(exact));
  });
  MESSAGE(fmt::format("log_positive: worst error {:.2e}", most));
  CHECK(most <= 2e-7);
}

TEST_CASE("highlight lobes: (1 - e)^n is within 2e-6 up to n = 10 000") {
  Random random(3);
  const double most = worst([&](int) {
    const auto e = float(random.log_uniform(1e-9, 1));
    const auto n = float(random.log_uniform(1, 10000));
    return std::fabs(double(shader::power_of_complement(e, n)) - std::pow(1 - double(e), double(n)));
  });
  MESSAGE(fmt::format("power_of_complement: worst absolute error {:.2e}", most));
  CHECK(most <= 2e-6);
  CHECK(shader::power_of_complement(0.0f, 10000.0f) == 1.0f);
  CHECK(shader::power_of_complement(1.0f, 1.0f) == 0.0f);
}

TEST_CASE("atan_yx is within 4e-7 of atan2 in every octant") {
  Random random(4);
  const double most = worst([&](int) {
    const auto y = float(random.uniform(-1, 1));
    const auto x = float(random.uniform(-1, 1) * random.log_uniform(1e-6, 1e6));
    return std::fabs(double(shader::atan_yx(y, x)) - std::atan2(double(y), double(x)));
  });
  MESSAGE(fmt::format("atan_yx: worst absolute error {:.2e}", most));
  CHECK(most <= 4e-7);
  CHECK(shader::atan_yx(0.0f, 0.0f) == 0.0f);
  CHECK(shader::atan_yx(0.0f, 1.0f) == 0.0f);
  CHECK(shader::atan_yx(1.0f, 0.0f) == doctest::Approx(1.5707963));
}

TEST_CASE("random numbers lie in [0, 1), are uniform, and differ in every argument") {
  double sum = 0;
  for (uint32_t i = 0; i < 1'000'000; ++i) {
    const float r = shader::random_number(i, 3, 1, 7);
    CHECK(r >= 0.0f);
    CHECK(r < 1.0f);
    sum += double(r);
  }
  CHECK(sum / 1e6 == doctest::Approx(0.5).epsilon(0.002));
  const float here = shader::random_number(10, 20, 30, 40);
  CHECK(here != shader::random_number(11, 20, 30, 40));
  CHECK(here != shader::random_number(10, 21, 30, 40));
  CHECK(here != shader::random_number(10, 20, 31, 40));
  CHECK(here != shader::random_number(10, 20, 30, 41));
}

TEST_CASE("media: an entered medium can be left again, also out of order; a fifth overflows and is flagged") {
  uint32_t flags = 0;
  uint32_t media = 0;
  for (uint32_t medium = 1; medium <= 4; ++medium) media = shader::enter_medium(media, medium, flags);
  CHECK(flags == 0);
  CHECK(shader::innermost_medium(media) == 4);
  CHECK(shader::enter_medium(media, 5, flags) == media);
  CHECK(flags == FLAG_MEDIA_OVERFLOW);
  CHECK(shader::leave_medium(media, 4) == 0x010203u);
  CHECK(shader::leave_medium(media, 3) == 0x010204u);
  CHECK(shader::leave_medium(media, 2) == 0x010304u);
  CHECK(shader::leave_medium(media, 1) == 0x020304u);
  CHECK(shader::leave_medium(media, 9) == media);
  CHECK(shader::leave_medium(0x0101u, 1) == 0x01u);
}
