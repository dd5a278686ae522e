// A backend as the cases of numerical stability use it: shared functions called by themselves, and whole pictures.
#pragma once

#include <memory>
#include <span>
#include <string>
#include <vector>

#include "measured_functions.h"
#include "pack/packed_scene.h"
#include "render/renderer.h"

namespace diptych::core::stability {

using shared::MeasuredInput;
using shared::MeasuredOutput;

#define NAME_FUNCTION(name) name,
enum class Function : std::uint32_t { MEASURED_FUNCTIONS(NAME_FUNCTION) };
#undef NAME_FUNCTION

class Backend {
public:
    Backend() = default;
    Backend(const Backend&) = delete;
    Backend& operator=(const Backend&) = delete;
    virtual ~Backend() = default;

    virtual std::string name() const = 0;    // "cpu" or "vulkan"
    virtual std::string device() const = 0;  // its own name
    virtual std::vector<MeasuredOutput> run(Function function, std::span<const MeasuredInput> inputs) = 0;
    virtual std::unique_ptr<Renderer> make_renderer(const PackedScene& packed) = 0;
};

/// `threads` 0 means all.
std::unique_ptr<Backend> make_cpu_backend(int threads);

/// Throws NoDevice where no device serves, Error where the program was built without Vulkan.
std::unique_ptr<Backend> make_vulkan_backend(const std::string& device, bool validation);

}  // namespace diptych::core::stability
