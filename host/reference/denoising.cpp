#include "host/reference/denoising.hpp"

#include <algorithm>
#include <cmath>

#include "host/core/halves.hpp"
#include "host/reference/least_squares.hpp"
#include "host/reference/pixel_field.hpp"
#include "host/scene/luminance.hpp"

namespace eyeray::engine::reference {
namespace {

using image::Image;

constexpr double rounding = 1e-5;  // decisions that are closer than this, relatively, may differ in float32
constexpr int window = 6, feature_window = 5, patch = 3, block = 64;

double weight_of(double distance) {
  return std::pow(std::max(0.0, 1 - distance / 16), 16);
}

class Denoising {
 public:
  explicit Denoising(const image::NoisyPicture& picture)
      : picture_(picture),
        width_(picture.color.width()),
        height_(picture.color.height()),
        channels_(picture.coverage.sample_count() > 0 ? 4 : 3),
        counts_(width_, height_, 1),
        undecided_(width_, height_, 1) {
    find_pixels_that_count();
  }

  std::vector<DenoisedPixel> run() {
    const PixelField features = mean_features();
    const HalfFields colors =
        halves({&picture_.color, &picture_.coverage}, {&picture_.half_color, &picture_.half_coverage});
    const HalfFields variances = variances_of(colors);
    const HalfFields lights = by_albedo(colors, features, 1),
                     light_variances = by_albedo(variances, features, 2);
    double mean = 0;
    for (int y = 0; y < height_; ++y)
      for (int x = 0; x < width_; ++x) mean += lights.first.at(x, y)[1] / (double(width_) * height_);
    const double least = std::max(1e-8 * mean * mean, 1e-30);
    HalfFields careful = colors, bold = colors;
    fit(colors.first, features, lights.second, light_variances.second, least, careful.first, bold.first);
    fit(colors.second, features, lights.first, light_variances.first, least, careful.second, bold.second);
    PixelField doubts(width_, height_, channels_);
    choose(colors, variances, 0, 3, bold, careful, doubts);
    if (channels_ == 4) choose(colors, variances, 3, 4, bold, careful, doubts);
    return result_of(careful, doubts);
  }

 private:
  bool counts(int x, int y) const { return counts_.has(x, y) && counts_.at(x, y)[0] > 0; }
  double share(int x, int y) const {
    const auto samples = uint64_t(*picture_.samples.pixel(x, y));
    return double(first_half_of(samples)) / double(samples);
  }
  double alpha(int x, int y) const { return channels_ == 4 ? double(*picture_.coverage.pixel(x, y)) : 1; }
  static double light(const float* color) {
    return luminance(Vec3(double(color[0]), double(color[1]), double(color[2])));
  }
  // Rounding may decide: marks the pixels that this affects.
  void mark(int x, int y, int radius) {
    for (int j = std::max(0, y - radius); j <= std::min(height_ - 1, y + radius); ++j)
      for (int i = std::max(0, x - radius); i <= std::min(width_ - 1, x + radius); ++i)
        undecided_.at(i, j)[0] = 1;
  }
  static bool close(double a, double b) {
    return a != b && std::abs(a - b) <= rounding * std::max(std::abs(a), std::abs(b));
  }

