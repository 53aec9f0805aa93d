// eyeray as a library: scenes, pictures, and the proof that they are right (docs/library.md).
//
//   eyeray::Renderer renderer;
//   const eyeray::Picture picture = renderer.render(eyeray::Scene::read("scene.toml"));
//   picture.write("picture.png");
//
// Any thread may call any function. A call that renders uses all cores, so such calls wait for each other.
// Functions throw Error for faults of the world: a file, a scene, a device. The library never ends the
// process, catches no signal, prints nothing, and leaves the environment as it is. A broken promise inside
// eyeray, which is a bug, calls abort().
#pragma once

#include <concepts>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <initializer_list>
#include <memory>
#include <span>
#include <stdexcept>
#include <string>
#include <string_view>
#include <type_traits>
#include <utility>
#include <vector>

#include "eyeray/version.hpp"

#define EYERAY_API [[gnu::visibility("default")]]

namespace eyeray::inline v0 {

// The version of the library that runs, as "0.1.0"; EYERAY_VERSION is the header's. Versions follow
// semver.org: while the first number is 0, another second number may break programs.
[[nodiscard]] EYERAY_API std::string_view version() noexcept;

// ---- Errors

// An error or a warning, and its position: scene.toml:12:5. Lines and columns count from 1; 0 is unknown.
struct Diagnostic {
  bool is_error = true;  // false: a warning
  std::string file;
  int line = 0;
  int column = 0;
  std::string message;
};

enum class ErrorKind {
  bad_input,  // a scene, a shader or an option is wrong
  no_device,  // there is no usable Vulkan device, it was lost, or memory ran out
  file_io,    // a file cannot be read or written
  timed_out,  // the device took longer than RendererOptions::timeout_seconds
  cancelled,  // a Cancellation or a progress function ended the call
  internal,   // eyeray has a bug
};

// `what()` is text for people: one sentence, or all diagnostics of a scene, each with its line and a caret.
class EYERAY_API Error : public std::runtime_error {
 public:
  Error(ErrorKind kind, const std::string& what, std::vector<Diagnostic> diagnostics = {});
  ~Error() override;
  ErrorKind kind() const noexcept { return kind_; }
  // Every fault of a scene or a shader, in the order of the file. Other errors have none.
  const std::vector<Diagnostic>& diagnostics() const noexcept { return *diagnostics_; }

 private:
  ErrorKind kind_;
  std::shared_ptr<const std::vector<Diagnostic>> diagnostics_;
};

// ---- Scenes

struct SceneOptions {
  // Values laid over the scene, as -D of the command line: "render.max_depth=3", "sphere.0.radius=2".
  std::vector<std::string> defines = {};
  // Folder trees that the scene may read from, beside the tree of its own file.
  std::vector<std::filesystem::path> allowed_folders = {};
  // Accept a scene with user-defined functions ([[implicit]] with `code` or `file`).
  bool formulas = true;
};

// Triangles from memory. Spans whose lengths disagree are an Error (bad_input), as are values that no mesh
// can have: NaN, an index out of range, a triangle without area.
struct MeshArrays {
  std::span<const float> positions;     // x, y, z of each vertex
  std::span<const uint32_t> triangles;  // three vertices each, counter-clockwise seen from outside
  std::span<const float> normals = {};  // x, y, z of each vertex; empty: smooth up to 40° between faces
  std::span<const float> uv = {};       // u, v of each vertex; empty: the mesh has none
};

class Renderer;

// A checked scene. It never changes, and copies share it.
class [[nodiscard]] EYERAY_API Scene {
 public:
  // Reads a file: .toml, or a mesh (.obj .ply .stl .off .3mf .gltf .glb .xyz .pcd). Error: file_io, or
  // bad_input with every diagnostic.
  static Scene read(const std::filesystem::path& file, const SceneOptions& options = {});
  // Reads the text of a scene file; diagnostics call it `name`. Such a scene cannot name other files.
  static Scene parse(std::string_view toml, std::string_view name = "scene",
                     const SceneOptions& options = {});

  int width() const noexcept;  // width of the picture, in pixels
  int height() const noexcept;
  int samples() const noexcept;  // a pixel
  const std::vector<Diagnostic>& warnings() const noexcept;

  struct Data;  // the engine's

 private:
  friend class Renderer;
  explicit Scene(std::shared_ptr<const Data> data) : data_(std::move(data)) {}
  const Data& data() const noexcept { return *data_; }

