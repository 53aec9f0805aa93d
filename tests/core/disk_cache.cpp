#include "host/core/disk_cache.hpp"

#include <sys/stat.h>
#include <unistd.h>

#include "tests/support/process.hpp"
//
#include "tests/support/doctest.hpp"

using namespace eyeray::engine;
using namespace eyeray::engine::test;
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

TEST_CASE("files that a cache makes are private under every umask") {
  const TemporaryFolder folder;
  const mode_t before = ::umask(0);
  const DiskCache cache(folder.path() / "cache");
  cache.store("a", "bytes");
  ::umask(before);
  CHECK(cache.load("a") == "bytes");
}

TEST_CASE("an unused cache gives a reason; a used or missing cache gives no warning") {
  const TemporaryFolder folder;
  const DiskCache cache(folder.path() / "cache");
  const std::string name = cache.folder().string();
  const std::string not_used = " is not used, so each start compiles again: ";
  using Warnings = std::vector<std::string>;
  CHECK(cache.warnings().empty());
  CHECK(DiskCache({}).warnings().empty());
  cache.store("a", "bytes");
  CHECK(cache.warnings().empty());
  std::filesystem::permissions(cache.folder(), perms(0770));
  CHECK(cache.warnings() == Warnings{"the cache " + name + not_used +
                                     "other users may write to it; chmod go-w " + name + " keeps them out"});
  std::filesystem::permissions(cache.folder(), perms(0700));

  // Modules of the twin and Mesa's compiled shaders lie in separate folders.
  std::filesystem::create_directory(cache.folder() / "twin");
  std::filesystem::permissions(cache.folder() / "twin", perms(0777));
  const std::string twin = name + "/twin";
  CHECK(cache.warnings() == Warnings{"the cache " + twin + not_used +
                                     "other users may write to it; chmod go-w " + twin + " keeps them out"});

  std::filesystem::create_directory_symlink(cache.folder(), folder / "link");
  CHECK(DiskCache(folder / "link").warnings() ==
        Warnings{"the cache " + folder / "link" + not_used +
                 "it is a symbolic link; name the folder that it leads to"});
  CHECK(DiskCache("/dev/null").warnings() ==
        Warnings{"the cache /dev/null" + not_used + "it is not a folder"});
  if (::geteuid() != 0) return;
  REQUIRE(::chown(cache.folder().c_str(), 12345, 12345) == 0);
  CHECK(cache.warnings() ==
        Warnings{"the cache " + name + not_used + "it belongs to another user, with the number 12345"});
}
