// The flat buffers that the shaders read, and the way shapes and materials write them.
#pragma once

#include <algorithm>
#include <bit>
#include <memory>
#include <set>
#include <span>
#include <unordered_map>
#include <utility>
#include <vector>

#include "host/core/raw_vector.hpp"
#include "host/expression/expression.hpp"
#include "host/records/records.hpp"
#include "host/scene/bounds.hpp"
#include "host/scene/image_texture.hpp"
#include "host/scene/material.hpp"

namespace eyeray::engine::formula {
class Formula;  // formula/formula.hpp
}

namespace eyeray::engine::records {

struct PackedFormula {
  std::shared_ptr<const formula::Formula> formula;
  bool by_bounds;  // whether rays find its surface by affine bounds, not by steps with a Lipschitz constant
};

// A scene as the shaders see it; every position is relative to the camera's eye.
struct PackedScene {
  // Primitives by slot. First come the world's own: those in no BVH, by kind in registry order, then the
  // others in the order of leaves. Those of each mesh or group with its own BVH follow.
  RawVector<shader::Primitive> primitives;
  std::vector<uint32_t> linear_ends;  // for each kind, the end of its primitives in no BVH
  // The index of the first primitive of `kind` that is in no BVH.
  uint32_t first_linear(uint32_t kind) const { return kind == 0 ? 0 : linear_ends[kind - 1]; }
  std::set<uint32_t> bvh_kinds;                       // kinds of the shapes in BVHs
  std::set<std::pair<uint32_t, uint32_t>> uses;       // kinds of shape, and materials that they are made of
  std::set<std::pair<uint32_t, uint32_t>> leaf_uses;  // the same for the shapes that CSG objects are made of
  bool mixed_csg = false;  // true if some CSG object's surfaces weaken a shadow ray differently
  RawVector<shader::uvec4> nodes;
  std::vector<shader::Bvh> bvhs;  // the world's, then one for each mesh or group of `instances`
  std::vector<shader::Instance> instances;
  // The most primitives, and iterations of their loops, that are tested as fast without a BVH.
  size_t most_linear = 0;
  bool has_bvh = false;          // whether `nodes` are to be used; else all is tested one by one
  bool quantised_nodes = false;  // the coding of `nodes`
  uint32_t stack_size = 1;       // the most entries that a traversal may have waiting
  RawVector<shader::uvec4> vertices;
  bool bent_normals = false;  // whether any material bends the normals of its surface
  bool own_colors = false;    // whether any of `vertices`, or any points, have colours
  bool pieces = false;        // whether any shape has several primitives
  bool lathes = false;        // whether any patch has texture coordinates of its own, as those of a lathe do
  bool round_cones = false;   // whether any capsule has two radii
  bool second_uv = false;     // whether any of `vertices` have second texture coordinates
  // The factor by which rounding in a shape's object space grows in world space: |linear| · |inverse|, the
  // largest of all shapes.
  float map_growth = 1;
  std::vector<PackedFormula> formulas;     // by number
  uint64_t shape_iterations = 0;           // iterations that the loops of all shapes may make together
  bool may_reach_iteration_limit = false;  // whether any shape may return T_ITERATION_LIMIT
  std::vector<shader::Material> materials;
  std::vector<shader::Texture> textures;
  size_t texel_count = 0;        // the number of texels, written or not; 0 without images
  std::vector<uint32_t> texels;  // records.h has the layout
  std::vector<shader::Medium> media{
      {{0, 0, 0}, 1, {0, 0, 0}, 0, 0, 0, 0, 0}};  // by number; medium 0 is around everything
  std::vector<shader::Light> lights;
  RawVector<shader::uvec4> environment;   // as in records.h; empty if there is none, or it is not written
  std::vector<shader::Emitter> emitters;  // lights, then surfaces in the order of their primitives
  std::vector<uint32_t> emitter_media;    // media that photons of `emitters` start in; empty without photons
  std::vector<shader::LightNode> light_nodes;  // empty where no light BVH is used
  std::set<uint32_t> lobes;                    // kinds of lobes of the materials' BSDFs
  bool panes = false;                          // whether paths may pass any material straight
  bool interfaces = false;            // whether such a material may be a border between media of one index
  bool transparent = false;           // whether the picture has an alpha in place of its background
  bool has_conductors = false;        // whether any material mirrors by a metal's index
  bool has_films = false;             // whether a thin film lies on any material
  std::vector<shader::vec4> albedos;  // as in records.h; empty where no lobe needs them
  shader::Frame frame{};
};

class Packer {
 public:
  // `eye`: the world position that becomes the origin.
  explicit Packer(const Vec3& eye) : origin_(eye) {}

