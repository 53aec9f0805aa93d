// One invocation of a kernel, line by line.
#include "host/compute/probe.hpp"

#include <nlohmann/json.hpp>

#include "support.hpp"

using namespace eyeray::engine;
using namespace eyeray::engine::test;

TEST_CASE("probe shows the lines of an invocation, and names the writer of what it read") {
  const ProcessResult ran = run_eyeray({"probe", "examples/kernels/prefix_sum.toml", "5,0,0"});
  CAPTURE(ran.out);
  CHECK(ran.code == 0);
  CHECK(contains(ran.out, "invocations): gpu and emulator agree\n"));
  CHECK(contains(ran.out, "    14      const uint before = local >= step ? list[local - step] : 0;\n"));
  CHECK(contains(ran.out, "list[4] is 1, from invocation 4,0,0; before = 1"));
  CHECK(contains(ran.out, "  Sums.sums[5]  6         =\n"));

  const ProcessResult followed = run_eyeray(
      {"probe", "examples/kernels/prefix_sum.toml", "5", "--follow", "before", "--backends", "emulator"});
  CAPTURE(followed.out);
  CHECK(followed.code == 0);
  CHECK(contains(followed.out, "emulator alone"));
  CHECK(contains(followed.out, "before = 1"));
  CHECK_FALSE(contains(followed.out, "numbers[5]"));
}

TEST_CASE("probe finds the first number that differs on the device") {
  const KernelFolder folder(two_buffers,
                            "uint i = gl_GlobalInvocationID.x;\ntarget[i] = 1;\ntarget[i] += source[i];", "");
  compute::ProbeOptions how;
  how.invocation = {3, 0, 0};
  const compute::Job job = folder.job();
  compute::Probed probed = compute::probe(job, how);
  REQUIRE(probed.numbers.size() == 1);
  CHECK(probed.numbers[0].name == "Target.target[3]");
  CHECK(probed.numbers[0].by.line == 6);
  CHECK_FALSE(probed.numbers[0].gpu.empty());
  // As if the device had computed another number.
  probed.numbers[0].gpu = "2";
  probed.numbers[0].differs = true;
  CHECK(contains(compute::to_text(job, probed),
                 "gpu and emulator differ in 1 of 1 numbers; the first is Target.target[3]: 2 against"));
  CHECK(contains(compute::to_text(job, probed), "k.comp:6\n"));
}

TEST_CASE("probe answers as JSON, with the writers") {
  const ProcessResult ran = run_eyeray({"probe", "examples/kernels/prefix_sum.toml", "5,0,0", "--json"});
  REQUIRE(ran.code == 0);
  const auto answer = nlohmann::json::parse(ran.out);
  CHECK(answer.at("wrote")[0].at("name") == "Sums.sums[5]");
  CHECK(answer.at("wrote")[0].at("line") == 21);
  CHECK(answer.at("first_difference").is_null());
  size_t writers = 0;
  for (const auto& line : answer.at("lines"))
    for (const auto& value : line.at("values"))
      if (value.contains("writer")) ++writers;
  CHECK(writers == 3);  // list[4], list[3] and list[1]
}

TEST_CASE("probe refuses what it cannot show, and says what it can") {
  const std::string file = "examples/kernels/prefix_sum.toml";
  const auto refused = [](const std::vector<std::string>& words, const std::string& message) {
    const ProcessResult ran = run_eyeray(words);
    CAPTURE(ran.err);
    CHECK(ran.code == 2);
    CHECK(contains(ran.err, message));
  };
  refused({"probe", file, "1024,0,0"},
          "has no invocation 1024,0,0: invocations are numbered from 0,0,0 to 1023,0,0");
  refused({"probe", file, "5,-1,0"}, "an invocation must be X,Y,Z");
  refused({"probe", file, "1,2,3,4"}, "an invocation must be X,Y,Z");
  refused({"probe", file, "5", "--follow", "lst"}, "has no variable `lst`: did you mean `list`?");
  refused({"probe", file, "5", "--sample", "1"}, "a kernel has no samples");
  refused({"probe", file, "5", "--backends", "gpu"}, "--backends must name the emulator");
  refused({"probe", "scenes/whitted.toml", "5,5", "--follow", "list"}, "is a scene");
}

TEST_CASE(
    "probe shows instructions of SPIR-V without lines, and does not run a dangerous kernel on the device") {
  const KernelFolder folder(two_buffers, "target[gl_GlobalInvocationID.x + 1000] = source[0];", "");
  const ProcessResult ran = run_eyeray({"probe", folder / "k.comp", "5"});
  CAPTURE(ran.out);
  CHECK(ran.code == 0);
  CHECK(contains(ran.out, "Target[index 1005 of 64] = "));
  CHECK(contains(ran.out, "The gpu did not run the kernel"));
  CHECK(contains(ran.out, "out of bounds"));
}
