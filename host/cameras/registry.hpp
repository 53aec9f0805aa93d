// The kinds of cameras, as scene files and the manual know them.
#pragma once

#include <memory>
#include <span>
#include <string_view>

#include "host/reading/table_reader.hpp"
#include "host/scene/camera.hpp"

namespace eyeray::engine::cameras {

// The words that each kind declares its keys with, and reads them.
using reading::Key, reading::KeyType, reading::TableReader;

struct CameraType {
  std::string_view name;  // `type` in a [camera] table, and its .glsl
  std::string_view manual;
  std::span<const Key> keys;                                       // beside `type`, `eye`, `target` and `up`
  std::shared_ptr<const Projection> (*parse)(TableReader& table);  // null after an error, which is reported
};

// Every kind of camera, in registry order.
std::span<const CameraType* const> types();

}  // namespace eyeray::engine::cameras
