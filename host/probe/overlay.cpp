#include "host/probe/overlay.hpp"

#include <algorithm>
#include <map>
#include <tuple>

namespace eyeray::engine::probe {
namespace {

// Counts how often each key has occurred: of elements with equal keys, the n-th is matched with the n-th.
template <typename Key>
class Occurrences {
 public:
  // The index of the next element for `key` among those for which `is` returns true; all.size() if there are
  // too few.
  template <typename All, typename Is>
  size_t next(const Key& key, const All& all, const Is& is) {
    size_t skip = met_[key]++;
    for (size_t i = 0; i < all.size(); ++i)
      if (is(all[i]) && skip-- == 0) return i;
    return all.size();
  }

 private:
  std::map<Key, size_t> met_;
};

using SiblingKey = std::tuple<size_t, RayKind, uint32_t>;

// The child that `ray` is laid over, below `parent`; nothing if there is none.
std::optional<size_t> child_for(const std::vector<Ray>& rays, size_t parent, const ProbedRay& ray,
                                Occurrences<SiblingKey>& occurrences) {
  const std::vector<size_t>& children = rays[parent].children;
  const size_t i = occurrences.next({parent, ray.kind, ray.number}, children, [&](size_t child) {
    return rays[child].kind == ray.kind && rays[child].number == ray.number;
  });
  return i < children.size() ? std::optional(children[i]) : std::nullopt;
}

}  // namespace

Range::Range(const ProbedValue& value) : low(value.numbers), high(value.numbers) {
  include(value);
}

void Range::include(const ProbedValue& value) {
  for (size_t c = 0; c < low.size(); ++c) {
    low[c] = std::min(low[c], value.numbers[c]);
    high[c] = std::max(high[c], value.numbers[c]);
  }
  if (value.type != ProbedValue::Type::real && std::ranges::find(whole, value.numbers[0]) == whole.end())
    whole.push_back(value.numbers[0]);
}

const Line* find_line(const Ray& ray, std::string_view name) {
  const auto found = std::ranges::find(ray.lines, name, &Line::name);
  return found == ray.lines.end() ? nullptr : &*found;
}

Overlay::Overlay(size_t executors) : executors_(executors) {
  rays_.push_back({RayKind::pixel, 0, 0, 0, std::vector<bool>(executors, true)});
}

void Overlay::add(size_t executor, const RayTree& tree) {
  std::vector<size_t> indices;                    // the index in rays_ of each ray of the tree
  std::vector<std::vector<size_t>> line_indices;  // the index in Ray::lines of each of their values
  Occurrences<SiblingKey> occurrences;
  for (const ProbedRay& ray : tree.rays) {
    size_t index = 0;
    if (!indices.empty()) {
      const size_t parent = indices[ray.parent];
      const auto found = child_for(rays_, parent, ray, occurrences);
      index = found.value_or(rays_.size());
      if (!found) {
        const size_t after = ray.index == 0 ? 0 : line_indices[ray.parent][ray.index - 1] + 1;
        rays_.push_back({ray.kind, ray.number, parent, after, std::vector<bool>(executors_, false)});
        rays_[parent].children.push_back(index);
      }
    }
    rays_[index].traced[executor] = true;
    indices.push_back(index);

    std::vector<Line>& lines = rays_[index].lines;
    Occurrences<std::string_view> names;
    line_indices.emplace_back();
    for (const ProbedValue& value : ray.values) {
      const size_t k =
          names.next(value.name, lines, [&](const Line& line) { return line.name == value.name; });
      if (k == lines.size())
        lines.push_back({value.name, std::vector<std::optional<ProbedValue>>(executors_)});
      lines[k].values[executor] = value;
      line_indices.back().push_back(k);
    }
  }
}

void Overlay::add_around(const RayTree& tree) {
  std::vector<std::optional<size_t>> indices;
  std::vector<bool> seen(rays_.size(), false);
  Occurrences<SiblingKey> occurrences;
  for (const ProbedRay& ray : tree.rays) {
    const auto index = indices.empty()        ? std::optional<size_t>(0)
                       : !indices[ray.parent] ? std::nullopt
                                              : child_for(rays_, *indices[ray.parent], ray, occurrences);
    indices.push_back(index);
    if (!index) continue;
    seen[*index] = true;
    std::vector<Line>& lines = rays_[*index].lines;
    Occurrences<std::string_view> names;
    for (const ProbedValue& value : ray.values) {
      const size_t k =
          names.next(value.name, lines, [&](const Line& line) { return line.name == value.name; });
      if (k == lines.size()) continue;
      if (lines[k].range)
        lines[k].range->include(value);
      else
        lines[k].range.emplace(value);
    }
  }
  for (size_t i = 0; i < rays_.size(); ++i)
    (seen[i] ? rays_[i].traced_around : rays_[i].missed_around) = true;
}

std::vector<size_t> Overlay::children_in_order(size_t ray) const {
  std::vector<size_t> all = rays_[ray].children;
  std::ranges::stable_sort(all, {}, [&](size_t k) { return rays_[k].index; });
  return all;
}

int Overlay::depth(size_t ray) const {
  int depth = -1;
  for (; ray != 0; ray = rays_[ray].parent) ++depth;
  return depth;
}

}  // namespace eyeray::engine::probe
