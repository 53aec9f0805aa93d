#include "host/compute/npy.hpp"

#include <fmt/ranges.h>

#include <charconv>

#include "host/core/error.hpp"
#include "host/core/text_scanner.hpp"

namespace eyeray::engine::compute {
namespace {

constexpr std::string_view magic = "\x93NUMPY";

// The header's text without white space outside of strings, which no name of a field has.
std::string without_spaces(std::string_view text) {
  std::string result;
  for (const char c : text)
    if (c != ' ' && c != '\n') result += c;
  return result;
}

// The value of a key in the header, up to the comma that ends it.
std::string value_of(const std::string& header, const std::string& key) {
  const size_t at = header.find("'" + key + "':");
  if (at == std::string::npos) return "";
  const size_t begin = at + key.size() + 3;
  size_t end = begin;
  for (int depth = 0; end < header.size(); ++end) {
    const char c = header[end];
    depth += c == '(' || c == '[';
    depth -= c == ')' || c == ']';
    if (depth == 0 && (c == ',' || c == '}')) break;
  }
  return header.substr(begin, end - begin);
}

std::vector<uint64_t> shape_of(const std::string& text, const auto& fail) {
  if (text.size() < 2 || text.front() != '(' || text.back() != ')') fail("its header has no shape");
  std::vector<uint64_t> shape;
  const char* at = text.data() + 1;
  const char* const end = text.data() + text.size() - 1;
  while (at < end) {
    uint64_t length = 0;
    const auto [next, error] = std::from_chars(at, end, length);
    if (error != std::errc() || (next != end && *next != ',')) fail("its shape is no list of whole numbers");
    shape.push_back(length);
    at = next + 1;
  }
  return shape;
}

std::string code_of(const Number& number) {
  const char kind = number.kind == NumberKind::real             ? 'f'
                    : number.kind == NumberKind::signed_integer ? 'i'
                                                                : 'u';
  return fmt::format("'{}{}{}'", number.bits == 8 ? '|' : '<', kind, number.bytes());
}

std::string shape_text(const std::vector<uint64_t>& shape) {
  return shape.size() == 1 ? fmt::format("({},)", shape[0]) : fmt::format("({})", fmt::join(shape, ","));
}

// Appends the lengths of arrays, vectors and matrices to the shape; returns the type of their elements.
const Type& take_lengths(const Type& type, std::vector<uint64_t>& shape) {
  const Type* inner = &type;
  for (; inner->element; inner = inner->element.get()) {
    if (is_image(*inner))
      shape.insert(shape.end(), inner->extent.rbegin(), inner->extent.rend());
    else
      shape.push_back(inner->count);
  }
  return *inner;
}

std::string descr_of(const Type& type) {
  if (type.form == Form::number) return code_of(type.number);
  std::string text;
  for (const Member& member : type.members) {
    std::vector<uint64_t> shape;
    const std::string inner = descr_of(take_lengths(*member.type, shape));
    text += fmt::format("{}('{}',{}{})", text.empty() ? "" : ",", member.name, inner,
                        shape.empty() ? "" : "," + shape_text(shape));
  }
  return "[" + text + "]";
}

}  // namespace

NpyArray parse_npy(std::string_view file, const std::string& name) {
  const auto fail = [&](const std::string& why) {
    throw Error(ExitCode::file_io, "cannot read the array {}: {}", name, why);
  };
  if (!file.starts_with(magic) || file.size() < 10) fail("it is no .npy file of NumPy");
  const auto byte = [&](size_t i) { return size_t{uint8_t(file[i])}; };
  const size_t version = byte(6), start = version == 1 ? 10 : 12;
  if (version < 1 || version > 3) fail(fmt::format("version {} of .npy files is unknown", version));
  if (file.size() < start) fail("it ends in its header");
  const size_t length = byte(8) | byte(9) << 8 | (version == 1 ? 0 : byte(10) << 16 | byte(11) << 24);
  if (file.size() - start < length) fail("it ends in its header");
  const std::string header = without_spaces(file.substr(start, length));

  NpyArray array{.descr = value_of(header, "descr"), .shape = {}, .bytes = file.substr(start + length)};
  if (array.descr.empty()) fail("its header has no data type");
  if (value_of(header, "fortran_order") != "False")
    fail("its elements are in Fortran's order: write it with numpy.ascontiguousarray");
  if (array.descr.find('>') != std::string::npos)
    fail("its numbers are big-endian: convert it with .astype(array.dtype.newbyteorder('<'))");
  array.shape = shape_of(value_of(header, "shape"), fail);
  return array;
}

std::string write_npy(const NpyArray& array) {
  std::string header = fmt::format("{{'descr': {}, 'fortran_order': False, 'shape': {}, }}", array.descr,
                                   shape_text(array.shape));
  // The elements begin at a multiple of 64 bytes.
  while ((12 + header.size() + 1) % 64 != 0) header += ' ';
  header += '\n';
  std::string file(magic);
  file += '\x02';
  file += '\0';
  for (int shift = 0; shift < 32; shift += 8) file += char(header.size() >> shift & 255);
  file += header;
  file += array.bytes;
  return file;
}

NpyArray npy_form(const Type& type) {
  NpyArray form;
  form.descr = descr_of(take_lengths(unwrapped(type), form.shape));
  return form;
}

}  // namespace eyeray::engine::compute
