#include "host/scene/image_texture_file.hpp"

#include <system_error>

#include "host/core/atomic_file.hpp"
#include "host/core/error.hpp"
#include "host/image/coded_image.hpp"

namespace eyeray::engine {

namespace fs = std::filesystem;

void check_image_file(const fs::path& path) {
  const auto fail = [&](const std::string& why) {
    return Error(ExitCode::file_io, "cannot read {}: {}", path.string(), why);
  };

  // Check the kind of file before reading it: a device never ends, and a pipe without a writer never begins.
  std::error_code error;
  const fs::file_status status = fs::status(path, error);
  if (error) throw fail(error.message());
  if (fs::is_directory(status)) throw fail("it is a folder");
  if (!fs::is_regular_file(status)) throw fail("it is not a regular file");
  if (const auto size = fs::file_size(path, error); !error && size > image::most_coded_bytes)
    throw fail(fmt::format("it has {} bytes; the most is {} (1 GiB)", size, image::most_coded_bytes));
}

ImageTexture load_image_texture(const fs::path& path, image::PixelBudget& budget,
                                std::vector<std::string>& warnings) {
  check_image_file(path);
  const std::string bytes = read_file(path);
  return decode_image_texture(std::as_bytes(std::span(bytes)), path.string(), budget, warnings);
}

ImageTexture decode_image_texture(std::span<const std::byte> bytes, const std::string& name,
                                  image::PixelBudget& budget, std::vector<std::string>& warnings) {
  image::CodedImage image = image::decode_coded_image(bytes, name, budget, warnings);
  return {.name = name, .width = image.width, .height = image.height, .texels = std::move(image.pixels)};
}

}  // namespace eyeray::engine
