// The shared objects that Diptych opens itself: libdiptych_images.so, libdiptych_mpi.so.
#pragma once

#include <string>

namespace diptych::core {

/// Opens the shared object `name`. Looks beside the program or library that holds this code, then in the library folder
/// of its installed tree, then in the folder above (for test programs). The first file found is opened. If there is
/// none, the dynamic linker searches by name. `binding` is RTLD_NOW, with which an object that needs a missing function
/// fails to load, or RTLD_LAZY, which loads faster but ends the process at the first call of a missing function. The
/// object's symbols are visible to nobody else (RTLD_LOCAL). Returns nullptr on failure; dlerror() then says why.
void* open_own_library(const std::string& name, int binding);

}  // namespace diptych::core
