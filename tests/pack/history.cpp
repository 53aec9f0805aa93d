// BVHs of successive frames: refitted if items have moved a little, and built anew if a refitted BVH would
// slow rays much. Hits are the same.
#include "host/bvh/history.hpp"

#include <fmt/format.h>

#include <memory>
#include <vector>

#include "host/executors/executor.hpp"
#include "host/loader/scene_file.hpp"
#include "tests/support/random.hpp"
//
#include "tests/support/doctest.hpp"

using namespace eyeray::engine;
using namespace eyeray::engine::bvh;

namespace {

constexpr size_t many = 3000;

// Small boxes spread over a cube; each seed puts them at other positions.
std::vector<Box> boxes_of(uint64_t seed, float shift = 0) {
  test::Random random{seed};
  std::vector<Box> boxes;
  for (size_t i = 0; i < many; ++i) {
    const glm::vec3 p(random.uniform(0, 10), random.uniform(0, 10), random.uniform(0, 10));
    const glm::vec3 moved = p + glm::vec3(shift * float(i % 7), 0, 0);
    boxes.push_back({moved, moved + 0.1f});
  }
  return boxes;
}

bool same(const Box& a, const Box& b) {
  return a.lower == b.lower && a.upper == b.upper;
}

bool same(const Bvh& a, const Bvh& b) {
  bool all = a.nodes.size() == b.nodes.size() && std::ranges::equal(a.order, b.order) && same(a.box, b.box);
  for (size_t i = 0; all && i < a.nodes.size(); ++i)
    for (int c = 0; c < 2; ++c) all = all && same(a.nodes[i].children[c].box, b.nodes[i].children[c].box);
  return all;
}

// Checks that each node's box bounds everything below it, and is no larger.
void check_boxes(const Bvh& bvh, std::span<const Box> boxes) {
  size_t wrong = 0, items = 0;
  const auto around = [&](auto& self, const Child& child) -> Box {
    Box box;
    if (child.type == ChildType::lone_item) {
      ++items;
      return boxes[child.index];
    }
    if (child.type == ChildType::leaf) {
      for (uint32_t i = 0; i < child.count; ++i, ++items) box.include(boxes[bvh.order[child.index + i]]);
    } else {
      for (const Child& below : bvh.nodes[child.index].children) {
        const Box inner = self(self, below);
        wrong += !same(inner, below.box);
        box.include(inner);
      }
    }
    return box;
  };
  Box all;
  for (const Child& child : bvh.nodes[0].children) {
    const Box inner = around(around, child);
    wrong += !same(inner, child.box);
    all.include(inner);
  }
  CHECK(wrong == 0);
  CHECK(items == boxes.size());
  CHECK(same(all, bvh.box));
}

// A cloud of balls that drifts apart, and a mirror below.
std::string cloud(double drift) {
  test::Random random{5};
  std::string text = R"(
[image]
width = 64
height = 48
[camera]
eye = [0, 2, 9]
target = [0, 1, 0]
[[light]]
type = "point"
position = [3, 9, 5]
intensity = 90
[[material]]
name = "clay"
type = "phong"
[[material]]
name = "mirror"
type = "mirror"
[[plane]]
point = [0, -1.5, 0]
normal = [0, 1, 0]
material = "mirror"
)";
  for (int i = 0; i < 1500; ++i) {
    const double x = random.uniform(-3, 3), y = random.uniform(-1, 3), z = random.uniform(-3, 3);
    text += fmt::format("[[sphere]]\ncenter = [{}, {}, {}]\nradius = 0.08\nmaterial = \"clay\"\n",
                        x * (1 + drift), y, z + drift * y);
  }
  return text;
}

}  // namespace

TEST_CASE("a refitted BVH has its items' boxes; if no item moved, it is unchanged") {
  const std::vector<Box> at_first = boxes_of(1), later = boxes_of(1, 0.05f);
  BvhOptions options;
  for (const uint32_t first_lone : {uint32_t(many), uint32_t(many - 40)}) {
    options.first_lone = first_lone;
    const Bvh built = build_bvh(at_first, options);
    check_boxes(built, at_first);
    Bvh refitted = built;
    refit(refitted, at_first);
    CHECK(same(refitted, built));
    refit(refitted, later);
    check_boxes(refitted, later);
    CHECK_FALSE(same(refitted, built));
    CHECK(sah_cost(refitted) > sah_cost(built) / 2);
  }
}

TEST_CASE("a BVH is refitted after small movements, and rebuilt after large ones or if its items change") {
  BvhHistory history;
  const auto frame = [&](const std::vector<Box>& boxes, uint32_t first_lone = uint32_t(many)) {
    history.begin_scene();
    BvhOptions options;
    options.first_lone = first_lone;
    const Bvh bvh = history.build(boxes, options);
    check_boxes(bvh, boxes);
    return std::pair(bvh, same(bvh, build_bvh(boxes, options)));
  };
  const auto [first, built] = frame(boxes_of(1));
  CHECK(built);
  const auto [second, built_again] = frame(boxes_of(1, 0.05f));
  CHECK_FALSE(built_again);
  CHECK(std::ranges::equal(first.order, second.order));
  CHECK(frame(boxes_of(2)).second);                       // everything is elsewhere
  CHECK_FALSE(frame(boxes_of(2, 0.02f)).second);          // the BVH of boxes_of(2) is the kept one now
  CHECK(frame(boxes_of(2), uint32_t(many - 40)).second);  // other items are lone now
  std::vector<Box> fewer = boxes_of(2);
  fewer.resize(many - 1);
  CHECK(frame(fewer, uint32_t(many - 40)).second);
}

TEST_CASE("frames with and without a BVH history have the same hits, to the last bit") {
  executors::ExecutorOptions with;
  with.pack.history = std::make_shared<BvhHistory>();
  const Rect all{0, 0, 64, 48};
  for (const executors::Backend backend : {executors::Backend::twin, executors::Backend::gpu}) {
    for (const double drift : {0.0, 0.02, 0.05, 0.9, 0.91}) {
      CAPTURE(drift);
      const Scene scene = loader::parse_scene(cloud(drift), "scene.toml");
      std::vector<PixelSample> got(size_t(all.pixels())), expected(got);
      REQUIRE(executors::make_executor(backend, scene, with)->sample(all, 0, got));
      REQUIRE(executors::make_executor(backend, scene, {})->sample(all, 0, expected));
      size_t different = 0, hits = 0;
      for (size_t i = 0; i < got.size(); ++i) {
        different += got[i].color != expected[i].color || got[i].hits != expected[i].hits;
        hits += expected[i].hits > 0;
      }
      CHECK(different == 0);
      CHECK(hits > got.size() / 4);
    }
  }
}
