#include "benchmarks/contenders/embree_world.hpp"

#include <span>

#include "host/bvh/embree_version.hpp"
#include "host/core/error.hpp"
#include "host/core/stopwatch.hpp"

namespace eyeray::engine::contenders {
namespace {

// Throws the error that Embree has recorded of a faulty call, if there is one.
void throw_errors(RTCDevice device) {
  const RTCError error = rtcGetDeviceError(device);
  if (error == RTC_ERROR_OUT_OF_MEMORY) throw std::bad_alloc();
  CHECK_EQ(int(error), int(RTC_ERROR_NONE));
}

// Sets a buffer of `count` elements, each of `floats` floats, and fills it by fill(float*, index).
template <typename Fill>
void fill_floats(RTCGeometry geometry, RTCBufferType type, RTCFormat format, size_t floats, size_t count,
                 const Fill& fill) {
  auto* const data =
      static_cast<float*>(rtcSetNewGeometryBuffer(geometry, type, 0, format, floats * sizeof(float), count));
  if (!data) throw std::bad_alloc();
  for (size_t i = 0; i < count; ++i) fill(data + i * floats, i);
}

void store(float* to, const Vec3& v) {
  for (int i = 0; i < 3; ++i) to[i] = float(v[i]);
}

RTCGeometry triangles(RTCDevice device, std::span<const Vec3> vertices, const Mat4& transform,
                      std::span<const std::array<uint32_t, 3>> corners) {
  const RTCGeometry geometry = rtcNewGeometry(device, RTC_GEOMETRY_TYPE_TRIANGLE);
  fill_floats(geometry, RTC_BUFFER_TYPE_VERTEX, RTC_FORMAT_FLOAT3, 3, vertices.size(),
              [&](float* to, size_t i) { store(to, Vec3(transform * Vec4(vertices[i], 1))); });
  void* const indices = rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3,
                                                sizeof corners[0], corners.size());
  if (!indices) throw std::bad_alloc();
  std::copy(corners.begin(), corners.end(), static_cast<std::array<uint32_t, 3>*>(indices));
  return geometry;
}

bool is_opaque(const Scene& scene, int material) {
  return scene.materials[size_t(material)]->shadow_transmittance() == 0;
}

bool count_bytes(void* world, ssize_t bytes, bool) {
  static_cast<EmbreeWorld*>(world)->bytes += bytes;
  return true;
}

}  // namespace

void EmbreeRelease::operator()(RTCDeviceTy* device) const {
  rtcReleaseDevice(device);
}
void EmbreeRelease::operator()(RTCSceneTy* scene) const {
  rtcReleaseScene(scene);
}

EmbreeWorld::EmbreeWorld(const Scene& scene) : device_(rtcNewDevice(nullptr)) {
  if (!device_) throw Error(ExitCode::bad_input, "Embree cannot be used on this processor");
  rtcSetDeviceMemoryMonitorFunction(device_.get(), count_bytes, this);
  all_.reset(rtcNewScene(device_.get()));
  for (const auto& material : scene.materials) {
    if (material->mask)
      throw Error(ExitCode::bad_input, "material \"{}\" has cutouts, which Embree's triangles cannot have",
                  material->name);
    if (material->shadow_transmittance() > 0 && !opaque_) opaque_.reset(rtcNewScene(device_.get()));
  }
  if (!scene.group_instances.empty())
    throw Error(ExitCode::bad_input,
                "Embree is raced without instanced groups: copy them, -D render.groups=flat");
  add_shapes(scene);
  add_meshes(scene);

  // The time is of the scenes that any renderer needs. The opaque scene is not timed: only our glass needs
  // it.
  const Stopwatch watch;
  for (const auto& mesh : meshes_) rtcCommitScene(mesh.get());
  rtcCommitScene(all_.get());
  build_seconds = watch.seconds();
  if (opaque_) rtcCommitScene(opaque_.get());
  throw_errors(device_.get());
}

void EmbreeWorld::attach(RTCGeometryTy* geometry, EmbreePart part, bool opaque) {
  rtcCommitGeometry(geometry);
  const auto id = unsigned(parts.size());
  rtcAttachGeometryByID(all_.get(), geometry, id);
  if (opaque_ && opaque) rtcAttachGeometryByID(opaque_.get(), geometry, id);
  rtcReleaseGeometry(geometry);
  parts.push_back(std::move(part));
}

