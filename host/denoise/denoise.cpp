#include "host/denoise/denoise.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <utility>

#include "host/core/error.hpp"
#include "host/core/halves.hpp"
#include "host/core/parallel_for.hpp"
#include "host/denoise/alpha.hpp"
#include "host/denoise/block_means.hpp"
#include "host/denoise/choice.hpp"
#include "host/scene/luminance.hpp"

namespace eyeray::engine::denoise {
namespace {

using image::Image;

constexpr float least_albedo = 0.02f;  // the least that colours are divided by
constexpr float dot_brightness = 16;   // the least brightness of a dot, relative to its surroundings
constexpr float dot_doubt = 0.2f;      // the least standard error of a dot, relative to its brightness
constexpr int scaling_radius = 5;  // radius of the windows in which variances are compared with the halves

// One picture while its noise is removed.
class Denoising {
 public:
  Denoising(const NoisyPicture& picture, Stages& stages)
      : picture_(picture),
        stages_(stages),
        width_(picture.color.width()),
        height_(picture.color.height()),
        planes_(picture.coverage.sample_count() > 0 ? 4 : 3),
        valid_(width_, height_, 1) {
    CHECK(picture.samples.width() == width_ && picture.samples.height() == height_);
    for_each_pixel(valid_, [&](int x, int y) { *valid_.at(0, x, y) = usable(x, y) ? 1.0f : 0.0f; });
    leave_out_dots();
  }

  DenoisedPicture run() {
    const Planes features = features_without_noise();
    Halves colors(width_, height_, planes_);
    split(picture_.color, picture_.half_color, 0, colors);
    if (planes_ == 4) split(picture_.coverage, picture_.half_coverage, 3, colors);
    Halves variances = variances_of(colors);
    colors.extend();
    Halves lights = colors, light_variances = variances;
    divide_by_albedo(features, lights, light_variances);
    lights.extend();
    light_variances.extend();
    const float least = least_variance(lights.first);

    Halves careful(width_, height_, planes_), bold(width_, height_, planes_);
    stages_.fit({colors, features, lights, light_variances, least, valid_}, careful, bold);
    choose_best(colors, variances, valid_, 0, 3, bold, careful);
    if (planes_ == 4) choose_best(colors, variances, valid_, 3, 4, bold, careful);
    return result_of(careful);
  }

 private:
  bool usable(int x, int y) const {
    bool usable = *picture_.samples.pixel(x, y) >= 2;
    for (const Image* each : {&picture_.color, &picture_.half_color, &picture_.variance, &picture_.albedo,
                              &picture_.half_albedo, &picture_.normal, &picture_.half_normal})
      for (int c = 0; c < 3; ++c) usable = usable && std::isfinite(each->pixel(x, y)[c]);
    return usable;
  }
  bool valid(int x, int y) const { return *valid_.at(0, x, y) != 0; }

  // The pixel's alpha, if it is covered at all; else 1, as for an opaque picture.
  float alpha(int x, int y) const {
    const float alpha = planes_ == 4 ? *picture_.coverage.pixel(x, y) : 1;
    return alpha > 0 ? alpha : 1;
  }
  bool covered(int x, int y) const { return planes_ == 3 || *picture_.coverage.pixel(x, y) > 0; }

  static float light(const Image& image, int x, int y) {
    const float* const color = image.pixel(x, y);
    return float(luminance(Vec3(color[0], color[1], color[2])));
  }

  // Dots that would still be seen if they were spread over a window stay, and do not count. They are much
  // brighter than their surroundings, and uncertain.
  void leave_out_dots() {
    const auto brightness = [&](int x, int y) {
      return valid(x, y) ? light(picture_.color, x, y) / alpha(x, y) : 0.0f;
    };
    const float floor =
        0.01f * float(parallel_sum(0, width_ * height_,
                                   [&](int i) { return double(brightness(i % width_, i / width_)); }) /
                      (double(width_) * height_));
    Planes dots(width_, height_, 1);
    for_each_pixel(valid_, [&](int x, int y) {
      const float here = brightness(x, y);
      std::array<float, 25> around{};
      int count = 0;
      for (int j = std::max(0, y - 2); j <= std::min(height_ - 1, y + 2); ++j)
        for (int i = std::max(0, x - 2); i <= std::min(width_ - 1, x + 2); ++i)
          if (covered(i, j)) around[size_t(count++)] = brightness(i, j);
      std::nth_element(around.begin(), around.begin() + count / 2, around.begin() + count);
      const bool bright = here > dot_brightness * (around[size_t(count / 2)] + floor);
      if (bright && std::sqrt(light(picture_.variance, x, y)) > dot_doubt * here) *dots.at(0, x, y) = 1;
    });
    for_each_pixel(valid_, [&](int x, int y) {
      if (*dots.at(0, x, y) != 0) *valid_.at(0, x, y) = 0;
    });
  }

