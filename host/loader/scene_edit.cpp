#include "host/loader/scene_edit.hpp"

#include <fmt/format.h>
#include <toml++/toml.h>

#include "host/core/atomic_file.hpp"
#include "host/core/error.hpp"

namespace eyeray::engine::loader {
namespace {

// The byte at which line `line` of the text begins; lines count from 1.
size_t line_start(const std::string& text, uint32_t line) {
  size_t at = 0;
  for (; line > 1; --line) at = text.find('\n', at) + 1;
  return at;
}

// The byte of a position; columns count characters from 1.
size_t byte_at(const std::string& text, const toml::source_position& position) {
  size_t at = line_start(text, position.line);
  for (uint32_t column = position.column; column > 1; --column) {
    ++at;
    while (at < text.size() && (uint8_t(text[at]) & 0xC0u) == 0x80u)
      ++at;  // the rest of a character in UTF-8
  }
  return at;
}

}  // namespace

std::string with_value(std::string text, const std::string& table, const std::string& key,
                       const std::string& value) {
  toml::table root;
  try {
    root = toml::parse(text);
  } catch (const toml::parse_error& error) {
    throw Error(ExitCode::bad_input, "{} = {} cannot be written, as the file is not a scene: {}", key, value,
                error.description());
  }
  const toml::table* const found = root[table].as_table();
  if (!found) {
    if (!text.empty() && !text.ends_with('\n')) text += '\n';
    return text + fmt::format("\n[{}]\n{} = {}\n", table, key, value);
  }
  const toml::node* const old = found->get(key);
  if (!old) {
    if (found->is_inline() || !text.substr(line_start(text, found->source().begin.line)).starts_with('['))
      throw Error(ExitCode::bad_input,
                  "write {} = {} into `{}` by hand: the table has no header on a line of its own", key, value,
                  table);
    const size_t header_end = text.find('\n', line_start(text, found->source().begin.line));
    const std::string line = fmt::format("\n{} = {}", key, value);
    return header_end == std::string::npos ? text + line + '\n' : text.insert(header_end, line);
  }

  // The value ends at a space, a comma, a brace, a comment or the end of the line.
  const size_t begin = byte_at(text, old->source().begin);
  const size_t end = std::min(text.find_first_of(" \t\r\n,}#", begin), text.size());
  return text.replace(begin, end - begin, value);
}

void set_value(const std::filesystem::path& file, const std::string& table, const std::string& key,
               const std::string& value) {
  const std::string text = with_value(read_file(file), table, key, value);
  write_file_atomically(file, text);
}

}  // namespace eyeray::engine::loader
