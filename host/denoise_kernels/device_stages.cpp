#include "host/denoise_kernels/device_stages.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>

#include "host/core/error.hpp"
#include "host/core/termination.hpp"
#include "host/gpu/command_list.hpp"

namespace eyeray::engine::denoise_kernels {
namespace {

using denoise::margin;
using denoise::patch_radius;
using denoise::Planes;

// The most pixels of a tile, so that its distances take some 25 MB.
constexpr int most_columns = 256, most_rows = 128;
constexpr const char* entry = "kernels/denoise.comp.glsl";

static_assert(DENOISE_MARGIN == margin && PATCH_RADIUS == patch_radius && FEATURES == denoise::feature_count);

}  // namespace

DeviceStages::DeviceStages(std::shared_ptr<executors::OpenDevice> device,
                           const executors::ExecutorOptions& options)
    : device_(std::move(device)),
      how_(executors::kernel_options(options.gpu, *device_)),
      files_(options.shader_folder, "") {}

DeviceStages::Stage& DeviceStages::stage(const std::string& defines) {
  for (Stage& made : stages_)
    if (made.defines == defines) return made;
  const auto spirv = times_.measure("compile", [&] {
    try {
      const gpu::ShaderSource source =
          gpu::read_shader([&](std::string_view name) { return files_.read(name); }, entry);
      const std::string define = fmt::format("#define {}\n", defines);
      const auto compile = [&] { return gpu::compile_kernel(source, define, how_, device_->cache()).spirv; };
      return files_.gave_users() ? compile() : of_own_input(compile);
    } catch (const InputError& error) {
      std::vector<Diagnostic> diagnostics = error.diagnostics();
      for (Diagnostic& d : diagnostics) d.position.file = files_.shown(d.position.file);
      throw InputError(std::move(diagnostics));
    }
  });
  constexpr int64_t most_items = int64_t{1} << 24;
  stages_.push_back({defines, times_.measure("compile", [&] { return device_->kernel(spirv, entry); }),
                     gpu::DispatchSize(device_->device().info(), most_items)});
  return stages_.back();
}

gpu::Buffer& DeviceStages::buffer(uint32_t binding, size_t bytes) {
  std::optional<gpu::Buffer>& buffer = buffers_[binding];
  if (!buffer || buffer->size() < bytes) buffer.emplace(device_->device(), bytes, "denoising");
  return *buffer;
}

void DeviceStages::upload(uint32_t binding, const Planes& planes, const Tile& tile) {
  times_.measure("copy", [&] {
    const size_t width = size_t(tile.width) + 2 * margin, height = size_t(tile.height) + 2 * margin;
    std::vector<float> values(width * height * size_t(planes.count()));
    float* to = values.data();
    for (int plane = 0; plane < planes.count(); ++plane)
      for (int y = tile.y - margin; y < tile.y + tile.height + margin; ++y)
        to = std::copy_n(planes.at(plane, tile.x - margin, y), width, to);
    buffer(binding, values.size() * sizeof(float)).upload_records(values);
  });
}

void DeviceStages::read(int first, const Tile& tile, Planes& planes) {
  times_.measure("copy", [&] {
    const size_t pixels = size_t(tile.width) * size_t(tile.height);
    const size_t end = pixels * size_t(first + planes.count());
    const std::span<const std::byte> bytes = buffers_[BINDING_DENOISED]->read(end * sizeof(float));
    const float* from = reinterpret_cast<const float*>(bytes.data()) + pixels * size_t(first);
    for (int plane = 0; plane < planes.count(); ++plane)
      for (int y = tile.y; y < tile.y + tile.height; ++y, from += tile.width)
        std::copy_n(from, tile.width, planes.at(plane, tile.x, y));
  });
}

void DeviceStages::run(const std::string& defines, int columns, int rows, int neighbours) {
  Stage& made = stage(defines);
  for (uint32_t binding = 0; binding < bindings; ++binding)
    if (buffers_[binding]) made.kernel->set_buffer(binding, *buffers_[binding]);
  std::string name = defines.substr(0, defines.find('\n'));
  std::ranges::transform(name, name.begin(), [](char c) { return c == '_' ? ' ' : char(std::tolower(c)); });
  name += step_.radius == denoise::window_radius ? " of colours" : " of features";

  const int groups = (columns * rows + 63) / 64;
  for (int first = 0; first < neighbours;) {
    stop_if_interrupted();
    const int count = std::clamp(int(made.size.items() / (64 * groups)), 1, neighbours - first);
    step_.neighbour = uint32_t(first);
    const gpu::RunTime time =
        gpu::dispatch(device_->device(), *made.kernel, std::as_bytes(std::span(&step_, 1)),
                      {uint32_t(groups), uint32_t(count), 1});
    times_.add("compile", time.compile_seconds);
    times_.add(name, time.seconds);
    made.size.took(int64_t{64} * groups * count, time.seconds);
    first += count;
  }
}

void DeviceStages::compare(const Window& window, const Tile& tile) {
  const int across = 2 * window.radius + 1, neighbours = across * across;
  const int wide = tile.width + 2 * patch_radius, high = tile.height + 2 * patch_radius;
  upload(BINDING_COMPARED, window.compared, tile);
  upload(BINDING_VARIANCES, window.variances, tile);
  upload(BINDING_COUNTING, window.valid, tile);
  upload(BINDING_VALUES, window.values, tile);
  buffer(BINDING_DISTANCES, size_t(neighbours) * size_t(wide) * size_t(high) * sizeof(float));
  buffer(BINDING_ROW_SUMS, size_t(neighbours) * size_t(tile.width) * size_t(high) * sizeof(float));
  step_.width = uint32_t(tile.width);
  step_.height = uint32_t(tile.height);
  step_.radius = uint32_t(window.radius);
  step_.compared = uint32_t(window.compared.count());
  step_.least = window.least;
  run("DIFFERENCES", wide, high, neighbours);
  run("ROW_SUMS", tile.width, high, neighbours);
  run("DISTANCES", tile.width, tile.height, neighbours);
}

template <typename Report, typename Body>
void DeviceStages::for_each_tile(const Planes& planes, const std::string& last, const Report& report,
                                 const Body& body) {
  const int columns = std::min(most_columns, planes.width());
  for (int y = 0; y < planes.height();) {
    int64_t items = stage(last).size.items();
    for (const Stage& each : stages_) items = std::min(items, each.size.items());
    const int wanted = int(items / (columns + 2 * patch_radius)) - 2 * patch_radius;
    const int rows = std::clamp(wanted, 1, std::min(most_rows, planes.height() - y));
    for (int x = 0; x < planes.width(); x += columns)
      body(Tile{x, y, std::min(columns, planes.width() - x), rows});
    y += rows;
    report(double(y) / planes.height());
  }
}

void DeviceStages::average(const denoise::NoisyFeatures& features, Planes& means) {
  const auto report = [&](double share) { report_average(share); };
  for_each_tile(means, "AVERAGE", report, [&](const Tile& tile) {
    buffer(BINDING_DENOISED, size_t(tile.width) * size_t(tile.height) * FEATURES * sizeof(float)).clear();
    const auto add = [&](const Planes& half, const Planes& other) {
      compare({denoise::feature_radius, denoise::feature_variance, other, features.variances, features.valid,
               half},
              tile);
      step_.strictness = 1;
      run("AVERAGE", tile.width, tile.height, 1);
    };
    add(features.halves.first, features.halves.second);
    add(features.halves.second, features.halves.first);
    read(0, tile, means);
  });
}

void DeviceStages::fit(const denoise::NoisyColors& colors, denoise::Halves& careful, denoise::Halves& bold) {
  const int count = colors.colors.first.count();
  const std::string last = fmt::format("FIT\n#define COLORS {}", count);
  const auto report = [&](double share) { report_fit(share); };
  for_each_tile(colors.valid, last, report, [&](const Tile& tile) {
    upload(BINDING_FEATURES, colors.features, tile);
    buffer(BINDING_DENOISED, size_t(tile.width) * size_t(tile.height) * 2 * MOST_COLORS * sizeof(float));
    const auto fit = [&](const Planes& half, const Planes& lights, const Planes& variances, Planes& one,
                         Planes& other) {
      compare({denoise::window_radius, colors.least, lights, variances, colors.valid, half}, tile);
      step_.strictness = denoise::careful_strictness;
      step_.first = 0;
      run(last, tile.width, tile.height, 1);
      step_.strictness = denoise::bold_strictness;
      step_.first = uint32_t(count);
      run(last, tile.width, tile.height, 1);
      read(0, tile, one);
      read(count, tile, other);
    };
    fit(colors.colors.first, colors.lights.second, colors.variances.second, careful.first, bold.first);
    fit(colors.colors.second, colors.lights.first, colors.variances.first, careful.second, bold.second);
  });
}

std::unique_ptr<denoise::Stages> make_stages(std::shared_ptr<executors::OpenDevice> device,
                                             const executors::ExecutorOptions& options) {
  const std::string& wanted = options.gpu.profile.denoise;
  const bool kernels =
      device && (wanted.empty() ? device->device().info().type != gpu::DeviceType::cpu : wanted == "kernels");
  if (kernels) return std::make_unique<DeviceStages>(std::move(device), options);
  return std::make_unique<denoise::ProcessorStages>();
}

}  // namespace eyeray::engine::denoise_kernels
