#include "host/compute/data_file.hpp"
#include "support.hpp"

using namespace eyeray::engine;
using namespace eyeray::engine::test;

namespace {

const std::string tiles = "layout(local_size_x = 4, local_size_y = 4) in; ";

// Copies one image of 5 × 3 texels to another.
KernelFolder copying(const std::string& type, const std::string& format, const std::string& toml = "") {
  return KernelFolder(tiles + "layout(" + format + ", binding = 0) readonly uniform " + type +
                          " source; layout(" + format + ", binding = 1) writeonly uniform " + type +
                          " target;",
                      "const ivec2 at = ivec2(gl_GlobalInvocationID.xy); if (any(greaterThanEqual(at, "
                      "imageSize(source)))) return;\n"
                      "imageStore(target, at, imageLoad(source, at));",
                      "invocations = [5, 3]\n" + toml);
}
const std::string sizes = "[image.source]\nsize = [5, 3]\n[image.target]\nsize = [5, 3]\n";

std::string failures(const KernelFolder& folder, const std::vector<std::string>& overrides = {}) {
  std::string text;
  for (const std::string& each : folder.verified(overrides).failures()) text += each + "\n";
  return text;
}

}  // namespace

TEST_CASE("texels of every format are the same on the device and in the emulator") {
  for (const gpu::TexelFormat& format : gpu::texel_formats()) {
    using Kind = emulator::Format::Kind;
    const Kind kind = format.numbers.kind;
    CAPTURE(format.name);
    const KernelFolder folder = copying(kind == Kind::natural   ? "uimage2D"
                                        : kind == Kind::integer ? "iimage2D"
                                                                : "image2D",
                                        std::string(format.name), sizes);
    const compute::Job job = folder.job();
    REQUIRE(job.buffers[0].bytes.size() == 15 * format.numbers.bytes());
    const compute::Outcome device = compute::run(job, {}), emulated = folder.emulated();
    CHECK(emulated.findings.empty());
    CHECK(device.buffers[1] == job.buffers[0].bytes);
    CHECK(device.buffers == emulated.buffers);
  }
}

TEST_CASE("images have one to three axes, and layers") {
  struct Row {
    std::string declaration, at, read;
    std::vector<uint64_t> extent;
  };
  const Row rows[] = {
      {"layout(binding = 1, r32ui) uniform uimage1D t", "id.x", "imageLoad(t, at).x", {4}},
      {"layout(binding = 1, r32ui) uniform uimage3D t", "id", "imageLoad(t, at).x", {4, 4, 3}},
      {"layout(binding = 1, r32ui) uniform uimage1DArray t", "id.xy", "imageLoad(t, at).x", {4, 4}},
      {"layout(binding = 1, r32ui) uniform uimage2DArray t", "id", "imageLoad(t, at).x", {4, 4, 3}},
      {"layout(binding = 1) uniform usampler2D t", "id.xy", "texelFetch(t, at, 0).x", {4, 4}},
      {"layout(binding = 1) uniform usampler3D t", "id", "texelFetch(t, at, 0).x", {4, 4, 3}},
      {"layout(binding = 1) uniform usampler2DArray t", "id", "texelFetch(t, at, 0).x", {4, 4, 3}},
      {"layout(binding = 1) uniform utexture2D t", "id.xy", "texelFetch(t, at, 0).x", {4, 4}},
  };
  for (const Row& row : rows) {
    CAPTURE(row.declaration);
    const std::string vector = row.extent.size() == 1 ? "int" : "ivec" + std::to_string(row.extent.size());
    const KernelFolder folder(
        "#extension GL_EXT_samplerless_texture_functions : require\n" + tiles + row.declaration +
            "; layout(std430, binding = 0) writeonly buffer Target { uint target[]; };",
        "const ivec3 id = ivec3(gl_GlobalInvocationID); const " + vector + " at = " + row.at +
            ";\ntarget[id.x + 4 * id.y + 16 * id.z] = " + row.read + ";",
        "groups = [1, 1, 3]\n[image.t]\nnoise = { to = 999 }\n");
    const compute::Job job = folder.job();
    CHECK(job.buffers[1].type->extent == row.extent);
    compute::RunOptions how;
    how.device.validation = "sync";
    const compute::Outcome device = compute::run(job, how);
    CHECK(device.validation_messages.empty());
    CHECK(device.buffers == folder.emulated().buffers);
    const auto target = records<uint32_t>(device.buffers[0]),
               texels = records<uint32_t>(job.buffers[1].bytes);
    const size_t each = texels.size() / job.buffers[1].type->count;  // components
    const size_t last = job.buffers[1].type->count - 1;
    CHECK(target[last] == texels[last * each]);
  }
}

