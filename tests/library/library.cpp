// The library as a program sees it: only its header is included, only its symbols are linked.
#include <doctest/doctest.h>
#include <signal.h>
#include <unistd.h>
#include <eyeray/eyeray.hpp>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <limits>
#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <thread>
#include <type_traits>
#include <vector>

using namespace eyeray::v0;

namespace {

constexpr const char* small = "tests/library/small.toml";

Renderer& renderer() {
  static Renderer one;
  return one;
}

std::string bytes_of(const std::string& file) {
  std::ifstream stream(file, std::ios::binary);
  return {std::istreambuf_iterator<char>(stream), {}};
}

bool same_bits(const Plane& a, const Plane& b) {
  return a.values.size() == b.values.size() && !a.values.empty() &&
         std::memcmp(a.values.data(), b.values.data(), a.values.size_bytes()) == 0;
}

std::vector<std::string> environment() {
  std::vector<std::string> all;
  for (char** each = environ; *each; ++each) all.emplace_back(*each);
  return all;
}

Scene with(std::vector<std::string> defines) {
  return Scene::read(small, {.defines = std::move(defines)});
}

// The error that `work` throws; a bad_input without a diagnostic if it throws nothing.
template <typename Work>
Error thrown_by(const Work& work) {
  try {
    static_cast<void>(work());
  } catch (const Error& error) {
    return error;
  }
  return {ErrorKind::bad_input, "nothing was thrown"};
}

}  // namespace

TEST_CASE("a process that renders keeps its environment and its signals") {
  const std::vector<std::string> before = environment();
  const auto handlers = [] {
    std::vector<void (*)(int)> all;
    for (const int number : {SIGINT, SIGTERM, SIGHUP}) {
      struct sigaction action{};
      REQUIRE(sigaction(number, nullptr, &action) == 0);
      all.push_back(action.sa_handler);
    }
    return all;
  };
  const auto handlers_before = handlers();
  // A picture so large that the program would set llvmpipe to vectors of 512 bits.
  const Scene scene = with({"image.width=1024", "image.height=1024"});
  CHECK(renderer().render(scene, {.crop = {0, 0, 64, 48}}).complete());
  CHECK(environment() == before);
  CHECK((handlers() == handlers_before));
}

TEST_CASE("a renderer's first picture warns of a cache that others may write to") {
  const std::string cache = std::filesystem::temp_directory_path() / "eyeray-open-cache-XXXXXX";
  std::string folder = cache;
  REQUIRE(mkdtemp(folder.data()));
  std::filesystem::permissions(folder, std::filesystem::perms::all);
  const char* const before = std::getenv("EYERAY_CACHE_DIR");
  const std::string kept = before ? before : "";
  setenv("EYERAY_CACHE_DIR", folder.c_str(), 1);
  Renderer one;
  const auto warning = [&](Backend backend) {
    const Picture picture = one.render(Scene::read(small), {.backend = backend});
    return picture.warnings().empty() ? std::string() : picture.warnings()[0].message;
  };
  CHECK(warning(Backend::reference) == "");
  CHECK(warning(Backend::gpu).starts_with("the cache " + folder + " is not used"));
  CHECK(warning(Backend::gpu) == "");
  before ? setenv("EYERAY_CACHE_DIR", kept.c_str(), 1) : unsetenv("EYERAY_CACHE_DIR");
  std::filesystem::remove_all(folder);
}

TEST_CASE("a picture has the warnings that the command line prints") {
  const auto only_warning = [&](const Scene& scene, const RenderOptions& options) {
    const Picture picture = renderer().render(scene, options);
    REQUIRE(picture.warnings().size() == 1);
    CHECK_FALSE(picture.warnings()[0].is_error);
    return picture.warnings()[0].message;
  };
  const Scene dim = Scene::read("scenes/path/lamps.toml", {.defines = {"image.width=32", "image.height=24"}});
  CHECK(only_warning(dim, {.clamp = 0.5}).starts_with("the picture is biased: clamp cut "));
  CHECK(only_warning(dim, {.noise = 0.001}).ends_with("samples a pixel are too few; allow more"));
  const Scene lit = Scene::read("scenes/meshes/knot.ply",
                                {.defines = {"image.width=32", "image.height=24", "image.exposure=9"}});
  CHECK(only_warning(lit, {}).find("exposure") != std::string::npos);
}

