#include "host/core/atomic_file.hpp"

#include "tests/support/process.hpp"
//
#include "tests/support/doctest.hpp"

using namespace eyeray::engine;
using eyeray::engine::test::read_text;
using eyeray::engine::test::TemporaryFolder;
using eyeray::engine::test::write_text;

namespace {

// The exit code that `action` fails with; ok when it does not.
template <typename Action>
ExitCode failure(const Action& action) {
  try {
    action();
  } catch (const Error& error) {
    return error.code();
  }
  return ExitCode::ok;
}

}  // namespace

TEST_CASE("a file is written whole, replaces an older one, and no other file is left") {
  const TemporaryFolder folder;
  write_file_atomically(folder / "a", std::string_view("first, and longer"));
  write_file_atomically(folder / "a", std::string_view("second"));
  CHECK(read_text(folder / "a") == "second");
  CHECK(read_file(folder / "a") == "second");
  CHECK(folder.names() == std::set<std::string>{"a"});
}

TEST_CASE("a name may be as long as the file system allows") {
  const TemporaryFolder folder;
  std::string name(255, 'a');
  for (size_t i = 1; i + 1 < name.size(); i += 2) name.replace(i, 2, "\u00e4");
  write_file_atomically(folder / name, std::string_view("x"));
  CHECK(folder.names() == std::set<std::string>{name});
}

TEST_CASE("all bytes survive, including zeros, beyond the size of one write and one read") {
  const TemporaryFolder folder;
  std::string bytes(3'000'001, '\0');
  for (size_t i = 0; i < bytes.size(); ++i) bytes[i] = char(i * 7 % 251);
  write_file_atomically(folder / "a", bytes);
  CHECK(read_file(folder / "a") == bytes);
}

TEST_CASE("a name without a folder is a file in the current folder") {
  const TemporaryFolder folder;
  const auto before = std::filesystem::current_path();
  std::filesystem::current_path(folder.path());
  write_file_atomically("plain", std::string_view("x"));
  std::filesystem::current_path(before);
  CHECK(folder.names() == std::set<std::string>{"plain"});
}

TEST_CASE("a failed write is a file error with the reason, and leaves everything unchanged") {
  const TemporaryFolder folder;
  CHECK(failure([&] { write_file_atomically(folder / "no/such/folder", std::string_view("x")); }) ==
        ExitCode::file_io);
  CHECK(failure([&] { check_writable(folder / "no/such/folder"); }) == ExitCode::file_io);
  CHECK(failure([&] { read_file(folder / "nothing"); }) == ExitCode::file_io);
  CHECK(failure([&] { read_file(folder.path()); }) == ExitCode::file_io);

  // A folder and a device are no files to replace, whoever may write to them.
  CHECK(failure([&] { write_file_atomically(folder.path(), std::string_view("x")); }) == ExitCode::file_io);
  CHECK(failure([] { write_file_atomically("/dev/null", std::string_view("x")); }) == ExitCode::file_io);
  CHECK(std::filesystem::is_character_file("/dev/null"));

  // The reason is the operating system's.
  try {
    read_file(folder / "nothing");
  } catch (const Error& error) {
    CHECK(std::string(error.what()).find("No such file or directory") != std::string::npos);
  }
  CHECK(folder.names().empty());
}

TEST_CASE("a full disk leaves the old file and no part of the new one") {
  // /dev/full allows no renaming in it; a file size limit fails the write in the same way.
  const TemporaryFolder folder;
  write_text(folder / "a", "old");
  const std::string script = "trap '' XFSZ; ulimit -f 1; exec \"$0\" --test-case='write much' --no-skip";
  const auto result =
      run_process({"/bin/sh", "-c", script, std::filesystem::read_symlink("/proc/self/exe").string()},
                  {{"EYERAY_TEST_FILE", folder / "a"}});
  CHECK(result.code == 0);
  CHECK(read_text(folder / "a") == "old");
  CHECK(folder.names() == std::set<std::string>{"a"});
}

TEST_CASE("write much" * doctest::skip()) {
  const char* path = std::getenv("EYERAY_TEST_FILE");
  REQUIRE(path != nullptr);
  const std::string much(1 << 20, 'x');
  CHECK(failure([&] { write_file_atomically(path, much); }) == ExitCode::file_io);
}

TEST_CASE("check_writable leaves no trace, and keeps an existing file") {
  const TemporaryFolder folder;
  check_writable(folder / "new");
  CHECK(folder.names().empty());
  write_text(folder / "old", "kept");
  check_writable(folder / "old");
  CHECK(read_text(folder / "old") == "kept");
}

TEST_CASE("a symbolic link stays, and the file that it points to is written") {
  const TemporaryFolder folder;
  std::filesystem::create_directory(folder / "sub");
  write_text(folder / "sub/target", "old");
  std::filesystem::create_symlink("sub/target", folder / "link");
  std::filesystem::create_symlink("link", folder / "second");
  std::filesystem::create_symlink("sub/new", folder / "dangling");
  std::filesystem::create_symlink("loop", folder / "loop");
  for (const char* name : {"link", "second"}) {
    write_file_atomically(folder / name, std::string_view(name));
    CHECK(read_text(folder / "sub/target") == name);
    CHECK(std::filesystem::is_symlink(folder / name));
  }
  write_file_atomically(folder / "dangling", std::string_view("made"));
  CHECK(std::filesystem::is_symlink(folder / "dangling"));
  CHECK(read_text(folder / "sub/new") == "made");
  CHECK(failure([&] { write_file_atomically(folder / "loop", std::string_view("x")); }) == ExitCode::file_io);
  CHECK(std::filesystem::is_symlink(folder / "loop"));
}

TEST_CASE("all hard links of a file have the new content") {
  const TemporaryFolder folder;
  const std::string longer(3'000'000, 'x');
  write_text(folder / "a", "old");
  std::filesystem::create_hard_link(folder / "a", folder / "b");
  std::filesystem::create_symlink("a", folder / "link");
  for (const std::string& content : {longer, std::string("short"), std::string()}) {
    write_file_atomically(folder / "link", content);
    CHECK(read_text(folder / "a") == content);
    CHECK(read_text(folder / "b") == content);
  }
  CHECK(std::filesystem::hard_link_count(folder / "b") == 2);
  CHECK(folder.names() == std::set<std::string>{"a", "b", "link"});
  check_writable(folder / "a");
  CHECK(std::filesystem::hard_link_count(folder / "b") == 2);
}

TEST_CASE("a replaced file keeps its mode") {
  using std::filesystem::perms;
  const TemporaryFolder folder;
  write_text(folder / "a", "old");
  for (const unsigned mode : {0600u, 0640u, 0664u, 0755u}) {
    std::filesystem::permissions(folder / "a", perms(mode));
    write_file_atomically(folder / "a", std::string_view("new"));
    CHECK(std::filesystem::status(folder / "a").permissions() == perms(mode));
  }
}

TEST_CASE("errors show the given file name on one line") {
  const TemporaryFolder folder;
  try {
    write_file_atomically(folder / "no\n::such/a\x1b.png", std::string_view("x"));
    FAIL("written");
  } catch (const Error& error) {
    CHECK(std::string(error.what()) ==
          "cannot write " + (folder / "no?::such/a?.png") + ": No such file or directory");
  }
}
