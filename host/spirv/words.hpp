// Iterates over the instructions of SPIR-V; for the .cpp files of this layer.
#pragma once

#include <cstdint>
#include <span>
#include <string>

#include "host/core/error.hpp"

namespace eyeray::engine::spirv {

constexpr size_t header_words = 5;

// Calls visit(opcode, instruction) for every instruction in order; instruction[0] holds opcode and length.
// Error (bad_input) when the words are not well-formed SPIR-V.
template <typename Visit>
void for_each_instruction(std::span<const uint32_t> words, const Visit& visit) {
  if (words.size() < header_words || words[0] != 0x07230203u)
    throw Error(ExitCode::bad_input, "a shader of {} words is not SPIR-V", words.size());
  for (size_t at = header_words; at < words.size();) {
    const size_t length = words[at] >> 16;
    if (length == 0 || length > words.size() - at)
      throw Error(ExitCode::bad_input, "a shader's SPIR-V breaks off at word {}", at);
    visit(words[at] & 0xffffu, words.subspan(at, length));
    at += length;
  }
}

// The string that begins at instruction[first].
inline std::string string_at(std::span<const uint32_t> instruction, size_t first) {
  std::string text;
  for (const uint32_t word : instruction.subspan(first)) {
    for (int shift = 0; shift < 32; shift += 8) {
      const char c = char(word >> shift & 0xffu);
      if (c == 0) return text;
      text += c;
    }
  }
  return text;
}

}  // namespace eyeray::engine::spirv