  // Pixels count if they are finite, have two samples, and are no dots: much brighter than the median around,
  // and uncertain.
  void find_pixels_that_count() {
    const Image* const images[] = {&picture_.color,      &picture_.half_color,  &picture_.variance,
                                   &picture_.albedo,     &picture_.half_albedo, &picture_.normal,
                                   &picture_.half_normal};
    PixelField brightness(width_, height_, 1);
    double mean = 0;
    for (int y = 0; y < height_; ++y) {
      for (int x = 0; x < width_; ++x) {
        bool usable = *picture_.samples.pixel(x, y) >= 2;
        for (const Image* image : images)
          for (int c = 0; c < 3; ++c) usable = usable && std::isfinite(image->pixel(x, y)[c]);
        counts_.at(x, y)[0] = usable;
        if (usable)
          brightness.at(x, y)[0] = light(picture_.color.pixel(x, y)) / (alpha(x, y) > 0 ? alpha(x, y) : 1);
        mean += brightness.at(x, y)[0] / (double(width_) * height_);
      }
    }
    for (int y = 0; y < height_; ++y) {
      for (int x = 0; x < width_; ++x) {
        std::vector<double> around;
        for (int j = y - 2; j <= y + 2; ++j)
          for (int i = x - 2; i <= x + 2; ++i)
            if (counts_.has(i, j) && alpha(i, j) > 0) around.push_back(brightness.at(i, j)[0]);
        std::ranges::sort(around);
        const double here = brightness.at(x, y)[0];
        const double usual = around.empty() ? 0 : around[around.size() / 2];
        const double bound = 16 * (usual + 0.01 * mean);
        const double error = std::sqrt(light(picture_.variance.pixel(x, y)));
        if (here > bound && error > 0.2 * here) counts_.at(x, y)[0] = 0;
        if (close(here, bound) || (here > bound && close(error, 0.2 * here))) mark(x, y, 20);
      }
    }
  }

  // The means of both halves, of images one after the other; 0 for pixels that do not count.
  HalfFields halves(std::vector<const Image*> means, std::vector<const Image*> firsts) const {
    int count = 0;
    for (const Image* mean : means) count += mean->sample_count() > 0 ? mean->channels() : 0;
    HalfFields result{PixelField(width_, height_, count), PixelField(width_, height_, count)};
    counts_.each([&](int x, int y) {
      if (!counts(x, y)) return;
      int at = 0;
      for (size_t i = 0; i < means.size(); ++i) {
        for (int c = 0; means[i]->sample_count() > 0 && c < means[i]->channels(); ++c, ++at) {
          const double mean = double(means[i]->pixel(x, y)[c]), first = double(firsts[i]->pixel(x, y)[c]);
          result.first.at(x, y)[at] = first;
          result.second.at(x, y)[at] = (mean - share(x, y) * first) / (1 - share(x, y));
        }
      }
    });
    return result;
  }

  // Calls body(x, distance) for the pixels of a row and their neighbours (dx, dy) away, if these count.
  template <typename Body>
  void compare_row(const PixelField& values, const PixelField& variances, double least, int dx, int dy, int y,
                   const Body& body) const {
    const auto difference = [&](int x, int j) {
      if (!counts(x, j) || !counts(x + dx, j + dy)) return 0.0;
      double sum = 0;
      for (int c = 0; c < values.count(); ++c) {
        const double apart = values.at(x, j)[c] - values.at(x + dx, j + dy)[c];
        const double own = variances.at(x, j)[c], other = variances.at(x + dx, j + dy)[c];
        const double noise = own + std::min(own, other);
        sum += (apart * apart - noise) / (least + noise);
      }
      return sum / values.count();
    };
    std::vector<double> columns(size_t(width_) + 2 * patch), own(size_t(width_) + 2 * patch);
    for (int x = -patch; x < width_ + patch; ++x) {
      for (int j = y - patch; j <= y + patch; ++j) columns[size_t(x + patch)] += difference(x, j);
      own[size_t(x + patch)] = difference(x, y);
    }
    for (int x = 0; x < width_; ++x) {
      if (!counts(x + dx, y + dy)) continue;
      double sum = 0;
      for (int i = 0; i <= 2 * patch; ++i) sum += columns[size_t(x + i)];
      body(x, std::max({0.0, sum / ((2 * patch + 1) * (2 * patch + 1)), own[size_t(x + patch)] / 4}));
    }
  }

