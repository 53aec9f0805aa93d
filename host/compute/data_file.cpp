#include "host/compute/data_file.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cstring>

#include "host/compute/npy.hpp"
#include "host/compute/picture_file.hpp"
#include "host/core/atomic_file.hpp"
#include "host/core/error.hpp"
#include "host/core/input_file.hpp"

namespace fs = std::filesystem;

namespace eyeray::engine::compute {
namespace {

constexpr size_t most_data_bytes = size_t{1} << 32;

// Bytes of a value's numbers without padding.
uint64_t packed_size(const Type& type) {
  if (type.form == Form::number) return type.number.bytes();
  uint64_t bytes = type.element ? type.count * packed_size(*type.element) : 0;
  for (const Member& member : type.members) bytes += packed_size(*member.type);
  return bytes;
}

std::string packed(const Type& type, std::span<const std::byte> bytes) {
  std::string text(packed_size(type), '\0');
  char* to = text.data();
  for_each_number(type, 0, [&](const Number& number, uint64_t offset) {
    std::memcpy(to, bytes.data() + offset, number.bytes());
    to += number.bytes();
  });
  return text;
}

std::vector<std::byte> unpacked(const Type& type, std::string_view text) {
  std::vector<std::byte> bytes(size(type));
  const char* from = text.data();
  for_each_number(type, 0, [&](const Number& number, uint64_t offset) {
    std::memcpy(bytes.data() + offset, from, number.bytes());
    from += number.bytes();
  });
  return bytes;
}

// "4096 bytes, or 16 and 12 for each element of 'data'".
std::string needs(const Type& block, uint64_t fixed, uint64_t each, std::string_view of) {
  const Member* const array = run_time_array(block);
  if (!array) return fmt::format("{} {}", fixed, of);
  return fixed == 0 ? fmt::format("{} {} for each element of '{}'", each, of, array->name)
                    : fmt::format("{} {}, and {} for each element of '{}'", fixed, of, each, array->name);
}

// Gives the block as many elements as `all` bytes have. `fixed` and `each`: the bytes in front of the array,
// and those of an element.
void fit(TypePtr& block, const fs::path& file, uint64_t all, uint64_t fixed, uint64_t each,
         std::string_view of) {
  const bool grows = run_time_array(*block) != nullptr;
  const bool fits =
      grows ? all >= fixed && each > 0 && (all - fixed) % each == 0 && all > fixed : all == fixed;
  if (!fits)
    throw Error(ExitCode::bad_input, "{} has {} {}, but the buffer has {}", file.string(), all, of,
                needs(*block, fixed, each, of));
  if (grows) block = with_elements(block, (all - fixed) / each);
}

// Gives an image the extent of an array, which must be the image's own if it has one.
void fit_image(TypePtr& image, const fs::path& file, const std::vector<uint64_t>& shape) {
  const size_t axes = image->extent.size();
  const uint64_t components = count_numbers(*image->element);
  if (shape.size() != axes + (components > 1) || (components > 1 && shape.back() != components))
    throw Error(ExitCode::bad_input, "{} has an array of shape ({}), but the {} image needs {} ax{}s{}",
                file.string(), fmt::join(shape, ", "), image->name, axes, axes == 1 ? "i" : "e",
                components > 1 ? fmt::format(", slowest first, and then {} components", components) : "");
  const std::vector<uint64_t> extent(shape.rend() - ptrdiff_t(axes), shape.rend());
  if (image->count == 0)
    image = with_extent(*image, extent);
  else if (image->extent != extent)
    throw Error(ExitCode::bad_input, "{} has {} texels, but the image has {}", file.string(),
                fmt::join(extent, " × "), fmt::join(image->extent, " × "));
}

std::vector<std::byte> read_npy(const fs::path& file, const std::string& text, TypePtr& block) {
  const NpyArray array = parse_npy(text, file.string());
  // An array of the buffer's own type, or of its numbers alone.
  const NpyArray form = npy_form(*block);
  const std::optional<Number> number = only_number(*block);
  const auto with_sign = [](std::string descr) {
    std::ranges::replace(descr, 'u', 'i');
    return descr;
  };
  std::string numbers_descr;
  if (number) {
    Type one{.number = *number};
    numbers_descr = npy_form(one).descr;
  }
  if (array.descr != form.descr && with_sign(array.descr) != with_sign(numbers_descr))
    throw Error(ExitCode::bad_input, "{} has elements of type {}, but the buffer has {}: convert the array{}",
                file.string(), array.descr, form.descr,
                number ? fmt::format(" with .astype({})", numbers_descr) : ", or use a .bin file");
  if (is_image(*block)) fit_image(block, file, array.shape);
  const Member* const grows = run_time_array(*block);
  fit(block, file, array.bytes.size(), packed_size(*block), grows ? packed_size(*grows->type->element) : 0,
      "bytes of numbers");

  // The shape has to be that of the bytes.
  uint64_t elements = 1;
  const uint64_t least = number ? number->bytes() : 1;
  for (const uint64_t length : array.shape) {
    if (length > array.bytes.size() / least / std::max<uint64_t>(elements, 1)) elements = 0;
    elements *= length;
  }
  if (number && elements * number->bytes() != array.bytes.size())
    throw Error(ExitCode::file_io,
                "cannot read the array {}: it has {} bytes of numbers, and its shape is of another size",
                file.string(), array.bytes.size());
  return unpacked(*block, array.bytes);
}

std::vector<std::byte> read_bin(const fs::path& file, const std::string& text, TypePtr& block) {
  const Member* const array = run_time_array(*block);
  fit(block, file, text.size(), array ? array->offset : size(*block), array ? array->type->stride : 0,
      "bytes");
  const auto bytes = std::as_bytes(std::span(text));
  return {bytes.begin(), bytes.end()};
}

std::string csv(const Type& block, std::span<const std::byte> bytes) {
  const Type& whole = unwrapped(block);
  const bool rows = whole.form == Form::array;
  const Type& element = rows ? *whole.element : whole;
  std::string text;
  const auto end_cell = [&](uint64_t offset, uint64_t last) { text += offset == last ? '\n' : ','; };
  uint64_t last = 0;
  for_each_number(element, 0, [&](const Number&, uint64_t offset) { last = offset; });
  for_each_number(element, 0, [&](const Number&, uint64_t offset) {
    const std::string path = path_of(element, offset);
    text += path.empty() ? "value" : path.substr(path[0] == '.' ? 1 : 0);
    end_cell(offset, last);
  });
  for (uint64_t i = 0; i < (rows ? whole.count : 1); ++i)
    for_each_number(element, 0, [&](const Number& number, uint64_t offset) {
      text += show_number(number, bytes.data() + i * whole.stride + offset);
      end_cell(offset, last);
    });
  return text;
}

}  // namespace

void check_output(const fs::path& file, const Type& block, uint64_t width) {
  const fs::path ending = file.extension();
  if (ending == ".npy" || ending == ".bin" || ending == ".csv") return;
  if (!is_picture(file))
    throw Error(ExitCode::bad_input, "{}: its ending must be .npy, .bin, .csv, .png, .pfm, .hdr or .exr",
                file.string());
  check_picture(file, block, width);
}

bool decides_extent(const fs::path& file, const Type& image) {
  return file.extension() == ".npy" || (is_picture(file) && image.extent.size() == 2);
}

std::vector<std::byte> read_block(const fs::path& file, TypePtr& block) {
  if (is_picture(file)) return read_picture(file, block);
  const fs::path ending = file.extension();
  if (ending != ".npy" && ending != ".bin")
    throw Error(ExitCode::bad_input, "{}: its ending must be .npy, .bin, .png, .pfm, .hdr or .exr",
                file.string());
  const std::string text = read_input_file(file, "the data", most_data_bytes);
  return ending == ".npy" ? read_npy(file, text, block) : read_bin(file, text, block);
}

void write_block(const fs::path& file, const Type& block, std::span<const std::byte> bytes, uint64_t width) {
  const fs::path ending = file.extension();
  if (is_picture(file)) return write_picture(file, block, bytes, width);
  if (ending == ".bin") return write_file_atomically(file, bytes);
  if (ending == ".csv") return write_file_atomically(file, csv(block, bytes));
  NpyArray array = npy_form(block);
  const std::string numbers = packed(block, bytes);
  array.bytes = numbers;
  write_file_atomically(file, write_npy(array));
}

}  // namespace eyeray::engine::compute
