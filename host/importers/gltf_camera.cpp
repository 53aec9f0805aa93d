#include "host/importers/gltf_camera.hpp"

#include <algorithm>

#include "host/scene/affine.hpp"

namespace eyeray::engine::importers {

namespace {

// Checks the clipping planes of a perspective or orthographic camera. `sound`: true if its other values are
// in range.
void check_planes(const GltfObject& form, bool sound, GltfBreaches& breaches) {
  if (!sound || (form.has("zfar") && !(form.number("zfar", 0) > form.number("znear", 0))))
    breaches.add("cameras whose aspectRatio, ymag, znear or zfar is out of range, which is ignored",
                 form.location());
}

}  // namespace

ImportedCamera gltf_camera(const GltfObject& source, const Mat4& world, GltfBreaches& breaches) {
  ImportedCamera camera;
  camera.eye = Vec3(world[3]);
  camera.target = camera.eye - unit(Vec3(world[2])) * std::max(1.0, magnitude(camera.eye));
  camera.up = unit(Vec3(world[1]));
  if (source.has("perspective") && source.has("orthographic"))
    source.fail("is both perspective and orthographic");
  if (const auto perspective = source.object("perspective")) {
    const double degrees = glm::degrees(perspective->number("yfov", 0));
    if (!(degrees > 0 && degrees < 180)) perspective->fail("has a yfov that is out of range");
    camera.form = PerspectiveCamera{degrees, FovAxis::vertical};
    check_planes(*perspective,
                 perspective->number("znear", 1) > 0 && perspective->number("aspectRatio", 1) > 0, breaches);
  } else if (const auto orthographic = source.object("orthographic")) {
    const double size = orthographic->number("xmag", 0);
    if (!(size > 1e-12 && size < 1e12)) orthographic->fail("has an xmag that is out of range");
    camera.form = OrthographicCamera{size};
    check_planes(*orthographic, orthographic->number("znear", 0) >= 0 && orthographic->number("ymag", 1) > 0,
                 breaches);
  } else {
    source.fail("is neither perspective nor orthographic");
  }
  return camera;
}

}  // namespace eyeray::engine::importers
