// The scene that these tests render: one sphere over a plane, small enough to take no time.
#pragma once

#include "tests/support/process.hpp"

namespace eyeray::test {

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

// `text` with its only occurrence of `before` replaced; throws when there is none.
inline std::string replaced(std::string text, const std::string& before, const std::string& after) {
  const size_t at = text.find(before);
  if (at == std::string::npos) throw std::runtime_error("no '" + before + "' in the text");
  return text.replace(at, before.size(), after);
}

inline void replace_in_file(const std::string& path, const std::string& before, const std::string& after) {
  write_text(path, replaced(read_text(path), before, after));
}

// shaders/kernels/pixel.glsl with `statements` put in where a sample's `color` is known and not yet stored.
inline std::string with_pixel_code(const std::string& shader, const std::string& statements) {
  const std::string place = "  return sample_result(";
  return replaced(shader, place, statements + place);
}

// Exports the embedded shaders to `folder` and makes the one that renders a sample loop without end.
// (Mesa 22.3.6 ends any loop after 65 535 turns; the work in each makes that take far longer than the tests'
// time-outs.)
inline void export_endless_shaders(const std::string& folder) {
  if (run_eyeray({"shaders", "--export", folder}).code != 0)
    throw std::runtime_error("shaders --export failed");
  std::string work;
  for (int i = 0; i < 96; ++i) work += "    e = sin(e * 1.7 + float(x)) + cos(e + float(y));\n";
  const std::string pixel = folder + "/kernels/pixel.glsl";
  write_text(pixel, with_pixel_code(read_text(pixel), "  float e = 1.0;\n  do {\n" + work +
                                                          "  } while (e < 100.0);\n  color.x += e;\n"));
}

}  // namespace eyeray::test
