// A destination that gets a picture without its noise.
#pragma once

#include <memory>
#include <utility>

#include "host/denoise/denoise.hpp"
#include "host/session/output.hpp"

namespace eyeray::engine::session {

// Collects the picture and the inputs of denoising, and passes the result to `output` at the end. Channels
// that `output` shows are passed on at once; if it is layered, it shows all.
class DenoisedOutput final : public Output {
 public:
  // `shown`: the channels that `output` gets. `output` must outlive this object. `transparent`: whether the
  // picture has an alpha.
  DenoisedOutput(Denoiser denoiser, Output& output, const film::Channels& shown, bool transparent);

  // To be called before the picture is finished.
  void use(std::unique_ptr<denoise::Stages> stages) { stages_ = std::move(stages); }
  // To be called before the picture is denoised. `progress` must return true.
  void report_to(denoise::Stages::Progress progress) { progress_ = std::move(progress); }
  // All channels that the picture must be rendered with.
  const film::Channels& channels() const { return channels_; }
  std::vector<std::filesystem::path> files() const override { return output_.files(); }
  void begin(const Plan& plan) override;
  void write(size_t plane, const image::Image& rows) override;
  void finish_color() override;
  void finish(const film::ChannelValues& values, Result& result) override { output_.finish(values, result); }
  // True if the denoiser estimates the noise that is left.
  bool estimates() const { return denoiser_ == Denoiser::own; }
  // The noise that is left in each block (film::NoiseBlocks) once these rows, which are all, are denoised.
  // Requires estimates().
  std::vector<double> noise_left(const film::Rows& all);
  // Adds the noise that is left in the picture.
  void describe(Result& result) const;
  // Adds a warning if the device failed to denoise.
  void warn(std::vector<Diagnostic>& warnings) const;
  void add_times(StageTimes& times) const;

 private:
  void pass_on(film::Channel channel, const image::Image& rows);
  denoise::DenoisedPicture denoise(const denoise::NoisyPicture& picture);
  // If the device fails or is interrupted, the processor denoises, which has the same bits: the samples are
  // not lost.
  denoise::DenoisedPicture denoise_without_loss(const denoise::NoisyPicture& picture);
  std::vector<double> noise_of(const denoise::DenoisedPicture& picture) const;

  Denoiser denoiser_;
  std::unique_ptr<denoise::Stages> stages_;
  denoise::Stages::Progress progress_;  // may be empty
  Output& output_;
  film::Channels channels_;
  bool transparent_;
  std::string failure_;  // why the device failed to denoise
  film::Channels shown_;
  denoise::NoisyPicture picture_;
  std::vector<int> rows_;    // the number of rows that each plane has so far
  double shown_as_one_ = 1;  // the luminance that the picture shows as 1
  double noise_wanted_ = 0;  // Request::noise
  double error_ = 0;
  std::vector<double> noise_;  // the noise that is left in each block
  double seconds_ = 0;         // spent on all denoising
  double last_seconds_ = 0;    // spent on the finished picture
};

}  // namespace eyeray::engine::session
