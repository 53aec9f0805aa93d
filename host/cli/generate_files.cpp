#include "host/cli/generate_files.hpp"

#include <fmt/ranges.h>

#include <fstream>
#include <nlohmann/json.hpp>

#include "host/cli/command.hpp"
#include "host/core/diagnostic.hpp"
#include "host/core/escaped_text.hpp"
#include "host/core/readable.hpp"
#include "host/core/standard_streams.hpp"
#include "host/core/stopwatch.hpp"
#include "host/generate/ply_file.hpp"
#include "host/program/json.hpp"

namespace fs = std::filesystem;

namespace eyeray::engine::cli {
namespace {

constexpr std::string_view made_by = "Made by eyeray generate";

// Throws Error if `path` cannot be written, or, unless `force`, if it has a file that eyeray generate did not
// make.
void check_target(const fs::path& path, bool force) {
  std::string start(200, '\0');
  std::ifstream file(path, std::ios::binary);
  if (file && !force) {
    file.read(start.data(), std::streamsize(start.size()));
    if (file.gcount() > 0 && start.find(made_by) == std::string::npos)
      throw Error(ExitCode::file_io, "{} exists and was not made by eyeray generate; --force overwrites it",
                  path.string());
  }
  check_writable(path);
}

struct Mesh {
  uint64_t vertices = 0;
  uint64_t triangles = 0;
  uint64_t bytes = 0;
};

Mesh write_mesh(const fs::path& path, const Generated& made) {
  generate::PlyFile file(path, fmt::format("{}: {}", made_by, made.recipe));
  made.mesh(file);
  file.commit();
  return {file.vertices(), file.triangles(), file.bytes()};
}

void report(const GenerateOutput& output, const Generated& made, const Mesh& mesh, uint64_t bytes,
            double seconds) {
  std::vector<Count> counts = made.counts;
  if (made.mesh) counts.push_back({"triangles", mesh.triangles});
  std::vector<std::string> parts;
  for (const auto& [what, number] : counts)
    parts.push_back(fmt::format("{} {}", number, number == 1 ? what.substr(0, what.size() - 1) : what));
  const std::string files = output.scene.string() + (made.mesh ? " and " + output.mesh().string() : "");
  print_lines(stderr, "wrote {}: {}, {:.1f} MB, in {}\n", files, fmt::join(parts, ", "), double(bytes) / 1e6,
              format_seconds(seconds));
  if (!output.json) return;

  Json json{{"scene", output.scene.string()}};
  if (made.mesh) json.update({{"mesh", output.mesh().string()}, {"vertices", mesh.vertices}});
  for (const auto& [what, number] : counts) json[std::string(what)] = number;
  json.update({{"bytes", bytes}, {"seconds", seconds}});
  print_json(json);
}

}  // namespace

void check_triangles(double triangles) {
  if (triangles > double(generate::max_generated_triangles))
    throw Error(ExitCode::bad_input, "the mesh would have {:.0f} triangles; at most {} are allowed",
                triangles, generate::max_generated_triangles);
}

void write_generated(const GenerateOutput& output, bool with_mesh, const std::function<Generated()>& make) {
  const Stopwatch watch;
  if (output.scene.extension() != ".toml")
    throw Error(ExitCode::bad_input, "{}: a scene's name must end in .toml", output.scene.string());
  if (const std::string mesh = output.mesh().filename().string(); with_mesh && printable(mesh) != mesh)
    throw Error(ExitCode::bad_input,
                "{}: the mesh is named after the scene: choose a name in UTF-8, without control characters",
                output.scene.string());
  check_target(output.scene, output.force);
  if (with_mesh) check_target(output.mesh(), output.force);

  const Generated made = make();
  Mesh mesh;
  std::string scene = fmt::format("# {}: {}\n", made_by, made.recipe) + made.scene;
  if (with_mesh) {
    mesh = write_mesh(output.mesh(), made);
    scene += fmt::format("\n[[mesh]]\nfile = {}\n{}", toml_string(output.mesh().filename().string()),
                         made.mesh_keys);
  }
  write_file_atomically(output.scene, scene);
  report(output, made, mesh, mesh.bytes + scene.size(), watch.seconds());
}

}  // namespace eyeray::engine::cli
