// Decodes meshes that Google's Draco has compressed. Private to the importers.
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
  std::shared_ptr<const draco::Mesh> mesh;  // null if the data cannot be decoded …
  std::string why;                          // … because they "are damaged: …", …
  uint64_t values = 0;                      // count of decoded numbers, of corners and vertices
};

// The decoded mesh. The data is not trusted: a few of its bytes can claim any number of faces and vertices,
// so memory is allocated for at most `most_values` numbers.
DracoResult decode_draco(std::string_view data, uint64_t most_values);

}  // namespace eyeray::engine::importers