TEST_CASE("a denoised picture has less noise, and the AOVs that were requested") {
  const auto render = [&](const std::string& samples, bool denoise) {
    const Scene box =
        Scene::read("scenes/path/cornell_box.toml",
                    {.defines = {"image.width=48", "image.height=48", "image.samples=" + samples}});
    return renderer().render(box, {.aovs = {"depth"}, .denoise = denoise});
  };
  const Picture truth = render("256", false), noisy = render("8", false), denoised = render("8", true);
  CHECK(denoised.aovs() == std::vector<std::string>{"depth"});
  const auto error = [&](const Picture& picture) {
    double sum = 0;
    for (size_t i = 0; i < truth.color().values.size(); ++i) {
      const double light = double(truth.color().values[i]);
      sum += std::pow(double(picture.color().values[i]) - light, 2) / (light * light + 1e-3);
    }
    return sum;
  };
  CHECK(error(denoised) < error(noisy) / 2);
}

TEST_CASE("a picture's planes have the shapes that the header documents") {
  const Picture picture = renderer().render(Scene::read(small), {.aovs = {"depth", "normal", "hits"}});
  CHECK(picture.complete());
  CHECK(picture.samples_done() == 1);
  CHECK(picture.rays() > 64 * 48);
  CHECK(picture.warnings().empty());
  const Plane color = picture.color(), depth = picture.aov("depth"), normal = picture.aov("normal");
  CHECK(
      (color.width == 64 && color.height == 48 && color.channels == 3 && color.values.size() == 64 * 48 * 3));
  CHECK((depth.channels == 1 && depth.values.size() == 64 * 48));
  CHECK((normal.channels == 3 && normal.values.size() == 64 * 48 * 3));
  CHECK(picture.aovs() == std::vector<std::string>{"depth", "normal", "hits"});
  // The sphere's nearest point is three units away, and its normal points at the eye; the corner is the
  // background.
  const size_t middle = 24 * 64 + 32;
  CHECK(depth.values[middle] == doctest::Approx(3).epsilon(1e-3));
  CHECK(normal.values[3 * middle + 2] == doctest::Approx(1).epsilon(1e-3));
  CHECK(depth.values[0] > 1e30f);
  CHECK(color.values[2] == 0.75f);
  CHECK(thrown_by([&] { return picture.aov("uv"); }).kind() == ErrorKind::bad_input);

  const Picture part = renderer().render(Scene::read(small), {.crop = {32, 24, 4, 2}});
  const Plane pixels = part.color();
  CHECK((pixels.width == 4 && pixels.height == 2));
  CHECK(std::memcmp(pixels.values.data(), &color.values[3 * middle], 12 * sizeof(float)) == 0);
}

TEST_CASE("a transparent picture has an alpha as a fourth channel") {
  const Picture picture = renderer().render(with({"image.transparent=true"}), {.aovs = {"coverage"}});
  const Plane color = picture.color(), coverage = picture.aov("coverage");
  REQUIRE((color.channels == 4 && color.values.size() == 64 * 48 * 4));
  const std::vector<uint8_t> shown = picture.tonemapped();
  REQUIRE(shown.size() == color.values.size());
  for (size_t i = 0; i < coverage.values.size(); ++i) {
    CHECK(color.values[4 * i + 3] == coverage.values[i]);
    CHECK(shown[4 * i + 3] == (coverage.values[i] == 1 ? 255 : 0));
    if (coverage.values[i] == 0) CHECK((color.values[4 * i] == 0 && shown[4 * i] == 0));
  }
  CHECK((coverage.values[24 * 64 + 32] == 1 && coverage.values[0] == 0));
  CHECK(picture.png().size() > 100);
  CHECK(thrown_by([&] { picture.write("/tmp/no.pfm"); }).kind() == ErrorKind::bad_input);
  CHECK(thrown_by([] { return renderer().render(Scene::read(small), {.aovs = {"coverage"}}); }).kind() ==
        ErrorKind::bad_input);
}

