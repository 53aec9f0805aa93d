// What there is to see: the supervisor writes it, the threads of the web server read it.
#pragma once

#include <condition_variable>
#include <map>
#include <mutex>
#include <optional>
#include <string>

#include "host/dev/message.hpp"
#include "host/image/false_color.hpp"
#include "host/image/image.hpp"

namespace eyeray::dev {

class Board {
 public:
  // The status: one JSON object that the page is told whenever it changes. `change` is called with it.
  template <typename Change>
  void update(const Change& change) {
    const std::lock_guard lock(mutex_);
    change(status_);
    publish();
  }

  // What a view shows: colours, or data, which is shown in false colour.
  struct Picture {
    image::Image image;
    std::optional<image::FalseColor> shown_as;
  };
  // Rows of a view's picture, from the worker: {"view", "width", "height", "row", "rows", "stride",
  // "channels"} and float32s; with "shown_as", a FalseColor. Of a coarse picture (stride > 1) each pixel
  // fills a square. Nothing for a message that does not add up.
  void put_rows(const Message& message);
  // A copy of a view's picture; nothing where there is none.
  std::optional<Picture> picture(const std::string& view) const;

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

}  // namespace eyeray::dev