TEST_CASE("a store outside of an image is found at its line, and differences name their texel") {
  CHECK(failures(copying("image2D", "rgba32f", sizes)) == "");
  const std::string beyond = failures(copying("image2D", "rgba32f", sizes), {"image.target.size=[4, 3]"});
  CHECK(contains(beyond, "k.comp:5"));
  CHECK(contains(beyond, "out of bounds: texel 4, 0 of 4, 3 in 'target'"));
  CHECK(contains(beyond, "the gpu did not run the kernel"));

  const KernelFolder odd(
      "#extension GL_KHR_shader_subgroup_basic : require\n" + tiles +
          "layout(rg32f, binding = 0) writeonly uniform image2D target;",
      "const ivec2 at = ivec2(gl_GlobalInvocationID.xy);\n"
      "imageStore(target, at, vec4(1, at == ivec2(3, 2) ? float(gl_SubgroupSize) : 1, 0, 0));",
      "");
  compute::VerifyOptions options;
  options.run.device.emulated_subgroup = 64;
  const compare::Report report = compute::verify_job(odd.job(), options);
  REQUIRE_FALSE(report.buffers.empty());
  CHECK(report.buffers[0].different == 1);
  CHECK(report.buffers[0].first.starts_with("[3, 2].g: "));
}

TEST_CASE("images are read from files and written to them") {
  const KernelFolder bytes = copying("image2D", "rgba8");
  compute::Job job = bytes.job({"image.source.noise={}", "image.source.size=[5,3]"});
  const compute::JobBuffer& source = job.buffers[0];
  for (size_t i = 3; i < source.bytes.size(); i += 4) job.buffers[0].bytes[i] = std::byte{255};  // alpha
  compute::write_block(bytes / "s.png", *source.type, source.bytes, 5);
  const std::vector<std::string> given = {"image.source.file=" + (bytes / "s.png"),
                                          "image.target.size=[5,3]"};
  CHECK(bytes.job(given).buffers[0].bytes == source.bytes);
  compute::write_block(bytes / "s.npy", *source.type, source.bytes, 5);
  CHECK(contains(read_text(bytes.path() / "s.npy"), "'shape': (3,5,4)"));
  std::vector<std::string> golden = given;
  golden.push_back("expect.target.file=" + (bytes / "s.npy"));
  CHECK(failures(bytes, golden) == "");
  golden.push_back("image.source.file=" + (bytes / "s.npy"));
  CHECK(failures(bytes, golden) == "");
  golden[0] = "image.source.fill=7";
  golden.back() = "image.source.size=[5,3]";
  CHECK(contains(failures(bytes, golden), "gate G: "));

  const KernelFolder halves = copying("image2D", "rgba16f", sizes);
  const compute::Job half = halves.job();
  for (const char* const name : {"h.pfm", "h.exr", "h.npy", "h.bin"}) {
    CAPTURE(name);
    compute::write_block(halves / name, *half.buffers[0].type, half.buffers[0].bytes, 5);
    const auto read = halves.job({"image.source.file=" + (halves / name)}).buffers[0].bytes;
    CHECK(records<uint16_t>(read)[56] == records<uint16_t>(half.buffers[0].bytes)[56]);
  }
}

TEST_CASE("an image without a format gets one, and another kernel may compute the same") {
  const KernelFolder folder(tiles +
                                "layout(binding = 0) uniform sampler2D source; layout(binding = 1) writeonly "
                                "uniform image2D target;",
                            "const ivec2 at = ivec2(gl_GlobalInvocationID.xy); imageStore(target, at, "
                            "texelFetch(source, at, 0) * OFF);",
                            "defines = [\"OFF=1.0\"]\n[image.target]\nformat = \"r32f\"\n"
                            "[same]\nkernel = \"k.comp\"\ndefines = [\"OFF=1.0\"]\n");
  CHECK(folder.job().buffers[0].type->name == "rgba32f");
  CHECK(folder.job().buffers[1].bytes.size() == 4 * 16);
  CHECK(failures(folder) == "");
  CHECK(contains(failures(folder, {"same.defines=[\"OFF=1.5\"]"}), "gate K: "));
}

