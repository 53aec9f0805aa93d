// The source of fonts in files that a scene names. The loader decides which files may be read, and how.
#pragma once

#include <memory>
#include <string>

#include "host/core/diagnostic.hpp"

namespace eyeray::engine::reading {

class FontSource {
 public:
  virtual ~FontSource() = default;

  // The bytes of the file `name`, which the scene names at `position`. Null, with an error in the log, if the
  // file may not or cannot be read.
  virtual std::shared_ptr<const std::string> load(const std::string& name,
                                                  const SourcePosition& position) = 0;
};

}  // namespace eyeray::engine::reading
