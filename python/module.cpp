// eyeray._eyeray: the library's classes for Python. python/eyeray/_eyeray.pyi has their types, docs/python.md
// shows them.
#include <pybind11/functional.h>
#include <pybind11/stl.h>
#include <pybind11/stl/filesystem.h>
#include <eyeray/eyeray.hpp>

#include "arrays.hpp"
#include "background.hpp"

namespace eyeray_python {
namespace {

using eyeray::Backend;
using eyeray::Cancellation;
using eyeray::Picture;
using eyeray::Renderer;
using eyeray::Report;
using eyeray::Scene;
using Path = std::filesystem::path;

// Text for people: bytes in it that are no UTF-8 are shown as \xff.
py::str text_of(const std::string& text) {
  return py::reinterpret_steal<py::str>(
      PyUnicode_DecodeUTF8(text.data(), py::ssize_t(text.size()), "backslashreplace"));
}

// The name of a file as Python has it, whatever its bytes: open() takes it.
py::str file_name_of(const std::string& name) {
  return py::reinterpret_steal<py::str>(
      PyUnicode_DecodeFSDefaultAndSize(name.data(), py::ssize_t(name.size())));
}

py::tuple diagnostics_of(const std::vector<eyeray::Diagnostic>& diagnostics) {
  const py::object type = py::module_::import("eyeray.errors").attr("Diagnostic");
  py::list all;
  for (const eyeray::Diagnostic& each : diagnostics)
    all.append(type(text_of(each.message), file_name_of(each.file), each.line, each.column, each.is_error));
  return py::tuple(all);
}

void raise(std::exception_ptr thrown) {
  try {
    if (thrown) std::rethrow_exception(thrown);
  } catch (const eyeray::Error& error) {
    const py::object type = py::module_::import("eyeray.errors").attr("_kinds")[py::int_(int(error.kind()))];
    const py::object value = type(text_of(error.what()), diagnostics_of(error.diagnostics()));
    PyErr_SetObject(type.ptr(), value.ptr());
  }
}

Backend backend_named(const py::object& value) {
  const auto name = cast_to<std::string>(value, "a backend must be 'gpu', 'twin' or 'reference'");
  if (name == "gpu") return Backend::gpu;
  if (name == "twin") return Backend::twin;
  if (name == "reference") return Backend::reference;
  throw py::value_error("a backend must be 'gpu', 'twin' or 'reference', not '" + name + "'");
}

eyeray::Rect rect_of(const py::object& crop) {
  if (crop.is_none()) return {};
  const auto [x, y, width, height] =
      cast_to<std::array<int, 4>>(crop, "a crop must be (x, y, width, height) in whole pixels");
  if (width < 1 || height < 1)
    throw py::value_error("a crop must be (x, y, width, height), of at least a pixel");
  return {x, y, width, height};
}

// False, or nothing at all? None goes on. From whichever thread. Once the call is cancelled its frame, and
// with it the callback, may be gone: it is not called then.
std::function<bool(const eyeray::Progress&)> progress_of(const py::object& callback,
                                                         const Cancellation& cancellation) {
  if (callback.is_none()) return {};
  if (!PyCallable_Check(callback.ptr())) throw py::type_error("progress must be a function of a float");
  return [&callback, cancellation](const eyeray::Progress& now) {
    if (cancellation.requested()) return false;
    const py::gil_scoped_acquire acquired;
    if (cancellation.requested()) return false;
    const InsideCallback inside;
    const py::object kept = callback;
    return !kept(now.share).is(py::bool_(false));
  };
}

Scene read(const Path& file, const py::object& defines, const std::vector<Path>& allowed_folders,
           bool formulas) {
  const eyeray::SceneOptions options{defines_of(defines), allowed_folders, formulas};
  return in_background<Scene>({}, [file, options] { return Scene::read(file, options); });
}

Scene parse(const std::string& toml, const std::string& name, const py::object& defines, bool formulas) {
  const eyeray::SceneOptions options{defines_of(defines), {}, formulas};
  return in_background<Scene>({}, [toml, name, options] { return Scene::parse(toml, name, options); });
}

void add(eyeray::SceneBuilder& builder, const std::string& section, const py::handle& value,
         const std::string& where) {
  if (!py::isinstance<py::dict>(value)) throw py::type_error(where + " must be a dict, or a list of dicts");
  const auto table = py::reinterpret_borrow<py::dict>(value);
  if (section == "mesh" && is_mesh_of_arrays(table))
    add_mesh(builder, table, where);
  else
    builder.add(section, table_of(table, where));
}

Scene build(const py::dict& tables, const std::string& name, const py::object& defines, bool formulas) {
  const auto builder = std::make_shared<eyeray::SceneBuilder>();
  for (const auto& [key, value] : tables) {
    const std::string section = py::str(key);
    if (py::isinstance<py::dict>(value)) {
      builder->set(section, table_of(py::reinterpret_borrow<py::dict>(value), section));
      continue;
    }
    if (!py::isinstance<py::list>(value) && !py::isinstance<py::tuple>(value))
      throw py::type_error(section + " must be a dict, or a list of dicts");
    size_t index = 0;
    for (const py::handle each : value) add(*builder, section, each, section + "." + std::to_string(index++));
  }
  const eyeray::SceneOptions options{defines_of(defines), {}, formulas};
  return in_background<Scene>({}, [builder, name, options] { return builder->scene(name, options); });
}

Picture render(const std::shared_ptr<Renderer>& renderer, const Scene& scene, const py::object& backend,
               const py::object& aovs, const py::object& crop, const py::object& noise,
               const py::object& clamp, bool reject_fireflies, const py::object& denoise,
               const py::object& progress, const std::optional<Cancellation>& cancellation) {
  eyeray::RenderOptions options;
  options.backend = backend_named(backend);
  options.aovs = strings_of(aovs, "aovs must be a list of names");
  options.crop = rect_of(crop);
  options.noise = cast_to<double>(noise, "noise must be a number");
  options.clamp = cast_to<double>(clamp, "clamp must be a number");
  options.reject_fireflies = reject_fireflies;
  if (py::isinstance<py::str>(denoise)) {
    if (denoise.cast<std::string>() != "oidn")
      throw py::value_error("denoise must be True, False or \"oidn\"");
    options.denoise = true;
    options.denoiser = eyeray::Denoiser::open_image_denoise;
  } else {
    options.denoise = cast_to<bool>(denoise, "denoise must be True, False or \"oidn\"");
  }
  if (cancellation) options.cancellation = *cancellation;
  options.progress = progress_of(progress, options.cancellation);
  return in_background<Picture>(options.cancellation, [=] { return renderer->render(scene, options); });
}

Report verify(const std::shared_ptr<Renderer>& renderer, const Scene& scene, const py::object& backends,
              const py::object& crop, const std::optional<Path>& evidence, const py::object& progress,
              const std::optional<Cancellation>& cancellation) {
  eyeray::VerifyOptions options;
  options.backends.clear();
  for (const std::string& each : strings_of(backends, "backends must be a list of names"))
    options.backends.push_back(backend_named(py::str(each)));
  options.crop = rect_of(crop);
  options.evidence = evidence.value_or(Path());
  if (cancellation) options.cancellation = *cancellation;
  options.progress = progress_of(progress, options.cancellation);
  return in_background<Report>(options.cancellation, [=] { return renderer->verify(scene, options); });
}

void add_scene(py::module_& module) {
  const py::tuple none;
  py::class_<Scene>(module, "Scene", "A scene, checked. It never changes.")
      .def_static("read", &read, py::arg("file"), py::kw_only(), py::arg("defines") = none,
                  py::arg("allowed_folders") = std::vector<Path>(), py::arg("formulas") = true,
                  "From a file: .toml, or a mesh (.obj .ply .stl .off .3mf .gltf .glb .xyz .pcd).")
      .def_static("parse", &parse, py::arg("toml"), py::kw_only(), py::arg("name") = "scene",
                  py::arg("defines") = none, py::arg("formulas") = true, "From text, as a file contains it.")
      .def_static("build", &build, py::arg("tables"), py::kw_only(),
                  py::arg("name") = "scene built in Python", py::arg("defines") = none,
                  py::arg("formulas") = true,
                  "From dicts of the same keys: {'camera': {…}, 'sphere': [{…}, …]}. A mesh may have arrays: "
                  "{'vertices': (n, 3), 'triangles': (m, 3), 'normals': (n, 3), 'uv': (n, 2), …}.")
      .def_property_readonly("width", &Scene::width)
      .def_property_readonly("height", &Scene::height)
      .def_property_readonly("samples", &Scene::samples)
      .def_property_readonly("warnings", [](const Scene& scene) { return diagnostics_of(scene.warnings()); });
}

py::bytes png_of(const Picture& picture) {
  std::string bytes;
  {
    const py::gil_scoped_release released;
    bytes = picture.png();
  }
  return bytes;
}

void add_picture(py::module_& module) {
  py::class_<Picture>(module, "Picture", "A picture. Its arrays are not copied, and are read-only.")
      .def_property_readonly(
          "color", [](const py::object& self) { return array_of(self.cast<const Picture&>().color(), self); },
          "Linear RGB, float32 of (height, width, 3), row 0 at the top.")
      .def_property_readonly("aovs",
                             [](const Picture& picture) { return py::tuple(py::cast(picture.aovs())); })
      .def(
          "aov",
          [](const py::object& self, const std::string& name) {
            return array_of(self.cast<const Picture&>().aov(name), self);
          },
          py::arg("name"), "float32 of (height, width), or (height, width, 3).")
      .def_property_readonly("samples_done", &Picture::samples_done)
      .def_property_readonly("complete", &Picture::complete)
      .def_property_readonly("rays", &Picture::rays)
      .def_property_readonly("seconds", &Picture::seconds)
      .def_property_readonly("sampling_seconds", &Picture::sampling_seconds)
      .def_property_readonly("warnings",
                             [](const Picture& picture) { return diagnostics_of(picture.warnings()); })
      .def("tonemapped", &tonemapped_array,
           "The colours for a screen, as a .png has them: sRGB, uint8 of (height, width, 3).")
      .def("png", &png_of, "The bytes of a .png.")
      .def("__array__", &color_array, py::arg("dtype") = py::none(), py::arg("copy") = py::none())
      .def(
          "_repr_png_",
          [](const Picture& picture) {
            return picture.samples_done() == 0 ? py::object(py::none()) : png_of(picture);
          },
          "The picture as a notebook shows it.")
      .def("write", &Picture::write, py::arg("file"), py::call_guard<py::gil_scoped_release>(),
           "Write it as .png, .pfm, .hdr or .exr.");
}

// Closing a device waits for calls that render, and those may wait for the GIL, to report progress. An
// abandoned call may own the last reference: its thread closes the device, perhaps when Python has ended.
// From then on PyGILState_Check() is true in any thread, but no thread has a state.
void close_without_gil(Renderer* renderer) {
  std::optional<py::gil_scoped_release> released;
  if (PyGILState_GetThisThreadState() && PyGILState_Check()) released.emplace();
  delete renderer;
}

void add_renderer(py::module_& module) {
  py::class_<Cancellation>(module, "Cancellation", "Requests that a call end soon; any thread may do so.")
      .def(py::init<>())
      .def("request", &Cancellation::request)
      .def_property_readonly("requested", &Cancellation::requested);
  py::class_<Report>(module, "Report", "The findings of verify(); true if every gate passes.")
      .def_readonly("passed", &Report::passed)
      .def_property_readonly("failures",
                             [](const Report& report) {
                               py::list all;
                               for (const std::string& each : report.failures) all.append(text_of(each));
                               return py::tuple(all);
                             })
      .def_readonly("text", &Report::text)
      .def_readonly("json", &Report::json)
      .def("__bool__", [](const Report& report) { return report.passed; });
  const auto make = [](const std::string& device, const std::optional<Path>& shaders, double timeout) {
    const py::gil_scoped_release
        released;  // it looks for a device that is named, after the calls that render
    return std::shared_ptr<Renderer>(new Renderer({device, shaders.value_or(Path()), timeout}),
                                     close_without_gil);
  };
  py::class_<Renderer, std::shared_ptr<Renderer>>(
      module, "Renderer", "Keeps the device open, so that a second picture starts at once.")
      .def(py::init(make), py::kw_only(), py::arg("device") = "auto", py::arg("shaders") = py::none(),
           py::arg("timeout") = 60.0)
      .def("render", &render, py::arg("scene"), py::kw_only(), py::arg("backend") = "gpu",
           py::arg("aovs") = py::tuple(), py::arg("crop") = py::none(), py::arg("noise") = 0.0,
           py::arg("clamp") = 0.0, py::arg("reject_fireflies") = false, py::arg("denoise") = false,
           py::arg("progress") = py::none(), py::arg("cancellation") = py::none())
      .def("verify", &verify, py::arg("scene"), py::kw_only(),
           py::arg("backends") = py::make_tuple("gpu", "twin"), py::arg("crop") = py::none(),
           py::arg("evidence") = py::none(), py::arg("progress") = py::none(),
           py::arg("cancellation") = py::none());
}

}  // namespace
}  // namespace eyeray_python

PYBIND11_MODULE(_eyeray, module) {
  namespace py = pybind11;
  py::register_exception_translator(eyeray_python::raise);
  module.def("version", [] { return std::string(eyeray::version()); });
  eyeray_python::add_scene(module);
  eyeray_python::add_picture(module);
  eyeray_python::add_renderer(module);
}