  std::shared_ptr<const Data> data_;
};

class Table;

// An integer of up to 64 bits or a floating-point number. bool and the character types are excluded.
template <typename T>
concept SceneNumber = std::floating_point<T> ||
                      (std::integral<T> && sizeof(T) <= 8 && !std::same_as<T, bool> &&
                       !std::same_as<T, char> && !std::same_as<T, wchar_t> && !std::same_as<T, char8_t> &&
                       !std::same_as<T, char16_t> && !std::same_as<T, char32_t>);

// The value of a scene's key: a truth value, a number, a text, a list or a table. Each of these converts to a
// Value, as in `set("two_sided", true)`. A Value holds TOML.
class EYERAY_API Value {
 public:
  // A template, since pointers would convert to bool.
  template <std::same_as<bool> Bool>
  Value(Bool value) : toml_(value ? "true" : "false") {}
  // Error (bad_input) above 2^63 − 1, which TOML cannot hold.
  template <SceneNumber T>
  Value(T value) : toml_(number(value)) {}
  template <std::convertible_to<std::string_view> Text>
  Value(const Text& text) : toml_(quoted(text)) {}
  Value(std::nullptr_t) = delete;
  Value(std::initializer_list<Value> list);  // {0, 1, 5}
  Value(const std::vector<Value>& list);
  Value(const Table& table);
  const std::string& toml() const noexcept { return toml_; }

 private:
  template <SceneNumber T>
  static std::string number(T value) {
    if constexpr (std::floating_point<T>)
      return of_floating(double(value));
    else if constexpr (std::is_signed_v<T>)
      return of_signed(value);
    else
      return of_unsigned(value);
  }
  static std::string of_floating(double value);
  static std::string of_signed(int64_t value);
  static std::string of_unsigned(uint64_t value);
  static std::string quoted(std::string_view text);

  std::string toml_;
};

// A table of a scene: keys and their values, in the order in which they were set. docs/scene-reference.md
// lists all keys.
class EYERAY_API Table {
 public:
  Table& set(std::string_view key, const Value& value);  // returns *this
  const std::vector<std::pair<std::string, Value>>& entries() const noexcept { return entries_; }

 private:
  std::vector<std::pair<std::string, Value>> entries_;
};

// Builds a scene in code, from the tables that a scene file has:
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

  SceneBuilder& set(std::string_view section, const Table& table);  // [section], once
  SceneBuilder& add(std::string_view section, const Table& table);  // another [[section]]
  // Adds a [[mesh]] of these triangles, which it copies. `table` has the other keys: material, transform,
  // smooth, name. Error (bad_input) for spans of wrong length.
  SceneBuilder& add_mesh(const MeshArrays& arrays, const Table& table = {});

  // The TOML to which the lines of diagnostics refer. It names meshes "mesh-0.ply", "mesh-1.ply" …
  [[nodiscard]] std::string text() const;
  // Error (bad_input) as Scene::parse.
  Scene scene(std::string_view name = "scene built in code", const SceneOptions& options = {}) const;

 private:
  struct Data;
  std::unique_ptr<Data> data_;
};

// ---- Pictures

// A part of a picture in pixels, from its top left. Without width and height it is the whole picture.
struct Rect {
  int x = 0, y = 0, width = 0, height = 0;
};

// A picture's values: rows from the top, pixels from the left, the channels of a pixel together. Channel c
// of pixel x, y is values[(y * width + x) * channels + c].
struct [[nodiscard]] Plane {
  std::span<const float> values;
  int width = 0, height = 0;
  int channels = 0;  // 1 or 3, or 4 with an alpha
};

// The pixels never change, and copies share them. A span is valid as long as a copy of the picture lives.
class [[nodiscard]] EYERAY_API Picture {
 public:
  // Linear RGB, unclipped: the mean of a pixel's samples. It is empty if the render was cancelled before
  // every pixel had a sample. If the scene is transparent, an alpha from 0 to 1 follows, by which the colours
  // are multiplied.
  Plane color() const;
  // The names of the AOVs that RenderOptions::aovs requested, and the values of one. `depth` is the distance
  // along the ray in units of the scene, infinity without a hit. `position` and normals are in the world's
  // frame. Ids and counts are whole numbers, −1 without a hit. docs/command-line.md describes each. Error
  // (bad_input) for an AOV that the picture lacks, as it may after a cancellation.
  [[nodiscard]] std::vector<std::string> aovs() const;
  Plane aov(std::string_view name) const;

  int samples_done() const noexcept;  // samples that every pixel has
  bool complete() const noexcept;     // false: it was cancelled
  uint64_t rays() const noexcept;     // camera, reflected, refracted and shadow rays
  double seconds() const noexcept;    // the duration of render()
  double sampling_seconds() const noexcept;
  // The warnings of `eyeray render`: pixels that may be wrong, noise that is left, values that clamp cut,
  // samples far brighter than others, a model that is hardly visible. A renderer's first picture also warns
  // of a cache that is not used because other users could have changed it. Warnings name no file.
  const std::vector<Diagnostic>& warnings() const noexcept;