void EmbreeWorld::add_shapes(const Scene& scene) {
  for (const bool opaque : {true, false}) {
    std::vector<SphereForm> spheres;
    std::vector<Vec3> vertices;
    EmbreePart sphere_part, triangle_part;
    for (size_t i = 0; i < scene.shapes.size(); ++i) {
      if (is_opaque(scene, scene.shapes[i]->material) != opaque) continue;
      const ShapeForm form = scene.shapes[i]->form();
      if (const auto* sphere = std::get_if<SphereForm>(&form)) {
        spheres.push_back(*sphere);
        sphere_part.primitives.push_back(int64_t(i));
      } else if (const auto* triangle = std::get_if<TriangleForm>(&form)) {
        vertices.insert(vertices.end(), triangle->vertices.begin(), triangle->vertices.end());
        triangle_part.primitives.push_back(int64_t(i));
      } else if (const auto* plane = std::get_if<PlaneForm>(&form)) {
        EmbreePlane& added = planes.emplace_back();
        store(added.normal, plane->normal);
        added.distance = float(glm::dot(plane->normal, plane->point));
        added.primitive = int64_t(i);
        added.opaque = opaque;
      } else {
        throw Error(ExitCode::bad_input, "{}:{}: Embree has no such shape", scene.shapes[i]->position.file,
                    scene.shapes[i]->position.line);
      }
    }
    if (!spheres.empty()) {
      const RTCGeometry geometry = rtcNewGeometry(device_.get(), RTC_GEOMETRY_TYPE_SPHERE_POINT);
      fill_floats(geometry, RTC_BUFFER_TYPE_VERTEX, RTC_FORMAT_FLOAT4, 4, spheres.size(),
                  [&](float* to, size_t i) {
                    store(to, spheres[i].center);
                    to[3] = float(spheres[i].radius);
                  });
      attach(geometry, std::move(sphere_part), opaque);
    }
    if (!vertices.empty()) {
      std::vector<std::array<uint32_t, 3>> corners(vertices.size() / 3);
      for (uint32_t i = 0; i < corners.size(); ++i) corners[i] = {3 * i, 3 * i + 1, 3 * i + 2};
      attach(triangles(device_.get(), vertices, Mat4(1.0), corners), std::move(triangle_part), opaque);
    }
  }
}

void EmbreeWorld::add_meshes(const Scene& scene) {
  std::vector<int> uses(scene.meshes.size());
  for (const Instance& instance : scene.instances) ++uses[size_t(instance.mesh)];
  std::vector<RTCScene> shared(scene.meshes.size());

  int64_t first = int64_t(scene.shapes.size());
  for (const Instance& instance : scene.instances) {
    const size_t i = size_t(instance.mesh);
    const Mesh& mesh = scene.meshes[i];
    const bool opaque = is_opaque(scene, instance.material);
    if (uses[i] == 1) {
      attach(triangles(device_.get(), mesh.positions, instance.transform, mesh.triangles),
             {.first = first, .primitives = {}}, opaque);
    } else {
      if (!shared[i]) {
        shared[i] = rtcNewScene(device_.get());
        meshes_.emplace_back(shared[i]);
        const RTCGeometry geometry = triangles(device_.get(), mesh.positions, Mat4(1.0), mesh.triangles);
        rtcCommitGeometry(geometry);
        rtcAttachGeometry(shared[i], geometry);
        rtcReleaseGeometry(geometry);
      }
      const RTCGeometry geometry = rtcNewGeometry(device_.get(), RTC_GEOMETRY_TYPE_INSTANCE);
      rtcSetGeometryInstancedScene(geometry, shared[i]);
      const glm::mat4 transform(instance.transform);
      rtcSetGeometryTransform(geometry, 0, RTC_FORMAT_FLOAT4X4_COLUMN_MAJOR, &transform[0][0]);
      attach(geometry, {.first = first, .primitives = {}}, opaque);
    }
    first += int64_t(mesh.triangles.size());
  }
}

}  // namespace eyeray::engine::contenders
