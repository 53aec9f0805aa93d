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

namespace eyeray::engine::dev {

class Board {
 public:
  // The status: one JSON object that is sent to the page whenever it changes. `change` is called with it.
  template <typename Change>
  void update(const Change& change) {
    const std::lock_guard lock(mutex_);
    change(status_);
    publish();
  }

  // The progress of a row: the request whose picture it is, the last sample, and the number of pixels for
  // each rendered one.
  struct Row {
    int64_t generation = -1, sample = -1, stride = 0;
    bool operator==(const Row&) const = default;
  };
  // The picture of a view: colours, or data, which is shown in false colour.
  struct Picture {
    image::Image image;
    std::optional<image::FalseColor> shown_as;
    std::vector<Row> rows;
  };
  // Rows of a view's picture, from the worker: {"generation", "view", "width", "height", "row", "rows",
  // "sample", "stride", "channels"} and float32s; with "shown_as", a FalseColor. Of a coarse picture
  // (stride > 1) each pixel fills a square. Nothing for a message that does not add up.
  void put_rows(const Message& message);
  // A copy of a view's picture; nothing where there is none.
  std::optional<Picture> picture(const std::string& view) const;
  // The difference of the colours of "gpu" and "reference": 0 where both are NaN, infinity where one is. NaN
  // in rows that one of them has rendered further than the other: their difference would mean nothing. Empty
  // if there are no two pictures of one size.
  std::optional<Picture> difference() const;

  // The answer to the last probe.
  void put_probe(Json answer);
  Json probe() const;

  // The status as text, once its version is another than `seen`, which is set; nothing when that takes longer
  // than `seconds` or the board was closed.
  std::optional<std::string> next_status(uint64_t& seen, double seconds) const;
  // Nobody waits any more.
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
