// `principled` by its published formulas, as numerical integrals that use nothing of eyeray. Walter,
// Marschner, Li, Torrance: Microfacet Models for Refraction through Rough Surfaces, EGSR 2007 (the equations
// cited here). Heitz: Understanding the Masking-Shadowing Function in Microfacet-Based BRDFs, JCGT 2014.
// Kulla, Conty: Revisiting Physically Based Shading at Imageworks, SIGGRAPH 2017. Khronos: glTF 2.0, appendix
// B, and KHR_materials_clearcoat, _sheen, _transmission, _anisotropy, _diffuse_transmission. Kelemen,
// Szirmay-Kalos: A Microfacet Based Coupled Specular-Matte BRDF Model, Eurographics 2001. Turquin: Practical
// Multiple Scattering Compensation for Microfacet Models, 2019.
#pragma once

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>
#include <vector>

#include "looks.hpp"

namespace eyeray::engine::test {

// Directions of the half sphere around z, of which y > 0: midpoints in √z and in the angle.
struct HalfSphere {
  static constexpr int rows = 128, turns = 96;
  static double height(int row) { return (row + 0.5) / rows * (row + 0.5) / rows; }
  static Vec3 direction(int row, int turn) {
    const double z = height(row), level = std::sqrt(1 - z * z), a = std::numbers::pi * (turn + 0.5) / turns;
    return {level * std::cos(a), level * std::sin(a), z};
  }
  // The solid angle of a direction, and of its mirror image with y < 0.
  static double angle(int row) { return 2 * std::numbers::pi / turns * 2 * std::sqrt(height(row)) / rows; }

  template <typename F>
  static double integral(const F& f) {
    double sum = 0;
    for (int row = 0; row < rows; ++row)
      for (int turn = 0; turn < turns; ++turn) sum += f(direction(row, turn)) * angle(row);
    return sum;
  }
};

// The microfacets of one roughness, rougher along x by KHR_materials_anisotropy.
class Facets {
 public:
  explicit Facets(double roughness, double anisotropy = 0)
      : along_(std::lerp(roughness * roughness, 1, anisotropy * anisotropy)),
        across_(roughness * roughness) {}

  // The density of microfacets with normal h: the extension's, which is equation 33 for equal widths.
  double density(const Vec3& h) const {
    const double area = along_ * across_;
    const Vec3 f(across_ * h.x, along_ * h.y, area * h.z);
    const double w = area / glm::dot(f, f);
    return area * w * w / std::numbers::pi;
  }
  // The share that both directions see (Heitz, equation 99, with equation 34 for each direction).
  double seen(const Vec3& o, const Vec3& i) const { return 1 / (1 / seen(o) + 1 / seen(i) - 1); }
  // Equation 20 without its Fresnel term, times the cosine of i.
  double mirrored(const Vec3& o, const Vec3& i) const {
    return density(glm::normalize(o + i)) * seen(o, i) / (4 * o.z);
  }
  // A normal by the density D cos θ: slopes of α √(x / (1 − x)).
  Vec3 normal(double x, double turn) const {
    const double slope = std::sqrt(x / (1 - x));
    return glm::normalize(Vec3(along_ * slope * std::cos(turn), across_ * slope * std::sin(turn), 1));
  }
  // The roughness of even microfacets that lose about as much light.
  double evened() const {
    return std::sqrt(0.75 * std::hypot(along_, across_) / std::numbers::sqrt2 + (along_ + across_) / 8);
  }

 private:
  double seen(const Vec3& w) const {
    const double slope = std::hypot(along_ * w.x, across_ * w.y) / w.z;
    return 2 / (1 + std::sqrt(1 + slope * slope));
  }

  double along_, across_;
};

inline double fifth_power(double cosine) {
  return std::pow(1 - cosine, 5);
}
// Schlick's term, from f0 to 1.
inline double schlick_term(double f0, const Vec3& o, const Vec3& i) {
  return f0 + (1 - f0) * fifth_power(std::min(1.0, glm::dot(o, glm::normalize(o + i))));
}

// The share of light from one direction that microfacets mirror once, for a Fresnel term of 1 and for
// Schlick's fifth power. Integrated over the microfacets' own angles.
struct Once {
  double all = 0, edge = 0;
  double with(double f0) const { return f0 * (all - edge) + edge; }
};
inline Once mirrored_once(const Facets& facets, const Vec3& o, int steps, int turns) {
  Once sum;
  for (int a = 0; a < steps; ++a)
    for (int b = 0; b < turns; ++b) {
      const Vec3 h = facets.normal((a + 0.5) / steps, 2 * std::numbers::pi * (b + 0.5) / turns);
      const double along = glm::dot(o, h), down = 2 * along * h.z - o.z;
      if (along <= 0 || down <= 0) continue;
      const double share = along / (o.z * h.z) * facets.seen(o, 2 * along * h - o) / (steps * turns);
      sum.all += share;
      sum.edge += share * fifth_power(along);
    }
  return sum;
}

// The light that rough mirrors scatter, for the directions of HalfSphere.
struct RoughMirror {
  std::vector<Once> rows;
  Once mean;

