// A destination that gets a picture without its noise.
#pragma once

#include "host/denoise/denoise.hpp"
#include "host/session/output.hpp"

namespace eyeray::engine::session {

// Collects the picture and the inputs of denoising, and passes the result to `output` at the end. Channels
// that `output` shows are passed on at once; if it is layered, it shows all.
class DenoisedOutput final : public Output {
 public:
  // `shown`: the channels that `output` gets. `output` must outlive this object. `transparent`: whether the
  // picture has an alpha.
  DenoisedOutput(Output& output, const film::Channels& shown, bool transparent);

  // All channels that the picture must be rendered with.
  const film::Channels& channels() const { return channels_; }
  std::vector<std::filesystem::path> files() const override { return output_.files(); }
  void begin(const Plan& plan) override;
  void write(size_t plane, const image::Image& rows) override;
  void finish_color() override;
  void finish(const film::ChannelValues& values, Result& result) override { output_.finish(values, result); }
  // Adds the noise that is left, and the time.
  void describe(Result& result) const;

 private:
  Output& output_;
  film::Channels channels_;
  bool transparent_;
  film::Channels shown_;
  denoise::NoisyPicture picture_;
  std::vector<int> rows_;  // the number of rows that each plane has so far
  double error_ = 0;
  double seconds_ = 0;
};

}  // namespace eyeray::engine::session
