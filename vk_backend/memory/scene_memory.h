// A packed scene's arrays on the device.
#pragma once

#include "memory/buffer.h"
#include "pack/packed_scene.h"
#include "memory/scene_addresses.h"
#include "memory/upload.h"

namespace diptych::core {

struct SceneMemory {
#define DECLARE_BUFFER(Type, name) Buffer name;
    SCENE_BUFFERS(DECLARE_BUFFER)
#undef DECLARE_BUFFER
    Revisions revisions;  // of what lies in them
};

/// Uploads every array that is not empty.
SceneMemory upload_scene(const Gpu& gpu, const PackedScene& packed);

/// Overwrites what moves (MOVING_BUFFERS) with that of another moment, where its revision is another. Throws Error
/// where a count is another. Nothing that reads it may be in flight.
void upload_moment(Uploader& uploader, const PackedScene& moment, SceneMemory& scene);

/// The same scene under other settings: arrays of geometry and texels stay where their size is the same, all others are
/// overwritten, or made anew where their size is another. Nothing that reads them may be in flight.
void replace_scene(const Gpu& gpu, const PackedScene& packed, SceneMemory& scene);

/// Bytes that upload_moment copies at most.
std::uint64_t moving_bytes(const PackedScene& moment);

/// The addresses of the scene's part of the block.
SceneAddresses scene_addresses(const SceneMemory& scene);

std::uint64_t scene_bytes(const SceneMemory& scene);

}  // namespace diptych::core
