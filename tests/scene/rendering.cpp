// The driver that makes pictures from samples: whole samples, parts of pictures, supersampling, counts.
#include <chrono>
#include <thread>

#include "frames.hpp"
#include "host/loader/scene_file.hpp"
#include "tests/support/ball_over_floor.hpp"
#include "tests/support/empty_scene.hpp"
//
#include "tests/support/doctest.hpp"

using namespace eyeray::engine;
using namespace eyeray::engine::loader;
using namespace eyeray::engine::render;
using namespace eyeray::engine::executors;
using namespace eyeray::engine::compare;
using namespace eyeray::engine::image;
using namespace eyeray::engine::test;

namespace {

// Answers sample s of pixel (x, y) with the colour (x, y, s), and is interrupted at the call whose number is
// given.
class StoppingExecutor final : public Executor {
 public:
  explicit StoppingExecutor(int calls) : calls_left_(calls) {}

  bool sample(const Grid& grid, uint32_t index, std::span<PixelSample> out,
              std::span<AuxiliarySample>) override {
    const Rect& tile = grid.area;
    // Slow enough that the driver does not ask for more at a time.
    std::this_thread::sleep_for(std::chrono::milliseconds(110));
    if (calls_left_-- == 0) {
      // The samples in `out` must not be used.
      for (PixelSample& sample : out) sample = {Vec3(1e9), 1000, 1000, loop_budget};
      return false;
    }
    REQUIRE(out.size() == size_t(tile.pixels()));
    for (int y = 0; y < tile.height; ++y)
      for (int x = 0; x < tile.width; ++x)
        out[size_t(y * tile.width + x)] = {Vec3(tile.x + x, tile.y + y, index), 2, 1, 0};
    return true;
  }
  void first_hits(const Rect&, std::span<FirstHit>) override { traced_first_hits = true; }
  Probed probe(int, int, uint32_t) override { return {}; }
  double query(const QueryBatch&, std::span<QueryHit>) override {
    FAIL("a picture asks for samples");
    return 0;
  }

  bool traced_first_hits = false;

 private:
  int calls_left_;
};

// A picture so wide that the driver requests it in several pieces.
Scene cooperative_scene() {
  Scene scene = test::empty_scene();
  scene.image = {.width = 1 << 18, .height = 10, .samples = 4};
  return scene;
}

const std::string mirror_over_floor = ball_over_floor("width = 40\nheight = 30", "type = \"mirror\"");

Scene parse(const std::string& text, std::initializer_list<const char*> changes) {
  std::vector<Override> overrides;
  for (const char* change : changes) overrides.push_back({change});
  return parse_scene(text, "scene.toml", overrides);
}

Image render_color(const Scene& scene, Backend backend) {
  return render_frame(scene, backend).color;
}

}  // namespace

TEST_CASE("an interrupted picture has whole samples: each pixel is the mean of its finished samples") {
  const Scene scene = cooperative_scene();

  // Find out how many pieces a sample takes.
  int calls = 0;
  StoppingExecutor endless(-1);
  RenderOptions counting;
  counting.progress = [&](const Progress& progress) {
    ++calls;
    CHECK(progress.samples_total == 4u * 2621440u);
    CHECK(progress.rays == 2 * progress.samples_done);
  };
  const Rendering full = render::render(scene, endless, counting);
  CHECK_FALSE(full.interrupted);
  CHECK(full.samples_done == 4);
  CHECK(full.rays == 2u * 4u * 2621440u);
  REQUIRE(calls > 8);
  for (int y = 0; y < 10; ++y) CHECK(full.color.pixel(7, y)[2] == 1.5f);

  bool uneven = false;
  for (const int stop : {1, 4, 5}) {
    CAPTURE(stop);
    StoppingExecutor executor(stop);
    const Rendering part = render::render(scene, executor, {{}, true, {}});
    CHECK(part.interrupted);
    CHECK_FALSE(executor.traced_first_hits);
    CHECK(part.first_hits.empty());
    CHECK(part.samples_done < 4);
    CHECK(part.flags == 0);
    CHECK(part.flagged_pixels == 0);
    if (part.samples_done == 0) continue;

    // Each row has samples 0 … n, n = samples_done or one less, whose mean is n / 2, and rows above have no
    // fewer.
    float above = 3;
    int extra_rows = 0;
    for (int y = 0; y < 10; ++y) {
      const float* pixel = part.color.pixel(12345, y);
      CHECK(pixel[0] == 12345);
      CHECK(pixel[1] == float(y));
      CHECK((pixel[2] == 0.5f * float(part.samples_done) || pixel[2] == 0.5f * float(part.samples_done - 1)));
      CHECK(pixel[2] <= above);
      CHECK(*part.hits.pixel(12345, y) == 1);
      above = pixel[2];
      extra_rows += pixel[2] == 0.5f * float(part.samples_done);
    }
    uneven = uneven || (extra_rows > 0 && extra_rows < 10);
    CHECK(part.rays == 2u * (uint64_t(part.samples_done) * 2621440u + uint64_t(extra_rows) * 262144u));
  }
  CHECK(uneven);
}

