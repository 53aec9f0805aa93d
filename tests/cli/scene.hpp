// The scene that these tests render: one sphere over a plane, small enough to take no time.
#pragma once

#include "tests/support/shader_overlay.hpp"

namespace eyeray::engine::test {

inline constexpr const char* small_scene = R"([image]
width = 64
height = 48

[camera]
eye = [0, 1, 4]
target = [0, 1, 0]
fov = 60

[render]
background = [0.25, 0.5, 0.75]
ambient = [0.2, 0.2, 0.2]

[[light]]
type = "point"
position = [3, 5, 4]
intensity = [20, 20, 20]

[[material]]
name = "matte"
type = "phong"
diffuse = [0.8, 0.4, 0.2]

[[sphere]]
center = [0, 1, 0]
radius = 1
material = "matte"
)";

// An empty folder with scene.toml in it.
class SceneFolder : public TemporaryFolder {
 public:
  SceneFolder() { write_text(scene(), small_scene); }
  std::string scene() const { return *this / "scene.toml"; }
};

inline void replace_in_file(const std::string& path, const std::string& before, const std::string& after) {
  write_text(path, replaced(read_text(path), before, after));
}

// kernels/pixel.glsl with `statements` put in where a sample's `color` is known and not yet stored.
inline std::string with_pixel_code(const std::string& shader, const std::string& statements) {
  const std::string before = "  return sample_result(";
  return replaced(shader, before, statements + before);
}

// Writes below `folder` the shader that renders a sample, made to loop without end.
// (Mesa 22.3.6 ends any loop after 65 535 iterations; the work in each makes that take far longer than the
// tests' time-outs.)
inline void lay_endless_shader(const std::string& folder) {
  std::string work;
  for (int i = 0; i < 96; ++i) work += "    e = sin(e * 1.7 + float(x)) + cos(e + float(y));\n";
  lay_shader(
      folder, "kernels/pixel.glsl",
      with_pixel_code(own_shader("kernels/pixel.glsl"),
                      "  float e = 1.0;\n  do {\n" + work + "  } while (e < 100.0);\n  color.x += e;\n"));
}

}  // namespace eyeray::engine::test
