// Values of the scene's structs in Python. Vectors are tuples and matrices read-only arrays, so that an edit of a part
// is refused instead of lost.
#pragma once

#include <algorithm>
#include <type_traits>

#include "bindings.h"

namespace diptych::python {

inline constexpr std::pair<const char*, AlphaMode> alpha_modes[] = {
    {"opaque", AlphaMode::opaque}, {"mask", AlphaMode::mask}, {"blend", AlphaMode::blend}};
inline constexpr std::pair<const char*, LightKind> light_kinds[] = {
    {"point", LightKind::point}, {"spot", LightKind::spot}, {"directional", LightKind::directional}};
inline const auto& names_of(AlphaMode) {
    return alpha_modes;
}
inline const auto& names_of(LightKind) {
    return light_kinds;
}

/// 4 x 4 as NumPy and textbooks index it, matrix[row, column]; a point is a column.
inline py::array to_array(const Matrix& matrix) {
    py::array_t<double> array({4, 4});
    for (py::ssize_t row = 0; row < 4; ++row) {
        for (py::ssize_t column = 0; column < 4; ++column) {
            array.mutable_at(row, column) = matrix[static_cast<std::size_t>(4 * column + row)];
        }
    }
    array.attr("setflags")(py::arg("write") = false);
    return array;
}

inline Matrix to_matrix(const char* name, const py::handle& value) {
    const auto array = py::array_t<double, py::array::c_style | py::array::forcecast>::ensure(value);
    if (!array || array.ndim() != 2 || array.shape(0) != 4 || array.shape(1) != 4) {
        PyErr_Clear();
        throw SettingError(std::string(name) + ": wants 4 x 4 numbers");
    }
    Matrix matrix;
    for (py::ssize_t row = 0; row < 4; ++row) {
        for (py::ssize_t column = 0; column < 4; ++column) {
            matrix[static_cast<std::size_t>(4 * column + row)] = array.at(row, column);
        }
    }
    return matrix;
}

template <typename T>
py::object to_python(const T& value) {
    if constexpr (std::is_same_v<T, Matrix>) {
        return to_array(value);
    } else if constexpr (std::is_same_v<T, float>) {
        return py::float_(as_written(value));
    } else if constexpr (std::is_enum_v<T>) {
        const auto& names = names_of(value);
        return py::str(
            std::find_if(std::begin(names), std::end(names), [&](auto& each) { return each.second == value; })->first);
    } else if constexpr (requires { std::tuple_size<T>::value; }) {
        py::tuple parts(value.size());
        for (std::size_t i = 0; i < value.size(); ++i) {
            parts[i] = to_python(value[i]);
        }
        return parts;
    } else {
        return py::cast(value);
    }
}

template <typename T>
T from_python(const char* name, const py::handle& value) {
    if constexpr (std::is_same_v<T, Matrix>) {
        return to_matrix(name, value);
    } else if constexpr (std::is_enum_v<T>) {
        std::string known;
        for (const auto& [each, result] : names_of(T{})) {
            if (py::isinstance<py::str>(value) && value.cast<std::string>() == each) {
                return result;
            }
            known += (known.empty() ? "" : ", ") + std::string(each);
        }
        throw SettingError(std::string(name) + " " + std::string(py::str(value)) + ": there are only " + known);
    } else {
        try {
            return value.cast<T>();
        } catch (const py::cast_error&) {
            std::string wanted = "a number";
            if constexpr (requires { std::tuple_size<T>::value; }) {
                wanted = std::to_string(std::tuple_size_v<T>) + " numbers";
            } else if constexpr (std::is_same_v<T, std::string>) {
                wanted = "a string";
            } else if constexpr (std::is_same_v<T, bool>) {
                wanted = "True or False";
            } else if constexpr (std::is_same_v<T, TextureSlot>) {
                wanted = "a TextureSlot";
            }
            throw py::type_error(std::string(name) + ": wants " + wanted);
        }
    }
}

}  // namespace diptych::python
