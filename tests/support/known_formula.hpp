// Random formulas with their results, computed here in float32 and in 32 bits by the rules of
// docs/formulas.md alone: no code of eyeray reads these texts for that.
#pragma once

#include <fmt/format.h>

#include <cmath>
#include <cstdint>
#include <cstring>
#include <limits>
#include <string>
#include <vector>

#include "tests/support/random.hpp"

namespace eyeray::engine::test {

class KnownFormula {
 public:
  explicit KnownFormula(uint64_t seed) : random_(seed) {
    for (int i = random_.below(4); i > 0; --i) constants_ += declaration("const ", globals_);
    std::string body = "  float zero = p.z;\n";
    known_ = &locals_;
    for (int i = 1 + random_.below(4); i > 0; --i) {
      const bool is_const = one_in(2);
      body += "  " + declaration(is_const ? "const " : "", locals_);
      if (is_const || one_in(3)) continue;
      const Known changed = expression(locals_.back().type, 2);
      body += fmt::format("  {} = {};\n", locals_.back().text, changed.text);
      locals_.back().bits = changed.bits;
    }
    const Known result = expression(type(), 4);
    expected_ = result.bits;
    const std::string word = result.type == 'f'   ? "word"
                             : result.type == 'b' ? "(word ? 1u : 0u)"
                                                  : "uint(word)";
    text_ = fmt::format(
        "{}float f(vec3 p) {{\n{}  {} word = {};\n  return {};\n}}\n", constants_, body, name_of(result.type),
        result.text,
        result.type == 'f' ? word : fmt::format("p.x > 0.0 ? float({0} >> 16) : float({0} & 65535u)", word));
    is_float_ = result.type == 'f';
  }

  const std::string& text() const { return text_; }
  // The result of f(p) for p.z = 0: the result itself if it is a float. Otherwise its upper half if p.x is
  // positive, else its lower half.
  bool is_float() const { return is_float_; }
  uint32_t expected() const { return expected_; }

 private:
  struct Known {
    char type;  // f, i, u, b
    std::string text;
    uint32_t bits;  // bits of a float; or a whole number; or 0 or 1
  };

  bool one_in(int n) { return random_.below(n) == 0; }
  char type() { return "ffiiub"[random_.below(6)]; }
  static std::string name_of(char type) {
    return type == 'f' ? "float" : type == 'i' ? "int" : type == 'u' ? "uint" : "bool";
  }
  static uint32_t bits(float value) {
    uint32_t result;
    std::memcpy(&result, &value, sizeof result);
    return result;
  }
  static float real(uint32_t bits) {
    float result;
    std::memcpy(&result, &bits, sizeof result);
    return result;
  }
  static int64_t whole(const Known& k) { return k.type == 'i' ? int64_t(int32_t(k.bits)) : int64_t(k.bits); }

  std::string declaration(const std::string& qualifier, std::vector<Known>& into) {
    const Known value = expression(type(), 3);
    const std::string name = fmt::format("{}{}", &into == &globals_ ? 'K' : 'v', into.size());
    into.push_back({value.type, name, value.bits});
    return fmt::format("{}{} {} = {};\n", qualifier, name_of(value.type), name, value.text);
  }

  Known leaf(char type) {
    std::vector<Known> named;
    for (const std::vector<Known>* list : {static_cast<const std::vector<Known>*>(&globals_), known_})
      if (list)
        for (const Known& known : *list)
          if (known.type == type) named.push_back(known);
    if (!named.empty() && one_in(2)) return named[size_t(random_.below(int(named.size())))];
    Known known{type, "", 0};
    switch (type) {
      case 'f': {
        static constexpr std::pair<const char*, float> list[] = {{"0.1", 0.1f},
                                                                 {"3.0", 3.0f},
                                                                 {"0.7", 0.7f},
                                                                 {"16777217.0", 16777216.0f},
                                                                 {"1e-3", 1e-3f},
                                                                 {".5", 0.5f},
                                                                 {"3.14159265", 3.1415927f},
                                                                 {"2.f", 2.0f},
                                                                 {"33.3", 33.3f},
                                                                 {"0.0", 0.0f}};
        const auto& [text, value] = list[random_.below(10)];
        known = {type, text, bits(value)};
        if (known_ && one_in(4)) known.text = fmt::format("({} + zero)", known.text);
        return known;
      }
      case 'b':
        known.bits = uint32_t(one_in(2));
        known.text = known.bits ? "true" : "false";
        return known;
      default: {
        static constexpr std::pair<const char*, uint32_t> list[] = {{"0", 0},
                                                                    {"1", 1},
                                                                    {"2", 2},
                                                                    {"7", 7},
                                                                    {"31", 31},
                                                                    {"33", 33},
                                                                    {"2147483647", 2147483647u},
                                                                    {"0x7ff", 2047},
                                                                    {"017", 15},
                                                                    {"16777217", 16777217u}};
        const auto& [text, value] = list[random_.below(10)];
        known = {type, text + std::string(type == 'u' ? "u" : ""), value};
        if (known_ && one_in(4)) known.text = fmt::format("({} + {}(zero))", known.text, name_of(type));
        return known;
      }
    }
  }

  Known expression(char type, int depth) {
    if (depth == 0 || one_in(6)) return leaf(type);
    const Known result = operation(type, depth - 1);
    // Results that are not finite, or that machines may flush to 0, are not tested.
    if (type == 'f' && !(result.bits << 1 == 0 || std::isnormal(real(result.bits)))) return leaf(type);
    return result;
  }

