#include "host/core/escaped_text.hpp"

#include <toml++/toml.h>
#include <algorithm>
#include <array>
#include <nlohmann/json.hpp>

#include "host/core/diagnostic.hpp"
#include "host/core/github_text.hpp"
#include "host/core/process.hpp"
#include "tests/support/nasty_strings.hpp"
//
#include "tests/support/doctest.hpp"

using namespace eyeray::engine;
using namespace eyeray::engine::test;

namespace {

bool is_utf8(const std::string& text) {
  return text.find('\xff') == std::string::npos;  // the one nasty string that is not
}

}  // namespace

TEST_CASE("a shell reads an escaped word unchanged") {
  for (const char* shell : {"sh", "bash"}) {
    std::string script = "printf '%s\\n'";
    std::string words;
    for (const std::string& text : nasty_strings) {
      if (text.find('\0') != std::string::npos) continue;  // no argument holds it
      script += " " + shell_word(text);
      words += text + "\n";
    }
    for (const char* text : {"", "=ls", "~", "a b", "-x", "$HOME", "*", "a=b", "!!", "{a,b}", "#"}) {
      script += " " + shell_word(text);
      words += std::string(text) + "\n";
    }
    CHECK(run_process({shell, "-c", script}).out == words);
  }
  CHECK(shell_word("scenes/whitted.toml") == "scenes/whitted.toml");
  CHECK(shell_word("camera.fov=30") == "camera.fov=30");
}

TEST_CASE("TOML reads an escaped string unchanged, and refuses text that is not UTF-8") {
  for (const std::string& text : nasty_strings) {
    CAPTURE(text);
    const std::string document = "a = " + toml_string(text) + "\n[b]\n";
    if (!is_utf8(text)) {
      CHECK_THROWS_AS((void)toml::parse(document), toml::parse_error);
      continue;
    }
    const toml::table table = toml::parse(document);
    CHECK(table.size() == 2);
    CHECK(table["a"].value<std::string>() == text);
  }
}

TEST_CASE("JSON reads a string unchanged, and holds no command to a terminal or to GitHub's workflows") {
  for (const std::string& text : nasty_strings) {
    CAPTURE(text);
    for (const int indent : {-1, 2}) {
      const std::string json = json_text(nlohmann::json{{text, text}}, indent);
      CHECK(log_lines(json) == json);
      for (const char* hidden : {"\u202e", "\u200b", "\u061c"}) {
        CHECK(json_text(nlohmann::json(hidden + text)).find(hidden) == std::string::npos);
        CHECK(printable(hidden + text) == "?" + printable(text));
      }
      const auto read = nlohmann::json::parse(json);
      REQUIRE(read.size() == 1);
      if (is_utf8(text)) CHECK(read.at(text) == text);
    }
  }
}

TEST_CASE("escaped text adds no tag or quote to XML, and no character that XML forbids") {
  for (const std::string& text : nasty_strings) {
    CAPTURE(text);
    const std::string xml = xml_text(text);
    CHECK(xml.find_first_of("<>\"") == std::string::npos);
    for (size_t at = 0; (at = xml.find('&', at)) != std::string::npos; ++at)
      CHECK(std::ranges::any_of(std::array{"&amp;", "&lt;", "&gt;", "&quot;"}, [&](const char* entity) {
        return xml.compare(at, std::string(entity).size(), entity) == 0;
      }));
    CHECK(std::ranges::none_of(xml, [](char c) { return uint8_t(c) < 0x20 && c != '\n' && c != '\t'; }));
  }
}