TEST_CASE("GPU and twin render the same bits, from several threads at once too") {
  const Scene scene = Scene::read(small);
  const Picture alone = renderer().render(scene);
  std::vector<Picture> pictures(3, alone);
  std::vector<std::thread> threads;
  for (size_t i = 0; i < pictures.size(); ++i)
    threads.emplace_back([&, i] {
      Renderer own;
      pictures[i] = own.render(scene, {.backend = i == 0 ? Backend::twin : Backend::gpu});
    });
  for (std::thread& thread : threads) thread.join();
  for (const Picture& each : pictures) CHECK(same_bits(each.color(), alone.color()));
  CHECK_FALSE(same_bits(renderer().render(with({"sphere.0.radius=0.9"})).color(), alone.color()));
}

TEST_CASE("a cancelled render returns its picture so far, and the renderer stays usable") {
  const Scene scene = with({"image.pattern=random", "image.samples=65536"});
  SUBCASE("by progress, with some samples") {
    int calls = 0;
    const auto progress = [&](const Progress& now) {
      CHECK((now.share > 0 && now.share <= 1));
      return ++calls < 3;
    };
    const Picture picture = renderer().render(scene, {.aovs = {"depth", "samples"}, .progress = progress});
    CHECK(calls == 3);
    CHECK_FALSE(picture.complete());
    CHECK((picture.samples_done() > 0 && picture.samples_done() < 65536));
    CHECK(picture.color().values.size() == 64 * 48 * 3);
    CHECK(picture.aovs() == std::vector<std::string>{"samples"});
    CHECK(picture.aov("samples").values[0] == float(picture.samples_done()));
  }
  SUBCASE("by another thread") {
    RenderOptions options;
    std::thread other([cancellation = options.cancellation]() mutable {
      std::this_thread::sleep_for(std::chrono::milliseconds(200));
      cancellation.request();
    });
    CHECK_FALSE(renderer().render(scene, options).complete());
    other.join();
  }
  SUBCASE("before it begins, and the picture is empty") {
    RenderOptions options;
    options.cancellation.request();
    const Picture picture = renderer().render(scene, options);
    CHECK((picture.samples_done() == 0 && picture.color().values.empty() && picture.color().width == 0));
    CHECK(thrown_by([&] { picture.write("never.png"); }).kind() == ErrorKind::bad_input);
    CHECK(thrown_by([&] { return picture.png(); }).kind() == ErrorKind::bad_input);
    CHECK(picture.tonemapped().empty());
    CHECK(thrown_by([&] {
            return renderer().verify(scene, {.cancellation = options.cancellation});
          }).kind() == ErrorKind::cancelled);
  }
  CHECK(renderer().render(Scene::read(small)).complete());
}

TEST_CASE("an exception from progress reaches the caller") {
  const auto progress = [](const Progress&) -> bool { throw std::string("enough"); };
  CHECK_THROWS_AS(static_cast<void>(renderer().render(Scene::read(small), {.progress = progress})),
                  std::string);
  CHECK(renderer().render(Scene::read(small)).complete());
}

TEST_CASE("errors have a kind, and a scene's errors have positions") {
  const Error missing = thrown_by([] { return Scene::read("no-such.toml"); });
  CHECK(missing.kind() == ErrorKind::file_io);
  const Error wrong = thrown_by([] { return Scene::parse("[[sphere]]\nradius = -1\nradios = 2\n", "mine"); });
  CHECK(wrong.kind() == ErrorKind::bad_input);
  REQUIRE(wrong.diagnostics().size() >= 2);
  CHECK(std::ranges::all_of(wrong.diagnostics(),
                            [](const Diagnostic& each) { return each.is_error && each.file == "mine"; }));
  CHECK(std::ranges::any_of(wrong.diagnostics(),
                            [](const Diagnostic& each) { return each.line == 2 && each.column == 10; }));
  CHECK(thrown_by([] { return Scene::parse("[[mesh]]\nfile = \"a.ply\"\n"); }).diagnostics().size() == 1);
  CHECK(thrown_by([] { Renderer({.device = "no such device"}); }).kind() == ErrorKind::no_device);
  CHECK(thrown_by([] { Renderer({.shaders = "no-such-folder"}); }).kind() == ErrorKind::file_io);
  CHECK(thrown_by([] { return renderer().render(Scene::read(small), {.crop = {60, 0, 10, 10}}); }).kind() ==
        ErrorKind::bad_input);
  CHECK(thrown_by([] { return renderer().render(Scene::read(small), {.aovs = {"deepth"}}); }).kind() ==
        ErrorKind::bad_input);
}

