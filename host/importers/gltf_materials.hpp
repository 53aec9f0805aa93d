// Turns the materials of a glTF file into ours. Private to the importers.
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "host/importers/gltf_buffers.hpp"
#include "host/importers/gltf_uv.hpp"
#include "host/importers/texture_files.hpp"
#include "host/materials/make.hpp"
#include "host/scene/material.hpp"
#include "host/textures/make.hpp"

namespace eyeray::engine::importers {

// Counts the parts of a file that the importer leaves out.
class GltfLeftOut {
 public:
  void add(const std::string& what, size_t count = 1);
  // Adds the warning "left out: normal maps (3), animations (1)".
  void report(std::vector<std::string>& warnings) const;

 private:
  std::vector<std::pair<std::string, size_t>> counts_;
};

// The uv of a mesh that a material's pictures use.
struct GltfUvUse {
  std::vector<GltfUv> uv;  // at most two, which is all that a vertex has
  // True if the normalTexture, or without one the anisotropyTexture, takes the second uv: TANGENT is along
  // their u.
  bool second_tangents = false;
};

class GltfMaterials {
 public:
  GltfMaterials(const GltfObject& document, GltfBuffers& buffers, TextureFiles& textures,
                GltfLeftOut& left_out, GltfBreaches& breaches);

  std::unique_ptr<Material> material(size_t index);
  GltfUvUse uv_use(size_t index) const;

 private:
  // The values of a metallic-roughness material, as numbers and pictures.
  struct Surface {
    Vec3 base{1};
    TexturePtr emission;
    std::shared_ptr<const ImageTexture> image;
    double metalness = 1;    // mean over the surface
    double roughness = 1;    // mean over the surface
    TexturePtr metal_rough;  // over the surface: blue is the metalness, green the roughness

    TexturePtr metalness_texture() const {
      return metal_rough ? metal_rough : textures::make_constant(Vec3(metalness));
    }
    TexturePtr roughness_texture() const {
      return metal_rough ? metal_rough : textures::make_constant(Vec3(roughness));
    }
  };

  Surface surface(const GltfObject& material);
  TexturePtr emission(const GltfObject& material);
  // `stand_in`: the material that Whitted's pictures show instead.
  std::unique_ptr<Material> principled(const GltfObject& source, const Surface& surface,
                                       std::unique_ptr<Material> stand_in);
  // The stand-in of a transmissive material in Whitted's pictures.
  std::unique_ptr<Material> glass(const GltfObject& material, const Surface& surface);
  double ior(const GltfObject& material);
  double index_of(const GltfObject& owner, const char* key, double fallback);
  Vec3 absorption(const GltfObject& material);
  double dispersion(const GltfObject& material);
  std::optional<RoughAxis> anisotropy(const GltfObject& material, materials::PrincipledValues& values);
  void iridescence(const GltfObject& material, materials::PrincipledValues& values);
  void diffuse_transmission(const GltfObject& material, materials::PrincipledValues& values);
  std::optional<AlphaMask> mask(const GltfObject& material, bool blends);
  std::optional<NormalMap> normal_map(const GltfObject& material, const std::optional<GltfObject>& reference);
  // The content to take from a picture: its sRGB colours, its numbers, or its alpha in place of each channel.
  enum class Content { color, data, alpha };
  std::shared_ptr<const ImageTexture> texture(const GltfObject& reference, Content content);
  // `factor` times the picture `map` of an extension; only `factor` if there is no such picture.
  TexturePtr scaled(const GltfObject& material, const GltfObject& extension, const char* map,
                    const Vec3& factor, Content content = Content::data);
  ImageTexture decode_image(size_t index, image::PixelBudget& budget, std::vector<std::string>& warnings);
  static std::optional<GltfObject> base_texture(const GltfObject& material);
  static std::vector<GltfObject> textures_of(const GltfObject& material);
  static void add_extension_textures(const GltfObject& material, std::vector<GltfObject>& textures);
  static std::vector<GltfUv> uv_of_material(const GltfObject& material);
  // The picture's position in the uv that a vertex has. Empty if it needs others: the loss is counted as
  // `what`.
  std::optional<textures::ImagePosition> position(const GltfObject& material, const GltfObject& reference,
                                                  const char* what);
  void note_rest(const GltfObject& material);
  // A number that is a share, from 0 to 1.
  double factor(const GltfObject& owner, const char* key, double fallback);
  double not_negative(const GltfObject& owner, const char* key, double fallback);
  std::vector<double> factors(const GltfObject& owner, const char* key, std::vector<double> fallback);

  const GltfObject& document_;
  GltfBuffers& buffers_;
  TextureFiles& textures_;
  GltfLeftOut& left_out_;
  GltfBreaches& breaches_;
};

}  // namespace eyeray::engine::importers
