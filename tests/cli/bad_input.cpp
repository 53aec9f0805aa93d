// Faults of input and of the machine: each has its message and its exit code, and leaves no file behind.
#include <nlohmann/json.hpp>

#include "host/image/image_file.hpp"
#include "scene.hpp"
//
#include "tests/support/doctest.hpp"

using namespace eyeray::engine;
using namespace eyeray::engine::image;
using namespace eyeray::engine::test;

namespace {

const std::set<std::string> only_the_scene{"scene.toml"};

struct BadScene {
  std::string before, after;          // a change of the small scene
  std::vector<std::string> messages;  // "line:column: error: …" and any other text that must be printed
};

}  // namespace

TEST_CASE("a scene that cannot be read is reported with the reason") {
  const SceneFolder folder;
  const ProcessResult missing = run_eyeray({"render", folder / "nope.toml", "-o", folder / "a.png"});
  CHECK(missing.code == 4);
  CHECK(missing.err.starts_with("eyeray: error: cannot read the scene " + folder / "nope.toml" +
                                ": No such file or directory"));
  const ProcessResult directory = run_eyeray({"render", folder.path(), "-o", folder / "a.png"});
  CHECK(directory.code == 4);
  CHECK(directory.err.find("it is a folder") != std::string::npos);
  const ProcessResult slash = run_eyeray({"render", folder.path().string() + "/"});
  CHECK(slash.code == 4);
  CHECK(slash.err.find("it is a folder; name a scene or a mesh in it\n") != std::string::npos);
  const ProcessResult picture = run_eyeray({"check", "tests/image/pictures/rgb.png"});
  CHECK(picture.code == 2);
  CHECK(picture.err.starts_with("eyeray: error: tests/image/pictures/rgb.png is not a scene: "));
  CHECK(folder.names() == only_the_scene);
}

TEST_CASE("a function without a Lipschitz constant or computable intervals is refused") {
  const SceneFolder folder;
  replace_in_file(folder.scene(), "[[sphere]]", R"([[implicit]]
code = """
float f(vec3 p) {
  float x = p.x;
  while (x > 1.0) x *= 0.5;
  return x;
}
"""
min = [-1, -1, -1]
max = [1, 1, 1]
material = "matte"
[[sphere]])");
  const ProcessResult result = run_eyeray({"check", folder.scene()});
  CHECK(result.code == 2);
  CAPTURE(result.err);
  CHECK(result.err.find("error: this loop has more than 1000 iterations, or a number of them that depends on "
                        "p; so no interval can be computed for it: declare a `lipschitz`\n"
                        "    while (x > 1.0) x *= 0.5;") != std::string::npos);
  // With a Lipschitz constant, no interval is needed.
  replace_in_file(folder.scene(), "max = [1, 1, 1]", "max = [1, 1, 1]\nlipschitz = 1");
  CHECK(run_eyeray({"check", folder.scene()}).code == 0);
}

TEST_CASE("invalid contents of a scene are reported at their line") {
  const BadScene cases[] = {
      {"[camera]", "[camera", {":5:8: error: "}},
      {"radius = 1", "radius = 1\nradios = 2", {":27:1: error: ", "did you mean `radius`"}},
      {"radius = 1", "radius = 1\nradius = 2", {":27:", "error: ", "radius"}},
      {"radius = 1", "radius = -1", {":26:10: error: ", "from 1e-12 to 1e12"}},
      {"radius = 1", "radius = nan", {":26:10: error: "}},
      {"radius = 1", "radius = inf", {":26:10: error: "}},
      {"width = 64", "width = 0", {":2:9: error: ", "1 to 65536"}},
      {"width = 64", "width = -5", {":2:9: error: "}},
      {"width = 64", "width = 65536\nheight = 65536 #", {"error: "}},
      {"target = [0, 1, 0]", "target = [0, 1, 4]", {"error: "}},
      {"[[sphere]]",
       "[[plane]]\npoint = [0, 0, 0]\nnormal = [0, 0, 0]\nmaterial = \"matte\"\n[[sphere]]",
       {"error: ", "normal"}},
      {"[[sphere]]",
       "[[triangle]]\nvertices = [[0,0,0],[1,1,1],[2,2,2]]\nmaterial = \"matte\"\n[[sphere]]",
       {"error: "}},
      {"radius = 1", "radius = 1\ntransform = [ { scale = 0 } ]", {"error: "}},
      {"material = \"matte\"", "material = \"mate\"", {"error: ", "did you mean", "matte"}},
  };
  for (const BadScene& bad : cases) {
    const SceneFolder folder;
    replace_in_file(folder.scene(), bad.before, bad.after);
    const ProcessResult result = run_eyeray({"render", folder.scene(), "-o", folder / "a.png"});
    CAPTURE(bad.after);
    CAPTURE(result.err);
    CHECK(result.code == 2);
    CHECK(result.out == "");
    CHECK(result.err.starts_with(folder.scene()));
    CHECK(result.err.find(" error") != std::string::npos);
    for (const std::string& message : bad.messages) CHECK(result.err.find(message) != std::string::npos);
    CHECK(folder.names() == only_the_scene);
  }
}

