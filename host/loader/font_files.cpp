#include "host/loader/font_files.hpp"

#include "host/core/error.hpp"
#include "host/core/input_file.hpp"

namespace eyeray::engine::loader {

namespace {

constexpr size_t most_font_bytes = size_t{1} << 25;
constexpr size_t most_fonts = 64;

}  // namespace

std::shared_ptr<const std::string> FontFiles::load(const std::string& name, const SourcePosition& position) {
  try {
    const auto [path, whole] = files_.find("font", name, position);
    files_.add(path);
    const auto found = fonts_.find(whole);
    if (found != fonts_.end()) return found->second;
    if (fonts_.size() == most_fonts)
      throw Error(ExitCode::bad_input, "the scene names more than {} fonts", most_fonts);
    auto font = std::make_shared<const std::string>(read_input_file(path, "the font", most_font_bytes));
    fonts_.emplace(whole, font);
    return font;
  } catch (const Error& unreadable) {
    log_.error(position, unreadable.what());
    return nullptr;
  }
}

}  // namespace eyeray::engine::loader
