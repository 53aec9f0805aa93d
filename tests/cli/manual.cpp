// Man pages and completions, which are made of the options that --help prints.
#include <fmt/format.h>

#include <regex>
#include <set>
#include <sstream>
#include <string>
#include <vector>

#include "scene.hpp"
//
#include "tests/support/doctest.hpp"

using namespace eyeray::engine;
using namespace eyeray::engine::test;

namespace {

std::vector<std::string> split(const std::string& words) {
  std::istringstream stream(words);
  std::vector<std::string> all;
  for (std::string word; stream >> word;) all.push_back(word);
  return all;
}

// The names at the start of a line of --help: options, or the commands below "COMMANDs".
std::set<std::string> options_in_help(const std::string& command) {
  std::vector<std::string> arguments = split(command);
  arguments.push_back("--help");
  const std::string help = run_eyeray(arguments).out;
  static const std::regex line(R"(\n  (-[^ ]+))"), name(R"(--?[a-zA-Z][a-z-]*)");
  std::set<std::string> names;
  for (std::sregex_iterator it(help.begin(), help.end(), line), end; it != end; ++it) {
    const std::string text = (*it)[1];
    for (std::sregex_iterator word(text.begin(), text.end(), name); word != end; ++word)
      names.insert(word->str());
  }
  return names;
}

// The completions that bash offers for the last of these words.
std::set<std::string> completed_by_bash(const std::string& script, const std::vector<std::string>& words) {
  std::string line = "source " + script + "; COMP_WORDS=(";
  for (const std::string& word : words) line += "'" + word + "' ";
  line += fmt::format("); COMP_CWORD={}; _eyeray; printf '%s\\n' \"${{COMPREPLY[@]}}\"", words.size() - 1);
  const ProcessResult result = run_process({"bash", "-euc", line});
  CAPTURE(result.err);
  CHECK(result.code == 0);
  const std::vector<std::string> offered = split(result.out);
  return {offered.begin(), offered.end()};
}

const std::vector<std::string> commands = {"render",  "verify",  "compare",    "probe",           "check",
                                           "dev",     "devices", "generate",   "shaders",         "new",
                                           "kernels", "manual",  "completion", "generate terrain"};

}  // namespace

TEST_CASE("each command has a man page, which lists every option of its --help") {
  const TemporaryFolder folder;
  REQUIRE(run_eyeray({"manual", folder / "man1"}).code == 0);
  for (const std::string& command : commands) {
    CAPTURE(command);
    const std::string page =
        folder / ("man1/eyeray-" + std::regex_replace(command, std::regex(" "), "-") + ".1");
    // The page as a terminal shows it. groff warns of requests that it does not understand.
    const ProcessResult shown =
        run_process({"groff", "-man", "-Tascii", "-P-cbou", "-ww", "-rLL=200n", page});
    CHECK(shown.code == 0);
    CHECK(shown.err == "");
    const std::set<std::string> options = options_in_help(command);
    CHECK(options.size() >= 2);
    for (const std::string& option : options) {
      CAPTURE(option);
      CHECK(std::regex_search(shown.out, std::regex("(\n +|, )" + option + "[ ,\n]")));
    }
  }
  const std::string page = read_text(folder / "man1/eyeray.1");
  for (const std::string& command : commands)
    if (command.find(' ') == std::string::npos)
      CHECK(page.find(".BR eyeray\\-" + command) != std::string::npos);
}

TEST_CASE("docs/options.md is what `eyeray manual --markdown` prints, with every option of each --help") {
  const ProcessResult printed = run_eyeray({"manual", "--markdown"});
  REQUIRE(printed.code == 0);
  CHECK_MESSAGE(read_text("docs/options.md") == printed.out,
                "run: eyeray manual --markdown > docs/options.md");
  for (const std::string& command : commands) {
    CAPTURE(command);
    const size_t begin = printed.out.find("## `eyeray " + command + "`\n");
    REQUIRE(begin != std::string::npos);
    const std::string part = printed.out.substr(begin, printed.out.find("\n## ", begin) - begin);
    for (const std::string& option : options_in_help(command))
      CHECK(part.find("`" + option + "`") != std::string::npos);
  }
}

