// Files inside the program (cmake/embed.cmake).
#pragma once

#include <string_view>

namespace eyeray::engine {

struct EmbeddedFile {
  std::string_view name;  // its path below the folder that it is from
  std::string_view text;
};

}  // namespace eyeray::engine
