#include "host/loader/overrides.hpp"

#include <algorithm>
#include <charconv>
#include <optional>

#include "host/loader/former_names.hpp"
#include "host/loader/sections.hpp"
#include "host/reading/source_position.hpp"
#include "host/reading/toml_text.hpp"

namespace eyeray::engine::loader {

namespace {

// True if the text is a name or the path of a file, which needs no quotes.
bool is_word(std::string_view text) {
  const auto letter = [](char c) {
    return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || c == '_' ||
           static_cast<unsigned char>(c) >= 0x80;
  };
  const auto digit = [](char c) { return c >= '0' && c <= '9'; };
  // In quotes, these two begin something else than a character.
  const auto inner = [](char c) { return static_cast<unsigned char>(c) >= ' ' && c != '"' && c != '\\'; };
  if (text.empty() || !std::ranges::all_of(text, inner)) return false;
  if (letter(text[0]) || text[0] == '.' || text[0] == '/') return true;
  // A file's name may begin with a digit.
  const size_t dot = text.rfind('.');
  return digit(text[0]) && dot != std::string_view::npos && dot + 1 < text.size() && letter(text[dot + 1]);
}

class Assignment {
 public:
  // `at`: the position for errors in the key. `value_at`: the position of the text's value, if it is in a
  // file.
  Assignment(std::string text, SourcePosition at, SourcePosition value_at, toml::table& root,
             DiagnosticLog& log)
      : text_(std::move(text)), at_(std::move(at)), value_at_(std::move(value_at)), root_(root), log_(log) {}

  // Sets the value. Returns the parts of the key, with indices in place of the names of list elements; none
  // after an error.
  std::vector<std::string> apply() {
    if (!parse()) return {};
    toml::node* const section = enter_section();
    if (!section || !assign(*section)) return {};
    std::vector<std::string> parts;
    for (const toml::key& part : path_) parts.emplace_back(part.str());
    if (element_) parts[1] = std::to_string(*element_);
    return parts;
  }

 private:
  void fail(std::string message) { log_.error(at_, std::move(message)); }

  // Parses the text, all in one line, with its value at the value's position in the file.
  toml::table parse_in_place(const std::string& text) const {
    const size_t value = text.find('=') + 1;
    const auto lines = size_t(std::max(0, value_at_.line - 1));
    const auto columns = size_t(std::max(0, value_at_.column - 1));
    const std::string before =
        std::string(lines, '\n') + std::string(columns > value ? columns - value : 0, ' ');
    return toml::parse(before + text, value_at_.file);
  }

  // Reads KEY=VALUE as TOML, after adding quotes to a bare word.
  bool parse() {
    const size_t equals = text_.find('=');
    reading::TreeBudget budget;
    const bool one_line = text_.find('\n') == std::string::npos && !reading::find_excess(text_, budget);
    if (equals == std::string::npos || !one_line)
      return fail("write KEY=VALUE, such as render.max_depth=3"), false;
    try {
      tree_ = parse_in_place(text_);
    } catch (const toml::parse_error& error) {
      const std::string_view value = std::string_view(text_).substr(equals + 1);
      const std::string reason = "syntax: " + reading::explain_syntax(error.description());
      if (!is_word(value)) return fail(reason), false;
      try {
        tree_ = parse_in_place(fmt::format("{}=\"{}\"", text_.substr(0, equals), value));
      } catch (const toml::parse_error&) {
        return fail(reason), false;
      }
    }

    rename_former(tree_);

    // Go down the parts of the key to the value.
    toml::node* node = &tree_;
    while (node->is_table() && !node->as_table()->is_inline()) {
      if (node->as_table()->size() != 1) return fail("write KEY=VALUE, such as render.max_depth=3"), false;
      const auto entry = node->as_table()->begin();
      path_.push_back(entry->first);
      node = &entry->second;
    }
    value_ = node;
    return true;
  }

