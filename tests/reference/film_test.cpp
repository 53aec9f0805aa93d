// The colour of a thin film, against the sum over the visible spectrum of Airy's formula for a layer between
// two media (Born, Wolf: Principles of Optics, 7.6). The eye's response is that of Wyman, Sloan, Shirley:
// Simple Analytic Approximations to the CIE XYZ Color Matching Functions, JCGT 2013: none of this is in an
// executor.
#include <algorithm>
#include <cmath>
#include <complex>

#include "host/optics/film.hpp"
#include "host/reference/bsdf.hpp"
#include "looks.hpp"
#include "tests/support/random.hpp"

#include "tests/support/doctest.hpp"

using namespace eyeray::engine;
using namespace eyeray::engine::test;
using reference::BsdfValue;
using reference::ViewedBsdf;

namespace {

Vec3 response(double wavelength) {
  const auto lobe = [&](double height, double middle, double below, double above) {
    const double off = (wavelength - middle) / (wavelength < middle ? below : above);
    return height * std::exp(-off * off / 2);
  };
  return {lobe(1.056, 599.8, 37.9, 31.0) + lobe(0.362, 442.0, 16.0, 26.7) + lobe(-0.065, 501.1, 20.4, 26.2),
          lobe(0.821, 568.8, 46.9, 40.5) + lobe(0.286, 530.9, 16.3, 31.1),
          lobe(1.217, 437.0, 11.8, 36.0) + lobe(0.681, 459.0, 26.0, 13.8)};
}

// The amplitude that a boundary reflects, by Schlick's approximation of its reflectance. It changes sign at
// the medium of greater index.
double amplitude(double from, double to, double cosine) {
  const double f0 = std::pow((from - to) / (from + to), 2);
  return (from < to ? -1 : 1) * std::sqrt(f0 + (1 - f0) * std::pow(1 - cosine, 5));
}

// Linear sRGB of a film's reflectance. All light together is white, as the paper has it.
Vec3 by_spectrum(double thickness, double ior, double f0, double cosine) {
  const double root = std::sqrt(f0), below = (1 + root) / (1 - root);
  const double inside = std::sqrt(1 - (1 - cosine * cosine) / (ior * ior));
  const double upper = amplitude(1, ior, cosine), lower = amplitude(ior, below, inside);
  const double through = 1 - upper * upper;
  const double mean = upper * upper + through * through * lower * lower / (1 - upper * upper * lower * lower);
  Vec3 xyz(0);
  double luminance = 0;
  for (double wavelength = 360; wavelength <= 830; wavelength += 0.5) {
    const std::complex<double> later =
        lower * std::polar(1.0, 4 * M_PI * ior * thickness * inside / wavelength);
    xyz += (std::norm((upper + later) / (1.0 + upper * later)) - mean) * response(wavelength);
    luminance += response(wavelength).y;
  }
  xyz /= luminance;
  return mean + Vec3(3.2404542 * xyz.x - 1.5371385 * xyz.y - 0.4985314 * xyz.z,
                     -0.9692660 * xyz.x + 1.8760108 * xyz.y + 0.0415560 * xyz.z,
                     0.0556434 * xyz.x - 0.2040259 * xyz.y + 1.0572252 * xyz.z);
}

}  // namespace

TEST_CASE("a thin film has the colours of interference that a sum over the spectrum gives") {
  double worst = 0;
  for (const double ior : {1.33, 1.8})
    for (const double f0 : {0.04, 0.6, 0.95})
      for (const double thickness : {100.0, 200.0, 300.0, 450.0, 700.0})
        for (const double cosine : {1.0, 0.7, 0.4}) {
          CAPTURE(ior);
          CAPTURE(f0);
          CAPTURE(thickness);
          CAPTURE(cosine);
          const Vec3 found = optics::Film{1, thickness, ior}.reflectance(cosine, Vec3(f0));
          const Vec3 expected = glm::clamp(by_spectrum(thickness, ior, f0, cosine), Vec3(0), Vec3(1));
          for (int c = 0; c < 3; ++c) {
            CAPTURE(c);
            CHECK(std::abs(found[c] - expected[c]) < 0.04);
            worst = std::max(worst, std::abs(found[c] - expected[c]));
          }
        }
  MESSAGE("off by up to " << worst);
}

TEST_CASE("a film that covers a share of a surface mirrors the blend of both") {
  const optics::Fresnel bare = optics::schlick({0.04, 0.5, 0.9}, Vec3(1));
  for (const double cosine : {1.0, 0.5, 0.1}) {
    const optics::Film film{0.3, 400, 1.5};
    const Vec3 expected = 0.7 * bare.at(cosine) + 0.3 * film.reflectance(cosine, bare.f0);
    CHECK(glm::length(film.over(bare, cosine) - expected) < 1e-12);
    CHECK(optics::Film{0, 400, 1.5}.over(bare, cosine) == bare.at(cosine));
  }
}

TEST_CASE("a smooth surface under a film mirrors the film's colour, and a white body under it stays white") {
  for (const double thickness : {150.0, 400.0})
    for (const double roughness : {0.0, 0.2, 0.6})
      for (const double cosine : {0.95, 0.5, 0.2}) {
        CAPTURE(thickness);
        CAPTURE(roughness);
        CAPTURE(cosine);
        Bsdf bsdf = bsdf_of({.roughness = roughness, .iridescence = 1}, cosine);
        bsdf.film.thickness = thickness;
        const Vec3 o = direction_of(cosine);
        const ViewedBsdf viewed(bsdf, o);
        Random random(4);
        constexpr int strata = 24;
        Vec3 all(0);
        for (int l = 0; l < strata; ++l)
          for (int x = 0; x < strata; ++x)
            for (int y = 0; y < strata; ++y) {
              const Vec2 u((x + random.uniform()) / strata, (y + random.uniform()) / strata);
              const Vec3 i = viewed.sample((l + random.uniform()) / strata, u).i;
              const BsdfValue value = viewed.at(i, i.z > 0);
              if (value.density > 0) all += value.value / value.density / double(strata * strata * strata);
            }
        // Rough surfaces seen edge-on mirror at many angles, which one of Schlick's curves cannot stand for.
        const double off = roughness > 0.5 && cosine < 0.3 ? 0.1 : 0.03;
        for (int c = 0; c < 3; ++c) CHECK(std::abs(all[c] - 1) < off);
        if (roughness > 0) continue;
        // The mirrored direction shows the film's reflectance where a bare surface shows its own.
        const Vec3 mirrored(-o.x, -o.y, o.z);
        Bsdf bare = bsdf;
        bare.film = {};
        bsdf.diffuse = bare.diffuse = Vec3(0);
        const Vec3 ratio =
            ViewedBsdf(bsdf, o).at(mirrored, true).value / ViewedBsdf(bare, o).at(mirrored, true).value;
        const Vec3 expected = by_spectrum(thickness, 1.3, 0.04, cosine) / bare.layer.at(cosine);
        for (int c = 0; c < 3; ++c) CHECK(ratio[c] == doctest::Approx(expected[c]).epsilon(0.1));
      }
}
