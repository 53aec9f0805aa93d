// The kinds of cameras, as scene files and the manual know them.
#pragma once

#include <memory>
#include <span>
#include <string_view>

#include "host/reading/table_reader.hpp"
#include "host/scene/camera.hpp"

namespace eyeray::engine::cameras {

// The types with which each kind declares and reads its keys.
using reading::Key, reading::KeyType, reading::TableReader;

struct CameraType {
  std::string_view name;  // the value of `type` in a [camera] table, and the name of its .glsl
  std::string_view manual;
  std::span<const Key> keys;                                       // beside `type`, `eye`, `target` and `up`
  std::shared_ptr<const Projection> (*parse)(TableReader& table);  // null after an error, which is reported
};

// Every kind of camera, in registry order.
std::span<const CameraType* const> types();

}  // namespace eyeray::engine::cameras
