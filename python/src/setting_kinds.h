// The kinds of settings: how each is read from Python, refused by its name, and shown.
#pragma once

#include <functional>
#include <limits>

#include "bindings.h"

namespace diptych::python {

struct Field {
    const char* name;
    const char* doc;
    std::function<py::object(const Settings&)> get;
    std::function<void(Settings&, const py::object&)> set;
    py::object range = py::none();  // of a number: (least, most)
};

template <typename T>
struct Choice {
    const char* name;
    T value;
};

template <typename T>
using Choices = std::vector<Choice<T>>;

inline std::string text_of(const py::handle& value) {
    return py::str(value);
}

[[noreturn]] inline void refuse(const char* name, const py::handle& value, const std::string& why) {
    throw SettingError(std::string(name) + ": " + text_of(value) + " " + why);
}

/// A member of Settings or of its ResamplingSettings.
template <typename T>
T& member(Settings& settings, T Settings::*field) {
    return settings.*field;
}
template <typename T>
T& member(Settings& settings, T ResamplingSettings::*field) {
    return settings.resampling.*field;
}
template <typename Pointer>
auto member(const Settings& settings, Pointer field) {
    return member(const_cast<Settings&>(settings), field);
}

template <typename T, typename Pointer>
Field choice(const char* name, Pointer field, const Choices<T>& choices, const char* doc) {
    const auto get = [field, &choices](const Settings& settings) -> py::object {
        for (const Choice<T>& each : choices) {
            if (each.value == member(settings, field)) {
                return py::str(each.name);
            }
        }
        throw Error("a setting has a value without a name");
    };
    const auto set = [name, field, &choices](Settings& settings, const py::object& value) {
        std::string names;
        for (const Choice<T>& each : choices) {
            if (py::isinstance<py::str>(value) && text_of(value) == each.name) {
                member(settings, field) = each.value;
                return;
            }
            names += (names.empty() ? "" : ", ") + std::string(each.name);
        }
        throw SettingError(std::string(name) + " " + text_of(value) + ": there are only " + names);
    };
    return {name, doc, get, set};
}

/// The integers of Python and of NumPy, but no truth value.
inline long long integer_of(const char* name, const py::handle& value) {
    if (PyBool_Check(value.ptr()) != 0 || PyIndex_Check(value.ptr()) == 0) {
        throw py::type_error(std::string(name) + ": wants an integer");
    }
    const auto index = py::reinterpret_steal<py::object>(PyNumber_Index(value.ptr()));
    int overflow = 0;
    const long long result = index ? PyLong_AsLongLongAndOverflow(index.ptr(), &overflow) : -1;
    if (PyErr_Occurred() != nullptr) {
        throw py::error_already_set();
    }
    return overflow == 0 ? result : overflow * std::numeric_limits<long long>::max();
}

template <typename Pointer>
Field integer(const char* name, Pointer field, long long least, long long most, const char* doc) {
    const auto get = [field](const Settings& settings) -> py::object { return py::int_(member(settings, field)); };
    const auto set = [=](Settings& settings, const py::object& value) {
        const long long number = integer_of(name, value);
        if (number < least || number > most) {
            refuse(name, value, "is not a number from " + std::to_string(least) + " to " + std::to_string(most));
        }
        auto& target = member(settings, field);
        target = static_cast<std::remove_reference_t<decltype(target)>>(number);
    };
    return {name, doc, get, set, py::make_tuple(least, most)};
}

inline constexpr float unlimited = std::numeric_limits<float>::max();
inline constexpr float positive = std::numeric_limits<float>::min();

template <typename Pointer>
Field number(const char* name, Pointer field, float least, float most, const char* doc) {
    const auto get = [field](const Settings& settings) -> py::object {
        return py::float_(as_written(member(settings, field)));
    };
    const auto set = [=](Settings& settings, const py::object& value) {
        const double number = PyFloat_AsDouble(value.ptr());
        if (PyErr_Occurred() != nullptr) {
            throw py::error_already_set();
        }
        if (!(number >= least && number <= most)) {
            refuse(name, value, most < unlimited ? "is not a number from 0 to 1" : "is not a positive number");
        }
        member(settings, field) = static_cast<float>(number);
    };
    return {name, doc, get, set, py::make_tuple(least, most)};
}

template <typename Pointer>
Field flag(const char* name, Pointer field, const char* doc) {
    const auto get = [field](const Settings& settings) -> py::object { return py::bool_(member(settings, field)); };
    const auto set = [name, field](Settings& settings, const py::object& value) {
        if (!py::isinstance<py::bool_>(value)) {
            throw py::type_error(std::string(name) + ": wants True or False");
        }
        member(settings, field) = value.cast<bool>();
    };
    return {name, doc, get, set};
}

}  // namespace diptych::python
