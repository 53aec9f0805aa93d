// TOML text as statements, by their looks alone: enough to step over one that does not parse. Private to the
// loader.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace eyeray::engine::loader {

// From a line that starts with `key =` or `[table]` to the next such line. A statement that starts a table
// and fails takes the table's other statements with it.
struct Statement {
  size_t begin = 0;  // bytes [begin, end) of the text
  size_t end = 0;
  int line = 0;  // of its first character that is not white space, from 1
  int column = 0;
  bool is_header = false;
  std::vector<std::string> header;  // the parts of the last [table] up to it
  std::vector<std::string> key;     // the parts of its key
};

// The statement to blame for a syntax error found at `line`: the one there, or the one before when that has
// no end.
Statement statement_at(std::string_view text, int line);

// Overwrites the statement with spaces, so that no other moves.
void blank(std::string& text, const Statement& statement);

// More parts than any key of a scene has. A tree as deep as keys can be long would overflow the stack.
inline constexpr int most_key_parts = 16;

// About how much a tree of the files of one scene may take, in units of 80 bytes: as much as that of the
// largest scene that eyeray generates, 256 MiB of numbers in lists.
struct TreeBudget {
  size_t left = size_t{1} << 25;
};

// The excess over a tree's limits, and its position.
struct Excess {
  int line = 0;
  int column = 0;
  std::string message;
};
// The first key with more parts than that, or the position from which on the tree would exceed the budget, of
// which the text is taken.
std::optional<Excess> find_excess(std::string_view text, TreeBudget& budget);

}  // namespace eyeray::engine::loader
