#include "scene_memory.h"

#include "error.h"

namespace diptych {

SceneMemory upload_scene(const Gpu& gpu, const PackedScene& packed) {
    using Usage = vk::BufferUsageFlagBits;
    // Any of them may feed an acceleration structure build; the flag costs nothing on those that do not.
    const vk::BufferUsageFlags usage =
        Usage::eStorageBuffer | Usage::eShaderDeviceAddress | Usage::eAccelerationStructureBuildInputReadOnlyKHR;
    SceneMemory scene;
    Uploader uploader(gpu);
#define UPLOAD_BUFFER(Type, name)                                                                                      \
    scene.name = upload_array(gpu, uploader, "scene buffer " #name, std::span(packed.name), usage);
    SCENE_BUFFERS(UPLOAD_BUFFER)
#undef UPLOAD_BUFFER
    uploader.finish();
    return scene;
}

void upload_moment(Uploader& uploader, const PackedScene& moment, const SceneMemory& scene) {
    const auto overwrite = [&](const Buffer& buffer, const char* name, std::span<const std::byte> bytes) {
        if (buffer.size != bytes.size()) {
            throw Error(std::string("scene buffer ") + name + ": " + std::to_string(bytes.size()) +
                        " bytes where the moment before had " + std::to_string(buffer.size));
        }
        uploader.upload(buffer, bytes);
    };
#define UPLOAD_BUFFER(Type, name) overwrite(scene.name, #name, std::as_bytes(std::span(moment.name)));
    MOVING_BUFFERS(UPLOAD_BUFFER)
#undef UPLOAD_BUFFER
    uploader.finish();
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

}  // namespace diptych
