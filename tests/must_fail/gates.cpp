// A check that cannot fail is a defect. So every gate gets a frame with one fault, and must fail for the
// right reason.
#include <sys/wait.h>
#include <unistd.h>

#include <bit>
#include <cmath>
#include <csignal>
#include <functional>
#include <limits>

#include "honest_frame.hpp"
#include "host/compare/report.hpp"
//
#include "tests/support/doctest.hpp"

using namespace eyeray::engine;
using namespace eyeray::engine::compare;
using namespace eyeray::engine::image;
using namespace eyeray::engine::test;

namespace {

constexpr float nan_value = std::numeric_limits<float>::quiet_NaN();
constexpr float infinity = std::numeric_limits<float>::infinity();

// The whole report of verify on a frame that stands for the GPU's, with an honest twin.
Report verify(const Frame& gpu) {
  const Frame twin = honest_frame(), reference = picture_frame();
  Report report;
  report.scene = "analytic.toml";
  report.width = picture_width;
  report.height = picture_height;
  report.area = reference.area;
  report.participants = {{"gpu", "gpu: a fake", 0, gpu.rays, inspect(gpu)},
                         {"twin", "twin: a fake", 0, twin.rays, inspect(twin)},
                         {"reference", "reference: a formula", 0, reference.rays, inspect(reference)}};
  report.exact = {{"gpu", "twin", 0, compare_exactly(gpu, twin)}};
  for (const auto& [name, frame] : {std::pair{"gpu", &gpu}, {"twin", &twin}}) {
    ReferenceResult result;
    result.value = name;
    result.comparison = compared(*frame, reference);
    report.against_reference.push_back(result);
  }
  return report;
}

bool mentions(const Report& report, const std::string& words) {
  for (const std::string& failure : report.failures()) {
    if (failure.find(words) != std::string::npos) return true;
  }
  return false;
}

// True if `action` ends the program by abort(), as CHECK does.
bool aborts(const std::function<void()>& action) {
  const pid_t child = fork();
  if (child == 0) {
    std::signal(SIGABRT, SIG_DFL);
    if (!freopen("/dev/null", "w", stderr)) _exit(2);
    action();
    _exit(0);
  }
  int status = 0;
  waitpid(child, &status, 0);
  return WIFSIGNALED(status) && WTERMSIG(status) == SIGABRT;
}

}  // namespace

TEST_CASE("without a fault every gate passes, and each honest difference has its cause") {
  const Report report = verify(honest_frame());
  CHECK(report.failures() == std::vector<std::string>{});
  CHECK(report.command_to_look().empty());
  const ReferenceComparison& comparison = report.against_reference[0].comparison;
  for (const Cause cause :
       {Cause::silhouette, Cause::texture_edge, Cause::refraction_branch, Cause::shadow_edge}) {
    CHECK(comparison.colors.explained[size_t(cause)] == edge_pixels);
  }
  CHECK(comparison.first_hits.explained[size_t(Cause::silhouette)] == edge_pixels);
  CHECK(comparison.first_hits.explained_pixels() == edge_pixels);
  CHECK(comparison.colors.equal + comparison.colors.matching + 4 * edge_pixels ==
        picture_width * picture_height);
}

