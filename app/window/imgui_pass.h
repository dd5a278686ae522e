// Dear ImGui's triangles on the swapchain's images: our own, since Debian's Vulkan half of it wants a loader that is
// linked.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "memory/buffer.h"
#include "device/gpu.h"
#include "display/swapchain.h"

struct ImDrawData;

namespace diptych::core::app {

/// What ImGui::Image is to be given: the view that `record` is handed.
inline constexpr std::intptr_t picture_texture = 1;

class ImguiPass {
public:
    /// Draws into images of `format`. Uploads the font atlas of the current ImGui context, which must be built. Throws
    /// Error.
    ImguiPass(const Gpu& gpu, vk::Format format);

    /// Draws into its images from now on. Nothing may be in flight.
    void set_targets(const Swapchain& swapchain);

    /// Draws over target number `target`, which it clears and leaves ready to be presented. `picture` is in the layout
    /// eShaderReadOnlyOptimal and stays as long as the frame is in flight; the frame that had this number before is
    /// over.
    void record(const vk::raii::CommandBuffer& commands, std::size_t target, std::size_t frame, vk::ImageView picture,
                const ImDrawData& drawn);

private:
    struct Frame {
        Buffer vertices;
        Buffer indices;
        vk::raii::DescriptorSet picture = nullptr;
        vk::ImageView shown;  // in that set
    };

    void make_sets();
    void make_pipeline();
    void upload_font();
    void upload(Frame& frame, const ImDrawData& drawn) const;
    void draw(const vk::raii::CommandBuffer& commands, const Frame& frame, const ImDrawData& drawn) const;
    void point_to(const vk::raii::DescriptorSet& set, vk::ImageView view) const;

    const Gpu& gpu_;
    vk::raii::Sampler sampler_ = nullptr;
    vk::raii::DescriptorSetLayout set_layout_ = nullptr;
    vk::raii::DescriptorPool pool_ = nullptr;
    vk::raii::RenderPass render_pass_ = nullptr;
    vk::raii::PipelineLayout layout_ = nullptr;
    vk::raii::Pipeline pipeline_ = nullptr;
    Allocation font_memory_;
    vk::raii::Image font_image_ = nullptr;
    vk::raii::ImageView font_view_ = nullptr;
    vk::raii::DescriptorSet font_ = nullptr;
    std::array<Frame, frames_in_flight> frames_;
    std::vector<vk::raii::Framebuffer> targets_;
    vk::Extent2D extent_;
};

}  // namespace diptych::core::app
