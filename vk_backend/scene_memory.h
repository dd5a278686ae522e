// A packed scene's arrays on the device.
#pragma once

#include "buffer.h"
#include "pack/packed_scene.h"
#include "scene_addresses.h"

namespace diptych {

struct SceneMemory {
#define DECLARE_BUFFER(Type, name) Buffer name;
    SCENE_BUFFERS(DECLARE_BUFFER)
#undef DECLARE_BUFFER
};

/// Uploads every array that is not empty.
SceneMemory upload_scene(const Gpu& gpu, const PackedScene& packed);

/// The addresses of the scene's part of the block.
SceneAddresses scene_addresses(const SceneMemory& scene);

std::uint64_t scene_bytes(const SceneMemory& scene);

}  // namespace diptych
