// Faults injected on the GPU side only: the program itself must notice, say why, and answer 1.
#include <limits>

#include "host/image/image_file.hpp"
#include "tests/support/process.hpp"
//
#include "tests/support/doctest.hpp"

using namespace eyeray;
using namespace eyeray::test;

namespace {

ProcessResult verify(const TemporaryFolder& folder, const std::string& fault) {
  std::vector<std::string> arguments = {"verify", "scenes/whitted.toml", "-s", "96x72", "--quiet",
                                        "--keep", folder / "kept"};
  if (!fault.empty()) arguments.insert(arguments.end(), {"--inject-fault", fault});
  return run_eyeray(arguments);
}

struct Fault {
  const char* name;
  std::vector<const char*> reasons;  // that the report must give
};

}  // namespace

TEST_CASE("without a fault verify passes and keeps nothing") {
  const TemporaryFolder folder;
  const ProcessResult result = verify(folder, "");
  CAPTURE(result.out);
  CAPTURE(result.err);
  CHECK(result.code == 0);
  CHECK(result.out.starts_with("PASSED scenes/whitted.toml"));
  CHECK(folder.names().empty());
}

TEST_CASE("every fault on the GPU's side is noticed, with its reason") {
  const char* bits = "gate A: gpu and twin";
  const char* colors = "gate B: gpu against the reference";
  const char* first_hits = "gate C: gpu against the reference";
  const Fault faults[] = {
      {"shift", {bits, colors, first_hits}},
      {"nan", {"gpu: ", " NaN", bits}},
      {"black", {bits, colors}},
      {"near_root", {bits, colors}},
      {"ior", {bits, colors}},
      {"light", {bits, colors}},
      {"normal", {bits, first_hits}},
      {"ids", {bits, first_hits, "parts at primitive"}},
      {"contraction", {bits}},
  };
  for (const Fault& fault : faults) {
    CAPTURE(fault.name);
    const TemporaryFolder folder;
    const ProcessResult result = verify(folder, fault.name);
    CAPTURE(result.out);
    CAPTURE(result.err);
    CHECK(result.code == 1);
    CHECK(result.out.starts_with("FAILED scenes/whitted.toml"));
    for (const char* reason : fault.reasons) {
      CAPTURE(reason);
      CHECK(result.out.find(reason) != std::string::npos);
    }
    CHECK(result.out.find("twin against the reference") == std::string::npos);
    CHECK(read_text(folder / "kept/command.txt").find(fault.name) != std::string::npos);
  }
}

TEST_CASE("a picture with rays whose steps ran out does not pass, and says why" *
          doctest::test_suite("long")) {
  const TemporaryFolder folder;
  const ProcessResult result = run_eyeray({"verify", "scenes/shapes/superellipsoid.toml", "-s", "96x72",
                                           "--quiet", "--inject-fault", "steps", "--keep", folder / "kept"});
  CAPTURE(result.out);
  CHECK(result.code == 1);
  CHECK(result.out.find(" incomplete pixels: a shape was not found in the steps allowed") !=
        std::string::npos);
}

TEST_CASE("compare answers 1 to pictures of another size, too different, or not a number") {
  const TemporaryFolder folder;
  Image picture(8, 6, 3);
  write_image(folder / "a.pfm", picture);
  write_image(folder / "narrow.pfm", Image(7, 6, 3));
  write_image(folder / "grey.pfm", Image(8, 6, 1));
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
  for (const Failing& failing : {Failing{"narrow.pfm", "wrong size: 7×6 in 3 channels against 8×6"},
                                 {"grey.pfm", "wrong size: 8×6 in 1 channel against 8×6"},
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
