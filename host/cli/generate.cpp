// eyeray generate: procedural scenes as files.
#include <fstream>
#include <nlohmann/json.hpp>

#include "cli/command.hpp"
#include "cli/json.hpp"
#include "core/stopwatch.hpp"
#include "generate/ply_file.hpp"
#include "generate/sphereflake.hpp"
#include "generate/terrain.hpp"

namespace fs = std::filesystem;

namespace eyeray::cli {
namespace {

constexpr std::string_view made_by = "Made by eyeray generate";
// Beyond, the spheres' TOML is larger than the loader reads.
constexpr int max_sphereflake_as_spheres = 6;

// What both generators are told.
struct Output {
  fs::path scene;
  bool force = false;
  bool json = false;

  fs::path mesh() const { return fs::path(scene).replace_extension(".ply"); }
};

// What was made, for --json and the last line.
struct Summary {
  uint64_t spheres = 0;
  uint64_t vertices = 0;
  uint64_t triangles = 0;
  uint64_t bytes = 0;  // of all files
};

// Error where `path` cannot be written, or holds what somebody else made.
void check_target(const fs::path& path, bool force) {
  std::string start(200, '\0');
  std::ifstream file(path, std::ios::binary);
  if (file && !force) {
    file.read(start.data(), std::streamsize(start.size()));
    if (file.gcount() > 0 && start.find(made_by) == std::string::npos)
      throw Error(ExitCode::file_io, "{} is there and was not made by eyeray generate; --force overwrites it",
                  path.string());
  }
  check_writable(path);
}

void check_targets(const Output& output, bool with_mesh) {
  if (output.scene.extension() != ".toml")
    throw Error(ExitCode::bad_input, "{}: a scene's name must end in .toml", output.scene.string());
  check_target(output.scene, output.force);
  if (with_mesh) check_target(output.mesh(), output.force);
}

void check_triangles(double triangles) {
  if (triangles > double(max_generated_triangles))
    throw Error(ExitCode::bad_input, "that would be {:.0f} triangles; the most is {}", triangles,
                max_generated_triangles);
}

// A string as TOML writes it.
std::string quoted(const std::string& text) {
  return Json(text).dump();
}

// `recipe` are the words after `eyeray generate` that make the same again.
std::string head(const std::string& recipe) {
  return fmt::format("# {}: {}\n", made_by, recipe);
}

std::string mesh_table(const fs::path& mesh, const std::string& material) {
  return fmt::format("\n[[mesh]]\nfile = {}\nmaterial = {}\n", quoted(mesh.filename().string()),
                     quoted(material));
}

// Writes the mesh that `make` gives, then the scene, so that no scene names a mesh that is not there.
template <typename Make>
Summary write_with_mesh(const Output& output, const std::string& recipe, const std::string& stage,
                        const std::string& material, const Make& make) {
  PlyFile mesh(output.mesh(), fmt::format("{}: {}", made_by, recipe));
  make(mesh);
  mesh.commit();
  const std::string scene = head(recipe) + stage + mesh_table(output.mesh(), material);
  write_file_atomically(output.scene, scene);
  return {0, mesh.vertices(), mesh.triangles(), mesh.bytes() + scene.size()};
}

void report(const Output& output, const Summary& made, double seconds) {
  std::string what;
  if (made.spheres > 0) what += fmt::format("{} spheres", made.spheres);
  if (made.triangles > 0) what += fmt::format("{} triangles", made.triangles);
  const std::string files = output.scene.string() + (made.triangles ? " and " + output.mesh().string() : "");
  fmt::print(stderr, "wrote {}: {}, {:.1f} MB, in {}\n", files, what, double(made.bytes) / 1e6,
             format_seconds(seconds));
  if (!output.json) return;
  Json json{{"scene", output.scene.string()}};
  if (made.triangles > 0) json["mesh"] = output.mesh().string();
  if (made.spheres > 0) json["spheres"] = made.spheres;
  if (made.triangles > 0) json.update({{"vertices", made.vertices}, {"triangles", made.triangles}});
  json.update({{"bytes", made.bytes}, {"seconds", seconds}});
  print_json(json);
}

struct SphereflakeCommand {
  Output output;
  int size_factor = 4;
  int divisions = 0;
  uint64_t triangles = 0;

