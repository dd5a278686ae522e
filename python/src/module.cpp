#include "bindings.h"
#include "diptych/version.h"

PYBIND11_MODULE(_diptych, module) {
    using namespace diptych::python;
    module.doc() = "The compiled part of the package diptych.";
    module.attr("__version__") = DIPTYCH_VERSION;
    bind_errors(module);
    bind_settings(module);
    bind_scene(module);
    bind_film(module);
    bind_session(module);
    bind_measure(module);
    bind_engines(module);
}
