#include <cmath>

#include "host/compute/interface.hpp"
#include "host/compute/npy.hpp"
#include "host/gpu/shader_compiler.hpp"
#include "support.hpp"

using namespace eyeray::engine;
using namespace eyeray::engine::test;

namespace {

std::vector<uint32_t> compile(const std::string& declarations) {
  return gpu::compile_shader({"k.comp", {{"k.comp", "#version 450\n" + declarations + "\nvoid main() {}\n"}}},
                             "")
      .spirv;
}

compute::TypePtr block(const std::string& declarations) {
  return compute::interface_of(compile(declarations)).buffers.at(0).type;
}

// The offsets of all numbers.
std::vector<uint64_t> offsets(const compute::Type& type) {
  std::vector<uint64_t> all;
  compute::for_each_number(type, 0, [&](const compute::Number&, uint64_t offset) { all.push_back(offset); });
  return all;
}

}  // namespace

TEST_CASE("numbers lie where std140 and std430 put them") {
  const std::string members = "{ float a; vec3 b; float c[2]; mat2 d; };";
  CHECK(offsets(*block("layout(std430, binding = 0) buffer B " + members)) ==
        std::vector<uint64_t>{0, 16, 20, 24, 28, 32, 40, 44, 48, 52});
  CHECK(offsets(*block("layout(std140, binding = 0) uniform B " + members)) ==
        std::vector<uint64_t>{0, 16, 20, 24, 32, 48, 64, 68, 80, 84});
  CHECK(offsets(*block("layout(std140, row_major, binding = 0) uniform B { mat3x2 m; };")) ==
        std::vector<uint64_t>{0, 16, 4, 20, 8, 24});
}

TEST_CASE("a number has a path and a type in the words of the kernel") {
  const compute::TypePtr type =
      compute::with_elements(block("struct Body { vec3 position; float mass; mat2 turn[2]; };\n"
                                   "layout(std430, binding = 0) buffer B { uint count; Body bodies[]; };"),
                             5);
  CHECK(compute::path_of(*type, 0) == ".count");
  CHECK(compute::path_of(*type, 16 + 48 + 4) == ".bodies[1].position.y");
  CHECK(compute::path_of(*type, 16 + 12) == ".bodies[0].mass");
  CHECK(compute::path_of(*type, 16 + 16 + 16 + 8 + 4) == ".bodies[0].turn[1][1].y");
  CHECK(compute::describe(*type->members[1].type) == "Body[5]");
  CHECK(compute::count_numbers(*type) == 1 + 5 * 12);
  CHECK(compute::size(*type) == 16 + 5 * 48);
  CHECK(compute::npy_form(*type).descr ==
        "[('count','<u4'),('bodies',[('position','<f4',(3,)),('mass','<f4'),('turn','<f4',(2,2,2))],(5,))]");
}

TEST_CASE("buffers have names, sets, bindings and directions") {
  const compute::Interface found = compute::interface_of(
      compile("layout(local_size_x = 4, local_size_y = 2) in;\n"
              "layout(std430, set = 1, binding = 0) readonly buffer In { uint a[]; } input_data;\n"
              "layout(std430, set = 0, binding = 7) writeonly buffer Out { uint b[]; };\n"
              "layout(std140, set = 0, binding = 2) uniform Sizes { uint n; };\n"
              "layout(push_constant) uniform Push { vec2 at; };"));
  REQUIRE(found.buffers.size() == 3);
  CHECK(found.buffers[0].name == "Sizes");
  CHECK(found.buffers[0].kind == gpu::BindingKind::uniform);
  CHECK_FALSE(found.buffers[0].writable);
  CHECK(found.buffers[1].name == "Out");
  CHECK_FALSE(found.buffers[1].readable);
  CHECK(found.buffers[1].writable);
  CHECK(found.buffers[2].name == "In");
  CHECK(found.buffers[2].variable == "input_data");
  CHECK(found.buffers[2].set == 1);
  CHECK_FALSE(found.buffers[2].writable);
  CHECK(found.local_size == std::array<uint32_t, 3>{4, 2, 1});
  CHECK(compute::size(*found.push) == 8);
}

TEST_CASE("numbers of all kinds are written and read") {
  using compute::Number;
  using compute::NumberKind;
  std::byte bytes[8] = {};
  const auto shown = [&](const Number& number, double value) {
    return compute::write_number(number, value, bytes) ? compute::show_number(number, bytes) : "no";
  };
  const Number half{NumberKind::real, 16}, byte{NumberKind::unsigned_integer, 8};
  const Number small{NumberKind::signed_integer, 16};
  CHECK(shown({NumberKind::real, 32}, 0.1) == "0.1");
  CHECK(shown({NumberKind::real, 64}, 0.1) == "0.1");
  CHECK(shown(half, 1.5) == "1.5");
  CHECK(shown(half, 65504) == "65504");
  CHECK(shown(half, 65520) == "inf");
  CHECK(shown(half, 0x1p-24) == fmt::format("{}", 0x1p-24));
  CHECK(shown(half, 2049) == "2048");  // to the even one
  CHECK(shown(half, 2047.75) == "2048");
  CHECK(shown(byte, 255) == "255");
  CHECK(shown(byte, 256) == "no");
  CHECK(shown(byte, -1) == "no");
  CHECK(shown(byte, 0.5) == "no");
  CHECK(shown(small, -32768) == "-32768");
  CHECK(shown(small, -32769) == "no");

  const auto apart = [](float a, float b) {
    return compute::distance({NumberKind::real, 32}, reinterpret_cast<std::byte*>(&a),
                             reinterpret_cast<std::byte*>(&b));
  };
  CHECK(apart(1, 1) == 0);
  CHECK(apart(1, std::nextafter(1.0f, 2.0f)) == 1);
  CHECK(apart(0, -0.0f) == 1);
  CHECK(apart(NAN, -NAN) == 0);
  CHECK(apart(NAN, 1) > 1000);
}
