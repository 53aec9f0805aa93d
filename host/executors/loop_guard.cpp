#include "host/executors/loop_guard.hpp"

#include <fmt/ranges.h>

#include <algorithm>
#include <cctype>
#include <optional>
#include <set>

#include "host/records/packer.hpp"

namespace eyeray::engine::executors {
namespace {

constexpr uint32_t first_bit = REFRACTED_SHIFT, bits = 32 - first_bit;
constexpr size_t most_listed = 8;

bool in_name(char c) {
  return std::isalnum(static_cast<unsigned char>(c)) || c == '_';
}

// The text with spaces in place of comments and preprocessor directives; line breaks stay.
std::string code_of(std::string_view text) {
  std::string code(text);
  const auto blank = [&](size_t begin, size_t end) {
    for (size_t i = begin; i < std::min(end, code.size()); ++i)
      if (code[i] != '\n') code[i] = ' ';
  };
  bool line_begins = true;
  for (size_t i = 0; i < code.size();) {
    size_t end = i + 1;
    if (code.compare(i, 2, "/*") == 0) {
      end = text.find("*/", i + 2);
      end = end == std::string_view::npos ? code.size() : end + 2;
      blank(i, end);
    } else if (code.compare(i, 2, "//") == 0 || (line_begins && code[i] == '#')) {
      end = std::min(text.find('\n', i), code.size());
      while (end < code.size() && code[end - 1] == '\\')
        end = std::min(text.find('\n', end + 1), code.size());
      blank(i, end);
    } else {
      line_begins = code[i] == '\n' || (line_begins && std::isspace(static_cast<unsigned char>(code[i])));
    }
    i = end;
  }
  return code;
}

// The position behind the bracket that closes the one at `open`; the end of the code if none does.
size_t behind(std::string_view code, size_t open) {
  const char closing = code[open] == '(' ? ')' : '}';
  int depth = 0;
  for (size_t i = open; i < code.size(); ++i) {
    if (code[i] == code[open]) ++depth;
    if (code[i] == closing && --depth == 0) return i + 1;
  }
  return code.size();
}

size_t skip_space(std::string_view code, size_t at) {
  return std::min(code.find_first_not_of(" \t\r\n", at), code.size());
}

// Calls visit(begin, end) for each function and any other code that ends with braces at the top level.
template <typename Visit>
void for_each_function(std::string_view code, const Visit& visit) {
  for (size_t begin = 0; begin < code.size();) {
    const size_t stop = code.find_first_of("{;", begin);
    if (stop == std::string_view::npos) return;
    const size_t end = code[stop] == '{' ? behind(code, stop) : stop + 1;
    if (code[stop] == '{') visit(skip_space(code, begin), end);
    begin = end;
  }
}

// The end of the loop whose keyword ends at `behind_keyword`.
size_t loop_end(std::string_view code, size_t behind_keyword) {
  size_t at = skip_space(code, behind_keyword);
  if (at < code.size() && code[at] == '(') at = skip_space(code, behind(code, at));
  if (at == code.size()) return at;
  return code[at] == '{' ? behind(code, at) : std::min(code.find(';', at), code.size());
}

// The condition of the loop whose header's bracket opens at `open`: its begin and end. Nothing if the header
// is incomplete.
std::optional<std::pair<size_t, size_t>> condition(std::string_view code, size_t open, bool is_for) {
  const size_t begin = open + 1, end = behind(code, open) - 1;
  if (code[end] != ')') return std::nullopt;
  if (!is_for) return std::pair(begin, end);
  std::vector<size_t> semicolons;
  int depth = 0;
  for (size_t i = begin; i < end; ++i) {
    depth += code[i] == '(' ? 1 : code[i] == ')' ? -1 : 0;
    if (depth == 0 && code[i] == ';') semicolons.push_back(i);
  }
  if (semicolons.size() != 2) return std::nullopt;
  return std::pair(semicolons[0] + 1, semicolons[1]);
}

}  // namespace

std::string LoopGuard::definitions() const {
  return fmt::format(
      "uint stopped_loops = 0u;\nuint counted_iterations = 0u;\n"
      "bool may_iterate(uint loop) {{\n  counted_iterations += 1u;\n"
      "  if (counted_iterations == {}u) stopped_loops = loop;\n  return stopped_loops == 0u;\n}}\n"
      "#define STOPPED_LOOPS stopped_loops\n",
      most_);
}

std::string LoopGuard::guard(const std::string& shown, std::string_view text, std::string_view original) {
  if (text == original) return std::string(text);
  if (std::ranges::find(files_, shown) == files_.end()) files_.push_back(shown);
  const std::string code = code_of(text), known_code = code_of(original);
  std::set<std::string_view> known;
  for_each_function(known_code, [&](size_t begin, size_t end) {
    known.insert(std::string_view(known_code).substr(begin, end - begin));
  });

  std::vector<std::pair<size_t, std::string>> insertions;
  const auto guard_loops = [&](size_t begin, size_t end) {
    if (known.contains(std::string_view(code).substr(begin, end - begin))) return;
    size_t nest_end = begin;
    uint32_t bit = 0;
    for (size_t i = begin; i < end; ++i) {
      if (!in_name(code[i])) continue;
      const size_t word_end =
          size_t(std::find_if_not(code.begin() + ptrdiff_t(i), code.end(), in_name) - code.begin());
      const std::string_view word = std::string_view(code).substr(i, word_end - i);
      if (word == "for" || word == "while" || word == "do") {
        if (i >= nest_end) {
          nest_end = loop_end(code, word_end);
          // The `while` of a `do` belongs to it.
          if (word == "do")
            nest_end = loop_end(code, skip_space(code, nest_end) + std::string_view("while").size());
          const size_t line_begin = text.rfind('\n', i) + 1;
          const std::string_view line = text.substr(line_begin, text.find('\n', i) - line_begin);
          bit = bit_of({shown, int(std::count(text.begin(), text.begin() + ptrdiff_t(i), '\n')) + 1,
                        std::string(line.substr(std::min(line.find_first_not_of(" \t"), line.size())))});
        }
        const size_t open = skip_space(code, word_end);
        const auto header =
            open < end && code[open] == '(' ? condition(code, open, word == "for") : std::nullopt;
        if (header) {
          const bool is_empty = skip_space(code, header->first) >= header->second;
          insertions.emplace_back(header->first,
                                  fmt::format("may_iterate({}u){}", bit, is_empty ? "" : " && ("));
          if (!is_empty) insertions.emplace_back(header->second, ")");
        }
      }
      i = word_end;
    }
  };
  for_each_function(code, guard_loops);

  std::string guarded;
  size_t done = 0;
  for (const auto& [at, what] : insertions) {
    guarded += text.substr(done, at - done);
    guarded += what;
    done = at;
  }
  return guarded += text.substr(done);
}

uint32_t LoopGuard::bit_of(const Loop& loop) {
  const auto found = std::ranges::find(loops_, loop);
  const auto number = uint32_t(found - loops_.begin());
  if (found == loops_.end()) loops_.push_back(loop);
  return 1u << (first_bit + number % bits);
}

std::string LoopGuard::list(uint32_t wanted) const {
  std::vector<std::string> lines;
  for (size_t i = 0; i < loops_.size(); ++i)
    if (wanted & 1u << (first_bit + i % bits))
      lines.push_back(fmt::format("{}:{}: {}", loops_[i].file, loops_[i].line, loops_[i].text));
  const size_t all = lines.size();
  if (all > most_listed) {
    lines.resize(most_listed);
    lines.push_back(fmt::format("and {} more", all - most_listed));
  }
  return fmt::format("{}", fmt::join(lines, "\n"));
}

void LoopGuard::stop(uint32_t stopped) const {
  const std::string loops = list(stopped);
  throw Error(ExitCode::timed_out,
              "a loop of your shaders did not end within {} iterations in one sample of a pixel; {}:\n{}",
              most_,
              loops.find('\n') == std::string::npos ? "it is this one, or one inside of it"
                                                    : "it is one of these, or one inside of them",
              loops);
}

void LoopGuard::check(uint32_t flags, bool ray_kinds) const {
  if (!(flags & FLAG_ENDLESS_LOOP) || !active()) return;
  constexpr uint32_t all = ~0u << first_bit;
  const uint32_t stopped = ray_kinds ? all : flags & all;
  if (!list(stopped).empty()) stop(stopped);
  throw Error(ExitCode::timed_out,
              "the driver stopped a loop after 65 535 iterations, in a kernel with your {}: look there for a "
              "loop that does not end",
              fmt::join(files_, ", "));
}

Error LoopGuard::explained(const Error& time_out) const {
  if (loops_.empty()) return time_out;
  return {ExitCode::timed_out, "{}; the loops of your shaders are:\n{}", time_out.what(), list(~0u)};
}

}  // namespace eyeray::engine::executors
