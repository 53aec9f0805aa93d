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
  // `scene` must outlive this object.
  ChannelValues(Channels channels, const Scene& scene);

  const Channels& channels() const { return channels_; }
  // Receives rows of a channel. `channel`: its index in channels().
  using Sink = std::function<void(size_t channel, const image::Image& rows)>;
  // Passes the rows of each channel of samples to `sink`.
  void give(const Rows& rows, const Sink& sink) const;
  // Passes the values of each channel of first hits to `sink`, in rows of `width` pixels, and counts the hits
  // in the channels' legends.
  void give(std::span<const FirstHit> hits, int width, const Sink& sink);
  // The legend of one of channels(); null if its values are not ids.
  const Legend* legend(Channel channel) const;

 private:
  Channels channels_;
  std::vector<std::optional<Legend>> legends_;  // one for each channel, empty unless its values are ids
};

}  // namespace eyeray::engine::film
