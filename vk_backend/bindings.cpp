#include "bindings.h"

#include <array>

#include "upload.h"

namespace diptych {

Bindings make_bindings(const Gpu& gpu, const PipelineLayout& layout, vk::AccelerationStructureKHR structure,
                       const SceneAddresses& addresses, const shared::RenderConstants& constants) {
    using Type = vk::DescriptorType;
    Bindings made;
    Uploader uploader(gpu, 4096);
    const vk::BufferUsageFlags usage = vk::BufferUsageFlagBits::eUniformBuffer;
    made.addresses = upload_array(gpu, uploader, "addresses", std::span(&addresses, 1), usage);
    made.constants = upload_array(gpu, uploader, "constants", std::span(&constants, 1), usage);
    uploader.finish();

    const std::array<vk::DescriptorPoolSize, 2> sizes = {
        {{.type = Type::eAccelerationStructureKHR, .descriptorCount = 1},
         {.type = Type::eUniformBuffer, .descriptorCount = 2}}};
    vk::DescriptorPoolCreateInfo pool{.flags = vk::DescriptorPoolCreateFlagBits::eFreeDescriptorSet, .maxSets = 1};
    pool.setPoolSizes(sizes);
    made.pool = gpu.device.createDescriptorPool(pool);
    vk::DescriptorSetAllocateInfo allocate{.descriptorPool = *made.pool};
    allocate.setSetLayouts(*layout.set);
    made.set = std::move(gpu.device.allocateDescriptorSets(allocate).front());

    vk::WriteDescriptorSetAccelerationStructureKHR structure_write;
    structure_write.setAccelerationStructures(structure);
    const vk::DescriptorBufferInfo addresses_info{.buffer = *made.addresses.handle, .range = VK_WHOLE_SIZE};
    const vk::DescriptorBufferInfo constants_info{.buffer = *made.constants.handle, .range = VK_WHOLE_SIZE};
    const std::array<vk::WriteDescriptorSet, 3> writes = {{
        {.pNext = &structure_write,
         .dstSet = *made.set,
         .dstBinding = 0,
         .descriptorCount = 1,
         .descriptorType = Type::eAccelerationStructureKHR},
        {.dstSet = *made.set,
         .dstBinding = 1,
         .descriptorCount = 1,
         .descriptorType = Type::eUniformBuffer,
         .pBufferInfo = &addresses_info},
        {.dstSet = *made.set,
         .dstBinding = 2,
         .descriptorCount = 1,
         .descriptorType = Type::eUniformBuffer,
         .pBufferInfo = &constants_info},
    }};
    gpu.device.updateDescriptorSets(writes, {});
    return made;
}

void replace_structure(const Gpu& gpu, const Bindings& bindings, vk::AccelerationStructureKHR structure) {
    vk::WriteDescriptorSetAccelerationStructureKHR structure_write;
    structure_write.setAccelerationStructures(structure);
    const vk::WriteDescriptorSet write{.pNext = &structure_write,
                                       .dstSet = *bindings.set,
                                       .dstBinding = 0,
                                       .descriptorCount = 1,
                                       .descriptorType = vk::DescriptorType::eAccelerationStructureKHR};
    gpu.device.updateDescriptorSets(write, {});
}

void replace_constants(const Gpu& gpu, const Bindings& bindings, const shared::RenderConstants& constants) {
    Uploader uploader(gpu, sizeof(constants));
    uploader.upload(bindings.constants, std::as_bytes(std::span(&constants, 1)));
    uploader.finish();
}

}  // namespace diptych