  // Albedo and normal by non-local means: each half with weights from the other one.
  PixelField mean_features() const {
    const HalfFields noisy =
        halves({&picture_.albedo, &picture_.normal}, {&picture_.half_albedo, &picture_.half_normal});
    PixelField squares(width_, height_, 6);
    squares.each([&](int x, int y) {
      for (int f = 0; f < 6; ++f)
        squares.at(x, y)[f] = std::pow(noisy.first.at(x, y)[f] - noisy.second.at(x, y)[f], 2) / 2;
    });
    const PixelField variances = squares.mean(2);
    PixelField result(width_, height_, 6);
    for (const auto& [half, other] :
         {std::pair(&noisy.first, &noisy.second), {&noisy.second, &noisy.first}}) {
      parallel_for(0, height_, [&, half = half, other = other](int y) {
        std::vector<std::array<double, 7>> sums(size_t(width_), std::array<double, 7>{});
        for (int dy = -feature_window; dy <= feature_window; ++dy)
          for (int dx = -feature_window; dx <= feature_window; ++dx)
            compare_row(*other, variances, 1e-4, dx, dy, y, [&](int x, double distance) {
              const double weight = weight_of(distance);
              for (int f = 0; f < 6; ++f) sums[size_t(x)][size_t(f)] += weight * half->at(x + dx, y + dy)[f];
              sums[size_t(x)][6] += weight;
            });
        for (int x = 0; x < width_; ++x)
          for (int f = 0; f < 6 && sums[size_t(x)][6] > 0; ++f)
            result.at(x, y)[f] += sums[size_t(x)][size_t(f)] / sums[size_t(x)][6] / 2;
      });
    }
    return result;
  }

  // The stated variance of each half, but at least the mean of those around without the two greatest. Samples
  // that are spread evenly have less: that mean is scaled to how much the halves differ around.
  HalfFields variances_of(const HalfFields& colors) {
    HalfFields stated{PixelField(width_, height_, channels_), PixelField(width_, height_, channels_)};
    // Stated variances and squared differences of the colour, of the colour apart from coverage, and of the
    // alpha.
    PixelField sums(width_, height_, 6);
    counts_.each([&](int x, int y) {
      if (!counts(x, y)) return;
      const double part = share(x, y), parts = 1 / part + 1 / (1 - part);
      const double a = alpha(x, y);
      const double of_alpha = channels_ == 4 ? a * (1 - a) / double(*picture_.samples.pixel(x, y)) : 0;
      double* const sum = sums.at(x, y);
      const auto apart = [&](int c) { return colors.first.at(x, y)[c] - colors.second.at(x, y)[c]; };
      for (int c = 0; c < channels_; ++c) {
        const double variance = c == 3 ? of_alpha : double(picture_.variance.pixel(x, y)[c]);
        stated.first.at(x, y)[c] = variance / part;
        stated.second.at(x, y)[c] = variance / (1 - part);
        sum[c == 3 ? 4 : 0] += variance * parts;
        sum[c == 3 ? 5 : 1] += apart(c) * apart(c);
        if (channels_ == 3 || c == 3 || !(a > 0)) continue;
        const double straight = double(picture_.color.pixel(x, y)[c]) / a;
        sum[2] += std::max(0.0, variance - of_alpha * straight * straight) * parts;
        sum[3] += std::pow(apart(c) - apart(3) * straight, 2);
      }
    });
    const PixelField ratios = sums.mean(5);
    HalfFields result = stated;
    for (int y = 0; y < height_; ++y) {
      for (int x = 0; x < width_; ++x) {
        const auto scale = [&](int at) {
          const double* const ratio = ratios.at(x, y);
          return ratio[at] > 0 ? std::min(1.0, ratio[at + 1] / ratio[at]) : 0;
        };
        const double of_color = channels_ == 4 ? std::max(scale(0), scale(2)) : scale(0);
        for (int c = 0; c < channels_; ++c) {
          likely_variance(stated.first, x, y, c, c == 3 ? scale(4) : of_color, result.first);
          likely_variance(stated.second, x, y, c, c == 3 ? scale(4) : of_color, result.second);
        }
      }
    }
    return result;
  }
  void likely_variance(const PixelField& stated, int x, int y, int c, double scale, PixelField& result) {
    std::array<double, 9> around{};
    for (int i = 0; i < 9; ++i) around[size_t(i)] = stated.at(x + i % 3 - 1, y + i / 3 - 1)[c];
    std::ranges::sort(around);
    double usual = 0;
    for (size_t i = 0; i < 7; ++i) usual += around[i] / 7;
    const double own = stated.at(x, y)[c];
    result.at(x, y)[c] = own > 4 * usual ? own : scale * std::max(usual, own);
    if (close(own, 4 * usual)) mark(x, y, 12);
  }

