// Faults in the GPU's shaders alone: the program itself must notice, print the reason, and answer 1.
#include <limits>
#include <set>

#include "host/image/image_file.hpp"
#include "tests/support/faults.hpp"
//
#include "tests/support/doctest.hpp"

using namespace eyeray::engine;
using namespace eyeray::engine::image;
using namespace eyeray::engine::test;

namespace {

ProcessResult verify(const TemporaryFolder& folder, const std::string& fault,
                     std::vector<std::string> scene = {"scenes/whitted.toml"}) {
  scene.insert(scene.begin(), "verify");
  scene.insert(scene.end(), {"-s", "96x72", "--quiet", "--keep", folder / "kept"});
  if (!fault.empty()) scene.insert(scene.end(), {"--shaders", lay_fault(folder, fault)});
  return run_eyeray(scene);
}

struct Expected {
  std::string fault;
  std::vector<const char*> reasons;  // that the report must give
  std::vector<std::string> scene = {"scenes/whitted.toml"};
};

// The expected findings of every fault.
std::vector<Expected> all_expected() {
  const char* bits = "gate A: gpu and twin";
  const char* colors = "gate B: gpu against the reference, colours";
  const char* first_hits = "gate C: gpu against the reference, first hits";
  const char* counts = "gate C: gpu against the reference, surfaces and rays";
  const char* paths = "gate D: gpu against the reference, paths";
  const std::vector<std::string> emitters = {"scenes/path/lamps.toml", "--spp", "2"};
  const auto seen_by = [](const std::string& camera) {
    return std::vector<std::string>{"scenes/cameras/" + camera + ".toml", "--spp", "4"};
  };
  const std::vector<std::string> box = {"scenes/path/cornell_box.toml", "--spp", "2"};
  const char* denoised_bits = "gate A: gpu and twin, denoised";
  const char* denoised = "gate B: gpu against the reference, denoised";
  const std::vector<std::string> denoised_box = {"scenes/path/cornell_box.toml", "--spp", "4", "--denoise"};
  const std::vector<std::string> watched = {
      "scenes/sphereflake.toml", "--backends", "twin",        "--emulate", "--tune",
      "acceleration=bvh",        "--tune",     "rays=packets"};
  return {
      {"near_root", {bits, counts, colors}},
      {"edge", {bits, first_hits, counts, colors, "diverges at primitive"}},
      {"position", {bits, first_hits, "diverges at position"}},
      {"normal", {bits, first_hits, counts, colors, "diverges at normal"}},
      {"uv", {bits, first_hits, "diverges at uv"}},
      {"ids", {bits, first_hits, "diverges at primitive"}},
      {"camera", {bits, first_hits, counts, colors}},
      {"lens", {bits, colors}, seen_by("thin_lens")},
      {"blades", {bits, colors}, seen_by("thin_lens")},
      {"focus", {bits, colors}, seen_by("thin_lens")},
      {"fisheye", {bits, first_hits, colors}, seen_by("fisheye")},
      {"circle", {bits, first_hits, counts, colors}, seen_by("fisheye")},
      {"panorama", {bits, first_hits, colors}, seen_by("panorama")},
      {"cylindrical", {bits, first_hits, colors}, seen_by("cylindrical")},
      {"own_camera", {bits, first_hits, colors}, seen_by("formula")},
      {"filter",
       {bits, colors},
       {"scenes/whitted.toml", "--spp", "4", "-D", "image.filter=blackman-harris", "--max-explained",
        "0.02"}},
      {"shadow", {bits, colors, "diverges at color"}},
      {"fresnel", {bits, colors, "diverges at color"}},
      {"refraction", {bits, counts, colors}},
      {"mirror", {bits, counts, colors}},
      {"depth", {bits, counts, colors}},
      {"checker", {bits, colors}},
      {"noise", {bits, colors}, {"scenes/solid_patterns.toml"}},
      {"normal_map", {bits, first_hits, colors, "diverges at normal"}, {"scenes/bumps.toml"}},
      {"coat_normal", {bits, paths}, {"scenes/path/lacquer.toml", "--spp", "2"}},
      {"bump", {bits, first_hits, colors, "diverges at normal"}, {"scenes/bumps.toml"}},
      {"horizon", {bits, first_hits, colors}, {"scenes/bumps.toml"}},
      {"counts", {bits, counts, "diverges at counts"}},
      {"offset", {bits, counts, colors}},
      {"ior", {bits, counts, colors}},
      {"light", {bits, colors}},
      {"near_light", {bits, colors, "explained, which is more than the 4 allowed"}},
      {"materials", {bits, first_hits, counts, colors, "diverges at material"}},
      {"bit", {bits, "by at most 4 ULP"}},
      {"nan", {"gpu: 1 NaN (first at ", bits, colors}},
      {"black", {bits, colors}},
      {"stale", {bits, counts, colors, "the worst is 95,71"}},
      {"shift", {bits, first_hits, counts, colors}},
      {"random",
       {bits, counts, colors},
       {"scenes/whitted.toml", "--spp", "4", "-D", "image.pattern=jittered", "--max-explained", "0.02"}},
      {"steps",
       {" incomplete pixels: the search for a shape ran out of steps", bits},
       {"scenes/shapes/superellipsoid.toml"}},
      {"mis", {bits, paths}, box},
      {"twice", {bits, paths}, box},
      {"share", {bits, paths}, emitters},
      {"density", {bits, paths}, emitters},
      {"solid_angle", {bits, paths}, box},
      {"spherical", {bits, paths}, emitters},
      {"cosine", {bits, paths}, box},
      {"roulette", {bits, paths}, box},
      {"shadow_end", {bits, paths}, box},
      {"pairs", {bits, paths}, box},
      {"lobe", {bits, paths}, {"scenes/path/materials.toml", "--spp", "2"}},
      {"masking", {bits, paths}, {"scenes/path/materials.toml", "--spp", "2"}},
      {"half_texel", {bits, paths}, {"scenes/path/environment.toml", "--spp", "2"}},
      {"albedo", {bits, "the tile of ", paths}, box},
      {"threshold",
       {bits, "diverges at a decision of its path", paths},
       {"scenes/path/materials.toml", "--spp", "2"}},
      {"clamp", {bits, paths}, box},
      {"emission_side", {bits, paths}, {"scenes/path/emitters.toml", "--spp", "2"}},
      {"emission_uv", {bits, paths}, {"scenes/path/emitters.toml", "--spp", "2"}},
      {"face", {bits, paths}, {"scenes/path/emitters.toml", "--spp", "2"}},
      {"light_leaf", {bits, paths}, {"scenes/path/many_lamps.toml", "--spp", "2"}},
      {"flight", {bits, paths}, {"scenes/path/fog.toml", "--spp", "2"}},
      {"height_fog", {bits, paths}, {"scenes/path/morning.toml", "--spp", "2"}},
      {"phase", {bits, paths}, {"scenes/path/fog.toml", "--spp", "2"}},
      {"pane", {bits, paths}, {"scenes/path/panes.toml", "--spp", "2"}},
      {"sheen", {bits, paths}, {"scenes/path/panes.toml", "--spp", "2"}},
      {"kernel", {bits, paths}, {"scenes/sppm/box.toml", "--spp", "1"}},
      {"cells", {bits, paths}, {"scenes/sppm/box.toml", "--spp", "1"}},
      {"gathered_twice", {bits, paths}, {"scenes/sppm/box.toml", "--spp", "1"}},
      {"photon_area", {bits, paths}, {"scenes/sppm/box.toml", "--spp", "1"}},
      {"photon_heading", {bits, paths}, {"scenes/sppm/box.toml", "--spp", "1"}},
      {"photon_flux", {bits, paths}, {"scenes/sppm/points.toml", "--spp", "1"}},
      {"photon_aim", {bits, paths}, {"scenes/sppm/points.toml", "--spp", "1"}},
      {"photon_index", {bits, paths}, {"scenes/sppm/paperweight.toml", "--spp", "1"}},
      {"photon_behind", {bits, paths}, {"scenes/sppm/frosted.toml", "--spp", "1"}},
      {"unset", {"gate S", "not initialised"}, watched},
      {"lane_reads", {"gate S", "packet.comp.glsl", "race"}, watched},
      {"next_hit", {"gate S", "packet.comp.glsl", "out of bounds"}, watched},
      {"list_count", {"gate S", "wavefront.comp.glsl", "race"}, watched},
      {"denoise_own", {denoised, denoised_bits}, denoised_box},
      {"denoise_cost", {denoised, denoised_bits}, denoised_box},
      {"denoise_patch", {denoised, denoised_bits}, denoised_box},
  };
}

// Verifies a scene with the fault, and looks for the expected text in the report.
void expect_noticed(const Expected& expected) {
  CAPTURE(expected.fault);
  const TemporaryFolder folder;
  const ProcessResult result = verify(folder, expected.fault, expected.scene);
  CAPTURE(result.out);
  CAPTURE(result.err);
  CHECK(result.code == 1);
  CHECK(result.out.starts_with("FAILED " + expected.scene[0]));
  for (const char* reason : expected.reasons) {
    CAPTURE(reason);
    CHECK(result.out.find(reason) != std::string::npos);
  }
  CHECK(result.out.find("twin against the reference") == std::string::npos);
  CHECK(read_text(folder / "kept/command.txt").find(expected.fault) != std::string::npos);
  const std::string causes = read_text(folder / "kept/gpu-causes.json");
  const std::string last = expected.reasons.back();
  if (last.starts_with("gate B") || last.starts_with("gate D"))
    CHECK(causes.find("unexplained") != std::string::npos);
}

}  // namespace

