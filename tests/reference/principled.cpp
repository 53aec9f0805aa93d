// The share of white light that `principled` scatters. A white surface of any share of metal, glass, coat and
// sheen scatters all of it: 1, whatever the executors compute.
#include <cmath>

#include "host/reference/bsdf.hpp"
#include "looks.hpp"
#include "tests/support/random.hpp"

#include "tests/support/doctest.hpp"

using namespace eyeray::engine;
using namespace eyeray::engine::test;
using reference::BsdfSample;
using reference::BsdfValue;
using reference::ViewedBsdf;

namespace {

// The share of uniform light from everywhere that the BSDF scatters to the viewer.
double albedo(const Bsdf& bsdf, double cosine) {
  const Vec3 o = direction_of(cosine);
  const ViewedBsdf viewed(bsdf, o);
  constexpr int strata = 16, lobes = 16;
  Random random(5);
  double sum = 0;
  for (int l = 0; l < lobes; ++l)
    for (int x = 0; x < strata; ++x)
      for (int y = 0; y < strata; ++y) {
        const double u = (x + random.uniform()) / strata;
        const double v = (y + random.uniform()) / strata;
        const BsdfSample sample = viewed.sample((l + random.uniform()) / lobes, {u, v});
        if (sample.kind == BsdfSample::Kind::lobe) {
          const BsdfValue value = viewed.at(sample.i, sample.i.z > 0);
          if (value.density > 0) sum += value.value.x / value.density;
        } else {
          const bool passed = sample.kind == BsdfSample::Kind::passed;
          sum += sample.weight.x * (passed ? 1 : viewed.through_layers(Vec3(-o.x, -o.y, o.z)));
        }
      }
  return sum / (lobes * strata * strata);
}

}  // namespace

TEST_CASE("a white principled surface scatters all light: metal, glass, coat and sheen in any shares") {
  for (const double metallic : {0.0, 0.25, 0.5, 0.75, 1.0})
    for (const double transmission : {0.0, 0.5, 1.0})
      for (const double roughness : {0.0, 0.3, 0.5, 0.8, 1.0})
        for (const auto& [coat, sheen] : {std::pair(0.0, 0.0), {1.0, 0.0}, {0.0, 1.0}, {0.5, 0.5}})
          for (const bool thin : {false, true})
            for (const bool leaving : {false, true}) {
              if ((leaving || thin) && (transmission == 0 || (leaving && thin))) continue;
              const Look look{metallic, transmission, roughness, coat, sheen, 1, 1, thin};
              for (const double cosine : {1.0, 0.6, 0.2}) {
                const double found = albedo(bsdf_of(look, cosine, leaving), cosine);
                if (std::abs(found - 1) < 0.01) continue;
                FAIL_CHECK("metallic " << metallic << ", transmission " << transmission << ", roughness "
                                       << roughness << ", coat " << coat << ", sheen " << sheen << ", thin "
                                       << thin << ", leaving " << leaving << ", cosine " << cosine << ": "
                                       << found);
              }
            }
}

TEST_CASE("a blend of paint and metal scatters the blend of their light, to every side") {
  for (const double roughness : {0.2, 0.6, 1.0})
    for (const double color : {0.2, 0.9}) {
      const Vec3 o = direction_of(0.7);
      const Bsdf paint = bsdf_of({.roughness = roughness, .color = color}, 0.7);
      const Bsdf metal = bsdf_of({.metallic = 1, .roughness = roughness, .color = color}, 0.7);
      const Bsdf blend = bsdf_of({.metallic = 0.3, .roughness = roughness, .color = color}, 0.7);
      Random random(9);
      for (int n = 0; n < 200; ++n) {
        Vec3 i = random.direction();
        i.z = std::abs(i.z);
        const auto sent = [&](const Bsdf& bsdf) { return ViewedBsdf(bsdf, o).at(i, true).value.x; };
        CHECK(sent(blend) == doctest::Approx(0.7 * sent(paint) + 0.3 * sent(metal)).epsilon(1e-9));
      }
    }
}

TEST_CASE(
    "light that a white body lets through evenly is not lost: paper, and glass in balance on both sides") {
  for (const double through : {0.3, 1.0})
    for (const double transmission : {0.0, 0.5})
      for (const double roughness : {0.3, 0.8})
        for (const bool leaving : {false, true}) {
          if (leaving && transmission == 0) continue;
          for (const double cosine : {1.0, 0.3}) {
            CAPTURE(through);
            CAPTURE(transmission);
            CAPTURE(leaving);
            const Bsdf bsdf = bsdf_of(
                {.transmission = transmission, .roughness = roughness, .diffuse_transmission = through},
                cosine, leaving);
            CHECK(albedo(bsdf, cosine) == doctest::Approx(1).epsilon(0.01));
          }
        }
}

TEST_CASE("a white brushed metal scatters about as much light as it gets") {
  double least = 1, most = 1;
  for (const double strength : {0.3, 0.6, 1.0})
    for (const double roughness : {0.1, 0.3, 0.6, 1.0})
      for (const double turn : {0.0, 0.8, 1.57})
        for (const double cosine : {1.0, 0.6, 0.2}) {
          Bsdf bsdf = bsdf_of({.metallic = 1, .roughness = roughness, .anisotropy = strength}, cosine);
          if (turn > 1) std::swap(bsdf.widths.x, bsdf.widths.y);
          const double found = albedo(bsdf, cosine);
          least = std::min(least, found);
          most = std::max(most, found);
          if (turn == 0.8) continue;
          CAPTURE(strength);
          CAPTURE(roughness);
          CAPTURE(turn);
          CAPTURE(cosine);
          CHECK(found < 1.03);
          CHECK(found > 0.96);
        }
  MESSAGE("from " << least << " to " << most);
}
