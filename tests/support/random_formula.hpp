// Random formulas from a grammar of their parts: arrays, indices, loops, calls, shadowing, odd literals.
#pragma once

#include <fmt/format.h>

#include <string>
#include <vector>

#include "tests/support/random.hpp"

namespace eyeray::engine::test {

class RandomFormula {
 public:
  // `tame`: the formula has nothing that GLSL leaves undefined, and only operations that every compiler
  // computes to the same bits.
  RandomFormula(uint64_t seed, bool tame) : random_(seed), tame_(tame) {}

  std::string text() {
    std::string all;
    if (one_in(3)) all += "const float K[3] = float[3](0.5, -2.0, 1.25);\nconst int SEVEN = 7;\n";
    has_constants_ = !all.empty();
    for (int i = random_.below(4); i > 0; --i) all += function();
    scopes_ = {{{"vec3", "p", 0}}};
    if (has_constants_) scopes_[0].push_back({"int", "SEVEN", -1});
    returns_ = "float";
    all += "float f(vec3 p) {\n" + statements(3 + random_.below(6)) + "  return " + expression("float", 3) +
           ";\n}\n";
    return all;
  }

 private:
  struct Variable {
    std::string type, name;
    int length;  // length of an array; 0: not an array; -1: a constant
  };
  struct Function {
    std::string type, name;
    std::vector<std::pair<std::string, std::string>> parameters;  // direction, type
  };

  bool one_in(int n) { return random_.below(n) == 0; }
  template <size_t n>
  std::string pick(const char* const (&list)[n]) {
    return list[random_.below(int(n))];
  }
  static int size(const std::string& type) { return type.starts_with("vec") ? type[3] - '0' : 1; }
  static bool whole(const std::string& type) { return type == "int" || type == "uint"; }
  std::string type() {
    static constexpr const char* types[] = {"float", "float", "float", "vec2", "vec3",
                                            "vec4",  "int",   "int",   "uint", "bool"};
    return pick(types);
  }
  std::string name() {
    return fmt::format("{}{}", "abcdefgh"[random_.below(8)], one_in(3) ? "" : std::to_string(names_++));
  }

  std::string literal(const std::string& type) {
    if (type == "bool") return one_in(2) ? "true" : "false";
    if (type == "int") {
      static constexpr const char* odd[] = {"2147483647", "0x7f", "017", "(-2147483647 - 1)", "0xffffffff"};
      return !tame_ && one_in(6) ? pick(odd) : std::to_string(random_.below(9) - 2);
    }
    if (type == "uint") {
      static constexpr const char* odd[] = {"4294967295u", "0xdeadbeefu", "031u"};
      return !tame_ && one_in(4) ? pick(odd) : std::to_string(random_.below(7)) + "u";
    }
    static constexpr const char* odd[] = {"1e-40", "3.4e38", "1e30", ".5",
                                          "2.",    "1e-10f", "0.1",  "16777217.0"};
    static constexpr const char* plain[] = {"0.0", "1.0", "-1.0", "0.5", "2.0", "-0.25", "3.0", "0.1", ".75"};
    return !tame_ && one_in(6) ? pick(odd) : pick(plain);
  }

