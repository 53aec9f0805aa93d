// eyeray kernels: a scene's kernels, and the figures that the driver's compiler states of them
// (docs/kernels.md).
#include <CLI/CLI.hpp>
#include <algorithm>
#include <array>
#include <csignal>
#include <cstdlib>
#include <map>
#include <nlohmann/json.hpp>

#include "host/cli/command.hpp"
#include "host/core/atomic_file.hpp"
#include "host/core/escaped_text.hpp"
#include "host/core/json_depth.hpp"
#include "host/core/make_folder.hpp"
#include "host/core/process.hpp"
#include "host/core/standard_streams.hpp"
#include "host/executors/executor.hpp"
#include "host/executors/open_device.hpp"
#include "host/program/json.hpp"

namespace fs = std::filesystem;

namespace eyeray::engine::cli {
namespace {

struct KernelsCommand {
  SceneOptions scene;
  executors::ExecutorOptions executor;
  std::string family;
  std::string spirv_folder;
  std::string old_file;
  bool json = false;

  ExitCode run();
};

// RADV's statistics that the table shows.
struct Column {
  std::string_view title;   // in the table
  std::string_view key;     // in JSON
  std::string_view driver;  // the driver's own name
};
constexpr std::array columns = {Column{"VGPRs", "vgprs", "VGPRs"},
                                Column{"SGPRs", "sgprs", "SGPRs"},
                                Column{"spilled VGPRs", "spilled_vgprs", "Spilled VGPRs"},
                                Column{"spilled SGPRs", "spilled_sgprs", "Spilled SGPRs"},
                                Column{"scratch", "scratch_bytes", "Scratch size"},
                                Column{"waves", "waves", "Subgroups per SIMD"},
                                Column{"instructions", "instructions", "Instructions"},
                                Column{"latency", "latency", "Latency"}};

constexpr const char* null_hardware = "Null hardware";

// The other name of a family that Mesa renamed; "" if there is none.
std::string other_name(const std::string& family) {
  constexpr std::array<std::pair<const char*, const char*>, 3> renamed = {
      {{"gfx1100", "navi31"}, {"gfx1101", "navi32"}, {"gfx1102", "navi33"}}};
  for (const auto& [before, after] : renamed) {
    if (family == before) return after;
    if (family == after) return before;
  }
  return "";
}

// Makes RADV, Mesa's driver for AMD, offer null hardware of a family. Error (bad_input) if it does not know
// the family, (no_device) if the machine has no RADV.
void make_null_hardware(const std::string& family) {
  constexpr const char* variable = "RADV_FORCE_FAMILY";
  for (const std::string& name : {family, other_name(family)}) {
    if (name.empty()) continue;
    // RADV aborts if it does not know the family, so another process tries it.
    const ProcessResult devices = run_process({"/proc/self/exe", "devices"}, {{variable, name}});
    if (devices.code == 128 + SIGABRT) continue;
    if (devices.out.find(null_hardware) == std::string::npos)
      throw Error(ExitCode::no_device,
                  "--family needs RADV, Mesa's Vulkan driver for AMD, but the Vulkan loader finds none: "
                  "install it (Debian: apt install mesa-vulkan-drivers), or add it to VK_DRIVER_FILES if "
                  "that is set");
    setenv(variable, name.c_str(), 1);
    return;
  }
  throw Error(ExitCode::bad_input,
              "--family must be a family of AMD's GPUs that this machine's RADV knows, such as navi21, "
              "gfx1100, vega10 or polaris10, not '{}'",
              family);
}

Json to_json(const gpu::Executable& program) {
  Json statistics = Json::object();
  for (const gpu::Statistic& each : program.statistics) {
    const auto* const column = std::ranges::find(columns, each.name, &Column::driver);
    const std::string key(column == columns.end() ? each.name : column->key);
    std::visit([&](const auto value) { statistics[key] = value; }, each.value);
  }
  return {{"name", program.name}, {"subgroup_size", program.subgroup_size}, {"statistics", statistics}};
}

Json to_json(const executors::MadeKernel& kernel) {
  Json programs = Json::array();
  for (const gpu::Executable& program : kernel.executables) programs.push_back(to_json(program));
  return {{"name", kernel.name},
          {"spirv_bytes", kernel.spirv.size() * sizeof(uint32_t)},
          {"build_seconds", kernel.build_seconds},
          {"programs", programs}};
}

Json to_json(const std::string& scene, const executors::ExecutorFacts& facts) {
  const gpu::DeviceInfo& device = facts.device->device().info();
  Json kernels = Json::array();
  for (const executors::MadeKernel& kernel : facts.kernels) kernels.push_back(to_json(kernel));
  return {{"scene", scene},
          {"device", device.name},
          {"driver", device.driver},
          {"driver_version", device.driver_version},
          {"description", facts.description},
          {"kernels", kernels}};
}

void write_spirv(const fs::path& folder, const std::vector<executors::MadeKernel>& kernels) {
  make_folder(folder);
  for (const executors::MadeKernel& kernel : kernels)
    write_file_atomically(folder / (kernel.name + ".spv"), std::as_bytes(std::span(kernel.spirv)));
}

// Title and JSON key of each statistic in the table: RADV's, as far as the driver has them, or else all.
std::vector<std::pair<std::string, std::string>> statistics_of(const Json& kernels) {
  std::vector<std::string> keys;
  for (const Json& kernel : kernels)
    for (const Json& program : kernel.at("programs"))
      for (const auto& [key, value] : program.at("statistics").items())
        if (std::ranges::find(keys, key) == keys.end()) keys.push_back(key);
  std::vector<std::pair<std::string, std::string>> shown;
  for (const Column& column : columns)
    if (std::ranges::find(keys, column.key) != keys.end()) shown.emplace_back(column.title, column.key);
  if (shown.empty())
    for (const std::string& key : keys) shown.emplace_back(key, key);
  return shown;
}

void print_table(const Json& answer) {
  const Json& kernels = answer.at("kernels");
  const auto statistics = statistics_of(kernels);
  std::vector<std::vector<std::string>> rows(1, {"kernel"});
  for (const auto& [title, key] : statistics) rows[0].push_back(title);
  rows[0].insert(rows[0].end(), {"SPIR-V bytes", "build"});
  for (const Json& kernel : kernels) {
    const auto add = [&](const Json& program) {
      std::vector<std::string>& row = rows.emplace_back(1, kernel.at("name"));
      for (const auto& [title, key] : statistics)
        row.push_back(program.contains(key) ? json_text(program.at(key)) : "");
      row.push_back(json_text(kernel.at("spirv_bytes")));
      row.push_back(fmt::format("{:.2f} s", kernel.at("build_seconds").get<double>()));
    };
    const Json& programs = kernel.at("programs");
    if (programs.empty()) add(Json::object());
    for (const Json& program : programs) add(program.at("statistics"));
  }

  print_lines(stdout, "{}, {}\n", answer.at("scene").get<std::string>(),
              answer.at("description").get<std::string>());
  std::vector<size_t> widths(rows[0].size());
  for (const auto& row : rows)
    for (size_t i = 0; i < row.size(); ++i) widths[i] = std::max(widths[i], row[i].size());
  for (const auto& row : rows) {
    std::string line = fmt::format("{:<{}}", row[0], widths[0]);
    for (size_t i = 1; i < row.size(); ++i) line += fmt::format("  {:>{}}", row[i], widths[i]);
    print_lines(stdout, "{}\n", line);
  }
  if (statistics.empty())
    print_lines(stdout,
                "The driver states no registers, spills or waves: it lacks "
                "VK_KHR_pipeline_executable_properties.\n");
}

using Figures = std::map<std::pair<std::string, std::string>, Json>;  // by kernel and key

// All figures of an answer but the times of builds, which differ each time.
Figures figures_of(const Json& answer) {
  Figures figures;
  for (const Json& kernel : answer.at("kernels")) {
    const std::string name = kernel.at("name");
    figures[{name, "spirv_bytes"}] = kernel.at("spirv_bytes");
    const Json& programs = kernel.at("programs");
    for (size_t i = 0; i < programs.size(); ++i)
      for (const auto& [key, value] : programs.at(i).at("statistics").items())
        figures[{name, i == 0 ? key : fmt::format("{} of program {}", key, i + 1)}] = value;
  }
  return figures;
}

// The figures in a file that has an earlier answer. Error (file_io) if it has none.
Figures read_figures(const std::string& file) {
  const std::string text = read_file(file);
  try {
    return figures_of(Json::parse(unless_too_deep(text)));
  } catch (const Json::exception&) {
    throw Error(ExitCode::file_io, "{}: it is not the output of eyeray kernels --json", file);
  }
}

// The figures that differ: {"kernel", "figure", "old", "new"}. null: one side lacks it.
Json changes_between(const Figures& before, const Figures& after) {
  Figures all = before;
  all.insert(after.begin(), after.end());
  const auto value_in = [](const Figures& figures, const auto& key) {
    const auto found = figures.find(key);
    return found == figures.end() ? Json() : found->second;
  };
  Json changes = Json::array();
  for (const auto& [key, value] : all) {
    const Json was = value_in(before, key), is = value_in(after, key);
    if (was != is)
      changes.push_back({{"kernel", key.first}, {"figure", key.second}, {"old", was}, {"new", is}});
  }
  return changes;
}

void print_changes(const std::string& old_file, const Json& changes) {
  if (changes.empty()) print_lines(stdout, "\nNo figure differs from {}.\n", old_file);
  if (!changes.empty()) print_lines(stdout, "\nThese figures differ from {}:\n", old_file);
  const auto text_of = [](const Json& value) {
    return value.is_null() ? std::string("none") : json_text(value);
  };
  for (const Json& change : changes)
    print_lines(stdout, "  {}: {} {} -> {}\n", change.at("kernel").get<std::string>(),
                change.at("figure").get<std::string>(), text_of(change.at("old")), text_of(change.at("new")));
}

ExitCode KernelsCommand::run() {
  const Figures before = old_file.empty() ? Figures() : read_figures(old_file);
  const Scene loaded = scene.load();
  if (!family.empty()) {
    make_null_hardware(family);
    executor.gpu.device = null_hardware;
  }
  setenv("MESA_SHADER_CACHE_DISABLE", "true", 1);  // so that builds take their full time
  executor.gpu.examines_kernels = true;
  const auto made = executors::make_executor(executors::Backend::gpu, loaded, executor);
  if (!spirv_folder.empty()) write_spirv(spirv_folder, made->facts().kernels);
  Json answer = to_json(scene.file(), made->facts());
  const Json changes = old_file.empty() ? Json::array() : changes_between(before, figures_of(answer));
  if (json) {
    if (!old_file.empty()) answer["changes"] = changes;
    print_json(answer);
  } else {
    print_table(answer);
    if (!old_file.empty()) print_changes(old_file, changes);
  }
  return changes.empty() ? ExitCode::ok : ExitCode::comparison_failed;
}

}  // namespace

void add_kernels(CLI::App& app, Run& run) {
  CLI::App* const command = app.add_subcommand(
      "kernels", "List a scene's kernels, with the registers, spills and waves that the driver states.");
  const auto options = std::make_shared<KernelsCommand>();
  options->scene.add_to(*command);
  command->add_flag("--json", options->json, "Answer as JSON on standard output.");
  command
      ->add_option(
          "--compare", options->old_file,
          "List the figures that differ from this earlier output of --json. Exit code 1 if any does.")
      ->option_text("OLD.json");
  command->add_option("--spirv", options->spirv_folder, "Write each kernel's SPIR-V to DIR/KERNEL.spv.")
      ->option_text("DIR");
  add_executor_options(*command, options->executor);
  command
      ->add_option("--family", options->family,
                   "Compile for an AMD GPU that the machine lacks, by Mesa's RADV: navi21, gfx1100, vega10, "
                   "polaris10 and others.")
      ->option_text("NAME")
      ->excludes("--device")
      ->group("Device");
  command->footer(
      "Example: the effect of a changed shader on a GPU's registers\n"
      "  eyeray kernels scenes/whitted.toml --family navi21 --json > old.json\n"
      "  eyeray kernels scenes/whitted.toml --family navi21 --shaders my-shaders --compare old.json");
  command->callback([options, &run] { run = [options] { return options->run(); }; });
}

}  // namespace eyeray::engine::cli
