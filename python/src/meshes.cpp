// Meshes and textures from arrays, which are checked and copied once.
#include "scene.h"

namespace diptych::python {

namespace {

std::string shape_of(const py::array& array) {
    return py::str(array.attr("shape"));
}

/// An array of rows of T. Its kind is NumPy's letter: 'f' takes all real numbers, 'u' integers alone.
template <typename T>
py::array_t<T, py::array::c_style | py::array::forcecast> rows(const char* name, const py::object& value, int columns,
                                                               const std::string& kinds) {
    const py::array given = py::array::ensure(value);
    const std::string wanted = std::string(name) + ": wants " + (kinds == "iu" ? "integers" : "float32") + " (n, " +
                               std::to_string(columns) + ")";
    if (!given) {
        PyErr_Clear();
        throw SettingError(wanted);
    }
    const bool empty = given.size() == 0;  // [] has no type worth a word
    if (!empty && kinds.find(given.dtype().kind()) == std::string::npos) {
        throw SettingError(wanted + ", not " + std::string(py::str(given.dtype())));
    }
    if (!empty && (given.ndim() != 2 || given.shape(1) != columns)) {
        throw SettingError(wanted + ", not " + shape_of(given));
    }
    return given;
}

template <typename Row, typename T, int flags>
std::span<const Row> span_of(const py::array_t<T, flags>& array) {
    static_assert(sizeof(Row) % sizeof(T) == 0);
    return {reinterpret_cast<const Row*>(array.data()),
            static_cast<std::size_t>(array.size()) / (sizeof(Row) / sizeof(T))};
}

/// Triangles with an index below 0 or over 32 bits would wrap around to others.
void refuse_wrapping(const py::object& triangles) {
    const py::array given = py::array::ensure(triangles);
    if (given && given.size() > 0) {
        const py::object least = given.attr("min")();
        const py::object most = given.attr("max")();
        if (least < py::int_(0) || most > py::int_(0xFFFFFFFFU)) {
            throw SettingError("triangles: index " + std::string(py::str(least < py::int_(0) ? least : most)) +
                               " is out of range");
        }
    }
}

int material_index(Scene& scene, const py::object& value) {
    auto& materials = scene.materials();
    if (value.is_none()) {
        return none;
    }
    if (py::isinstance<Element<Material>>(value)) {
        auto& element = value.cast<Element<Material>&>();
        const Material* material = &element.get();
        for (std::size_t i = 0; i < materials.size(); ++i) {
            if (material == &materials[i]) {
                return static_cast<int>(i);
            }
        }
        return static_cast<int>(materials.size());  // appended once the mesh is accepted
    }
    const Elements<Material> list{scene};
    if (py::isinstance<py::str>(value)) {
        return static_cast<int>(list.index(value.cast<std::string>()));
    }
    return static_cast<int>(list.index(from_python<py::ssize_t>("material", value)));
}

int add_mesh(Scene& scene, const py::object& positions, const py::object& triangles, const py::object& normals,
             const py::object& uvs, const py::object& material, const py::object& transform, const std::string& name) {
    const auto points = rows<float>("positions", positions, 3, "fiu");
    refuse_wrapping(triangles);
    const auto corners = rows<std::uint32_t>("triangles", triangles, 3, "iu");
    const auto directions = rows<float>("normals", normals.is_none() ? py::list() : normals, 3, "fiu");
    const auto coordinates = rows<float>("uvs", uvs.is_none() ? py::list() : uvs, 2, "fiu");
    MeshData mesh{name,
                  span_of<Vec3>(points),
                  span_of<std::array<std::uint32_t, 3>>(corners),
                  span_of<Vec3>(directions),
                  span_of<Vec2>(coordinates),
                  material_index(scene, material)};
    const Matrix object_to_world = transform.is_none() ? identity : to_matrix("transform", transform);
    auto& materials = scene.materials();
    const bool adds_material = mesh.material == static_cast<int>(materials.size());
    if (adds_material) {
        materials.push_back(Material(material.cast<Element<Material>&>().get()));
    }
    try {
        const int index = scene.add_mesh(mesh, object_to_world);
        if (adds_material && !material.cast<Element<Material>&>().in_scene) {
            material.cast<Element<Material>&>() = Element<Material>(scene, static_cast<std::size_t>(mesh.material));
        }
        return index;
    } catch (const Error& error) {
        if (adds_material) {
            materials.pop_back();
        }
        throw SettingError(error.what());
    }
}

int add_texture(Scene& scene, const py::object& pixels, const std::string& name) {
    const py::array given = py::array::ensure(pixels);
    if (!given || given.ndim() != 3 || (given.shape(2) != 3 && given.shape(2) != 4) ||
        !py::isinstance<py::array_t<std::uint8_t>>(given)) {
        PyErr_Clear();
        throw SettingError("pixels: wants uint8 (height, width, 3 or 4)");
    }
    const py::array_t<std::uint8_t, py::array::c_style | py::array::forcecast> array = given;
    const auto height = static_cast<int>(array.shape(0));
    const auto width = static_cast<int>(array.shape(1));
    const auto channels = static_cast<std::size_t>(array.shape(2));
    std::vector<std::uint8_t> rgba(static_cast<std::size_t>(array.size()) / channels * 4, 255);
    for (std::size_t pixel = 0; pixel < rgba.size() / 4; ++pixel) {
        std::copy_n(array.data() + pixel * channels, channels, rgba.data() + pixel * 4);
    }
    return scene.add_texture(width, height, rgba, name);
}

}  // namespace

void bind_meshes(py::class_<Scene>& scene) {
    scene.def(
        "add_mesh", &add_mesh, py::arg("positions"), py::arg("triangles"), py::arg("normals") = py::none(),
        py::arg("uvs") = py::none(), py::arg("material") = py::none(), py::arg("transform") = py::none(), py::kw_only(),
        py::arg("name") = "",
        "Adds a mesh and one instance of it, and returns the mesh's index.\n\n"
        "positions: float32 (n, 3), metres. triangles: integers (m, 3), indices into positions; counter-clockwise is\n"
        "the front. normals: float32 (n, 3), or None for flat shading. uvs: float32 (n, 2), or None. material: its\n"
        "index, its name, a Material, which joins the scene, or None for a default. transform: (4, 4), [row, column].\n"
        "Arrays are checked and copied; where one is wrong, SettingError is raised and nothing is added.\n\n"
        ">>> import diptych as dp\n"
        ">>> scene = dp.Scene()\n"
        ">>> square = [(-1, 0, -1), (-1, 0, 1), (1, 0, 1), (1, 0, -1)]\n"
        ">>> scene.add_mesh(square, [(0, 1, 2), (0, 2, 3)], material=dp.Material(name=\"floor\"))\n"
        "0\n"
        ">>> scene.triangle_count, scene.materials.names()\n"
        "(2, ['floor'])\n");
    scene.def(
        "add_texture", &add_texture, py::arg("pixels"), py::arg("name") = "",
        "Adds uint8 (h, w, 3) or (h, w, 4), row 0 on top, as a texture that repeats and is filtered. Returns the\n"
        "index that a TextureSlot takes.");
}

}  // namespace diptych::python
