#include "host/image/exr_header.hpp"

#include <algorithm>
#include <cstdint>
#include <cstring>
#include <iterator>
#include <optional>

namespace eyeray::engine::image {

namespace {

struct FixedType {
  std::string_view name;
  uint32_t bytes;
};
constexpr FixedType fixed_types[] = {
    {"box2f", 16},
    {"box2i", 16},
    {"chromaticities", 32},
    {"compression", 1},
    {"deepImageState", 1},
    {"double", 8},
    {"envmap", 1},
    {"float", 4},
    {"int", 4},
    {"keycode", 28},
    {"m33d", 72},
    {"m33f", 36},
    {"m44d", 128},
    {"m44f", 64},
    {"lineOrder", 1},
    {"v2d", 16},
    {"rational", 8},
    {"tiledesc", 9},
    {"timecode", 8},
    {"v2f", 8},
    {"v2i", 8},
    {"v3d", 24},
    {"v3f", 12},
    {"v3i", 12},
};

// Takes values from the front of the bytes; each is empty if too few bytes are left.
class Reader {
 public:
  explicit Reader(std::string_view bytes) : rest_(bytes) {}

  bool empty() const { return rest_.empty(); }
  std::optional<std::string_view> take(size_t count) {
    if (count > rest_.size()) return std::nullopt;
    const std::string_view taken = rest_.substr(0, count);
    rest_.remove_prefix(count);
    return taken;
  }
  std::optional<uint32_t> number() {
    const auto bytes = take(sizeof(uint32_t));
    if (!bytes) return std::nullopt;
    uint32_t value = 0;
    std::memcpy(&value, bytes->data(), sizeof value);
    return value;
  }
  // Takes the bytes up to a zero, and the zero.
  std::optional<std::string_view> name() {
    const size_t end = rest_.find('\0');
    if (end == std::string_view::npos) return std::nullopt;
    const auto taken = take(end);
    take(1);
    return taken;
  }

 private:
  std::string_view rest_;
};

bool sound_channels(Reader value) {
  constexpr size_t after_name = 16;
  while (true) {
    const auto name = value.name();
    if (!name) return false;
    if (name->empty()) return value.empty();
    if (!value.take(after_name)) return false;
  }
}

bool sound_strings(Reader value) {
  while (!value.empty()) {
    const auto length = value.number();
    if (!length || !value.take(*length)) return false;
  }
  return true;
}

bool sound_preview(Reader value) {
  const auto width = value.number(), height = value.number();
  if (!width || !height || *width > 65536 || *height > 65536) return false;
  return value.take(size_t{4} * *width * *height) && value.empty();
}

bool sound(std::string_view type, std::string_view value) {
  if (type == "chlist") return sound_channels(Reader(value));
  if (type == "stringvector") return sound_strings(Reader(value));
  if (type == "preview") return sound_preview(Reader(value));
  if (type == "idmanifest") return value.size() >= 4;
  const FixedType* fixed = std::ranges::find(fixed_types, type, &FixedType::name);
  return fixed == std::end(fixed_types) || value.size() == fixed->bytes;
}

// Attributes without which a header has no meaning. OpenEXR takes values of its own in their place.
constexpr std::string_view required[] = {"channels", "dataWindow", "displayWindow"};

// Takes one header. Returns nothing if it is not sound, false if it is empty: an empty header ends the
// headers of parts.
std::optional<bool> take_header(Reader& reader) {
  size_t required_seen = 0;
  for (bool any = false;; any = true) {
    const auto name = reader.name();
    if (!name) return std::nullopt;
    if (name->empty()) return any && required_seen < std::size(required) ? std::nullopt : std::optional(any);
    required_seen += size_t(std::ranges::count(required, *name));
    const auto type = reader.name();
    const auto size = reader.number();
    if (!type || !size) return std::nullopt;
    const auto value = reader.take(*size);
    if (!value || !sound(*type, *value)) return std::nullopt;
  }
}

}  // namespace

bool exr_header_sound(std::string_view bytes) {
  constexpr uint32_t magic = 20000630, has_parts = 0x1000;
  Reader reader(bytes);
  if (reader.number() != magic) return false;
  const auto version = reader.number();
  if (!version) return false;
  std::optional<bool> any = take_header(reader);
  while (any == true && (*version & has_parts)) any = take_header(reader);
  return any.has_value();
}

}  // namespace eyeray::engine::image
