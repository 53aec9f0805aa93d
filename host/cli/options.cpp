// Options that several commands share. An option becomes an override of the scene; the loader checks its
// value.
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <array>
#include <cstdlib>
#include <span>

#include "host/cli/command.hpp"
#include "host/core/embedded_shaders.hpp"
#include "host/core/escaped_text.hpp"
#include "host/core/process.hpp"
#include "host/core/standard_streams.hpp"
#include "host/executors/cpp_compiler.hpp"
#include "host/executors/tuning.hpp"
#include "host/loader/scene_file.hpp"
#include "host/loader/sections.hpp"
#include "host/program/option_values.hpp"
#include "host/reading/key.hpp"
#include "host/session/request.hpp"

namespace eyeray::engine::cli {
namespace {

// An option that lays one value over the scene.
struct ValueOption {
  const char* name;
  const char* value;
  std::string_view section, key;
  const char* text;
};
constexpr std::array value_options = {
    ValueOption{"--spp", "N", "image", "samples", "Samples a pixel"},
    ValueOption{"--exposure", "STOPS", "image", "exposure", "Exposure of a .png"},
    ValueOption{"--tone", "CURVE", "image", "tone", "Tone curve of a .png"},
    ValueOption{"--white-balance", "KELVIN", "image", "white_balance", "Light that a .png shows as white"},
    ValueOption{"--integrator", "NAME", "render", "integrator", "Integrator (docs/scene-reference.md)"},
    ValueOption{"--max-depth", "N", "render", "max_depth",
                "Maximum number of successive reflections and refractions"},
    ValueOption{"--seed", "N", "render", "seed", "Seed of all random numbers"},
    ValueOption{"--triangle", "METHOD", "render", "triangle", "Triangle intersection"}};

const reading::Key& key_of(const ValueOption& option) {
  return *std::ranges::find(loader::find_section(option.section)->keys, option.key, &reading::Key::name);
}

// An option for a mesh alone: the key of its override, and its text.
struct MeshOption {
  const char* name;
  const char* value;
  std::string_view key;
  const char* text;
};
constexpr std::array mesh_options = {
    MeshOption{"--look", "NAME", "look", "How a mesh alone is shown (docs/scene-file.md): {}."},
    MeshOption{"--camera", "NAME", "camera",
               "The camera of a glTF file alone, by its name or its number from 0."},
    MeshOption{"--gltf-scene", "NAME", "gltf_scene",
               "The scene of a glTF file alone, by its name or its number from 0."},
    MeshOption{"--variant", "NAME", "variant",
               "The variant of the materials of a glTF file alone, by its name or its number from 0."},
    MeshOption{"--point-shape", "SHAPE", "point_shape",
               "The shape of the points of a scan alone: sphere, or disk, perpendicular to its normal."},
    MeshOption{
        "--point-size", "X", "point_size",
        "The diameter of the spheres or disks that show the points of a scan alone, in the file's units."},
    MeshOption{"--line-width", "X", "line_width",
               "The diameter of the lines of an OBJ or glTF file alone, in the file's units. Without it, "
               "lines are left "
               "out."},
    MeshOption{"--up", "AXIS", "up",
               "The axis that points up in a mesh file alone: y, z, x, -y, -z or -x. Most scans and CAD "
               "files have z."}};

// The option's text with the allowed values of its key: "Samples a pixel: an integer from 1 to 65536."
std::string description_of(const ValueOption& option) {
  std::string values = describe(key_of(option));
  std::erase(values, '"');
  return fmt::format("{}: {}.", option.text, values);
}

// Warns of files that have an embedded shader's name but lie in another folder: they replace nothing.
void warn_of_misplaced_shaders(const std::filesystem::path& folder) {
  std::error_code error;
  for (const auto& entry : std::filesystem::recursive_directory_iterator(folder, error)) {
    const std::filesystem::path path = entry.path().lexically_relative(folder);
    const EmbeddedFile* namesake = nullptr;
    for (const EmbeddedFile& shader : embedded_shaders()) {
      if (shader.name == path.generic_string()) {
        namesake = nullptr;
        break;
      }
      if (std::filesystem::path(shader.name).filename() == path.filename()) namesake = &shader;
    }
    if (namesake)
      print_lines(stderr, "eyeray: warning: {} replaces no shader; did you mean {}?\n", entry.path().string(),
                  (folder / namesake->name).string());
  }
}

// Sets the sanitizers. Restarts the process, which needs their runtime from its start, unless it has it.
void sanitize(executors::ExecutorOptions& options, const std::string& list) {
  if (list != "address" && list != "undefined" && list != "address,undefined" && list != "undefined,address")
    throw Error(ExitCode::bad_input, "--sanitize must be address, undefined or address,undefined, not '{}'",
                list);
  options.twin.compile = true;
  options.twin.sanitizers = list;
  constexpr const char* prepared = "EYERAY_SANITIZERS";
  if (const char* const done = std::getenv(prepared); done && done == list) return;
  Environment environment = executors::sanitizer_environment(list);
  environment.emplace_back(prepared, list);
  restart(environment);
}

}  // namespace

std::vector<std::string> value_choices(std::string_view name) {
  const auto* const option =
      std::ranges::find_if(value_options, [&](const ValueOption& each) { return each.name == name; });
  if (option == value_options.end()) return {};
  const auto choices = key_of(*option).choices;
  return {choices.begin(), choices.end()};
}

std::pair<int, int> parse_pixel(const std::string& text) {
  int pixel[2];
  if (!parse_integers(text, ',', pixel))
    throw Error(ExitCode::bad_input, "a pixel must be X,Y, such as 320,240, not '{}'", text);
  return {pixel[0], pixel[1]};
}

std::vector<executors::Backend> parse_backends(const std::string& list) {
  std::vector<executors::Backend> backends;
  for (size_t begin = 0; begin <= list.size();) {
    const size_t end = std::min(list.find(',', begin), list.size());
    const executors::Backend backend = executors::parse_backend(list.substr(begin, end - begin));
    begin = end + 1;
    if (std::find(backends.begin(), backends.end(), backend) == backends.end()) backends.push_back(backend);
  }
  return backends;
}

void SceneOptions::add_to(CLI::App& command) {
  const std::string group = "Scene";
  command
      .add_option("SCENE", file_,
                  "The scene file (docs/scene-file.md), or a mesh: .obj, .ply, .stl, .off, .3mf, .gltf, "
                  ".glb, .xyz, .pcd.")
      ->required()
      ->check([](const std::string& file) { return file.empty() ? "must be the name of a file" : ""; });
  const auto add = [&](const char* name, auto& value, const char* text, const std::string& description) {
    return command.add_option(name, value, description)->option_text(text)->group(group);
  };
  add("-D,--define", defines_, "KEY=VALUE",
      "Override a value of the scene: render.max_depth=3, sphere.0.radius=2, camera.eye=[0,1,5]. May be "
      "repeated.")
      ->allow_extra_args(false)
      ->take_all();
  add("--allow-path", trust_.folders, "DIR",
      "A folder outside the scene's own from which the scene may read files. May be repeated.")
      ->allow_extra_args(false)
      ->take_all();
  command
      .add_flag("--no-formulas{false}", trust_.formulas,
                "Refuse a scene with user-defined functions (`code` or `file` of a shape, a texture or a "
                "camera).")
      ->group(group);
  add("-s,--size", size_, "WxH", "Picture size in pixels, such as 640x480.");
  static_assert(std::tuple_size_v<decltype(mesh_values_)> == mesh_options.size());
  for (size_t i = 0; i < mesh_options.size(); ++i) {
    const MeshOption& each = mesh_options[i];
    add(each.name, mesh_values_[i], each.value,
        fmt::format(fmt::runtime(each.text), fmt::join(loader::look_names, ", ")));
  }
  command
      .add_flag("--transparent", transparent_,
                "Give the picture, a .png or an .exr, an alpha in place of its background. A mesh alone then "
                "stands on no floor.")
      ->group(group);
  static_assert(std::tuple_size_v<decltype(values_)> == value_options.size());
  for (size_t i = 0; i < value_options.size(); ++i) {
    const ValueOption& each = value_options[i];
    add(each.name, values_[i], each.value, description_of(each));
  }
}

std::string SceneOptions::as_written() const {
  std::string text;
  for (const std::string& define : defines_) text += " -D " + shell_word(define);
  const auto add = [&](const char* name, const std::string& value) {
    if (!value.empty()) text += fmt::format(" {} {}", name, shell_word(value));
  };
  add("-s", size_);
  for (size_t i = 0; i < mesh_options.size(); ++i) add(mesh_options[i].name, mesh_values_[i]);
  add("--turntable", turntable_);
  if (transparent_) text += " --transparent";
  for (size_t i = 0; i < value_options.size(); ++i) add(value_options[i].name, values_[i]);
  return text;
}

Scene SceneOptions::load() const {
  std::vector<loader::Override> overrides;
  for (const std::string& define : defines_) overrides.push_back({define});
  const auto override_with = [&](std::string_view key, const char* name, const std::string& value) {
    if (!value.empty())
      overrides.push_back({fmt::format("{}={}", key, value), fmt::format("{} {}", name, value)});
  };
  for (size_t i = 0; i < mesh_options.size(); ++i)
    override_with(mesh_options[i].key, mesh_options[i].name, mesh_values_[i]);
  override_with("turntable", "--turntable", turntable_);
  if (!size_.empty()) {
    const auto [width, height] = parse_size(size_);
    overrides.push_back({fmt::format("image.width={}", width), "-s " + size_});
    overrides.push_back({fmt::format("image.height={}", height), "-s " + size_});
  }
  if (transparent_) overrides.push_back({"image.transparent=true", "--transparent"});
  for (size_t i = 0; i < value_options.size(); ++i) {
    const ValueOption& each = value_options[i];
    if (!values_[i].empty())
      overrides.push_back({fmt::format("{}.{}={}", each.section, each.key, values_[i]),
                           fmt::format("{} {}", each.name, values_[i])});
  }

  Scene scene = session::checked(loader::load_scene(file_, overrides, trust_));
  for (const Diagnostic& warning : scene.warnings) print_lines(stderr, "{}\n", format_diagnostic(warning));
  return scene;
}

void add_device_options(CLI::App& command, executors::ExecutorOptions& options) {
  const std::string group = "Device";
  command
      .add_option("--device", options.gpu.device,
                  "The Vulkan device: auto, cpu, gpu, a number, or a part of a name (see eyeray devices).")
      ->option_text("WHICH")
      ->group(group);
  command
      .add_option("--timeout", options.gpu.timeout_seconds, "The longest wait for the device, in seconds.")
      ->option_text(fmt::format("SECONDS={}", options.gpu.timeout_seconds))
      ->group(group)
      ->check(within(0.001, 1e6));
  command
      .add_flag("--fast-math", options.gpu.fast_math,
                "Let the driver contract and re-associate arithmetic. Results are then not bit-exact.")
      ->group(group);
  std::string keys;
  for (const executors::Tuning& each : executors::tunings())
    keys += fmt::format("{}{}", keys.empty() ? "" : ", ", each.key);
  command
      .add_option_function<std::vector<std::string>>(
          "--tune",
          [&options](const std::vector<std::string>& settings) {
            for (const std::string& setting : settings) executors::tune(options, setting);
          },
          fmt::format("Set how kernels are built and find hits, for measurements. May be repeated. Keys: {}; "
                      "docs/tuning.md has their values and effects.",
                      keys))
      ->option_text("KEY=VALUE")
      ->allow_extra_args(false)
      ->take_all()
      ->group(group);
  command
      .add_option("--validate", options.gpu.validation,
                  "Run under the Vulkan validation layer: core or sync.")
      ->option_text("SET")
      ->group(group)
      ->check(one_of({"core", "sync"}));
}

void add_executor_options(CLI::App& command, executors::ExecutorOptions& options) {
  add_device_options(command, options);
  const std::string group = "Device";
  command
      .add_option("--shaders", options.shader_folder,
                  "A folder whose files replace the embedded shaders of the same names (see eyeray shaders "
                  "--export).")
      ->option_text("DIR")
      ->group(group)
      ->check([](const std::string& folder) {
        if (!std::filesystem::is_directory(folder))
          throw Error(ExitCode::file_io, "--shaders {}: no such folder; eyeray shaders --export {} makes one",
                      folder, shell_word(folder));
        warn_of_misplaced_shaders(folder);
        return std::string();
      });
  command
      .add_flag("--compile-twin", options.twin.compile,
                "Compile the twin from --shaders too, with a C++ compiler ($CXX), for debuggers.")
      ->group(group);
  command
      .add_option_function<std::string>(
          "--sanitize", [&options](const std::string& list) { sanitize(options, list); },
          "Compile the twin with sanitizers: address, undefined, or both (address,undefined).")
      ->option_text("LIST")
      ->group(group);
}

void add_backend_option(CLI::App& command, executors::Backend& backend) {
  const auto parse = [&backend](const std::string& name) { backend = executors::parse_backend(name); };
  command
      .add_option_function<std::string>("--backend", parse,
                                        "The executor: gpu, twin (the same shaders as C++ on the CPU), "
                                        "reference (float64, written independently) or emulator (the gpu's "
                                        "kernels on the CPU).")
      ->option_text("NAME=gpu")
      ->group("Device");
}

void add_crop_option(CLI::App& command, Rect& crop) {
  const auto parse = [&crop](const std::string& text) {
    int numbers[4];
    if (!parse_integers(text, ',', numbers))
      throw Error(ExitCode::bad_input, "--crop must be X,Y,W,H in pixels, such as 0,0,64,64, not '{}'", text);
    crop = {numbers[0], numbers[1], numbers[2], numbers[3]};
    if (crop.width < 1 || crop.height < 1)
      throw Error(ExitCode::bad_input, "--crop {} has no pixels: width and height must be at least 1", text);
  };
  command
      .add_option_function<std::string>("--crop", parse,
                                        "Only this rectangle of pixels, counted from the picture's top left.")
      ->option_text("X,Y,W,H")
      ->group("Scene");
}

}  // namespace eyeray::engine::cli
