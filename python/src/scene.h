// The parts of a scene's binding that have a file of their own.
#pragma once

#include "elements.h"

namespace diptych::python {

void bind_environment(py::module_& module);
void bind_scene_environment(py::class_<Scene>& scene);
void bind_nodes(py::module_& module);
void bind_meshes(py::class_<Scene>& scene);

}  // namespace diptych::python
