// Vectors for data that grows with the scene and is written by all cores: new elements are not initialised.
#pragma once

#include <memory>
#include <new>
#include <type_traits>
#include <utility>
#include <vector>

namespace eyeray::engine {

// Leaves elements uninitialised if they are made without a value.
template <typename T>
struct RawAllocator : std::allocator<T> {
  static_assert(std::is_trivially_copyable_v<T>);
  template <typename Other>
  struct rebind {
    using other = RawAllocator<Other>;
  };

  RawAllocator() = default;
  template <typename Other>
  RawAllocator(const RawAllocator<Other>&) {}

  void construct(T*) {}
  template <typename... Values>
  void construct(T* at, Values&&... values) {
    ::new (static_cast<void*>(at)) T(std::forward<Values>(values)...);
  }
};

// A caller of resize() must write every new element.
template <typename T>
using RawVector = std::vector<T, RawAllocator<T>>;

}  // namespace eyeray::engine
