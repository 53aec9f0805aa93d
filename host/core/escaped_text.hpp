// Escapes any text for targets such as XML, TOML or a shell: one function for each kind of target. Text for
// terminals and logs is in github_text.hpp.
#pragma once

#include <string>
#include <string_view>

namespace eyeray::engine {

// The text of an element or attribute of XML. Line breaks stay; characters not in XML become a question mark.
std::string xml_text(std::string_view text);

// A string of TOML, in quotes. Bytes that are no UTF-8 stay, and no reader of TOML accepts them.
std::string toml_string(std::string_view text);

// One word of a shell's command line, quoted where necessary. Lists of ffmpeg have the same quotes.
std::string shell_word(std::string_view word);

// JSON in which no terminal and no GitHub workflow finds a command. A parser finds the same values.
std::string harmless_json(std::string json);

// A JSON value as text: in one line, or indented by `indent`. Bytes that are no UTF-8 become U+FFFD.
template <typename Json>
std::string json_text(const Json& value, int indent = -1) {
  return harmless_json(value.dump(indent, ' ', false, Json::error_handler_t::replace));
}

}  // namespace eyeray::engine
