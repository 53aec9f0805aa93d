#include "host/core/private_folder.hpp"

#include <fmt/format.h>
#include <sys/stat.h>
#include <unistd.h>

#include <system_error>

namespace eyeray::engine {
namespace {

bool is_private(const std::filesystem::path& path, mode_t type) {
  struct stat status{};
  return ::lstat(path.c_str(), &status) == 0 && (status.st_mode & S_IFMT) == type &&
         status.st_uid == ::geteuid() && (status.st_mode & (S_IWGRP | S_IWOTH)) == 0;
}

}  // namespace

bool is_private_folder(const std::filesystem::path& folder) {
  return is_private(folder, S_IFDIR);
}

bool is_private_file(const std::filesystem::path& file) {
  return is_private(file, S_IFREG);
}

std::string why_not_private(const std::filesystem::path& folder) {
  struct stat status{};
  if (is_private_folder(folder) || ::lstat(folder.c_str(), &status) != 0) return "";
  if (S_ISLNK(status.st_mode)) return "it is a symbolic link; name the folder that it leads to";
  if (!S_ISDIR(status.st_mode)) return "it is not a folder";
  if (status.st_uid != ::geteuid())
    return fmt::format("it belongs to another user, with the number {}", status.st_uid);
  return fmt::format("other users may write to it; chmod go-w {} keeps them out", folder.string());
}

bool make_private_folder(const std::filesystem::path& folder) {
  std::error_code failed;
  std::filesystem::create_directories(folder.parent_path(), failed);
  ::mkdir(folder.c_str(), 0700);
  return is_private_folder(folder);
}

}  // namespace eyeray::engine
