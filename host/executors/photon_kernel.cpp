#include "host/executors/photon_kernel.hpp"

#include <algorithm>

#include "host/core/error.hpp"
#include "host/core/termination.hpp"
#include "host/executors/samples.hpp"
#include "host/executors/tile_size.hpp"
#include "host/gpu/command_list.hpp"

namespace eyeray::engine::executors {
namespace {

// Two surfaces that scatter light widely store each photon, more or less. If more do, the buffer is enlarged.
constexpr double usually_stopped = 2;

// The number of records of `record` bytes for which a device has room, in each of `buffers` buffers. Stored
// photons have two buffers: the second one holds them in order.
uint64_t room_on(const gpu::DeviceInfo& device, size_t record, int buffers) {
  return std::min(device.limits.storage_range, device.limits.heap / uint64_t(buffers)) / record;
}

// The size of the buffer for the photons' results. Error (no_device) if the device has no room for it.
size_t bytes_of_results(const gpu::DeviceInfo& device, uint32_t photons) {
  if (const uint64_t room = room_on(device, sizeof(shader::PhotonResult), 1); photons > room)
    throw Error(ExitCode::no_device,
                "`photons` in [render] is {}, but {} has memory for the results of {} ({} bytes each; a "
                "shader sees {} bytes of one buffer): lower `photons`",
                photons, device.name, room, sizeof(shader::PhotonResult), device.limits.storage_range);
  return photons * sizeof(shader::PhotonResult);
}

}  // namespace

PhotonKernel::PhotonKernel(gpu::Device& device, SceneKernels& kernels, StageTimes& times,
                           const Workgroups& workgroups, const PhotonSettings& settings, const Vec3& eye)
    : device_(device),
      kernels_(kernels),
      times_(times),
      workgroups_(workgroups),
      settings_(settings),
      eye_(eye),
      kernel_(kernels.make("kernels/photons.comp.glsl", "#define SENDS_PHOTONS\n")),
      dispatch_size_(device.info(), most_items),
      pass_(device, sizeof(shader::PhotonPass), "photon pass"),
      results_(device, bytes_of_results(device.info(), settings.count), "photons' results"),
      count_(device, sizeof(uint32_t), "photon count") {
  kernel_->set_buffer(BINDING_PHOTON_PASS, pass_);
  kernel_->set_buffer(BINDING_OUTPUT, results_);
  kernel_->set_buffer(BINDING_NEXT_LIST, count_);
  const uint64_t room = room_on(device.info(), sizeof(shader::Photon), 2);
  make_room(uint32_t(std::min(usually_stopped * settings.count, double(room))));
  // Kernels see no photons until the first are emitted.
  const shader::PhotonPass pass = photon_pass(settings_, 0, eye_, capacity_);
  pass_.upload_records(std::span(&pass, 1));
  photons_.emplace(device_, sizeof(shader::Photon), "photons");
  cells_.emplace(device_, (size_t(pass.key_mask) + 2) * sizeof(uint32_t), "photons' cells");
}

void PhotonKernel::make_room(uint32_t photons) {
  if (photons <= capacity_) return;
  capacity_ = photons;
  found_.emplace(device_, size_t{photons} * sizeof(shader::Photon), "photons found");
  kernel_->set_buffer(BINDING_PHOTONS, *found_);
}

void PhotonKernel::bind(gpu::Kernel& kernel) const {
  kernel.set_buffer(BINDING_PHOTON_PASS, pass_);
  kernel.set_buffer(BINDING_PHOTONS, *photons_);
  kernel.set_buffer(BINDING_PHOTON_CELLS, *cells_);
}

bool PhotonKernel::trace(uint32_t index) {
  const shader::PhotonPass pass = photon_pass(settings_, index, eye_, capacity_);
  pass_.upload_records(std::span(&pass, 1));
  count_.clear();
  for (uint32_t first = 0; first < settings_.count;) {
    if (interrupted()) return false;
    shader::Dispatch push{};
    push.tile_x = first;
    push.sample_index = index;
    push.count = std::min(uint32_t(dispatch_size_.items()), settings_.count - first);
    const gpu::RunTime time = kernels_.run([&] {
      return gpu::dispatch(device_, *kernel_, std::as_bytes(std::span(&push, 1)),
                           {workgroups_.of_items(push.count), 1, 1});
    });
    times_.add("pipeline", time.compile_seconds);
    times_.add("photons", time.seconds);
    longest_dispatch_ = std::max(longest_dispatch_, time.seconds);
    dispatch_size_.took(push.count, time.seconds);
    first += push.count;
  }
  stored_ = count_.read_records<uint32_t>(1)[0];
  return true;
}

bool PhotonKernel::send_out(uint32_t index, std::span<const uint32_t> left_out) {
  if (sample_ == index && choice_ == kernels_.choice()) return true;
  sample_.reset();
  if (!trace(index)) return false;
  if (stored_ > capacity_) {
    const gpu::DeviceInfo& device = device_.info();
    const uint64_t room = room_on(device, sizeof(shader::Photon), 2);
    if (stored_ > room)
      throw Error(ExitCode::no_device,
                  "of {} photons, surfaces store {}, but {} has memory for {} ({} bytes each; a shader sees "
                  "{} bytes of one buffer): lower `photons` in [render] to {} or less",
                  settings_.count, stored_, device.name, room, sizeof(shader::Photon),
                  device.limits.storage_range, uint64_t(0.9 * double(room) / stored_ * settings_.count));
    make_room(uint32_t(std::min(room, uint64_t{stored_} + stored_ / 8)));
    if (!trace(index)) return false;
  }
  times_.measure("photon sort", [&] {
    const std::span<const std::byte> bytes = found_->read(stored_ * sizeof(shader::Photon));
    const std::span found(reinterpret_cast<const shader::Photon*>(bytes.data()), stored_);
    const shader::PhotonPass pass = photon_pass(settings_, index, eye_, capacity_);
    const PhotonList list = photon_list(found, pass.key_mask, left_out);
    if (photons_->size() < list.photons.size() * sizeof(shader::Photon))
      photons_.emplace(device_, size_t{capacity_} * sizeof(shader::Photon), "photons");
    if (!list.photons.empty()) photons_->upload_records(list.photons);
    cells_->upload_records(list.cells);
  });
  const auto results = results_.read_records<shader::PhotonResult>(settings_.count);
  kernels_.check_loops(results);
  flags_ = 0;
  for (const shader::PhotonResult& result : results) flags_ |= result.flags & ~FLAG_ENDLESS_LOOP;
  check_ended(flags_);
  sample_ = index;
  choice_ = kernels_.choice();
  return true;
}

}  // namespace eyeray::engine::executors
