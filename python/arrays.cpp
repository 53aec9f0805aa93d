#include "arrays.hpp"

#include <cstdint>
#include <limits>
#include <vector>

namespace eyeray_python {
namespace {

std::string shape_of(const py::array& array) {
  return py::str(array.attr("shape"));
}

constexpr int deepest = 64;

eyeray::Table table_within(const py::dict& dict, const std::string& where, int depth);

// `depth`: of lists and dicts around it.
eyeray::Value value_of(const py::handle& value, const std::string& where, int depth) {
  if (py::isinstance<py::bool_>(value)) return value.cast<bool>();
  if (py::isinstance<py::int_>(value)) {
    try {
      return value.cast<int64_t>();
    } catch (const py::cast_error&) {
      throw py::value_error(where + ": the integer has more than 64 bits");
    }
  }
  if (py::isinstance<py::float_>(value)) return value.cast<double>();
  if (py::isinstance<py::str>(value)) return value.cast<std::string>();
  if (depth > deepest)
    throw py::value_error(where.substr(0, 60) + ": lists and dicts are nested more than " +
                          std::to_string(deepest) + " deep; does one contain itself?");
  if (py::isinstance<py::dict>(value))
    return table_within(py::reinterpret_borrow<py::dict>(value), where, depth + 1);
  // numpy's scalars and arrays as Python's numbers and lists.
  if (py::hasattr(value, "tolist")) return value_of(value.attr("tolist")(), where, depth + 1);
  if (py::isinstance<py::list>(value) || py::isinstance<py::tuple>(value)) {
    std::vector<eyeray::Value> values;
    for (const py::handle each : value) values.push_back(value_of(each, where, depth + 1));
    return values;
  }
  throw py::type_error(where + ": " + type_name(value) + " cannot be a value of a scene");
}

eyeray::Table table_within(const py::dict& dict, const std::string& where, int depth) {
  eyeray::Table table;
  for (const auto& [key, value] : dict) {
    if (!py::isinstance<py::str>(key))
      throw py::type_error(where + ": a key must be a str, not " + type_name(key));
    const std::string name = py::str(key);
    table.set(name, value_of(value, where + "." + name, depth));
  }
  return table;
}

py::array array_named(const py::dict& table, const char* name, const std::string& where, int columns,
                      const char* kinds, const char* wanted) {
  const py::object value = table[name];
  const std::string full_name = where + "." + name;
  if (!py::isinstance<py::array>(value) && !py::isinstance<py::list>(value) &&
      !py::isinstance<py::tuple>(value))
    throw py::type_error(full_name + " must be an array, not " + type_name(value));
  const py::array array = py::array::ensure(value);
  if (!array) throw py::error_already_set();
  if (std::string(kinds).find(array.dtype().kind()) == std::string::npos)
    throw py::type_error(full_name + " must be of " + wanted + ", not of " +
                         std::string(py::str(array.dtype())));
  if (array.ndim() != 2 || array.shape(1) != columns)
    throw py::value_error(full_name + " has the shape " + shape_of(array) + ", not (n, " +
                          std::to_string(columns) + ")");
  return array;
}

using Floats = py::array_t<float, py::array::c_style | py::array::forcecast>;

Floats floats_named(const py::dict& table, const char* name, const std::string& where, int columns) {
  return array_named(table, name, where, columns, "fiu", "numbers");
}

std::span<const float> span_of(const Floats& array) {
  return {array.data(), size_t(array.size())};
}

std::vector<uint32_t> indices_named(const py::dict& table, const char* name, const std::string& where) {
  const py::array_t<int64_t, py::array::c_style | py::array::forcecast> array =
      array_named(table, name, where, 3, "iu", "integers");
  std::vector<uint32_t> indices(size_t(array.size()));
  for (size_t i = 0; i < indices.size(); ++i) {
    const int64_t index = array.data()[i];
    if (index < 0 || index > std::numeric_limits<uint32_t>::max())
      throw py::value_error(where + "." + name + ": " + std::to_string(index) +
                            " is not the index of a vertex");
    indices[i] = uint32_t(index);
  }
  return indices;
}

}  // namespace

py::array array_of(const eyeray::Plane& plane, const py::handle& owner) {
  std::vector<py::ssize_t> shape{plane.height, plane.width};
  if (plane.channels != 1) shape.push_back(plane.channels == 0 ? 3 : plane.channels);
  py::array array(py::dtype::of<float>(), shape, {}, plane.values.data(), owner);
  array.attr("flags").attr("writeable") = false;
  return array;
}

py::array color_array(const py::object& picture, const py::object& dtype, const py::object& copy) {
  const py::array color = array_of(picture.cast<const eyeray::Picture&>().color(), picture);
  const bool copies = !copy.is_none() && py::bool_(copy);
  if (!copies && (dtype.is_none() || color.dtype().equal(py::dtype::from_args(dtype)))) return color;
  if (!copy.is_none() && !copies)
    throw py::value_error(
        "a picture's colours are float32: another dtype needs a copy, which copy=False forbids");
  return color.attr("astype")(dtype.is_none() ? py::object(color.dtype()) : dtype);
}

py::array tonemapped_array(const eyeray::Picture& picture) {
  std::vector<uint8_t> codes;
  {
    const py::gil_scoped_release released;
    codes = picture.tonemapped();
  }
  const eyeray::Plane color = picture.color();
  return py::array_t<uint8_t>({color.height, color.width, std::max(3, color.channels)}, codes.data());
}

std::string type_name(const py::handle& value) {
  return py::str(py::type::of(value).attr("__name__"));
}

bool is_mesh_of_arrays(const py::handle& table) {
  return py::isinstance<py::dict>(table) && py::reinterpret_borrow<py::dict>(table).contains("vertices");
}

void add_mesh(eyeray::SceneBuilder& builder, const py::dict& table, const std::string& where) {
  if (!table.contains("triangles")) throw py::value_error(where + " has vertices, but no triangles");
  const Floats vertices = floats_named(table, "vertices", where, 3);
  const std::vector<uint32_t> triangles = indices_named(table, "triangles", where);
  Floats normals, uv;
  if (table.contains("normals")) normals = floats_named(table, "normals", where, 3);
  if (table.contains("uv")) uv = floats_named(table, "uv", where, 2);
  py::dict rest;
  for (const auto& [key, value] : table) {
    const std::string name = py::str(key);
    if (name != "vertices" && name != "triangles" && name != "normals" && name != "uv") rest[key] = value;
  }
  builder.add_mesh({span_of(vertices), triangles, span_of(normals), span_of(uv)}, table_of(rest, where));
}

eyeray::Table table_of(const py::dict& dict, const std::string& where) {
  return table_within(dict, where, 1);
}

std::vector<std::string> defines_of(const py::object& defines) {
  if (py::isinstance<py::dict>(defines)) {
    std::vector<std::string> all;
    for (const auto& [key, value] : py::reinterpret_borrow<py::dict>(defines))
      all.push_back(std::string(py::str(key)) + "=" + value_of(value, std::string(py::str(key)), 1).toml());
    return all;
  }
  return strings_of(defines, "defines must be a list of \"key=value\", or a dict");
}

std::vector<std::string> strings_of(const py::object& list, const char* wanted) {
  if (py::isinstance<py::str>(list)) throw py::type_error(std::string(wanted) + ", not str");
  return cast_to<std::vector<std::string>>(list, wanted);
}

}  // namespace eyeray_python
