// Between numpy's arrays and eyeray's.
#pragma once

#include <pybind11/numpy.h>
#include <pybind11/pybind11.h>
#include <eyeray/eyeray.hpp>

#include <string>

namespace eyeray_python {

namespace py = pybind11;

// The plane as an array of (height, width) or (height, width, 3), which is not copied, cannot be written, and
// keeps `owner` alive.
py::array array_of(const eyeray::Plane& plane, const py::handle& owner);

// What Scene.build has for a mesh: a dict with `vertices`, `triangles`, perhaps `normals` and `uv`, and the
// keys of
// [[mesh]].
bool is_mesh_of_arrays(const py::handle& table);
// TypeError or ValueError, which begin with `where`, for arrays of wrong type or shape.
void add_mesh(eyeray::SceneBuilder& builder, const py::dict& table, const std::string& where);

// A dict as a table, all that is in it too; TypeError for what no scene can hold.
eyeray::Table table_of(const py::dict& dict, const std::string& where);
// What `define` lays over a scene: strings as they are, of a dict "key=value".
std::vector<std::string> defines_of(const py::object& defines);

}  // namespace eyeray_python