TEST_CASE("absurd sizes on the command line are refused") {
  const SceneFolder folder;
  for (const std::string size : {"0x48", "-4x48", "65537x1", "31623x31623"}) {
    CAPTURE(size);
    const ProcessResult result = run_eyeray({"render", folder.scene(), "-s", size, "-o", folder / "a.png"});
    CHECK(result.code == 2);
    CHECK(result.err.starts_with("-s " + size + ": error: "));
    CHECK(result.err.ends_with("1 error\n"));
  }
  const ProcessResult billion =
      run_eyeray({"render", folder.scene(), "-s", "31623x31623", "-o", folder / "a.png"});
  CHECK(billion.err.find("1000014129 pixels") != std::string::npos);
  CHECK(folder.names() == only_the_scene);
}

TEST_CASE("an output that cannot be written is refused before rendering") {
  const SceneFolder folder;
  std::filesystem::create_directory(folder / "folder.png");
  for (const std::string& output :
       {folder / "nowhere/a.png", folder / "folder.png", std::string("/proc/a.png")}) {
    const ProcessResult result = run_eyeray({"render", folder.scene(), "-o", output});
    CAPTURE(result.err);
    CHECK(result.code == 4);
    CHECK(result.err.starts_with("eyeray: error: "));
    CHECK(result.err.find(output) != std::string::npos);
    CHECK(result.err.find("gpu:") == std::string::npos);
  }
  CHECK(folder.names() == std::set<std::string>{"scene.toml", "folder.png"});
}

TEST_CASE("a render never overwrites a file that it reads, whatever name the output has") {
  const SceneFolder folder;
  const auto path = [&](const std::string& name) { return std::filesystem::path(folder / name); };
  std::filesystem::create_directory(path("art"));
  std::filesystem::copy("tests/image/pictures/rgb.png", path("art/wood.png"));
  const std::string scene = std::string("include = \"more.hdr\"\n") + small_scene;
  write_text(path("art/scene.png"),
             replaced(scene, "diffuse = [0.8, 0.4, 0.2]", "diffuse = { image = \"wood.png\" }"));
  write_text(path("art/more.hdr"), "[render]\nmax_depth = 3\n");
  std::filesystem::create_symlink("art", path("way"));
  std::filesystem::create_hard_link(path("art/wood.png"), path("same.depth.pfm"));
  const auto kept = [&] {
    return read_text(path("art/scene.png")) + read_text(path("art/more.hdr")) +
           read_text(path("art/wood.png"));
  };
  const std::string before = kept();
  const auto render = [&](std::vector<std::string> more) {
    std::vector<std::string> words{"render", folder / "art/scene.png", "--backend", "reference", "-q"};
    words.insert(words.end(), more.begin(), more.end());
    return run_eyeray(words);
  };
  for (const std::vector<std::string>& output :
       std::vector<std::vector<std::string>>{{"-o", folder / "art/scene.png"},
                                             {"-o", folder / "way/scene.png"},
                                             {"-o", folder / "way/../art/more.hdr"},
                                             {"-o", folder / "a.png", "-o", folder / "art/wood.png"},
                                             {"-o", folder / "same.png", "--aov", "depth"}}) {
    const ProcessResult result = render(output);
    CAPTURE(result.err);
    CHECK(result.code == 2);
    CHECK(result.err.find("would be overwritten, but the scene reads it") != std::string::npos);
    CHECK(kept() == before);
  }
  // The default name of the picture is refused likewise: it is the scene's.
  const ProcessResult result =
      run_process({"sh", "-c", "cd \"$0\" && exec \"$1\" render scene.png --backend reference",
                   folder / "way", std::filesystem::absolute(eyeray_binary()).string()});
  CHECK(result.code == 2);
  CHECK(kept() == before);
  CHECK(render({"-o", folder / "art/fine.png"}).code == 0);

  const std::string picture = folder / "art/fine.png";
  const ProcessResult compared = run_eyeray({"compare", picture, picture, "--diff", folder / "way/fine.png"});
  CHECK(compared.code == 2);
  CHECK(compared.err.find("--diff would overwrite it") != std::string::npos);
}

