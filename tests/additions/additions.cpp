// Follows every docs/adding-a….md in a copy of the tree: adds the page's kind with the page's own blocks,
// builds the program, and renders and verifies the page's scene. So no page goes stale, and each kind takes
// as the page states two files and a row.
#include <fmt/format.h>

#include <algorithm>
#include <regex>
#include <vector>

#include "tests/support/doctest.hpp"
#include "tests/support/process.hpp"

using namespace eyeray::engine;
using namespace eyeray::engine::test;

namespace fs = std::filesystem;

namespace {

// A block of a page: all of a file, or a row of a list in it.
struct Block {
  std::string path;
  std::string text;
};

struct Page {
  std::string name;
  std::vector<Block> code, rows, scenes;
};

// The texts after "`path`:" and "`path`, at the end…:".
Page read_page(const fs::path& file) {
  Page page{.name = file.filename(), .code = {}, .rows = {}, .scenes = {}};
  const std::string text = read_text(file);
  static const std::regex heading(R"(`([\w/]+\.\w+)`(, at the end[^\n]*)?:\n\n(`{3,})\w+\n)");
  for (std::sregex_iterator it(text.begin(), text.end(), heading), end; it != end; ++it) {
    const auto from = size_t(it->position() + it->length());
    const Block block{(*it)[1],
                      text.substr(from, text.find(fmt::format("\n{}\n", (*it)[3].str()), from) + 1 - from)};
    const bool row = (*it)[2].matched, scene = block.path.starts_with("scenes/");
    (row ? page.rows : scene ? page.scenes : page.code).push_back(block);
  }
  return page;
}

std::vector<Page> read_pages() {
  std::vector<Page> pages;
  for (const auto& entry : fs::directory_iterator("docs"))
    if (entry.path().filename().string().starts_with("adding-a")) pages.push_back(read_page(entry.path()));
  return pages;
}

// The text with `row` added at the end of its first list, which is a macro's lines or an array.
std::string with_row(const std::string& text, const std::string& row) {
  static const std::regex macro(R"(\n  (X|R)\([^\n]*\)(?=\n(?! )))"), array(R"(\n\};\n)");
  std::smatch last;
  if (std::regex_search(text, last, macro))
    return last.prefix().str() + last.str() + " \\\n  " + row.substr(0, row.size() - 1) + last.suffix().str();
  REQUIRE(std::regex_search(text, last, array));
  return last.prefix().str() + "\n" + row + "};\n" + last.suffix().str();
}

// A copy of the program's sources, with the additions of the pages. Its build lies beside it, as the real
// tree's build does, so that ccache has all files that the pages do not change.
class Tree {
 public:
  Tree() {
    fs::remove_all(root_);
    fs::create_directories(root_);
    for (const char* part :
         {"CMakeLists.txt", "CMakePresets.json", "LICENSE", "cmake", "host", "include", "python", "shaders"})
      fs::copy(part, root_ / part, fs::copy_options::recursive);
  }

  std::string operator/(const std::string& path) const { return root_ / path; }

  void add(const Page& page) const {
    for (const auto* blocks : {&page.code, &page.scenes}) {
      for (const Block& block : *blocks) {
        CHECK_FALSE_MESSAGE(fs::exists(root_ / block.path), block.path);
        fs::create_directories((root_ / block.path).parent_path());
        write_text(root_ / block.path, block.text);
      }
    }
    for (const Block& block : page.rows) {
      REQUIRE_MESSAGE(fs::exists(root_ / block.path), block.path);
      write_text(root_ / block.path, with_row(read_text(root_ / block.path), block.text));
    }
  }

  ProcessResult build(const std::string& target) const {
    const ProcessResult configured = run_process({"cmake", "-S", root_, "--preset", "release",
                                                  "-DEYERAY_TESTS=OFF", "-DCMAKE_CXX_COMPILER=" CXX_COMPILER},
                                                 {}, 600);
    REQUIRE_MESSAGE(configured.code == 0, configured.err);
    return run_process({"cmake", "--build", build_, "-j", "2", "--target", target, "--", "--quiet"}, {},
                       7200);
  }

  ProcessResult run(std::vector<std::string> arguments) const {
    arguments.insert(arguments.begin(), build_ / "eyeray");
    return run_process(arguments, {}, 3600);
  }

 private:
  const fs::path root_ = SCRATCH_FOLDER, build_ = root_ / "build/release";
};

}  // namespace

TEST_CASE("each page on adding a kind is true: two files and a row, and its scene verifies") {
  const std::vector<Page> pages = read_pages();
  REQUIRE(pages.size() == 8);
  const Tree tree;
  for (const Page& page : pages) {
    CAPTURE(page.name);
    const bool aov = page.name == "adding-an-aov.md";
    CHECK(page.code.size() == (aov ? 0 : 2));
    CHECK(page.rows.size() == (aov ? 2 : 1));
    CHECK(page.scenes.size() == (aov ? 0 : 1));
    tree.add(page);
  }
  const ProcessResult built = tree.build("eyeray");
  REQUIRE_MESSAGE(built.code == 0, built.out);

  const std::string manual = tree.run({"check", "--manual"}).out;
  for (const Page& page : pages) {
    for (const Block& scene : page.scenes) {
      CAPTURE(scene.path);
      const ProcessResult verified = tree.run({"verify", tree / scene.path});
      CHECK_MESSAGE(verified.code == 0, verified.out, verified.err);
      const std::string kind = fs::path(scene.path).stem();
      const std::string titles[] = {fmt::format("= \"{}\"`\n", kind), fmt::format("## `[[{}]]`\n", kind),
                                    fmt::format("### `{{ {} = … }}`\n", kind)};
      CHECK(std::ranges::any_of(
          titles, [&](const std::string& title) { return manual.find(title) != std::string::npos; }));
    }
  }
  const Page& any = *std::ranges::find_if(pages, [](const Page& page) { return !page.scenes.empty(); });
  const ProcessResult seen =
      tree.run({"render", tree / any.scenes[0].path, "--backend", "twin", "-s", "32x24", "--aov",
                "height,clipped", "-o", tree / "seen.png", "--quiet"});
  CHECK_MESSAGE(seen.code == 0, seen.err);
  for (const char* aov : {"height", "clipped"}) CHECK(fs::exists(tree / fmt::format("seen.{}.pfm", aov)));

  // If a kind's shader or C++ file is missing, the build fails with an error that names it.
  for (const Page& page : pages) {
    for (const Block& half : page.code) {
      CAPTURE(half.path);
      fs::remove(tree / half.path);
      const ProcessResult failed = tree.build(half.path.ends_with(".glsl") ? "twin" : "eyeray");
      CHECK(failed.code != 0);
      CHECK(failed.out.find(fs::path(half.path).stem()) != std::string::npos);
      write_text(tree / half.path, half.text);
    }
  }
}
