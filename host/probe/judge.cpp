#include "host/probe/judge.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <bit>
#include <cmath>

#include "host/compare/exact.hpp"
#include "host/compare/tolerance.hpp"

namespace eyeray::engine::probe {
namespace {

using executors::Backend;
using executors::backend_name;

constexpr compare::Tolerances tolerances;

bool same_bits(const ProbedValue& a, const ProbedValue& b) {
  return a.size == b.size && a.type == b.type &&
         std::bit_cast<std::array<uint64_t, 4>>(a.numbers) ==
             std::bit_cast<std::array<uint64_t, 4>>(b.numbers);
}

// The largest distance in ulps between values of a float32 executor and of the reference, or of two float32
// executors.
int64_t ulp_distance(const ProbedValue& a, const ProbedValue& b) {
  int64_t most = 0;
  for (size_t c = 0; c < size_t(a.size); ++c)
    most = std::max(most, compare::ulp_distance(float(a.numbers[c]), float(b.numbers[c])));
  return most;
}

std::string describe(const ProbedValue& a, const ProbedValue& b) {
  if (a.type == ProbedValue::Type::boolean) return "not the same";
  if (a.type == ProbedValue::Type::integer) return fmt::format("{} and {}", a.numbers[0], b.numbers[0]);
  const int64_t ulp = ulp_distance(a, b);
  return ulp == std::numeric_limits<int64_t>::max() ? "NaN" : fmt::format("{} ULP", ulp);
}

class Judge {
 public:
  Judge(Overlay& overlay, std::span<const Backend> executors, bool incomplete)
      : overlay_(overlay), executors_(executors), incomplete_(incomplete) {
    for (size_t i = 0; i < executors.size(); ++i) (is_exact(i) ? exact_ : reference_).push_back(i);
  }

  // True if anything is beyond tolerance of the reference at the pixel itself.
  bool any_beyond() const {
    return std::ranges::any_of(overlay_.rays(), [&](const Ray& ray) {
      return misses(ray) || std::ranges::any_of(ray.lines, [&](const Line& line) {
               return std::ranges::any_of(exact_, [&](size_t i) { return beyond(ray, line, i, false); });
             });
    });
  }

  void judge_all() {
    for (Ray& ray : overlay_.rays()) {
      judge_presence(ray);
      for (Line& line : ray.lines) judge_line(ray, line);
    }
  }

 private:
  bool is_exact(size_t i) const { return executors_[i] != Backend::reference; }
  std::string name(size_t i) const { return std::string(backend_name(executors_[i])); }

  const ProbedValue* reference(const Line& line) const {
    return reference_.empty() || !line.values[reference_[0]] ? nullptr : &*line.values[reference_[0]];
  }

  // True if some of the executors have the ray, and others lack it.
  bool misses(const Ray& ray) const {
    return !incomplete_ && std::ranges::find(ray.traced, false) != ray.traced.end();
  }

  void judge_presence(Ray& ray) {
    if (!misses(ray)) return;
    // The descendants of a missing ray are missing too.
    if (ray.parent != 0 && overlay_.rays()[ray.parent].traced == ray.traced) return;
    std::vector<std::string> with;
    bool same = true;
    for (size_t i = 0; i < executors_.size(); ++i) {
      if (ray.traced[i]) with.push_back(name(i));
      same = same && (!is_exact(i) || ray.traced[i] == ray.traced[exact_[0]]);
    }
    ray.verdict = same && ray.traced_around && ray.missed_around ? Verdict::explained : Verdict::differs;
    ray.difference =
        fmt::format("only {} {} this ray", fmt::join(with, " and "), with.size() == 1 ? "traces" : "trace");
  }

  const ProbedValue* reference(const Ray& ray, std::string_view name) const {
    const Line* const line = find_line(ray, name);
    return line ? reference(*line) : nullptr;
  }

  // The tolerance of a coordinate along this ray and at its origin: compare::t_tolerance. A ray starts
  // off its surface by up to eight times the uncertainty of the surface's position (geometry/ray.glsl).
  double coordinate_tolerance(const Ray& ray) const {
    double reach = 0, t_scale = 0;
    for (const char* point : {"origin", "position", "first_hit_position"})
      if (const ProbedValue* const p = reference(ray, point))
        reach = std::max(reach, std::hypot(p->numbers[0], p->numbers[1], p->numbers[2]));
    for (const Ray* at = &ray;; at = &overlay_.rays()[at->parent]) {
      if (const ProbedValue* const scale = reference(*at, "t_scale"))
        t_scale = std::max(t_scale, (at == &ray ? 1 : 8) * scale->numbers[0]);
      if (at->kind == RayKind::pixel) break;
    }
    return compare::t_tolerance(FirstHit{.t = reach, .t_scale = t_scale}, tolerances);
  }

