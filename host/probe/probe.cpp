#include "host/probe/probe.hpp"

#include <fmt/ranges.h>

#include <algorithm>
#include <bit>

#include "host/compare/explain.hpp"
#include "host/core/error.hpp"
#include "host/core/termination.hpp"
#include "host/executors/executors.hpp"
#include "host/executors/shader_files.hpp"
#include "host/probe/judge.hpp"
#include "host/rounding/positions.hpp"
#include "host/rounding/ways.hpp"
#include "host/scene/objects.hpp"

namespace eyeray::engine::probe {
namespace {

using executors::Backend;
using executors::Executor;

// The number of positions on each ring around the pixel.
constexpr int angles = 16;

// The rays and values of one pixel, by each executor.
class Pixel {
 public:
  Pixel(const Scene& scene, const Options& options)
      : scene_(scene), options_(options), renderer_(reference_of(scene, options)) {
    executors::ExecutorOptions how = options.executor;
    how.ray_kinds = true;
    for (const Backend backend : options.backends)
      executors_.push_back(backend == Backend::reference ? executors::make_reference_executor(renderer_)
                                                         : executors::make_executor(backend, scene, how));
  }

  Findings look() {
    Findings findings;
    findings.scene = scene_.file.string();
    findings.width = scene_.image.width;
    findings.height = scene_.image.height;
    findings.x = options_.x;
    findings.y = options_.y;
    findings.samples = scene_.image.samples;
    findings.sample = index_ = options_.sample ? *options_.sample : first_that_differs();
    findings.eye = scene_.camera.eye;
    findings.overlay = Overlay(executors_.size());

    bool incomplete = false;
    for (size_t i = 0; i < executors_.size(); ++i) {
      executors::Probed probed = executors_[i]->probe(options_.x, options_.y, index_);
      const Backend backend = options_.backends[i];
      const std::string name(backend_name(backend));
      findings.participants.push_back({backend, executors_[i]->facts().description, probed.sample});
      if (const Vec3 color = sample(i, index_).color; !same_bits(color, probed.sample.color))
        findings.notes.push_back(
            fmt::format("the kernel that renders computes {:.9g} {:.9g} {:.9g} for this pixel with {}, which "
                        "differs from the value here: find out why",
                        color.x, color.y, color.z, name));
      if (probed.rays.lost > 0) {
        incomplete = true;
        findings.notes.push_back(fmt::format("{}: the tree is truncated: {} more rays and values had no room",
                                             name, probed.rays.lost));
      }
      FirstHit hit;
      executors_[i]->first_hits({options_.x, options_.y, 1, 1}, std::span(&hit, 1));
      findings.overlay.add(i, finished(std::move(probed.rays), probed.sample, hit, backend));
    }
    note_changed_shaders(findings);
    judge(findings.overlay, options_.backends, incomplete, [&] { add_around(findings.overlay); });
    name_hits(findings);
    return findings;
  }

 private:
  static std::shared_ptr<const reference::Renderer> reference_of(const Scene& scene, const Options& options) {
    if (std::ranges::find(options.backends, Backend::reference) == options.backends.end()) return nullptr;
    return std::make_shared<const reference::Renderer>(scene, options.executor.pack.acceleration);
  }

  static bool same_bits(const Vec3& a, const Vec3& b) {
    return std::bit_cast<std::array<uint64_t, 3>>(a) == std::bit_cast<std::array<uint64_t, 3>>(b);
  }

  PixelSample sample(size_t executor, uint32_t index) {
    PixelSample sample;
    if (!executors_[executor]->sample(Rect{options_.x, options_.y, 1, 1}, index, std::span(&sample, 1)))
      stop_if_interrupted();
    return sample;
  }

  // The first sample whose colours differ by the rules of verify; 0 if none does.
  uint32_t first_that_differs() {
    for (uint32_t index = 0; scene_.image.samples > 1 && index < uint32_t(scene_.image.samples); ++index) {
      std::optional<Vec3> exact, reference;
      bool differs = false;
      for (size_t i = 0; i < executors_.size(); ++i) {
        const Vec3 color = sample(i, index).color;
        std::optional<Vec3>& other = options_.backends[i] == Backend::reference ? reference : exact;
        differs = differs || (other && !same_bits(*other, color));
        other = color;
      }
      if (exact && reference)
        differs = differs || !(compare::color_excess(*exact, *reference, compare::Tolerances{}.color) <= 1);
      if (differs) return index;
    }
    return 0;
  }

  // The tree with points relative to the eye, and the sample's sums and the first hit as the pixel's own
  // values.
  RayTree finished(RayTree tree, const PixelSample& sample, const FirstHit& hit, Backend backend) const {
    for (ProbedRay& ray : tree.rays)
      for (ProbedValue& value : ray.values)
        if (backend == Backend::reference && meaning_of(value.name) == Meaning::point)
          for (int c = 0; c < 3; ++c) value.numbers[size_t(c)] -= scene_.camera.eye[c];
    const auto add = [&](std::string name, ProbedValue::Type type, std::initializer_list<double> numbers) {
      ProbedValue value{.name = std::move(name), .type = type, .size = int(numbers.size())};
      std::ranges::copy(numbers, value.numbers.begin());
      tree.rays[0].values.push_back(std::move(value));
    };
    using enum ProbedValue::Type;
    add("rays", integer, {double(sample.rays)});
    add("hits", integer, {double(sample.hits)});
    add("flags", integer, {double(sample.flags)});
    add("color", real, {sample.color.x, sample.color.y, sample.color.z});
    const Vec3 position = hit.position - scene_.camera.eye;
    add("first_hit_primitive", integer, {double(hit.primitive)});
    add("first_hit_t", real, {hit.t});
    add("first_hit_position", real, {position.x, position.y, position.z});
    add("first_hit_normal", real, {hit.normal.x, hit.normal.y, hit.normal.z});
    add("first_hit_uv", real, {hit.uv.x, hit.uv.y});
    add("first_hit_material", integer, {double(hit.material)});
    if (backend == Backend::reference) add("t_scale", real, {hit.t_scale});
    return tree;
  }