TEST_CASE("a loop of a renderer's shaders that does not end is an error that names it") {
  const std::filesystem::path folder =
      std::filesystem::temp_directory_path() / ("eyeray-endless-" + std::to_string(getpid()));
  std::filesystem::create_directories(folder / "shapes");
  std::string text = bytes_of("shaders/shapes/sphere.glsl");
  const std::string end = "  return discriminant > 0.0f ? t : T_NONE;\n";
  REQUIRE(text.find(end) != std::string::npos);
  text.insert(text.find(end), "  while (true) {}\n");
  std::ofstream(folder / "shapes/sphere.glsl") << text;
  const Error error = thrown_by([&] { return Renderer({.shaders = folder}).render(Scene::read(small)); });
  std::filesystem::remove_all(folder);
  CHECK(error.kind() == ErrorKind::timed_out);
  const std::string message = error.what();
  CHECK(message.find((folder / "shapes/sphere.glsl:").string()) != std::string::npos);
  CHECK(message.ends_with(": while (true) {}"));
}

TEST_CASE("a scene built in code is the same as one from a file") {
  SceneBuilder builder;
  builder.set("image", Table().set("width", 64).set("height", 48));
  builder.set("camera", Table().set("eye", {0, 1, 4}).set("target", {0, 1, 0}).set("fov", 60.0));
  builder.set("render", Table().set("background", {0.25, 0.5, 0.75}).set("ambient", {0.2, 0.2, 0.2}));
  builder.add("light",
              Table().set("type", "point").set("position", {3, 5, 4}).set("intensity", {20, 20, 20}));
  builder.add("material",
              Table().set("name", "say \"matte\"\n").set("type", "phong").set("diffuse", {.8, .4, .2}));
  builder.add("sphere", Table().set("center", {0, 1, 0}).set("radius", 1).set("material", "say \"matte\"\n"));
  const Picture picture = renderer().render(builder.scene());
  CHECK(same_bits(picture.color(), renderer().render(Scene::read(small)).color()));

  // A mesh of one triangle beside the sphere changes pixels; one of wrong arrays is refused, with the reason.
  const std::vector<float> positions{-2, 0, 1, -1, 0, 1, -1.5, 2, 1};
  const std::vector<uint32_t> corners{0, 1, 2};
  builder.add_mesh({positions, corners}, Table().set("material", "say \"matte\"\n"));
  CHECK_FALSE(same_bits(renderer().render(builder.scene()).color(), picture.color()));
  const auto refusal = [&](const MeshArrays& arrays) {
    return thrown_by([&] {
      SceneBuilder wrong;
      wrong.add_mesh(arrays);
      return wrong.scene();
    });
  };
  const std::vector<uint32_t> beyond{0, 1, 3};
  const std::vector<float> nan{-2, 0, 1, -1, 0, std::numeric_limits<float>::quiet_NaN(), -1.5, 2, 1};
  CHECK(std::string(refusal({std::span(positions).first(8), corners}).what()).find("three a vertex") !=
        std::string::npos);
  CHECK(refusal({positions, std::span(corners).first(2)}).diagnostics().empty());
  CHECK(refusal({positions, corners, std::span(positions).first(6)}).diagnostics().empty());
  CHECK(refusal({positions, beyond}).diagnostics().size() == 1);
  CHECK(refusal({nan, corners}).diagnostics().size() == 1);
}