TEST_CASE("a scene file that reports size 0 is still read") {
  // A process's environment is a file of /proc, of size 0 and with text in it.
  const ProcessResult result = run_eyeray({"check", "/proc/self/environ", "--json"}, {{"A", "\xff"}});
  CAPTURE(result.err);
  CHECK(result.code == 2);
  CHECK(result.err.find("/proc/self/environ is not a scene: it contains bytes that are not text") !=
        std::string::npos);
}

TEST_CASE("without a Vulkan driver or loader nothing is rendered, and the message names the remedy") {
  const SceneFolder folder;
  const Environment no_driver{{"VK_DRIVER_FILES", "/nonexistent.json"},
                              {"VK_ICD_FILENAMES", "/nonexistent.json"}};
  const Environment no_loader{{"EYERAY_VULKAN_LOADER", "/nonexistent.so"}};
  for (const auto& [environment, what] :
       {std::pair{no_driver, "VK_DRIVER_FILES=/nonexistent.json names no file, correct or unset it"},
        std::pair{no_loader, "no Vulkan loader"}}) {
    const ProcessResult render = run_eyeray({"render", folder.scene(), "-o", folder / "a.png"}, environment);
    CHECK(render.code == 3);
    CHECK(render.err.find(what) != std::string::npos);
    CHECK(render.err.find("apt install") != std::string::npos);
    CHECK(render.err.find("with --backend twin") != std::string::npos);
    CHECK(run_eyeray({"devices"}, environment).code == 3);
    const ProcessResult verify = run_eyeray({"verify", folder.scene()}, environment);
    CHECK(verify.code == 3);
    CHECK(verify.err.find("with --backends twin") != std::string::npos);
    // The CPU backends need neither a driver nor a loader.
    CHECK(run_eyeray({"render", folder.scene(), "--backend", "twin", "-o", folder / "twin.png"}, environment)
              .code == 0);
    std::filesystem::remove(folder / "twin.png");
  }
  CHECK(run_eyeray({"render", folder.scene(), "--device", "no such device", "-o", folder / "a.png"}).code ==
        3);
  CHECK(folder.names() == only_the_scene);
}

TEST_CASE("a shader that does not compile is shown at its line") {
  const SceneFolder folder;
  const std::string shaders = folder / "shaders";
  lay_shader(shaders, "kernels/pixel.glsl",
             with_pixel_code(own_shader("kernels/pixel.glsl"), "  color = nonsense;\n"));
  const ProcessResult result =
      run_eyeray({"render", folder.scene(), "-o", folder / "a.png", "--shaders", shaders});
  CAPTURE(result.err);
  CHECK(result.code == 2);
  CHECK(result.err.find(shaders + "/kernels/pixel.glsl:") == 0);
  CHECK(result.err.find(": error: ") != std::string::npos);
  CHECK(folder.names() == std::set<std::string>{"scene.toml", "shaders"});

  const ProcessResult nowhere = run_eyeray({"render", folder.scene(), "--shaders", folder / "none"});
  CHECK(nowhere.code == 4);
  CHECK(nowhere.err.find("no such folder") != std::string::npos);
}

