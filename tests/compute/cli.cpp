// eyeray run and eyeray verify with kernels.
#include <nlohmann/json.hpp>

#include "support.hpp"

using namespace eyeray::engine;
using namespace eyeray::engine::test;

TEST_CASE("the examples run and verify, and the planted race is found") {
  const ProcessResult all = run_eyeray({"verify", "examples/kernels"});
  CAPTURE(all.out);
  CHECK(all.code == 0);
  CHECK(contains(all.out, "6 kernels in "));
  const TemporaryFolder folder;
  const ProcessResult race =
      run_eyeray({"verify", "examples/kernels/prefix_sum.toml", "-D", "defines=[\"RACE\"]", "--github",
                  "--junit", folder / "j.xml", "--report", folder / "page"});
  CHECK(race.code == 1);
  CHECK(contains(race.out, "::error file=examples/kernels/prefix_sum.comp,line="));
  CHECK(contains(read_text(folder.path() / "j.xml"), "failures=\"1\""));
  CHECK(contains(read_text(folder.path() / "page/index.html"), "race"));
  CHECK(std::filesystem::exists(folder / "page/kept/emulator-Sums.npy"));
}

TEST_CASE("run prints a summary, writes files, and needs no kernel file") {
  const KernelFolder folder(two_buffers + "layout(push_constant) uniform P { float scale; };",
                            "uint i = gl_GlobalInvocationID.x; target[i] = scale * source[i];", "");
  for (const std::string backend : {"gpu", "emulator"}) {
    const ProcessResult ran =
        run_eyeray({"run", folder / "k.comp", "--groups", "2", "-D", "push.scale=2", "-o",
                    "Target=" + (folder / "t.npy"), "--backend", backend, "--json"});
    CAPTURE(ran.err);
    REQUIRE(ran.code == 0);
    const auto answer = nlohmann::json::parse(ran.out);
    CHECK(answer.at("buffers")[1].at("type") == "float[128]");
    CHECK(answer.at("buffers")[1].at("min") == 2 * answer.at("buffers")[0].at("min").get<double>());
    CHECK(std::filesystem::file_size(folder / "t.npy") == 128 + 512);
  }
  const ProcessResult zero = run_eyeray({"run", folder / "k.comp"});
  CHECK(zero.code == 0);
  CHECK(contains(zero.err, "warning: the push constants are 0: scale"));
  CHECK(contains(zero.out, "Target (set 0, binding 1), float[64]: min 0, max 0, mean 0"));

  CHECK(run_eyeray({"run", folder / "none.comp"}).code == 4);
  CHECK(run_eyeray({"run", folder / "k.comp", "--groups", "a"}).code == 2);
  CHECK(run_eyeray({"run", folder / "k.comp", "-o", "Nothing=x.npy"}).code == 2);
  CHECK(run_eyeray({"run", folder / "k.comp", "-o", "Target=" + (folder / "no/x.npy")}).code == 4);
  CHECK(run_eyeray({"verify", folder / "k.comp", "--backends", "twin"}).code == 2);
  CHECK(run_eyeray({"verify", folder / "k.comp", "--backends", "emulator"}).code == 0);
}

TEST_CASE("HLSL runs, by its registers or its bindings") {
  const TemporaryFolder folder;
  write_text(
      folder.path() / "k.hlsl",
      "StructuredBuffer<float> source : register(t0);\nRWStructuredBuffer<float> target : register(u0);\n"
      "cbuffer Sizes : register(b0) { float scale; };\n"
      "float of(RWStructuredBuffer<float> list, uint i) { return list[i]; }\n"
      "[numthreads(64, 1, 1)]\nvoid twice(uint3 id : SV_DispatchThreadID) {\n"
      "  target[id.x] = scale * source[id.x] + 0 * of(target, id.x);\n}\n");
  const ProcessResult ran =
      run_eyeray({"verify", folder / "k.hlsl", "-D", "entry=twice", "-D", "buffer.Sizes.values={scale=2}"});
  CAPTURE(ran.err);
  CAPTURE(ran.out);
  CHECK(ran.code == 0);
  CHECK(contains(ran.out, "gate A passed gpu = emulator, target: 0 of 64 numbers differ"));
  const ProcessResult bad = run_eyeray({"run", folder / "k.hlsl", "-D", "entry=thrice"});
  CHECK(bad.code == 2);
  CHECK(contains(bad.err, "k.hlsl has no function \"thrice\": name the entry point by `entry`"));
}
