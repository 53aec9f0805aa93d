// Parts of a picture, as the tests name and render them.
#pragma once

#include <fmt/format.h>

#include "scene.hpp"
#include "tests/support/doctest.hpp"

namespace eyeray::engine::test {

using Words = std::vector<std::string>;

inline Words operator+(Words words, const Words& more) {
  words.insert(words.end(), more.begin(), more.end());
  return words;
}

inline std::string part_of(const SceneFolder& folder, int index, int count) {
  return folder / fmt::format("part.{}-of-{}.eyeray", index, count);
}

inline Words all_parts(const SceneFolder& folder, int count) {
  Words parts;
  // In reverse order.
  for (int i = count; i > 0; --i) parts.push_back(part_of(folder, i, count));
  return parts;
}

// The words that make a command render one part.
inline Words words_of_part(const SceneFolder& folder, int index, int count) {
  return {"--shard", fmt::format("{}/{}", index, count), "-o", part_of(folder, index, count)};
}

inline void render_part(const SceneFolder& folder, const Words& picture, int index, int count,
                        const Environment& environment = {}) {
  const ProcessResult result = run_eyeray(picture + words_of_part(folder, index, count), environment);
  CAPTURE(result.err);
  REQUIRE(result.code == 0);
}

}  // namespace eyeray::engine::test
