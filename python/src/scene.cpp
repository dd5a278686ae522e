// Scenes, what they consist of, and how they are loaded.
#include "scene.h"

namespace diptych::python {

namespace {

constexpr const char* material_doc =
    "A glTF 2.0 material. Factors multiply textures. Colours are linear Rec.709.\n\n"
    "A material made on its own becomes part of a scene by Scene.materials.append or Scene.add_mesh. One that is part\n"
    "of a scene writes its edits through; sessions see them at their next render.\n\n"
    ">>> import diptych as dp\n"
    ">>> scene = dp.Scene()\n"
    ">>> scene.materials.append(dp.Material(name=\"paint\", base_color=(1, 0, 0, 1)))\n"
    ">>> scene.materials[\"paint\"].roughness = 0.25\n"
    ">>> scene.materials[0]\n"
    "Material(name='paint', base_color=(1.0, 0.0, 0.0, 1.0), roughness=0.25)\n";

constexpr const char* scene_doc =
    "What is rendered: right-handed, metres, +Y up, angles in radians.\n\n"
    "Scene() is empty and black. Lists give their elements by index or by name. Scenes may be edited at any time\n"
    "between renders, and not by two threads at once.\n\n"
    ">>> import diptych as dp\n"
    ">>> scene = dp.Scene()\n"
    ">>> scene.lights.append(dp.Light(name=\"lamp\", position=(0, 2, 0), intensity=(10, 10, 10)))\n"
    ">>> scene.lights[\"lamp\"].intensity = (5, 5, 5)  # W/sr\n"
    ">>> len(scene.lights), scene.triangle_count\n"
    "(1, 0)\n";

constexpr const char* hangs_in_doc =
    "Index of the node that it hangs in (diptych.Node), -1 is none. A matrix that is edited wins over the node: node\n"
    "is -1 from the next render on.";

void bind_values(py::module_& module) {
    py::class_<TextureSlot>(
        module, "TextureSlot",
        "Where a material reads a texture; immutable. (u', v') = (u_row . (u, v, 1), v_row . (u, v, 1)).")
        .def(py::init([](int texture, int uv_set, const Vec3& u_row, const Vec3& v_row) {
                 return TextureSlot{texture, uv_set, u_row, v_row};
             }),
             py::arg("texture") = none, py::arg("uv_set") = 0, py::arg("u_row") = py::make_tuple(1.0, 0.0, 0.0),
             py::arg("v_row") = py::make_tuple(0.0, 1.0, 0.0))
        .def_readonly("texture", &TextureSlot::texture, "Of Scene.add_texture, or of the file; -1 is none.")
        .def_readonly("uv_set", &TextureSlot::uv_set, "0 or 1.")
        .def_property_readonly("u_row", [](const TextureSlot& slot) { return to_python(slot.u_row); })
        .def_property_readonly("v_row", [](const TextureSlot& slot) { return to_python(slot.v_row); })
        .def(
            "__eq__", [](const TextureSlot& a, const TextureSlot& b) { return a == b; }, py::is_operator())
        .def("__repr__",
             [](const TextureSlot& slot) {
                 return "TextureSlot(texture=" + std::to_string(slot.texture) +
                        ", uv_set=" + std::to_string(slot.uv_set) + ")";
             })
        .attr("__hash__") = py::none();
    ElementClass<Material>(module, "Material", material_doc)
        .field("name", &Material::name, "Its name; need not be unique.")
        .field("base_color", &Material::base_color, "(r, g, b, a), 0 to 1.")
        .field("metallic", &Material::metallic, "0 to 1.")
        .field("roughness", &Material::roughness, "0 to 1, perceptual: the microfacet alpha is its square.")
        .field("normal_scale", &Material::normal_scale, "Factor on the normal map's x and y.")
        .field("emission", &Material::emission, "(r, g, b), radiance, W/(sr m²).")
        .field("ior", &Material::ior, "Index of refraction: 0, or at least 1.")
        .field("specular", &Material::specular, "0 to 1.")
        .field("specular_color", &Material::specular_color, "(r, g, b).")
        .field("alpha_mode", &Material::alpha_mode, "\"opaque\", \"mask\" or \"blend\".")
        .field("alpha_cutoff", &Material::alpha_cutoff, "Of mask: less alpha is a hole.")
        .field("double_sided", &Material::double_sided, "Emits from both sides.")
        .field("unlit", &Material::unlit, "Shows base_color and scatters nothing.")
        .field("base_color_texture", &Material::base_color_texture, "rgb sRGB, a linear.")
        .field("metallic_roughness_texture", &Material::metallic_roughness_texture, "g roughness, b metallic.")
        .field("normal_texture", &Material::normal_texture, "Tangent space, +Y up.")
        .field("emission_texture", &Material::emission_texture, "sRGB.")
        .field("specular_texture", &Material::specular_texture, "a.")
        .field("specular_color_texture", &Material::specular_color_texture, "rgb sRGB.");
    ElementClass<Camera>(module, "Camera", "A camera, which looks along its local -Z.")
        .field("name", &Camera::name, "Its name; need not be unique.")
        .field("camera_to_world", &Camera::camera_to_world, "Float64 (4, 4), [row, column]; rigid.")
        .position(&Camera::camera_to_world)
        .field("node", &Camera::node, hangs_in_doc)
        .field("orthographic", &Camera::orthographic, "Else perspective.")
        .field("vertical_fov", &Camera::vertical_fov, "Of a perspective camera: radians, between 0 and pi.")
        .field("orthographic_height", &Camera::orthographic_height, "Metres, of the whole view.")
        .field("lens_radius", &Camera::lens_radius, "Metres; 0 is a pinhole.")
        .field("focus_distance", &Camera::focus_distance, "Metres along -Z.");
    ElementClass<Light>(module, "Light", "A light of no size, which looks along its local -Z.")
        .field("name", &Light::name, "Its name; need not be unique.")
        .field("kind", &Light::kind, "\"point\", \"spot\" or \"directional\".")
        .field("light_to_world", &Light::light_to_world, "Float64 (4, 4), [row, column].")
        .position(&Light::light_to_world)
        .field("node", &Light::node, hangs_in_doc)
        .field("intensity", &Light::intensity, "(r, g, b): W/sr of point and spot, W/m² of directional.")
        .field("inner_cone", &Light::inner_cone, "Of spot: radians.")
        .field("outer_cone", &Light::outer_cone, "Of spot: radians, greater than inner_cone, at most pi/2.");
    ElementClass<Instance>(module, "Instance", "A mesh at its place.")
        .field("name", &Instance::name, "Its name; need not be unique.")
        .field("mesh", &Instance::mesh, "What Scene.add_mesh returned.")
        .field("object_to_world", &Instance::object_to_world, "Float64 (4, 4), [row, column].")
        .position(&Instance::object_to_world)
        .field("node", &Instance::node, hangs_in_doc);
    bind_elements<Material>(module, "Materials", false);
    bind_elements<Camera>(module, "Cameras", true);
    bind_elements<Light>(module, "Lights", true);
    bind_elements<Instance>(module, "Instances", true);
}

Scene loaded(const py::object& path, const std::vector<std::string>& ignore_extensions, bool strict,
             bool allow_external, std::uint64_t memory_limit, const std::string& animation, bool complete) {
    std::vector<std::string> warnings;
    LoadOptions options{ignore_extensions, strict, allow_external, memory_limit, animation,
                        complete,          [&](const std::string& line) { warnings.push_back(line); }};
    const std::string file = path_of(path);
    Scene scene = [&] {
        const py::gil_scoped_release others_run;
        return load(file, options);
    }();
    warn(warnings, 1);
    return scene;
}

template <typename T>
auto list_getter() {
    return [](const Scene& scene) { return Elements<T>{scene}; };
}

}  // namespace

void bind_scene(py::module_& module) {
    bind_values(module);
    bind_environment(module);
    bind_nodes(module);
    py::class_<Scene> scene(module, "Scene", scene_doc);
    scene.def(py::init<>())
        .def_property_readonly("materials", list_getter<Material>())
        .def_property_readonly("cameras", list_getter<Camera>(),
                               "A scene without one is seen by a camera that frames it.")
        .def_property_readonly("lights", list_getter<Light>())
        .def_property_readonly("instances", list_getter<Instance>())
        .def_property_readonly("nodes", list_getter<Node>(),
                               "All nodes of the file, with the file's indices; none of a scene that was built.")
        .def_property_readonly("name", &Scene::name, "The file's path; empty for a scene that was built.")
        .def_property_readonly("mesh_count", &Scene::mesh_count)
        .def_property_readonly("triangle_count", &Scene::triangle_count, "Over all instances.")
        .def_property_readonly("animations", &Scene::animations, "Names, in the file's order.")
        .def_property_readonly("duration", &Scene::duration, "Seconds to the last key of any animation.")
        .def("copy", &Scene::copy, "A scene of its own with the same content.")
        .def("__repr__", [](const Scene& self) {
            const std::string name = self.name().empty() ? "" : " " + self.name() + ",";
            return "<Scene" + name + " " + std::to_string(self.triangle_count()) + " triangles>";
        });
    scene.def(
        "add_sun",
        [](Scene& self, double azimuth, double elevation, double irradiance) {
            self.add(Sun{azimuth, elevation, irradiance});
            return Element<Light>(self, self.lights().size() - 1);
        },
        py::arg("azimuth") = 0.0, py::arg("elevation") = 45.0, py::arg("irradiance") = 1.0,
        "Adds a directional light and returns it. Azimuth in degrees from -Z, clockwise seen from above; elevation in\n"
        "degrees above the horizon; irradiance in W/m², of a surface that faces the sun.");
    bind_scene_environment(scene);
    bind_meshes(scene);
    module.def("load", &loaded, py::arg("path"), py::kw_only(),
               py::arg("ignore_extensions") = std::vector<std::string>(), py::arg("strict") = false,
               py::arg("allow_external") = false, py::arg("memory_limit") = 0, py::arg("animation") = "", py::arg("complete") = true,
               "Loads a .gltf or .glb file.\n\n"
               "What it cannot show becomes a SceneWarning; strict raises Error instead. ignore_extensions names glTF\n"
               "extensions that the file requires and that are done without. allow_external reads what the file names\n"
               "outside its folder too. memory_limit is the number of bytes that the file may ask for; 0 is a quarter of the\n"
               "machine's memory. animation is the name or the index of the one that plays; all play where it is "
               "empty.\n"
               "complete adds a camera and a neutral sky where the scene has neither.");
    module.def(
        "look_at",
        [](const Point& eye, const Point& target, const Point& up, double vertical_fov) {
            return Element<Camera>(look_at(eye, target, up, vertical_fov));
        },
        py::arg("eye"), py::arg("target"), py::arg("up") = py::make_tuple(0.0, 1.0, 0.0),
        py::arg("vertical_fov") = 0.785,
        "A perspective camera at the point eye that looks at the point target; metres, radians.\n\n"
        "Its camera_to_world serves as a spot light's light_to_world too.\n\n"
        ">>> import diptych as dp\n"
        ">>> dp.look_at((0, 1, 5), (0, 1, 0)).position\n"
        "(0.0, 1.0, 5.0)\n");
}

}  // namespace diptych::python
