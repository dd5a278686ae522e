#include "gltf/material.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <map>
#include <optional>
#include <utility>

#include "gltf/image.h"

namespace diptych::core::gltf {
namespace {

// What maps the file's textures and images to the scene's, which hold only those in use.
struct TextureTables {
    std::map<int, int> textures;
    std::map<int, int> images;
    std::vector<int> wanted_images;
};

struct Context {
    Document& document;
    Scene& scene;
    TextureTables tables;
};

Wrap wrap_mode(Document& document, int mode, const std::string& object) {
    switch (mode) {
    case TINYGLTF_TEXTURE_WRAP_CLAMP_TO_EDGE:
        return Wrap::clamp;
    case TINYGLTF_TEXTURE_WRAP_MIRRORED_REPEAT:
        return Wrap::mirror;
    case TINYGLTF_TEXTURE_WRAP_REPEAT:
        return Wrap::repeat;
    default:
        warn(document, object, "wrap mode " + std::to_string(mode) + " is unknown; it repeats");
        return Wrap::repeat;
    }
}

// The image of a texture's extension, or `none`.
int image_of(const tinygltf::Texture& texture, const char* extension) {
    const auto found = texture.extensions.find(extension);
    const bool named = found != texture.extensions.end() && found->second.Get("source").IsInt();
    return named ? found->second.Get("source").GetNumberAsInt() : none;
}

// The image that a texture reads, or `none`: WebP where this program can decode it, else the core image, else what an
// extension names, so that a warning can say what is lacking.
int image_of(const Document& document, const tinygltf::Texture& texture, const std::string& object) {
    const int webp = image_of(texture, "EXT_texture_webp");
    if (texture.source != none) {
        return webp != none && reads_webp(document, object) ? webp : texture.source;
    }
    return webp != none ? webp : image_of(texture, "KHR_texture_basisu");
}

int import_image(Context& context, int index, const std::string& object) {
    if (index < 0 || static_cast<std::size_t>(index) >= context.document.images.size()) {
        fail(context.document, object, "there is no images[" + std::to_string(index) + "]");
    }
    const auto [entry, added] =
        context.tables.images.try_emplace(index, static_cast<int>(context.tables.wanted_images.size()));
    if (added) {
        context.tables.wanted_images.push_back(index);
    }
    return entry->second;
}

// The scene's texture for the file's, or `none` where that has no image we can use.
int import_texture(Context& context, int index, const std::string& slot) {
    Document& document = context.document;
    if (index < 0 || static_cast<std::size_t>(index) >= document.model.textures.size()) {
        fail(document, slot, "there is no textures[" + std::to_string(index) + "]");
    }
    if (const auto found = context.tables.textures.find(index); found != context.tables.textures.end()) {
        return found->second;
    }
    const tinygltf::Texture& source = document.model.textures[static_cast<std::size_t>(index)];
    const std::string object = label("textures", static_cast<std::size_t>(index), source.name);
    const int image = image_of(document, source, object);
    if (image == none) {
        warn(document, object, "has no image; it is left out");
        return context.tables.textures[index] = none;
    }
    Texture texture;
    texture.name = source.name;
    texture.image = import_image(context, image, object + ".source");
    if (source.sampler != none) {
        if (source.sampler < 0 || static_cast<std::size_t>(source.sampler) >= document.model.samplers.size()) {
            fail(document, object, "there is no samplers[" + std::to_string(source.sampler) + "]");
        }
        const tinygltf::Sampler& sampler = document.model.samplers[static_cast<std::size_t>(source.sampler)];
        const std::string sampler_name = label("samplers", static_cast<std::size_t>(source.sampler), sampler.name);
        texture.wrap_u = wrap_mode(document, sampler.wrapS, sampler_name);
        texture.wrap_v = wrap_mode(document, sampler.wrapT, sampler_name);
        texture.filter = sampler.magFilter == TINYGLTF_TEXTURE_FILTER_NEAREST ? Filter::nearest : Filter::linear;
    }
    context.scene.textures.push_back(std::move(texture));
    return context.tables.textures[index] = static_cast<int>(context.scene.textures.size()) - 1;
}

double number(const tinygltf::Value& object, const char* key, double fallback) {
    if (!object.Has(key) || !object.Get(key).IsNumber()) {
        return fallback;
    }
    return object.Get(key).GetNumberAsDouble();
}

template <std::size_t N>
std::array<double, N> numbers(const tinygltf::Value& object, const char* key, std::array<double, N> fallback) {
    if (!object.Has(key) || object.Get(key).ArrayLen() != N) {
        return fallback;
    }
    for (std::size_t i = 0; i < N; ++i) {
        const tinygltf::Value& value = object.Get(key).Get(static_cast<int>(i));
        fallback[i] = value.IsNumber() ? value.GetNumberAsDouble() : fallback[i];
    }
    return fallback;
}

// KHR_texture_transform: offset · rotation · scale, where a positive angle turns counter-clockwise as seen in the
// image, whose v axis points down.
void apply_transform(const tinygltf::Value& extension, TextureSlot& slot, int& uv_set) {
    const std::array<double, 2> offset = numbers<2>(extension, "offset", {0, 0});
    const std::array<double, 2> scale = numbers<2>(extension, "scale", {1, 1});
    const double angle = number(extension, "rotation", 0);
    const double c = std::cos(angle);
    const double s = std::sin(angle);
    slot.u_row = {c * scale[0], s * scale[1], offset[0]};
    slot.v_row = {-s * scale[0], c * scale[1], offset[1]};
    if (extension.Has("texCoord") && extension.Get("texCoord").IsInt()) {
        uv_set = extension.Get("texCoord").GetNumberAsInt();
    }
}

TextureSlot import_slot(Context& context, int texture, int uv_set, const tinygltf::ExtensionMap& extensions,
                        const std::string& object) {
    TextureSlot slot;
    if (texture == none) {
        return slot;
    }
    slot.texture = import_texture(context, texture, object);
    if (const auto found = extensions.find("KHR_texture_transform"); found != extensions.end()) {
        apply_transform(found->second, slot, uv_set);
    }
    if (uv_set < 0 || uv_set > 1) {
        warn(context.document, object,
             "reads UV set " + std::to_string(uv_set) + ", only 0 and 1 are supported; left out");
        return {};
    }
    slot.uv_set = uv_set;
    const glm::vec3 sum = slot.u_row + slot.v_row;
    if (!std::isfinite(sum.x + sum.y + sum.z)) {
        warn(context.document, object, "has a texture transform that is not finite; left out");
        slot.u_row = {1, 0, 0};
        slot.v_row = {0, 1, 0};
    }
    return slot;
}

template <typename Info>
TextureSlot import_slot(Context& context, const Info& info, const std::string& object) {
    return import_slot(context, info.index, info.texCoord, info.extensions, object);
}

// A texture reference inside an extension, which tinygltf leaves as JSON.
TextureSlot import_slot(Context& context, const tinygltf::Value& extension, const char* key,
                        const std::string& object) {
    if (!extension.Has(key) || !extension.Get(key).IsObject()) {
        return {};
    }
    const tinygltf::Value& info = extension.Get(key);
    if (!info.Get("index").IsInt()) {
        fail(context.document, object + "." + key, "has no index");
    }
    tinygltf::ExtensionMap extensions;
    if (info.Has("extensions") && info.Get("extensions").IsObject()) {
        extensions = info.Get("extensions").Get<tinygltf::Value::Object>();
    }
    const int uv_set = info.Get("texCoord").IsInt() ? info.Get("texCoord").GetNumberAsInt() : 0;
    return import_slot(context, info.Get("index").GetNumberAsInt(), uv_set, extensions, object + "." + key);
}

float in_range(Document& document, double value, double low, double high, const std::string& object) {
    const double clamped = std::clamp(value, low, high);
    if (clamped != value) {
        warn(document, object, "is out of range; clamped to " + std::to_string(clamped));
    }
    return static_cast<float>(clamped);
}

constexpr double unbounded = std::numeric_limits<float>::max();

void import_extensions(Context& context, const tinygltf::Material& source, const std::string& object,
                       Material& material) {
    const auto extension = [&](const char* name) -> const tinygltf::Value* {
        const auto found = source.extensions.find(name);
        return found == source.extensions.end() ? nullptr : &found->second;
    };
    Document& document = context.document;
    if (const tinygltf::Value* ior = extension("KHR_materials_ior")) {
        // 0 is the extension's word for a Fresnel term of 1.
        const double value = number(*ior, "ior", 1.5);
        material.ior = value == 0 ? 0.0F : in_range(document, value, 1, unbounded, object + ".ior");
    }
    if (const tinygltf::Value* specular = extension("KHR_materials_specular")) {
        material.specular =
            in_range(document, number(*specular, "specularFactor", 1), 0, 1, object + ".specularFactor");
        const std::array<double, 3> color = numbers<3>(*specular, "specularColorFactor", {1, 1, 1});
        for (int i = 0; i < 3; ++i) {
            material.specular_color[i] =
                in_range(document, color[static_cast<std::size_t>(i)], 0, unbounded, object + ".specularColorFactor");
        }
        material.specular_texture = import_slot(context, *specular, "specularTexture", object);
        material.specular_color_texture = import_slot(context, *specular, "specularColorTexture", object);
    }
    material.unlit = extension("KHR_materials_unlit") != nullptr;
}

AlphaMode alpha_mode(Document& document, const std::string& mode, const std::string& object) {
    if (mode == "MASK") {
        return AlphaMode::mask;
    }
    if (mode == "BLEND") {
        return AlphaMode::blend;
    }
    if (mode != "OPAQUE") {
        warn(document, object + ".alphaMode", "'" + mode + "' is unknown; taken as OPAQUE");
    }
    return AlphaMode::opaque;
}

Material import_material(Context& context, const tinygltf::Material& source, const std::string& object) {
    Document& document = context.document;
    const tinygltf::PbrMetallicRoughness& pbr = source.pbrMetallicRoughness;
    Material material;
    material.name = source.name;
    for (std::size_t i = 0; i < 4 && i < pbr.baseColorFactor.size(); ++i) {
        material.base_color[static_cast<int>(i)] =
            in_range(document, pbr.baseColorFactor[i], 0, 1, object + ".baseColorFactor");
    }
    material.metallic = in_range(document, pbr.metallicFactor, 0, 1, object + ".metallicFactor");
    material.roughness = in_range(document, pbr.roughnessFactor, 0, 1, object + ".roughnessFactor");
    material.normal_scale =
        in_range(document, source.normalTexture.scale, -unbounded, unbounded, object + ".normalTexture.scale");
    const MovingEmission emission = read_emission(document, source, object);
    material.emission = glm::min(emission.factor * emission.strength, glm::vec3(std::numeric_limits<float>::max()));
    material.alpha_mode = alpha_mode(document, source.alphaMode, object);
    material.alpha_cutoff = in_range(document, source.alphaCutoff, 0, unbounded, object + ".alphaCutoff");
    material.double_sided = source.doubleSided;
    material.base_color_texture = import_slot(context, pbr.baseColorTexture, object + ".baseColorTexture");
    material.metallic_roughness_texture =
        import_slot(context, pbr.metallicRoughnessTexture, object + ".metallicRoughnessTexture");
    material.normal_texture = import_slot(context, source.normalTexture, object + ".normalTexture");
    material.emission_texture = import_slot(context, source.emissiveTexture, object + ".emissiveTexture");
    import_extensions(context, source, object, material);
    return material;
}

// A colour from an image that cannot be had shows the checker that stands for it. Other values are left out: a checker
// is no direction, and its roughness would look like a choice.
void settle_missing_images(Context& context, const std::vector<std::string>& problems) {
    Document& document = context.document;
    const auto image_label = [&](std::size_t image) {
        const int index = context.tables.wanted_images[image];
        return label("images", static_cast<std::size_t>(index), document.images[static_cast<std::size_t>(index)].name);
    };
    const auto missing = [&](const TextureSlot& slot) -> std::optional<std::size_t> {
        if (slot.texture == none) {
            return std::nullopt;
        }
        const int image = context.scene.textures[static_cast<std::size_t>(slot.texture)].image;
        const auto i = static_cast<std::size_t>(image);
        return problems[i].empty() ? std::nullopt : std::optional(i);
    };
    for (std::size_t i = 0; i < context.scene.materials.size(); ++i) {
        Material& material = context.scene.materials[i];
        for (const TextureSlot* slot :
             {&material.base_color_texture, &material.emission_texture, &material.specular_color_texture}) {
            if (const auto image = missing(*slot)) {
                warn(document, image_label(*image), "cannot be read; shown as a magenta-black checker",
                     problems[*image]);
            }
        }
        const std::string object = label("materials", i, material.name);
        for (const auto& [slot, name] : {std::pair(&material.metallic_roughness_texture, ".metallicRoughnessTexture"),
                                         {&material.normal_texture, ".normalTexture"},
                                         {&material.specular_texture, ".specularTexture"}}) {
            if (const auto image = missing(*slot)) {
                warn(document, object + name, "is left out, because its image cannot be read",
                     image_label(*image) + ": " + problems[*image]);
                *slot = {};
            }
        }
    }
}

}  // namespace

MovingEmission read_emission(Document& document, const tinygltf::Material& source, const std::string& object) {
    MovingEmission emission;
    for (std::size_t i = 0; i < 3 && i < source.emissiveFactor.size(); ++i) {
        emission.factor[static_cast<int>(i)] =
            in_range(document, source.emissiveFactor[i], 0, unbounded, object + ".emissiveFactor");
    }
    const auto extension = source.extensions.find("KHR_materials_emissive_strength");
    if (extension != source.extensions.end()) {
        emission.strength = in_range(document, number(extension->second, "emissiveStrength", 1), 0, unbounded,
                                     object + ".emissiveStrength");
    }
    return emission;
}

void import_materials(Document& document, Scene& scene) {
    Context context{document, scene, {}};
    for (std::size_t i = 0; i < document.model.materials.size(); ++i) {
        const tinygltf::Material& source = document.model.materials[i];
        scene.materials.push_back(import_material(context, source, label("materials", i, source.name)));
    }
    DecodedImages decoded = decode_images(document, context.tables.wanted_images);
    scene.images = std::move(decoded.images);
    settle_missing_images(context, decoded.problems);
}

}  // namespace diptych::core::gltf
