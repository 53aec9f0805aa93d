// The fuzzer's test of a formula: it is refused, or it runs to an end, twice to the same bits, and has a
// kernel. The first byte chooses the use of the bytes: as a text, as damage to a text that a grammar made, or
// as the seed of a known formula, whose bits are tested too.
#include <cstdlib>
#include <cstring>

#include "host/formula/formula.hpp"
#include "tests/support/known_formula.hpp"
#include "tests/support/random_formula.hpp"

using namespace eyeray::engine;

namespace {

constexpr const char* pieces[] = {
    "(",          ")",       "[",   "]",      "{",       "}",      ";",    ",",        "?",     ":",
    "+",          "-",       "*",   "/",      "%",       "<<",     ">>",   "<",        "==",    "&&",
    "=",          "+=",      "++",  "!",      "~",       "^",      ".x",   ".zyx",     "[0]",   "[1024]",
    "0",          "7u",      "1.",  "p",      "f(p)",    "const ", "out ", "int ",     "vec3 ", "float a[3];",
    "0x7fffffff", "for(;;)", "if(", "while(", "return ", "break;", "sin(", "float[2]("};

uint64_t number_at(std::string_view bytes) {
  uint64_t number = 0;
  std::memcpy(&number, bytes.data(), std::min(bytes.size(), sizeof number));
  return number;
}

// A text made by the grammar, with a piece inserted at some position for every three bytes.
std::string damaged(std::string_view bytes) {
  std::string text = test::RandomFormula(number_at(bytes), bytes.size() % 2 == 0).text();
  for (bytes.remove_prefix(std::min(bytes.size(), sizeof(uint64_t))); bytes.size() >= 3;
       bytes.remove_prefix(3)) {
    const auto byte = [&](size_t i) { return size_t(uint8_t(bytes[i])); };
    text.insert((byte(0) + 256 * byte(1)) % (text.size() + 1), pieces[byte(2) % std::size(pieces)]);
  }
  return text;
}

template <typename T>
bool same_twice(const formula::Formula& formula, const std::array<T, 3>& p) {
  try {
    const T first = formula.value(p), second = formula.value(p);
    return std::memcmp(&first, &second, sizeof first) == 0;
  } catch (const Error& error) {
    return error.code() == ExitCode::timed_out;
  }
}

void run(const std::string& text, const uint32_t* expected) {
  try {
    const formula::Formula formula({text, {"f.glsl", 1, 1}}, {{"size", {0.5}}}, "it");
    for (const float x : {0.0f, 0.75f, -3e9f})
      if (!same_twice(formula, std::array{x, 0.5f, x}) ||
          !same_twice(formula, std::array{double(x), 0.5, 1e300}))
        std::abort();
    if (formula.kernel("k_").empty()) std::abort();
    if (expected && formula.value(std::array{-1.0f, 0.0f, 0.0f}) != float(*expected & 0xffffu)) std::abort();
    (void)formula.straight_line();
  } catch (const InputError&) {
  }
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size) {
  const std::string_view bytes(reinterpret_cast<const char*>(data), size);
  if (bytes.empty()) return 0;
  const std::string_view rest = bytes.substr(1);
  if (bytes[0] == 'k') {
    const test::KnownFormula known(number_at(rest));
    const uint32_t expected = known.expected();
    run(known.text(), known.is_float() ? nullptr : &expected);
  } else if (bytes[0] == 'g') {
    run(damaged(rest), nullptr);
  } else {
    run(std::string(bytes), nullptr);
  }
  return 0;
}
