#include "host/importers/ply_header.hpp"

#include <algorithm>
#include <charconv>

#include "host/importers/malformed.hpp"

namespace eyeray::engine::importers {

namespace {

constexpr size_t sizes[] = {1, 1, 2, 2, 4, 4, 4, 8};

// The names of types, in both generations of the format.
constexpr std::pair<std::string_view, PlyType> type_names[] = {
    {"char", PlyType::int8},       {"int8", PlyType::int8},       {"uchar", PlyType::uint8},
    {"uint8", PlyType::uint8},     {"short", PlyType::int16},     {"int16", PlyType::int16},
    {"ushort", PlyType::uint16},   {"uint16", PlyType::uint16},   {"int", PlyType::int32},
    {"int32", PlyType::int32},     {"uint", PlyType::uint32},     {"uint32", PlyType::uint32},
    {"float", PlyType::float32},   {"float32", PlyType::float32}, {"double", PlyType::float64},
    {"float64", PlyType::float64},
};

std::vector<std::string_view> split(std::string_view line) {
  std::vector<std::string_view> words;
  for (size_t at = 0; (at = line.find_first_not_of(" \t\r", at)) != std::string_view::npos;) {
    const size_t end = std::min(line.find_first_of(" \t\r", at), line.size());
    words.push_back(line.substr(at, end - at));
    at = end;
  }
  return words;
}

// True for `TextureFile`, in any case.
bool is_texture_file(std::string_view word) {
  return std::ranges::equal(word, std::string_view("texturefile"),
                            [](char a, char b) { return a == b || a == b - 32; });
}

class HeaderReader {
 public:
  HeaderReader(std::string_view bytes, const std::string& file) : bytes_(bytes), file_(file) {
    // The first line shows how lines end: a LF after the header's last CR may be binary data.
    const size_t end = bytes.find_first_of("\r\n");
    if (end != std::string_view::npos && !bytes.substr(end).starts_with("\r\n")) line_break_ = bytes[end];
  }

  PlyHeader read() {
    if (next_line() != std::vector<std::string_view>{"ply"})
      fail("this is not a PLY file: it does not start with `ply`");
    for (;;) {
      const std::vector<std::string_view> words = next_line();
      if (words.size() > 2 && (words[0] == "comment" || words[0] == "obj_info") &&
          is_texture_file(words[1])) {
        // A picture's name may contain blanks.
        const std::string_view last = words.back();
        header_.pictures.emplace_back(words[2].data(), last.data() + last.size());
      }
      if (words.empty() || words[0] == "comment" || words[0] == "obj_info") continue;
      if (words[0] == "end_header") break;
      if (words[0] == "format") {
        read_format(words);
      } else if (words[0] == "element") {
        read_element(words);
      } else if (words[0] == "property") {
        read_property(words);
      } else {
        fail(fmt::format("`{}` is not a statement of a PLY header", words[0]));
      }
    }
    if (!formatted_) fail("the header has no `format`");
    header_.size = at_;
    return std::move(header_);
  }

 private:
  [[noreturn]] void fail(const std::string& message) const {
    throw malformed_at(file_, bytes_, start_, message);
  }

  std::vector<std::string_view> next_line() {
    start_ = at_;
    const size_t end = bytes_.find(line_break_, at_);
    if (end == std::string_view::npos) fail("the header ends without `end_header`");
    at_ = end + 1;
    return split(bytes_.substr(start_, end - start_));
  }

  void read_format(const std::vector<std::string_view>& words) {
    constexpr std::pair<std::string_view, PlyFormat> names[] = {
        {"ascii", PlyFormat::ascii},
        {"binary_little_endian", PlyFormat::little_endian},
        {"binary_big_endian", PlyFormat::big_endian}};
    for (const auto& [name, format] : names) {
      if (words.size() != 3 || words[1] != name || words[2] != "1.0") continue;
      header_.format = format;
      formatted_ = true;
      return;
    }
    fail("write format ascii, binary_little_endian or binary_big_endian, and 1.0");
  }

  void read_element(const std::vector<std::string_view>& words) {
    if (words.size() != 3) fail("write element NAME COUNT");
    PlyElement element{std::string(words[1]), 0, {}};
    const std::string_view number = words[2];
    const auto [end, error] = std::from_chars(number.data(), number.data() + number.size(), element.count);
    if (error != std::errc() || end != number.data() + number.size())
      fail(fmt::format("`{}` is not a number of elements", number));
    header_.elements.push_back(std::move(element));
  }

  void read_property(const std::vector<std::string_view>& words) {
    if (header_.elements.empty()) fail("a property must come after an element");
    std::vector<PlyProperty>& properties = header_.elements.back().properties;
    if (words.size() == 3) {
      properties.push_back({std::string(words[2]), type(words[1])});
    } else if (words.size() == 5 && words[1] == "list") {
      const PlyType length = type(words[2]);
      if (length >= PlyType::float32) fail("the length of a list must be an integer");
      properties.push_back({std::string(words[4]), type(words[3]), length});
    } else {
      fail("write property TYPE NAME, or property list TYPE TYPE NAME");
    }
  }

  PlyType type(std::string_view name) const {
    for (const auto& [known, type] : type_names) {
      if (known == name) return type;
    }
    fail(fmt::format("`{}` is not a type of PLY", name));
  }

  std::string_view bytes_;
  const std::string& file_;
  char line_break_ = '\n';
  size_t at_ = 0;
  size_t start_ = 0;  // the beginning of the last line read
  bool formatted_ = false;
  PlyHeader header_ = {};
};

}  // namespace

size_t size_of(PlyType type) {
  return sizes[static_cast<size_t>(type)];
}

size_t PlyElement::least_bytes(PlyFormat format) const {
  size_t bytes = 0;
  for (const PlyProperty& property : properties)
    bytes += format == PlyFormat::ascii ? 2 : size_of(property.list.value_or(property.type));
  return bytes;
}

bool PlyElement::has_lists() const {
  for (const PlyProperty& property : properties) {
    if (property.list) return true;
  }
  return false;
}

bool PlyHeader::has_faces() const {
  return std::ranges::any_of(elements, [](const PlyElement& element) {
    return element.count > 0 && (element.name == "face" || element.name == "tristrips");
  });
}

PlyHeader read_ply_header(std::string_view bytes, const std::string& file) {
  return HeaderReader(bytes, file).read();
}

}  // namespace eyeray::engine::importers
