// The values of some AOVs as a picture is rendered, and what their ids stand for.
#pragma once

#include <functional>
#include <optional>
#include <span>
#include <vector>

#include "host/aov/aov.hpp"
#include "host/aov/legend.hpp"

namespace eyeray::aov {

class AovValues {
 public:
  // `scene` must outlive it.
  AovValues(std::vector<Aov> aovs, const Scene& scene);

  const std::vector<Aov>& aovs() const { return aovs_; }
  // Is given rows of an AOV, by its index.
  using Sink = std::function<void(size_t aov, const image::Image& rows)>;
  // Of those that are made of these.
  void give(const render::FinishedRows& rows, const Sink& sink) const;
  // Of those that are made of first hits, `width` a row, which their legends see.
  void give(std::span<const FirstHit> hits, int width, const Sink& sink);
  // Of an AOV of ids, by its index; null of another.
  const Legend* legend(size_t aov) const { return legends_[aov] ? &*legends_[aov] : nullptr; }

 private:
  std::vector<Aov> aovs_;
  std::vector<std::optional<Legend>> legends_;  // as many
};

}  // namespace eyeray::aov
