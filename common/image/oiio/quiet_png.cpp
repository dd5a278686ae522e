// OpenImageIO's handler of libpng's errors notes the message and returns to libpng, which then prints it on stderr and
// jumps. So libpng is given a handler that jumps by itself. This library comes before libpng where the loader looks for
// symbols, so OpenImageIO calls the two functions below. Declared here as libpng's manual has them: its headers are no
// package of the build.
#include <dlfcn.h>

extern "C" {
struct png_struct_def;
using PngHandler = void (*)(png_struct_def* png, const char* message);
png_struct_def* png_create_read_struct_2(const char* version, void* error_data, PngHandler error, PngHandler warning,
                                         void* memory_data, void* allocate, void* release);
void* png_get_mem_ptr(const png_struct_def* png);
void png_set_mem_fn(png_struct_def* png, void* memory_data, void* allocate, void* release);
[[noreturn]] void png_longjmp(const png_struct_def* png, int value);

[[gnu::visibility("default")]] png_struct_def* png_create_read_struct(const char* version, void* error_data,
                                                                      PngHandler error, PngHandler warning);
[[gnu::visibility("default")]] void png_set_error_fn(png_struct_def* png, void* error_data, PngHandler error,
                                                     PngHandler warning);
}

namespace {

// Of this thread; OpenImageIO names its handlers at creation, again right after it, and then no more.
thread_local png_struct_def* newest = nullptr;

void say_nothing(png_struct_def*, const char*) {}

/// The caller's handler takes the place of the data of an allocator, which there is none of.
void note_and_jump(png_struct_def* png, const char* message) {
    if (const auto note = reinterpret_cast<PngHandler>(png_get_mem_ptr(png))) {
        note(png, message);
    }
    png_longjmp(png, 1);
}

PngHandler quiet(PngHandler warning) {
    return warning != nullptr ? warning : say_nothing;
}

}  // namespace

png_struct_def* png_create_read_struct(const char* version, void* error_data, PngHandler error, PngHandler warning) {
    auto* const handler = reinterpret_cast<void*>(error);
    newest =
        png_create_read_struct_2(version, error_data, note_and_jump, quiet(warning), handler, nullptr, nullptr);
    return newest;
}

void png_set_error_fn(png_struct_def* png, void* error_data, PngHandler error, PngHandler warning) {
    using SetErrorFn = void(png_struct_def*, void*, PngHandler, PngHandler);
    static const auto of_libpng = reinterpret_cast<SetErrorFn*>(dlsym(RTLD_NEXT, "png_set_error_fn"));
    if (png != newest) {
        of_libpng(png, error_data, error, warning);
        return;
    }
    png_set_mem_fn(png, reinterpret_cast<void*>(error), nullptr, nullptr);
    of_libpng(png, error_data, note_and_jump, quiet(warning));
}
