// Tests of changes of a file: which of them count.
#include "host/dev/source_files.hpp"

#include "tests/support/process.hpp"
//
#include "tests/support/doctest.hpp"

using namespace eyeray::engine::dev;
using namespace eyeray::engine::test;
namespace fs = std::filesystem;

namespace {

const SourceFiles::Clock::time_point in_a_while = SourceFiles::Clock::now() + std::chrono::hours(1);

}  // namespace

TEST_CASE("a file counts as changed if its bytes changed, not if it was only saved") {
  const TemporaryFolder folder;
  const fs::path file = folder / "a.glsl";
  write_text(file, "1");
  SourceFiles files;
  files.set({file, folder / "not-there"}, in_a_while);
  CHECK(files.changed().empty());
  write_text(file, "1");
  CHECK(files.changed().empty());
  write_text(file, "2");
  CHECK(files.changed() == std::set<fs::path>{file});
  CHECK(files.changed().empty());
  fs::remove(file);
  CHECK_FALSE(files.changed().empty());
  write_text(folder / "not-there", "");
  CHECK_FALSE(files.changed().empty());
  write_text(folder / "other", "1");
  CHECK(files.changed().empty());
}

TEST_CASE("a file that was saved while it was read counts as changed") {
  const TemporaryFolder folder;
  write_text(folder / "a.glsl", "1");
  SourceFiles files;
  files.set({folder / "a.glsl"}, SourceFiles::Clock::now() - std::chrono::hours(1));
  CHECK_FALSE(files.changed().empty());
  CHECK(files.changed().empty());
  // A saved file counts as changed once, even if it was known and its bytes are the same: a reader may have
  // seen it half written.
  const auto before = SourceFiles::now();
  CHECK_FALSE(files.any_unknown());
  write_text(folder / "a.glsl", "1");
  files.set({folder / "a.glsl"}, before);
  CHECK(files.any_unknown());
  CHECK_FALSE(files.changed().empty());
  files.set({folder / "a.glsl"}, before);
  CHECK_FALSE(files.any_unknown());
  CHECK(files.changed().empty());
  // set() keeps the known state of a file that it names again.
  write_text(folder / "a.glsl", "2");
  files.set({folder / "a.glsl"}, in_a_while);
  CHECK_FALSE(files.changed().empty());
}

TEST_CASE("a change without notification is found once the file stays the same") {
  const TemporaryFolder folder;
  const fs::path file = folder / "a.glsl";
  write_text(file, "1");
  SourceFiles files;
  files.set({file}, in_a_while);
  CHECK(files.changed_unnoticed().empty());
  write_text(file, "22");
  CHECK(files.changed_unnoticed().empty());
  write_text(file, "333");
  CHECK(files.changed_unnoticed().empty());
  CHECK_FALSE(files.changed_unnoticed().empty());
  CHECK(files.changed_unnoticed().empty());
}
