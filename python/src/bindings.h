// What the files of this folder share. Each binds one area of the library to the module diptych._diptych.
#pragma once

#include <pybind11/numpy.h>
#include <pybind11/pybind11.h>
#include <pybind11/stl.h>

#include <string>
#include <vector>

#include "diptych/diptych.h"

namespace diptych::python {

namespace py = pybind11;

/// A name that the scene or the film does not have: in Python a KeyError too.
class UnknownName : public Error {
public:
    using Error::Error;
};

void bind_errors(py::module_& module);
void bind_settings(py::module_& module);
void bind_scene(py::module_& module);
void bind_film(py::module_& module);
void bind_session(py::module_& module);
void bind_measure(py::module_& module);
void bind_engines(py::module_& module);

/// Issues diptych.SceneWarning for each line, as of the line of Python that lies `depth` calls up. Throws where
/// Python's filters make an error of it.
void warn(const std::vector<std::string>& lines, int depth);

/// Of a string or an os.PathLike.
inline std::string path_of(const py::object& path) {
    return py::str(py::module_::import("os").attr("fspath")(path));
}

/// Refuses what the backend would not heed.
BackendChoice choice_of(const std::string& backend, const std::string& device, int threads, bool validation);

/// The shortest decimal that single precision rounds to the value: a roughness of 0.3 reads as 0.3.
double as_written(float value);

/// What an object shows: a read-only array on memory that `owner` keeps alive.
template <typename T>
py::array view_of(const T* data, const std::vector<py::ssize_t>& shape, const py::object& owner) {
    py::array_t<T> array(shape, data, owner);  // with a base, pybind11 does not copy
    array.attr("setflags")(py::arg("write") = false);
    return array;
}

/// An array on memory of its own.
template <typename T>
py::array array_of(std::vector<T> values, const std::vector<py::ssize_t>& shape) {
    auto* owned = new std::vector<T>(std::move(values));
    const py::capsule owner(owned, [](void* memory) { delete static_cast<std::vector<T>*>(memory); });
    return py::array_t<T>(shape, owned->data(), owner);
}

}  // namespace diptych::python
