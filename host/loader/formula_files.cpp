#include "host/loader/formula_files.hpp"

#include "host/core/error.hpp"
#include "host/core/input_file.hpp"

namespace eyeray::engine::loader {

namespace {

constexpr size_t most_bytes = size_t{1} << 16;

}  // namespace

std::optional<formula::FormulaText> FormulaFiles::load(const std::string& name,
                                                       const SourcePosition& position) {
  try {
    const auto [path, whole] = files_.find("file", name, position);
    const bool fresh = files_.add(path);
    formula::FormulaText text{read_input_file(path, "the formula", most_bytes), {path.string(), 1, 1}};
    drop_byte_order_mark(text.text);
    if (fresh) log_.add_source(path.string(), text.text);
    return text;
  } catch (const Error& unreadable) {
    log_.error(position, unreadable.what());
    return std::nullopt;
  }
}

}  // namespace eyeray::engine::loader