  double tolerance(const Ray& ray, const Line& line, double reference) const {
    switch (meaning_of(line.name)) {
      case Meaning::point:
        return coordinate_tolerance(ray);
      case Meaning::distance:
        return std::max(tolerances.t * std::abs(reference), coordinate_tolerance(ray));
      case Meaning::direction:
        return tolerances.normal;
      case Meaning::uv:
        return tolerances.uv * std::max(1.0, std::abs(reference));
      case Meaning::color:
      case Meaning::scale:
      case Meaning::other:
        break;
    }
    return tolerances.color * std::max(1.0, std::abs(reference));
  }

  // True if the hit of this ray, or of one before it, is another primitive somewhere around the pixel. There
  // all values vary like a square root, and may lie beyond the range around the pixel by that range's width.
  bool at_rim(const Ray& ray) const {
    for (const Ray* at = &ray; at->kind != RayKind::pixel; at = &overlay_.rays()[at->parent]) {
      const Line* const primitive = find_line(*at, "primitive");
      if (at->missed_around || (primitive && primitive->range && primitive->range->whole.size() > 1))
        return true;
    }
    return false;
  }

  // True if executor i's value is beyond tolerance of the reference's value and, if `around`, also beyond
  // tolerance of the reference's range around the pixel.
  bool beyond(const Ray& ray, const Line& line, size_t i, bool around) const {
    const ProbedValue* const other = reference(line);
    if (!other || !line.values[i]) return false;
    const ProbedValue& value = *line.values[i];
    if (value.size != other->size) return true;
    if (other->type != ProbedValue::Type::real) {
      if (value.numbers[0] == other->numbers[0]) return false;
      return !around || !line.range ||
             std::ranges::find(line.range->whole, value.numbers[0]) == line.range->whole.end();
    }
    for (size_t c = 0; c < size_t(value.size); ++c) {
      const double v = value.numbers[c], r = other->numbers[c];
      if (v == r) continue;
      double low = r, high = r;
      if (around && line.range) {
        const double beyond = at_rim(ray) ? line.range->high[c] - line.range->low[c] : 0;
        low = std::min(low, line.range->low[c] - beyond);
        high = std::max(high, line.range->high[c] + beyond);
      }
      if (!(v >= low - tolerance(ray, line, low) && v <= high + tolerance(ray, line, high))) return true;
    }
    return false;
  }

  void judge_line(const Ray& ray, Line& line) {
    const auto add = [&](size_t a, size_t b, Verdict verdict) {
      line.verdict = std::max(line.verdict, verdict);
      line.difference += fmt::format("{}{} and {}: {}", line.difference.empty() ? "" : "; ", name(a), name(b),
                                     describe(*line.values[a], *line.values[b]));
    };
    for (size_t k = 1; k < exact_.size(); ++k) {
      const auto &a = line.values[exact_[0]], &b = line.values[exact_[k]];
      if (a && b && !same_bits(*a, *b)) add(exact_[0], exact_[k], Verdict::differs);
    }
    for (const size_t i : exact_)
      if (beyond(ray, line, i, false))
        add(i, reference_[0], beyond(ray, line, i, true) ? Verdict::differs : Verdict::explained);
  }

  Overlay& overlay_;
  std::span<const Backend> executors_;
  bool incomplete_;
  std::vector<size_t> exact_, reference_;
};

}  // namespace

Meaning meaning_of(std::string_view name) {
  using enum Meaning;
  if (name.starts_with(first_hit_prefix)) name.remove_prefix(first_hit_prefix.size());
  struct Row {
    std::string_view name;
    Meaning meaning;
  };
  static constexpr Row rows[] = {
      {"origin", point},
      {"position", point},
      {"t", distance},
      {"direction", direction},
      {"normal", direction},
      {"normal_geometric", direction},
      {"uv", uv},
      {"ambient", color},
      {"diffuse", color},
      {"specular", color},
      {"reflected", color},
      {"transmitted", color},
      {"emitted", color},
      {"throughput", color},
      {"light", color},
      {"contribution", color},
      {"t_scale", scale},
  };
  const auto* const row = std::ranges::find(rows, name, &Row::name);
  return row == std::end(rows) ? other : row->meaning;
}

void judge(Overlay& overlay, std::span<const executors::Backend> executors, bool incomplete,
           const std::function<void()>& add_around) {
  Judge judge(overlay, executors, incomplete);
  if (judge.any_beyond()) add_around();
  judge.judge_all();
}

}  // namespace eyeray::engine::probe