TEST_CASE("a shell that runs command.txt unchanged gets the same result again") {
  const TemporaryFolder folder;
  const std::string scene = folder / "it's a $scene.toml", kept = folder / "kept";
  std::filesystem::copy_file("scenes/whitted.toml", scene);
  const ProcessResult first = verify(folder, "bit", {scene, "-D", "render.max_depth=2"});
  CAPTURE(first.err);
  REQUIRE(first.code == 1);
  const std::string picture = read_text(kept + "/gpu.pfm"), command = read_text(kept + "/command.txt");
  CAPTURE(command);
  write_text(folder / "command.txt", command);
  std::filesystem::remove_all(kept);
  const ProcessResult again = run_process({"sh", "-c", "cd / && exec sh " + (folder / "command.txt")},
                                          {{"PATH", "/usr/bin:/bin"}}, 600);
  CAPTURE(again.err);
  CHECK(again.code == 1);
  CHECK(again.out.substr(0, again.out.find('\n')) == first.out.substr(0, first.out.find('\n')));
  CHECK(read_text(kept + "/gpu.pfm") == picture);
  CHECK(read_text(kept + "/command.txt") == command);
}

TEST_CASE("without a fault verify passes and keeps nothing") {
  const TemporaryFolder folder;
  const ProcessResult result = verify(folder, "");
  CAPTURE(result.out);
  CAPTURE(result.err);
  CHECK(result.code == 0);
  CHECK(result.out.starts_with("PASSED scenes/whitted.toml"));
  CHECK(folder.names().empty());
}

