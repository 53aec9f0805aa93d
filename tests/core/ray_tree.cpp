// The tree that is made of rays and values in order of time.
#include "host/core/ray_tree.hpp"

#include <cmath>

#include "tests/support/doctest.hpp"

using namespace eyeray::engine;

TEST_CASE("rays and values are attached to their parents, whatever order the loop traces in") {
  RayRecorder recorder;
  recorder.value("point", 3, Vec2(1.5, 2.5));
  recorder.ray(RayKind::eye, 0, 0);
  recorder.value("t", 7, 2.0f);
  recorder.ray(RayKind::shadow, 1, 0);
  recorder.value("visibility", 8, 1.0f);
  recorder.back(0);
  recorder.value("light", 9, Vec3(1, 2, 3));
  // The refracted ray is traced first, then the reflected ray that waited.
  recorder.ray(RayKind::refracted, 0, 1);
  recorder.ray(RayKind::reflected, 0, 2);
  recorder.value("deep", 1, true);
  recorder.ray(RayKind::reflected, 0, 1);
  recorder.value("late", 2, -4);
  recorder.value("zero", 2, -0.0f);
  recorder.back(0xffffffffu);
  recorder.value("end", 2, 5u);

  const std::vector<ProbedRay>& rays = recorder.tree().rays;
  REQUIRE(rays.size() == 6);
  CHECK(recorder.tree().lost == 0);
  const auto check = [&](size_t i, RayKind kind, size_t parent, size_t index,
                         std::vector<std::string> names) {
    CAPTURE(i);
    CHECK(rays[i].kind == kind);
    CHECK(rays[i].parent == parent);
    CHECK(rays[i].index == index);
    REQUIRE(rays[i].values.size() == names.size());
    for (size_t k = 0; k < names.size(); ++k) CHECK(rays[i].values[k].name == names[k]);
  };
  check(0, RayKind::pixel, 0, 0, {"point", "end"});
  check(1, RayKind::eye, 0, 1, {"t", "light"});
  check(2, RayKind::shadow, 1, 1, {"visibility"});
  check(3, RayKind::refracted, 1, 2, {});
  check(4, RayKind::reflected, 3, 0, {"deep"});
  check(5, RayKind::reflected, 1, 2, {"late", "zero"});
  CHECK_FALSE(std::signbit(rays[5].values[1].numbers[0]));
  CHECK(rays[2].number == 1);
  CHECK(rays[1].values[1].size == 3);
  CHECK(rays[1].values[1].numbers[2] == 3);
  CHECK(rays[1].values[0].line == 7);
  CHECK(rays[4].values[0].type == ProbedValue::Type::boolean);
  CHECK(rays[5].values[0].type == ProbedValue::Type::integer);
  CHECK(rays[5].values[0].numbers[0] == -4);
}

TEST_CASE("records that do not fit are counted") {
  RayRecorder recorder;
  for (uint32_t i = 0; i < RayRecorder::most + 10; ++i) recorder.value("x", 1, 1.0f);
  recorder.ray(RayKind::eye, 0, 0);
  CHECK(recorder.tree().rays[0].values.size() == RayRecorder::most);
  CHECK(recorder.tree().rays.size() == 1);
  CHECK(recorder.tree().lost == 11);
}