  // Adds the reference's values around the pixel, with which verify explains differences
  // (verify/neighbours.cpp).
  void add_around(Overlay& overlay) const {
    if (!renderer_) return;
    uint32_t hits = 0;
    const auto add = [&](const Vec2& shift, const rounding::Displacement& way) {
      RayRecorder recorder;
      const PixelSample sample = renderer_->sample(options_.x, options_.y, index_, shift, way, &recorder);
      hits = std::max(hits, sample.hits);
      const FirstHit hit = renderer_->first_hit(options_.x, options_.y, shift, way);
      overlay.add_around(finished(std::move(recorder.tree()), sample, hit, Backend::reference));
    };
    const auto add_position = [&](const Vec2& shift, uint32_t seed) {
      const bool moved = shift != Vec2(0.0);
      for (const rounding::Displacement& way : rounding::ways_of_probe(moved, seed)) add(shift, way);
    };
    add_position({0, 0}, 0);
    const double t = renderer_->first_hit(options_.x, options_.y).t;
    const double rounding = renderer_->rounding(options_.x, options_.y, t);
    uint32_t seed = 0;
    const rounding::Positions positions = rounding::positions_around(rounding, hits, angles, true);
    for (const Vec2& position : positions.all) add_position(position, ++seed);
    for (size_t i = 0; i < positions.innermost; ++i)
      add(positions.all[i], {.pivot = renderer_->pivot(options_.x, options_.y, uint32_t(i))});
  }

  void note_changed_shaders(Findings& findings) const {
    const std::vector<std::string> changed = executors::changed_shaders(options_.executor.shader_folder);
    if (!changed.empty() && !options_.executor.twin.compile)
      findings.notes.push_back(
          fmt::format("the gpu has {}; the twin has the built-in shaders", fmt::join(changed, ", ")));
  }

  void name_hits(Findings& findings) const {
    const Objects objects(scene_);
    for (const Ray& ray : findings.overlay.rays()) {
      std::string hit;
      if (const Line* const line = find_line(ray, "primitive")) {
        const auto value = std::ranges::find_if(line->values, [](const auto& v) { return v.has_value(); });
        const auto primitive = int64_t((*value)->numbers[0]);
        hit = primitive < 0                                    ? "nothing"
              : uint64_t(primitive) < scene_.primitive_count() ? objects.describe(uint64_t(primitive))
                                                               : "no primitive of the scene";
      }
      findings.hits.push_back(hit);
    }
  }

  const Scene& scene_;
  const Options& options_;
  std::shared_ptr<const reference::Renderer> renderer_;  // null where the reference takes no part
  std::vector<std::unique_ptr<Executor>> executors_;
  uint32_t index_ = 0;
};

}  // namespace

std::string describe(const Ray& ray) {
  switch (ray.kind) {
    case RayKind::pixel:
      return "pixel";
    case RayKind::eye:
      return "camera ray";
    case RayKind::reflected:
      return "reflected ray";
    case RayKind::refracted:
      return "refracted ray";
    case RayKind::shadow:
      return fmt::format("shadow ray to light {}", ray.number);
  }
  return "ray";
}

std::optional<Findings::Location> Findings::first_difference() const {
  std::optional<Location> first;
  const auto look = [&](Verdict verdict, size_t ray, std::optional<size_t> line) {
    if (!first && verdict == Verdict::differs) first = Location{ray, line};
  };
  overlay.in_order([&](size_t i) { look(overlay.rays()[i].verdict, i, std::nullopt); },
                   [&](size_t i, size_t k) { look(overlay.rays()[i].lines[k].verdict, i, k); });
  return first;
}

std::string Findings::way_to(size_t ray) const {
  const Ray& last = overlay.rays()[ray];
  return last.kind == RayKind::pixel || last.parent == 0
             ? describe(last)
             : fmt::format("{} / {}", way_to(last.parent), describe(last));
}

Findings probe_pixel(const Scene& scene, const Options& options) {
  const ImageSettings& image = scene.image;
  if (options.x < 0 || options.y < 0 || options.x >= image.width || options.y >= image.height)
    throw Error(ExitCode::bad_input, "there is no pixel {},{}: the picture is {}×{}, its first pixel 0,0",
                options.x, options.y, image.width, image.height);
  if (options.sample && *options.sample >= uint32_t(image.samples))
    throw Error(ExitCode::bad_input, "--sample {}: a pixel has {} sample{}, the first is 0", *options.sample,
                image.samples, image.samples == 1 ? "" : "s");
  return Pixel(scene, options).look();
}

}  // namespace eyeray::engine::probe
