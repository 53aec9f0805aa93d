// Texts that tests compare with files, so that a review shows how a change changes them.
#pragma once

#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <string>

#include "tests/support/doctest.hpp"
#include "tests/support/process.hpp"

namespace eyeray::engine::test {

// Fails if `text` differs from the file's text, and shows the first line that differs. `scripts/test --bless`
// writes the files anew instead.
inline void check_snapshot(const std::string& file, const std::string& text) {
  if (std::getenv("EYERAY_BLESS")) {
    std::filesystem::create_directories(std::filesystem::path(file).parent_path());
    return write_text(file, text);
  }
  REQUIRE_MESSAGE(std::filesystem::exists(file), file, " is missing: scripts/test --bless writes it");
  const std::string kept = read_text(file);
  if (text == kept) return;
  size_t same = 0;
  while (same < std::min(text.size(), kept.size()) && text[same] == kept[same]) ++same;
  const auto line_of = [same](const std::string& all) {
    const size_t begin = same == 0 ? 0 : all.rfind('\n', same - 1) + 1;
    return all.substr(begin, all.find('\n', begin) - begin);
  };
  const auto number = 1 + std::count(text.begin(), text.begin() + std::ptrdiff_t(same), '\n');
  FAIL_CHECK(file, ":", number, " was\n  ", line_of(kept), "\nand is\n  ", line_of(text),
             "\nIf that is meant, scripts/test --bless writes it there.");
}

}  // namespace eyeray::engine::test
