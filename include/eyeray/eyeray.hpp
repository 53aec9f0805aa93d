// eyeray as a library: scenes, pictures, and the proof that they are right (docs/library.md).
//
//   eyeray::Renderer renderer;
//   const eyeray::Picture picture = renderer.render(eyeray::Scene::read("scene.toml"));
//   picture.write("picture.png");
//
// Every function may be called from any thread. Each renders on all cores, so calls that work wait for each
// other. Faults of the world are thrown as Error. The process is never ended, no signal is caught, and
// nothing is printed; the environment stays as it is. A broken promise inside eyeray, a bug, calls abort().
#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <initializer_list>
#include <memory>
#include <span>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

#include "eyeray/version.hpp"

#define EYERAY_API __attribute__((visibility("default")))

#ifndef EYERAY_ITSELF  // whose own files have an eyeray::Scene of theirs
namespace eyeray {
inline namespace v0 {}
}  // namespace eyeray
#endif

namespace eyeray::v0 {

// "0.1.0", of the library that runs; EYERAY_VERSION is that of this header. By semver.org: while it begins
// with 0, what differs before the second point may be incompatible.
EYERAY_API std::string_view version() noexcept;

// ---- Errors

// What is wrong, or doubtful, and where: scene.toml:12:5. Lines and columns count from 1; 0 where unknown.
struct Diagnostic {
  bool is_error = true;  // else a warning
  std::string file;
  int line = 0;
  int column = 0;
  std::string message;
};

enum class ErrorKind {
  bad_input,  // a scene, a shader, an option
  no_device,  // no usable Vulkan device, or it was lost; or no memory
  file_io,
  timed_out,  // the device, longer than RendererOptions::timeout_seconds
  cancelled,  // by a Cancellation or by Progress
};

// what() is for people: one sentence, or of a scene all its diagnostics, each with the line and a caret.
class EYERAY_API Error : public std::runtime_error {
 public:
  Error(ErrorKind kind, const std::string& what, std::vector<Diagnostic> diagnostics = {});
  ~Error() override;
  ErrorKind kind() const noexcept { return kind_; }
  // All that is wrong with a scene or a shader, in the order of the file; else empty.
  const std::vector<Diagnostic>& diagnostics() const noexcept { return *diagnostics_; }

 private:
  ErrorKind kind_;
  std::shared_ptr<const std::vector<Diagnostic>> diagnostics_;
};

// ---- Scenes

struct SceneOptions {
  // "render.max_depth=3", "sphere.0.radius=2": laid over the scene, as -D of the command line.
  std::vector<std::string> defines = {};
  // Beside the folder of the scene's file, where it may read from; with all below.
  std::vector<std::filesystem::path> allowed_folders = {};
  // Whether it may bring functions of its own ([[implicit]] with `code` or `file`).
  bool formulas = true;
};

// Triangles from memory. Each span must be as long as the others make it; an Error (bad_input) says where
// not, and what is wrong with the values (NaN, an index out of range, no area …).
struct MeshArrays {
  std::span<const float> positions;     // x, y, z a vertex
  std::span<const uint32_t> triangles;  // three vertices each, counter-clockwise seen from outside
  std::span<const float> normals = {};  // x, y, z a vertex, or none: smooth up to 40° between faces
  std::span<const float> uv = {};       // two a vertex, or none
};

class SceneBuilder;

// A scene, checked. Copies share it: it never changes.
class EYERAY_API Scene {
 public:
  // From a file: .toml, or a mesh (.obj .ply .gltf .glb). Error: file_io, or bad_input with every
  // diagnostic.
  static Scene read(const std::filesystem::path& file, const SceneOptions& options = {});
  // From text, as a file holds it; `name` stands in diagnostics. It can name no files but include none.
  static Scene parse(std::string_view toml, const std::string& name = "scene",
                     const SceneOptions& options = {});

  int width() const noexcept;  // of the picture, in pixels
  int height() const noexcept;
  int samples() const noexcept;  // a pixel
  const std::vector<Diagnostic>& warnings() const noexcept;

