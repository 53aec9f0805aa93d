#include "host/importers/gltf_meshopt.hpp"

#include <fmt/format.h>
#include <meshoptimizer.h>

#include <algorithm>

namespace eyeray::engine::importers {

namespace {

struct Coding {
  std::string mode;
  std::string filter;
  uint64_t count;
  uint64_t stride;
};

constexpr uint64_t divide_up(uint64_t a, uint64_t b) {
  return (a + b - 1) / b;
}

// The fewest bytes that can encode the elements of `coding`.
uint64_t least_bytes(const Coding& coding) {
  if (coding.mode == "TRIANGLES") return 1 + coding.count / 3 + 16;
  if (coding.mode == "INDICES") return 1 + coding.count + 4;
  // In each block, each byte of an element takes at least two bits for every 16 elements.
  const uint64_t block = std::min<uint64_t>(8192 / coding.stride & ~uint64_t{15}, 256);
  const auto bytes = [](uint64_t elements) { return divide_up(divide_up(elements, 16), 4); };
  const uint64_t blocks = coding.count / block * bytes(block) + bytes(coding.count % block);
  return 1 + coding.stride * blocks + std::max<uint64_t>(32, coding.stride);
}

// Checks the values of the extension, including those that the library does not check.
void check(const GltfObject& view, const GltfObject& object, const Coding& coding) {
  const bool attributes = coding.mode == "ATTRIBUTES";
  const uint64_t stride = coding.stride;
  if (!attributes && coding.mode != "TRIANGLES" && coding.mode != "INDICES")
    object.fail(fmt::format("has the mode \"{}\", which eyeray does not support", coding.mode));
  const bool right_stride =
      attributes ? stride % 4 == 0 && stride > 0 && stride <= 256 : stride == 2 || stride == 4;
  if (!right_stride)
    object.fail(fmt::format("has a byteStride of {}, which {} cannot have", stride, coding.mode));
  if (coding.mode == "TRIANGLES" && coding.count % 3 != 0)
    object.fail(fmt::format("has a count of {}, which must be a multiple of three", coding.count));

  const bool known = coding.filter == "NONE" || coding.filter == "OCTAHEDRAL" ||
                     coding.filter == "QUATERNION" || coding.filter == "EXPONENTIAL";
  if (!known) object.fail(fmt::format("has the filter \"{}\", which eyeray does not support", coding.filter));
  const bool right_filter =
      coding.filter == "NONE" || (attributes && (coding.filter == "EXPONENTIAL" || stride == 8 ||
                                                 (coding.filter == "OCTAHEDRAL" && stride == 4)));
  if (!right_filter) {
    object.fail(fmt::format("has the filter {}, which {} with a byteStride of {} cannot have", coding.filter,
                            coding.mode, stride));
  }

  if (view.count("byteStride", stride) != stride) view.fail("has another byteStride than its decoded data");
  const uint64_t length = view.count("byteLength", 0);
  if (coding.count > length / stride || coding.count * stride != length) {
    view.fail(fmt::format("should have {} bytes, but is decoded to {} elements of {}", length, coding.count,
                          stride));
  }
}

// Checks the first byte, which contains the mode's number and a version.
void check_version(const GltfObject& object, const Coding& coding, std::string_view coded) {
  const bool attributes = coding.mode == "ATTRIBUTES";
  const int known = attributes ? 0 : 1;
  const int first = static_cast<unsigned char>(coded[0]);
  const int expected = attributes ? 0xa : coding.mode == "TRIANGLES" ? 0xe : 0xd;
  if (first >> 4 == expected && (first & 15) > known) {
    object.fail(fmt::format(
        "has data of version {} of {}; eyeray reads versions up to {}, those of EXT_meshopt_compression",
        first & 15, coding.mode, known));
  }
}

// Decodes the bytes; false if that fails.
bool decode(const Coding& coding, std::string_view coded, std::string& decoded) {
  const auto* bytes = reinterpret_cast<const unsigned char*>(coded.data());
  if (coding.mode == "TRIANGLES")
    return meshopt_decodeIndexBuffer(decoded.data(), coding.count, coding.stride, bytes, coded.size()) == 0;
  if (coding.mode == "INDICES")
    return meshopt_decodeIndexSequence(decoded.data(), coding.count, coding.stride, bytes, coded.size()) == 0;
  if (meshopt_decodeVertexBuffer(decoded.data(), coding.count, coding.stride, bytes, coded.size()) != 0)
    return false;
  if (coding.filter == "OCTAHEDRAL") meshopt_decodeFilterOct(decoded.data(), coding.count, coding.stride);
  if (coding.filter == "QUATERNION") meshopt_decodeFilterQuat(decoded.data(), coding.count, coding.stride);
  if (coding.filter == "EXPONENTIAL") meshopt_decodeFilterExp(decoded.data(), coding.count, coding.stride);
  return true;
}

}  // namespace

std::optional<GltfObject> meshopt_coding(const GltfObject& view) {
  if (auto coding = view.extension("EXT_meshopt_compression")) return coding;
  return view.extension("KHR_meshopt_compression");
}

std::string decode_meshopt(const GltfObject& view, const GltfObject& object, std::string_view coded) {
  const std::string filter = object.text("filter");
  const Coding coding{object.text("mode"), filter.empty() ? "NONE" : filter, object.count("count", 0),
                      object.count("byteStride", 0)};
  check(view, object, coding);
  if (coded.size() < least_bytes(coding)) {
    object.fail(fmt::format("has {} bytes, which cannot encode {} elements of {}", coded.size(), coding.count,
                            coding.stride));
  }
  check_version(object, coding, coded);
  std::string decoded(coding.count * coding.stride, '\0');
  if (!decode(coding, coded, decoded))
    object.fail(fmt::format("has data that are damaged: they are not {}", coding.mode));
  return decoded;
}

}  // namespace eyeray::engine::importers
