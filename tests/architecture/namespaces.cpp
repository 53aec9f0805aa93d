// Checks the owners of names: a folder under host/ is a namespace, and a type has one definition.
#include <map>
#include <set>

#include "layering.hpp"
#include "sources.hpp"
#include "tests/support/doctest.hpp"

using namespace eyeray::engine::test;

namespace {

// The layers that may put names directly into eyeray::engine.
const std::set<std::string> of_everyone = {"core", "scene"};
// The layers that may open eyeray::engine::shader.
const std::set<std::string> speaks_shader = {"records", "twin"};

// A line of a namespace's body, which clang-format leaves at the margin.
struct Line {
  size_t number;
  std::string scope;  // "eyeray::engine::loader", with "{}" at its end inside an unnamed namespace
  std::string text;
};

// A namespace that a file opens.
struct Opening {
  size_t line;
  std::string name;
  bool declares_only;  // nothing but forward declarations
};

const std::regex opening(R"(^(?:inline )?namespace ([\w:]*(?:inline \w+)?) ?\{$)");
const std::regex closing(R"(^\}(?:  // namespace.*)?$)");
const std::regex declaration(R"(^(?:class|struct) (\w+);.*$)");

std::vector<Opening> openings(const SourceFile& file) {
  std::vector<Opening> found;
  std::smatch match;
  for (size_t i = 0; i < file.lines.size(); ++i) {
    if (!std::regex_match(file.lines[i], match, opening) || match[1].length() == 0) continue;
    size_t end = i + 1;
    while (end < file.lines.size() && std::regex_match(file.lines[end], declaration)) ++end;
    const bool declares_only = end < file.lines.size() && std::regex_match(file.lines[end], closing);
    found.push_back({i, match[1], declares_only});
  }
  return found;
}

// The lines at the margin that are in a namespace and do not open or close one.
std::vector<Line> top_level(const SourceFile& file) {
  std::vector<Line> found;
  std::vector<std::string> scopes;
  std::smatch match;
  bool in_body = false;  // true inside of a type or a function, which ends with a brace at the margin
  for (size_t i = 0; i < file.lines.size(); ++i) {
    const std::string& line = file.lines[i];
    if (std::regex_match(line, match, opening)) {
      const std::string name = match[1].length() ? match[1].str() : "{}";
      scopes.push_back(scopes.empty() ? name : scopes.back() + "::" + name);
    } else if (in_body) {
      in_body = !line.starts_with("}");
    } else if (line.starts_with("}")) {
      if (!scopes.empty()) scopes.pop_back();
    } else if (!scopes.empty() && !line.empty() && !line.starts_with(" ")) {
      found.push_back({i, scopes.back(), line});
      in_body = code(line).find('{') != std::string::npos && code(line).find('}') == std::string::npos;
    }
  }
  return found;
}

bool in_its_own_namespace(const SourceFile& file, const std::string& name) {
  const std::string own = "eyeray::engine::" + file.layer();
  if (name == own || name.starts_with(own + "::")) return true;
  if (file.layer() == "library" && name == "eyeray::inline v0") return true;  // known to other programs
  if (of_everyone.contains(file.layer()) && (name == "eyeray::engine" || name == "eyeray::engine::detail"))
    return true;
  return speaks_shader.contains(file.layer()) && name == "eyeray::engine::shader";
}

}  // namespace

TEST_CASE("a folder under host/ is a namespace") {
  size_t seen = 0;
  for (const SourceFile& file : layer_files()) {
    for (const Opening& each : openings(file)) {
      if (!each.name.starts_with("eyeray") || each.declares_only) continue;
      ++seen;
      INFO(file.at(each.line), " opens ", each.name);
      CHECK(in_its_own_namespace(file, each.name));
    }
  }
  CHECK(seen > 300);
}

TEST_CASE("no two files define a type of one name in one namespace") {
  static const std::regex definition(
      R"(^(?:class|struct|union|enum|enum class) (\w+)(?: final)?(?: :.*)? \{.*$)");
  std::map<std::string, std::string> defined;
  std::smatch match;
  for (const SourceFile& file : layer_files()) {
    for (const Line& line : top_level(file)) {
      if (line.scope.find("{}") != std::string::npos || !std::regex_match(line.text, match, definition))
        continue;
      const std::string name = line.scope + "::" + match[1].str();
      const auto added = defined.emplace(name, file.at(line.number));
      INFO(name, " is defined in ", added.first->second, " and in ", file.at(line.number));
      CHECK(added.second);
    }
  }
  CHECK(defined.size() > 300);
  CHECK(defined.contains("eyeray::engine::loader::Batch"));
  CHECK(defined.contains("eyeray::engine::bench::Batch"));
}

TEST_CASE("a forward declaration names only types of layers that the file may include") {
  // Types that a layer only declares, because a layer above it defines them: layer, type.
  const std::set<std::pair<std::string, std::string>> handed_down = {{"scene", "Packer"}};

  // The headers that define each type.
  const std::vector<SourceFile> files = layer_files();
  static const std::regex definition(R"(^\s*(?:class|struct) (\w+)(?: final)?(?: :.*)? \{.*$)");
  std::map<std::string, std::set<std::string>> owners;
  std::smatch match;
  for (const SourceFile& file : files)
    for (const std::string& line : file.lines)
      if (std::regex_match(line, match, definition)) owners[match[1]].insert(file.layer());

  const std::map<std::string, Links> layers = read_layers();
  std::set<std::pair<std::string, std::string>> needed;
  for (const SourceFile& file : files) {
    for (const Line& line : top_level(file)) {
      if (!std::regex_match(line.text, match, declaration)) continue;
      const std::string name = match[1];
      const auto owner = owners.find(name);
      if (owner == owners.end() || owner->second.contains(file.layer())) continue;
      const bool linked = std::ranges::any_of(
          owner->second, [&](const std::string& layer) { return layers.at(file.layer()).contains(layer); });
      if (linked) continue;
      INFO(file.at(line.number), " declares ", name, ", which is of ", *owner->second.begin());
      CHECK(handed_down.contains({file.layer(), name}));
      needed.insert({file.layer(), name});
    }
  }
  CHECK(needed == handed_down);
}
