#include "host/pack/linear_list.hpp"

#include <algorithm>
#include <limits>
#include <vector>

#include "host/bvh/bvh.hpp"

namespace eyeray::engine::pack {
namespace {

// Nearly every ray that hits the scene hits a box of at least this share of the surface area of the scene's
// box. While few primitives have such boxes, to test them straight away is cheaper than the steps to them.
constexpr double most_of_scene = 0.5;
constexpr size_t most_in_linear_list = 4;

}  // namespace

void unbind_few(BlasRecords& items) {
  bvh::Box all;
  std::vector<size_t> of_kind(shader::SHAPE_KINDS);
  for (uint32_t i = 0; i < items.size(); ++i) {
    if (!items.boxes[i].is_finite()) continue;
    all.include(items.boxes[i]);
    ++of_kind[items.kind(i)];
  }
  const auto most_common = uint32_t(std::ranges::max_element(of_kind) - of_kind.begin());
  std::vector<uint32_t> few, others;
  for (uint32_t i = 0; i < items.size(); ++i) {
    if (!items.boxes[i].is_finite()) continue;
    if (items.boxes[i].area() >= most_of_scene * all.area())
      few.push_back(i);
    else if (items.kind(i) != most_common)
      others.push_back(i);
  }
  if (few.size() + others.size() <= most_in_linear_list)
    few.insert(few.end(), others.begin(), others.end());
  else if (few.size() > most_in_linear_list)
    return;
  for (const uint32_t i : few)
    items.boxes[i] = {glm::vec3(-std::numeric_limits<float>::infinity()),
                      glm::vec3(std::numeric_limits<float>::infinity())};
}

}  // namespace eyeray::engine::pack
