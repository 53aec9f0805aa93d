// Portsmouth, Kutz, Hill: EON: A Practical Energy-Preserving Rough Diffuse BRDF, JCGT 2025. Kelemen,
// Szirmay-Kalos: A Microfacet Based Coupled Specular-Matte BRDF Model, Eurographics 2001. Walter, Marschner,
// Li, Torrance: Microfacet Models for Refraction through Rough Surfaces, EGSR 2007. Kulla, Conty: Revisiting
// Physically Based Shading at Imageworks, SIGGRAPH 2017. Estevez, Kulla: Production Friendly Microfacet Sheen
// BRDF, SIGGRAPH 2017. Turquin: Practical Multiple Scattering Compensation for Microfacet Models, 2019.
// facets.hpp has the sources of microfacets.
#include "host/reference/bsdf.hpp"

#include <algorithm>
#include <cmath>

#include "host/reference/emitter_sample.hpp"
#include "host/tables/albedos.hpp"

namespace eyeray::engine::reference {

namespace {

using optics::Fresnel;
using optics::GgxAlbedo;

double largest(const Vec3& v) {
  return std::max({v.x, v.y, v.z});
}

const Fresnel& coat_fresnel() {
  static const Fresnel fresnel = optics::schlick(Vec3(0.04), Vec3(1));
  return fresnel;
}

// The reflectance by more than one microfacet, as a factor of the share of light that one microfacet leaves
// over.
Vec3 often(const Fresnel& fresnel, const GgxAlbedo& albedo) {
  return fresnel.mean * fresnel.mean * albedo.mean_once / (1.0 - fresnel.mean * (1 - albedo.mean_once));
}

Vec3 once(const Fresnel& fresnel, double once, double edge) {
  return fresnel.f0 * (once - edge) + fresnel.f90 * edge;
}

// The share of light that one microfacet mirrors.
Vec3 once(const Fresnel& fresnel, const GgxAlbedo& albedo) {
  return fresnel.conductor ? fresnel.mean * albedo.once : once(fresnel, albedo.once, albedo.edge);
}

// The albedo of a layer, single and multiple reflection together: for one direction, and on average. The
// colour of a film may exceed 1 in a channel, which then lets no light through.
Vec3 layer_albedo(const Fresnel& fresnel, const GgxAlbedo& albedo) {
  return glm::min(once(fresnel, albedo.once, albedo.edge) + often(fresnel, albedo) * (1 - albedo.once), 1.0);
}
Vec3 mean_layer_albedo(const Fresnel& fresnel, const GgxAlbedo& albedo) {
  return once(fresnel, albedo.mean_once, albedo.mean_edge) + often(fresnel, albedo) * (1 - albedo.mean_once);
}

// The share of light that a coat leaves when light crosses it once.
double through_coat(double coat, double roughness, double cosine) {
  if (coat == 0) return 1;
  const GgxAlbedo albedo = tables::ggx_albedo(cosine, roughness);
  return 1 - coat * once(coat_fresnel(), albedo.once, albedo.edge).x;
}

// The share of light that sheen leaves when light crosses it once.
double through_sheen(const Vec3& sheen, double roughness, double cosine) {
  return sheen == Vec3(0) ? 1 : 1 - largest(sheen) * tables::sheen_albedo(cosine, roughness).albedo;
}

// Most light that a smooth surface reflects between its microfacets leaves edge-on, where directions chosen
// by cosine are rare. This share of its directions is uniform on the half sphere instead.
double uniform_share(double roughness) {
  return std::max(0.0, 1 - 3 * roughness);
}
constexpr double uniform_density = 1 / (2 * M_PI);
double between_facets_density(double roughness, double cosine) {
  return cosine > 0 ? std::lerp(cosine / M_PI, uniform_density, uniform_share(roughness)) : 0;
}

// The share of a rough pane's directions that are mirrored to the other side: about that of their light in
// all light that goes through.
double thin_mirrored(const Fresnel& layer, const GgxAlbedo& albedo) {
  const double all = largest(1.0 - layer_albedo(layer, albedo));
  const double scattered = largest(1.0 - often(layer, albedo)) * (1 - albedo.once);
  return all > 0 ? 1 - std::min(scattered / all, 1.0) : 0;
}

// Malley's method: a uniform point on the disk, projected up to the half sphere.
Vec3 cosine_direction(const Vec2& u) {
  const double radius = std::max(std::abs(2 * u.x - 1), std::abs(2 * u.y - 1));
  return {on_disk(u), std::sqrt(1 - radius * radius)};
}
// Archimedes' map: equal areas of the disk become equal areas of the half sphere.
Vec3 uniform_direction(const Vec2& u) {
  const double radius = std::max(std::abs(2 * u.x - 1), std::abs(2 * u.y - 1));
  return {std::sqrt(2 - radius * radius) * on_disk(u), 1 - radius * radius};
}

// The EON model of rough diffuse reflection, without the light's cosine.
Vec3 rough_diffuse(const Vec3& color, double r, const Vec3& o, const Vec3& i) {
  const double a = 1 / (1 + r * (0.5 - 2 / (3 * M_PI)));
  const auto albedo = [&](double cosine) {
    const double theta = std::acos(std::min(cosine, 1.0)), sine = std::sin(theta);
    const double g = sine * (theta - sine * cosine) +
                     2.0 / 3 * (cosine > 0 ? std::tan(theta) * (1 - sine * sine * sine) - sine : -sine);
    return a * (1 + r * g / M_PI);
  };
  const double s = glm::dot(i, o) - i.z * o.z;
  const double single = a * (1 + r * (s > 0 ? s / std::max(i.z, o.z) : s));
  const double mean = a * (1 + r * (2.0 / 3 - 28 / (15 * M_PI)));
  if (mean == 1) return color / M_PI;  // the roughness is too small to count
  const Vec3 several = color * color * mean / (1.0 - color * (1 - mean));
  return (color * single + several * (1 - albedo(i.z)) * (1 - albedo(o.z)) / (1 - mean)) / M_PI;
}

}  // namespace

ViewedBsdf::ViewedBsdf(const Bsdf& bsdf, const Vec3& o, bool adjoint)
    : bsdf_(bsdf),
      o_(o),
      layer_(bsdf.film.share > 0 ? bsdf.film.seen(bsdf.layer, o.z) : bsdf.layer),
      metal_(bsdf.film.share > 0 ? bsdf.film.seen(bsdf.metal, o.z) : bsdf.metal),
      facets_(bsdf.roughness, bsdf.widths),
      once_o_(facets_.uneven() ? facets_.once(o) : Facets::Once{}),
      coat_(LocalFrame::turned_to(bsdf.coat_normal)),
      coat_o_(coat_.seen(o)),
      adjoint_(adjoint) {
  const bool any_glossy = bsdf.metallic > 0 || bsdf.layer.f90 != Vec3(0);
  const GgxAlbedo albedo = any_glossy ? albedo_of(o) : GgxAlbedo{};
  const Layers crossed = layers(o_);
  // A photon's viewer is not known yet.
  const double coated = adjoint_ ? 1 : crossed.coat, under = coated * (adjoint_ ? 1 : crossed.sheen);
  const Vec3 let_in = 1.0 - layer_albedo(layer_, albedo);
  passed_ =
      bsdf.passed * (crossed.coat * crossed.sheen * let_in) + bsdf.crossed * (crossed.coat * crossed.sheen);
  Vec3 albedos[lobes];
  albedos[diffuse] = under * bsdf.diffuse * let_in;
  albedos[glossy] =
      under * (bsdf.layered * once(layer_, albedo.once, albedo.edge) + bsdf.metallic * once(metal_, albedo));
  albedos[multiple] = under * (bsdf.layered * often(layer_, albedo) + bsdf.metallic * often(metal_, albedo)) *
                      (1 - albedo.once);
  albedos[coat] = Vec3(1 - crossed.coat);
  albedos[glass] = under * bsdf.glass;
  albedos[sheen] = Vec3(0);
  if (bsdf.sheen != Vec3(0))
    albedos[sheen] = coated * bsdf.sheen * tables::sheen_albedo(o.z, bsdf.sheen_roughness).albedo;
  albedos[thin] = under * bsdf.thin * let_in;
  albedos[translucent] = under * bsdf.translucent * let_in;
  albedos[mirror] = bsdf.mirror * under;
  albedos[transmitted] = bsdf.transmitted * under;
  albedos[straight] = passed();
  for (int lobe = 0; lobe < lobes; ++lobe) {
    shares_[lobe] = largest(albedos[lobe]);
    albedo_ += albedos[lobe];
  }
  for (const double share : shares_) sum_ += share;
  if (sum_ > 0)
    for (double& share : shares_) share /= sum_;
}

ViewedBsdf ViewedBsdf::part(bool wide) const {
  constexpr double least_wide = 0.32;
  ViewedBsdf part = *this;
  for (int lobe = 0; lobe < lobes; ++lobe) {
    bool is_wide = false;
    switch (lobe) {
      case diffuse:
      case sheen:
      case translucent:
        is_wide = true;
        break;
      case glossy:
      case multiple:
      case glass:
      case thin:
        is_wide = bsdf_.roughness >= least_wide;
        break;
      case coat:
        is_wide = bsdf_.coat_roughness >= least_wide;
        break;
      default:
        break;
    }
    if (is_wide != wide) part.shares_[lobe] = 0;
  }
  part.sum_ = part.followed();
  return part;
}

double ViewedBsdf::followed() const {
  double sum = 0;
  for (const double share : shares_) sum += share;
  return sum;
}

BsdfValue ViewedBsdf::value(Lobe lobe, const Vec3& i) const {
  const double cosine = std::max(0.0, i.z), even = cosine / M_PI;
  const auto albedo = [&](const Vec3& w) { return albedo_of(w); };
  switch (lobe) {
    case diffuse: {
      if (cosine == 0) return {};
      Vec3 value = bsdf_.diffuse_roughness > 0
                       ? rough_diffuse(bsdf_.diffuse, bsdf_.diffuse_roughness, o_, i) * cosine
                       : bsdf_.diffuse * even;
      return {value * through_layer(i), even};
    }
    case translucent: {
      const double behind = std::max(0.0, -i.z) / M_PI;
      return {bsdf_.translucent * through_layer({i.x, i.y, -i.z}) * behind, behind};
    }
    case glossy: {
      const Facets::Reflection found = facets_.reflection(o_, i);
      const double along = std::min(1.0, glm::dot(o_, glm::normalize(o_ + i)));
      const Vec3 mirrored = bsdf_.layered * bsdf_.film.over(bsdf_.layer, along) +
                            bsdf_.metallic * bsdf_.film.over(bsdf_.metal, along);
      return {found.value * mirrored, found.density};
    }
    case multiple:
      return {(bsdf_.layered * often(layer_, albedo(o_)) + bsdf_.metallic * often(metal_, albedo(o_))) *
                  (1 - albedo(o_).once) * (1 - albedo(i).once) / (1 - albedo(o_).mean_once) * even,
              between_facets_density(bsdf_.roughness, i.z)};
    case coat: {
      const Vec3& own_o = coat_o_;
      const Vec3 own_i = coat_.into(i);
      const Facets::Reflection found = Facets(bsdf_.coat_roughness).reflection(own_o, own_i);
      BsdfValue result{Vec3(found.value), found.density};
      result.value *=
          bsdf_.coat * coat_fresnel().at(std::min(1.0, glm::dot(own_o, glm::normalize(own_o + own_i))));
      if (adjoint_ && own_i.z > 0) result.value *= own_o.z / o_.z * std::abs(i.z) / own_i.z;
      return result;
    }
    case glass: {
      const double n_o = bsdf_.ior_from, n_i = bsdf_.ior_to;
      const bool through = i.z < 0;
      Vec3 h = glm::normalize(through ? n_o * o_ + n_i * i : o_ + i);
      if (h.z < 0) h = -h;
      const double along_o = glm::dot(o_, h), along_i = glm::dot(i, h);
      if (along_o <= 0 || (along_i > 0) == through) return {};
      const double mirrored = optics::dielectric_reflectance(std::min(1.0, along_o), n_o, n_i);
      const double masking = 1 / (1 + facets_.lambda(o_));
      const double both = 1 / (1 + facets_.lambda(o_) + facets_.lambda(i));
      const double seen = facets_.density(h) * masking * along_o / o_.z;
      const double sum = n_o * along_o + n_i * along_i;
      const double density = through ? seen * (1 - mirrored) * n_i * n_i * std::abs(along_i) / (sum * sum)
                                     : seen * mirrored / (4 * along_o);
      const double once = !adjoint_ ? tables::glass_albedo(o_.z, bsdf_.roughness, n_o, n_i)
                          : through ? tables::glass_albedo(-i.z, bsdf_.roughness, n_i, n_o)
                                    : tables::glass_albedo(i.z, bsdf_.roughness, n_o, n_i);
      return {bsdf_.glass * (through ? bsdf_.glass_color : Vec3(1)) * density * both / masking / once,
              density};
    }
    case sheen: {
      if (cosine == 0) return {};
      const double half_way = std::min(1.0, glm::normalize(o_ + i).z), r = bsdf_.sheen_roughness;
      const double edge_on =
          std::max({1.0, tables::sheen_albedo(o_.z, r).unweakened, tables::sheen_albedo(i.z, r).unweakened});
      return {bsdf_.sheen * optics::sheen(half_way, o_.z, i.z, r) / edge_on * cosine, uniform_density};
    }
    case thin: {
      if (i.z >= 0) return {};
      const Vec3 up(i.x, i.y, -i.z);
      const Facets::Reflection blurred = facets_.reflection(o_, up);
      const GgxAlbedo there = albedo(o_), here = albedo(up);
      const double along = std::min(1.0, glm::dot(o_, glm::normalize(o_ + up)));
      const Vec3 let_in = 1.0 - bsdf_.film.over(bsdf_.layer, along);
      const Vec3 scattered = (1.0 - often(layer_, there)) * (1 - there.once) * (1 - here.once) /
                             (1 - there.mean_once) * up.z / M_PI;
      return {bsdf_.thin * (let_in * blurred.value + scattered),
              std::lerp(between_facets_density(bsdf_.roughness, up.z), blurred.density,
                        thin_mirrored(layer_, there))};
    }
    default:
      return {};
  }
}

GgxAlbedo ViewedBsdf::albedo_of(const Vec3& w) const {
  GgxAlbedo albedo = tables::ggx_albedo(std::abs(w.z), bsdf_.roughness);
  if (facets_.uneven() && w.z != 0) {
    const Facets::Once once = w == o_ ? once_o_ : facets_.once({w.x, w.y, std::abs(w.z)});
    albedo.once = once.all;
    albedo.edge = once.edge;
  }
  return albedo;
}

Vec3 ViewedBsdf::through_layer(const Vec3& w) const {
  if (bsdf_.layer.f90 == Vec3(0)) return Vec3(1);
  const GgxAlbedo there = albedo_of(o_), here = albedo_of(w);
  const bool filmed = bsdf_.film.share > 0;
  const Fresnel towards_light = filmed ? bsdf_.film.seen(bsdf_.layer, w.z) : layer_;
  const Vec3 mean = filmed ? layer_.mean * there.mean_once + often(layer_, there) * (1 - there.mean_once)
                           : mean_layer_albedo(layer_, there);
  return (1.0 - layer_albedo(layer_, there)) * (1.0 - layer_albedo(towards_light, here)) / (1.0 - mean);
}

ViewedBsdf::Layers ViewedBsdf::layers(const Vec3& w) const {
  const double in_coat = w == o_ ? coat_o_.z : std::max(0.0, coat_.into(w).z);
  return {through_coat(bsdf_.coat, bsdf_.coat_roughness, in_coat),
          through_sheen(bsdf_.sheen, bsdf_.sheen_roughness, w.z)};
}

// The layers that dim light from i. A layer takes as much light from the lobes under it as it reflects to the
// viewer (Khronos: KHR_materials_clearcoat, KHR_materials_sheen), so that a white surface stays white. For a
// photon, i points to the viewer; if that is behind the surface, the layers count as on that side.
ViewedBsdf::Layers ViewedBsdf::layers_between(const Vec3& i) const {
  return layers(!adjoint_ ? o_ : i.z < 0 ? -i : i);
}

double ViewedBsdf::through_layers(const Vec3& i) const {
  const Layers left = layers_between(i);
  return left.coat * left.sheen;
}

BsdfValue ViewedBsdf::at(const Vec3& i, bool before) const {
  BsdfValue all;
  const Layers left = layers_between(i);
  for (const Lobe lobe : {diffuse, glossy, multiple, coat, glass, sheen, thin, translucent}) {
    if (shares_[lobe] == 0) continue;
    const BsdfValue one = value(lobe, i);
    const bool counts = lobe == coat ? before : before == (i.z > 0);
    const double under = lobe == coat ? 1 : lobe == sheen ? left.coat : left.coat * left.sheen;
    if (counts) all.value += under * one.value;
    all.density += shares_[lobe] * one.density;
  }
  return all;
}

bool ViewedBsdf::faces(const Vec3& i, bool before) const {
  return before == (i.z > 0) || (before && bsdf_.coat > 0 && coat_.into(i).z > 0);
}

Vec3 ViewedBsdf::direction(Lobe lobe, double part, const Vec2& u) const {
  if (lobe == diffuse) return cosine_direction(u);
  if (lobe == sheen) return uniform_direction(u);
  if (lobe == translucent) return cosine_direction(u) * Vec3(1, 1, -1);
  const double mirrored = lobe == thin ? thin_mirrored(layer_, albedo_of(o_)) : 0;
  if (lobe == multiple || (lobe == thin && part >= mirrored)) {
    const double rest = (part - mirrored) / (1 - mirrored);
    const Vec3 i = rest < uniform_share(bsdf_.roughness) ? uniform_direction(u) : cosine_direction(u);
    return {i.x, i.y, lobe == thin ? -i.z : i.z};
  }
  if (lobe == coat) {
    const Vec3 h = Facets(bsdf_.coat_roughness).normal(coat_o_, u);
    const Vec3 i = 2 * std::min(1.0, glm::dot(coat_o_, h)) * h - coat_o_;
    return i.z > 0 ? coat_.out_of(i) : Vec3(0);
  }
  const Vec3 h = facets_.normal(o_, u);
  const double along = std::min(1.0, glm::dot(o_, h));
  // Light that a microfacet scatters to the wrong side is lost.
  if (lobe != glass) {
    const Vec3 i = 2 * along * h - o_;
    return i.z > 0 ? Vec3(i.x, i.y, lobe == thin ? -i.z : i.z) : Vec3(0);
  }
  const bool reflects = part < optics::dielectric_reflectance(along, bsdf_.ior_from, bsdf_.ior_to);
  const Vec3 i = reflects ? 2 * along * h - o_ : glm::refract(-o_, h, bsdf_.ior_from / bsdf_.ior_to);
  return (i.z > 0) == reflects ? i : Vec3(0);
}

BsdfSample ViewedBsdf::sample(double random, const Vec2& u) const {
  // Choose the last lobe whose range of numbers begins at or before `random`.
  double begin = 0, below = 0;
  Lobe chosen = diffuse;
  for (int lobe = 0; lobe < lobes; ++lobe) {
    if (shares_[lobe] > 0 && random >= below) {
      chosen = Lobe(lobe);
      begin = below;
    }
    below += shares_[lobe];
  }
  const double share = shares_[chosen];
  switch (chosen) {
    case mirror:
      return {BsdfSample::Kind::mirrored, Vec3(0), bsdf_.mirror / share, 14};
    case transmitted:
      return {BsdfSample::Kind::refracted, Vec3(0), bsdf_.transmitted / share, 15};
    case straight:
      return {BsdfSample::Kind::passed, Vec3(0), passed() / share, 16};
    default:
      return {BsdfSample::Kind::lobe, direction(chosen, (random - begin) / share, u), Vec3(0),
              uint32_t(chosen)};
  }
}

}  // namespace eyeray::engine::reference
