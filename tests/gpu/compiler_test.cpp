#include <sys/stat.h>

#include "host/gpu/kernel_compiler.hpp"
#include "support.hpp"
#include "tests/support/process.hpp"

using namespace eyeray::engine;
using namespace eyeray::engine::test;

namespace {

const std::string head = "#version 450\nlayout(local_size_x = 1) in;\n";

// The compiler's diagnostics of `texts`, whose entry is "main.comp.glsl".
std::vector<Diagnostic> diagnose(const std::map<std::string, std::string>& texts,
                                 const std::string& preamble = "") {
  try {
    gpu::compile_shader(gpu::read_shader(files(texts), "main.comp.glsl"), preamble);
  } catch (const InputError& error) {
    CHECK(error.code() == ExitCode::bad_input);
    return error.diagnostics();
  }
  return {};
}

std::string format(const Diagnostic& d) {
  return fmt::format("{}:{}:{}: {}", d.position.file, d.position.line, d.position.column, d.message);
}

}  // namespace

TEST_CASE("all errors are reported at once, each with file, line, column and the line's text") {
  const auto found =
      diagnose({{"main.comp.glsl",
                 head + "#include \"lib/half.glsl\"\nvoid main() {\n  int a = foo;\n  halve(1.0);\n}\n"},
                {"lib/half.glsl", "float halve(float x) {\n  return barfoo + bar;\n}\n"}});
  REQUIRE(found.size() >= 3);
  CHECK(format(found[0]) == "lib/half.glsl:2:10: 'barfoo': undeclared identifier");
  CHECK(found[0].source_line == "  return barfoo + bar;");
  CHECK(format(found[1]) ==
        "lib/half.glsl:2:19: 'bar': undeclared identifier");  // the word, not the end of barfoo
  const bool main_too = std::any_of(found.begin(), found.end(), [](const Diagnostic& d) {
    return format(d) == "main.comp.glsl:5:11: 'foo': undeclared identifier" &&
           d.source_line == "  int a = foo;";
  });
  CHECK(main_too);
}

