#include "host/core/disk_cache.hpp"

#include <sys/stat.h>
#include <unistd.h>

#include "tests/support/process.hpp"
//
#include "tests/support/doctest.hpp"

using namespace eyeray;
using namespace eyeray::test;
using std::filesystem::perms;

TEST_CASE("a cache folder that others may write to is not used") {
  const TemporaryFolder folder;
  const DiskCache cache(folder.path() / "cache");
  cache.store("a", "bytes");
  REQUIRE(cache.load("a") == "bytes");
  for (const unsigned mode : {0777u, 0775u, 01777u}) {
    std::filesystem::permissions(cache.folder(), perms(mode));
    CHECK(!cache.load("a"));
    cache.store("b", "bytes");
    CHECK(!std::filesystem::exists(cache.folder() / "b.eyeray-cache"));
  }
  std::filesystem::permissions(cache.folder(), perms(0755));
  CHECK(cache.load("a") == "bytes");

  std::filesystem::create_directory_symlink(cache.folder(), folder / "link");
  CHECK(!DiskCache(folder / "link").load("a"));
}

TEST_CASE("a cache entry that others may write to, or a link, is not read") {
  const TemporaryFolder folder;
  const DiskCache cache(folder.path() / "cache");
  cache.store("a", "bytes");
  const std::filesystem::path entry = cache.folder() / "a.eyeray-cache";
  std::filesystem::permissions(entry, perms(0666));
  CHECK(!cache.load("a"));
  std::filesystem::permissions(entry, perms(0600));
  CHECK(cache.load("a") == "bytes");
  std::filesystem::rename(entry, folder / "elsewhere");
  std::filesystem::create_symlink(folder / "elsewhere", entry);
  CHECK(!cache.load("a"));
}

TEST_CASE("a cache folder or entry of another user is not used") {
  if (::geteuid() != 0) return;  // only root can give a file away
  const TemporaryFolder folder;
  const DiskCache cache(folder.path() / "cache");
  cache.store("a", "bytes");
  const std::filesystem::path entry = cache.folder() / "a.eyeray-cache";
  REQUIRE(::chown(entry.c_str(), 12345, 12345) == 0);
  CHECK(!cache.load("a"));
  REQUIRE(::chown(entry.c_str(), 0, 0) == 0);
  CHECK(cache.load("a") == "bytes");
  REQUIRE(::chown(cache.folder().c_str(), 12345, 12345) == 0);
  CHECK(!cache.load("a"));
}

TEST_CASE("what a cache makes is private under every umask") {
  const TemporaryFolder folder;
  const mode_t before = ::umask(0);
  const DiskCache cache(folder.path() / "cache");
  cache.store("a", "bytes");
  ::umask(before);
  CHECK(cache.load("a") == "bytes");
}
