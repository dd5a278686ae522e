#include "image/image_library.h"

#include <dlfcn.h>

#include <string_view>

#include "error.h"
#include "image/oiio/entry.h"
#include "own_library.h"
#include "threads.h"

namespace diptych::core {
namespace {

constexpr const char* file_name = "libdiptych_images.so";

[[noreturn]] void fail(const std::string& reason) {
    throw Error(std::string(file_name) + ", which reads and writes pictures, cannot be loaded: " + reason);
}

/// Libraries behind OpenImageIO start threads while they are loaded, some a fixed number and some one a core, and abort
/// the process where they cannot.
constexpr unsigned fixed_threads = 4;

const ImageLibrary& load() {
    require_threads(fixed_threads + machine_threads());
    void* library = open_own_library(file_name, RTLD_LAZY);
    if (library == nullptr) {
        fail(dlerror());
    }
    const auto* interface = static_cast<const char*>(dlsym(library, image_library_interface));
    const auto entry = reinterpret_cast<ImageLibraryEntry*>(dlsym(library, image_library_entry));
    if (entry == nullptr || interface == nullptr || interface != std::string_view(DIPTYCH_IMAGES_INTERFACE)) {
        fail("it belongs to another build than this program, which needs the interface " DIPTYCH_IMAGES_INTERFACE);
    }
    return *entry();  // stays loaded until the process ends
}

}  // namespace

const ImageLibrary& image_library() {
    static const ImageLibrary& library = load();
    return library;
}

}  // namespace diptych::core