TEST_CASE("a value accepts every number and text, but no type that only converts to one") {
  CHECK(Value(true).toml() == "true");
  CHECK(Value(-3).toml() == "-3");
  CHECK(Value(3u).toml() == "3");
  CHECK(Value(size_t(3)).toml() == "3");
  CHECK(Value(uint8_t(200)).toml() == "200");
  CHECK(Value(-3l).toml() == "-3");
  CHECK(Value(std::numeric_limits<int64_t>::min()).toml() == "-9223372036854775808");
  CHECK(Value(uint64_t(std::numeric_limits<int64_t>::max())).toml() == "9223372036854775807");
  CHECK(Value(0.5f).toml() == "0.5");
  CHECK(Value(0.1f).toml() == "0.10000000149011612");
  CHECK(Value(0.1l).toml() == "0.1");
  CHECK(Value("a").toml() == Value(std::string_view("a")).toml());
  CHECK(Value("a").toml() == Value(std::string("a")).toml());
  CHECK(Value({0, 1u, 2.5f, "a", true, Value{1, 2}}).toml() == "[0, 1, 2.5, \"a\", true, [1, 2]]");
  CHECK(Table().set(std::string_view("a b"), 1).entries()[0].first == "a b");

  const Error large = thrown_by([] { return Value(uint64_t(1) << 63); });
  CHECK(large.kind() == ErrorKind::bad_input);
  CHECK(std::string(large.what()).starts_with("9223372036854775808 is too large for a scene"));

  static_assert(!std::is_constructible_v<Value, char>);
  static_assert(!std::is_constructible_v<Value, wchar_t>);
  static_assert(!std::is_constructible_v<Value, char8_t>);
  static_assert(!std::is_constructible_v<Value, const int*>);
  static_assert(!std::is_constructible_v<Value, void*>);
  static_assert(!std::is_constructible_v<Value, const wchar_t*>);
  static_assert(!std::is_constructible_v<Value, std::nullptr_t>);
  static_assert(!std::is_constructible_v<Value, Backend>);
  static_assert(std::is_convertible_v<std::string, Value> && std::is_convertible_v<size_t, Value>);
}

TEST_CASE("only the engine makes scenes and pictures of its data") {
  static_assert(!std::is_constructible_v<Scene, std::shared_ptr<const Scene::Data>>);
  static_assert(!std::is_constructible_v<Picture, std::shared_ptr<const Picture::Data>>);
}

TEST_CASE("verify returns the program's report") {
  const Report report = renderer().verify(Scene::read(small), {.crop = {0, 0, 32, 32}});
  CHECK(report.passed);
  CHECK(report.failures.empty());
  CHECK(report.text.starts_with("PASSED"));
  CHECK(report.json.find("\"passed\"") != std::string::npos);
  CHECK(thrown_by([] {
          return renderer().verify(Scene::read(small), {.backends = {Backend::reference}});
        }).kind() == ErrorKind::bad_input);
}

TEST_CASE("a picture writes the same file as the program") {
  const std::string folder = (std::filesystem::temp_directory_path() / "eyeray-library-XXXXXX").string();
  std::string made = folder;
  REQUIRE(mkdtemp(made.data()));
  const char* program = std::getenv("EYERAY_BINARY");
  REQUIRE(program);
  for (const char* ending : {"pfm", "png"}) {
    const std::string ours = made + "/ours." + ending, theirs = made + "/theirs." + ending;
    const std::string options = " -D image.exposure=1";
    renderer().render(with({"image.exposure=1"})).write(ours);
    REQUIRE(std::system((std::string(program) + " render " + small + options + " -q -o " + theirs).c_str()) ==
            0);
    CHECK(bytes_of(ours).size() > 100);
    CHECK(bytes_of(ours) == bytes_of(theirs));
  }
  const Picture picture = renderer().render(with({"image.exposure=1"}));
  CHECK(picture.png() == bytes_of(made + "/theirs.png"));
  const std::vector<uint8_t> shown = picture.tonemapped();
  REQUIRE(shown.size() == picture.color().values.size());
  // The background is 0.25, 0.5 and 0.75, twice as bright.
  CHECK((shown[0] == 188 && shown[1] == 255 && shown[2] == 255));
  std::filesystem::remove_all(made);
}
