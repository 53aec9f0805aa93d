#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "host/core/error.hpp"
#include "host/image/coded_image.hpp"
//
#include "tests/support/doctest.hpp"

namespace eyeray::engine::test {

using Colors = std::vector<std::array<uint8_t, 4>>;

struct Decoded {
  Colors pixels;
  int width = 0, height = 0;
  std::vector<std::string> warnings;
  std::string refused;
};

inline Decoded decode_tiff(const std::string& bytes) {
  Decoded result;
  try {
    image::PixelBudget budget;
    image::CodedImage image =
        image::decode_coded_image(std::as_bytes(std::span(bytes)), "a", budget, result.warnings);
    result.pixels = std::move(image.pixels);
    result.width = image.width;
    result.height = image.height;
  } catch (const Error& error) {
    CHECK(error.code() == ExitCode::file_io);
    result.refused = error.what();
  }
  return result;
}

}  // namespace eyeray::engine::test
