// The share of white light that `principled` scatters. A white surface of any share of metal, glass, coat and
// sheen scatters all of it: 1, whatever the executors compute. The share that one microfacet mirrors is
// integrated here.
#include <cmath>
#include <numbers>

#include "host/loader/scene_file.hpp"
#include "host/reference/bsdf.hpp"
#include "tests/support/random.hpp"

#include "tests/support/doctest.hpp"

using namespace eyeray::engine;
using eyeray::engine::test::Random;
using reference::BsdfSample;
using reference::BsdfValue;
using reference::ViewedBsdf;

namespace {

struct Look {
  double metallic = 0, transmission = 0, roughness = 0.5, coat = 0, sheen = 0, color = 1, specular = 1;
  bool thin = false;
};

// The BSDF for a ray that leaves the shape, or for one that enters.
Bsdf bsdf_of(const Look& look, double cosine, bool leaving = false) {
  const Scene scene =
      loader::parse_scene(fmt::format(R"(
[camera]
eye = [0, 0, 5]
target = [0, 0, 0]
[[light]]
type = "point"
position = [0, 5, 5]
[render]
integrator = "path"
[[material]]
name = "m"
type = "principled"
color = {}
metallic = {}
roughness = {}
specular = {}
transmission = {}
coat = {}
coat_roughness = 0.3
sheen_color = {}
thin = {}
[[sphere]]
material = "m"
center = [0, 0, 0]
radius = 1
)",
                                      look.color, look.metallic, look.roughness, look.specular,
                                      look.transmission, look.coat, look.sheen, look.thin),
                          "scene.toml");
  const Material& material = *scene.materials.back();
  const ScatteringContext context{.point = {},
                                  .cos_view = cosine,
                                  .ior_from = leaving ? 1.5 : 1,
                                  .ior_to = leaving || look.thin || look.transmission == 0 ? 1 : 1.5};
  return material.bsdf(context, material.scattering(context));
}

Vec3 direction_of(double cosine) {
  return {std::sqrt(1 - cosine * cosine), 0, cosine};
}

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

// Smith's height-correlated GGX with Schlick's Fresnel term, integrated over the half sphere by midpoints in
// the microfacets' own angles: Walter et al. (EGSR 2007), Heitz (JCGT 2014).
double mirrored_once(double f0, double roughness, double cosine) {
  const double width = roughness * roughness;
  const auto lambda = [&](double c) {
    const double tangent = std::sqrt(1 - c * c) / c;
    return (std::sqrt(1 + width * width * tangent * tangent) - 1) / 2;
  };
  const Vec3 o = direction_of(cosine);
  constexpr int steps = 400;
  double sum = 0;
  for (int a = 0; a < steps; ++a)
    for (int b = 0; b < steps; ++b) {
      // tan² θ = α² x / (1 − x) has the density D cos θ.
      const double x = (a + 0.5) / steps, tangent = width * std::sqrt(x / (1 - x));
      const double z = 1 / std::sqrt(1 + tangent * tangent), turn = 2 * std::numbers::pi * (b + 0.5) / steps;
      const Vec3 h(z * tangent * std::cos(turn), z * tangent * std::sin(turn), z);
      const double along = glm::dot(o, h);
      const Vec3 i = 2 * along * h - o;
      if (along <= 0 || i.z <= 0) continue;
      const double fresnel = f0 + (1 - f0) * std::pow(1 - along, 5);
      sum += fresnel * along / (cosine * h.z) / (1 + lambda(cosine) + lambda(i.z));
    }
  return sum / (steps * steps);
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

TEST_CASE("rough metal's single scattering agrees with a separate integral; the rest is uniform") {
  for (const double roughness : {0.4, 0.7, 1.0})
    for (const double cosine : {0.9, 0.4})
      for (const double color : {1.0, 0.5}) {
        CAPTURE(roughness);
        CAPTURE(cosine);
        const double f0 = color, lost = 1 - mirrored_once(1, roughness, cosine);
        const double found =
            albedo(bsdf_of({.metallic = 1, .roughness = roughness, .color = color}, cosine), cosine);
        const double once = mirrored_once(f0, roughness, cosine);
        // Kulla and Conty (2017): the share of the rest that comes out again after more than one microfacet.
        double mean_once = 0;
        constexpr int steps = 32;
        for (int k = 0; k < steps; ++k) {
          const double c = std::sqrt((k + 0.5) / steps);
          mean_once += mirrored_once(1, roughness, c) / steps;
        }
        const double mean = f0 + (1 - f0) / 21;
        const double often = mean * mean * mean_once / (1 - mean * (1 - mean_once));
        CHECK(found == doctest::Approx(once + often * lost).epsilon(0.01));
      }
}