TEST_CASE("a shader of --shaders in a folder where none is read is reported, with its path") {
  const SceneFolder folder;
  const std::string shaders = folder / "shaders";
  lay_shader(shaders, "sphere.glsl", "as folders were before shaders lay in folders\n");
  lay_shader(shaders, "shapes/own.glsl", "no shader's name\n");
  const ProcessResult result =
      run_eyeray({"render", folder.scene(), "-o", folder / "a.png", "--shaders", shaders});
  CHECK(result.code == 0);
  CHECK(result.err.find("eyeray: warning: " + shaders + "/sphere.glsl replaces no shader; did you mean " +
                        shaders + "/shapes/sphere.glsl?\n") == 0);
  CHECK(result.err.find("own.glsl") == std::string::npos);
}

TEST_CASE("a user's kernel without push constants runs; one with other push constants is reported") {
  const SceneFolder folder;
  const std::string shaders = folder / "shaders";
  const auto render = [&](const std::string& kernel) {
    lay_shader(shaders, "kernels/render.comp.glsl",
               "#version 450\nlayout(local_size_x = 64) in;\n"
               "layout(std430, set = 0, binding = 7) buffer Words { uint words[]; };\n" +
                   kernel);
    return run_eyeray({"render", folder.scene(), "-o", folder / "a.png", "--shaders", shaders});
  };
  const ProcessResult none = render("void main() { words[gl_LocalInvocationIndex] = 0u; }\n");
  CAPTURE(none.err);
  CHECK(none.code == 0);
  const ProcessResult other = render(
      "layout(push_constant) uniform Push { uint x; };\nvoid main() { words[gl_LocalInvocationIndex] = x; "
      "}\n");
  CAPTURE(other.err);
  CHECK(other.code == 2);
  CHECK(other.err.find(
            "kernel 'kernels/render.comp.glsl' declares 4 bytes of push constants, but eyeray sets 32") !=
        std::string::npos);
  const ProcessResult unknown = render(
      "layout(std430, binding = 99) buffer More { uint more[]; };\nvoid main() { words[0] = more[0]; }\n");
  CAPTURE(unknown.err);
  CHECK(unknown.code == 2);
  CHECK(unknown.err.find("kernel 'kernels/render.comp.glsl' reads binding 99") != std::string::npos);
}

TEST_CASE("a shader that loops for ever is abandoned after --timeout") {
  const SceneFolder folder;
  lay_endless_shader(folder / "shaders");
  const ProcessResult result = run_eyeray({"render", folder.scene(), "-s", "256x256", "-o", folder / "a.png",
                                           "--shaders", folder / "shaders", "--timeout", "0.3"});
  CAPTURE(result.err);
  CHECK(result.code == 5);
  CHECK(result.err.starts_with("eyeray: error: "));
  CHECK(result.seconds < 30);
  CHECK(folder.names() == std::set<std::string>{"scene.toml", "shaders"});
}

TEST_CASE("Ctrl-C keeps what was rendered") {
  const SceneFolder folder;
  const ProcessResult result =
      run_eyeray({"render", folder.scene(), "--spp", "65536", "-o", folder / "a.pfm"}, {}, 120, 3000);
  CAPTURE(result.err);
  CHECK(result.code == 130);
  CHECK(result.err.find("eyeray: interrupted; ") != std::string::npos);
  CHECK(result.err.find(" of 65536 samples a pixel were kept\n") != std::string::npos);
  CHECK(folder.names() == std::set<std::string>{"scene.toml", "a.pfm"});
  CHECK(read_image(folder / "a.pfm").pixel(0, 0)[0] == doctest::Approx(0.25));
}

TEST_CASE("Ctrl-C before every pixel has a sample keeps nothing") {
  const SceneFolder folder;
  const ProcessResult result = run_eyeray(
      {"render", folder.scene(), "-s", "2800x2800", "--backend", "reference", "-o", folder / "a.pfm", "-q"},
      {}, 120, 300);
  CHECK(result.code == 130);
  CHECK(result.err.starts_with("eyeray: error: interrupted"));
  CHECK(folder.names() == only_the_scene);
}
