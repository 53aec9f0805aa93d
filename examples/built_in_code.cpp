// built_in_code PICTURE: a scene without a file, a mesh without one either.
#include <eyeray/eyeray.hpp>

#include <cmath>
#include <cstdio>
#include <vector>

namespace {

// A sheet of n × n squares that ripples around the origin.
struct Sheet {
  std::vector<float> positions;
  std::vector<uint32_t> triangles;
};

Sheet ripples(uint32_t n) {
  Sheet sheet;
  for (uint32_t j = 0; j <= n; ++j) {
    for (uint32_t i = 0; i <= n; ++i) {
      const float x = 4 * float(i) / float(n) - 2, z = 4 * float(j) / float(n) - 2;
      sheet.positions.insert(sheet.positions.end(), {x, 0.15f * std::cos(6 * std::hypot(x, z)), z});
    }
  }
  for (uint32_t j = 0; j < n; ++j) {
    for (uint32_t i = 0; i < n; ++i) {
      const uint32_t a = j * (n + 1) + i, b = a + 1, c = a + n + 1, d = c + 1;
      sheet.triangles.insert(sheet.triangles.end(), {a, c, b, b, c, d});
    }
  }
  return sheet;
}

}  // namespace

int main(int argc, char** argv) try {
  if (argc != 2) return std::fputs("usage: built_in_code PICTURE\n", stderr), 2;
  using eyeray::Table;
  eyeray::SceneBuilder builder;
  builder.set("image", Table().set("width", 160).set("height", 120).set("samples", 4));
  builder.set("camera", Table().set("eye", {0, 2, 4}).set("target", {0, 0.3, 0}));
  builder.set("render", Table().set("background", {0.3, 0.5, 0.8}).set("ambient", 0.2));
  builder.add("light",
              Table().set("type", "point").set("position", {3, 5, 2}).set("intensity", {20, 20, 20}));
  builder.add("material", Table().set("name", "glass").set("type", "dielectric").set("ior", 1.5));
  builder.add("material", Table().set("name", "clay").set("type", "phong").set("diffuse", {0.8, 0.4, 0.2}));
  builder.add("sphere", Table().set("center", {0, 0.9, 0}).set("radius", 0.6).set("material", "glass"));
  const Sheet sheet = ripples(64);
  builder.add_mesh({sheet.positions, sheet.triangles}, Table().set("material", "clay"));

  eyeray::Renderer renderer;
  const eyeray::Picture picture = renderer.render(builder.scene());
  picture.write(argv[1]);

  // Faults are refused as in a file, by the line of builder.text().
  try {
    builder.add("sphere", Table().set("center", {0, 0, 0}).set("radius", -1).set("material", "glass"));
    static_cast<void>(builder.scene());
  } catch (const eyeray::Error& error) {
    const eyeray::Diagnostic& first = error.diagnostics().front();
    std::printf("refused at line %d: %s\n", first.line, first.message.c_str());
  }
  return 0;
} catch (const eyeray::Error& error) {
  std::fprintf(stderr, "%s\n", error.what());
  return 1;
}
