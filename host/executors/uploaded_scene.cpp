#include "host/executors/uploaded_scene.hpp"

#include "host/core/error.hpp"

namespace eyeray::engine::executors {

void UploadedScene::add(const SceneBuffer& source) {
  gpu::Buffer buffer(device_, source.size(), source.name,
                     source.texels && texels_ ? gpu::BindingKind::texels : gpu::BindingKind::storage);
  bytes_ += buffer.size();
  if (source.geometry) geometry_bytes_ += buffer.size();
  if (bytes_ > device_.info().limits.heap)
    throw Error(ExitCode::no_device,
                "the scene needs more than the {} bytes of memory that {} has: {} up to buffer '{}'",
                device_.info().limits.heap, device_.info().name, bytes_, source.name);
  if (!source.bytes.empty()) buffer.upload(source.bytes);
  buffers_.emplace_back(source.binding, std::move(buffer));
}

void UploadedScene::bind(gpu::Kernel& kernel) const {
  for (const auto& [binding, buffer] : buffers_) kernel.set_buffer(binding, buffer);
}

}  // namespace eyeray::engine::executors
