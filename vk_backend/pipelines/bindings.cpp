#include "pipelines/bindings.h"

#include <array>

#include "memory/upload.h"

namespace diptych::core {
namespace {

constexpr std::uint32_t structure_binding = 0;
constexpr std::uint32_t previous_binding = 3;
constexpr std::uint32_t emitters_binding = 4;

}  // namespace

Bindings make_bindings(const Gpu& gpu, const PipelineLayout& layout, const Structures& structures,
                       const SceneAddresses& addresses, const shared::RenderConstants& constants) {
    using Type = vk::DescriptorType;
    Bindings made;
    Uploader uploader(gpu, 4096);
    const vk::BufferUsageFlags usage = vk::BufferUsageFlagBits::eUniformBuffer;
    made.addresses = upload_array(gpu, uploader, Purpose::pipelines, std::span(&addresses, 1), usage);
    made.constants = upload_array(gpu, uploader, Purpose::pipelines, std::span(&constants, 1), usage);
    uploader.finish();

    const std::array<vk::DescriptorPoolSize, 2> sizes = {
        {{.type = Type::eAccelerationStructureKHR, .descriptorCount = 3},
         {.type = Type::eUniformBuffer, .descriptorCount = 2}}};
    vk::DescriptorPoolCreateInfo pool{.maxSets = 1};
    pool.setPoolSizes(sizes);
    made.pool = gpu.device.createDescriptorPool(pool);
    vk::DescriptorSetAllocateInfo allocate{.descriptorPool = *made.pool};
    allocate.setSetLayouts(*layout.set);
    made.set = gpu.device.allocateDescriptorSets(allocate).front().release();

    const vk::DescriptorBufferInfo addresses_info{.buffer = *made.addresses.handle, .range = VK_WHOLE_SIZE};
    const vk::DescriptorBufferInfo constants_info{.buffer = *made.constants.handle, .range = VK_WHOLE_SIZE};
    const std::array<vk::WriteDescriptorSet, 2> writes = {{
        {.dstSet = made.set,
         .dstBinding = 1,
         .descriptorCount = 1,
         .descriptorType = Type::eUniformBuffer,
         .pBufferInfo = &addresses_info},
        {.dstSet = made.set,
         .dstBinding = 2,
         .descriptorCount = 1,
         .descriptorType = Type::eUniformBuffer,
         .pBufferInfo = &constants_info},
    }};
    gpu.device.updateDescriptorSets(writes, {});
    replace_structures(gpu, made, structures);
    return made;
}

void replace_structures(const Gpu& gpu, const Bindings& bindings, const Structures& structures) {
    for (const auto& [binding, handle] :
         {std::pair(structure_binding, structures.scene), std::pair(previous_binding, structures.previous),
          std::pair(emitters_binding, structures.emitters)}) {
        const vk::AccelerationStructureKHR present = handle ? handle : structures.scene;
        vk::WriteDescriptorSetAccelerationStructureKHR handles;
        handles.setAccelerationStructures(present);
        const vk::WriteDescriptorSet write{.pNext = &handles,
                                           .dstSet = bindings.set,
                                           .dstBinding = binding,
                                           .descriptorCount = 1,
                                           .descriptorType = vk::DescriptorType::eAccelerationStructureKHR};
        gpu.device.updateDescriptorSets(write, {});
    }
}

void record_values(Recorder& recorder, const Bindings& bindings, const SceneAddresses& addresses,
                   const shared::RenderConstants& constants) {
    recorder.use({{Resource::scene, Unit::transfer, Effect::write}});
    recorder->updateBuffer<SceneAddresses>(*bindings.addresses.handle, 0, addresses);
    recorder->updateBuffer<shared::RenderConstants>(*bindings.constants.handle, 0, constants);
}

}  // namespace diptych::core
