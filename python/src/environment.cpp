// The light from infinity. An environment is a value on its own, or a scene's, through which edits are written.
#include "scene.h"

namespace diptych::python {

namespace {

struct BoundEnvironment {
    explicit BoundEnvironment(Environment value = {}) {
        get = [own = std::make_shared<Environment>(std::move(value))]() -> Environment& { return *own; };
    }
    explicit BoundEnvironment(const Scene& of) {
        get = [scene = of]() mutable -> Environment& { return scene.environment(); };
    }
    std::function<Environment&()> get;
};

std::shared_ptr<const EnvironmentMap> to_map(const py::object& value) {
    if (value.is_none()) {
        return nullptr;
    }
    const auto array = py::array_t<float, py::array::c_style | py::array::forcecast>::ensure(value);
    if (!array || array.ndim() != 3 || array.shape(2) != 3 || array.size() == 0) {
        PyErr_Clear();
        throw SettingError("map: wants float32 (height, width, 3)");
    }
    auto map = std::make_shared<EnvironmentMap>();
    map->height = static_cast<int>(array.shape(0));
    map->width = static_cast<int>(array.shape(1));
    const Vec3* first = reinterpret_cast<const Vec3*>(array.data());
    map->texels.assign(first, first + array.size() / 3);
    return map;
}

py::object to_view(const std::shared_ptr<const EnvironmentMap>& map) {
    if (!map) {
        return py::none();
    }
    auto* owned = new std::shared_ptr<const EnvironmentMap>(map);
    const py::capsule owner(owned,
                            [](void* memory) { delete static_cast<std::shared_ptr<const EnvironmentMap>*>(memory); });
    return view_of(map->texels.data()->data(), {map->height, map->width, 3}, owner);
}

}  // namespace

void bind_environment(py::module_& module) {
    using E = BoundEnvironment;
    py::class_<E>(module, "Environment", "Light from infinity: radiance scale, times the map where there is one.")
        .def(py::init([](const Vec3& scale, double rotation, const py::object& map) {
                 return E(Environment{scale, rotation, to_map(map)});
             }),
             py::kw_only(), py::arg("scale") = py::make_tuple(0.0, 0.0, 0.0), py::arg("rotation") = 0.0,
             py::arg("map") = py::none())
        .def_property(
            "scale", [](const E& self) { return to_python(self.get().scale); },
            [](E& self, const py::object& value) { self.get().scale = from_python<Vec3>("scale", value); },
            "(r, g, b), W/(sr m²), or a factor on the map.")
        .def_property(
            "rotation", [](const E& self) { return self.get().rotation; },
            [](E& self, const py::object& value) { self.get().rotation = from_python<double>("rotation", value); },
            "Radians, counter-clockwise about +Y seen from above.")
        .def_property(
            "map", [](const E& self) { return to_view(self.get().map); },
            [](E& self, const py::object& value) { self.get().map = to_map(value); },
            "Float32 (h, w, 3), linear radiance of an equirectangular map whose centre looks along -Z; or None. "
            "Reading\n"
            "gives a read-only view; an array that is set is copied.");
    module.def(
        "load_environment",
        [](const py::object& path, std::uint64_t memory_limit) {
            return E(load_environment(path_of(path), memory_limit));
        },
        py::arg("path"), py::arg("memory_limit") = 0,
        "Reads a map from an .hdr or .exr file, at scale (1, 1, 1). The file may ask for memory_limit bytes; 0 is a quarter\n"
        "of the machine's memory.");
}

void bind_scene_environment(py::class_<Scene>& scene) {
    scene.def_property(
        "environment", [](const Scene& self) { return BoundEnvironment(self); },
        [](Scene& self, const BoundEnvironment& value) { self.environment() = Environment(value.get()); },
        "Light from infinity; an Environment that is set is copied.");
}

}  // namespace diptych::python
