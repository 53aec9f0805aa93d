// Checks the calls of the built libraries, which no #include shows, against the document.
#include <set>
#include <sstream>

#include "host/core/process.hpp"
#include "layering.hpp"
#include "tests/support/doctest.hpp"

using namespace eyeray::engine::test;

namespace {

// The symbols of eyeray::engine that a library defines, and those that it takes from other libraries.
struct Symbols {
  std::set<std::string> defined, undefined;
};

Symbols symbols_of(const std::string& layer) {
  const eyeray::engine::ProcessResult nm =
      eyeray::engine::run_process({"nm", "-C", std::string(LIBRARY_FOLDER) + "/lib" + layer + ".a"});
  REQUIRE_MESSAGE(nm.code == 0, nm.err);
  Symbols symbols;
  std::istringstream lines(nm.out);
  for (std::string line; std::getline(lines, line);) {
    // "0000000000000040 T eyeray::…", sixteen blanks where there is no address.
    if (line.size() < 20 || line.find("eyeray::engine::") == std::string::npos) continue;
    (line[17] == 'U' ? symbols.undefined : symbols.defined).insert(line.substr(19));
  }
  return symbols;
}

// The links of a layer in a row of the table in docs/architecture.md: "image, formula".
std::map<std::string, std::string> read_document() {
  std::ifstream stream("docs/architecture.md");
  static const std::regex row(R"(\| `(\w+)` \| .* \| (.*) \|)");
  std::map<std::string, std::string> links;
  std::smatch match;
  bool in_table = false;
  for (std::string line; std::getline(stream, line);) {
    if (line.starts_with("| layer |")) in_table = true;
    if (line.empty()) in_table = false;
    if (in_table && std::regex_match(line, match, row)) links[match[1]] = match[2];
  }
  return links;
}

}  // namespace

TEST_CASE("a layer calls only what it links") {
  const std::map<std::string, Links> layers = read_layers();
  std::map<std::string, Symbols> symbols;
  for (const auto& [layer, links] : layers)
    if (!layer.ends_with("cli")) symbols[layer] = symbols_of(layer);

  size_t seen = 0;
  for (const auto& [caller, own] : symbols) {
    const std::string& layer = caller;
    for (const std::string& name : own.undefined) {
      if (own.defined.contains(name)) continue;
      bool linked = false;
      std::string owners;
      for (const auto& [other, theirs] : symbols) {
        if (!theirs.defined.contains(name)) continue;
        linked = linked || layers.at(layer).contains(other);
        owners += " " + other;
      }
      INFO(layer, " calls ", name, ", and does not link", owners);
      CHECK((linked || owners.empty()));
      ++seen;
    }
  }
  CHECK(seen > 300);
}

TEST_CASE("docs/architecture.md lists the layers as CMakeLists.txt does") {
  const std::map<std::string, Links> layers = read_layers();
  std::map<std::string, std::string> document = read_document();
  for (const auto& entry : layers) {
    const std::string& layer = entry.first;
    CAPTURE(layer);
    std::set<std::string> listed, expected;
    static const std::regex word(R"([\w/]+)");
    const std::string& row = document[layer];
    for (auto it = std::sregex_iterator(row.begin(), row.end(), word); it != std::sregex_iterator(); ++it)
      listed.insert(it->str());
    for (const std::string& link : entry.second) {
      if (link == "shader_headers") expected.insert("shaders/");
      if (layers.contains(link) && link != "core") expected.insert(link);
    }
    CHECK(listed == expected);
  }
  CHECK(document.size() == layers.size());
}
