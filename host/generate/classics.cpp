#include <iterator>

#include "host/generate/gears.hpp"
#include "host/generate/mount.hpp"
#include "host/generate/rings.hpp"
#include "host/generate/teapot.hpp"
#include "host/generate/tetra.hpp"
#include "host/generate/tree.hpp"

namespace eyeray::generate {

std::span<const Classic> classics() {
  static const Classic all[] = {tetra_classic, tree_classic,  rings_classic,
                                gears_classic, mount_classic, teapot_classic};
  return all;
}

}  // namespace eyeray::generate
