#include "own_library.h"

#include <dlfcn.h>
#include <link.h>

#include <filesystem>

namespace diptych::core {
namespace {

namespace fs = std::filesystem;

/// The file that this code was loaded from; the dynamic linker gives the program itself no name.
fs::path own_file() {
    Dl_info info{};
    void* extra = nullptr;
    if (dladdr1(reinterpret_cast<const void*>(&own_file), &info, &extra, RTLD_DL_LINKMAP) != 0) {
        const std::string name = static_cast<const link_map*>(extra)->l_name;
        return name.empty() ? fs::path("/proc/self/exe") : fs::path(name);
    }
    return {};
}

}  // namespace

// The dynamic linker alone would do, by RUNPATH, but looks in LD_LIBRARY_PATH first, where another version may lie; and
// it asks for the RUNPATH of whoever calls dlopen, which under AddressSanitizer is the sanitizer.
void* open_own_library(const std::string& name, int binding) {
    std::error_code error;
    const fs::path folder = fs::canonical(own_file(), error).parent_path();
    if (!error) {
        const fs::path above = folder.parent_path();  // test programs lie in a folder of the build tree
        for (const fs::path& place : {folder / name, above / DIPTYCH_LIBRARY_FOLDER / name, above / name}) {
            if (fs::exists(place, error)) {
                return dlopen(place.c_str(), binding | RTLD_LOCAL);
            }
        }
    }
    return dlopen(name.c_str(), binding | RTLD_LOCAL);
}

}  // namespace diptych::core
