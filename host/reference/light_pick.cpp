// Conty Estevez, Kulla: Importance Sampling of Many Lights with Adaptive Tree Splitting, HPG 2018.
#include "host/reference/light_pick.hpp"

#include <algorithm>
#include <cmath>

#include "host/reference/rng.hpp"
#include "host/scene/whole_shares.hpp"

namespace eyeray::engine::reference {

namespace {

// The least value of a cosine in an importance, and the tolerance at the limits of angles. So rounding
// excludes no light that shines.
constexpr double least_cosine = 1e-4;
// The number of levels for which one random number is used.
constexpr int levels_a_number = 4;

double angle_between(const Vec3& a, const Vec3& b) {
  return std::atan2(glm::length(glm::cross(a, b)), glm::dot(a, b));
}

struct Pair {
  Pair(const LightBvh& bvh, uint32_t index, const LitPoint& point)
      : children{&bvh.nodes[index], &bvh.nodes[index + 1]},
        importances{importance(children[0]->bounds, point), importance(children[1]->bounds, point)} {}

  double share(bool second) const {
    const double sum = importances[0] + importances[1];
    return sum > 0 ? importances[second] / sum : 0;
  }

  std::array<const LightBvh::Node*, 2> children;
  std::array<double, 2> importances;
};

}  // namespace

double importance(const LightBounds& bounds, const LitPoint& point) {
  const Vec3 way = bounds.center - point.position;
  const double distance = glm::length(way);
  const double radius = bounds.radius * (1 + 1e-6);
  const double near = bounds.power / std::max({distance * distance, radius * radius, 1e-30});
  if (distance <= radius) return near;
  const double seen = std::asin(radius / distance);
  double leaving = angle_between(-way, bounds.axis);
  if (bounds.both_sides) leaving = std::min(leaving, M_PI - leaving);
  const double cosine = std::cos(std::max(0.0, leaving - bounds.spread - seen));
  if (!(cosine > std::cos(bounds.reach) - least_cosine)) return 0;
  double arriving = 1;
  if (point.normal) arriving = std::cos(std::max(0.0, angle_between(way, *point.normal) - seen));
  if (!(arriving > -least_cosine)) return 0;
  return near * std::max(cosine, least_cosine) * std::max(arriving, least_cosine);
}

std::optional<LightPick> pick_light(const LightChoice& choice, const LitPoint& point, double u) {
  const auto number = uint32_t(u * choice_numbers);
  if (const auto found = std::ranges::upper_bound(choice.ends, number); found != choice.ends.end()) {
    const auto light = size_t(found - choice.ends.begin());
    return LightPick{light, choice.share(light)};
  }
  const uint32_t count = choice.bvh_numbers();
  const uint32_t of_bvh = number - (choice_numbers - count);
  double rest = of_bvh / double(count), share = count / double(choice_numbers);
  uint32_t pair = 0;
  for (int level = 0;; ++level) {
    if (level > 0 && level % levels_a_number == 0)
      rest = (pcg(of_bvh ^ uint32_t(level) << 24) >> 8) * 0x1p-24;
    const Pair both(choice.bvh, pair, point);
    const double of_first = both.share(false);
    const bool second = !(rest < of_first);
    const double taken = both.share(second);
    if (taken == 0) return std::nullopt;
    rest = std::min((second ? rest - of_first : rest) / taken, 1 - 0x1p-24);
    share *= taken;
    const LightBvh::Node& child = *both.children[second];
    if (child.leaf) return LightPick{child.child, share};
    pair = child.child;
  }
}

double light_share(const LightChoice& choice, const LitPoint& point, size_t light) {
  if (choice.bvh.nodes.empty() || choice.bvh.trails[light] == LightBvh::no_trail) return choice.share(light);
  const uint32_t trail = choice.bvh.trails[light];
  double share = choice.bvh_numbers() / double(choice_numbers);
  uint32_t pair = 0;
  for (int level = 0;; ++level) {
    const Pair both(choice.bvh, pair, point);
    const bool second = trail >> level & 1;
    share *= both.share(second);
    const LightBvh::Node& child = *both.children[second];
    if (child.leaf) return share;
    pair = child.child;
  }
}

}  // namespace eyeray::engine::reference