TEST_CASE("gate A detects one bit, wherever it is") {
  const auto flip = [](float& value) { value = std::bit_cast<float>(std::bit_cast<uint32_t>(value) ^ 1u); };
  const auto flip_double = [&](double& value) {
    float narrow = float(value);
    flip(narrow);
    value = double(narrow);
  };
  const std::vector<std::function<void(Frame&)>> changes = {
      [&](Frame& f) { flip(f.color.pixel(50, 30)[2]); },
      [&](Frame& f) { flip_double(hit_at(f, on_ball).t); },
      [&](Frame& f) { flip_double(hit_at(f, on_ball).position.y); },
      [&](Frame& f) { flip_double(hit_at(f, on_ball).normal.z); },
      [&](Frame& f) { flip_double(hit_at(f, on_ball).normal_geometric.z); },
      [&](Frame& f) { flip_double(hit_at(f, on_ball).cosine); },
      [&](Frame& f) { flip_double(hit_at(f, on_ball).uv.x); },
      [&](Frame& f) { hit_at(f, on_ball).material = 0; },
      [&](Frame& f) { hit_at(f, on_ball).primitive = 0; },
      [&](Frame& f) { flip(*f.hits.pixel(50, 30)); },
      [&](Frame& f) { flip(*f.rays_traced.pixel(50, 30)); },
  };
  const Frame twin = honest_frame();
  CHECK(compare_exactly(twin, twin).passes(0));
  for (size_t i = 0; i < changes.size(); ++i) {
    CAPTURE(i);
    Frame gpu = twin;
    changes[i](gpu);
    const ExactComparison comparison = compare_exactly(gpu, twin);
    CHECK_FALSE(comparison.passes(0));
    CHECK(comparison.different_pixels == 1);
    CHECK(comparison.worst.pixel == on_ball);
    CHECK(comparison.worst.seam != Seam::none);
  }

  // The sign of a zero is a bit as well, and a ray too many is a difference.
  Frame zero = twin, minus_zero = twin;
  *zero.color.pixel(0, 0) = 0.0f;
  *minus_zero.color.pixel(0, 0) = -0.0f;
  CHECK_FALSE(compare_exactly(zero, minus_zero).passes(0));
  Frame more_rays = twin;
  ++more_rays.rays;
  CHECK_FALSE(compare_exactly(more_rays, twin).passes(0));
}

TEST_CASE("a ULP bound forgives small distances, never an id, a NaN or a ray") {
  const Frame twin = honest_frame();
  Frame gpu = twin;
  float& value = gpu.color.pixel(50, 30)[0];
  value = std::nextafter(std::nextafter(value, infinity), infinity);
  CHECK(compare_exactly(gpu, twin).max_ulp == 2);
  CHECK_FALSE(compare_exactly(gpu, twin).passes(1));
  CHECK(compare_exactly(gpu, twin).passes(2));
  value = nan_value;
  CHECK_FALSE(compare_exactly(gpu, twin).passes(64));
  gpu = twin;
  hit_at(gpu, on_ball).primitive = 2;
  CHECK_FALSE(compare_exactly(gpu, twin).passes(64));
  gpu = twin;
  gpu.rays += 1;
  CHECK_FALSE(compare_exactly(gpu, twin).passes(64));
}

TEST_CASE("a single NaN, infinity or negative colour fails, everywhere") {
  struct Fault {
    float value;
    const char* word;
  };
  for (const Fault fault : {Fault{nan_value, "1 NaN"}, {infinity, "1 infinite"}, {-1e-6f, "1 negative"}}) {
    CAPTURE(fault.word);
    Frame gpu = honest_frame();
    gpu.color.pixel(on_ball.x, on_ball.y)[1] = fault.value;
    const Report report = verify(gpu);
    CHECK(mentions(report, std::string("gpu: ") + fault.word));
    CHECK(mentions(report, "first at 50,30"));
    CHECK(report.pixel_to_look_at() == on_ball);
    CHECK_FALSE(inspect(gpu.color).ok());
  }

  // A NaN is no match, not even for a NaN of the reference, and nothing explains it.
  Frame gpu = honest_frame();
  gpu.color.pixel(on_ball.x, on_ball.y)[1] = nan_value;
  CHECK(compared(gpu).colors.unexplained == 1);
  CHECK(compared(gpu, gpu).colors.unexplained == 1);
  CHECK(count_different(gpu.color, gpu.color, 1.0) == 1);
  gpu = honest_frame();
  hit_at(gpu, on_ball).normal.x = std::nan("");
  CHECK(compared(gpu).first_hits.unexplained == 1);
  CHECK(mentions(verify(gpu), "gpu: 1 NaN"));
  gpu = honest_frame();
  hit_at(gpu, on_ball).t = std::nan("");
  CHECK(compared(gpu).first_hits.unexplained == 1);
  gpu = honest_frame();
  hit_at(gpu, on_ball).t = double(infinity);
  CHECK(mentions(verify(gpu), "gpu: 1 infinite"));
}

TEST_CASE("samples that the executor flags as incomplete fail") {
  Frame gpu = honest_frame();
  gpu.flags = stack_overflow;
  gpu.flagged_pixels = 3;
  CHECK(mentions(verify(gpu), "3 incomplete pixels: more rays pending"));
}

