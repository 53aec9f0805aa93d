// Reads the .glb container, and the data outside it that URIs name.
#include <array>
#include <cstring>

#include "host/importers/gltf_buffers.hpp"
#include "host/importers/malformed.hpp"

namespace eyeray::engine::importers {

namespace {

constexpr uint32_t magic = 0x46546c67;         // "glTF"
constexpr uint32_t json_chunk = 0x4e4f534a;    // "JSON"
constexpr uint32_t binary_chunk = 0x004e4942;  // "BIN"

// A little-endian number of 32 bits; the caller has checked that the bytes have it.
uint32_t word(std::string_view bytes, size_t at) {
  uint32_t value = 0;
  for (size_t i = 4; i-- > 0;) value = value << 8 | static_cast<unsigned char>(bytes[at + i]);
  return value;
}

int hex(char c) {
  if (c >= '0' && c <= '9') return c - '0';
  if (c >= 'a' && c <= 'f') return c - 'a' + 10;
  return c >= 'A' && c <= 'F' ? c - 'A' + 10 : -1;
}

// The decoded bytes; nothing if the text is not base64 (RFC 4648). The padding at the end may be missing.
std::optional<std::string> decode_base64(std::string_view text) {
  constexpr std::string_view digits = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  static const std::array<int8_t, 256> values = [&] {
    std::array<int8_t, 256> all;
    all.fill(-1);
    for (size_t i = 0; i < digits.size(); ++i)
      all[static_cast<unsigned char>(digits[i])] = static_cast<int8_t>(i);
    return all;
  }();
  while (text.ends_with('=')) text.remove_suffix(1);
  std::string bytes;
  bytes.reserve(text.size() / 4 * 3 + 3);
  uint32_t bits = 0;
  int count = 0;
  for (const char c : text) {
    const int8_t value = values[static_cast<unsigned char>(c)];
    if (value < 0) return std::nullopt;
    bits = bits << 6 | static_cast<uint32_t>(value);
    count += 6;
    if (count < 8) continue;
    count -= 8;
    bytes += static_cast<char>(bits >> count & 0xff);
  }
  return bytes;
}

}  // namespace

GltfContainer open_gltf(std::string_view bytes, const std::string& file) {
  if (bytes.size() < 4 || word(bytes, 0) != magic) return {bytes, {}, {}};
  if (bytes.size() < 12) throw malformed(file, "the file ends too early");
  if (word(bytes, 4) != 2) throw malformed(file, fmt::format("it must be glTF 2, not {}", word(bytes, 4)));

  // Find the chunks: JSON first, then perhaps binary data. Further chunks are ignored.
  std::optional<std::string_view> json;
  std::optional<std::string_view> binary;
  std::vector<std::string> breaches;
  if (word(bytes, 8) != bytes.size()) breaches.emplace_back("lengths of .glb that are not the file's");
  bytes = bytes.substr(0, word(bytes, 8));
  size_t at = 12;
  for (size_t chunks = 0; at + 8 <= bytes.size(); ++chunks) {
    const uint32_t length = word(bytes, at);
    const uint32_t type = word(bytes, at + 4);
    at += 8;
    if (length > bytes.size() - at) throw malformed(file, "the file ends too early");
    if (length % 4 != 0) breaches.emplace_back("chunks of .glb whose length is not a multiple of 4");
    if (!json && type != json_chunk) throw malformed(file, "its first chunk is not JSON");
    if (!json) {
      json = bytes.substr(at, length);
    } else if (type == binary_chunk && !binary) {
      binary = bytes.substr(at, length);
      if (chunks != 1) breaches.emplace_back("binary chunks of .glb that are not the second chunk");
    } else if (type == json_chunk || type == binary_chunk) {
      breaches.emplace_back("second chunks of a type in .glb, left out");
    } else {
      breaches.emplace_back("chunks of .glb of a type that glTF does not define, left out");
    }
    at += length;
  }
  if (at < bytes.size()) breaches.emplace_back("bytes after the last chunk of .glb, left out");
  if (!json) throw malformed(file, "the file ends too early");
  return {*json, binary, std::move(breaches)};
}

std::string decode_uri(std::string_view uri) {
  std::string name;
  for (size_t i = 0; i < uri.size(); ++i) {
    const bool coded = uri[i] == '%' && i + 2 < uri.size() && hex(uri[i + 1]) >= 0 && hex(uri[i + 2]) >= 0;
    name += coded ? static_cast<char>(hex(uri[i + 1]) * 16 + hex(uri[i + 2])) : uri[i];
    if (coded) i += 2;
  }
  return name;
}

std::string GltfBuffers::read_uri(const GltfObject& owner, std::string_view what) {
  const std::string uri = owner.text("uri");
  if (!uri.starts_with("data:")) return assets_.read(decode_uri(uri), what);
  constexpr std::string_view coding = ";base64,";
  const size_t data = uri.find(coding);
  auto bytes = data == std::string::npos ? std::nullopt
                                         : decode_base64(std::string_view(uri).substr(data + coding.size()));
  if (!bytes) owner.fail("has a data URI that is not base64");
  return std::move(*bytes);
}

}  // namespace eyeray::engine::importers
