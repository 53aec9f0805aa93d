// The interface of materials, in float64. A material is one .cpp in host/materials, one .glsl in
// shaders/materials and one row in materials/rows.h.
#pragma once

#include <memory>
#include <optional>
#include <string>

#include "host/core/vec.hpp"
#include "host/scene/bsdf.hpp"
#include "host/scene/texture.hpp"

namespace eyeray::engine {

namespace records {
class Packer;  // records/packer.hpp
}

// The medium in a closed shape, or outside all shapes. Light is weakened by exp(−absorption · distance), and
// for paths also by scattering into other directions. The phase function is Henyey's and Greenstein's: g is
// the mean cosine of the scattering angle.
struct Medium {
  double ior = 1.0;
  Vec3 absorption{0.0};  // per unit of length, like scattering
  Vec3 scattering{0.0};
  double anisotropy = 0;  // g, within ±most_anisotropy
  double dispersion = 0;  // 20 / Abbe number; 0: all colours have one index

  // The indices at blue and red light (the F and C lines) differ from `ior` (at the d line) by (ior − 1) / (2
  // V), where V is the Abbe number. Khronos: KHR_materials_dispersion.
  double spread() const { return (ior - 1) * dispersion / 40; }
  // The index for light of these colours: that of red light for red alone, that of blue light for blue alone.
  double index(const Vec3& light) const {
    if (light.x > 0 && light.y == 0 && light.z == 0) return ior - spread();
    return light.x == 0 && light.y == 0 && light.z > 0 ? ior + spread() : ior;
  }
};
constexpr double most_anisotropy = 0.99;

// The light that a surface point scatters towards the viewer, after Whitted 1980.
struct Scattering {
  Vec3 ambient{0.0};   // × the scene's ambient light
  Vec3 diffuse{0.0};   // × light · cos θ
  Vec3 specular{0.0};  // × light · (highlight lobe), see HighlightModel
  double shininess = 1.0;
  bool blinn = false;     // lobe (n·h)^shininess instead of Phong's (r·l)^shininess
  Vec3 reflected{0.0};    // × light from the mirror direction
  Vec3 transmitted{0.0};  // × light from the refracted direction; 0 under total internal reflection
  Vec3 emitted{0.0};      // radiance that the point emits
};

// The values at a point on which a material may depend.
struct ScatteringContext {
  TextureContext point;
  double cos_view;  // cosine between the shading normal and the direction back along the ray, in [0, 1]
  double ior_from;  // index of refraction of the medium the ray comes through
  double ior_to;    // index of refraction of the medium behind the surface
  Vec3 color{1.0};  // color of a mesh's vertices: the factor of the colours that scatter
  Vec3 coat_normal{0, 0, 1};  // in the surface's own frame, whose z is the shading normal
};

// There is no surface where the alpha, times that of a mesh's vertices, is below a limit. The limit is
// `cutoff`. For a material that blends, it is a random number of each ray instead, so that the ray hits with
// a probability of alpha.
struct AlphaMask {
  TexturePtr alpha;     // by Texture::alpha_at
  double cutoff = 0.5;  // above 0
  bool blends = false;

  // `random`: the ray's number, in (0, 1].
  bool covers(const Vec2& uv, double vertex_alpha = 1, double random = 1) const {
    return alpha->alpha_at(uv) * vertex_alpha >= (blends ? random : cutoff);
  }
};

// A colour encodes a direction in tangent space, as in glTF: 2 · code − 1, with red along u, green along v
// and blue along the normal. Red and green are multiplied by `scale`.
struct NormalMap {
  TexturePtr texture;
  double scale = 1;
};

// The direction along which microfacets are wider than across it: that of u, or of a map as in glTF, whose
// red is along u and whose green along v. It is rotated by `turn` radians, from u to v.
struct RoughAxis {
  TexturePtr texture = nullptr;  // null: along u
  double turn = 0;
};

// A height field, in which white has the height `height` in the world. Heights are compared at a distance of
// `width` to both sides: in uv, or in the world for a texture in_space().
struct BumpMap {
  TexturePtr texture;
  double height;
  double width;
};

class Material {
 public:
  virtual ~Material() = default;

  virtual Scattering scattering(const ScatteringContext& context) const = 0;
  // The BSDF for paths. `scattering`: the result of scattering(). The default returns its terms, with the
  // diffuse one cut to 1. Together they may exceed 1, which the loader warns of (loader/path_check.hpp).
  virtual Bsdf bsdf(const ScatteringContext& context, const Scattering& scattering) const;
  // The colour that `raycast` shades.
  virtual Vec3 base_color(const TextureContext& point) const = 0;
  // True if the material emits.
  virtual bool emits() const { return false; }
  // The emitted light if it is constant; else empty.
  virtual std::optional<Vec3> constant_emission() const { return std::nullopt; }
  // The medium of a material that fills its shape and lets rays through; empty for any other.
  virtual std::optional<Medium> medium() const { return std::nullopt; }
  // True if paths treat the material as a pane, which has no inside, for any result of medium().
  virtual bool thin() const { return false; }
  // The share of a shadow ray's light that passes a shape of this material, however often it crosses it.
  virtual double shadow_transmittance() const { return 0.0; }
  // Appends the material's one record (and its textures).
  virtual void pack(records::Packer& packer) const = 0;

  std::string name;
  bool emits_in_front = false;    // emits only on the side of the normals; else on both sides
  bool samples_emission = true;   // paths send shadow rays to its surfaces; else they find them by chance
  bool front_only = false;        // for meshes: rays from behind do not hit it, and it emits in front
  std::optional<AlphaMask> mask;  // never set if there is a medium
  std::optional<NormalMap> normal_map;
  std::optional<BumpMap> bump_map;           // applied after normal_map
  std::optional<RoughAxis> rough_axis;       // set if the BSDF may set `widths`
  std::optional<NormalMap> coat_normal_map;  // for the coat, which the other maps do not bend
};

}  // namespace eyeray::engine
