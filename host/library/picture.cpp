#include "host/library/picture.hpp"

#include <algorithm>

#include "host/image/image_file.hpp"
#include "host/library/engine_call.hpp"

namespace eyeray::engine::library {
namespace {

v0::Plane plane_of(const image::Image& image) {
  return {image.samples(), image.width(), image.height(), image.sample_count() > 0 ? image.channels() : 0};
}

}  // namespace
}  // namespace eyeray::engine::library

namespace eyeray::inline v0 {

Plane Picture::color() const {
  return engine::library::plane_of(data_->color);
}

std::vector<std::string> Picture::aovs() const {
  std::vector<std::string> names;
  for (const auto& each : data_->aovs) names.emplace_back(each.first->name);
  return names;
}

Plane Picture::aov(std::string_view name) const {
  for (const auto& [aov, image] : data_->aovs)
    if (aov->name == name) return engine::library::plane_of(image);
  throw Error(ErrorKind::bad_input,
              fmt::format("the picture has no AOV '{}'{}; request it by the option `aovs` of the render",
                          name, data_->complete ? "" : ", since it was cancelled"));
}

int Picture::samples_done() const noexcept {
  return data_->samples_done;
}
bool Picture::complete() const noexcept {
  return data_->complete;
}
uint64_t Picture::rays() const noexcept {
  return data_->rays;
}
double Picture::seconds() const noexcept {
  return data_->seconds;
}
double Picture::sampling_seconds() const noexcept {
  return data_->sampling_seconds;
}
const std::vector<Diagnostic>& Picture::warnings() const noexcept {
  return data_->warnings;
}

std::vector<uint8_t> Picture::tonemapped() const {
  return engine::library::run_engine([&] {
    const engine::image::Image shown = engine::image::toned(data_->color, data_->tone);
    std::vector<uint8_t> codes(shown.sample_count());
    std::ranges::transform(shown.samples(), codes.begin(), engine::image::srgb8);
    if (shown.channels() == 4)
      for (size_t i = 3; i < codes.size(); i += 4) codes[i] = engine::image::alpha8(shown.samples()[i]);
    return codes;
  });
}

std::string Picture::png() const {
  return engine::library::run_engine([&] {
    if (data_->color.sample_count() == 0)
      throw engine::Error(engine::ExitCode::bad_input,
                          "there is no .png: the picture was cancelled and is empty");
    return engine::image::encode_png(engine::image::toned(data_->color, data_->tone));
  });
}

void Picture::write(const std::filesystem::path& file) const {
  engine::library::call_engine([&] {
    const bool shown = engine::image::image_format(file) == engine::image::ImageFormat::png;
    if (data_->color.sample_count() == 0)
      throw engine::Error(engine::ExitCode::bad_input,
                          "{} is not written: the picture was cancelled and is empty", file.string());
    engine::image::write_image(file, shown ? engine::image::toned(data_->color, data_->tone) : data_->color);
  });
}

}  // namespace eyeray::inline v0
