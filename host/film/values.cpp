#include "host/film/values.hpp"

#include <algorithm>

#include "host/core/error.hpp"

namespace eyeray::engine::film {

ChannelValues::ChannelValues(Channels channels, const Scene& scene) : channels_(std::move(channels)) {
  legends_.resize(channels_.size());
  for (size_t i = 0; i < channels_.size(); ++i)
    if (channels_[i]->legend) legends_[i].emplace(channels_[i]->legend(scene));
}

const Legend* ChannelValues::legend(Channel channel) const {
  const auto found = std::ranges::find(channels_, channel);
  CHECK(found != channels_.end());
  const std::optional<Legend>& legend = legends_[size_t(found - channels_.begin())];
  return legend ? &*legend : nullptr;
}

void ChannelValues::give(const Rows& rows, const Sink& sink) const {
  for (size_t i = 0; i < channels_.size(); ++i)
    if (channels_[i]->of_samples()) sink(i, rows[channels_[i]]);
}

void ChannelValues::give(std::span<const FirstHit> hits, int width, const Sink& sink) {
  for (size_t i = 0; i < channels_.size(); ++i) {
    if (channels_[i]->of_samples()) continue;
    sink(i, channel_image(channels_[i], hits, width, legends_[i] ? &legends_[i]->entries() : nullptr));
    if (legends_[i]) legends_[i]->see(hits);
  }
}

}  // namespace eyeray::engine::film