  Known operation(char type, int depth) {
    const auto e = [&](char of) { return expression(of, depth); };
    if (one_in(6)) {
      const Known c = e('b'), x = e(type), y = e(type);
      return {type, fmt::format("({} ? {} : {})", c.text, x.text, y.text), c.bits ? x.bits : y.bits};
    }
    return type == 'f'   ? float_operation(e('f'), e('f'), e(one_in(2) ? 'i' : 'u'))
           : type == 'b' ? truth(e('f'), e('f'), e(one_in(2) ? 'i' : 'u'), e('b'), e('b'))
                         : whole_operation(type, e(type), e(type), e('f'), e(type == 'i' ? 'u' : 'i'));
  }

  Known float_operation(const Known& a, const Known& b, const Known& w) {
    const float x = real(a.bits), y = real(b.bits);
    const auto infix = [&](char sign, float value) {
      return Known{'f', fmt::format("({} {} {})", a.text, sign, b.text), bits(value)};
    };
    const auto of_one = [&](const char* name, float value) {
      return Known{'f', fmt::format("{}({})", name, a.text), bits(value)};
    };
    const auto of_two = [&](const char* name, float value) {
      return Known{'f', fmt::format("{}({}, {})", name, a.text, b.text), bits(value)};
    };
    switch (random_.below(12)) {
      case 0:
      case 1:
        return infix('+', x + y);
      case 2:
        return infix('-', x - y);
      case 3:
      case 4:
        return infix('*', x * y);
      case 5:
        return infix('/', x / y);
      case 6:
        return of_one("-", -x);
      case 7:
        return of_one("abs", std::fabs(x));
      case 8:
        return of_one("floor", std::floor(x));
      case 9:
        return one_in(2) ? of_one("sqrt", std::sqrt(x)) : of_one("trunc", std::trunc(x));
      case 10:
        return one_in(2) ? of_two("max", x < y ? y : x) : of_two("step", y < x ? 0.0f : 1.0f);
      default:
        return {'f', fmt::format("float({})", w.text),
                bits(w.type == 'i' ? float(int32_t(w.bits)) : float(w.bits))};
    }
  }

  Known truth(const Known& a, const Known& b, const Known& w, const Known& c, const Known& d) {
    const float x = real(a.bits), y = real(b.bits);
    switch (random_.below(7)) {
      case 0:
        return {'b', fmt::format("({} < {})", a.text, b.text), x < y};
      case 1:
        return {'b', fmt::format("({} >= {})", a.text, b.text), x >= y};
      case 2:
        return {'b', fmt::format("({} == {} * 1.0)", a.text, b.text), x == y};
      case 3:
        return {'b', fmt::format("({} && {})", c.text, d.text), c.bits & d.bits};
      case 4:
        return {'b', fmt::format("({} ^^ {})", c.text, d.text), c.bits ^ d.bits};
      case 5:
        return {'b', fmt::format("!{}", c.text), c.bits ^ 1u};
      default:
        return {'b', fmt::format("({} > {})", w.text, w.type == 'u' ? "7u" : "7"), whole(w) > 7};
    }
  }

  Known whole_operation(char type, const Known& a, const Known& b, const Known& f, const Known& other) {
    const bool is_signed = type == 'i';
    const int64_t x = whole(a), y = whole(b);
    const auto infix = [&](const char* sign, uint32_t value) {
      return Known{type, fmt::format("({} {} {})", a.text, sign, b.text), value};
    };
    switch (random_.below(12)) {
      case 0:
        return infix("+", uint32_t(x + y));
      case 1:
        return infix("-", uint32_t(x - y));
      case 2:
        return infix("*", a.bits * b.bits);
      case 3:
        return infix("/", y == 0 ? 0 : uint32_t(x / y));
      case 4: {
        // The remainder has the sign of y.
        const int64_t rest = y == 0 ? 0 : x % y;
        return infix("%", uint32_t(rest != 0 && (rest < 0) != (y < 0) ? rest + y : rest));
      }
      case 5:
        return infix("&", a.bits & b.bits);
      case 6:
        return infix("^", a.bits ^ b.bits);
      case 7:
        return infix("<<", a.bits << (b.bits & 31u));
      case 8:
        return infix(">>", is_signed ? uint32_t(x >> (b.bits & 31u)) : a.bits >> (b.bits & 31u));
      case 9:
        return {type, fmt::format("(- {})", a.text), 0u - a.bits};
      case 10: {
        const double value = double(real(f.bits));
        const uint32_t converted =
            is_signed
                ? value >= -2147483648.0 && value < 2147483648.0 ? uint32_t(int32_t(value)) : 0x80000000u
            : value >= 0 && value < 4294967296.0 ? uint32_t(value)
                                                 : 0u;
        return {type, fmt::format("{}({})", name_of(type), f.text), converted};
      }
      default:
        return {type, fmt::format("{}({})", name_of(type), other.text), other.bits};
    }
  }

  Random random_;
  std::vector<Known> globals_, locals_;
  const std::vector<Known>* known_ = nullptr;  // the local variables, where they may be used
  std::string constants_, text_;
  bool is_float_ = false;
  uint32_t expected_ = 0;
};

}  // namespace eyeray::engine::test