  // A variable of the type, or an element or part of one; "" where there is none. `stored`: the variable can
  // be written to.
  std::string variable(const std::string& type, bool stored, int depth) {
    std::vector<std::string> found;
    for (size_t scope = 0; scope < scopes_.size(); ++scope) {
      for (const Variable& v : scopes_[scope]) {
        if (shadowed(scope, v.name) || (stored && v.length < 0)) continue;
        if (v.length > 0) {
          if (v.type == type)
            found.push_back(fmt::format("{}[{}]", v.name, index(v.length, depth)));
          else if (type == "float" && size(v.type) > 1)
            found.push_back(fmt::format("{}[{}].{}", v.name, index(v.length, depth),
                                        "xyzw"[random_.below(size(v.type))]));
          continue;
        }
        if (v.type == type) found.push_back(v.name);
        if (size(v.type) == 1) continue;
        if (type == "float" && one_in(2))
          found.push_back(fmt::format("{}[{}]", v.name, index(size(v.type), depth)));
        const std::string part = swizzle(size(v.type), size(type), stored);
        if ((type == "float" || type.starts_with("vec")) && !part.empty())
          found.push_back(v.name + "." + part);
      }
    }
    return found.empty() ? "" : found[size_t(random_.below(int(found.size())))];
  }
  bool shadowed(size_t scope, const std::string& name) const {
    for (size_t inner = scope + 1; inner < scopes_.size(); ++inner)
      for (const Variable& v : scopes_[inner])
        if (v.name == name) return true;
    return false;
  }
  // A swizzle of `count` letters for a vector of `of` components; "" if the letters must be distinct and the
  // vector has too few.
  std::string swizzle(int of, int count, bool distinct) {
    if (distinct && count > of) return "";
    std::string letters = std::string("xyzw").substr(0, size_t(of)), result;
    for (int i = 0; i < count; ++i) {
      const auto at = size_t(random_.below(int(letters.size())));
      result += letters[at];
      if (distinct) letters.erase(at, 1);
    }
    return result;
  }
  std::string index(int length, int depth) {
    if (depth <= 0 || one_in(3)) return std::to_string(random_.below(length));
    const std::string wild = expression("int", depth - 1);
    return tame_ ? fmt::format("clamp({}, 0, {})", wild, length - 1) : wild;
  }

  std::string expression(const std::string& type, int depth) {
    if (depth <= 0 || one_in(5)) {
      const std::string v = one_in(4) ? "" : variable(type, false, depth - 1);
      return !v.empty()                ? v
             : type.starts_with("vec") ? fmt::format("{}({})", type, literal("float"))
                                       : literal(type);
    }
    const auto e = [&](const std::string& t) { return expression(t, depth - 1); };
    if (one_in(6)) return fmt::format("({} ? {} : {})", e("bool"), e(type), e(type));
    for (const Function& f : functions_)
      if (f.type == type && one_in(4)) return call(f, depth - 1);
    if (type == "bool") {
      switch (random_.below(5)) {
        case 0:
          return fmt::format("({} {} {})", e("float"), one_in(2) ? "<" : ">=", e("float"));
        case 1:
          return fmt::format("({} {} {})", e("int"), one_in(2) ? "<" : "!=", e("int"));
        case 2:
          return fmt::format("({} {} {})", e("bool"), one_in(3) ? "^^" : one_in(2) ? "&&" : "||", e("bool"));
        case 3:
          return fmt::format("!{}", e("bool"));
        default:
          return fmt::format("({} == {})", e("vec2"), e("vec2"));
      }
    }
    if (whole(type)) {
      const std::string suffix = type == "uint" ? "u" : "";
      switch (random_.below(tame_ ? 5 : 8)) {
        case 0:
          return fmt::format("({} + {})", e(type), e(type));
        case 1:
          return fmt::format("({} * {})", e(type), e(type));
        case 2:
          return fmt::format("({} {} {})", e(type), one_in(3) ? "^" : one_in(2) ? "&" : "|", e(type));
        case 3:
          return fmt::format("({} {} {}{})", e(type), one_in(2) ? "<<" : ">>",
                             tame_ ? random_.below(32) : random_.below(80) - 20, suffix);
        case 4:
          return type == "int" && tame_ ? fmt::format("int({})", e("uint"))
                 : type == "int"        ? fmt::format("int({})", e("float"))
                                        : fmt::format("uint({})", e("int"));
        case 5:
          return fmt::format("({} {} {})", e(type), one_in(2) ? "/" : "%", e(type));
        case 6:
          return fmt::format("{}({})", type, e("float"));
        default:
          return fmt::format("({} << {})", e(type), e(type));
      }
    }
    const int n = size(type);
    switch (random_.below(tame_ ? 5 : 9)) {
      case 0:
        return fmt::format("({} + {})", e(type), e(type));
      case 1:
        return fmt::format("({} * {})", e(type), e(type));
      case 2:
        return fmt::format("({} - {})", e(type), n > 1 && one_in(2) ? e("float") : e(type));
      case 3:
        return fmt::format("-({})", e(type));
      case 4:
        if (n == 1)
          return one_in(2)        ? fmt::format("float({})", e("int"))
                 : has_constants_ ? fmt::format("K[{}]", index(3, depth - 1))
                                  : e(type);
        return n == 2   ? fmt::format("vec2({}, {})", e("float"), e("float"))
               : n == 3 ? fmt::format("vec3({}, {})", e("vec2"), e("float"))
                        : fmt::format("vec4({}, {})", e("float"), e("vec3"));
      case 5:
        return fmt::format("({} / {})", e(type), e(type));
      case 6: {
        static constexpr const char* one[] = {"abs",  "sign", "floor", "ceil",    "fract",   "trunc",
                                              "sqrt", "sin",  "cos",   "tan",     "asin",    "acos",
                                              "atan", "exp",  "log",   "exp2",    "log2",    "inversesqrt",
                                              "sinh", "cosh", "tanh",  "radians", "degrees", "round"};
        return fmt::format("{}({})", pick(one), e(type));
      }
      case 7: {
        static constexpr const char* two[] = {"min", "max", "mod", "pow", "atan", "step"};
        return fmt::format("{}({}, {})", pick(two), e(type), e(type));
      }
      default:
        if (n == 1)
          return one_in(2)   ? fmt::format("length({})", e("vec3"))
                 : one_in(2) ? fmt::format("dot({}, {})", e("vec3"), e("vec3"))
                             : fmt::format("distance({}, {})", e("vec2"), e("vec2"));
        return n == 3 && one_in(2) ? fmt::format("cross({}, {})", e(type), e(type))
               : one_in(2)         ? fmt::format("normalize({})", e(type))
               : one_in(2)         ? fmt::format("mix({}, {}, {})", e(type), e(type), e("float"))
                                   : fmt::format("clamp({}, {}, {})", e(type), e("float"), e("float"));
    }
  }

