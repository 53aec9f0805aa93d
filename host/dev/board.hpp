// The state shown on the page: the supervisor writes it, the threads of the web server read it.
#pragma once

#include <condition_variable>
#include <map>
#include <mutex>
#include <optional>
#include <string>

#include "host/dev/message.hpp"
#include "host/image/false_color.hpp"
#include "host/image/image.hpp"
#include "host/image/tone.hpp"

namespace eyeray::engine::dev {

class Board {
 public:
  // Calls `change` with the status: one JSON object that is sent to the page whenever it changes.
  template <typename Change>
  void update(const Change& change) {
    const std::lock_guard lock(mutex_);
    change(status_);
    publish();
  }

  // The progress of a row: the generation of its request, its last sample, and its stride: each rendered
  // pixel fills stride x stride pixels.
  struct Row {
    int64_t generation = -1, sample = -1, stride = 0;
    bool operator==(const Row&) const = default;
  };
  // The picture of a view: colours, or data, which is shown in false colour.
  struct Picture {
    image::Image image;
    std::optional<image::FalseColor> shown_as;
    image::Tone tone;  // tone of colours
    std::vector<Row> rows;
  };
  // Stores rows of a view's picture, from the worker: {"generation", "view", "width", "height", "row",
  // "rows", "sample", "stride", "channels"} and float32s; with "shown_as", a FalseColor, or "tone",
  // {"exposure", "curve", "white_balance"}. In a coarse picture (stride > 1) each pixel fills a square.
  // Ignores an inconsistent message.
  void put_rows(const Message& message);
  // A copy of a view's picture; empty if the view has none.
  std::optional<Picture> picture(const std::string& view) const;
  // The difference of the colours of "gpu" and "reference": 0 where both are NaN, infinity where one is. NaN
  // in rows that one picture has rendered further than the other: their difference would mean nothing. Empty
  // unless both pictures exist and have the same size.
  std::optional<Picture> difference() const;

  // The answer to the last probe.
  void put_probe(Json answer);
  Json probe() const;

  // Waits until the version of the status differs from `seen`, sets `seen` to it, and returns the status as
  // text. Empty after `seconds` without a change, or if the board was closed.
  std::optional<std::string> next_status(uint64_t& seen, double seconds) const;
  // Wakes all threads that wait for a status: next_status() then returns nothing.
  void close();
  bool closed() const;

 private:
  void publish();

  mutable std::mutex mutex_;
  mutable std::condition_variable changed_;
  Json status_ = Json::object();
  uint64_t version_ = 0;
  std::map<std::string, Picture> pictures_;
  Json probe_;
  bool closed_ = false;
};

}  // namespace eyeray::engine::dev