  // The share of the samples that are in the first half.
  float first_share(int x, int y) const {
    const auto samples = uint64_t(*picture_.samples.pixel(x, y));
    return float(first_half_of(samples)) / float(samples);
  }

  // Writes the two halves of a mean to the planes from `plane` on.
  void split(const Image& mean, const Image& half, int plane, Halves& halves) const {
    for_each_pixel(valid_, [&](int x, int y) {
      if (!valid(x, y)) return;
      const float share = first_share(x, y);
      for (int c = 0; c < mean.channels(); ++c) {
        const float first = half.pixel(x, y)[c];
        *halves.first.at(plane + c, x, y) = first;
        *halves.second.at(plane + c, x, y) = (mean.pixel(x, y)[c] - share * first) / (1 - share);
      }
    });
  }

  // The variance of a pixel's few samples is uncertain. It is at least the mean of those around, without the
  // two greatest. Only that mean is scaled.
  static float likely_variance(const Planes& variances, int plane, int x, int y, float scale) {
    std::array<float, 9> around{};
    size_t count = 0;
    for (int j = -1; j <= 1; ++j)
      for (int i = -1; i <= 1; ++i) around[count++] = *variances.at(plane, x + i, y + j);
    std::ranges::sort(around);
    float usual = 0;
    for (size_t i = 0; i < 7; ++i) usual += around[i] / 7;
    const float own = *variances.at(plane, x, y);
    return own > 4 * usual ? own : scale * std::max(usual, own);
  }

  // The stated variance is that of independent samples. Samples that are spread evenly have less. So it is
  // scaled to how much the halves differ in a larger window.
  Halves variances_of(const Halves& colors) const {
    Halves stated(width_, height_, planes_);
    // Pairs of planes: the halves' stated variances, and their squared differences. The pairs are of the
    // colour, of the colour apart from coverage, and of the alpha.
    Planes sums(width_, height_, planes_ == 4 ? 6 : 2);
    for_each_pixel(valid_, [&](int x, int y) {
      if (!valid(x, y)) return;
      const float share = first_share(x, y);
      const auto add = [&](int plane, float variance, float apart) {
        *sums.at(plane, x, y) += variance / share + variance / (1 - share);
        *sums.at(plane + 1, x, y) += apart * apart;
      };
      const float of_alpha = variance_of_alpha(x, y),
                  alpha = planes_ == 4 ? *picture_.coverage.pixel(x, y) : 1;
      for (int c = 0; c < planes_; ++c) {
        const float variance = c == 3 ? of_alpha : picture_.variance.pixel(x, y)[c];
        const float apart = *colors.first.at(c, x, y) - *colors.second.at(c, x, y);
        *stated.first.at(c, x, y) = variance / share;
        *stated.second.at(c, x, y) = variance / (1 - share);
        add(c == 3 ? 4 : 0, variance, apart);
        if (planes_ == 3 || c == 3 || !(alpha > 0)) continue;
        const float straight = picture_.color.pixel(x, y)[c] / alpha;
        const float alphas_apart = *colors.first.at(3, x, y) - *colors.second.at(3, x, y);
        add(2, std::max(0.0f, variance - of_alpha * straight * straight), apart - alphas_apart * straight);
      }
    });
    stated.extend();
    sums.extend();
    const Planes ratio = blurred(sums, scaling_radius);
    Halves result(width_, height_, planes_);
    for_each_pixel(valid_, [&](int x, int y) {
      const auto scale_by = [&](int plane) {
        const float all = *ratio.at(plane, x, y);
        return all > 0 ? std::min(1.0f, *ratio.at(plane + 1, x, y) / all) : 0.0f;
      };
      // Outlines have far more variance than their surroundings, and evenly spread samples find them well.
      // They must not make the variance beside them seem too large.
      const float scale = planes_ == 4 ? std::max(scale_by(0), scale_by(2)) : scale_by(0);
      for (int c = 0; c < planes_; ++c) {
        const float factor = c == 3 ? scale_by(4) : scale;
        *result.first.at(c, x, y) = likely_variance(stated.first, c, x, y, factor);
        *result.second.at(c, x, y) = likely_variance(stated.second, c, x, y, factor);
      }
    });
    return result;
  }