TEST_CASE("every fault has a line in a shader, an expected result, and a row in the documents") {
  const TemporaryFolder folder;
  const std::string document = read_text("docs/gates.md");
  std::set<std::string> names, expected;
  for (const Fault& fault : faults) {
    const std::string name(fault.name);
    CAPTURE(name);
    CHECK_NOTHROW(lay_fault(folder, name));
    CHECK(document.find(fmt::format("\n| `{}` | ", name)) != std::string::npos);
    names.insert(name);
  }
  for (const Expected& each : all_expected()) expected.insert(each.fault);
  CHECK(expected == names);
  CHECK(names.size() == std::size(faults));
  CHECK_THROWS(lay_fault(folder, "none"));
}

TEST_CASE(
    "faults in geometry, in a light's position, in one bit and in denoising are detected, with the reason") {
  for (const Expected& expected : all_expected())
    for (const char* name : {"edge", "near_light", "bit", "denoise_cost"})
      if (expected.fault == name) expect_noticed(expected);
}

TEST_CASE("every fault on the GPU's side is detected, with its reason" * doctest::test_suite("long")) {
  for (const Expected& expected : all_expected()) expect_noticed(expected);
}

TEST_CASE("a driver that may contract a·b + c is detected") {
  expect_noticed({"", {"gate A: gpu and twin"}, {"scenes/whitted.toml", "--fast-math"}});
}

TEST_CASE("verify names a device that flushes denormals, also where no pixel shows it") {
  const ProcessResult result = run_eyeray({"verify", "scenes/whitted.toml", "-s", "16x12", "--spp", "1",
                                           "--tune", "constants=off", "--tune", "device-denormals=worst"});
  CHECK(result.code == 0);
  CHECK(result.out.find("arithmetic not exact, denormals lost, infinities kept") != std::string::npos);
}

TEST_CASE("compare returns 1 for pictures of another size, too different, or with a NaN") {
  const TemporaryFolder folder;
  Image picture(8, 6, 3);
  write_image(folder / "a.pfm", picture);
  write_image(folder / "narrow.pfm", Image(7, 6, 3));
  picture.samples()[40] = 2e-4f;
  write_image(folder / "other.pfm", picture);
  picture.samples()[40] = -1e-6f;
  write_image(folder / "negative.pfm", picture);
  picture.samples()[40] = std::numeric_limits<float>::quiet_NaN();
  write_image(folder / "nan.pfm", picture);

  const auto compare = [&](const std::string& name, std::vector<std::string> options = {}) {
    options.insert(options.begin(), {"compare", folder / name, folder / "a.pfm"});
    return run_eyeray(options);
  };
  CHECK(compare("a.pfm").code == 0);
  struct Failing {
    const char* name;
    const char* reason;
  };
  for (const Failing& failing : {Failing{"narrow.pfm", "the sizes differ: 7×6 in 3 channels against 8×6"},
                                 {"other.pfm", "1 of 48 pixels differ"},
                                 {"negative.pfm", "1 negative (first at 5,1)"},
                                 {"nan.pfm", "1 NaN (first at 5,1)"}}) {
    CAPTURE(failing.reason);
    const ProcessResult result = compare(failing.name);
    CAPTURE(result.out);
    CHECK(result.code == 1);
    CHECK(result.out.find(failing.reason) != std::string::npos);
  }
  CHECK(compare("other.pfm", {"--max-different", "1"}).code == 0);
  CHECK(compare("other.pfm", {"--tolerance", "1e-3"}).code == 0);
  CHECK(compare("nan.pfm", {"--max-different", "48"}).code == 1);
  CHECK(compare("other.pfm", {"--tolerance", "nan"}).code == 2);
  CHECK(compare("missing.pfm").code == 4);

  CHECK(compare("other.pfm", {"--diff", folder / "difference.png"}).code == 1);
  CHECK(read_image(folder / "difference.png").width() == 8);
}
