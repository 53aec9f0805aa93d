// Between numpy's arrays and eyeray's.
#pragma once

#include <pybind11/numpy.h>
#include <pybind11/pybind11.h>
#include <pybind11/stl.h>
#include <eyeray/eyeray.hpp>

#include <string>
#include <vector>

namespace eyeray_python {

namespace py = pybind11;

// The plane as an array of (height, width) or (height, width, 3), which is not copied, cannot be written, and
// keeps `owner` alive.
py::array array_of(const eyeray::Plane& plane, const py::handle& owner);
// The colours as numpy's protocol __array__ asks for them; ValueError where `copy` forbids the copy that
// `dtype` takes.
py::array color_array(const py::object& picture, const py::object& dtype, const py::object& copy);
// uint8 of (height, width, 3).
py::array tonemapped_array(const eyeray::Picture& picture);

// The name of its type.
std::string type_name(const py::handle& value);

// The value as T; TypeError "`wanted`, not str" for another type.
template <typename T>
T cast_to(const py::handle& value, const char* wanted) {
  try {
    return value.cast<T>();
  } catch (const py::cast_error&) {
    throw py::type_error(std::string(wanted) + ", not " + type_name(value));
  }
}

// True if it is a mesh for add_mesh: a dict with `vertices`, `triangles`, perhaps `normals` and `uv`, and the
// keys of [[mesh]].
bool is_mesh_of_arrays(const py::handle& table);
// TypeError or ValueError, which begin with `where`, for arrays of wrong type or shape.
void add_mesh(eyeray::SceneBuilder& builder, const py::dict& table, const std::string& where);

// A dict as a table, with all inside it; TypeError for a value that no scene can hold.
eyeray::Table table_of(const py::dict& dict, const std::string& where);
// The values that `defines` lays over a scene: strings as they are, a dict's entries as "key=value".
std::vector<std::string> defines_of(const py::object& defines);
// A list of strings; TypeError as cast_to, for a string alone too.
std::vector<std::string> strings_of(const py::object& list, const char* wanted);

}  // namespace eyeray_python
