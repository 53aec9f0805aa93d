// Small scenes, built in code.
#pragma once

#include <glm/gtc/matrix_transform.hpp>
#include <random>

#include "host/lights/make.hpp"
#include "host/materials/make.hpp"
#include "host/reference/renderer.hpp"
#include "host/shapes/make.hpp"
#include "tests/support/empty_scene.hpp"

namespace eyeray::engine::test {

inline TexturePtr gray(double value) {
  return textures::make_constant(Vec3(value));
}

inline int add(Scene& scene, std::unique_ptr<Material> material) {
  scene.materials.push_back(std::move(material));
  return int(scene.materials.size()) - 1;
}

inline int add(Scene& scene, std::unique_ptr<Shape> shape, int material) {
  shape->material = material;
  scene.shapes.push_back(std::move(shape));
  return int(scene.shapes.size()) - 1;
}

inline void add_point_light(Scene& scene, const Vec3& position, const Vec3& intensity,
                            Falloff falloff = Falloff::none) {
  scene.lights.push_back(lights::make_light(PointLight{position, intensity, falloff}));
}

inline void add_sun(Scene& scene, const Vec3& to_light, const Vec3& intensity, double angle = 0) {
  scene.lights.push_back(lights::make_light(DirectionalLight{glm::normalize(to_light), intensity, angle}));
}

inline void add_spot(Scene& scene, const SpotLight& values) {
  scene.lights.push_back(lights::make_light(values));
}

// A scene of one pixel, whose ray runs from `eye` exactly towards `target`.
inline Scene one_pixel(const Vec3& eye, const Vec3& target) {
  Scene scene = test::empty_scene();
  scene.image = {.width = 1, .height = 1};
  scene.camera.eye = eye;
  scene.camera.target = target;
  const Vec3 along = glm::abs(glm::normalize(target - eye));
  scene.camera.up = along.y > 0.9 ? Vec3(1, 0, 0) : Vec3(0, 1, 0);
  return scene;
}

inline PixelSample look(const Scene& scene) {
  return reference::Renderer(scene).sample(0, 0, 0);
}

inline bool near(double a, double b, double tolerance) {
  return std::abs(a - b) <= tolerance;
}
inline bool near(const Vec2& a, const Vec2& b, double tolerance) {
  return near(a.x, b.x, tolerance) && near(a.y, b.y, tolerance);
}
inline bool near(const Vec3& a, const Vec3& b, double tolerance) {
  return glm::length(a - b) <= tolerance;
}

// The surface that a ray hits; the test ends if it hits none.
inline SurfacePoint surface_hit(const Shape& shape, const Ray& ray) {
  return shape.surface(ray, shape.intersect(ray).value());
}
// The distance to the hit along the ray; -1 if the ray hits nothing.
inline double distance(const Shape& shape, const Ray& ray) {
  const auto hit = shape.intersect(ray);
  return hit ? hit->t : -1;
}

// Repeatable random values.
class Dice {
 public:
  double between(double low, double high) { return std::uniform_real_distribution(low, high)(engine_); }
  // 10^between(low, high).
  double scale(double low, double high) { return std::pow(10.0, between(low, high)); }
  Vec3 direction() {
    std::normal_distribution<double> normal;
    return glm::normalize(Vec3(normal(engine_), normal(engine_), normal(engine_)));
  }
  Vec3 in_box(double half) { return {between(-half, half), between(-half, half), between(-half, half)}; }

 private:
  std::mt19937_64 engine_{1980};
};

}  // namespace eyeray::engine::test
