// The library's exceptions as classes of Python.
#include "bindings.h"

namespace diptych::python {

namespace {

// Held for as long as the process, as translators have no other way to reach them.
PyObject* error_type;
PyObject* setting_error_type;
PyObject* unknown_name_type;
PyObject* no_device_type;
PyObject* out_of_memory_type;
PyObject* device_lost_type;
PyObject* interrupted_type;
PyObject* warning_type;

PyObject* new_type(py::module_& module, const char* name, const char* doc, const py::tuple& bases,
                   const py::dict& members = {}) {
    const std::string full_name = std::string("diptych.") + name;
    PyObject* type = PyErr_NewExceptionWithDoc(full_name.c_str(), doc, bases.ptr(), members.ptr());
    if (type == nullptr) {
        throw py::error_already_set();
    }
    module.attr(name) = py::handle(type);
    return type;
}

void translate(std::exception_ptr thrown) {
    try {
        std::rethrow_exception(thrown);
    } catch (const SettingError& error) {
        PyErr_SetString(setting_error_type, error.what());
    } catch (const UnknownName& error) {
        PyErr_SetString(unknown_name_type, error.what());
    } catch (const NoDevice& error) {
        PyErr_SetString(no_device_type, error.what());
    } catch (const OutOfMemory& error) {
        PyErr_SetString(out_of_memory_type, error.what());
    } catch (const DeviceLost& error) {
        PyErr_SetString(device_lost_type, error.what());
    } catch (const Interrupted& error) {
        PyErr_SetString(interrupted_type, error.what());
    } catch (const Error& error) {
        PyErr_SetString(error_type, error.what());
    }
}

}  // namespace

void bind_errors(py::module_& module) {
    const py::handle exception = PyExc_Exception;
    error_type = new_type(module, "Error",
                          "Bad input, a setting out of range, or a file that cannot be read or written.\n\n"
                          "The message is one line that names the file, the object in it and the reason.",
                          py::make_tuple(exception));
    const py::handle base = error_type;
    setting_error_type =
        new_type(module, "SettingError", "A setting or an argument is out of range. Also a ValueError.",
                 py::make_tuple(base, py::handle(PyExc_ValueError)));
    py::dict plain_message;  // a KeyError would show its message in quotes
    plain_message["__str__"] = exception.attr("__str__");
    unknown_name_type =
        new_type(module, "UnknownName", "The scene or the film has nothing of that name. Also a KeyError.",
                 py::make_tuple(base, py::handle(PyExc_KeyError)), plain_message);
    no_device_type = new_type(module, "NoDevice",
                              "The machine has no device that the backend needs. The message lists what is missing.",
                              py::make_tuple(base));
    out_of_memory_type = new_type(module, "OutOfMemory",
                                  "The device has no room for what was asked of it. The message says what would need "
                                  "less. Also a MemoryError.",
                                  py::make_tuple(base, py::handle(PyExc_MemoryError)));
    device_lost_type = new_type(module, "DeviceLost",
                                "The device was lost while it worked. Films taken before stay whole; the session can "
                                "only be closed.",
                                py::make_tuple(base));
    interrupted_type =
        new_type(module, "Interrupted", "A call that has no partial result was stopped.", py::make_tuple(base));
    warning_type = new_type(module, "SceneWarning", "A part of a scene that is not rendered as its file asks.",
                            py::make_tuple(py::handle(PyExc_UserWarning)));
    py::register_exception_translator(translate);
}

void warn(const std::vector<std::string>& lines, int depth) {
    for (const std::string& line : lines) {
        if (PyErr_WarnEx(warning_type, line.c_str(), depth) != 0) {
            throw py::error_already_set();
        }
    }
}

}  // namespace diptych::python
