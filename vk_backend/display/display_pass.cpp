#include "display/display_pass.h"

#include <array>
#include <bit>
#include <cassert>
#include <cmath>
#include <cstring>
#include <numeric>

#include "../../shaders/display.h"
#include "commands/commands.h"
#include "passes/pass_table.h"
#include "memory/readback.h"
#include "shader_binaries.h"
#include "film/tonemap.h"

namespace diptych::core {
namespace {

using Access = vk::AccessFlagBits;
using Layout = vk::ImageLayout;
using PipelineStage = vk::PipelineStageFlagBits;

constexpr vk::Format picture_format = vk::Format::eR8G8B8A8Unorm;
constexpr vk::ImageSubresourceRange whole{
    .aspectMask = vk::ImageAspectFlagBits::eColor, .levelCount = 1, .layerCount = 1};
constexpr std::uint32_t group_side = 16;  // of display.comp; each invocation counts one bin
static_assert(group_side * group_side == shared::HISTOGRAM_BINS);

#define ASSERT_LAYER(name, constant) static_assert(static_cast<std::uint32_t>(DisplayLayer::name) == shared::constant)
ASSERT_LAYER(radiance, LAYER_RADIANCE);
ASSERT_LAYER(albedo, LAYER_ALBEDO);
ASSERT_LAYER(normal, LAYER_NORMAL);
ASSERT_LAYER(depth, LAYER_DEPTH);
ASSERT_LAYER(standard_error, LAYER_STANDARD_ERROR);
ASSERT_LAYER(samples, LAYER_SAMPLES);
ASSERT_LAYER(nonfinite, LAYER_NONFINITE);
ASSERT_LAYER(light_id, LAYER_LIGHT_ID);
ASSERT_LAYER(reservoir_m, LAYER_RESERVOIR_M);
ASSERT_LAYER(reservoir_w, LAYER_RESERVOIR_W);
#undef ASSERT_LAYER

shared::uvec2 words(vk::DeviceAddress address) {
    return {static_cast<std::uint32_t>(address), static_cast<std::uint32_t>(address >> 32U)};
}

shared::DisplayFilm describe(const DeviceFilm& shown) {
    shared::DisplayFilm film{};
    if (!shown.film) {
        return film;
    }
    film.pixels = words(shown.film->pixels.address);
    film.moments = words(shown.film->moments.address);
    film.first_hits = words(shown.film->first_hits.address);
    film.size = {static_cast<std::uint32_t>(shown.film->width), static_cast<std::uint32_t>(shown.film->height)};
    if (shown.resampling) {
        const std::uint64_t set_bytes = std::uint64_t{film.size.x} * film.size.y * sizeof(shared::Reservoir);
        film.reservoirs = words(shown.resampling->reservoirs.address + shown.reservoir_set * set_bytes);
    }
    return film;
}

constexpr std::uint32_t histogram_bytes = shared::HISTOGRAM_BINS * sizeof(std::uint32_t);

shared::Display describe(const DisplayRequest& request, const DisplayPicture& picture) {
    shared::Display display{};
    display.left = describe(request.left);
    display.right = describe(request.right);
    display.size = {picture.width, picture.height};
    display.divider = request.divider;
    display.layer = static_cast<std::uint32_t>(request.layer);
    display.flags = (request.difference ? shared::DISPLAY_DIFFERENCE : 0U) |
                    (request.logarithmic ? shared::DISPLAY_LOGARITHMIC : 0U);
    display.tonemap = static_cast<std::uint32_t>(request.tonemap);
    display.exposure = std::exp2(request.exposure_ev);
    display.low = request.low;
    display.high = request.high;
    return display;
}

struct Change {
    Layout from;
    Layout to;
    vk::PipelineStageFlags before;
    vk::PipelineStageFlags after;
    vk::AccessFlags written;
    vk::AccessFlags read;
};

// A barrier of the image alone; the recorder handles buffers.
void change_layout(const vk::raii::CommandBuffer& commands, vk::Image image, const Change& change) {
    const vk::ImageMemoryBarrier barrier{.srcAccessMask = change.written,
                                         .dstAccessMask = change.read,
                                         .oldLayout = change.from,
                                         .newLayout = change.to,
                                         .srcQueueFamilyIndex = VK_QUEUE_FAMILY_IGNORED,
                                         .dstQueueFamilyIndex = VK_QUEUE_FAMILY_IGNORED,
                                         .image = image,
                                         .subresourceRange = whole};
    commands.pipelineBarrier(change.before, change.after, {}, {}, {}, barrier);
}

void bind(const Gpu& gpu, const DisplayPass& pass, DisplayPicture& picture) {
    using Type = vk::DescriptorType;
    const std::array<vk::DescriptorPoolSize, 2> sizes = {
        {{.type = Type::eStorageImage, .descriptorCount = 1}, {.type = Type::eStorageBuffer, .descriptorCount = 1}}};
    picture.pool =
        gpu.device.createDescriptorPool({.maxSets = 1, .poolSizeCount = sizes.size(), .pPoolSizes = sizes.data()});
    vk::DescriptorSetAllocateInfo allocate{.descriptorPool = *picture.pool};
    allocate.setSetLayouts(*pass.set);
    picture.set = gpu.device.allocateDescriptorSets(allocate).front().release();
    const vk::DescriptorImageInfo image{.imageView = *picture.view, .imageLayout = Layout::eGeneral};
    const vk::DescriptorBufferInfo histograms{.buffer = *picture.histogram.handle, .range = VK_WHOLE_SIZE};
    const std::array<vk::WriteDescriptorSet, 2> writes = {{
        {.dstSet = picture.set,
         .dstBinding = 0,
         .descriptorCount = 1,
         .descriptorType = Type::eStorageImage,
         .pImageInfo = &image},
        {.dstSet = picture.set,
         .dstBinding = 1,
         .descriptorCount = 1,
         .descriptorType = Type::eStorageBuffer,
         .pBufferInfo = &histograms},
    }};
    gpu.device.updateDescriptorSets(writes, {});
}

// Lower end of a bin.
float bin_start(std::uint32_t bin) {
    return std::bit_cast<float>((shared::HISTOGRAM_FIRST + bin) << 21U);
}

}  // namespace

bool is_scalar(DisplayLayer layer) {
    switch (layer) {
    case DisplayLayer::radiance:
    case DisplayLayer::albedo:
    case DisplayLayer::normal:
    case DisplayLayer::light_id:
        return false;
    case DisplayLayer::depth:
    case DisplayLayer::standard_error:
    case DisplayLayer::samples:
    case DisplayLayer::nonfinite:
    case DisplayLayer::reservoir_m:
    case DisplayLayer::reservoir_w:
        break;
    }
    return true;
}

DisplayPass make_display_pass(const Gpu& gpu) {
    return in_context("setting up the display", [&] {
        const std::array<vk::DescriptorSetLayoutBinding, 2> bindings = {{
            {.binding = 0,
             .descriptorType = vk::DescriptorType::eStorageImage,
             .descriptorCount = 1,
             .stageFlags = vk::ShaderStageFlagBits::eCompute},
            {.binding = 1,
             .descriptorType = vk::DescriptorType::eStorageBuffer,
             .descriptorCount = 1,
             .stageFlags = vk::ShaderStageFlagBits::eCompute},
        }};
        const vk::PushConstantRange push{.stageFlags = vk::ShaderStageFlagBits::eCompute,
                                         .size = sizeof(shared::Display)};
        DisplayPass pass;
        pass.set =
            gpu.device.createDescriptorSetLayout({.bindingCount = bindings.size(), .pBindings = bindings.data()});
        pass.layout = gpu.device.createPipelineLayout({.setLayoutCount = 1,
                                                       .pSetLayouts = &*pass.set,
                                                       .pushConstantRangeCount = 1,
                                                       .pPushConstantRanges = &push});
        const std::span<const std::uint32_t> code = shader_binary("display.comp");
        const vk::raii::ShaderModule module =
            gpu.device.createShaderModule({.codeSize = code.size_bytes(), .pCode = code.data()});
        const vk::ComputePipelineCreateInfo info{
            .stage = {.stage = vk::ShaderStageFlagBits::eCompute, .module = *module, .pName = "main"},
            .layout = *pass.layout};
        pass.pipeline = gpu.device.createComputePipeline(nullptr, info);
        return pass;
    });
}

DisplayPicture make_display_picture(const Gpu& gpu, const DisplayPass& pass, std::uint32_t width,
                                    std::uint32_t height) {
    using Usage = vk::ImageUsageFlagBits;
    return in_context("allocating a picture of " + std::to_string(width) + "x" + std::to_string(height), [&] {
        DisplayPicture picture;
        picture.width = width;
        picture.height = height;
        picture.image = gpu.device.createImage({.imageType = vk::ImageType::e2D,
                                                .format = picture_format,
                                                .extent = {width, height, 1},
                                                .mipLevels = 1,
                                                .arrayLayers = 1,
                                                .usage = Usage::eStorage | Usage::eSampled | Usage::eTransferSrc});
        picture.memory = allocate_image(gpu, picture.image);
        picture.view = gpu.device.createImageView(
            {.image = *picture.image, .viewType = vk::ImageViewType::e2D, .format = picture_format, .subresourceRange = whole});
        using BufferUsage = vk::BufferUsageFlagBits;
        picture.histogram = make_buffer(
            gpu, Purpose::display, histogram_bytes,
            BufferUsage::eStorageBuffer | BufferUsage::eTransferDst | BufferUsage::eTransferSrc, MemoryKind::device);
        picture.histograms = make_buffer(gpu, Purpose::display, std::uint64_t{display_slots} * histogram_bytes,
                                         BufferUsage::eTransferDst, MemoryKind::readback);
        std::memset(picture.histograms.mapped, 0, picture.histograms.size);  // nothing has been shown yet
        bind(gpu, pass, picture);
        return picture;
    });
}

void record_display(const vk::raii::CommandBuffer& commands, const DisplayPass& pass, const DisplayPicture& picture,
                    const DisplayRequest& request, std::uint32_t slot) {
    assert(slot < display_slots);
    Recorder recorder(commands);
    change_layout(commands, *picture.image,
                  {.from = Layout::eUndefined,
                   .to = Layout::eGeneral,
                   .before = PipelineStage::eAllCommands,
                   .after = PipelineStage::eComputeShader,
                   .written = Access::eMemoryWrite,
                   .read = Access::eShaderWrite});
    recorder.use({{Resource::histogram, Unit::transfer, Effect::write}});
    commands.fillBuffer(*picture.histogram.handle, 0, VK_WHOLE_SIZE, 0);
    recorder.use(uses_of(shader_binary("display.comp")));
    const shared::Display display = describe(request, picture);
    commands.bindPipeline(vk::PipelineBindPoint::eCompute, *pass.pipeline);
    commands.bindDescriptorSets(vk::PipelineBindPoint::eCompute, *pass.layout, 0, picture.set, {});
    commands.pushConstants<shared::Display>(*pass.layout, vk::ShaderStageFlagBits::eCompute, 0, display);
    commands.dispatch((picture.width + group_side - 1) / group_side, (picture.height + group_side - 1) / group_side, 1);
    change_layout(commands, *picture.image,
                  {.from = Layout::eGeneral,
                   .to = Layout::eShaderReadOnlyOptimal,
                   .before = PipelineStage::eComputeShader,
                   .after = PipelineStage::eFragmentShader | PipelineStage::eTransfer,
                   .written = Access::eShaderWrite,
                   .read = Access::eShaderRead | Access::eTransferRead});
    recorder.use(
        {{Resource::histogram, Unit::transfer, Effect::read}, {Resource::readback, Unit::transfer, Effect::write}});
    commands.copyBuffer(*picture.histogram.handle, *picture.histograms.handle,
                        vk::BufferCopy{.dstOffset = std::uint64_t{slot} * histogram_bytes, .size = histogram_bytes});
    recorder.use({{Resource::readback, Unit::host, Effect::read}});
}

std::optional<DisplayRange> shown_range(const DisplayPicture& picture, std::uint32_t slot) {
    assert(slot < display_slots);
    const auto* first = static_cast<const std::uint32_t*>(picture.histograms.mapped) + slot * shared::HISTOGRAM_BINS;
    const std::span<const std::uint32_t> bins(first, shared::HISTOGRAM_BINS);
    const std::uint64_t total = std::accumulate(bins.begin(), bins.end(), std::uint64_t{0});
    if (total == 0) {
        return std::nullopt;
    }
    // The bin in which the share of the count is reached.
    const auto bin_at = [&](double share) {
        std::uint64_t seen = 0;
        std::uint32_t bin = 0;
        while (static_cast<double>(seen += bins[bin]) < share * static_cast<double>(total)) {
            ++bin;
        }
        return bin;
    };
    return DisplayRange{.low = bin_start(bin_at(0.01)), .high = bin_start(bin_at(0.99) + 1)};
}

Image read_display(const Gpu& gpu, const DisplayPicture& picture) {
    return in_context("reading the picture", [&] {
        const std::size_t pixels = std::size_t{picture.width} * picture.height;
        const Buffer host = make_buffer(gpu, Purpose::readback, 4 * pixels, vk::BufferUsageFlagBits::eTransferDst,
                                        MemoryKind::readback);
        run_commands(gpu, [&](Recorder& recorder) {
            const vk::raii::CommandBuffer& commands = recorder;
            change_layout(commands, *picture.image,
                          {.from = Layout::eShaderReadOnlyOptimal,
                           .to = Layout::eTransferSrcOptimal,
                           .before = PipelineStage::eAllCommands,
                           .after = PipelineStage::eTransfer,
                           .written = Access::eMemoryWrite,
                           .read = Access::eTransferRead});
            const vk::BufferImageCopy copy{
                .imageSubresource = {.aspectMask = vk::ImageAspectFlagBits::eColor, .layerCount = 1},
                .imageExtent = {picture.width, picture.height, 1}};
            recorder.use({{Resource::readback, Unit::transfer, Effect::write}});
            commands.copyImageToBuffer(*picture.image, Layout::eTransferSrcOptimal, *host.handle, copy);
            change_layout(commands, *picture.image,
                          {.from = Layout::eTransferSrcOptimal,
                           .to = Layout::eShaderReadOnlyOptimal,
                           .before = PipelineStage::eTransfer,
                           .after = PipelineStage::eFragmentShader,
                           .written = {},
                           .read = Access::eShaderRead});
            recorder.use({{Resource::readback, Unit::host, Effect::read}});
        });
        Image image = make_image(static_cast<int>(picture.width), static_cast<int>(picture.height), 3);
        const auto* bytes = static_cast<const std::uint8_t*>(host.mapped);
        for (std::size_t i = 0; i < pixels; ++i) {
            for (std::size_t channel = 0; channel < 3; ++channel) {
                image.data[3 * i + channel] = static_cast<float>(bytes[4 * i + channel]) / 255.0F;
            }
        }
        return image;
    });
}

}  // namespace diptych::core