TEST_CASE("a crop equals that part of the whole picture, bit by bit, with every executor") {
  const Scene scene = parse(mirror_over_floor, {"image.samples=4", "image.pattern=jittered"});
  for (const Backend backend : backends) {
    CAPTURE(backend_names[int(backend)]);
    const auto executor = make_executor(backend, scene, {});
    const Frame all = render_frame(scene, *executor, whole(scene));
    for (const Rect& area :
         {Rect{0, 0, 40, 30}, Rect{11, 7, 17, 13}, Rect{39, 29, 1, 1}, Rect{0, 29, 40, 1}}) {
      const Frame part = render_frame(scene, *executor, area);
      int different = 0;
      for (int y = 0; y < area.height; ++y) {
        for (int x = 0; x < area.width; ++x) {
          const FirstHit& hit = part.first_hit(x, y);
          const FirstHit& other = all.first_hit(area.x + x, area.y + y);
          different += color_at(part.color, x, y) != color_at(all.color, area.x + x, area.y + y) ||
                       *part.hits.pixel(x, y) != *all.hits.pixel(area.x + x, area.y + y) ||
                       hit.t != other.t || hit.primitive != other.primitive || hit.normal != other.normal;
        }
      }
      CHECK(different == 0);
    }
  }
}

TEST_CASE("2 × 2 samples are the mean of four pixels of the picture twice the size") {
  for (const Backend backend : backends) {
    CAPTURE(backend_names[int(backend)]);
    const Image coarse = render_color(parse(mirror_over_floor, {"image.samples=4"}), backend);
    const Image fine = render_color(parse(mirror_over_floor, {"image.width=80", "image.height=60"}), backend);
    // The shaders' samples are float32, and their mean is exact; the reference's are rounded in the larger
    // picture.
    const double tolerance = backend == Backend::reference ? 1e-7 : 0;
    double worst = 0;
    for (int y = 0; y < 30; ++y) {
      for (int x = 0; x < 40; ++x) {
        Vec3 mean(0);
        for (const auto& [i, j] : {std::pair{0, 0}, {1, 0}, {0, 1}, {1, 1}})
          mean += color_at(fine, 2 * x + i, 2 * y + j);
        const Vec3 error = glm::abs(color_at(coarse, x, y) - Vec3(glm::vec3(mean / 4.0)));
        worst = std::max({worst, error.x, error.y, error.z});
      }
    }
    CHECK(worst <= tolerance);
  }
}

TEST_CASE("jittered samples depend on the seed, and on nothing else") {
  for (const Backend backend : backends) {
    CAPTURE(backend_names[int(backend)]);
    const Scene first = parse(mirror_over_floor, {"image.samples=4", "image.pattern=jittered"});
    const Scene other =
        parse(mirror_over_floor, {"image.samples=4", "image.pattern=jittered", "render.seed=1"});
    const Image image = render_color(first, backend);
    CHECK(image.samples() == render_color(first, backend).samples());
    CHECK(image.samples() != render_color(other, backend).samples());
  }
}

TEST_CASE("rays are counted: camera, shadow and mirrored ones") {
  // Scenes in which all pixels show the floor.
  const auto floor = [](std::initializer_list<const char*> changes) {
    Scene scene = parse(mirror_over_floor, changes);
    scene.shapes.erase(scene.shapes.begin());
    scene.camera.target = {0, 0, 5};
    return scene;
  };
  struct Case {
    Scene scene = test::empty_scene();
    uint64_t rays_per_pixel;
  };
  Case cases[] = {{floor({}), 2},                                  // eye and shadow
                  {floor({"render.integrator=raycast"}), 1},       // no shadows
                  {floor({"image.samples=9"}), 18},                // nine rays of each kind
                  {floor({"light.0.position=[0, -1, 0]"}), 1},     // the light stands behind the floor
                  {floor({"material.floor.reflectance=0.5"}), 3},  // the mirrored ray goes to the sky
                  {floor({"material.floor.reflectance=0.5", "render.max_depth=0"}), 2},
                  {floor({"material.floor.reflectance=0.5", "render.min_throughput=0.5"}), 2}};
  for (const Case& c : cases) {
    for (const Backend backend : backends) {
      CAPTURE(backend_names[int(backend)]);
      const Frame frame = render_frame(c.scene, backend);
      CHECK(frame.rays == c.rays_per_pixel * 40 * 30);
      CHECK(*frame.hits.pixel(20, 15) == 1);
    }
  }
}