  // The variance of the pixel's alpha if each sample is covered wholly or not at all; 0 for an opaque
  // picture.
  float variance_of_alpha(int x, int y) const {
    if (planes_ == 3) return 0;
    const float alpha = *picture_.coverage.pixel(x, y);
    return alpha * (1 - alpha) / *picture_.samples.pixel(x, y);
  }

  // Arriving light is smoother than a texture that it falls on.
  void divide_by_albedo(const Planes& features, Halves& colors, Halves& variances) const {
    for_each_pixel(valid_, [&](int x, int y) {
      for (int c = 0; c < 3; ++c) {
        const float factor = 1 / std::max(*features.at(c, x, y), least_albedo);
        for (Planes* each : {&colors.first, &colors.second}) *each->at(c, x, y) *= factor;
        for (Planes* each : {&variances.first, &variances.second}) *each->at(c, x, y) *= factor * factor;
      }
    });
  }

  // Albedo and normal, each half averaged with weights from the other one.
  Planes features_without_noise() const {
    Halves halves(width_, height_, feature_count);
    split(picture_.albedo, picture_.half_albedo, 0, halves);
    split(picture_.normal, picture_.half_normal, 3, halves);
    halves.extend();
    Planes squares(width_, height_, feature_count);
    for_each_pixel(valid_, [&](int x, int y) {
      for (int f = 0; f < feature_count; ++f) {
        const float apart = *halves.first.at(f, x, y) - *halves.second.at(f, x, y);
        *squares.at(f, x, y) = 0.5f * apart * apart;
      }
    });
    squares.extend();
    const Planes variances = blurred(squares, 2);

    Planes features(width_, height_, feature_count);
    stages_.average({halves, variances, valid_}, features);
    features.extend();
    return features;
  }

  // Far below any noise that is seen.
  float least_variance(const Planes& colors) const {
    double sum = 0;
    for (int y = 0; y < height_; ++y)
      for (int x = 0; x < width_; ++x) sum += double(*colors.at(1, x, y));
    const double mean = sum / (double(width_) * height_);
    return float(std::max(1e-8 * mean * mean, 1e-30));
  }

  DenoisedPicture result_of(const Halves& fitted) const {
    DenoisedPicture result{.color = picture_.color, .errors = Image(width_, height_, 1)};
    double errors = 0, sum = 0;
    for (int y = 0; y < height_; ++y) {
      for (int x = 0; x < width_; ++x) {
        if (!valid(x, y)) {
          *result.errors.pixel(x, y) = std::sqrt(light(picture_.variance, x, y));
          continue;
        }
        const float share = first_share(x, y);
        Vec3 apart(0.0);
        for (int c = 0; c < 3; ++c) {
          const float first = *fitted.first.at(c, x, y), second = *fitted.second.at(c, x, y);
          result.color.pixel(x, y)[c] = share * first + (1 - share) * second;
          apart[c] = double(first - second) / 2;
        }
        const double error = std::abs(luminance(apart));
        *result.errors.pixel(x, y) = float(error);
        errors += error;
        sum += double(light(result.color, x, y));
      }
    }
    keep_block_means(picture_.color, valid_, result.color);
    if (planes_ == 4)
      result.color = with_alpha(picture_, result.color, [&](int x, int y) {
        if (!valid(x, y)) return *picture_.coverage.pixel(x, y);
        const float share = first_share(x, y);
        return share * *fitted.first.at(3, x, y) + (1 - share) * *fitted.second.at(3, x, y);
      });
    result.error = sum > 0 ? errors / sum : 0;
    return result;
  }

  const NoisyPicture& picture_;
  Stages& stages_;
  const int width_, height_;
  const int planes_;  // 3 for the colour, and one for the alpha of a transparent picture
  Planes valid_;      // 1 for pixels that take part
};

}  // namespace

DenoisedPicture denoise(const NoisyPicture& picture, Stages& stages) {
  return Denoising(picture, stages).run();
}

DenoisedPicture denoise(const NoisyPicture& picture) {
  ProcessorStages stages;
  return denoise(picture, stages);
}

}  // namespace eyeray::engine::denoise
