// Compares the tables of albedos with the integrals that they stand for, and tests the reflectance of metals.
#include <algorithm>
#include <cmath>
#include <utility>

#include "bsdf_examples.hpp"
#include "host/optics/fresnel.hpp"
#include "host/optics/ggx_albedo.hpp"
#include "host/optics/glass_albedo.hpp"
#include "host/optics/metals.hpp"
#include "host/tables/albedos.hpp"
#include "host/twin/shader_functions.hpp"
#include "host/twin/twin.hpp"
//
#include "tests/support/doctest.hpp"

using namespace eyeray::engine;

TEST_CASE("GGX's directional albedo is 1 − ln 2 at roughness 1, and its table agrees with the integral") {
  CHECK(tables::ggx_albedo(1, 1).once == doctest::Approx(1 - std::log(2.0)).epsilon(1e-4));
  double worst = 0, sum = 0;
  int count = 0;
  for (double cosine = 0.02; cosine < 1; cosine += 0.0171)
    for (double roughness = 0.06; roughness < 1; roughness += 0.0237) {
      const double error = std::abs(tables::ggx_albedo(cosine, roughness).once -
                                    optics::ggx_albedo_integral(cosine, roughness).once);
      worst = std::max(worst, error);
      sum += error;
      ++count;
    }
  MESSAGE("off by up to " << worst << ", in the mean by " << sum / count);
  CHECK(worst < 4e-3);
  CHECK(sum / count < 2e-4);
}

TEST_CASE("a smooth mirror's tiny loss to other microfacets is accurate in float32") {
  const records::PackedScene scene = test::scene_with_albedos();
  const shader::Binding binding(twin::view_of(scene));
  double worst = 0;
  for (const double roughness : {0.05, 0.1, 0.5, 1.0})
    for (double cosine = 0.01; cosine < 1; cosine += 0.017) {
      const optics::GgxAlbedo theirs = tables::ggx_albedo(cosine, roughness);
      const shader::vec4 ours = shader::ggx_albedo(float(cosine), float(roughness));
      worst = std::max({worst, std::abs(double(ours.x) / (1 - theirs.once) - 1),
                        std::abs(double(ours.z) / (1 - theirs.mean_once) - 1)});
    }
  MESSAGE("off by up to " << worst << " of itself");
  CHECK(worst < 2e-5);
}

TEST_CASE("the table of rough glass's directional albedo agrees with the integral") {
  double worst = 0;
  for (const auto& [from, to] :
       {std::pair(1.0, 1.5), {1.5, 1.0}, {1.0, 1.33}, {1.33, 1.0}, {2.4, 1.0}, {1.0, 1.1}, {1.1, 1.0}})
    for (double cosine = 0.05; cosine < 1; cosine += 0.113)
      for (double roughness = 0.06; roughness < 1; roughness += 0.17)
        worst = std::max(worst, std::abs(tables::glass_albedo(cosine, roughness, from, to) -
                                         optics::glass_albedo_integral(cosine, roughness, from, to, 4)));
  MESSAGE("off by up to " << worst);
  CHECK(worst < 4e-3);
}

TEST_CASE("metals have their tabulated reflectance, and its mean is the integral") {
  // At normal incidence, the reflectance is ((n − 1)² + k²) / ((n + 1)² + k²).
  for (const optics::Metal& metal : optics::metals) {
    const optics::Fresnel fresnel = optics::conductor(metal.n, metal.k);
    for (int c = 0; c < 3; ++c) {
      const double n = metal.n[c], k = metal.k[c];
      CHECK(fresnel.at(1)[c] ==
            doctest::Approx(((n - 1) * (n - 1) + k * k) / ((n + 1) * (n + 1) + k * k)).epsilon(1e-12));
      CHECK(double(shader::conductor_reflectance(float(n), float(k), 0.3f)) ==
            doctest::Approx(fresnel.at(0.3)[c]).epsilon(1e-5));
    }
  }
}