  static const RoughMirror& of(double roughness) {
    static std::map<double, RoughMirror> known;
    const auto [at, is_new] = known.try_emplace(roughness);
    RoughMirror& it = at->second;
    if (!is_new) return it;
    for (int row = 0; row < HalfSphere::rows; ++row) {
      const double z = HalfSphere::height(row);
      it.rows.push_back(mirrored_once(Facets(roughness), direction_of(z), 128, 128));
      const double weight = 4 * z * std::sqrt(z) / HalfSphere::rows;
      it.mean.all += it.rows.back().all * weight;
      it.mean.edge += it.rows.back().edge * weight;
    }
    return it;
  }

  // Kulla and Conty: the share of the light not mirrored once that leaves after several microfacets.
  double often(double f0) const {
    const double fresnel = f0 + (1 - f0) / 21;
    return fresnel * fresnel * mean.all / (1 - fresnel * (1 - mean.all));
  }
  // All light that the surface mirrors.
  double albedo(double f0, const Once& once) const { return once.with(f0) + often(f0) * (1 - once.all); }
};

// KHR_materials_sheen, times the cosine of i.
inline double sheen_term(double roughness, const Vec3& o, const Vec3& i) {
  const double alpha = roughness * roughness, sine = std::sin(std::acos(glm::normalize(o + i).z));
  const double fibres = (2 + 1 / alpha) * std::pow(sine, 1 / alpha) / (2 * std::numbers::pi);
  return fibres / (4 * (o.z + i.z - o.z * i.z)) * i.z;
}
inline double sheen_albedo(double roughness, double cosine) {
  const Vec3 o = direction_of(cosine);
  return HalfSphere::integral([&](const Vec3& i) { return sheen_term(roughness, o, i); });
}

// Equation 22.
inline double dielectric_term(double c, double from, double to) {
  const double g_squared = to * to / (from * from) - 1 + c * c;
  if (g_squared <= 0) return 1;
  const double g = std::sqrt(g_squared), a = (g - c) / (g + c), b = (c * (g + c) - 1) / (c * (g - c) + 1);
  return a * a * (1 + b * b) / 2;
}

// Equations 20 and 21 for radiance / index², times the cosine of i. The viewer o is in the medium `from`.
inline double glass_term(double roughness, double from, double to, const Vec3& o, const Vec3& i) {
  const Facets facets(roughness);
  if (i.z > 0)
    return dielectric_term(std::min(1.0, glm::dot(o, glm::normalize(o + i))), from, to) *
           facets.mirrored(o, i);
  Vec3 h = glm::normalize(from * o + to * i);
  if (h.z < 0) h = -h;
  const double along_o = glm::dot(o, h), along_i = glm::dot(i, h);
  if (along_o <= 0 || along_i >= 0) return 0;
  const double sum = from * along_o + to * along_i;
  return along_o * -along_i / o.z * to * to * (1 - dielectric_term(along_o, from, to)) *
         facets.seen(o, {i.x, i.y, -i.z}) * facets.density(h) / (sum * sum);
}

// `principled` seen from one direction.
class PrincipledFormulas {
 public:
  PrincipledFormulas(const Look& look, double cosine, bool leaving)
      : look_(look),
        o_(direction_of(cosine)),
        from_(leaving ? look.ior : 1),
        to_(leaving ? 1 : look.ior),
        facets_(look.roughness, look.anisotropy),
        mirror_(RoughMirror::of(facets_.evened())),
        once_(mirrored_once(facets_, o_, 128, 128)) {
    if (look.sheen > 0) {
      sheen_o_ = sheen_albedo(look.sheen_roughness, cosine);
      for (int row = 0; row < HalfSphere::rows; ++row)
        sheen_rows_.push_back(sheen_albedo(look.sheen_roughness, HalfSphere::height(row)));
      double sum = 0;
      for (int row = 0; row < HalfSphere::rows; ++row)
        for (int turn = 0; turn < HalfSphere::turns; ++turn)
          sum += sheen(HalfSphere::direction(row, turn), row) * HalfSphere::angle(row);
      under_ *= 1 - sum;
    }
    coat_left_ = 1 - look.coat * mirrored_once(Facets(look.coat_roughness), o_, 128, 128).with(0.04);
    if (look.transmission > 0 && !look.thin)
      glass_once_ = HalfSphere::integral([&](const Vec3& i) {
        return glass_term(look_.roughness, from_, to_, o_, i) +
               glass_term(look_.roughness, from_, to_, o_, {i.x, i.y, -i.z});
      });
  }