  // Makes a world position relative to the eye, in float64. Only this difference is rounded to float32.
  Vec3 relative(const Vec3& world) const { return world - origin_; }
  // Sets the point to which positions are relative. Objects in an object space are relative to a point of
  // that space.
  void set_origin(const Vec3& origin) { origin_ = origin; }

  void add(const shader::Primitive& primitive) { scene.primitives.push_back(primitive); }
  // Adds one of the primitives of a shape that consists of several. They share its id.
  void add_piece(const shader::Primitive& primitive, const Bounds& bounds) {
    add(primitive);
    pieces.push_back(bounds);
    scene.pieces = true;
  }
  // Makes room for the pieces of a shape that has many.
  void reserve_pieces(size_t count) {
    scene.primitives.reserve(scene.primitives.size() + count);
    pieces.reserve(count);
  }
  // A primitive; its id and optical depth are filled in later. a, b, c: as in the shape's .glsl. `extra`:
  // an index into vertices.
  static shader::Primitive primitive(uint32_t kind, int material, const shader::vec4& a,
                                     const shader::vec4& b, const shader::vec4& c, uint32_t extra = NONE) {
    return {0u, shader::material_and_kind(uint32_t(material), kind), 0u, extra, a, b, c};
  }
  void add(const shader::Material& material) { scene.materials.push_back(material); }
  void add(const shader::Light& light) { scene.lights.push_back(light); }
  // Appends `data` to the vertices, and returns the index at which it starts.
  uint32_t add_vertices(std::initializer_list<shader::uvec4> data) { return add_vertices(std::span(data)); }
  uint32_t add_vertices(std::span<const shader::uvec4> data);
  void add_map_growth(double growth) { scene.map_growth = std::max(scene.map_growth, float(growth)); }
  // Every shape that loops states how often it may.
  void add_iterations(size_t count) { scene.shape_iterations += count; }
  // Every shape whose `intersect` may return T_ITERATION_LIMIT calls this.
  void add_iteration_limit() { scene.may_reach_iteration_limit = true; }
  // The index of a texture; equal textures share one.
  uint32_t add(const shader::Texture& texture);
  // The index of an image's first texel. Images of the same texels share them. Error (bad_input) if there are
  // more than an index can address. Only counts texels: write_texels() writes them.
  uint32_t add_image(const std::shared_ptr<const ImageTexture>& image);
  // Writes the texels of all images: a second copy of them, which only executors need.
  void write_texels();
  // The number of a formula; equal formulas share one. `by_bounds`: rays find its surface by affine bounds.
  // InputError, at the text, if all formulas together are too much for a kernel.
  uint32_t add_formula(const std::shared_ptr<const formula::Formula>& formula, bool by_bounds = false);
  // The number of a medium, 1 … 255.
  uint32_t add_medium(const Medium& medium);

  PackedScene scene;
  std::vector<Bounds> pieces;  // the world's bounds of each primitive of the shape that is being packed;
                               // empty if it is one primitive

 private:
  struct PlacedImage {
    std::shared_ptr<const ImageTexture> image;
    uint32_t first;  // its first texel
  };

  Vec3 origin_;
  double formula_instructions_ = 0;
  std::vector<PlacedImage> images_;
  // By the hash of the shared object: indices into images_, and in scene.textures.
  std::unordered_multimap<size_t, size_t> images_by_texels_;
  std::unordered_multimap<size_t, size_t> textures_by_bytes_;
};

// Float32 records from float64 values.
inline shader::Medium to_record(const Medium& medium) {
  return {glm::vec3(medium.absorption),
          float(medium.ior),
          glm::vec3(medium.scattering),
          float(medium.anisotropy),
          float(medium.spread()),
          0,
          0,
          0};
}
inline shader::vec4 to_vec4(const Vec3& v, double w = 0) {
  return shader::vec4(glm::vec3(v), float(w));
}
inline shader::uvec4 to_bits(const shader::vec4& v) {
  return std::bit_cast<shader::uvec4>(v);
}

}  // namespace eyeray::engine::records
