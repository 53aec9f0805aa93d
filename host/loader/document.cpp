#include "host/loader/document.hpp"

#include <algorithm>

#include "host/loader/former_names.hpp"
#include "host/loader/scene_text.hpp"
#include "host/loader/sections.hpp"
#include "host/reading/source_position.hpp"
#include "host/reading/toml_text.hpp"

namespace eyeray::engine::loader {

namespace {

namespace fs = std::filesystem;

constexpr size_t deepest_include = 16;

// Overlays `below` with `over`: the keys of `over` win, and the table's position is that of `over`.
void merge_settings(toml::table& over, toml::table& below) {
  for (auto&& [key, node] : below) {
    if (!over.contains(key.str())) over.insert_or_assign(key, std::move(node));
  }
}

// Merges the well-formed sections of `file` into `root`.
void merge(toml::table& root, toml::table& file, DiagnosticLog& log) {
  for (auto&& [key, node] : file) {
    if (key.str() == include_key) continue;
    const SourcePosition at = reading::position_of(key.source());
    const Section* section = find_section(key.str());
    if (!section) {
      const char* brackets = node.is_table() || node.is_array_of_tables() ? "table" : "key";
      log.error(at, log.full() ? "unknown"
                               : fmt::format("unknown {} `{}`; {}", brackets, key.str(),
                                             suggest_section(key.str())));
      continue;
    }

    // Merge a single table.
    toml::node* known = root.get(key.str());
    if (!section->many()) {
      if (!node.is_table()) {
        log.error(at, fmt::format("write {}, in single brackets: a scene can have only one", section->title));
        continue;
      }
      if (known) merge_settings(*node.as_table(), *known->as_table());
      root.erase(key.str());
      root.insert_or_assign(key, std::move(node));
      continue;
    }

    // Append a list of tables. A table that lacks its second brackets is read, too, to report its other
    // faults.
    if (!known) known = &root.insert_or_assign(key, toml::array()).first->second;
    if (node.is_table()) {
      log.error(at, fmt::format("write {}, in double brackets: a scene can have many", section->title));
      known->as_array()->push_back(std::move(node));
      continue;
    }
    toml::array* list = node.as_array();
    if (!list) {
      log.error(at, fmt::format("`{}` must be a table, written {}", key.str(), section->title));
      continue;
    }
    for (toml::node& element : *list) {
      if (element.is_table()) {
        known->as_array()->push_back(std::move(element));
      } else {
        log.error(reading::position_of(element.source()),
                  fmt::format("every {} must be a table", section->title));
      }
    }
  }
}

class Includer {
 public:
  Includer(Document& document, const AllowedFolders& folders, DiagnosticLog& log)
      : document_(document), folders_(folders), log_(log) {}

  // Merges the includes of `file`, then the file itself.
  void add(const fs::path& file, std::string text) {
    std::error_code error;
    chain_.push_back(fs::weakly_canonical(file, error));
    done_.push_back(chain_.back());
    document_.files.push_back(file);

    const std::string name = file.string();
    toml::table tree = reading::parse_toml(log_.add_source(name, std::move(text)), name, budget_, log_);
    rename_former(tree);
    if (const toml::node* include = tree.get(include_key)) include_all(*include, file);
    merge(document_.root, tree, log_);
    chain_.pop_back();
  }

 private:
  void include_all(const toml::node& node, const fs::path& from) {
    if (node.is_string()) return include_one(node, from);
    const toml::array* list = node.as_array();
    if (!list || std::ranges::any_of(*list, [](const toml::node& element) { return !element.is_string(); })) {
      log_.error(reading::position_of(node.source()), "`include` must be a file name or a list of them");
      return;
    }
    for (const toml::node& element : *list) include_one(element, from);
  }

  void include_one(const toml::node& node, const fs::path& from) {
    const SourcePosition at = reading::position_of(node.source());
    try {
      const auto [file, whole] = folders_.find(include_key, node.value_or(std::string()), from);
      if (std::ranges::find(chain_, whole) != chain_.end()) return log_.error(at, cycle(whole));
      if (std::ranges::find(done_, whole) != done_.end()) return;  // the file has been included already
      if (chain_.size() > deepest_include) {
        return log_.error(at, fmt::format("includes are nested more than {} deep", deepest_include));
      }
      add(file, read_scene_text(file));
    } catch (const Error& unreadable) {
      log_.error(at, unreadable.what());
    }
  }

  // The error's text "a.toml includes itself: a.toml → b.toml → a.toml".
  std::string cycle(const fs::path& again) const {
    std::string text = again.filename().string() + " includes itself: ";
    for (auto link = std::ranges::find(chain_, again); link != chain_.end(); ++link) {
      text += link->filename().string() + " → ";
    }
    return text + again.filename().string();
  }

  Document& document_;
  const AllowedFolders& folders_;
  DiagnosticLog& log_;
  reading::TreeBudget budget_;
  std::vector<fs::path> chain_;  // the files being read, from the scene down
  std::vector<fs::path> done_;
};

}  // namespace

Document read_document(const fs::path& scene, const AllowedFolders& folders, DiagnosticLog& log) {
  Document document;
  Includer(document, folders, log).add(scene, read_scene_text(scene));
  return document;
}

Document parse_document(std::string_view text, const std::string& name, DiagnosticLog& log) {
  Document document;
  reading::TreeBudget budget;
  toml::table tree = reading::parse_toml(log.add_source(name, std::string(text)), name, budget, log);
  rename_former(tree);
  if (const toml::node* include = tree.get(include_key)) {
    log.error(reading::position_of(include->source()), "only a scene in a file can include others");
  }
  merge(document.root, tree, log);
  return document;
}

}  // namespace eyeray::engine::loader
