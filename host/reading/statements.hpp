// Splits TOML text into statements, without parsing them: that suffices to step over a statement that does
// not parse. Private to this layer and to those that read files of TOML.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace eyeray::engine::reading {

// The text from a line that starts with `key =` or `[table]` to the next such line. If a statement that
// starts a table does not parse, it includes the table's other statements.
struct Statement {
  size_t begin = 0;  // bytes [begin, end) of the text
  size_t end = 0;
  int line = 0;  // line of its first character that is not white space, from 1
  int column = 0;
  bool is_header = false;
  std::vector<std::string> header;  // the parts of the name of its [table]
  std::vector<std::string> key;     // the parts of its key
};

// The statement to blame for a syntax error found at `line`: the statement at that line, or the one before it
// if that one is not closed.
Statement statement_at(std::string_view text, int line);

// Overwrites the statement with spaces, so that no other statement moves.
void blank(std::string& text, const Statement& statement);

// Limit on the parts of a key; no key of a scene has more. Without a limit, a long key would make a tree so
// deep that it overflows the stack.
inline constexpr int most_key_parts = 16;

// Approximate limit on the memory of the tree of one scene's files, in units of 80 bytes. It suffices for the
// largest scene that eyeray generates, 256 MiB of numbers in lists.
struct TreeBudget {
  size_t left = size_t{1} << 25;
};

// An error text for a tree that exceeds a limit, and its position.
struct Excess {
  int line = 0;
  int column = 0;
  std::string message;
};
// The first key with more than `most_key_parts` parts, or the first position at which the tree exceeds the
// budget. The cost of the text is subtracted from the budget.
std::optional<Excess> find_excess(std::string_view text, TreeBudget& budget);

}  // namespace eyeray::engine::reading
