#include "host/importers/gltf_buffers.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstring>
#include <limits>
#include <type_traits>

#include "host/importers/gltf_components.hpp"
#include "host/importers/gltf_meshopt.hpp"
#include "host/importers/malformed.hpp"

namespace eyeray::engine::importers {

namespace {

template <typename T>
double load(const char* bytes, bool normalized) {
  T value;
  std::memcpy(&value, bytes, sizeof value);
  if constexpr (std::is_integral_v<T>) {
    if (normalized) return std::max(-1.0, double(value) / double(std::numeric_limits<T>::max()));
  }
  return static_cast<double>(value);
}

double load(const char* bytes, uint64_t type, bool normalized) {
  static_assert(std::endian::native == std::endian::little, "glTF's numbers are little-endian");
  return visit_component(type, [&](auto zero) { return load<decltype(zero)>(bytes, normalized); });
}

template <typename T>
void set(T& element, size_t component, double value) {
  if constexpr (std::is_arithmetic_v<T>) {
    element = static_cast<T>(value);
  } else if constexpr (std::is_same_v<T, Mat4>) {
    element[static_cast<int>(component / 4)][static_cast<int>(component % 4)] = value;
  } else {
    element[static_cast<int>(component)] = value;
  }
}

template <typename T>
double component_of(const T& element, size_t k) {
  if constexpr (std::is_arithmetic_v<T>) {
    return double(element);
  } else if constexpr (std::is_same_v<T, Mat4>) {
    return element[static_cast<int>(k / 4)][static_cast<int>(k % 4)];
  } else {
    return element[static_cast<int>(k)];
  }
}

}  // namespace

// A range of elements, all of which lie inside a buffer.
struct GltfBuffers::Elements {
  const char* bytes = nullptr;
  size_t stride = 0;
  uint64_t type = 0;
};

GltfBuffers::GltfBuffers(const GltfObject& document, const GltfContainer& container, AssetFiles& assets,
                         GltfBreaches& breaches)
    : document_(document), container_(container), assets_(assets), breaches_(breaches) {
  buffers_.resize(document.size("buffers"));
  if (container.binary && (buffers_.empty() || document.element("buffers", 0).has("uri")))
    breaches.add("binary chunks of .glb that no buffer uses, left out", "the file");
  decoded_views_.resize(document.size("bufferViews"));
}

uint64_t GltfBuffers::byte_size() const {
  uint64_t sum = container_.json.size() + (container_.binary ? container_.binary->size() : 0);
  for (const auto& buffer : buffers_) sum += buffer ? buffer->size() : 0;
  return sum;
}

std::string_view GltfBuffers::buffer(size_t index) {
  const GltfObject source = document_.element("buffers", index);
  const uint64_t length = source.count("byteLength", 0);
  std::string_view bytes;
  if (index == 0 && !source.has("uri") && container_.binary) {
    bytes = *container_.binary;
  } else if (!source.has("uri")) {
    source.fail("has no data");
  } else {
    if (!buffers_[index]) buffers_[index] = read_uri(source, "the buffer");
    bytes = *buffers_[index];
  }
  if (length > bytes.size())
    source.fail(fmt::format("should have {} bytes, but there are only {}", length, bytes.size()));
  const size_t padding = source.has("uri") ? 0 : 3;
  const std::string uri = source.text("uri");
  const bool inside = uri.starts_with("data:");
  if ((inside || padding > 0) && bytes.size() - length > padding)
    breaches_.add("buffers with more data than their byteLength, left out", source.location());
  if (inside && !uri.starts_with("data:application/octet-stream;") &&
      !uri.starts_with("data:application/gltf-buffer;"))
    breaches_.add("data URIs of buffers of another type than application/octet-stream", source.location());
  return bytes.substr(0, length);
}

// The bytes that `source` points at. It is a bufferView, or the object in one that describes its coded bytes.
std::string_view GltfBuffers::range(const GltfObject& source) {
  const auto owner = source.index("buffer", buffers_.size());
  if (!owner) source.fail("has no buffer");
  const std::string_view bytes = buffer(*owner);
  const uint64_t offset = source.count("byteOffset", 0);
  const uint64_t length = source.count("byteLength", 0);
  if (offset > bytes.size() || length > bytes.size() - offset)
    source.fail(fmt::format("extends to byte {} of a buffer that has {}", offset + length, bytes.size()));
  return bytes.substr(offset, length);
}

std::string_view GltfBuffers::view(size_t index) {
  const GltfObject source = document_.element("bufferViews", index);
  const auto coding = meshopt_coding(source);
  if (!coding) return range(source);
  auto& decoded = decoded_views_[index];
  if (!decoded) {
    decoded = decode_meshopt(source, *coding, range(*coding));
    decoded_bytes_ += decoded->size();
    allow(decoded->size() / 2);
    // Limit the decoded bytes of all views: many views may share the same coded bytes.
    if (decoded_bytes_ > std::max<uint64_t>(1 << 20, 64 * byte_size()))
      source.fail("makes the decoded data larger than a file of this size may have");
  }
  return *decoded;
}

void GltfBuffers::claim(const GltfObject& owner, uint64_t elements) {
  elements_read_ += elements;
  if (elements_read_ > std::max<uint64_t>(1 << 20, 16 * byte_size() + allowed_elements_))
    owner.fail("makes the number of elements larger than a file of this size may have");
}

void GltfBuffers::supply(std::map<size_t, std::string> elements) {
  supplied_ = std::move(elements);
}

// The elements of `owner`: an accessor, or the sparse part of one.
GltfBuffers::Elements GltfBuffers::elements(const GltfObject& owner, std::optional<size_t> index,
                                            size_t components, uint64_t type, uint64_t count) {
  const size_t size = components * bytes_of(type);
  if (size == 0) owner.fail("has a componentType that glTF does not define");
  if (!index) owner.fail("has no bufferView");
  const std::string_view bytes = view(*index);
  const uint64_t stride = document_.element("bufferViews", *index).count("byteStride", size);
  const uint64_t offset = owner.count("byteOffset", 0);
  if (stride < size) owner.fail(fmt::format("has elements of {} bytes, {} apart", size, stride));
  check_layout(owner, *index, bytes_of(type));
  const bool inside = offset <= bytes.size() && size <= bytes.size() - offset &&
                      count - 1 <= (bytes.size() - offset - size) / stride;
  if (count > 0 && !inside) owner.fail("reaches beyond the end of its bufferView");
  return {bytes.data() + offset, stride, type};
}

// Adds breaches of the alignment rules. They matter to programs that hand the bytes to a GPU as they are;
// this importer reads each number by itself.
void GltfBuffers::check_layout(const GltfObject& owner, size_t index, size_t component_size) {
  const GltfObject view = document_.element("bufferViews", index);
  const uint64_t offset = owner.count("byteOffset", 0);
  if (offset % component_size != 0 || (offset + view.count("byteOffset", 0)) % component_size != 0)
    breaches_.add("accessors that do not begin at a multiple of their components' size", owner.location());
  const uint64_t stride = view.count("byteStride", 4);
  if (stride < 4 || stride > 252 || stride % 4 != 0)
    breaches_.add("strides that are not multiples of 4 from 4 to 252", view.location() + ".byteStride");
}

// Compares the data with the accessor's min and max. A contradiction is a sign of wrong data.
template <typename T>
void GltfBuffers::check_range(const GltfObject& accessor, const std::vector<T>& all, size_t components) {
  if (all.empty() || !(accessor.has("min") || accessor.has("max"))) return;
  double unit = 1;  // factor from the stated min and max to the data's values
  if (accessor.flag("normalized")) {
    visit_component(accessor.count("componentType", 0), [&](auto zero) {
      if constexpr (std::is_integral_v<decltype(zero)>)
        unit = 1.0 / std::numeric_limits<decltype(zero)>::max();
    });
  }
  for (size_t k = 0; k < components; ++k) {
    double low = component_of(all[0], k), high = low;
    for (const T& element : all) {
      low = std::min(low, component_of(element, k));
      high = std::max(high, component_of(element, k));
    }
    const double slack =
        1e-3 * (high - low) + 1e-5 * std::max(std::abs(low), std::abs(high)) + (unit < 1 ? unit : 0);
    for (const auto& [key, found] : {std::pair{"min", low}, {"max", high}}) {
      const std::vector<double> declared = accessor.numbers(key);
      if (!declared.empty() && declared.size() != components)
        accessor.fail(fmt::format("has a {} of {} numbers", key, declared.size()));
      if (!declared.empty() && !(std::abs(declared[k] * unit - found) <= slack))
        breaches_.add("accessors whose min or max is not that of their data, which are used",
                      accessor.location());
    }
  }
}

template <typename T>
std::vector<T> GltfBuffers::read(size_t index, std::string_view type, size_t components) {
  const GltfObject accessor = document_.element("accessors", index);
  const size_t views = document_.size("bufferViews");
  if (accessor.text("type") != type) accessor.fail(fmt::format("must be of type {}", type));
  const uint64_t count = accessor.count("count", 0);
  const uint64_t component = accessor.count("componentType", 0);
  const bool normalized = accessor.flag("normalized");
  if (count == 0) accessor.fail("has no elements");
  if (normalized && (component == floating || component == unsigned_int))
    breaches_.add("accessors of floats or of 32 bits that are normalized", accessor.location());

  const auto copy = [&](const Elements& from, uint64_t i, T& to) {
    const char* bytes = from.bytes + i * from.stride;
    for (size_t k = 0; k < components; ++k)
      set(to, k, load(bytes + k * bytes_of(component), component, normalized));
  };
  std::optional<Elements> base;
  if (const auto supplied = supplied_.find(index); supplied != supplied_.end()) {
    base = Elements{supplied->second.data(), components * bytes_of(component), component};
  } else if (const auto index_of_view = accessor.index("bufferView", views)) {
    base = elements(accessor, index_of_view, components, component, count);
  }

  // Count the elements: several accessors may read the same bytes. Without bytes, all elements are 0.
  claim(accessor, count);
  std::vector<T> all(count, T(0));
  for (uint64_t i = 0; base && i < count; ++i) copy(*base, i, all[i]);

  // Overwrite elements with the sparse values.
  if (const auto sparse = accessor.object("sparse")) {
    const uint64_t changes = sparse->count("count", 0);
    if (changes == 0 || changes > count)
      sparse->fail(
          fmt::format("has a count of {}: it must be from 1 to that of its accessor, {}", changes, count));
    const auto sparse_indices = sparse->object("indices");
    const auto values = sparse->object("values");
    if (!sparse_indices || !values) sparse->fail("needs indices and values");
    const uint64_t index_type = sparse_indices->count("componentType", 0);
    if (index_type != unsigned_byte && index_type != unsigned_short && index_type != unsigned_int)
      sparse_indices->fail("must be unsigned integers");
    const Elements at =
        elements(*sparse_indices, sparse_indices->index("bufferView", views), 1, index_type, changes);
    const Elements from =
        elements(*values, values->index("bufferView", views), components, component, changes);
    refuse_stride(*sparse_indices, views);
    refuse_stride(*values, views);
    double last = -1;
    for (uint64_t i = 0; i < changes; ++i) {
      const double element_index = load(at.bytes + i * at.stride, index_type, false);
      if (!(element_index > last))
        sparse_indices->fail(fmt::format("have {} after {}: they must increase", element_index, last));
      last = element_index;
      if (!(element_index < static_cast<double>(count)))
        sparse_indices->fail(fmt::format("have {}, beyond the accessor", element_index));
      copy(from, i, all[static_cast<size_t>(element_index)]);
    }
  }
  if (!supplied_.contains(index)) check_range(accessor, all, components);
  return all;
}

// Refuses a stride: data other than vertex attributes must be packed, and some readers ignore a stride.
void GltfBuffers::refuse_stride(const GltfObject& owner, size_t views) const {
  const auto view = owner.index("bufferView", views);
  if (!view) return;
  const GltfObject source = document_.element("bufferViews", *view);
  if (source.has("byteStride") && !meshopt_coding(source))
    owner.fail(fmt::format(
        "is in bufferViews[{}], which has a byteStride: only attributes of vertices may have one", *view));
}

std::vector<Vec2> GltfBuffers::vec2(size_t accessor) {
  return read<Vec2>(accessor, "VEC2", 2);
}
std::vector<Vec3> GltfBuffers::vec3(size_t accessor) {
  return read<Vec3>(accessor, "VEC3", 3);
}
std::vector<Vec4> GltfBuffers::vec4(size_t accessor) {
  return read<Vec4>(accessor, "VEC4", 4);
}
std::vector<Mat4> GltfBuffers::mat4(size_t accessor) {
  refuse_stride(document_.element("accessors", accessor), document_.size("bufferViews"));
  return read<Mat4>(accessor, "MAT4", 16);
}
std::vector<double> GltfBuffers::numbers(size_t accessor, std::string_view type) {
  refuse_stride(document_.element("accessors", accessor), document_.size("bufferViews"));
  std::vector<double> all;
  const auto add = [&](const auto& elements, size_t components) {
    for (const auto& element : elements)
      for (size_t k = 0; k < components; ++k) all.push_back(component_of(element, k));
  };
  if (type == "VEC4") {
    add(vec4(accessor), 4);
  } else if (type == "VEC3") {
    add(vec3(accessor), 3);
  } else {
    add(read<double>(accessor, type, 1), 1);
  }
  return all;
}
std::vector<Vec4> GltfBuffers::colors(size_t accessor) {
  if (document_.element("accessors", accessor).text("type") == "VEC4") return vec4(accessor);
  std::vector<Vec4> all;
  for (const Vec3& color : vec3(accessor)) all.emplace_back(color, 1.0);
  return all;
}
std::vector<uint32_t> GltfBuffers::indices(size_t accessor) {
  const GltfObject source = document_.element("accessors", accessor);
  const uint64_t type = source.count("componentType", 0);
  if (type != unsigned_byte && type != unsigned_short && type != unsigned_int)
    source.fail("contains indices, which must be unsigned integers");
  if (source.flag("normalized")) source.fail("contains indices, which cannot be normalized");
  refuse_stride(source, document_.size("bufferViews"));
  std::vector<uint32_t> all = read<uint32_t>(accessor, "SCALAR", 1);
  const uint64_t restart = (uint64_t{1} << 8 * bytes_of(type)) - 1;
  if (std::ranges::find(all, restart) != all.end())
    breaches_.add("indices that begin a new strip in other readers, read as those of vertices",
                  source.location());
  return all;
}

}  // namespace eyeray::engine::importers
