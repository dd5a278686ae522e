// Addresses of all buffers that shaders read: the uniform block SceneAddresses of shaders/scene_hooks.glsl.
#pragma once

#include <cstdint>

#include "../../shaders/device_buffers.h"
#include "language/scene_buffers.h"

namespace diptych::core {

/// Device addresses; 0 if there is no such buffer.
struct SceneAddresses {
#define DECLARE_ADDRESS(Type, name) std::uint64_t name = 0;
    SCENE_BUFFERS(DECLARE_ADDRESS)
#undef DECLARE_ADDRESS
#define DECLARE_ADDRESS(Type, name, alignment, access) std::uint64_t name = 0;
    DEVICE_ARRAYS(DECLARE_ADDRESS)
#undef DECLARE_ADDRESS
#define DECLARE_ADDRESS(name) std::uint64_t name = 0;
    DEVICE_BLOCKS(DECLARE_ADDRESS)
#undef DECLARE_ADDRESS
};

}  // namespace diptych::core
