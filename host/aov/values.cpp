#include "host/aov/values.hpp"

namespace eyeray::aov {

AovValues::AovValues(std::vector<Aov> aovs, const Scene& scene) : aovs_(std::move(aovs)) {
  legends_.resize(aovs_.size());
  for (size_t i = 0; i < aovs_.size(); ++i)
    if (aovs_[i]->legend) legends_[i].emplace(aovs_[i]->legend(scene));
}

void AovValues::give(const render::FinishedRows& rows, const Sink& sink) const {
  for (size_t i = 0; i < aovs_.size(); ++i)
    if (const ValuesOfRows* values = std::get_if<ValuesOfRows>(&aovs_[i]->values)) sink(i, (*values)(rows));
}

void AovValues::give(std::span<const FirstHit> hits, int width, const Sink& sink) {
  for (size_t i = 0; i < aovs_.size(); ++i) {
    if (!aovs_[i]->is_of_first_hits()) continue;
    sink(i, aov_image(aovs_[i], hits, width, legends_[i] ? &legends_[i]->entries() : nullptr));
    if (legends_[i]) legends_[i]->see(hits);
  }
}

}  // namespace eyeray::aov
