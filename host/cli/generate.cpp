// eyeray generate: procedural scenes as files.
#include "host/cli/command.hpp"
#include "host/cli/generate_files.hpp"
#include "host/generate/sphereflake.hpp"
#include "host/generate/studio.hpp"
#include "host/generate/terrain.hpp"
#include "host/image/image_file.hpp"
#include "host/program/option_values.hpp"

namespace eyeray::engine::cli {
namespace {

// The largest size factor whose TOML of spheres the loader can still read.
constexpr int max_sphereflake_as_spheres = 6;

struct SphereflakeCommand {
  GenerateOutput output;
  int size_factor = 4;
  int divisions = 0;
  uint64_t triangles = 0;

  ExitCode run() const;
};

ExitCode SphereflakeCommand::run() const {
  const uint64_t count = generate::sphereflake_count(size_factor);
  if (divisions == 0 && triangles == 0) {
    if (size_factor > max_sphereflake_as_spheres)
      throw Error(ExitCode::bad_input,
                  "size factor {} makes {} spheres, too many for a scene file; the largest size factor is "
                  "{}, or let --tessellate make a mesh",
                  size_factor, count, max_sphereflake_as_spheres);
    write_generated(output, false, [&] {
      return Generated{.recipe = fmt::format("sphereflake --size-factor {}", size_factor),
                       .counts = {{"spheres", count}},
                       .scene = generate::sphereflake_stage() + generate::sphereflake_spheres(size_factor)};
    });
    return ExitCode::ok;
  }

  const int edge = divisions > 0 ? divisions : generate::sphereflake_divisions(size_factor, triangles);
  check_triangles(double(generate::sphereflake_triangles(size_factor, 1)) * edge * edge);
  write_generated(output, true, [&] {
    return Generated{
        .recipe = fmt::format("sphereflake --size-factor {} --tessellate {}", size_factor, edge),
        .scene = generate::sphereflake_stage(),
        .mesh = [&](generate::MeshSink& sink) { generate::sphereflake_mesh(size_factor, edge, sink); },
        .mesh_keys = "material = \"ball\"\n"};
  });
  return ExitCode::ok;
}

struct TerrainCommand {
  GenerateOutput output;
  generate::TerrainOptions terrain;
  uint64_t triangles = 0;

  ExitCode run();
};

ExitCode TerrainCommand::run() {
  if (triangles > 0) terrain.grid = generate::terrain_grid(triangles);
  check_triangles(2.0 * terrain.grid * terrain.grid);
  write_generated(output, true, [&] {
    return Generated{.recipe = fmt::format("terrain --grid {} --seed {} --roughness {}", terrain.grid,
                                           terrain.seed, terrain.roughness),
                     .scene = generate::terrain_stage(),
                     .mesh = [&](generate::MeshSink& sink) { generate::terrain_mesh(terrain, sink); },
                     .mesh_keys = "material = \"ground\"\n"};
  });
  return ExitCode::ok;
}

void add_output(CLI::App& command, GenerateOutput& output) {
  command.add_option("-o,--output", output.scene, "The scene file. A mesh is written beside it, as .ply.")
      ->option_text("FILE.toml")
      ->required();
  command.add_flag("--force", output.force, "Overwrite files that eyeray generate did not make.");
  command.add_flag("--json", output.json, "Answer as JSON on standard output.");
}

void add_sphereflake(CLI::App& generate, Run& run) {
  CLI::App* const command = generate.add_subcommand(
      "sphereflake", "Spheres on spheres: \"balls\" of Haines' procedural databases.");
  command->alias("balls");
  const auto options = std::make_shared<SphereflakeCommand>();
  add_output(*command, options->output);
  command->add_option("--size-factor", options->size_factor, "Levels: 4 has 7381 spheres, 5 has 66430.")
      ->option_text("N=4")
      ->check(whole_within(1, generate::max_sphereflake));
  CLI::Option* const tessellate =
      command
          ->add_option(
              "--tessellate", options->divisions,
              "Make a mesh: each sphere is an octahedron whose edges are divided by N, with 8 N^2 triangles.")
          ->option_text("N")
          ->check(whole_within(1, 8192));
  command->add_option("--triangles", options->triangles, "Make a mesh of about N triangles in all.")
      ->option_text("N")
      ->check(whole_within(1, int64_t(generate::max_generated_triangles)))
      ->excludes(tessellate);
  command->footer("Example: eyeray generate sphereflake -o balls.toml --size-factor 5");
  command->callback([options, &run] { run = [options] { return options->run(); }; });
}

void add_terrain(CLI::App& generate, Run& run) {
  CLI::App* const command = generate.add_subcommand("terrain", "A fractal landscape as a mesh of any size.");
  const auto options = std::make_shared<TerrainCommand>();
  add_output(*command, options->output);
  CLI::Option* const grid = command
                                ->add_option("--grid", options->terrain.grid,
                                             "The number of cells along each side. A cell has two triangles.")
                                ->option_text("N=160")
                                ->check(whole_within(1, generate::max_terrain_grid));
  command->add_option("--triangles", options->triangles, "Make about N triangles.")
      ->option_text("N")
      ->check(whole_within(1, int64_t(generate::max_generated_triangles)))
      ->excludes(grid);
  command->add_option("--seed", options->terrain.seed, "The seed of the landscape.")
      ->option_text("N=0")
      ->check(whole_within(0, std::numeric_limits<uint32_t>::max()));
  command
      ->add_option("--roughness", options->terrain.roughness,
                   "Roughness, from 0.2 for rolling hills to 0.6 for crags.")
      ->option_text("R=0.48")
      ->check(within(0.2, 0.6));
  command->footer("Example: eyeray generate terrain -o alps.toml --triangles 8000000 --seed 7");
  command->callback([options, &run] { run = [options] { return options->run(); }; });
}

void add_studio(CLI::App& generate, Run& run) {
  struct Options {
    std::filesystem::path picture;
    int width = 1024;
  };
  CLI::App* const command =
      generate.add_subcommand("studio", "A picture of light from all directions, for [environment].");
  const auto options = std::make_shared<Options>();
  command->add_option("-o,--output", options->picture, "The picture.")
      ->option_text("FILE.hdr|.exr|.pfm")
      ->required();
  command->add_option("--width", options->width, "The width in pixels. The height is half of it.")
      ->option_text("N=1024")
      ->check(whole_within(2, generate::most_studio_width));
  command->footer("Example: eyeray generate studio -o studio.hdr");
  command->callback([options, &run] {
    run = [options] {
      image::write_image(options->picture, generate::studio(options->width));
      return ExitCode::ok;
    };
  });
}

}  // namespace

void add_generate(CLI::App& app, Run& run) {
  CLI::App* const command = app.add_subcommand("generate", "Write a procedural scene, of any size.");
  add_sphereflake(*command, run);
  add_terrain(*command, run);
  add_studio(*command, run);
  command->footer(
      "Each has its own --help, and answers in JSON under --json.\n"
      "Example: eyeray generate terrain -o terrain.toml --triangles 1000000\n"
      "         eyeray generate sphereflake -o balls.toml");
}

}  // namespace eyeray::engine::cli