  struct Data;  // the engine's
  explicit Scene(std::shared_ptr<const Data> data) : data_(std::move(data)) {}
  const Data& data() const noexcept { return *data_; }

 private:
  std::shared_ptr<const Data> data_;
};

class Table;

// What a key of a scene can be; kept as the TOML that it is.
class EYERAY_API Value {
 public:
  Value(bool value);  // NOLINT: `set("two_sided", true)` is what this is for
  Value(int value);
  Value(int64_t value);
  Value(double value);
  Value(const char* value);
  Value(const std::string& value);
  Value(std::initializer_list<Value> list);  // {0, 1, 5}
  Value(const std::vector<Value>& list);
  Value(const Table& table);
  const std::string& toml() const noexcept { return toml_; }

 private:
  std::string toml_;
};

// A table of a scene: keys and values, in the order in which they were set. docs/scene-reference.md lists
// them.
class EYERAY_API Table {
 public:
  Table& set(const std::string& key, const Value& value);  // *this
  const std::vector<std::pair<std::string, Value>>& entries() const noexcept { return entries_; }

 private:
  std::vector<std::pair<std::string, Value>> entries_;
};

// A scene built in code, of the same tables as a file has:
//
//   eyeray::SceneBuilder builder;
//   builder.set("camera", eyeray::Table().set("eye", {0, 1, 5}).set("target", {0, 1, 0}));
//   builder.add("sphere", eyeray::Table().set("center", {0, 1, 0}).set("radius", 1));
//   const eyeray::Scene scene = builder.scene();
class EYERAY_API SceneBuilder {
 public:
  SceneBuilder();
  ~SceneBuilder();
  SceneBuilder(SceneBuilder&&) noexcept;
  SceneBuilder& operator=(SceneBuilder&&) noexcept;

  SceneBuilder& set(const std::string& section, const Table& table);  // [section], once
  SceneBuilder& add(const std::string& section, const Table& table);  // another [[section]]
  // Another [[mesh]] of these triangles, which are copied; `table` may have its other keys (material,
  // transform, smooth, name). Error (bad_input) where the spans are of wrong length.
  SceneBuilder& add_mesh(const MeshArrays& arrays, const Table& table = {});

  // The TOML, whose lines diagnostics count; meshes stand in it as "mesh-0.ply", "mesh-1.ply" …
  std::string text() const;
  // Error (bad_input) as Scene::parse.
  Scene scene(const std::string& name = "scene built in code", const SceneOptions& options = {}) const;

 private:
  struct Data;
  std::unique_ptr<Data> data_;
};

// ---- Pictures

// A part of a picture in pixels, from its top left; without width all of it.
struct Rect {
  int x = 0, y = 0, width = 0, height = 0;
};

// A picture's values: row by row from the top, in a row from the left, the channels of a pixel together:
// values[(y * width + x) * channels + c].
struct Plane {
  std::span<const float> values;
  int width = 0, height = 0;
  int channels = 0;  // 1 or 3
};

// Copies share the pixels, which never change; spans are valid as long as one copy lives.
class EYERAY_API Picture {
 public:
  // Linear RGB, unclipped: the mean of a pixel's samples. Of a render that was cancelled before every pixel
  // had one it is empty.
  Plane color() const;
  // What was asked for in RenderOptions::aovs: their names, and each. `depth` in units of the scene along
  // the ray, infinity where nothing is hit; `position` and normals in the world; ids and counts as whole
  // numbers, −1 where nothing is hit. docs/command-line.md says what each holds. Error (bad_input) for one
  // that it has not, as after a cancellation.
  std::vector<std::string> aovs() const;
  Plane aov(std::string_view name) const;

