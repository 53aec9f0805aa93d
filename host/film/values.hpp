// The values of some channels as a picture is rendered, and the meaning of their ids.
#pragma once

#include <functional>
#include <optional>
#include <span>
#include <vector>

#include "host/film/film.hpp"
#include "host/film/legend.hpp"

namespace eyeray::engine::film {

class ChannelValues {
 public:
  // `scene` must outlive it.
  ChannelValues(Channels channels, const Scene& scene);

  const Channels& channels() const { return channels_; }
  // Is given rows of a channel, by its index.
  using Sink = std::function<void(size_t channel, const image::Image& rows)>;
  // Hands on the channels of samples.
  void give(const Rows& rows, const Sink& sink) const;
  // Hands on the channels of first hits, `width` a row; their legends see the hits.
  void give(std::span<const FirstHit> hits, int width, const Sink& sink);
  // The legend of a channel of ids, by its index; null for another channel.
  const Legend* legend(size_t channel) const { return legends_[channel] ? &*legends_[channel] : nullptr; }

 private:
  Channels channels_;
  std::vector<std::optional<Legend>> legends_;  // as many
};

}  // namespace eyeray::engine::film