  // The colours for a screen: sRGB, 8 bits a channel, with the scene's exposure and tone curve. Rows, pixels
  // and channels lie as in color(). With an alpha, colours are not multiplied by it.
  [[nodiscard]] std::vector<uint8_t> tonemapped() const;
  // The bytes of a .png of these colours. Error (bad_input) for an empty picture.
  [[nodiscard]] std::string png() const;
  // Writes that .png, or the linear colours as .pfm, .hdr or .exr. Error: bad_input for another ending, for
  // an empty picture, or for an alpha in a .pfm or .hdr; or file_io. A file under that name is always whole.
  void write(const std::filesystem::path& file) const;

  struct Data;  // the engine's

 private:
  friend class Renderer;
  explicit Picture(std::shared_ptr<const Data> data) : data_(std::move(data)) {}

  std::shared_ptr<const Data> data_;
};

struct Progress {
  double share = 0;    // the share of samples that are done, from 0 to 1
  uint64_t rays = 0;   // rays traced so far
  double seconds = 0;  // since sampling began
};

// Requests that a call end soon; any thread may do so. Copies are the same request. The call waits until the
// device has finished its current work, about 50 ms, and until its driver has finished compiling a kernel, up
// to seconds.
class EYERAY_API Cancellation {
 public:
  Cancellation();
  void request() noexcept;
  [[nodiscard]] bool requested() const noexcept;

  struct Data;  // the engine's
  Data& data() const noexcept { return *data_; }

 private:
  std::shared_ptr<Data> data_;
};

enum class Backend {
  gpu,        // the shaders on a Vulkan device
  twin,       // the same shaders compiled as C++: the same bits without a device
  reference,  // a renderer in float64, written independently
};

enum class Denoiser {
  own,                 // eyeray's, which keeps the mean brightness
  open_image_denoise,  // Intel's library, if it is installed
};

struct RenderOptions {
  Backend backend = Backend::gpu;
  std::vector<std::string> aovs = {};  // "depth", "normal" …, or "all"
  Rect crop = {};
  // Above 0: a pixel takes samples until its error is at most this share of its brightness, after denoising
  // if `denoise` is set. The scene's number of samples is the maximum.
  double noise = 0;
  // Above 0: samples are cut to this value, which removes bright dots and makes the picture darker.
  double clamp = 0;
  // Leaves out rare samples that are far brighter than all around, which makes the picture darker.
  bool reject_fireflies = false;
  // Removes the noise of random paths from the finished picture. `denoise` in the scene's [render] does the
  // same.
  bool denoise = false;
  Denoiser denoiser = Denoiser::own;
  // The thread that called render() calls this a few times a second. The function returns false to
  // cancel. Its exceptions reach the caller of render().
  std::function<bool(const Progress&)> progress = {};
  Cancellation cancellation = {};
};

// ---- The proof

struct VerifyOptions {
  std::vector<Backend> backends = {Backend::gpu, Backend::twin};  // compared with the reference
  Rect crop = {};
  std::filesystem::path evidence = {};  // the folder for pictures of a failed gate; empty: keep none
  std::function<bool(const Progress&)> progress = {};  // as render() calls it, for each backend in turn
  Cancellation cancellation = {};
};

// The findings of `eyeray verify` (docs/report.md).
struct [[nodiscard]] Report {
  bool passed = false;
  std::vector<std::string> failures;  // a sentence each
  std::string text;                   // lines for people
  std::string json;                   // the same for programs
};

// ---- The renderer

struct RendererOptions {
  std::string device = "auto";         // auto, cpu, gpu, a number, or a part of a name (`eyeray devices`)
  std::filesystem::path shaders = {};  // a folder laid over the embedded shaders, file by file
  double timeout_seconds = 60;         // the longest wait for the device
};

// Keeps the device open and its last kernels built, so that a second picture starts at once. The first use
// of the backend gpu opens the device.
class EYERAY_API Renderer {
 public:
  // Error: bad_input, file_io, and no_device where no usable device is the one that `device` selects; with
  // "auto" only the first use finds that.
  explicit Renderer(const RendererOptions& options = {});
  ~Renderer();
  Renderer(Renderer&&) noexcept;
  Renderer& operator=(Renderer&&) noexcept;

  // A cancelled render returns a whole picture with fewer samples, or an empty one. Error: bad_input for
  // options that do not suit the scene, no_device, timed_out.
  Picture render(const Scene& scene, const RenderOptions& options = {});
  // Renders with each backend and the reference, and compares the pictures. Errors as render()'s, and
  // cancelled.
  Report verify(const Scene& scene, const VerifyOptions& options = {});

  struct Data;

 private:
  std::unique_ptr<Data> data_;
};

}  // namespace eyeray::inline v0
