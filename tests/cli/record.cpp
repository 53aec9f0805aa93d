// verify --record.
#include "scene.hpp"
#include "tests/support/faults.hpp"
//
#include "tests/support/doctest.hpp"

using namespace eyeray::engine;
using namespace eyeray::engine::test;

TEST_CASE("verify records the needs of a healthy scene, and nothing for a failing scene") {
  const SceneFolder folder;
  const std::string before = read_text(folder.scene());
  const auto verify = [&](std::vector<std::string> options) {
    options.insert(options.begin(), {"verify", folder.scene(), "--quiet", "--keep", folder / "kept"});
    return run_eyeray(options);
  };

  // Nothing is written for a picture other than the file's, or with a fault.
  CHECK(verify({"--record", "-s", "8x6"}).err ==
        "eyeray: error: --record verifies scenes as their files define them: leave out -s 8x6\n");
  CHECK(verify({"--record", "--crop", "0,0,8,6"}).code == 2);
  CHECK(verify({"--record", "--shaders", lay_fault(folder, "light")}).code == 1);
  CHECK(read_text(folder.scene()) == before);

  const ProcessResult recorded = verify({"--record"});
  CHECK(recorded.code == 0);
  CHECK(recorded.err == fmt::format("eyeray: recorded max_explained = 0 in {}\n", folder.scene()));
  CHECK(read_text(folder.scene()) == before + "\n[verify]\nmax_explained = 0\n");
  CHECK(verify({}).code == 0);

  // Recording again replaces the value; a value that is too high is no reason to refuse.
  write_text(folder.scene(), before + "\n[verify]\nmax_explained = 0.02 # too much\n");
  CHECK(verify({"--record"}).code == 0);
  CHECK(read_text(folder.scene()) == before + "\n[verify]\nmax_explained = 0 # too much\n");
}
