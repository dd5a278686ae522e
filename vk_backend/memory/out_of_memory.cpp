#include "memory/out_of_memory.h"

#include <fmt/format.h>

#include "error.h"

namespace diptych::core {

const char* what_needs_less(Purpose purpose) {
    switch (purpose) {
    case Purpose::film:
    case Purpose::readback:
        return "a smaller `size` or no `layers` needs less";
    case Purpose::reservoirs:
        return "a smaller `size` or the `integrator` path needs less";
    case Purpose::paths_in_flight:
        return "a smaller `size` or a smaller scene leaves more";
    case Purpose::textures:
        return "smaller textures in the scene's file need less";
    case Purpose::structures:
    case Purpose::structure_scratch:
    case Purpose::vertices:
    case Purpose::tables:
        return "a scene of fewer triangles, instances and lights needs less";
    case Purpose::display:
        return "a smaller window needs less";
    default:
        return "a smaller `size` or a smaller scene needs less";
    }
}

void refuse(const Gpu& gpu, const std::string& need, const HeapRoom& room, const std::string& advice) {
    const std::string whole =
        room.of_host ? "the machine's memory or of what the process may use" : size_text(room.size);
    throw OutOfMemory(fmt::format("Vulkan device {}: out of memory: {}; free: {} of {}; {}; the `backend` cpu needs no "
                                  "device",
                                  gpu.name, need, size_text(room.free), whole, advice));
}

void refuse_allocation(const Gpu& gpu, Purpose purpose, std::uint64_t bytes, std::uint32_t heap,
                       const std::string& reason) {
    refuse(gpu,
           fmt::format("{} for {}{}; in use: {}", size_text(bytes), name_of(purpose),
                       reason.empty() ? "" : " (" + reason + ")", text_of(gpu.memory_use->bytes())),
           heap_room(gpu, heap), what_needs_less(purpose));
}

}  // namespace diptych::core