TEST_CASE("what is wrong with an image is one sentence") {
  struct Row {
    std::string toml, wanted;
  };
  const Row rows[] = {
      {"[image.sorce]\nfill = 0\n",
       "k.toml:3:8: error: the kernel has no buffer or image `sorce`; did you mean `source`?"},
      {"[buffer.source]\nfill = 0\n", "write [image.source], a table"},
      {"[image.source]\nvalues = [1]\n", "unknown key `values` in [image.source]"},
      {"[image.source]\nsize = 5\n", "`size` must be 2 whole numbers, since 'source' has as many axes"},
      {"[image.source]\nsize = [5, 3, 1]\n", "k.toml:4:"},
      {"[image.source]\nsize = [5, 0]\n", "`size` must be one to three whole numbers"},
      {"[image.source]\nsize = [70000, 70000]\n",
       "'source': an rgba32f image of 70000 × 70000 would have more than 4294967296 bytes"},
      {"[image.source]\nsize = [4294967295, 4294967295]\n", "would have more than 4294967296 bytes"},
      {"[image.source]\nformat = \"r32f\"\n", "the kernel declares 'source' as rgba32f"},
      {"[image.source]\nformat = \"rgba\"\n", "`format` must be one of rgba32f, rgba16f"},
      {"[image.source]\nfile = \"none.pfm\"\n", "none.pfm"},
      {"[image.source]\nfile = \"three.npy\"\n",
       "three.npy has an array of shape (3, 5, 3), but the rgba32f image needs 2 axes, slowest first, and "
       "then 4 components"},
      {"[image.source]\nfile = \"four.npy\"\nsize = [3, 3]\n",
       "four.npy has 5 × 3 texels, but the image has 3 × 3"},
      {"[image.target]\noutput = \"t.gif\"\n", "its ending must be .npy"},
  };
  for (const Row& row : rows) {
    CAPTURE(row.toml);
    const KernelFolder folder = copying("image2D", "rgba32f", row.toml);
    const auto number = std::make_shared<compute::Type>();
    for (const auto& [name, components] : {std::pair("three.npy", 3), std::pair("four.npy", 4)}) {
      const auto texel = std::make_shared<compute::Type>(compute::Type{
          .form = compute::Form::vector, .element = number, .count = uint64_t(components), .stride = 4});
      const compute::Type numbers{.form = compute::Form::array,
                                  .element = texel,
                                  .count = 15,
                                  .stride = uint64_t(components) * 4,
                                  .extent = {5, 3}};
      compute::write_block(folder / name, numbers, std::vector<std::byte>(size(numbers)), 0);
    }
    const std::string refusal = folder.refusal();
    CAPTURE(refusal);
    CHECK(contains(refusal, row.wanted));
  }
  const KernelFolder wide = copying("image2D", "rgba32f", "[image.source]\nsize = [1, 100000]\n");
  try {
    compute::run(wide.job(), {});
    FAIL("a device has images of 100000 texels along an axis");
  } catch (const Error& error) {
    CHECK(error.code() == ExitCode::no_device);
    CHECK(contains(error.what(), "image 'source' has 1 × 100000 × 1 texels in 1 layers, but "));
  }
  const auto refused = [](const std::string& declaration, const std::string& body) {
    return KernelFolder(lines64 + declaration, body, "").refusal();
  };
  CHECK(contains(
      refused("layout(r11f_g11f_b10f, binding = 3) uniform image2D p;", "imageStore(p, ivec2(0), vec4(0));"),
      "the kernel declares the image 'p' in a format that eyeray does not have; it has rgba32f, "));
  const std::string filtered =
      refused("layout(binding = 3) uniform sampler2D look; layout(r32f, binding = 4) uniform image2D p;",
              "imageStore(p, ivec2(0),\n  texture(look, vec2(0.5)));");
  CAPTURE(filtered);
  CHECK(contains(filtered, "the emulator does not have the instruction "));
  CHECK(contains(filtered, "k.comp:5 (OpImageSampleExplicitLod "));
}
