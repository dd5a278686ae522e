// A packed scene's arrays on the device.
#pragma once

#include <string_view>

#include "memory/buffer.h"
#include "pack/packed_scene.h"
#include "memory/scene_addresses.h"
#include "memory/upload.h"

namespace diptych::core {

struct SceneMemory {
#define DECLARE_BUFFER(Type, name) Buffer name;
    SCENE_BUFFERS(DECLARE_BUFFER)
#undef DECLARE_BUFFER
    Revisions revisions;  // of the uploaded contents
};

/// What the array of that name is for.
Purpose purpose_of_array(std::string_view name);

/// Uploads every array that is not empty.
SceneMemory upload_scene(const Gpu& gpu, const PackedScene& packed);

/// Overwrites the arrays that move (MOVING_BUFFERS) with those of another moment, if their revision differs. Throws
/// Error if a count differs. Nothing that reads them may be in flight.
void upload_moment(Uploader& uploader, const PackedScene& moment, SceneMemory& scene);

/// Replaces the scene by the same scene with other settings. Geometry and texels whose size is unchanged stay. All
/// other arrays are overwritten, or recreated if their size differs. Nothing that reads them may be in flight.
void replace_scene(const Gpu& gpu, const PackedScene& packed, SceneMemory& scene);

/// Upper bound of the bytes that upload_moment copies.
std::uint64_t moving_bytes(const PackedScene& moment);

/// The scene's part of the address block.
SceneAddresses scene_addresses(const SceneMemory& scene);

std::uint64_t scene_bytes(const SceneMemory& scene);

}  // namespace diptych::core
