// The files of the page, embedded in the program.
#pragma once

#include <span>
#include <string_view>

namespace eyeray::dev {

struct PageFile {
  std::string_view name;
  std::string_view type;  // as HTTP says it
  std::string_view text;
};

std::span<const PageFile> page_files();

}  // namespace eyeray::dev