  std::string call(const Function& f, int depth) {
    std::string arguments;
    for (const auto& [direction, type] : f.parameters) {
      std::string argument = direction.empty() ? expression(type, depth) : variable(type, true, 0);
      if (argument.empty()) return literal_of(f.type);
      arguments += (arguments.empty() ? "" : ", ") + argument;
    }
    return fmt::format("{}({})", f.name, arguments);
  }
  std::string literal_of(const std::string& type) {
    return type.starts_with("vec") ? fmt::format("{}({})", type, literal("float")) : literal(type);
  }

  std::string function() {
    Function f{type(), fmt::format("g{}", functions_.size()), {}};
    scopes_ = {{}};
    std::string parameters = "float q";
    f.parameters.push_back({"", "float"});
    scopes_[0].push_back({"float", "q", 0});
    for (int i = random_.below(3); i > 0; --i) {
      const std::string direction = one_in(2) ? "" : "inout ", t = type(), n = fmt::format("q{}", i);
      parameters += fmt::format(", {}{} {}", direction, t, n);
      f.parameters.push_back({direction, t});
      scopes_[0].push_back({t, n, 0});
    }
    returns_ = f.type;
    const std::string body = statements(1 + random_.below(4));
    const std::string text = fmt::format("{} {}({}) {{\n{}  return {};\n}}\n", f.type, f.name, parameters,
                                         body, expression(f.type, 2));
    functions_.push_back(f);
    return text;
  }

