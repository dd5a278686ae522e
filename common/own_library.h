// The shared objects that Diptych opens itself: libdiptych_images.so, libdiptych_mpi.so.
#pragma once

#include <string>

namespace diptych::core {

/// Opens the shared object `name`: beside the program or library that holds this code, in the folder of libraries of
/// its installed tree, in the folder above, or else where the dynamic linker finds it. `binding` is RTLD_NOW, which
/// refuses an object that lacks a function, or RTLD_LAZY, which loads sooner. Its symbols stay its own. nullptr where
/// there is none or it does not load; dlerror() then says why.
void* open_own_library(const std::string& name, int binding);

}  // namespace diptych::core
