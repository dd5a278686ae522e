// A scene's lists of materials, cameras, lights and instances in Python: edits write through to the scene.
#pragma once

#include <functional>
#include <memory>

#include "values.h"

namespace diptych::python {

inline std::vector<Material>& list_of(Scene& scene, const Material*) {
    return scene.materials();
}
inline std::vector<Camera>& list_of(Scene& scene, const Camera*) {
    return scene.cameras();
}
inline std::vector<Light>& list_of(Scene& scene, const Light*) {
    return scene.lights();
}
inline std::vector<Instance>& list_of(Scene& scene, const Instance*) {
    return scene.instances();
}
inline std::vector<Node>& list_of(Scene& scene, const Node*) {
    return scene.nodes();
}

/// The first of that name; the library's Error lists the names that there are.
inline Material& named(Scene& scene, const std::string& name, const Material*) {
    return scene.material(name);
}
inline Camera& named(Scene& scene, const std::string& name, const Camera*) {
    return scene.camera(name);
}
inline Light& named(Scene& scene, const std::string& name, const Light*) {
    return scene.light(name);
}
inline Instance& named(Scene& scene, const std::string& name, const Instance*) {
    return scene.instance(name);
}
inline Node& named(Scene& scene, const std::string& name, const Node*) {
    return scene.node(name);
}

/// A value on its own, or an element of a scene. The element is found anew at each use, by its index, because the
/// scene's lists move in memory as they grow.
template <typename T>
struct Element {
    Element() : Element(T{}) {}
    explicit Element(T value) {
        get = [own = std::make_shared<T>(std::move(value))]() -> T& { return *own; };
    }
    Element(const Scene& of, std::size_t index) : in_scene(true) {
        get = [scene = of, index]() mutable -> T& {
            auto& list = list_of(scene, static_cast<T*>(nullptr));
            if (index >= list.size()) {
                throw py::index_error("this element was deleted from its scene");
            }
            return list[index];
        };
    }

    std::function<T&()> get;
    bool in_scene = false;
};

/// The class of Element<T>, whose fields are added one by one.
template <typename T>
class ElementClass {
public:
    ElementClass(py::module_& module, const char* name, const std::string& doc) : class_(module, name, doc.c_str()) {
        class_.def(py::init([](const py::kwargs& values) {
            Element<T> element;
            const py::object self = py::cast(&element, py::return_value_policy::reference);
            for (const auto& [key, value] : values) {
                if (!py::hasattr(py::type::of(self), key)) {
                    throw py::type_error("no field is called " + std::string(py::str(key)));
                }
                py::setattr(self, key, value);
            }
            return Element<T>(element.get());
        }));
        class_.def(
            "__eq__", [](const Element<T>& a, const Element<T>& b) { return a.get() == b.get(); }, py::is_operator());
        class_.attr("__hash__") = py::none();
        class_.attr("_fields") = py::tuple();
        class_.def("__repr__", [](const py::object& self) {
            std::string parts;
            const py::object plain = py::type::of(self)();
            for (const py::handle& field : py::type::of(self).attr("_fields")) {
                const std::string shown = py::repr(self.attr(field));
                if (shown != std::string(py::repr(plain.attr(field)))) {
                    parts += (parts.empty() ? "" : ", ") + std::string(py::str(field)) + "=" + shown;
                }
            }
            return std::string(py::str(py::type::of(self).attr("__name__"))) + "(" + parts + ")";
        });
    }

    template <typename F>
    ElementClass& field(const char* name, F T::*member, const char* doc) {
        class_.def_property(
            name, [member](const Element<T>& element) { return to_python(element.get().*member); },
            [name, member](Element<T>& element, const py::object& value) {
                element.get().*member = from_python<F>(name, value);
            },
            doc);
        class_.attr("_fields") = py::object(class_.attr("_fields")) + py::make_tuple(name);
        return *this;
    }

    /// The last column of a transform.
    ElementClass& position(Matrix T::*transform) {
        class_.def_property(
            "position",
            [transform](const Element<T>& element) {
                const Matrix& matrix = element.get().*transform;
                return py::make_tuple(matrix[12], matrix[13], matrix[14]);
            },
            [transform](Element<T>& element, const py::object& value) {
                const Point point = from_python<Point>("position", value);
                std::copy(point.begin(), point.end(), (element.get().*transform).begin() + 12);
            },
            "(x, y, z), metres: the last column of the transform.");
        return *this;
    }

private:
    py::class_<Element<T>> class_;
};

template <typename T>
struct Elements {
    Scene scene;

    std::vector<T>& list() const {
        Scene handle = scene;
        return list_of(handle, static_cast<T*>(nullptr));
    }
    std::size_t index(py::ssize_t given) const {
        const auto size = static_cast<py::ssize_t>(list().size());
        if (given < -size || given >= size) {
            throw py::index_error("index " + std::to_string(given) + " of " + std::to_string(size));
        }
        return static_cast<std::size_t>(given < 0 ? given + size : given);
    }
    std::size_t index(const std::string& name) const {
        Scene handle = scene;
        try {
            const T& found = named(handle, name, static_cast<T*>(nullptr));
            return static_cast<std::size_t>(&found - list().data());
        } catch (const Error& error) {
            throw UnknownName(error.what());
        }
    }
};

/// What only reads a list: its items are `Item`s of the scene and an index.
template <typename T, typename Item>
py::class_<Elements<T>> bind_look_up(py::module_& module, const char* class_name) {
    using List = Elements<T>;
    py::class_<List> list(module, class_name);
    list.def("__len__", [](const List& self) { return self.list().size(); });
    list.def("__getitem__", [](const List& self, py::ssize_t index) { return Item(self.scene, self.index(index)); });
    list.def("__getitem__",
             [](const List& self, const std::string& name) { return Item(self.scene, self.index(name)); });
    list.def("__contains__", [](const List& self, const std::string& name) {
        return std::any_of(self.list().begin(), self.list().end(), [&](const T& each) { return each.name == name; });
    });
    list.def("__repr__", [](const py::object& self) { return std::string(py::repr(py::list(self))); });
    list.def(
        "index", [](const List& self, const std::string& name) { return self.index(name); },
        "The index of the first element of that name.");
    list.def(
        "names",
        [](const List& self) {
            std::vector<std::string> names;
            std::transform(self.list().begin(), self.list().end(), std::back_inserter(names),
                           [](const T& each) { return each.name; });
            return names;
        },
        "The elements' names, in order.");
    return list;
}

/// Deletions are bound only where no other part of the scene counts on the elements' indices.
template <typename T>
void bind_elements(py::module_& module, const char* class_name, bool deletes) {
    using List = Elements<T>;
    py::class_<List> list = bind_look_up<T, Element<T>>(module, class_name);
    list.def("__setitem__", [](const List& self, py::ssize_t index, const Element<T>& value) {
        self.list()[self.index(index)] = T(value.get());
    });
    list.def(
        "append",
        [](const List& self, Element<T>& element) {
            self.list().push_back(T(element.get()));
            if (!element.in_scene) {
                element = Element<T>(self.scene, self.list().size() - 1);
            }
        },
        "Adds the element, which is part of the scene from then on; of an element of a scene it adds a copy.");
    if (deletes) {
        list.def("__delitem__", [](const List& self, py::ssize_t index) {
            self.list().erase(self.list().begin() + static_cast<std::ptrdiff_t>(self.index(index)));
        });
        list.def(
            "clear", [](const List& self) { self.list().clear(); }, "Deletes all elements.");
    }
}

}  // namespace diptych::python
