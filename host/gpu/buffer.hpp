// A storage buffer, a uniform buffer or a storage texel buffer: bytes that a kernel sees, between two guards
// that it must not touch.
#pragma once

#include <cstddef>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "host/gpu/device.hpp"
#include "host/gpu/reflect.hpp"

namespace eyeray::engine::gpu {

class RawBuffer;

class Buffer {
 public:
  // Makes a buffer of `bytes` zeros, rounded up to whole words or texels, and to at least one. `name` is for
  // errors. Error (no_device) with the numbers when the device's shaders cannot see that much, or when its
  // memory is too small.
  Buffer(Device& device, size_t bytes, std::string name, BindingKind kind = BindingKind::storage);
  ~Buffer();
  Buffer(Buffer&&) noexcept;
  Buffer& operator=(Buffer&&) noexcept;

  size_t size() const { return bytes_; }
  const std::string& name() const { return name_; }
  // The kind of binding by which kernels may use it.
  BindingKind kind() const { return kind_; }

  // Copies `bytes` to the start of the buffer, or to `offset` (a multiple of 4, as bytes.size() must be).
  void upload(std::span<const std::byte> bytes, size_t offset = 0);
  // Makes every byte 0, or the first `bytes` (a multiple of 4).
  void clear() { clear(bytes_); }
  void clear(size_t bytes);
  // The first `bytes` bytes, valid until the next read or dispatch. Error (no_device) when a guard was
  // overwritten: a shader wrote outside its buffers.
  std::span<const std::byte> read(size_t bytes);
  std::span<const std::byte> read() { return read(bytes_); }

  // Uploads any vector, array or span of records.
  template <typename Records>
  void upload_records(const Records& records) {
    upload(std::as_bytes(std::span(records)));
  }
  // Reads the first `count` records.
  template <typename T>
  std::vector<T> read_records(size_t count) {
    const std::span<const std::byte> bytes = read(count * sizeof(T));
    const T* first =
        reinterpret_cast<const T*>(bytes.data());  // mapped memory is aligned far beyond any record
    return std::vector<T>(first, first + count);
  }

  // The offset of the shader's bytes in the Vulkan buffer. The guards lie before and after them.
  size_t payload_offset() const { return guard_; }
  const RawBuffer& raw() const { return *raw_; }

 private:
  std::byte* staging();
  void copy_to_device(size_t offset, size_t bytes);
  void copy_from_device(size_t bytes);
  void check_guards(const std::byte* all) const;

  std::shared_ptr<Context> context_;
  std::string name_;
  BindingKind kind_;
  size_t bytes_ = 0;
  size_t guard_ = 0;                    // bytes of each guard
  std::unique_ptr<RawBuffer> raw_;      // guard, payload, guard; null if no kernel runs (compiles_only)
  std::unique_ptr<RawBuffer> staging_;  // a mapped copy of raw_; null if memory is shared, or before any copy
};

}  // namespace eyeray::engine::gpu
