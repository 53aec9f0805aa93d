#include <iterator>

#include "generate/gears.hpp"
#include "generate/mount.hpp"
#include "generate/rings.hpp"
#include "generate/teapot.hpp"
#include "generate/tetra.hpp"
#include "generate/tree.hpp"

namespace eyeray {

std::span<const Classic> classics() {
  static const Classic all[] = {tetra_classic, tree_classic,  rings_classic,
                                gears_classic, mount_classic, teapot_classic};
  return all;
}

}  // namespace eyeray