TEST_CASE("a long line is cut around the fault") {
  const auto found = diagnose({{"main.comp.glsl", head + "void main() {" + std::string(100'000, ' ') +
                                                      "int a = foo;" + std::string(100'000, ' ') + "}\n"}});
  REQUIRE(!found.empty());
  CHECK(found[0].position.column == 13 + 100'000 + 9);
  CHECK(found[0].source_line.size() < 200);
  CHECK(found[0].source_line.find("int a = foo;") != std::string::npos);
}

TEST_CASE("a syntax error has the column of its token, if the line has that token once") {
  const auto column = [](const std::string& line) {
    const auto syntax = diagnose({{"main.comp.glsl", head + "void main() {\n" + line + "\n}\n"}});
    REQUIRE(!syntax.empty());
    CHECK(syntax[0].position.line == 4);
    return syntax[0].position.column;
  };
  CHECK(column("  int a = ;") == 11);
  CHECK(column("  int a = 1; int b = ;") == 0);
  CHECK(column("  { int a = 1 }") == 15);
}

TEST_CASE("an error in a registry's row is reported in the row's file") {
  const std::string registry =
      head + "#include \"shapes/ball.glsl\"\n#define SHAPES(X) X(ball)\n#define HIT(name) name##_hit(1.0);\n";
  const auto reported = [&](const std::string& ball) {
    const auto found = diagnose(
        {{"main.comp.glsl", registry + "void main() { SHAPES(HIT) }\n"}, {"shapes/ball.glsl", ball}});
    REQUIRE(!found.empty());
    return format(found[0]);
  };
  const std::string rest =
      ": 'ball_hit': no matching overloaded function found, which main.comp.glsl:6 needs";
  CHECK(reported("float ball_strike(float x) { return x; }\n") == "shapes/ball.glsl:1:0" + rest);
  CHECK(reported("// ball_hit\nfloat ball_hit(bool x) { return 1.0; }\n") == "shapes/ball.glsl:2:7" + rest);
}

TEST_CASE("errors of the preamble and of linking name no source line") {
  const auto linking = diagnose({{"main.comp.glsl", head + "void other() {}\n"}});
  REQUIRE(linking.size() == 1);
  CHECK(contains(linking[0].message, "Missing entry point"));
  CHECK(linking[0].position.file == "main.comp.glsl");
  CHECK(linking[0].position.line == 0);
  CHECK(!diagnose({{"main.comp.glsl", head + "void main() {}\n"}}, "#define\n").empty());
}

TEST_CASE("the preamble's defines reach the shader, its line numbers do not move") {
  const std::string text = head + "void main() {\n#ifdef BROKEN\n  foo;\n#endif\n}\n";
  CHECK(diagnose({{"main.comp.glsl", text}}).empty());
  const auto found = diagnose({{"main.comp.glsl", text}}, "#define OTHER 1\n#define BROKEN 1\n");
  REQUIRE(!found.empty());
  CHECK(format(found[0]) == "main.comp.glsl:5:3: 'foo': undeclared identifier");
}

TEST_CASE("includes come from the root only, and never leave it") {
  const auto refused = [](const std::string& path, const std::string& why) {
    const auto found = diagnose({{"main.comp.glsl", head + "#include \"lib/a.glsl\"\nvoid main() {}\n"},
                                 {"lib/a.glsl", "\n#include \"" + path + "\"\n"},
                                 {"lib/b.glsl", ""},
                                 {"../secret.glsl", ""},
                                 {"/etc/secret.glsl", ""}});
    REQUIRE(!found.empty());
    CHECK(found[0].position.file == "lib/a.glsl");
    CHECK(found[0].position.line == 2);
    CHECK(contains(found[0].message, why));
    CHECK(contains(found[0].source_line, path));
  };
  refused("../secret.glsl", "may not have '.', '..'");
  refused("lib/../../secret.glsl", "may not have '.', '..'");
  refused("./lib/b.glsl", "may not have '.', '..'");
  refused("/etc/secret.glsl", "absolute");
  refused("b.glsl", "there is no such file");  // not beside the file that includes it
  const auto angled =
      diagnose({{"main.comp.glsl", head + "#include <b.glsl>\nvoid main() {}\n"}, {"b.glsl", ""}});
  REQUIRE(!angled.empty());
  CHECK(angled[0].position.line == 3);
  CHECK(diagnose({{"main.comp.glsl", head + "#include \"lib/b.glsl\"\nvoid main() {}\n"}, {"lib/b.glsl", ""}})
            .empty());
}

TEST_CASE("an endless include is an error, a guarded one is not") {
  const std::string main_text = head + "#include \"a.glsl\"\nvoid main() {}\n";
  const auto endless = diagnose({{"main.comp.glsl", main_text}, {"a.glsl", "#include \"a.glsl\"\n"}});
  REQUIRE(!endless.empty());
  CHECK(contains(endless[0].message, "does it include itself?"));
  CHECK(diagnose({{"main.comp.glsl", main_text},
                  {"a.glsl", "#ifndef A\n#define A\n#include \"a.glsl\"\nint a = 1;\n#endif\n"}})
            .empty());
}

TEST_CASE("a shader's source is everything it may include, read once") {
  int reads = 0;
  const auto provider = files({{"m", "#include \"a\"\n  #  include \"b\"\n// no include\n"},
                               {"a", "#if 0\n#include \"c\"\n#endif\n"},
                               {"b", "#include \"a\"\n#include \"missing\"\n"},
                               {"c", ""},
                               {"unused", ""}});
  const gpu::ShaderSource source =
      gpu::read_shader([&](std::string_view path) { return ++reads, provider(path); }, "m");
  CHECK(source.file_names() == std::vector<std::string>{"a", "b", "c", "m"});
  CHECK(reads == 5);  // and "missing", once
  CHECK(error_of([&] { gpu::read_shader(provider, "nothing"); }).first == "there is no shader 'nothing'");
}

TEST_CASE("SPIR-V is cached by content, and a damaged entry is replaced") {
  const TemporaryFolder folder;
  const DiskCache cache(folder.path() / "deep" / "cache");
  const auto source = [](const std::string& body) {
    return gpu::read_shader(files({{"m", head + "#include \"a\"\nvoid main() {}\n"}, {"a", body}}), "m");
  };
  const auto entries = [&] {
    std::vector<std::filesystem::path> paths;
    for (const auto& entry : std::filesystem::directory_iterator(cache.folder()))
      paths.push_back(entry.path());
    return paths;
  };
  const std::vector<uint32_t> first = gpu::compile_kernel(source("int a = 1;"), "", {}, cache).spirv;
  REQUIRE(entries().size() == 1);
  const std::filesystem::path entry = entries()[0];

  // The result comes from the cache's entry: other words that are stored there with a correct hash come back.
  const std::string key = entry.stem().string();
  cache.store(key, "12345678");
  CHECK(gpu::compile_kernel(source("int a = 1;"), "", {}, cache).spirv.size() == 2);

  // Truncated and changed entries are not used.
  cache.store(key, "12345678");
  for (const std::string& damage :
       {std::string("x"), std::string(), read_text(entry).substr(0, 38), "0" + read_text(entry)}) {
    write_text(entry, damage);
    CHECK(gpu::compile_kernel(source("int a = 1;"), "", {}, cache).spirv == first);
    CHECK(cache.load(key)->size() == first.size() * 4);
  }

  // Another text, preamble or entry file makes another shader, which has a separate entry in the cache.
  gpu::compile_kernel(source("int a = 2;"), "", {}, cache);
  gpu::compile_kernel(source("int a = 1;"), "#define A\n", {}, cache);
  CHECK(entries().size() == 3);
}

TEST_CASE("the names of cached SPIR-V depend on every source file that makes it") {
  std::map<std::string, std::string> embedded, present;
  for (const EmbeddedFile& file : gpu::own_sources()) embedded[std::string(file.name)] = file.text;
  for (const auto& entry : std::filesystem::directory_iterator("host/gpu"))
    present[entry.path().filename().string()] = read_text(entry.path());
  CHECK(present.contains("called_arithmetic.cpp"));
  CHECK(embedded == present);
}

TEST_CASE("a shader with warnings is compiled every time, so that they are seen every time") {
  const TemporaryFolder folder;
  const DiskCache cache(folder.path());
  const auto source = gpu::read_shader(files({{"m",
                                               "#version 450\n#extension GL_KHR_no_such_thing : "
                                               "enable\nlayout(local_size_x = 1) in;\nvoid main() {}\n"}}),
                                       "m");
  for (int i = 0; i < 2; ++i) {
    const auto warnings = gpu::compile_kernel(source, "", {}, cache).warnings;
    REQUIRE(warnings.size() == 1);
    CHECK(warnings[0].severity == Severity::warning);
    CHECK(warnings[0].position.line == 2);
  }
}

TEST_CASE("a cache that cannot be written stores nothing, and does no harm") {
  const TemporaryFolder folder;
  write_text(folder / "file", "");
  const DiskCache pipes(folder.path() / "pipes");
  std::filesystem::create_directory(pipes.folder());
  REQUIRE(mkfifo((pipes.folder() / "x.eyeray-cache").c_str(), 0600) == 0);
  CHECK_FALSE(pipes.load("x"));
  for (const DiskCache& cache :
       {DiskCache({}), DiskCache(folder.path() / "file"), DiskCache("/proc/nowhere")}) {
    cache.store("name", "bytes");
    CHECK(!cache.load("name"));
  }
}

TEST_CASE("a cache drops its oldest entries, and only its own") {
  const TemporaryFolder folder;
  const DiskCache cache(folder.path());
  write_text(folder / "mine.txt", "keep");
  for (int i = 0; i <= 512; ++i) write_text(folder / fmt::format("{}.eyeray-cache", i), "old");
  const auto past = std::filesystem::file_time_type::clock::now() - std::chrono::hours(1);
  for (int i = 0; i <= 512; ++i)
    std::filesystem::last_write_time(folder / fmt::format("{}.eyeray-cache", i),
                                     past + std::chrono::seconds(i));
  cache.store("new", "bytes");
  CHECK(cache.load("new") == "bytes");
  CHECK(folder.names().contains("mine.txt"));
  CHECK(folder.names().contains("512.eyeray-cache"));
  CHECK(!folder.names().contains("0.eyeray-cache"));
  CHECK(folder.names().size() == 256 + 1);
}