  int samples_done() const noexcept;  // that every pixel has
  bool complete() const noexcept;     // not cancelled
  uint64_t rays() const noexcept;     // eye, reflected, refracted and shadow rays
  double seconds() const noexcept;    // of all of render()
  double sampling_seconds() const noexcept;
  // What `eyeray render` warns of: pixels that may be wrong, noise that is left, what clamp did, samples that
  // are far brighter than others, a model that is hardly seen; and of a renderer's first picture, that a
  // cache is not used since others could have changed it. They name no file.
  const std::vector<Diagnostic>& warnings() const noexcept;

  // The colours as .png (sRGB, with the scene's exposure and tone curve), .pfm, .hdr or .exr (linear
  // float). Error: bad_input for another ending or an empty picture, file_io. No half-written file bears
  // the name.
  void write(const std::filesystem::path& file) const;

  struct Data;
  explicit Picture(std::shared_ptr<const Data> data) : data_(std::move(data)) {}

 private:
  std::shared_ptr<const Data> data_;
};

struct Progress {
  double share = 0;    // of the samples, from 0 to 1
  uint64_t rays = 0;   // traced so far
  double seconds = 0;  // since sampling began
};

// Asks a call to end soon; from any thread. Copies are the same request. The device finishes what it has
// been given, some 50 ms of work, and a kernel that its driver compiles, up to seconds.
class EYERAY_API Cancellation {
 public:
  Cancellation();
  void request() noexcept;
  bool requested() const noexcept;

  struct Data;
  Data& data() const noexcept { return *data_; }

 private:
  std::shared_ptr<Data> data_;
};

enum class Backend {
  gpu,        // the shaders, on a Vulkan device
  twin,       // the same shaders, compiled as C++: the same bits, and no device
  reference,  // float64, written independently
};

struct RenderOptions {
  Backend backend = Backend::gpu;
  std::vector<std::string> aovs = {};  // "depth", "normal" …, or "all"
  Rect crop = {};
  double noise = 0;  // above 0: samples are taken until pixels are off by no more than this share of their
                     // brightness, and the scene's number is the most
  double clamp = 0;  // above 0: samples are cut to it, which makes a darker picture without bright dots
  // Called by the thread that called render(), a few times a second; false cancels. What it throws goes to
  // render()'s caller.
  std::function<bool(const Progress&)> progress = {};
  Cancellation cancellation = {};
};

// ---- The proof

struct VerifyOptions {
  std::vector<Backend> backends = {Backend::gpu, Backend::twin};  // compared with the reference
  Rect crop = {};
  std::filesystem::path evidence = {};  // a folder for pictures when a gate fails; empty: none are kept
  std::function<bool(const Progress&)> progress = {};  // as of render(), for each backend in turn
  Cancellation cancellation = {};
};

// What `eyeray verify` finds (docs/verification.md).
struct Report {
  bool passed = false;
  std::vector<std::string> failures;  // a sentence each
  std::string text;                   // for people, lines
  std::string json;                   // for programs
};

// ---- The renderer

struct RendererOptions {
  std::string device = "auto";         // auto, cpu, gpu, a number, or a part of a name (`eyeray devices`)
  std::filesystem::path shaders = {};  // a folder laid over the shaders inside, file by file
  double timeout_seconds = 60;         // the longest wait for the device
};

// Keeps the device open and its last kernels built, so that a second picture starts at once. Opens it when
// the backend gpu is first used.
class EYERAY_API Renderer {
 public:
  explicit Renderer(const RendererOptions& options = {});
  ~Renderer();
  Renderer(Renderer&&) noexcept;
  Renderer& operator=(Renderer&&) noexcept;

  // A cancelled render returns what it has, a whole picture with fewer samples, or an empty one. Error:
  // bad_input for options that the scene or the picture does not go with, no_device, timed_out.
  Picture render(const Scene& scene, const RenderOptions& options = {});
  // Renders by each backend and the reference, and compares. Error (cancelled) when cancelled; else as
  // render().
  Report verify(const Scene& scene, const VerifyOptions& options = {});

  struct Data;

 private:
  std::unique_ptr<Data> data_;
};

}  // namespace eyeray::v0
