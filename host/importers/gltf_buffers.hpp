// The binary data of a glTF file: buffers, bufferViews and accessors. All ranges are checked. Private to the
// importers.
#pragma once

#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "host/core/vec.hpp"
#include "host/importers/asset_files.hpp"
#include "host/importers/gltf_breaches.hpp"
#include "host/importers/gltf_json.hpp"

namespace eyeray::engine::importers {

// The parts of a .glb, which point into `bytes`; a .gltf has only JSON. InputError if the file is damaged.
struct GltfContainer {
  std::string_view json;
  std::optional<std::string_view> binary;
  std::vector<std::string> breaches = {};  // kinds for GltfBreaches::add
};
GltfContainer open_gltf(std::string_view bytes, const std::string& file);

class GltfBuffers {
 public:
  GltfBuffers(const GltfObject& document, const GltfContainer& container, AssetFiles& assets,
              GltfBreaches& breaches);

  // The bytes of a `uri`: inline data, or a file. Error if it is damaged or cannot be read.
  std::string read_uri(const GltfObject& owner, std::string_view what);
  // The bytes of a bufferView, which are decoded if they are coded (gltf_meshopt.hpp).
  std::string_view view(size_t index);

  // From now on, these accessors have the elements given here, packed, of the accessor's own type and count.
  // All other accessors have the elements of their bufferViews again.
  void supply(std::map<size_t, std::string> elements);
  // Counts elements that are read: even a short file may claim any number. InputError, at `owner`, if the sum
  // exceeds the limit for a file of this size.
  void claim(const GltfObject& owner, uint64_t elements);
  // Raises the limit of claim() by `elements`, for data that are coded.
  void allow(uint64_t elements) { allowed_elements_ += elements; }
  // Size in bytes of the data read so far, in the form in which it was read.
  uint64_t byte_size() const;

  // The elements of an accessor. Normalized integers become numbers from −1 or 0 to 1.
  std::vector<Vec2> vec2(size_t accessor);
  std::vector<Vec3> vec3(size_t accessor);
  std::vector<Vec4> vec4(size_t accessor);
  std::vector<Mat4> mat4(size_t accessor);
  // The numbers of an animation's accessor, one after the other: of type SCALAR, VEC3 or VEC4.
  std::vector<double> numbers(size_t accessor, std::string_view type);
  std::vector<Vec4> colors(size_t accessor);  // RGBA; the alpha of an RGB colour is 1
  std::vector<uint32_t> indices(size_t accessor);

 private:
  struct Elements;

  std::string_view buffer(size_t index);
  std::string_view range(const GltfObject& source);
  Elements elements(const GltfObject& owner, std::optional<size_t> view, size_t components, uint64_t type,
                    uint64_t count);
  void refuse_stride(const GltfObject& owner, size_t views) const;
  void check_layout(const GltfObject& owner, size_t view, size_t component_size);
  template <typename T>
  void check_range(const GltfObject& accessor, const std::vector<T>& all, size_t components);
  template <typename T>
  std::vector<T> read(size_t accessor, std::string_view type, size_t components);

  const GltfObject& document_;
  GltfContainer container_;
  AssetFiles& assets_;
  GltfBreaches& breaches_;
  std::vector<std::optional<std::string>> buffers_;        // each is read when it is first used
  std::vector<std::optional<std::string>> decoded_views_;  // each is decoded when it is first used
  std::map<size_t, std::string> supplied_;                 // by accessor
  uint64_t decoded_bytes_ = 0;                             // in decoded_views_
  uint64_t allowed_elements_ = 0;
  uint64_t elements_read_ = 0;
};

// The name of the file that a URI gives: %20 becomes a space.
std::string decode_uri(std::string_view uri);

}  // namespace eyeray::engine::importers
