// The types of data in a kernel's buffers, as its SPIR-V lays them out in memory, and in its images.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace eyeray::engine::compute {

enum class NumberKind : uint8_t { signed_integer, unsigned_integer, real };

struct Number {
  NumberKind kind = NumberKind::real;
  uint32_t bits = 32;  // 8, 16, 32 or 64
  bool operator==(const Number&) const = default;
  uint64_t bytes() const { return bits / 8; }
};

struct Type;
using TypePtr = std::shared_ptr<const Type>;

struct Member {
  std::string name;
  uint64_t offset = 0;  // bytes
  TypePtr type;
};

enum class Form : uint8_t { number, vector, matrix, array, structure };

struct Type {
  Form form = Form::number;
  Number number{};      // a number's kind
  TypePtr element{};    // a vector's number, a matrix's column, an array's element
  uint64_t count = 0;   // elements; an array with 0 of them has a run-time length
  uint64_t stride = 0;  // bytes between elements
  std::string name{};   // a structure's, or the format of an image
  std::vector<Member> members{};
  // Texels of an image along its axes, x first. It is an array of all of them. Axes of 0: not known yet.
  std::vector<uint64_t> extent{};
};

// The bytes that a buffer or an image may have.
constexpr uint64_t most_bytes = uint64_t{1} << 32;

inline bool is_image(const Type& type) {
  return !type.extent.empty();
}
// The image of so many texels along its axes. Error (bad_input) if that is more than most_bytes.
TypePtr with_extent(const Type& image, const std::vector<uint64_t>& extent);

// Bytes from the type's start to the end of its last number. A run-time array has none.
uint64_t size(const Type& type);
// The numbers in a value of the type.
uint64_t count_numbers(const Type& type);
// The kind of all its numbers; nothing if they are of several kinds.
std::optional<Number> only_number(const Type& type);

// The array of run-time length at the end of a block; null if there is none.
const Member* run_time_array(const Type& block);
// The block with that many elements in its run-time array.
TypePtr with_elements(const TypePtr& block, uint64_t elements);

// The member of a block of one member, and so on inwards; else the block itself.
const Type& unwrapped(const Type& block);

// "float", "uint16".
std::string describe(const Number& number);
// "vec4[16]", "Body[]", "float", "rgba8 image of 61 × 40".
std::string describe(const Type& type);
// The number at a byte of a value: ".bodies[3].position.y", "[3, 5].r". Empty if it is the whole value.
std::string path_of(const Type& type, uint64_t byte);

// Calls visit(number, offset) for every number of a value, in order.
template <typename Visit>
void for_each_number(const Type& type, uint64_t offset, const Visit& visit) {
  if (type.form == Form::number) return visit(type.number, offset);
  for (const Member& member : type.members) for_each_number(*member.type, offset + member.offset, visit);
  if (type.element)
    for (uint64_t i = 0; i < type.count; ++i) for_each_number(*type.element, offset + i * type.stride, visit);
}

// A number in memory as a double; a 64-bit integer may be rounded.
double read_number(const Number& number, const std::byte* at);
// Its shortest text that reads back the same.
std::string show_number(const Number& number, const std::byte* at);
// Writes a value. False if the number's kind does not hold it: an integer that is out of range or no integer.
// A real is rounded to nearest.
bool write_number(const Number& number, double value, std::byte* at);
bool write_number(const Number& number, int64_t value, std::byte* at);
// The distance of two numbers in units in the last place; of integers their difference. Two NaNs have none.
uint64_t distance(const Number& number, const std::byte* a, const std::byte* b);

}  // namespace eyeray::engine::compute