TEST_CASE("a black picture fails") {
  Frame gpu = honest_frame();
  for_each_pixel(gpu, [](float* color, FirstHit&) { color[0] = color[1] = color[2] = 0; });
  const Report report = verify(gpu);
  CHECK(mentions(report, "gate A: gpu and twin: 6912 of 6912 pixels"));
  CHECK(
      mentions(report, "gate B: gpu against the reference, colours: 6912 of 6912 pixels differ unexplained"));
  CHECK_FALSE(mentions(report, "gate C"));
}

TEST_CASE("a shift by one pixel fails, in any direction") {
  for (const Vec2 shift : {Vec2(1, 0), Vec2(-1, 0), Vec2(0, 1), Vec2(0, -1), Vec2(0.02, 0), Vec2(0, -0.02)}) {
    const ReferenceComparison comparison = compared(picture_frame(shift));
    CHECK_FALSE(comparison.colors.passes());
    CHECK_FALSE(comparison.first_hits.passes());
  }
}

TEST_CASE("swapped ids fail at the seam 'primitive'") {
  Frame gpu = honest_frame();
  for_each_pixel(gpu, [](float*, FirstHit& hit) {
    if (hit.primitive >= 0 && hit.primitive < 2) hit.primitive = 1 - hit.primitive;
  });
  CHECK(mentions(verify(gpu), "diverges at primitive"));
  CHECK_FALSE(compared(gpu).first_hits.passes());

  // One pixel is enough to fail, and the id of a pixel that is 3 pixels away explains nothing.
  gpu = honest_frame();
  hit_at(gpu, {48, 34 - 22}).primitive = 0;
  CHECK(compared(gpu).first_hits.unexplained == 1);
}

TEST_CASE("another material fails") {
  Frame gpu = honest_frame();
  hit_at(gpu, on_ball).material = 0;
  const ReferenceComparison comparison = compared(gpu);
  CHECK(comparison.first_hits.unexplained == 1);
  CHECK(comparison.first_hits.worst.seam == Seam::material);
}

TEST_CASE("the wrong root fails at the seam 't'") {
  Frame gpu = honest_frame();
  for_each_pixel(gpu, [](float*, FirstHit& hit) {
    if (hit.primitive == 1) hit.t = 1800 - hit.t;
  });
  const ReferenceComparison comparison = compared(gpu);
  CHECK_FALSE(comparison.first_hits.passes());
  CHECK(comparison.first_hits.worst.seam == Seam::t);
  CHECK(mentions(verify(gpu), "gate C: gpu against the reference, first hits: "));
  CHECK(mentions(verify(gpu), "diverges at t"));
}

TEST_CASE("flipped normals fail at the seam 'normal'") {
  Frame gpu = honest_frame();
  for_each_pixel(gpu, [](float*, FirstHit& hit) { hit.normal = -hit.normal; });
  const ReferenceComparison comparison = compared(gpu);
  CHECK_FALSE(comparison.first_hits.passes());
  CHECK(comparison.first_hits.worst.seam == Seam::normal);
}

TEST_CASE("wrong geometric normals, and a back reported as a front, fail at their seam") {
  for (const bool turned : {false, true}) {
    Frame gpu = honest_frame();
    for_each_pixel(gpu, [&](float*, FirstHit& hit) {
      if (turned)
        hit.cosine = -hit.cosine;
      else
        hit.normal_geometric = glm::normalize(hit.normal_geometric + Vec3(0.01, 0, 0));
    });
    const ReferenceComparison comparison = compared(gpu);
    CHECK_FALSE(comparison.first_hits.passes());
    CHECK(comparison.first_hits.worst.seam == Seam::geometric_normal);
  }
}

TEST_CASE("a missing light fails at the seam 'color'") {
  Frame gpu = honest_frame();
  for_each_pixel(gpu, [](float* color, FirstHit& hit) {
    if (hit.primitive == 1) color[0] = color[1] = color[2] = 0.1f;
  });
  const ReferenceComparison comparison = compared(gpu);
  CHECK_FALSE(comparison.colors.passes());
  CHECK(comparison.first_hits.passes());
  CHECK(comparison.colors.worst.seam == Seam::color);
}

TEST_CASE("a wrong colour fails at the seam 'color' where an explained first hit differs too") {
  Frame gpu = honest_frame();
  const FirstHit honest = picture_frame().first_hits[6 * picture_width + 88];
  REQUIRE(gpu.first_hits[6 * picture_width + 88].primitive != honest.primitive);
  gpu.color.pixel(88, 6)[1] = 9;
  const ReferenceComparison comparison = compared(gpu);
  CHECK_FALSE(comparison.colors.passes());
  CHECK(comparison.first_hits.passes());
  CHECK(comparison.colors.worst.pixel.x == 88);
  CHECK(comparison.colors.worst.seam == Seam::color);
}