  // The table that the first one or two parts of the key name; null, with an error, if there is none.
  toml::node* enter_section() {
    const std::string_view name = path_[0].str();
    const Section* section = find_section(name);
    if (name == include_key) return fail("`include` is allowed only in a file"), nullptr;
    if (!section) return fail(fmt::format("unknown table `{}`; {}", name, suggest_section(name))), nullptr;
    next_ = section->many() ? 2 : 1;
    if (path_.size() <= next_) {
      fail(fmt::format("name the key too: {}{}.KEY=VALUE", section->name, section->many() ? ".INDEX" : ""));
      return nullptr;
    }
    toml::node* found = root_.get(section->name);
    if (!section->many()) {
      return found ? found : &root_.insert_or_assign(section->name, toml::table()).first->second;
    }
    return find_element(*section, found ? found->as_array() : nullptr);
  }

  // The element of a list of tables that the key's second part selects, by index or by its `name`.
  toml::node* find_element(const Section& section, toml::array* list) {
    const std::string_view wanted = path_[1].str();
    const size_t count = list ? list->size() : 0;
    std::vector<std::string_view> names;
    for (size_t i = 0; i < count; ++i) {
      const toml::node* name = list->get(i)->as_table()->get("name");
      if (!name || !name->is_string()) continue;
      names.push_back(name->as_string()->get());
      if (names.back() == wanted) return list->get(element_.emplace(i));
    }
    const auto index = as_index(wanted);
    if (index && *index < count) return list->get(element_.emplace(*index));

    const std::string nearest = nearest_name(wanted, names);
    if (count == 0) {
      fail(fmt::format("the scene has no {}", section.title));
    } else if (!index && !nearest.empty()) {
      fail(fmt::format("no {} is named `{}`; did you mean `{}`?", section.title, wanted, nearest));
    } else {
      fail(fmt::format("there is no {}.{}: the scene has {} {}, from 0 to {}", section.name, wanted, count,
                       section.title, count - 1));
    }
    return nullptr;
  }

  // Follows the other parts of the key, and sets the value at the last part; false after an error.
  bool assign(toml::node& section) {
    toml::node* node = &section;
    for (; next_ < path_.size(); ++next_) {
      const toml::key& part = path_[next_];
      const bool last = next_ + 1 == path_.size();
      if (toml::table* table = node->as_table()) {
        if (last) {
          table->erase(part.str());
          table->insert_or_assign(part, std::move(*value_));
          return true;
        }
        node = table->get(part.str());
        if (!node) node = &table->insert_or_assign(part, toml::table()).first->second;
      } else if (toml::array* list = node->as_array()) {
        const auto index = as_index(part.str());
        if (!index || *index >= list->size()) {
          return fail(fmt::format("`{}` has {} elements, counted from 0, so there is no element `{}`",
                                  path_[next_ - 1].str(), list->size(), part.str())),
                 false;
        }
        if (last) {
          list->replace(list->cbegin() + static_cast<std::ptrdiff_t>(*index), std::move(*value_));
          return true;
        }
        node = list->get(*index);
      } else {
        return fail(fmt::format("`{}` is a single value, so it has no `{}`", path_[next_ - 1].str(),
                                part.str())),
               false;
      }
    }
    return false;
  }

  const std::string text_;
  SourcePosition at_, value_at_;
  toml::table& root_;
  DiagnosticLog& log_;
  toml::table tree_;
  std::vector<toml::key> path_;
  size_t next_ = 0;                // the index of the first part of the path that is still to be followed
  std::optional<size_t> element_;  // index in a list of tables
  toml::node* value_ = nullptr;
};

}  // namespace

std::optional<size_t> as_index(std::string_view text) {
  size_t index = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), index);
  if (error != std::errc() || end != text.data() + text.size()) return std::nullopt;
  return index;
}

std::string as_written(const Override& change) {
  return change.written.empty() ? "-D " + change.text : change.written;
}

void apply_overrides(toml::table& root, std::span<const Override> overrides, DiagnosticLog& log) {
  for (const Override& change : overrides) {
    const std::string written = as_written(change);
    const SourcePosition at{printable(written), 0, 0};
    Assignment(change.text, at, at, root, log).apply();
  }
}

std::vector<std::string> apply_track(toml::table& root, std::string_view target, std::string_view value,
                                     const SourcePosition& at, const SourcePosition& value_at,
                                     DiagnosticLog& log) {
  return Assignment(fmt::format("{}={}", target, value), at, value_at, root, log).apply();
}

}  // namespace eyeray::engine::loader