  std::string statements(int count) {
    std::string text;
    for (int i = 0; i < count; ++i) text += statement();
    return text;
  }
  std::string block(int count) {
    scopes_.push_back({});
    const std::string text = "{\n" + statements(count) + "}\n";
    scopes_.pop_back();
    return text;
  }
  std::string declaration() {
    std::string n = name();
    for (const Variable& v : scopes_.back())
      if (v.name == n) n = fmt::format("z{}", names_++);
    const std::string t = type();
    if (one_in(4)) {
      const int length = 1 + random_.below(5);
      std::string text = fmt::format("{} {}[{}]", t, n, length), list;
      for (int i = 0; i < length; ++i) list += (i ? ", " : "") + literal_of(t);
      if (tame_ || one_in(2)) text += fmt::format(" = {}[{}]({})", t, length, list);
      scopes_.back().push_back({t, n, length});
      return text + ";\n";
    }
    const std::string value = tame_ || !one_in(4) ? " = " + expression(t, 3) : "";
    scopes_.back().push_back({t, n, 0});
    return fmt::format("{} {}{};\n", t, n, value);
  }
  std::string statement() {
    const bool deep = scopes_.size() > 4;
    switch (random_.below(deep ? 5 : 9)) {
      case 0:
      case 1:
        return declaration();
      case 2:
      case 3: {
        const std::string t = type(), v = variable(t, true, 2);
        if (v.empty()) return declaration();
        static constexpr const char* signs[] = {"=", "=", "+=", "-=", "*="};
        if (whole(t) && one_in(3))
          return fmt::format("{} {} {};\n", v, tame_ ? "^=" : one_in(2) ? "<<=" : "%=", expression(t, 2));
        if (t != "bool" && one_in(6)) return v + (one_in(2) ? "++;\n" : "--;\n");
        return fmt::format("{} {} {};\n", v, t == "bool" ? "=" : pick(signs), expression(t, 3));
      }
      case 4: {
        for (const Function& f : functions_)
          if (one_in(2)) return call(f, 2) + ";\n";
        return array_statement();
      }
      case 5:
        return fmt::format("if ({}) {}", expression("bool", 2), block(1 + random_.below(3))) +
               (one_in(2) ? "else " + block(1 + random_.below(2)) : "");
      case 6: {
        const std::string i = fmt::format("i{}", names_++);
        scopes_.push_back({{"int", i, tame_ ? -1 : 0}});
        ++loops_;
        std::string body = block(1 + random_.below(3));
        --loops_;
        scopes_.pop_back();
        return fmt::format("for (int {0} = {1}; {0} {2} {3}; {0}{4}) {5}", i, random_.below(3),
                           one_in(4) ? "<=" : "<", random_.below(6), one_in(4) ? " += 2" : "++", body);
      }
      case 7: {
        const std::string i = fmt::format("w{}", names_++);
        ++loops_;
        std::string body = block(1 + random_.below(2));
        --loops_;
        return fmt::format("int {0} = 0;\nwhile ({0} < {1} && {2}) {{\n{0}++;\n{3}}}\n", i, random_.below(6),
                           expression("bool", 1), body);
      }
      default:
        if (loops_ > 0)
          return fmt::format("if ({}) {};\n", expression("bool", 2), one_in(2) ? "break" : "continue");
        return fmt::format("if ({}) return {};\n", expression("bool", 2), expression(returns_, 2));
    }
  }
  // A statement that assigns or compares a whole array.
  std::string array_statement() {
    for (const auto& scope : scopes_)
      for (const Variable& a : scope)
        for (const Variable& b : scope)
          if (a.length > 0 && a.length == b.length && a.type == b.type && a.name != b.name &&
              !shadowed(size_t(&scope - scopes_.data()), a.name) &&
              !shadowed(size_t(&scope - scopes_.data()), b.name))
            return one_in(2) ? fmt::format("{} = {};\n", a.name, b.name)
                             : fmt::format("if ({} == {}) {}", a.name, b.name, block(1));
    return declaration();
  }

  Random random_;
  bool tame_;
  bool has_constants_ = false;
  int names_ = 0, loops_ = 0;
  std::string returns_ = "float";
  std::vector<std::vector<Variable>> scopes_;
  std::vector<Function> functions_;
};

}  // namespace eyeray::engine::test
