// Tests of the ways in which editors save files, and of changes to other files, which do not count.
#include "host/dev/file_watcher.hpp"

#include <unistd.h>

#include <thread>

#include "tests/support/process.hpp"
//
#include "tests/support/doctest.hpp"

using namespace eyeray::engine;
using namespace eyeray::engine::dev;
using namespace eyeray::engine::test;
namespace fs = std::filesystem;

namespace {

using Names = std::set<std::string>;

// The next report of the watcher while `work` is done.
template <typename Work>
Names changes_during(FileWatcher& watcher, const Work& work) {
  work();
  alarm(20);  // a change that is never reported ends the test
  const Names names = watcher.wait();
  alarm(0);
  return names;
}

}  // namespace

TEST_CASE("a save is reported once, however it is done") {
  const TemporaryFolder folder;
  const std::string file = folder / "scene.toml";
  write_text(file, "1");
  FileWatcher watcher;
  watcher.watch({{file}, {}, {}});

  SUBCASE("written in place") {
    CHECK(changes_during(watcher, [&] { write_text(file, "2"); }) == Names{"scene.toml"});
  }
  SUBCASE("renamed over") {
    const auto save = [&] {
      write_text(folder / "scene.toml.new", "2");
      fs::rename(folder / "scene.toml.new", file);
    };
    CHECK(changes_during(watcher, save) == Names{"scene.toml"});
    CHECK(changes_during(watcher, save) == Names{"scene.toml"});
  }
  SUBCASE("moved away, then written anew") {
    const auto save = [&] {
      fs::rename(file, folder / "scene.toml~");
      write_text(file, "2");
    };
    CHECK(changes_during(watcher, save) == Names{"scene.toml"});
  }
  SUBCASE("deleted, and back later") {
    CHECK(changes_during(watcher, [&] { fs::remove(file); }) == Names{"scene.toml"});
    CHECK(changes_during(watcher, [&] { write_text(file, "2"); }) == Names{"scene.toml"});
  }
  SUBCASE("the folder is replaced") {
    const auto replace = [&] {
      fs::rename(folder.path(), folder.path().string() + ".old");
      fs::create_directory(folder.path());
      write_text(file, "2");
    };
    CHECK_FALSE(changes_during(watcher, replace).empty());
    fs::remove_all(folder.path().string() + ".old");
    watcher.watch({{file}, {}, {}});
    CHECK(changes_during(watcher, [&] { write_text(file, "3"); }) == Names{"scene.toml"});
  }
}

TEST_CASE("changes to other files in the folder are not reported") {
  const TemporaryFolder folder;
  write_text(folder / "scene.toml", "1");
  FileWatcher watcher;
  watcher.watch({{folder / "scene.toml"}, {}, {}});
  write_text(folder / "scene.png", "picture");
  write_text(folder / ".scene.toml.swp", "editor");
  (void)read_text(folder / "scene.toml");
  CHECK(changes_during(watcher, [&] { write_text(folder / "scene.toml", "2"); }) == Names{"scene.toml"});
}

TEST_CASE("a file whose folder does not exist yet is watched") {
  const TemporaryFolder folder;
  FileWatcher watcher;
  const WatchList list{{folder / "a/b/mesh.toml"}, {}, {}};
  watcher.watch(list);
  CHECK(changes_during(watcher, [&] { fs::create_directory(folder / "a"); }) == Names{"a"});
  watcher.watch(list);
  CHECK(changes_during(watcher, [&] { fs::create_directory(folder / "a/b"); }) == Names{"b"});
  watcher.watch(list);
  CHECK(changes_during(watcher, [&] { write_text(folder / "a/b/mesh.toml", "1"); }) == Names{"mesh.toml"});
}

TEST_CASE("the target of a symbolic link is watched") {
  const TemporaryFolder folder;
  fs::create_directory(folder / "real");
  write_text(folder / "real/scene.toml", "1");
  fs::create_symlink(folder / "real/scene.toml", folder / "link.toml");
  FileWatcher watcher;
  watcher.watch({{folder / "link.toml"}, {}, {}});
  CHECK(changes_during(watcher, [&] { write_text(folder / "real/scene.toml", "2"); }) == Names{"scene.toml"});
}

TEST_CASE("all files of a kind below a folder are watched, in new folders too") {
  const TemporaryFolder folder;
  fs::create_directories(folder / "shaders/shapes");
  FileWatcher watcher;
  const WatchList list{{}, {folder / "shaders"}, {".glsl"}};
  watcher.watch(list);
  write_text(folder / "shaders/shapes/notes.txt", "1");
  CHECK(changes_during(watcher, [&] { write_text(folder / "shaders/shapes/cone.glsl", "1"); }) ==
        Names{"cone.glsl"});
  CHECK(changes_during(watcher, [&] { fs::create_directory(folder / "shaders/new"); }) == Names{"new"});
  watcher.watch(list);
  CHECK(changes_during(watcher, [&] { write_text(folder / "shaders/new/x.glsl", "1"); }) == Names{"x.glsl"});
}

TEST_CASE("a file that is missing for a moment is reported once it is back") {
  const TemporaryFolder folder;
  const std::string file = folder / "scene.toml";
  write_text(file, "1");
  FileWatcher watcher;
  watcher.watch({{file}, {}, {}});
  std::thread editor([&] {
    fs::rename(file, folder / "scene.toml~");
    std::this_thread::sleep_for(std::chrono::milliseconds(50));
    write_text(file, "2");
  });
  CHECK(changes_during(watcher, [] {}) == Names{"scene.toml"});
  CHECK(read_text(file) == "2");
  editor.join();
}

TEST_CASE("many saves in a row are one change") {
  const TemporaryFolder folder;
  const std::string file = folder / "scene.toml";
  // A busy machine may stretch the pauses between the saves: try until they were short.
  for (double longest_pause = 1; longest_pause > 0.008;) {
    longest_pause = 0;
    FileWatcher watcher;
    watcher.watch({{file}, {}, {}});
    std::thread editor([&] {
      for (int i = 0; i < 5; ++i) {
        const Stopwatch pause;
        write_text(file, std::to_string(i));
        if (i < 4) std::this_thread::sleep_for(std::chrono::milliseconds(1));
        longest_pause = std::max(longest_pause, pause.seconds());
      }
    });
    watcher.wait();
    const std::string seen = read_text(file);
    editor.join();
    if (longest_pause <= 0.008) CHECK(seen == "4");
  }
}
