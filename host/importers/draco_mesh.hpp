// Meshes that are coded by Google's Draco. Private to the importers.
// Source: Draco Bitstream Specification 2.2.
#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <string_view>

namespace draco {
class Mesh;
}

namespace eyeray::engine::importers {

struct DracoResult {
  std::shared_ptr<const draco::Mesh> mesh;  // null where there is none to be had …
  std::string why;                          // … because the data "are damaged: …", …
  uint64_t values = 0;                      // numbers that were made: of corners and of vertices
};

// The decoded mesh. The data is not trusted: a few of its bytes claim the numbers of faces and vertices, and
// nothing is allocated for more than `most_values` numbers.
DracoResult decode_draco(std::string_view data, uint64_t most_values);

}  // namespace eyeray::engine::importers
