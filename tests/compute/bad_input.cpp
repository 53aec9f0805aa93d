#include "support.hpp"

using namespace eyeray::engine;
using namespace eyeray::engine::test;

TEST_CASE("what is wrong in a kernel file is one sentence at its line") {
  const std::string body = "target[gl_GlobalInvocationID.x] = source[0];";
  struct Row {
    std::string toml, wanted;
  };
  const Row rows[] = {
      {"grups = 3\n", "k.toml:2:1: error: unknown key `grups` in the kernel file; did you mean `groups`?"},
      {"groups = 0\n",
       "k.toml:2:10: error: `groups` must be one to three whole numbers from 1 to 4294967295"},
      {"groups = [1, 2, 3, 4]\n", "`groups` must be one to three whole numbers"},
      {"groups = 1\ninvocations = 64\n", "`groups` is given already: leave out `invocations`"},
      {"defines = [1]\n", "`defines` must be a list of strings"},
      {"ulp = -1\n", "ulp` must be an integer from 0 to 16777216"},
      {"[constants]\nN = 3\n", "k.toml:3:1: error: the kernel has no specialization constant `N`"},
      {"[push]\nn = 3\n", "the kernel has no push constants"},
      {"[buffer.Sorce]\nfill = 0\n",
       "k.toml:2:9: error: the kernel has no buffer or image `Sorce`; did you mean `Source`?"},
      {"[buffer.Source]\nfil = 0\n", "unknown key `fil` in [buffer.Source]; did you mean `file`?"},
      {"[buffer.Source]\nfill = 0\nvalues = [1]\n", "[buffer.Source] has contents already"},
      {"[buffer.Source]\nvalues = [1, true, \"a\"]\n",
       "k.toml:3:20: error: this must be a number that a float holds"},
      {"[buffer.Source]\nelements = 9999999999\n", "must be an integer from 1 to 1073741824"},
      {"[buffer.Source]\nelements = 3\nvalues = [1, 2]\n", "this list has 2 values, but float[3] has 3"},
      {"[buffer.Source]\nbytes = 10\n", "'Source' has 0 bytes and 4 for each element"},
      {"[buffer.Source]\nnoise = { from = 1, to = 0 }\n", "numbers that do not hold this range"},
      {"[buffer.Source]\nnoise = 3\n", "`noise` must be a table"},
      {"[buffer.Source]\nfile = \"none.npy\"\n", "k.toml:3:8: error: cannot read the data"},
      {"[buffer.Source]\nfile = \"k.toml\"\n", "its ending must be .npy, .bin, .png, .pfm, .hdr or .exr"},
      {"[buffer]\nSource = 3\n", "write [buffer.Source], a table"},
      {"[expect.Target]\n", "[expect.Target] needs `file`, a string"},
      {"[same]\nkernel = \"none.comp\"\n", "none.comp"},
      {"groups = [\n", "syntax"},
      {"groups = [70000, 70000, 70000]\n", "buffer 'Source' would have more than 4294967296 bytes"},
  };
  for (const Row& row : rows) {
    CAPTURE(row.toml);
    const KernelFolder folder(two_buffers, body, row.toml);
    const std::string refusal = folder.refusal();
    CAPTURE(refusal);
    CHECK(contains(refusal, row.wanted));
  }
  const KernelFolder folder(two_buffers, body, "");
  CHECK(folder.refusal() == "");
  CHECK(contains(folder.refusal({"groups"}), "-D groups: error: write KEY=VALUE"));
  CHECK(contains(folder.refusal({"buffer.Source.fill=x"}), "-D buffer.Source.fill=x: error: "));
}

TEST_CASE("a kernel that cannot be compiled or run is refused at its line") {
  const auto refused = [](const std::string& declarations, const std::string& body) {
    return KernelFolder(lines64 + declarations, body, "").refusal();
  };
  const std::string compiler = refused("", "float x = y;");
  CHECK(contains(compiler, "k.comp:4:11: error: 'y': undeclared identifier"));
  CHECK(contains(refused("\n#include \"none.glsl\"", ""), "there is no such file"));
  CHECK(contains(refused("layout(rgba8, binding = 3) uniform imageCube picture;",
                         "imageStore(picture, ivec3(0), vec4(0));"),
                 "the kernel binds an image, 'picture', at set 0, binding 3"));
  CHECK(contains(refused("layout(binding = 3) uniform sampler look; layout(binding = 4) uniform texture2D t;",
                         "vec4 c = texelFetch(sampler2D(t, look), ivec2(0), 0);"),
                 "a sampler, 'look'"));
  CHECK(contains(refused("layout(std430, binding = 0) buffer B { float b[]; } many[2];", "many[1].b[0] = 1;"),
                 "an array of bindings"));
}

TEST_CASE("SPIR-V that is none, or not valid, is refused before anything reads it") {
  const KernelFolder folder(two_buffers, "", "");
  const auto refused = [&](const std::string& bytes) {
    write_text(folder.path() / "k.spv", bytes);
    return folder.refusal({"kernel=" + (folder / "k.spv")});
  };
  CHECK(contains(refused("abc"), "k.spv is no SPIR-V: it has 3 bytes"));
  CHECK(contains(refused(""), "k.spv is no SPIR-V: it has 0 bytes"));
  CHECK(contains(refused("abcdefgh"), "k.spv is no SPIR-V: it does not begin with 0x07230203"));
  const std::string header("\x03\x02\x23\x07\x00\x03\x01\x00\x00\x00\x00\x00\x10\x00\x00\x00\x00\x00\x00\x00",
                           20);
  CHECK(contains(refused(header), "k.spv is no valid SPIR-V for Vulkan 1.1: "));
  CHECK(contains(refused(header + std::string("\x02\x00\xff\xff\x00\x00\x00\x00", 8)), "is no valid SPIR-V"));
  std::string newer = header;
  newer[5] = 0;
  newer[6] = 6;
  CHECK(contains(refused(newer), "is no valid SPIR-V"));
}