  // Colours divided by albedo, or variances by its square.
  HalfFields by_albedo(HalfFields values, const PixelField& features, int power) const {
    counts_.each([&](int x, int y) {
      for (PixelField* field : {&values.first, &values.second})
        for (int c = 0; c < 3; ++c)
          field->at(x, y)[c] /= std::pow(std::max(features.at(x, y)[c], 0.02), power);
    });
    return values;
  }

  // The value at each pixel of the linear function that fits its window best, by stricter and looser weights.
  void fit(const PixelField& colors, const PixelField& features, const PixelField& lights,
           const PixelField& variances, double least, PixelField& careful, PixelField& bold) const {
    parallel_for(0, height_, [&](int y) {
      std::vector<LeastSquares> strict(size_t(width_), LeastSquares(6, channels_)), loose = strict;
      for (int dy = -window; dy <= window; ++dy)
        for (int dx = -window; dx <= window; ++dx)
          compare_row(lights, variances, least, dx, dy, y, [&](int x, double distance) {
            std::array<double, 6> terms{};
            for (int f = 0; f < 6; ++f)
              terms[size_t(f)] = features.at(x + dx, y + dy)[f] - features.at(x, y)[f];
            strict[size_t(x)].add(weight_of(2.5 * distance), terms, colors.at(x + dx, y + dy));
            loose[size_t(x)].add(weight_of(0.4 * distance), terms, colors.at(x + dx, y + dy));
          });
      for (int x = 0; x < width_; ++x) {
        if (!counts(x, y)) continue;
        const auto one = strict[size_t(x)].constants(1e-3), other = loose[size_t(x)].constants(1e-3);
        for (int c = 0; c < channels_; ++c) {
          careful.at(x, y)[c] = std::max(0.0, one[size_t(c)]);
          bold.at(x, y)[c] = std::max(0.0, other[size_t(c)]);
        }
      }
    });
  }

  // In a window around each pixel: the squared error of a fit, seen from the other half less its variance,
  // that variance, and the sum of all these as positive numbers.
  PixelField errors_of(const HalfFields& colors, const HalfFields& variances, int begin, int end,
                       const HalfFields& fitted) const {
    PixelField sums(width_, height_, 3);
    sums.each([&](int x, int y) {
      if (!counts(x, y)) return;
      for (int c = begin; c < end; ++c) {
        const double squares = std::pow(fitted.first.at(x, y)[c] - colors.second.at(x, y)[c], 2) +
                               std::pow(fitted.second.at(x, y)[c] - colors.first.at(x, y)[c], 2);
        const double noise = variances.first.at(x, y)[c] + variances.second.at(x, y)[c];
        sums.at(x, y)[0] += (squares - noise) / 2;
        sums.at(x, y)[1] += noise / 2;
        sums.at(x, y)[2] += (squares + noise) / 2;
      }
    });
    return sums.mean(2);
  }

  // The better fit at each pixel, mixed with the noisy halves so that the error is least.
  void choose(const HalfFields& colors, const HalfFields& variances, int begin, int end,
              const HalfFields& other, HalfFields& best, PixelField& doubts) const {
    const PixelField errors = errors_of(colors, variances, begin, end, best);
    const PixelField others = errors_of(colors, variances, begin, end, other);
    counts_.each([&](int x, int y) {
      const double* const own = errors.at(x, y);
      const double* const its = others.at(x, y);
      const double noise = own[1] / 2, error = std::max(0.0, std::min(own[0], its[0]) - noise);
      const double mixed = error > 0 ? error / (error + noise) : 0;
      const bool doubtful = std::abs(own[0] - its[0]) <= 10 * rounding * (own[2] + its[2]);
      for (int c = begin; c < end; ++c) {
        const auto mix = [&](const PixelField& fitted, const PixelField& noisy) {
          return fitted.at(x, y)[c] + mixed * (noisy.at(x, y)[c] - fitted.at(x, y)[c]);
        };
        const double kept[] = {mix(best.first, colors.first), mix(best.second, colors.second)};
        const double taken[] = {mix(other.first, colors.first), mix(other.second, colors.second)};
        const bool better = its[0] < own[0];
        best.first.at(x, y)[c] = better ? taken[0] : kept[0];
        best.second.at(x, y)[c] = better ? taken[1] : kept[1];
        if (doubtful)
          doubts.at(x, y)[c] =
              std::abs(share(x, y) * (kept[0] - taken[0]) + (1 - share(x, y)) * (kept[1] - taken[1]));
      }
    });
  }

