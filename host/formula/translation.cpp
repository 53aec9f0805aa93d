#include "formula/translation.hpp"

#include <fmt/format.h>

#include <bit>
#include <charconv>

namespace eyeray::formula {

namespace {

// What is written for each token, and around it.
struct Piece {
  std::string before, text, after;
};

class Translator {
 public:
  explicit Translator(const Program& program) : program_(program), pieces_(program.tokens.size()) {
    for (size_t i = 0; i < pieces_.size(); ++i) pieces_[i].text = program.tokens[i].text;
  }

  Piece& at(size_t i) { return pieces_[i]; }

  void rename(const std::string& prefix) {
    for (size_t i = 0; i < pieces_.size(); ++i) {
      if (program_.roles[i] == Program::Role::name) pieces_[i].text = prefix + pieces_[i].text;
      if (program_.roles[i] == Program::Role::built_in) pieces_[i].text = "fn_" + pieces_[i].text;
    }
  }

  void count_turns(const std::string& turn) {
    for (const auto& [begin, end] : program_.conditions) {
      if (begin == end) {
        pieces_[begin].before += turn;
      } else {
        pieces_[begin].before = turn + " && (" + pieces_[begin].before;
        pieces_[end - 1].after += ")";
      }
    }
  }

  // Every token on its line, a space between two.
  Translation finish() const {
    Translation result;
    int line = 1, column = 1;
    const auto write = [&](const std::string& text) {
      result.text += text;
      column += int(text.size());
    };
    for (size_t i = 0; i < pieces_.size(); ++i) {
      const Token& token = program_.tokens[i];
      if (token.line == line && column > 1) write(" ");
      for (; line < token.line; ++line, column = 1) result.text += '\n';
      write(pieces_[i].before);
      result.places.push_back({line, column, token.line, token.column});
      write(pieces_[i].text);
      write(pieces_[i].after);
    }
    result.text += '\n';
    return result;
  }

 private:
  const Program& program_;
  std::vector<Piece> pieces_;
};

// As glslang reads it: by way of float64.
double value_of(const std::string& decimal) {
  double value = 0;
  const char* begin = decimal.data();
  std::from_chars(begin, begin + decimal.size(), value);
  return value;
}

// "2, 0" for "zx".
std::string components(const std::string& swizzle) {
  std::string list;
  for (const char c : swizzle) {
    size_t which = 0;
    for (const std::string_view set : {"xyzw", "rgba", "stpq"})
      if (const size_t found = set.find(c); found != std::string_view::npos) which = found;
    list += fmt::format("{}{}", list.empty() ? "" : ", ", which);
  }
  return list;
}

// C++'s way to say a type, a literal, a part of a vector.
void to_cpp(Translator& out, const Program& program) {
  for (size_t i = 0; i < program.tokens.size(); ++i) {
    const Token& token = program.tokens[i];
    std::string& text = out.at(i).text;
    if (program.roles[i] == Program::Role::type) {
      if (token.is("float")) text = "real";
      if (token.is("int")) text = "Int";
      if (token.is("uint")) text = "Uint";
      if (program.reference_types.contains(i)) text += "&";
    } else if (program.roles[i] == Program::Role::swizzle) {
      const bool one = token.text.size() == 1;
      text = one ? std::string(1, "xyzw"[components(token.text)[0] - '0'])
                 : fmt::format("{}<{}>()", program.stored_swizzles.contains(i) ? "part" : "get",
                               components(token.text));
    } else if (token.kind == Token::Kind::decimal) {
      const bool suffix = token.text.back() == 'f' || token.text.back() == 'F';
      text = fmt::format("real({})", token.text.substr(0, token.text.size() - (suffix ? 1 : 0)));
    } else if (token.kind == Token::Kind::integer && !program.sizes.contains(i)) {
      const bool natural = token.text.back() == 'u' || token.text.back() == 'U';
      text = fmt::format("{}({})", natural ? "Uint" : "Int", token.text);
    }
  }
  for (const size_t i : program.directions) out.at(i).text.clear();
  for (const auto& [brackets, size] : program.indices) {
    out.at(brackets.begin).after = fmt::format("element<{}>(", size);
    out.at(brackets.end).before = ")";
  }
  for (const auto& [begin, end] : program.lists) {
    for (size_t i = begin; i < end; ++i) out.at(i).text.clear();
    out.at(end).text = "{";
    out.at(program.partner[end]).text = "}";
  }
  // Where GLSL leaves it open what comes back, C++ must not fall out of the function.
  for (const Program::Function& function : program.functions)
    if (function.type != "void" && function.body.begin < function.body.end)
      out.at(function.body.end - 1).before += "return {}; ";
}

}  // namespace

std::string unfolded(float value) {
  return fmt::format("uintBitsToFloat(0x{:08x}u)", std::bit_cast<uint32_t>(value));
}

Translation checked_glsl(const Program& program, const std::string& prefix) {
  Translator out(program);
  out.rename(prefix);
  return out.finish();
}

Translation kernel_glsl(const Program& program, const std::string& prefix) {
  Translator out(program);
  out.rename(prefix);
  for (size_t i = 0; i < program.tokens.size(); ++i)
    if (program.tokens[i].kind == Token::Kind::decimal)
      out.at(i).text = unfolded(float(value_of(program.tokens[i].text)));
  for (const size_t i : program.float_constants) out.at(i).text.clear();
  out.count_turns("formula_turn()");
  return out.finish();
}

Translation cpp(const Program& program, const std::string& prefix) {
  Translator out(program);
  out.rename(prefix);
  to_cpp(out, program);
  out.count_turns("turn()");
  return out.finish();
}

}  // namespace eyeray::formula
