#include "host/executors/fault.hpp"

#include <fmt/ranges.h>

#include <algorithm>
#include <limits>

#include "host/core/error.hpp"

namespace eyeray::executors {
namespace {

constexpr std::string_view names[] = {"",          "shift",  "nan", "black",       "ior",  "light",
                                      "near_root", "normal", "ids", "contraction", "steps"};

// `text` with `from` replaced; a fault that no longer finds its place must not pass unseen.
std::string replaced(std::string text, std::string_view from, std::string_view to) {
  const size_t at = text.find(from);
  CHECK(at != std::string::npos);
  return text.replace(at, from.size(), to);
}

}  // namespace

Fault::Fault(std::string name) : name_(std::move(name)) {
  if (std::find(std::begin(names), std::end(names), name_) == std::end(names))
    throw Error(ExitCode::bad_input, "no fault is called '{}'; known:{}", name_, fmt::join(names, " "));
}

void Fault::damage(PackedScene& scene) const {
  if (is("ior"))
    for (size_t i = 1; i < scene.media.size(); ++i) scene.media[i].ior *= 1.05f;
  if (is("light") && !scene.lights.empty()) scene.lights[0].intensity = shader::vec3(0);
}

std::string Fault::damage(std::string_view file, std::string text) const {
  if (is("near_root") && file == "shapes/sphere.glsl")
    return replaced(std::move(text), "ENTERS(ray, low) ? low : high", "low");
  if (is("normal") && file == "geometry/surface.glsl")
    return replaced(std::move(text), "  return surface;",
                    "  surface.normal = -surface.normal;\n  return surface;");
  if (is("ids") && file == "kernels/pixel.glsl")
    return replaced(std::move(text), "result.primitive = hit.id;", "result.primitive = hit.id ^ 1u;");
  if (is("steps") && file == "shapes/superellipsoid.glsl")
    return replaced(std::move(text), "SUPERELLIPSOID_STEPS 64u", "SUPERELLIPSOID_STEPS 4u");
  return text;
}

void Fault::damage(std::span<PixelSample> samples) const {
  if (is("nan") && !samples.empty())
    samples[samples.size() / 2].color.y = std::numeric_limits<double>::quiet_NaN();
  if (is("black"))
    for (PixelSample& sample : samples) sample.color = Vec3(0.0);
}

}  // namespace eyeray::executors
