#include "memory/scene_memory.h"

#include <algorithm>
#include <array>
#include <string_view>
#include <utility>

#include "error.h"

namespace diptych::core {
namespace {

// Every array may be an input of an acceleration structure build. The flag costs nothing for the others.
const vk::BufferUsageFlags usage = vk::BufferUsageFlagBits::eStorageBuffer |
                                   vk::BufferUsageFlagBits::eShaderDeviceAddress |
                                   vk::BufferUsageFlagBits::eAccelerationStructureBuildInputReadOnlyKHR;

// The largest arrays of a scene. Settings do not change their contents, but may omit an array.
bool is_lasting(std::string_view name) {
    return purpose_of_array(name) == Purpose::vertices || name == "texels";
}

bool holds(std::uint64_t revision, std::uint64_t wanted) {
    return wanted != 0 && revision == wanted;
}

template <typename T>
void replace(const Gpu& gpu, Uploader& uploader, const char* name, const std::vector<T>& elements, bool known,
             Buffer& buffer) {
    const std::span<const T> all(elements);
    if (buffer.size != all.size_bytes()) {
        buffer = upload_array(gpu, uploader, purpose_of_array(name), all, usage);
    } else if (!known || !is_lasting(name)) {
        uploader.upload(buffer, std::as_bytes(all));
    }
}

}  // namespace

Purpose purpose_of_array(std::string_view name) {
    constexpr std::array vertices = {"positions", "triangles", "normals", "tangents", "uvs", "colors"};
    constexpr std::array textures = {"texels", "environment_texels", "environment_table"};
    const auto is_one_of = [&](const auto& names) {
        return std::find(names.begin(), names.end(), name) != names.end();
    };
    return is_one_of(vertices) ? Purpose::vertices : is_one_of(textures) ? Purpose::textures : Purpose::tables;
}

SceneMemory upload_scene(const Gpu& gpu, const PackedScene& packed) {
    SceneMemory scene;
    Uploader uploader(gpu);
#define UPLOAD_BUFFER(Type, name)                                                                                      \
    scene.name = upload_array(gpu, uploader, purpose_of_array(#name), std::span(packed.name), usage);
    SCENE_BUFFERS(UPLOAD_BUFFER)
#undef UPLOAD_BUFFER
    uploader.finish();
    scene.revisions = packed.revisions;
    return scene;
}

void replace_scene(const Gpu& gpu, const PackedScene& packed, SceneMemory& scene) {
    Uploader uploader(gpu, std::uint64_t{8} << 20U);
    // If memory runs out midway, it is unknown which arrays are complete.
    const Revisions held = std::exchange(scene.revisions, {});
#define REPLACE_BUFFER(Type, name)                                                                                     \
    if (scene.name.size != std::span(packed.name).size_bytes() || !holds(held.name, packed.revisions.name)) {          \
        replace(gpu, uploader, #name, packed.name, held.name != 0, scene.name);                                        \
    }
    SCENE_BUFFERS(REPLACE_BUFFER)
#undef REPLACE_BUFFER
    uploader.finish();
    scene.revisions = packed.revisions;
}

void upload_moment(Uploader& uploader, const PackedScene& moment, SceneMemory& scene) {
    bool uploads = false;
    const auto overwrite = [&](const Buffer& buffer, const char* name, std::span<const std::byte> bytes,
                               std::uint64_t wanted, std::uint64_t& revision) {
        if (buffer.size != bytes.size()) {
            throw Error(std::string("scene buffer ") + name + ": " + std::to_string(bytes.size()) +
                        " bytes where the moment before had " + std::to_string(buffer.size));
        }
        if (!holds(revision, wanted)) {
            uploader.upload(buffer, bytes);
            revision = wanted;
            uploads = true;
        }
    };
#define UPLOAD_BUFFER(Type, name)                                                                                      \
    overwrite(scene.name, #name, std::as_bytes(std::span(moment.name)), moment.revisions.name, scene.revisions.name);
    MOVING_BUFFERS(UPLOAD_BUFFER)
#undef UPLOAD_BUFFER
    if (uploads) {
        uploader.finish();
    }
}

std::uint64_t moving_bytes(const PackedScene& moment) {
    std::uint64_t bytes = 0;
#define ADD_BYTES(Type, name) bytes += moment.name.size() * sizeof(moment.name[0]);
    MOVING_BUFFERS(ADD_BYTES)
#undef ADD_BYTES
    return bytes;
}

SceneAddresses scene_addresses(const SceneMemory& scene) {
    SceneAddresses addresses;
#define COPY_ADDRESS(Type, name) addresses.name = scene.name.address;
    SCENE_BUFFERS(COPY_ADDRESS)
#undef COPY_ADDRESS
    return addresses;
}

std::uint64_t scene_bytes(const SceneMemory& scene) {
    std::uint64_t bytes = 0;
#define ADD_BYTES(Type, name) bytes += scene.name.size;
    SCENE_BUFFERS(ADD_BYTES)
#undef ADD_BYTES
    return bytes;
}

}  // namespace diptych::core
