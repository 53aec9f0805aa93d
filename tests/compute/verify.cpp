#include "host/compute/data_file.hpp"
#include "support.hpp"

using namespace eyeray::engine;
using namespace eyeray::engine::test;

namespace {

// The kernel's findings and failures.
std::string failures(const std::string& declarations, const std::string& body, const std::string& toml = "") {
  const KernelFolder folder(two_buffers + declarations, body, toml);
  std::string text;
  for (const std::string& each : folder.verified().failures()) text += each + "\n";
  return text;
}

const std::string reverse =
    "uint i = gl_LocalInvocationID.x; list[i] = source[i];\n@\ntarget[i] = list[63u - i];";

std::string with(std::string text, const std::string& middle) {
  return text.replace(text.find('@'), 1, middle);
}

}  // namespace

TEST_CASE("a right kernel passes, and planted faults are found at their lines") {
  CHECK(failures("shared float list[64];", with(reverse, "barrier();")) == "");
  const std::string race = failures("shared float list[64];", with(reverse, ""));
  CHECK(contains(race, "gate S: "));
  CHECK(contains(race, "k.comp:6"));
  CHECK(contains(race, "race"));

  const std::string beyond = failures("", "uint i = gl_LocalInvocationID.x;\ntarget[i + 1u] = source[i];");
  CHECK(contains(beyond, "k.comp:5"));
  CHECK(contains(beyond, "out of bounds"));
  CHECK(contains(beyond, "the gpu did not run the kernel, since a fault of gate S could crash it"));

  const std::string unset =
      failures("", "uint i = gl_LocalInvocationID.x; float sum;\nif (i > 3u) sum = 1.0;\ntarget[i] = sum;");
  CHECK(contains(unset, "k.comp:6"));
  CHECK(contains(unset, "not initialised"));
}

TEST_CASE("gates A, G and K name the first number that differs") {
  // The size of a subgroup differs, so the executors do.
  const KernelFolder odd(
      "#extension GL_KHR_shader_subgroup_basic : require\n" + two_buffers,
      "uint i = gl_LocalInvocationID.x; target[i] = i == 3u ? float(gl_SubgroupSize) : 1.0;",
      "[buffer.Target]\nfill = 0\n");
  compute::VerifyOptions options;
  options.run.device.emulated_subgroup = 64;
  const compare::Report report = compute::verify_job(odd.job(), options);
  REQUIRE(report.buffers.size() == 4);  // gates A and S of both buffers
  CHECK(report.buffers[0].passes());
  CHECK(report.buffers[1].different == 1);
  CHECK(report.buffers[1].first.starts_with(".target[3]: "));
  CHECK(contains(report.buffers[1].first, " against 64, "));
  CHECK_FALSE(report.passes());
  CHECK(compute::verify_job(odd.job({"buffer.Target.compare=false"}), options).passes());
  const compare::Report order =
      KernelFolder(two_buffers + "layout(std430, binding = 2) buffer Count { uint count; };",
                   "uint i = gl_GlobalInvocationID.x; target[atomicAdd(count, 1u)] = source[i];",
                   "groups = 2\n[buffer.Count]\nfill = 0\n")
          .verified();
  REQUIRE_FALSE(order.failures().empty());
  CHECK(contains(order.failures().back(), "gate S: emulator and emulator in descending order, Target: "));
  CHECK(contains(compare::to_junit({&report, 1}), "failures=\"1\""));
  CHECK(contains(compare::to_json({&report, 1}), "\"different\":1"));
  CHECK(contains(compare::to_row(report, 10), "1 differ"));

  const KernelFolder folder(two_buffers, "uint i = gl_LocalInvocationID.x; target[i] = 2.0 * source[i];",
                            "[expect.Target]\nfile = \"t.bin\"\n[same]\nkernel = \"o.comp\"\n");
  write_text(folder.path() / "o.comp",
             "#version 450\nlayout(local_size_x = 1) in;\n"
             "layout(std430, binding = 5) buffer Target { float t[]; };\n"
             "layout(std430, binding = 6) readonly buffer Source { float s[]; };\n"
             "void main() { uint i = gl_GlobalInvocationID.x; t[i] = s[i] + s[i] OFF; }\n");
  write_text(folder.path() / "t.bin", std::string(256, '\0'));
  const std::vector<std::string> right = {"same.defines=[\"OFF=\"]"};
  const compute::Outcome outcome = folder.emulated(right);
  compute::write_block(folder / "t.bin", *folder.job(right).buffers[1].type, outcome.buffers[1], 0);
  CHECK(folder.verified(right).failures().empty());
  const auto wrong = folder.verified({"same.defines=[\"OFF=+ 1e-6\"]"}).failures();
  REQUIRE(wrong.size() == 1);
  CHECK(wrong[0].starts_with("gate K: "));
  CHECK(contains(wrong[0], "o.comp, Target: "));
  CHECK(folder.verified({"same.defines=[\"OFF=+ 1e-6\"]", "same.ulp=16777216"}).failures().empty());
  write_text(folder.path() / "t.bin", std::string(256, '\0'));
  const auto golden = folder.verified(right).failures();
  REQUIRE(golden.size() == 1);
  CHECK(golden[0].starts_with("gate G: gpu and "));
  CHECK(folder.verified({right[0], "expect.Target.absolute=2"}).failures().empty());
}
