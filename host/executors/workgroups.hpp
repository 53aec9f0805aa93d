// The number of workgroups in a dispatch. Each has 64 invocations.
#pragma once

#include <cstdint>

#include "host/records/records.hpp"

namespace eyeray::engine::executors {

struct Workgroups {
  uint32_t stride = 1;    // GROUP_STRIDE: a CPU driver splits a dispatch evenly over so many threads
  uint32_t subgroup = 8;  // lanes

  // For one invocation per item.
  uint32_t of_items(uint32_t count) const { return in_runs(count, 64); }
  // For packets of rays, each traced by one subgroup (kernels/cooperative/packet.comp.glsl).
  uint32_t of_packets(uint32_t rays) const { return in_runs(rays, 64 / subgroup * PACKET); }

  // The number of pixels of a tile whose sides are rounded up to multiples of 8: a workgroup has 8 × 8 pixels
  // (kernels/tile.glsl).
  static uint32_t pixels(uint32_t width, uint32_t height) {
    return (width + 7) / 8 * ((height + 7) / 8) * 64;
  }

 private:
  // The number of workgroups that makes runs of equal length.
  uint32_t in_runs(uint32_t items, uint32_t a_group) const {
    const uint32_t groups = (items + a_group - 1) / a_group;
    return (groups + stride - 1) / stride * stride;
  }
};

}  // namespace eyeray::engine::executors
