#include "host/importers/pcd_header.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <optional>

#include "host/importers/malformed.hpp"

namespace eyeray::engine::importers {

namespace {

// Limits on a header, so that the size of a point can be computed.
constexpr size_t most_fields = 1024;
constexpr uint32_t most_values_of_field = 1 << 20;

using Words = std::vector<std::string_view>;

class PcdHeaderReader {
 public:
  PcdHeaderReader(std::string_view bytes, const std::string& file) : bytes_(bytes), file_(file) {}

  PcdHeader read() {
    for (;;) {
      const Words words = next_line();
      if (words.empty() || words[0].starts_with('#')) continue;
      if (words[0] == "DATA") {
        read_data(words);
        break;
      }
      read_statement(words);
    }
    finish();
    return std::move(header_);
  }

 private:
  [[noreturn]] void fail(const std::string& message) const {
    throw malformed_at(file_, bytes_, start_, message);
  }

  Words next_line() {
    start_ = at_;
    const size_t end = bytes_.find('\n', at_);
    if (end == std::string_view::npos) {
      if (names_.empty() && sizes_.empty()) fail("this is not a PCD file: it has no header");
      fail("the header ends without `DATA`");
    }
    at_ = end + 1;
    const std::string_view line = bytes_.substr(start_, end - start_);
    Words words;
    for (size_t at = 0; (at = line.find_first_not_of(" \t\r", at)) != std::string_view::npos;) {
      const size_t stop = std::min(line.find_first_of(" \t\r", at), line.size());
      words.push_back(line.substr(at, stop - at));
      at = stop;
    }
    if (words.size() > most_fields + 1) fail(fmt::format("a PCD has at most {} fields", most_fields));
    return words;
  }

  uint64_t number(std::string_view word) const {
    uint64_t value = 0;
    const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), value);
    if (error != std::errc() || end != word.data() + word.size())
      fail(fmt::format("`{}` is not a whole number", word));
    return value;
  }

  // The one number of a statement such as WIDTH.
  uint64_t only_number(const Words& words) const {
    if (words.size() != 2) fail(fmt::format("write {} and a number", words[0]));
    return number(words[1]);
  }

  void read_statement(const Words& words) {
    const std::string_view name = words[0];
    if (name == "VERSION") return;
    if (name == "FIELDS" || name == "COLUMNS") {
      names_.assign(words.begin() + 1, words.end());
    } else if (name == "SIZE") {
      sizes_.clear();
      for (size_t i = 1; i < words.size(); ++i) sizes_.push_back(number(words[i]));
    } else if (name == "TYPE") {
      types_.assign(words.begin() + 1, words.end());
    } else if (name == "COUNT") {
      counts_.clear();
      for (size_t i = 1; i < words.size(); ++i) counts_.push_back(number(words[i]));
    } else if (name == "WIDTH") {
      width_ = only_number(words);
    } else if (name == "HEIGHT") {
      height_ = only_number(words);
    } else if (name == "VIEWPOINT") {
      const Words rest{"VIEWPOINT", "0", "0", "0", "1", "0", "0", "0"};
      header_.has_pose = words != rest;
    } else if (name == "POINTS") {
      points_ = only_number(words);
    } else {
      fail(fmt::format("`{}` is not a statement of a PCD header", name));
    }
  }

  void read_data(const Words& words) {
    constexpr std::pair<std::string_view, PcdData> forms[] = {
        {"ascii", PcdData::ascii}, {"binary", PcdData::binary}, {"binary_compressed", PcdData::compressed}};
    for (const auto& [name, data] : forms) {
      if (words.size() != 2 || words[1] != name) continue;
      header_.data = data;
      header_.size = at_;
      return;
    }
    fail("write DATA ascii, binary or binary_compressed");
  }

  PlyType type(std::string_view letter, uint64_t bytes) const {
    constexpr PlyType integers[] = {PlyType::int8, PlyType::int16, PlyType::int32};
    constexpr PlyType naturals[] = {PlyType::uint8, PlyType::uint16, PlyType::uint32};
    const size_t which = bytes == 1 ? 0 : bytes == 2 ? 1 : 2;
    if (letter == "F" && bytes == 4) return PlyType::float32;
    if (letter == "F" && bytes == 8) return PlyType::float64;
    if (letter == "I" && (bytes == 1 || bytes == 2 || bytes == 4)) return integers[which];
    if (letter == "U" && (bytes == 1 || bytes == 2 || bytes == 4)) return naturals[which];
    fail(fmt::format("a field of type {} and of {} bytes is not supported", letter, bytes));
  }

  // Joins the statements, now that all are read.
  void finish() {
    if (names_.empty()) fail("the header has no FIELDS");
    const size_t count = names_.size();
    if (counts_.empty()) counts_.assign(count, 1);
    for (const auto& [name, given] : {std::pair("SIZE", sizes_.size()), std::pair("TYPE", types_.size()),
                                      std::pair("COUNT", counts_.size())})
      if (given != count) fail(fmt::format("there are {} FIELDS, but {} values of {}", count, given, name));
    for (size_t i = 0; i < count; ++i) {
      if (counts_[i] > most_values_of_field)
        fail(fmt::format("a field of {} values; at most {} are possible", counts_[i], most_values_of_field));
      const PcdField field{std::string(names_[i]), type(types_[i], sizes_[i]),
                           static_cast<uint32_t>(counts_[i]), header_.point_bytes};
      header_.point_bytes += size_of(field.type) * field.count;
      header_.point_values += field.count;
      header_.fields.push_back(field);
    }
    if (!points_ && !width_) fail("the header states no number of POINTS");
    const uint64_t rows = height_.value_or(1);
    const uint64_t most = ~uint64_t{0};
    if (width_ && rows > 0 && *width_ > most / rows)
      fail(fmt::format("WIDTH {} times HEIGHT {} is no number of points", *width_, rows));
    header_.points = points_.value_or(width_.value_or(0) * rows);
    if (points_ && width_ && *width_ * rows != *points_)
      fail(fmt::format("{} POINTS differ from WIDTH {} times HEIGHT {}", *points_, *width_, rows));
  }

  std::string_view bytes_;
  const std::string& file_;
  size_t at_ = 0;
  size_t start_ = 0;  // the beginning of the last line read
  Words names_, types_;
  std::vector<uint64_t> sizes_, counts_;
  std::optional<uint64_t> width_, height_, points_;
  PcdHeader header_ = {};
};

}  // namespace

const PcdField* PcdHeader::find(std::string_view name) const {
  const auto found = std::ranges::find(fields, name, &PcdField::name);
  return found == fields.end() ? nullptr : &*found;
}

PcdHeader read_pcd_header(std::string_view bytes, const std::string& file) {
  return PcdHeaderReader(bytes, file).read();
}

}  // namespace eyeray::engine::importers
