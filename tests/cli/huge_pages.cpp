// Huge pages, where Linux gives them on request.
#include "scene.hpp"
//
#include "tests/support/doctest.hpp"

using namespace eyeray::engine;
using namespace eyeray::engine::test;

namespace {

// The page faults of a comparison of two pictures of 16 MB.
long page_faults(const SceneFolder& pictures, const Environment& environment) {
  const ProcessResult result =
      run_eyeray({"compare", pictures / "picture.pfm", pictures / "picture.pfm"}, environment);
  CAPTURE(result.err);
  REQUIRE(result.code == 0);
  return result.page_faults;
}

}  // namespace

TEST_CASE("eyeray requests huge pages, unless the user sets GLIBC_TUNABLES") {
  const SceneFolder pictures;
  write_text(pictures / "picture.pfm", "PF\n1024 1365\n-1\n" + std::string(1024 * 1365 * 12, '\0'));
  const long usual = page_faults(pictures, {}), plain = page_faults(pictures, {{"GLIBC_TUNABLES", ""}});
  CAPTURE(usual);
  CAPTURE(plain);
  const bool to_who_asks =
      read_text("/sys/kernel/mm/transparent_hugepage/enabled").find("[madvise]") != std::string::npos;
  if (to_who_asks)
    CHECK(2 * usual < plain);
  else
    CHECK(2 * usual > plain);
}
