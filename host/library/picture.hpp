// The implementation of the library's pictures.
#pragma once

#include <eyeray/eyeray.hpp>

#include <string>
#include <vector>

#include "host/film/channel.hpp"
#include "host/image/image.hpp"
#include "host/image/tone.hpp"

namespace eyeray::inline v0 {

struct Picture::Data {
  engine::image::Tone tone;
  engine::image::Image color;
  std::vector<std::pair<engine::film::Channel, engine::image::Image>> aovs;
  int samples_done = 0;
  bool complete = false;
  uint64_t rays = 0;
  double seconds = 0;
  double sampling_seconds = 0;
  std::vector<Diagnostic> warnings;
};

}  // namespace eyeray::inline v0