  // Factors by which blocks keep their mean, as often as needed.
  void keep_means(PixelField& picture, PixelField& doubts) const {
    const int across = (width_ + block - 1) / block, down = (height_ + block - 1) / block;
    for (int repeat = 0; repeat < 8; ++repeat) {
      PixelField factors(across, down, 3);
      factors.each([&](int i, int j) {
        for (int c = 0; c < 3; ++c) {
          double wanted = 0, present = 0;
          for (int y = j * block; y < std::min((j + 1) * block, height_); ++y)
            for (int x = i * block; x < std::min((i + 1) * block, width_); ++x)
              if (counts(x, y))
                wanted += double(picture_.color.pixel(x, y)[c]), present += picture.at(x, y)[c];
          factors.at(i, j)[c] = present > 0 && wanted > 0 ? wanted / present : 1;
        }
      });
      picture.each([&](int x, int y) {
        if (!counts(x, y)) return;
        const double u = (x + 0.5) / block - 0.5, v = (y + 0.5) / block - 0.5;
        const int i = int(std::floor(u)), j = int(std::floor(v));
        for (int c = 0; c < 3; ++c) {
          const auto row = [&](int k) {
            return std::lerp(factors.at(i, k)[c], factors.at(i + 1, k)[c], u - i);
          };
          const double factor = std::lerp(row(j), row(j + 1), v - j);
          picture.at(x, y)[c] *= factor;
          doubts.at(x, y)[c] *= factor;
        }
      });
    }
  }

  // True if all around are wholly covered, or not at all.
  bool evenly_covered(int x, int y) const {
    const double here = alpha(x, y);
    bool even = here == 0 || here == 1;
    for (int j = y - 1; j <= y + 1; ++j)
      for (int i = x - 1; i <= x + 1; ++i) even = even && (!counts_.has(i, j) || alpha(i, j) == here);
    return even;
  }

  std::vector<DenoisedPixel> result_of(const HalfFields& fitted, PixelField& doubts) const {
    PixelField picture(width_, height_, channels_);
    picture.each([&](int x, int y) {
      for (int c = 0; c < channels_; ++c)
        picture.at(x, y)[c] = !counts(x, y) ? (c == 3 ? alpha(x, y) : double(picture_.color.pixel(x, y)[c]))
                                            : share(x, y) * fitted.first.at(x, y)[c] +
                                                  (1 - share(x, y)) * fitted.second.at(x, y)[c];
    });
    keep_means(picture, doubts);
    std::vector<DenoisedPixel> result(size_t(width_) * size_t(height_));
    picture.each([&](int x, int y) {
      DenoisedPixel& pixel = result[size_t(y) * size_t(width_) + size_t(x)];
      const bool even = channels_ == 4 && evenly_covered(x, y);
      for (int c = 0; c < channels_; ++c) {
        pixel.color[size_t(c)] = picture.at(x, y)[c];
        pixel.doubt[size_t(c)] = doubts.at(x, y)[c];
        if (even && alpha(x, y) == 0 && c < 3) pixel.color[size_t(c)] = double(picture_.color.pixel(x, y)[c]);
      }
      if (channels_ == 4) pixel.color[3] = even ? alpha(x, y) : std::min(1.0, pixel.color[3]);
      pixel.undecided = undecided_.at(x, y)[0] > 0;
    });
    return result;
  }

  const image::NoisyPicture& picture_;
  const int width_, height_, channels_;
  PixelField counts_;     // 1 for pixels that count
  PixelField undecided_;  // DenoisedPixel::undecided
};

}  // namespace

std::vector<DenoisedPixel> denoise(const image::NoisyPicture& picture) {
  return Denoising(picture).run();
}

}  // namespace eyeray::engine::reference