TEST_CASE("bash completes commands, options and the values that they list") {
  const TemporaryFolder folder;
  const std::string script = folder / "eyeray.bash";
  write_text(script, run_eyeray({"completion", "bash"}).out);
  using Words = std::set<std::string>;
  CHECK(completed_by_bash(script, {"eyeray", "re"}) == Words{"render"});
  CHECK(completed_by_bash(script, {"eyeray", "de"}) == Words{"dev", "devices"});
  CHECK(completed_by_bash(script, {"eyeray", "render", "--exp"}) == Words{"--exposure"});
  CHECK(completed_by_bash(script, {"eyeray", "render", "a.toml", "--tune", "ra"}) ==
        Words{"rays=packets", "rays=lanes"});
  CHECK(completed_by_bash(script, {"eyeray", "verify", "a.toml", "--integrator", "w"}) == Words{"whitted"});
  // To bash, the text beside = is a separate word.
  CHECK(completed_by_bash(script, {"eyeray", "render", "a.toml", "--tune", "rays", "="}) ==
        Words{"packets", "lanes"});
  CHECK(completed_by_bash(script, {"eyeray", "render", "a.toml", "--tune", "rays", "=", "l"}) ==
        Words{"lanes"});
  CHECK(completed_by_bash(script, {"eyeray", "render", "-o", "b"}).empty());  // bash's own: files
  CHECK(completed_by_bash(script, {"eyeray", "render", "b"}).empty());
  CHECK(completed_by_bash(script, {"eyeray", "generate", "terr"}) == Words{"terrain"});
  CHECK(completed_by_bash(script, {"eyeray", "generate", "terrain", "--tri"}) == Words{"--triangles"});
  for (const std::string& command : commands) {
    CAPTURE(command);
    std::vector<std::string> words = split("eyeray " + command);
    words.emplace_back("-");
    CHECK(completed_by_bash(script, words) == options_in_help(command));
  }
}

TEST_CASE("fish completes commands, options and values, and zsh accepts its completion file") {
  const TemporaryFolder folder;
  const std::string fish = folder / "eyeray.fish", zsh = folder / "_eyeray";
  write_text(fish, run_eyeray({"completion", "fish"}).out);
  write_text(zsh, run_eyeray({"completion", "zsh"}).out);
  const auto offered = [&](const std::string& line) {
    const Environment home = {{"HOME", folder / "home"}};
    return run_process({"fish", "--no-config", "-c", "source " + fish + "; complete -C '" + line + "'"}, home)
        .out;
  };
  CHECK(offered("eyeray re").starts_with("render\t"));
  CHECK(offered("eyeray render --exp").starts_with("--exposure\t"));
  CHECK(offered("eyeray render --tune splits=o").starts_with("splits=off"));
  CHECK(offered("eyeray generate terr").starts_with("terrain\t"));
  CHECK(offered("eyeray generate terrain --tri").starts_with("--triangles\t"));
  CHECK(offered("eyeray verify --check").empty());

  const ProcessResult parsed = run_process({"zsh", "-fnc", read_text(zsh)});
  CHECK(parsed.code == 0);
  CHECK(parsed.err == "");
  const std::string text = read_text(zsh);
  for (const std::string& command : commands) {
    CAPTURE(command);
    const std::string head = "_eyeray_" + std::regex_replace(command, std::regex(" "), "_") + "() {";
    const size_t begin = text.find(head);
    REQUIRE(begin != std::string::npos);
    const std::string function = text.substr(begin, text.find("\n}\n", begin) - begin);
    for (const std::string& option : options_in_help(command))
      CHECK(function.find("'*" + option + "[") != std::string::npos);
  }
}

TEST_CASE("completion refuses a shell other than bash, fish and zsh") {
  const ProcessResult refused = run_eyeray({"completion", "tcsh"});
  CHECK(refused.code == 2);
  CHECK(refused.err.find("tcsh") != std::string::npos);
}