  ExitCode run() const;
};

ExitCode SphereflakeCommand::run() const {
  const Stopwatch watch;
  const uint64_t count = sphereflake_count(size_factor);
  if (divisions == 0 && triangles == 0) {
    if (size_factor > max_sphereflake_as_spheres)
      throw Error(
          ExitCode::bad_input,
          "size factor {} has {} spheres, more than a scene file holds; the largest as spheres is {}, "
          "--tessellate makes a mesh",
          size_factor, count, max_sphereflake_as_spheres);
    check_targets(output, false);
    const std::string scene = head(fmt::format("sphereflake --size-factor {}", size_factor)) +
                              sphereflake_stage() + sphereflake_spheres(size_factor);
    write_file_atomically(output.scene, scene);
    report(output, {count, 0, 0, scene.size()}, watch.seconds());
    return ExitCode::ok;
  }

  const int edge = divisions > 0 ? divisions : sphereflake_divisions(size_factor, triangles);
  check_triangles(double(sphereflake_triangles(size_factor, 1)) * edge * edge);
  check_targets(output, true);
  const std::string recipe = fmt::format("sphereflake --size-factor {} --tessellate {}", size_factor, edge);
  const Summary made = write_with_mesh(output, recipe, sphereflake_stage(), "ball",
                                       [&](MeshSink& sink) { sphereflake_mesh(size_factor, edge, sink); });
  report(output, made, watch.seconds());
  return ExitCode::ok;
}

struct TerrainCommand {
  Output output;
  TerrainOptions terrain;
  uint64_t triangles = 0;

  ExitCode run();
};

ExitCode TerrainCommand::run() {
  const Stopwatch watch;
  if (triangles > 0) {
    check_triangles(double(triangles));
    terrain.grid = terrain_grid(triangles);
  }
  check_triangles(2.0 * terrain.grid * terrain.grid);
  check_targets(output, true);
  const std::string recipe = fmt::format("terrain --grid {} --seed {} --roughness {}", terrain.grid,
                                         terrain.seed, terrain.roughness);
  const Summary made = write_with_mesh(output, recipe, terrain_stage(), "ground",
                                       [&](MeshSink& sink) { terrain_mesh(terrain, sink); });
  report(output, made, watch.seconds());
  return ExitCode::ok;
}

void add_output(CLI::App& command, Output& output) {
  command.add_option("-o,--output", output.scene, "The scene file; a mesh lies beside it as .ply.")
      ->option_text("FILE.toml")
      ->required();
  command.add_flag("--force", output.force, "Overwrite files that eyeray generate did not make.");
  command.add_flag("--json", output.json, "Answer as JSON on standard output.");
}

void add_sphereflake(CLI::App& generate, Run& run) {
  CLI::App* const command = generate.add_subcommand(
      "sphereflake", "Spheres on spheres: \"balls\" of Haines' procedural databases.");
  const auto options = std::make_shared<SphereflakeCommand>();
  add_output(*command, options->output);
  command->add_option("--size-factor", options->size_factor, "Levels: 4 has 7381 spheres, 5 has 66430.")
      ->option_text("N=4")
      ->check(CLI::Range(1, max_sphereflake));
  CLI::Option* const tessellate =
      command
          ->add_option("--tessellate", options->divisions,
                       "A mesh instead, every sphere an octahedron with edges divided by N: 8 N^2 triangles.")
          ->option_text("N")
          ->check(CLI::Range(1, 8192));
  command->add_option("--triangles", options->triangles, "A mesh instead, of about N triangles in all.")
      ->option_text("N")
      ->check(CLI::PositiveNumber)
      ->excludes(tessellate);
  command->footer("Example: eyeray generate sphereflake -o balls.toml --size-factor 5");
  command->callback([options, &run] { run = [options] { return options->run(); }; });
}

void add_terrain(CLI::App& generate, Run& run) {
  CLI::App* const command = generate.add_subcommand("terrain", "A fractal landscape as a mesh of any size.");
  const auto options = std::make_shared<TerrainCommand>();
  add_output(*command, options->output);
  CLI::Option* const grid =
      command->add_option("--grid", options->terrain.grid, "Cells a side, two triangles each.")
          ->option_text("N=160")
          ->check(CLI::Range(1, max_terrain_grid));
  command->add_option("--triangles", options->triangles, "About so many triangles instead.")
      ->option_text("N")
      ->check(CLI::PositiveNumber)
      ->excludes(grid);
  command->add_option("--seed", options->terrain.seed, "Another number, another landscape.")
      ->option_text("N=0");
  command->add_option("--roughness", options->terrain.roughness, "From 0.2, rolling hills, to 0.6, crags.")
      ->option_text("R=0.48")
      ->check(within(0.2, 0.6));
  command->footer("Example: eyeray generate terrain -o alps.toml --triangles 8000000 --seed 7");
  command->callback([options, &run] { run = [options] { return options->run(); }; });
}

}  // namespace

void add_generate(CLI::App& app, Run& run) {
  CLI::App* const command = app.add_subcommand("generate", "Write a procedural scene, of any size.");
  add_sphereflake(*command, run);
  add_terrain(*command, run);
  command->footer(
      "Each has its own --help, and answers in JSON under --json.\n"
      "Example: eyeray generate terrain -o terrain.toml --triangles 1000000\n"
      "         eyeray generate sphereflake -o balls.toml");
}

}  // namespace eyeray::cli
