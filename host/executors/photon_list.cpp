#include "host/executors/photon_list.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <tuple>

namespace eyeray::engine::executors {
namespace {

static_assert(most_photon_targets == MOST_PHOTON_TARGETS);

constexpr uint32_t least_keys = 1 << 8, most_keys = 1 << 22;

}  // namespace

PhotonList photon_list(std::span<const shader::Photon> stored, uint32_t key_mask,
                       std::span<const uint32_t> left_out) {
  PhotonList list;
  list.cells.assign(size_t(key_mask) + 2, 0);
  list.photons.resize(stored.size());

  // Count the photons of each key, sort all by key, then those of each key by number and depth.
  for (const shader::Photon& photon : stored) ++list.cells[size_t(photon.key) + 1];
  for (size_t key = 1; key < list.cells.size(); ++key) list.cells[key] += list.cells[key - 1];
  std::vector<uint32_t> next(list.cells.begin(), list.cells.end() - 1);
  for (const shader::Photon& photon : stored) {
    shader::Photon& placed = list.photons[next[photon.key]++];
    placed = photon;
    if (std::ranges::binary_search(left_out, photon.number)) placed.flux = shader::vec3(0);
  }
  for (size_t key = 0; key + 1 < list.cells.size(); ++key)
    std::sort(list.photons.begin() + list.cells[key], list.photons.begin() + list.cells[key + 1],
              [](const shader::Photon& a, const shader::Photon& b) {
                return std::tie(a.number, a.depth) < std::tie(b.number, b.depth);
              });
  return list;
}

shader::PhotonPass photon_pass(const PhotonSettings& settings, uint32_t index, const Vec3& eye,
                               uint32_t capacity) {
  const double radius = photon_radius(settings, index);
  shader::PhotonPass pass{};
  pass.center = glm::vec3(settings.center - eye);
  pass.reach = float(settings.reach);
  pass.radius_squared = float(radius * radius);
  pass.height = float(0.1 * radius);
  pass.cells = float(1 / (2 * radius));
  pass.scale = float(2 / (M_PI * radius * radius) / settings.count);
  pass.key_mask = std::clamp(std::bit_ceil(settings.count), least_keys, most_keys) - 1;
  pass.capacity = capacity;
  pass.target_count = uint32_t(settings.targets.size());
  for (size_t i = 0; i < settings.targets.size(); ++i)
    pass.targets[i] = glm::vec4(settings.targets[i].center - eye, settings.targets[i].radius);
  return pass;
}

}  // namespace eyeray::engine::executors
