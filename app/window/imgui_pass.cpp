#include "window/imgui_pass.h"

#include <imgui.h>

#include <algorithm>
#include <cstddef>
#include <cstring>

#include "commands/commands.h"
#include "shader_binaries.h"

namespace diptych::core::app {

namespace {

constexpr std::intptr_t font_texture = 2;

constexpr vk::ImageSubresourceRange whole{
    .aspectMask = vk::ImageAspectFlagBits::eColor, .levelCount = 1, .layerCount = 1};

struct Push {
    float scale[2];
    float translate[2];
};

vk::raii::ShaderModule make_module(const Gpu& gpu, const char* name) {
    const std::span<const std::uint32_t> spirv = shader_binary(name);
    return gpu.device.createShaderModule({.codeSize = spirv.size_bytes(), .pCode = spirv.data()});
}

vk::raii::RenderPass make_render_pass(const Gpu& gpu, vk::Format format) {
    const vk::AttachmentDescription attachment{.format = format,
                                               .samples = vk::SampleCountFlagBits::e1,
                                               .loadOp = vk::AttachmentLoadOp::eClear,
                                               .storeOp = vk::AttachmentStoreOp::eStore,
                                               .stencilLoadOp = vk::AttachmentLoadOp::eDontCare,
                                               .stencilStoreOp = vk::AttachmentStoreOp::eDontCare,
                                               .initialLayout = vk::ImageLayout::eUndefined,
                                               .finalLayout = vk::ImageLayout::ePresentSrcKHR};
    const vk::AttachmentReference reference{.attachment = 0, .layout = vk::ImageLayout::eColorAttachmentOptimal};
    const vk::SubpassDescription subpass{.pipelineBindPoint = vk::PipelineBindPoint::eGraphics,
                                         .colorAttachmentCount = 1,
                                         .pColorAttachments = &reference};
    // The change of layout waits for the image to be handed over, which the submit waits for at this stage.
    const vk::SubpassDependency dependency{.srcSubpass = VK_SUBPASS_EXTERNAL,
                                           .dstSubpass = 0,
                                           .srcStageMask = vk::PipelineStageFlagBits::eColorAttachmentOutput,
                                           .dstStageMask = vk::PipelineStageFlagBits::eColorAttachmentOutput,
                                           .srcAccessMask = {},
                                           .dstAccessMask = vk::AccessFlagBits::eColorAttachmentWrite};
    return gpu.device.createRenderPass({.attachmentCount = 1,
                                        .pAttachments = &attachment,
                                        .subpassCount = 1,
                                        .pSubpasses = &subpass,
                                        .dependencyCount = 1,
                                        .pDependencies = &dependency});
}

/// For set-up work: all before it comes before all after it.
void change_layout(const vk::raii::CommandBuffer& commands, vk::Image image, vk::ImageLayout from, vk::ImageLayout to) {
    const vk::ImageMemoryBarrier barrier{.srcAccessMask = vk::AccessFlagBits::eMemoryWrite,
                                         .dstAccessMask =
                                             vk::AccessFlagBits::eMemoryRead | vk::AccessFlagBits::eMemoryWrite,
                                         .oldLayout = from,
                                         .newLayout = to,
                                         .srcQueueFamilyIndex = VK_QUEUE_FAMILY_IGNORED,
                                         .dstQueueFamilyIndex = VK_QUEUE_FAMILY_IGNORED,
                                         .image = image,
                                         .subresourceRange = whole};
    commands.pipelineBarrier(vk::PipelineStageFlagBits::eAllCommands, vk::PipelineStageFlagBits::eAllCommands, {}, {},
                             {}, barrier);
}

/// Grows `buffer` to `size` with room to spare; the frame that used it is over.
void make_room(const Gpu& gpu, Buffer& buffer, std::uint64_t size, vk::BufferUsageFlags usage) {
    if (buffer.size < size) {
        buffer = make_buffer(gpu, Purpose::display, size + size / 2, usage, MemoryKind::upload);
    }
}

/// The part of a command's rectangle that lies on the target; nothing where none does.
vk::Rect2D scissor_of(const ImDrawCmd& command, const ImDrawData& drawn, vk::Extent2D extent) {
    const auto edge = [](float value, float offset, float scale, std::uint32_t limit) {
        return static_cast<std::uint32_t>(std::clamp((value - offset) * scale, 0.0F, static_cast<float>(limit)));
    };
    const ImVec2 offset = drawn.DisplayPos;
    const ImVec2 scale = drawn.FramebufferScale;
    const std::uint32_t left = edge(command.ClipRect.x, offset.x, scale.x, extent.width);
    const std::uint32_t top = edge(command.ClipRect.y, offset.y, scale.y, extent.height);
    const std::uint32_t right = edge(command.ClipRect.z, offset.x, scale.x, extent.width);
    const std::uint32_t bottom = edge(command.ClipRect.w, offset.y, scale.y, extent.height);
    return {.offset = {static_cast<std::int32_t>(left), static_cast<std::int32_t>(top)},
            .extent = {right > left ? right - left : 0, bottom > top ? bottom - top : 0}};
}

}  // namespace

ImguiPass::ImguiPass(const Gpu& gpu, vk::Format format) : gpu_(gpu) {
    in_context("preparing the interface", [&] {
        make_sets();
        render_pass_ = make_render_pass(gpu_, format);
        make_pipeline();
        upload_font();
    });
}

void ImguiPass::make_sets() {
    sampler_ = gpu_.device.createSampler({.magFilter = vk::Filter::eLinear,
                                          .minFilter = vk::Filter::eLinear,
                                          .addressModeU = vk::SamplerAddressMode::eClampToEdge,
                                          .addressModeV = vk::SamplerAddressMode::eClampToEdge});
    const vk::DescriptorSetLayoutBinding binding{.binding = 0,
                                                 .descriptorType = vk::DescriptorType::eCombinedImageSampler,
                                                 .descriptorCount = 1,
                                                 .stageFlags = vk::ShaderStageFlagBits::eFragment};
    set_layout_ = gpu_.device.createDescriptorSetLayout({.bindingCount = 1, .pBindings = &binding});
    constexpr std::uint32_t count = frames_in_flight + 1;
    const vk::DescriptorPoolSize size{.type = vk::DescriptorType::eCombinedImageSampler, .descriptorCount = count};
    pool_ = gpu_.device.createDescriptorPool({.flags = vk::DescriptorPoolCreateFlagBits::eFreeDescriptorSet,
                                              .maxSets = count,
                                              .poolSizeCount = 1,
                                              .pPoolSizes = &size});
    const std::array<vk::DescriptorSetLayout, count> layouts = {*set_layout_, *set_layout_, *set_layout_};
    std::vector<vk::raii::DescriptorSet> sets = gpu_.device.allocateDescriptorSets(
        {.descriptorPool = *pool_, .descriptorSetCount = count, .pSetLayouts = layouts.data()});
    font_ = std::move(sets[0]);
    for (std::size_t i = 0; i < frames_in_flight; ++i) {
        frames_[i].picture = std::move(sets[1 + i]);
    }
}

void ImguiPass::make_pipeline() {
    const vk::PushConstantRange push{.stageFlags = vk::ShaderStageFlagBits::eVertex, .size = sizeof(Push)};
    layout_ = gpu_.device.createPipelineLayout(
        {.setLayoutCount = 1, .pSetLayouts = &*set_layout_, .pushConstantRangeCount = 1, .pPushConstantRanges = &push});
    const vk::raii::ShaderModule vertex = make_module(gpu_, "imgui.vert");
    const vk::raii::ShaderModule fragment = make_module(gpu_, "imgui.frag");
    const std::array stages = {vk::PipelineShaderStageCreateInfo{
                                   .stage = vk::ShaderStageFlagBits::eVertex, .module = *vertex, .pName = "main"},
                               vk::PipelineShaderStageCreateInfo{
                                   .stage = vk::ShaderStageFlagBits::eFragment, .module = *fragment, .pName = "main"}};
    const vk::VertexInputBindingDescription binding{.binding = 0, .stride = sizeof(ImDrawVert)};
    const std::array attributes = {
        vk::VertexInputAttributeDescription{
            .location = 0, .format = vk::Format::eR32G32Sfloat, .offset = offsetof(ImDrawVert, pos)},
        vk::VertexInputAttributeDescription{
            .location = 1, .format = vk::Format::eR32G32Sfloat, .offset = offsetof(ImDrawVert, uv)},
        vk::VertexInputAttributeDescription{
            .location = 2, .format = vk::Format::eR8G8B8A8Unorm, .offset = offsetof(ImDrawVert, col)}};
    const vk::PipelineVertexInputStateCreateInfo input{.vertexBindingDescriptionCount = 1,
                                                       .pVertexBindingDescriptions = &binding,
                                                       .vertexAttributeDescriptionCount = attributes.size(),
                                                       .pVertexAttributeDescriptions = attributes.data()};
    const vk::PipelineInputAssemblyStateCreateInfo assembly{.topology = vk::PrimitiveTopology::eTriangleList};
    const vk::PipelineViewportStateCreateInfo viewport{.viewportCount = 1, .scissorCount = 1};
    const vk::PipelineRasterizationStateCreateInfo raster{.lineWidth = 1};
    const vk::PipelineMultisampleStateCreateInfo samples{.rasterizationSamples = vk::SampleCountFlagBits::e1};
    using Part = vk::ColorComponentFlagBits;
    const vk::PipelineColorBlendAttachmentState over{.blendEnable = VK_TRUE,
                                                     .srcColorBlendFactor = vk::BlendFactor::eSrcAlpha,
                                                     .dstColorBlendFactor = vk::BlendFactor::eOneMinusSrcAlpha,
                                                     .srcAlphaBlendFactor = vk::BlendFactor::eOne,
                                                     .dstAlphaBlendFactor = vk::BlendFactor::eOneMinusSrcAlpha,
                                                     .colorWriteMask = Part::eR | Part::eG | Part::eB | Part::eA};
    const vk::PipelineColorBlendStateCreateInfo blend{.attachmentCount = 1, .pAttachments = &over};
    const std::array dynamic = {vk::DynamicState::eViewport, vk::DynamicState::eScissor};
    const vk::PipelineDynamicStateCreateInfo changing{.dynamicStateCount = dynamic.size(),
                                                      .pDynamicStates = dynamic.data()};
    pipeline_ = gpu_.device.createGraphicsPipeline(nullptr, {.stageCount = stages.size(),
                                                             .pStages = stages.data(),
                                                             .pVertexInputState = &input,
                                                             .pInputAssemblyState = &assembly,
                                                             .pViewportState = &viewport,
                                                             .pRasterizationState = &raster,
                                                             .pMultisampleState = &samples,
                                                             .pColorBlendState = &blend,
                                                             .pDynamicState = &changing,
                                                             .layout = *layout_,
                                                             .renderPass = *render_pass_});
}

void ImguiPass::upload_font() {
    unsigned char* texels = nullptr;
    int width = 0;
    int height = 0;
    ImGui::GetIO().Fonts->GetTexDataAsRGBA32(&texels, &width, &height);
    ImGui::GetIO().Fonts->SetTexID((ImTextureID)font_texture);
    const std::size_t size = static_cast<std::size_t>(width) * static_cast<std::size_t>(height) * 4;
    const vk::Extent3D extent{static_cast<std::uint32_t>(width), static_cast<std::uint32_t>(height), 1};
    constexpr vk::Format format = vk::Format::eR8G8B8A8Unorm;
    font_image_ =
        gpu_.device.createImage({.imageType = vk::ImageType::e2D,
                                 .format = format,
                                 .extent = extent,
                                 .mipLevels = 1,
                                 .arrayLayers = 1,
                                 .usage = vk::ImageUsageFlagBits::eSampled | vk::ImageUsageFlagBits::eTransferDst});
    font_memory_ = allocate_image(gpu_, font_image_);
    font_view_ = gpu_.device.createImageView(
        {.image = *font_image_, .viewType = vk::ImageViewType::e2D, .format = format, .subresourceRange = whole});
    const Buffer staging =
        make_buffer(gpu_, Purpose::display, size, vk::BufferUsageFlagBits::eTransferSrc, MemoryKind::upload);
    std::memcpy(staging.mapped, texels, size);
    run_commands(gpu_, [&](const vk::raii::CommandBuffer& commands) {
        change_layout(commands, *font_image_, vk::ImageLayout::eUndefined, vk::ImageLayout::eTransferDstOptimal);
        const vk::BufferImageCopy region{
            .imageSubresource = {.aspectMask = vk::ImageAspectFlagBits::eColor, .layerCount = 1},
            .imageExtent = extent};
        commands.copyBufferToImage(*staging.handle, *font_image_, vk::ImageLayout::eTransferDstOptimal, region);
        change_layout(commands, *font_image_, vk::ImageLayout::eTransferDstOptimal,
                      vk::ImageLayout::eShaderReadOnlyOptimal);
    });
    point_to(font_, *font_view_);
}

void ImguiPass::point_to(const vk::raii::DescriptorSet& set, vk::ImageView view) const {
    const vk::DescriptorImageInfo info{
        .sampler = *sampler_, .imageView = view, .imageLayout = vk::ImageLayout::eShaderReadOnlyOptimal};
    gpu_.device.updateDescriptorSets(vk::WriteDescriptorSet{.dstSet = *set,
                                                            .dstBinding = 0,
                                                            .descriptorCount = 1,
                                                            .descriptorType = vk::DescriptorType::eCombinedImageSampler,
                                                            .pImageInfo = &info},
                                     {});
}

void ImguiPass::set_targets(const Swapchain& swapchain) {
    targets_.clear();
    for (Frame& frame : frames_) {
        frame.shown = nullptr;  // a picture made since may bear the handle of one that is gone
    }
    extent_ = swapchain.extent;
    for (const vk::raii::ImageView& view : swapchain.views) {
        targets_.push_back(gpu_.device.createFramebuffer({.renderPass = *render_pass_,
                                                          .attachmentCount = 1,
                                                          .pAttachments = &*view,
                                                          .width = extent_.width,
                                                          .height = extent_.height,
                                                          .layers = 1}));
    }
}

void ImguiPass::upload(Frame& frame, const ImDrawData& drawn) const {
    const auto vertices = static_cast<std::uint64_t>(drawn.TotalVtxCount) * sizeof(ImDrawVert);
    const auto indices = static_cast<std::uint64_t>(drawn.TotalIdxCount) * sizeof(ImDrawIdx);
    make_room(gpu_, frame.vertices, vertices, vk::BufferUsageFlagBits::eVertexBuffer);
    make_room(gpu_, frame.indices, indices, vk::BufferUsageFlagBits::eIndexBuffer);
    auto* vertex = static_cast<ImDrawVert*>(frame.vertices.mapped);
    auto* index = static_cast<ImDrawIdx*>(frame.indices.mapped);
    for (int i = 0; i < drawn.CmdListsCount; ++i) {
        const ImDrawList& list = *drawn.CmdLists[i];
        vertex = std::copy(list.VtxBuffer.begin(), list.VtxBuffer.end(), vertex);
        index = std::copy(list.IdxBuffer.begin(), list.IdxBuffer.end(), index);
    }
}

void ImguiPass::record(const vk::raii::CommandBuffer& commands, std::size_t target, std::size_t number,
                       vk::ImageView picture, const ImDrawData& drawn) {
    Frame& frame = frames_[number];
    if (frame.shown != picture) {
        frame.shown = picture;
        point_to(frame.picture, picture);
    }
    upload(frame, drawn);
    const vk::ClearValue clear(vk::ClearColorValue(std::array<float, 4>{0, 0, 0, 1}));
    commands.beginRenderPass({.renderPass = *render_pass_,
                              .framebuffer = *targets_[target],
                              .renderArea = {{0, 0}, extent_},
                              .clearValueCount = 1,
                              .pClearValues = &clear},
                             vk::SubpassContents::eInline);
    if (drawn.TotalIdxCount > 0) {
        draw(commands, frame, drawn);
    }
    commands.endRenderPass();
}

void ImguiPass::draw(const vk::raii::CommandBuffer& commands, const Frame& frame, const ImDrawData& drawn) const {
    commands.bindPipeline(vk::PipelineBindPoint::eGraphics, *pipeline_);
    commands.bindVertexBuffers(0, *frame.vertices.handle, {0});
    commands.bindIndexBuffer(*frame.indices.handle, 0,
                             sizeof(ImDrawIdx) == 2 ? vk::IndexType::eUint16 : vk::IndexType::eUint32);
    commands.setViewport(0, vk::Viewport{.width = static_cast<float>(extent_.width),
                                         .height = static_cast<float>(extent_.height),
                                         .minDepth = 0,
                                         .maxDepth = 1});
    Push push{};
    push.scale[0] = 2 / drawn.DisplaySize.x;
    push.scale[1] = 2 / drawn.DisplaySize.y;
    push.translate[0] = -1 - drawn.DisplayPos.x * push.scale[0];
    push.translate[1] = -1 - drawn.DisplayPos.y * push.scale[1];
    commands.pushConstants<Push>(*layout_, vk::ShaderStageFlagBits::eVertex, 0, push);
    std::uint32_t first_index = 0;
    std::int32_t first_vertex = 0;
    for (int i = 0; i < drawn.CmdListsCount; ++i) {
        const ImDrawList& list = *drawn.CmdLists[i];
        for (const ImDrawCmd& command : list.CmdBuffer) {
            const vk::Rect2D scissor = scissor_of(command, drawn, extent_);
            if (scissor.extent.width == 0 || scissor.extent.height == 0 || command.UserCallback != nullptr) {
                continue;
            }
            const bool shows_picture =
                command.GetTexID() == (ImTextureID)picture_texture;  // a pointer or a number, by version
            commands.bindDescriptorSets(vk::PipelineBindPoint::eGraphics, *layout_, 0,
                                        shows_picture ? *frame.picture : *font_, {});
            commands.setScissor(0, scissor);
            commands.drawIndexed(command.ElemCount, 1, first_index + command.IdxOffset,
                                 first_vertex + static_cast<std::int32_t>(command.VtxOffset), 0);
        }
        first_index += static_cast<std::uint32_t>(list.IdxBuffer.Size);
        first_vertex += list.VtxBuffer.Size;
    }
}

}  // namespace diptych::core::app