  // The BSDF times the cosine of i, which is a direction of that row, before or behind the surface.
  double at(const Vec3& i, int row) const {
    if (i.z < 0) return coat_left_ * under_ * behind(i, row);
    const double coat = look_.coat * schlick_term(0.04, o_, i) * Facets(look_.coat_roughness).mirrored(o_, i);
    return coat + coat_left_ * ((look_.sheen > 0 ? sheen(i, row) : 0) + under_ * before(i, row));
  }

 private:
  double through() const { return look_.transmission * (1 - look_.metallic); }
  double body() const { return 1 - look_.metallic - through(); }
  // The dielectric share that mirrors by Schlick's term: a pane counts, glass does not.
  double layer() const { return look_.thin ? 1 - look_.metallic : body(); }
  double layer_f0() const { return std::pow((look_.ior - 1) / (look_.ior + 1), 2); }
  // Light that left one microfacet and hit others, per share that leaves in the end.
  double even(const Vec3& i, int row) const {
    return (1 - once_.all) * (1 - towards(i, row).all) / (1 - mirror_.mean.all) * std::abs(i.z) /
           std::numbers::pi;
  }
  // The light that microfacets mirror once into direction i, or its mirror image behind the surface.
  const Once& towards(const Vec3& i, int row) const {
    if (look_.anisotropy == 0) return mirror_.rows[size_t(row)];
    const Vec3 up(i.x, i.y, std::abs(i.z));
    if (up != towards_) once_towards_ = mirrored_once(facets_, towards_ = up, 24, 32);
    return once_towards_;
  }
  // An albedo above 1 is divided out, for the larger one of both directions.
  double sheen(const Vec3& i, int row) const {
    return look_.sheen * sheen_term(look_.sheen_roughness, o_, i) /
           std::max({1.0, sheen_o_, sheen_rows_[size_t(row)]});
  }
  double before(const Vec3& i, int row) const {
    const double f0 = layer_f0();
    const auto mirrors = [&](double at_zero) {
      return schlick_term(at_zero, o_, i) * facets_.mirrored(o_, i) + mirror_.often(at_zero) * even(i, row);
    };
    const double glass =
        look_.thin || through() == 0 ? 0 : glass_term(look_.roughness, from_, to_, o_, i) / glass_once_;
    // KHR_materials_diffuse_transmission, and the light that would come through but is reflected totally.
    const double scattered =
        look_.color * (1 - look_.diffuse_transmission) + look_.diffuse_transmission * (1 - crossing());
    return layer() * mirrors(f0) + look_.metallic * mirrors(look_.color) +
           body() * scattered * let_in(i, row) * i.z / std::numbers::pi + through() * glass;
  }
  // The coupling of a layer with a body under it, for light that leaves in a direction of that row.
  double let_in(const Vec3& i, int row) const {
    const double f0 = layer_f0();
    return (1 - mirror_.albedo(f0, once_)) * (1 - mirror_.albedo(f0, towards(i, row))) /
           (1 - mirror_.albedo(f0, mirror_.mean));
  }
  // The share of evenly transmitted light that leaves on the other side.
  double crossing() const {
    const bool refracts = look_.transmission > 0 && !look_.thin;
    return refracts ? std::min(1.0, to_ * to_ / (from_ * from_)) : 1;
  }
  double behind(const Vec3& i, int row) const { return evenly_behind(i, row) + straight_behind(i, row); }
  double evenly_behind(const Vec3& i, int row) const {
    return body() * look_.diffuse_transmission * crossing() * let_in(i, row) * -i.z / std::numbers::pi;
  }
  double straight_behind(const Vec3& i, int row) const {
    if (through() == 0) return 0;
    if (!look_.thin)
      return through() * look_.color * glass_term(look_.roughness, from_, to_, o_, i) / glass_once_;
    const Vec3 up(i.x, i.y, -i.z);
    return through() * look_.color *
           ((1 - schlick_term(layer_f0(), o_, up)) * facets_.mirrored(o_, up) +
            (1 - mirror_.often(layer_f0())) * even(i, row));
  }

  Look look_;
  Vec3 o_;
  double from_, to_;
  Facets facets_;
  const RoughMirror& mirror_;
  Once once_;
  mutable Vec3 towards_{0};  // the last direction of towards(), and its result
  mutable Once once_towards_;
  double sheen_o_ = 0;
  std::vector<double> sheen_rows_;
  double under_ = 1, coat_left_ = 1, glass_once_ = 1;
};

}  // namespace eyeray::engine::test