TEST_CASE("a difference above the tolerance fails, and one below passes") {
  for (const auto& [factor, passes] : {std::pair{0.5, true}, {5.0, false}}) {
    Frame gpu = picture_frame();
    gpu.color.pixel(on_ball.x, on_ball.y)[0] += float(factor * 1e-4);
    CHECK(compared(gpu).colors.passes() == passes);
    gpu = picture_frame();
    hit_at(gpu, on_ball).t *= 1 + factor * 1e-5;
    CHECK(compared(gpu).first_hits.passes() == passes);
    gpu = picture_frame();
    hit_at(gpu, on_ball).normal.y += factor * 1e-4;
    CHECK(compared(gpu).first_hits.passes() == passes);
    gpu = picture_frame();
    hit_at(gpu, on_ball).normal_geometric.y += factor * 1e-4;
    CHECK(compared(gpu).first_hits.passes() == passes);
    gpu = picture_frame();
    hit_at(gpu, on_ball).uv.y += factor * 1e-4;
    CHECK(compared(gpu).first_hits.passes() == passes);
    gpu = picture_frame();
    hit_at(gpu, on_ball).position.x += factor * 1e-5 * hit_at(gpu, on_ball).t;
    CHECK(compared(gpu).first_hits.passes() == passes);
  }
}

TEST_CASE("gate C detects one surface or one ray too many") {
  for (const auto image : {&Frame::hits, &Frame::rays_traced}) {
    Frame gpu = picture_frame();
    *(gpu.*image).pixel(on_ball.x, on_ball.y) += 1;
    const Tally counts = compared(gpu).counts;
    CHECK(counts.unexplained == 1);
    CHECK(counts.worst.pixel == on_ball);
    CHECK(counts.worst.seam == Seam::counts);
    CHECK(compared(gpu).colors.passes());
  }
  // At the mirror's edge the counts may be those of either side, but at its corner they may not be any
  // others.
  CHECK(compared(honest_frame()).counts.passes());
  CHECK(compared(honest_frame()).counts.explained[size_t(Cause::silhouette)] == edge_pixels);
}

TEST_CASE("a picture of another size, position or shape fails, and so does an empty one") {
  const Frame reference = picture_frame();
  std::vector<Frame> wrong(7, honest_frame());
  wrong[0].color = Image(picture_width - 1, picture_height, 3);
  wrong[1].area.width = picture_width - 1;
  wrong[2].area.x = 1;
  wrong[3].first_hits.pop_back();
  wrong[4].hits = Image(picture_width, picture_height, 3);
  wrong[6].rays_traced = Image(picture_width, picture_height + 1, 1);
  wrong[5].color = Image(picture_width, picture_height, 1);
  for (const Frame& frame : wrong) {
    CHECK_FALSE(compare_exactly(frame, reference).passes(64));
    CHECK_FALSE(compared(frame).passes());
    CHECK(mentions(verify(frame), "the sizes differ"));
  }
  CHECK_FALSE(compare_exactly(Frame{}, Frame{}).passes(64));
  CHECK_FALSE(compared(Frame{}, Frame{}).passes());
  CHECK_FALSE(Tally{}.passes());
  CHECK_FALSE(ExactComparison{}.passes(64));
  CHECK_FALSE(Report{}.passes());
}

TEST_CASE("a tolerance that is too large, negative or not a number ends the program") {
  CHECK_FALSE(aborts([] { Tolerances{}.check(); }));
  CHECK(aborts([] { Tolerances{.color = std::nan("")}.check(); }));
  CHECK(aborts([] { Tolerances{.color = 0.1}.check(); }));
  CHECK(aborts([] { Tolerances{.t = 0.1}.check(); }));
  CHECK(aborts([] { Tolerances{.normal = 0.1}.check(); }));
  CHECK(aborts([] { Tolerances{.max_explained = 0.5}.check(); }));
  CHECK(aborts([] { Tolerances{.color = -1}.check(); }));
  CHECK(aborts([] { ExactComparison{}.passes(1000); }));
  CHECK(aborts([] { count_different(Image(1, 1, 1), Image(1, 1, 1), std::nan("")); }));
}
