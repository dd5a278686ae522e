#include <cstring>
#include <map>

#include "bsdf/bsdf.h"
#include "pack/features.h"
#include "pack/pack_parts.h"
#include "film/tonemap.h"

namespace diptych::core {
namespace {

std::uint32_t wrap_bits(Wrap wrap) {
    switch (wrap) {
    case Wrap::repeat:
        return shared::WRAP_REPEAT;
    case Wrap::clamp:
        return shared::WRAP_CLAMP;
    case Wrap::mirror:
        return shared::WRAP_MIRROR;
    }
    return shared::WRAP_REPEAT;
}

/// Appends slots and, at first use, the texels of their images.
class SlotPacker {
public:
    SlotPacker(const Scene& scene, PackedScene& packed) : scene_(scene), packed_(packed) {}

    std::uint32_t add(const TextureSlot& slot, bool srgb) {
        if (slot.texture == none) {
            return shared::NONE;
        }
        const Texture& texture = scene_.textures[static_cast<std::size_t>(slot.texture)];
        const TextureImage& image = scene_.images[static_cast<std::size_t>(texture.image)];
        shared::TextureSlot out{};
        out.first_texel = first_texel(texture.image);
        out.width = static_cast<std::uint32_t>(image.width);
        out.height = static_cast<std::uint32_t>(image.height);
        out.flags = (srgb ? shared::TEXTURE_SRGB : 0U) |
                    (texture.filter == Filter::nearest ? shared::TEXTURE_NEAREST : 0U) |
                    (slot.uv_set == 1 ? shared::TEXTURE_UV_1 : 0U) |
                    (wrap_bits(texture.wrap_u) << shared::TEXTURE_WRAP_U_SHIFT) |
                    (wrap_bits(texture.wrap_v) << shared::TEXTURE_WRAP_V_SHIFT);
        out.u_row = slot.u_row;
        out.v_row = slot.v_row;
        packed_.texture_slots.push_back(out);
        return static_cast<std::uint32_t>(packed_.texture_slots.size() - 1);
    }

private:
    std::uint32_t first_texel(int image_index) {
        const auto [found, fresh] = first_texels_.try_emplace(image_index, 0U);
        if (fresh) {
            const TextureImage& image = scene_.images[static_cast<std::size_t>(image_index)];
            const std::size_t first = packed_.texels.size();
            require_indexable(scene_, first + image.rgba.size() / 4, "texels");
            packed_.texels.resize(first + image.rgba.size() / 4);
            std::memcpy(packed_.texels.data() + first, image.rgba.data(), image.rgba.size());
            found->second = static_cast<std::uint32_t>(first);
        }
        return found->second;
    }

    const Scene& scene_;
    PackedScene& packed_;
    std::map<int, std::uint32_t> first_texels_;
};

std::uint32_t material_flags(const Material& m) {
    return (m.alpha_mode == AlphaMode::mask ? shared::MATERIAL_ALPHA_MASK : 0U) |
           (m.alpha_mode == AlphaMode::blend ? shared::MATERIAL_ALPHA_BLEND : 0U) |
           (m.double_sided || m.unlit ? shared::MATERIAL_DOUBLE_SIDED : 0U) | (m.unlit ? shared::MATERIAL_UNLIT : 0U) |
           (emits(m) ? shared::MATERIAL_EMISSIVE : 0U);
}

}  // namespace

void pack_materials(const Scene& scene, PackedScene& packed) {
    SlotPacker slots(scene, packed);
    for (const Material& m : scene.materials) {
        shared::Material out{};
        out.base_color = m.base_color;
        out.emission = m.emission;
        out.metallic = m.metallic;
        out.specular_color = m.specular_color;
        out.roughness = m.roughness;
        out.specular = m.specular;
        out.f0 = shared::dielectric_f0(m.ior);
        out.normal_scale = m.normal_scale;
        out.alpha_cutoff = m.alpha_cutoff;
        out.flags = material_flags(m);
        out.base_color_slot = slots.add(m.base_color_texture, true);
        out.metallic_roughness_slot = slots.add(m.metallic_roughness_texture, false);
        out.normal_slot = slots.add(m.normal_texture, false);
        out.emission_slot = slots.add(m.emission_texture, true);
        out.specular_slot = slots.add(m.specular_texture, false);
        out.specular_color_slot = slots.add(m.specular_color_texture, true);
        packed.materials.push_back(out);
    }
    if (!packed.texels.empty()) {
        for (int byte = 0; byte < 256; ++byte) {
            packed.srgb_table.push_back(shared::srgb_decode(static_cast<float>(byte) / 255.0F));
        }
    }
}

}  // namespace diptych::core
