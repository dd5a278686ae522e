// The file's node tree.
#include "scene.h"

namespace diptych::python {

namespace {

constexpr const char* node_doc =
    "A node of the file's tree, at rest. Its name and its node_to_parent may be edited, the rest is the file's.\n\n"
    "An edited matrix moves all that hangs in the node and below it, at the next render: the matrices of these\n"
    "instances, cameras and lights are the product of their nodes' (a camera's and a light's without scale). A matrix\n"
    "of an instance, camera or light that is edited itself wins over the nodes, whether these are edited too or not:\n"
    "the object then hangs in no node. A skinned mesh hangs in none: its joints placed it when it was loaded.\n\n"
    "An animation that plays sets a node's translation, rotation or scale at each moment that a session poses, in\n"
    "place of that part of the matrix. The parts that it does not set, and a scene at rest, are the matrix's. The matrix\n"
    "of such a node has to be a product of the three.\n\n"
    ">>> import json, tempfile\n"
    ">>> import diptych as dp\n"
    ">>> tree = {\"asset\": {\"version\": \"2.0\"}, \"scene\": 0, \"scenes\": [{\"nodes\": [0]}],\n"
    "...         \"cameras\": [{\"type\": \"perspective\", \"perspective\": {\"yfov\": 0.8, \"znear\": 0.1}}],\n"
    "...         \"nodes\": [{\"name\": \"crane\", \"children\": [1], \"translation\": [0, 3, 0]},\n"
    "...                   {\"name\": \"eye\", \"camera\": 0, \"translation\": [0, 0, 2]}]}\n"
    ">>> with tempfile.NamedTemporaryFile(\"w\", suffix=\".gltf\") as file:\n"
    "...     print(json.dumps(tree), file=file, flush=True)\n"
    "...     scene = dp.load(file.name)\n"
    ">>> scene.nodes[\"crane\"].children, scene.nodes[\"eye\"].cameras[0].position\n"
    "([Node(name='eye')], (0.0, 3.0, 2.0))\n"
    ">>> scene.nodes[\"crane\"].position = (0, 5, 0)\n"
    ">>> film = dp.render(scene, spp=1, size=(4, 3))\n"
    ">>> scene.cameras[\"eye\"].position\n"
    "(0.0, 5.0, 2.0)\n";

/// A node of a scene: nodes are neither made nor deleted, so the index stays.
struct SceneNode {
    SceneNode(const Scene& of, std::size_t at) : scene(of), index(at) {}

    Node& get() const {
        Scene handle = scene;
        std::vector<Node>& nodes = handle.nodes();
        if (index >= nodes.size()) {
            throw py::index_error("this node was deleted from its scene");
        }
        return nodes[index];
    }
    NodeContent content() const { return scene.content_of(static_cast<int>(index)); }

    Scene scene;
    std::size_t index;
};

template <typename T>
std::vector<Element<T>> elements(const Scene& scene, const std::vector<int>& indices) {
    std::vector<Element<T>> elements;
    for (const int index : indices) {
        elements.emplace_back(scene, static_cast<std::size_t>(index));
    }
    return elements;
}

std::vector<SceneNode> children(const SceneNode& node) {
    std::vector<SceneNode> children;
    for (const int child : node.get().children) {
        children.emplace_back(node.scene, static_cast<std::size_t>(child));
    }
    return children;
}

void set_position(const SceneNode& node, const py::object& value) {
    const Point point = from_python<Point>("position", value);
    std::copy(point.begin(), point.end(), node.get().node_to_parent.begin() + 12);
}

}  // namespace

void bind_nodes(py::module_& module) {
    py::class_<SceneNode>(module, "Node", node_doc)
        .def_property(
            "name", [](const SceneNode& node) { return node.get().name; },
            [](const SceneNode& node, const py::object& value) {
                node.get().name = from_python<std::string>("name", value);
            },
            "Its name; need not be unique.")
        .def_property(
            "node_to_parent", [](const SceneNode& node) { return to_python(node.get().node_to_parent); },
            [](const SceneNode& node, const py::object& value) {
                node.get().node_to_parent = from_python<Matrix>("node_to_parent", value);
            },
            "Float64 (4, 4), [row, column]; affine.")
        .def_property(
            "position",
            [](const SceneNode& node) {
                const Matrix& matrix = node.get().node_to_parent;
                return py::make_tuple(matrix[12], matrix[13], matrix[14]);
            },
            &set_position, "(x, y, z), metres, in the parent's frame: the last column of node_to_parent.")
        .def_readonly("index", &SceneNode::index, "In Scene.nodes, and in the file.")
        .def_property_readonly(
            "parent",
            [](const SceneNode& node) -> std::optional<SceneNode> {
                const int parent = node.get().parent;
                return parent == none ? std::nullopt
                                      : std::optional(SceneNode(node.scene, static_cast<std::size_t>(parent)));
            },
            "A node, or None.")
        .def_property_readonly("children", &children, "Nodes, by ascending index.")
        .def_property_readonly(
            "animated", [](const SceneNode& node) { return node.get().animated; },
            "Whether an animation that plays sets the node.")
        .def_property_readonly(
            "instances", [](const SceneNode& node) { return elements<Instance>(node.scene, node.content().instances); },
            "What hangs in the node itself, not below it.")
        .def_property_readonly(
            "cameras", [](const SceneNode& node) { return elements<Camera>(node.scene, node.content().cameras); },
            "What hangs in the node itself, not below it.")
        .def_property_readonly(
            "lights", [](const SceneNode& node) { return elements<Light>(node.scene, node.content().lights); },
            "What hangs in the node itself, not below it.")
        .def(
            "__eq__", [](const SceneNode& a, const SceneNode& b) { return a.index == b.index && a.get() == b.get(); },
            py::is_operator())
        .def("__repr__",
             [](const SceneNode& node) { return "Node(name=" + std::string(py::repr(py::str(node.get().name))) + ")"; })
        .attr("__hash__") = py::none();
    bind_look_up<Node, SceneNode>(module, "Nodes");
}

}  // namespace diptych::python
