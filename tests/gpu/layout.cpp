// Offsets of every shared struct, as the SPIR-V has them and as C++ has them.
#include <map>
#include <string>

#include "../../shaders/dispatch.h"
#include "../../shaders/display.h"
#include "../../shaders/wave.h"
#include "catch.h"
#include "film/film_pixel.h"
#include "geometry/hit.h"
#include "path/path_record.h"
#include "memory/scene_addresses.h"
#include "language/scene_types.h"
#include "shader_binaries.h"

namespace diptych::core::tests {
namespace {

struct Layouts {
    std::map<std::string, std::map<std::string, std::uint32_t>> offsets;  // struct -> field -> bytes
    std::map<std::string, std::uint32_t> strides;                         // element struct of a run-time array -> bytes
};

std::string text_at(std::span<const std::uint32_t> words) {
    return reinterpret_cast<const char*>(words.data());
}

// SPIR-V 1.5, sections 2.3 and 3.32: only what names and decorates members and arrays.
Layouts read_layouts(std::span<const std::uint32_t> spirv) {
    constexpr std::uint32_t op_name = 5;
    constexpr std::uint32_t op_member_name = 6;
    constexpr std::uint32_t op_type_runtime_array = 29;
    constexpr std::uint32_t op_decorate = 71;
    constexpr std::uint32_t op_member_decorate = 72;
    constexpr std::uint32_t array_stride = 6;
    constexpr std::uint32_t offset = 35;
    std::map<std::uint32_t, std::string> names;
    std::map<std::pair<std::uint32_t, std::uint32_t>, std::string> member_names;
    std::map<std::uint32_t, std::uint32_t> strides;
    Layouts layouts;
    for (std::size_t at = 5; at < spirv.size(); at += spirv[at] >> 16U) {
        const auto words = spirv.subspan(at, spirv[at] >> 16U);
        const std::uint32_t op = words[0] & 0xffffU;
        if (op == op_name) {
            names[words[1]] = text_at(words.subspan(2));
        } else if (op == op_member_name) {
            member_names[{words[1], words[2]}] = text_at(words.subspan(3));
        } else if (op == op_member_decorate && words[3] == offset) {
            layouts.offsets[names[words[1]]][member_names[{words[1], words[2]}]] = words[4];
        } else if (op == op_decorate && words[2] == array_stride) {
            strides[words[1]] = words[3];
        } else if (op == op_type_runtime_array) {
            layouts.strides[names[words[2]]] = strides[words[1]];
        }
    }
    return layouts;
}

using Offsets = std::map<std::string, std::uint32_t>;
#define FIELD(Type, name)                                                                                              \
    { #name, static_cast < std::uint32_t>(offsetof(shared::Type, name)) }

// Every field of every struct on the bus.
std::map<std::string, Offsets> cpp_offsets() {
    return {
        {"Instance",
         {FIELD(Instance, row_0), FIELD(Instance, row_1), FIELD(Instance, row_2), FIELD(Instance, first_geometry),
          FIELD(Instance, first_emitter_slot), FIELD(Instance, mirrored)}},
        {"Geometry",
         {FIELD(Geometry, first_triangle), FIELD(Geometry, first_vertex), FIELD(Geometry, first_normal),
          FIELD(Geometry, first_tangent), FIELD(Geometry, first_uv_0), FIELD(Geometry, first_uv_1),
          FIELD(Geometry, first_color), FIELD(Geometry, material)}},
        {"Material",
         {FIELD(Material, base_color), FIELD(Material, emission), FIELD(Material, metallic),
          FIELD(Material, specular_color), FIELD(Material, roughness), FIELD(Material, specular), FIELD(Material, f0),
          FIELD(Material, normal_scale), FIELD(Material, alpha_cutoff), FIELD(Material, flags),
          FIELD(Material, base_color_slot), FIELD(Material, metallic_roughness_slot), FIELD(Material, normal_slot),
          FIELD(Material, emission_slot), FIELD(Material, specular_slot), FIELD(Material, specular_color_slot)}},
        {"TextureSlot",
         {FIELD(TextureSlot, first_texel), FIELD(TextureSlot, width), FIELD(TextureSlot, height),
          FIELD(TextureSlot, flags), FIELD(TextureSlot, u_row), FIELD(TextureSlot, v_row)}},
        {"EmissiveTriangle",
         {FIELD(EmissiveTriangle, vertex_0), FIELD(EmissiveTriangle, pmf), FIELD(EmissiveTriangle, edge_1),
          FIELD(EmissiveTriangle, flags), FIELD(EmissiveTriangle, edge_2), FIELD(EmissiveTriangle, geometry),
          FIELD(EmissiveTriangle, radiance), FIELD(EmissiveTriangle, primitive), FIELD(EmissiveTriangle, front),
          FIELD(EmissiveTriangle, double_area)}},
        {"PunctualLight",
         {FIELD(PunctualLight, position), FIELD(PunctualLight, type), FIELD(PunctualLight, direction),
          FIELD(PunctualLight, pmf), FIELD(PunctualLight, intensity), FIELD(PunctualLight, cone_scale),
          FIELD(PunctualLight, cone_offset), FIELD(PunctualLight, part)}},
        {"AliasEntry", {FIELD(AliasEntry, probability), FIELD(AliasEntry, alias)}},
        {"LightCluster",
         {FIELD(LightCluster, center), FIELD(LightCluster, spread), FIELD(LightCluster, pmf),
          FIELD(LightCluster, first), FIELD(LightCluster, count), FIELD(LightCluster, radius)}},
        {"ClusterPick", {FIELD(ClusterPick, probability), FIELD(ClusterPick, light), FIELD(ClusterPick, alias)}},
        {"LightNode",
         {FIELD(LightNode, center_x), FIELD(LightNode, center_y), FIELD(LightNode, center_z), FIELD(LightNode, place),
          FIELD(LightNode, spread), FIELD(LightNode, axis_x), FIELD(LightNode, axis_y), FIELD(LightNode, axis_z),
          FIELD(LightNode, blur), FIELD(LightNode, front), FIELD(LightNode, power), FIELD(LightNode, child)}},
        {"LeafPick",
         {FIELD(LeafPick, probability), FIELD(LeafPick, light), FIELD(LeafPick, light_share), FIELD(LeafPick, alias),
          FIELD(LeafPick, alias_share)}},
        {"LightPlace", {FIELD(LightPlace, slot), FIELD(LightPlace, share)}},
        {"Camera",
         {FIELD(Camera, origin), FIELD(Camera, kind), FIELD(Camera, right), FIELD(Camera, lens_radius),
          FIELD(Camera, up), FIELD(Camera, focus_distance), FIELD(Camera, forward)}},
        {"Environment",
         {FIELD(Environment, scale), FIELD(Environment, kind), FIELD(Environment, rotation), FIELD(Environment, size),
          FIELD(Environment, pmf)}},
        {"RenderConstants",
         {FIELD(RenderConstants, camera), FIELD(RenderConstants, environment), FIELD(RenderConstants, size),
          FIELD(RenderConstants, seed), FIELD(RenderConstants, sampler_kind), FIELD(RenderConstants, sample_count),
          FIELD(RenderConstants, max_depth), FIELD(RenderConstants, integrator), FIELD(RenderConstants, brdf),
          FIELD(RenderConstants, normal_maps),
          FIELD(RenderConstants, mis), FIELD(RenderConstants, light_sampler), FIELD(RenderConstants, light_count),
          FIELD(RenderConstants, emissive_triangle_count), FIELD(RenderConstants, punctual_light_count),
          FIELD(RenderConstants, light_cluster_count), FIELD(RenderConstants, atlas_tile),
          FIELD(RenderConstants, previous_camera), FIELD(RenderConstants, resampling)}},
        {"ResamplingConstants",
         {FIELD(ResamplingConstants, light_candidates), FIELD(ResamplingConstants, near_candidates),
          FIELD(ResamplingConstants, bsdf_candidates), FIELD(ResamplingConstants, temporal),
          FIELD(ResamplingConstants, spatial_passes), FIELD(ResamplingConstants, neighbors),
          FIELD(ResamplingConstants, radius), FIELD(ResamplingConstants, confidence_cap),
          FIELD(ResamplingConstants, mis), FIELD(ResamplingConstants, visibility), FIELD(ResamplingConstants, reach)}},
        {"ResamplingPass",
         {FIELD(ResamplingPass, frame), FIELD(ResamplingPass, reservoirs), FIELD(ResamplingPass, other_reservoirs),
          FIELD(ResamplingPass, surfaces), FIELD(ResamplingPass, has_history), FIELD(ResamplingPass, iteration)}},
        {"FirstVertex",
         {FIELD(FirstVertex, hit), FIELD(FirstVertex, origin), FIELD(FirstVertex, rays), FIELD(FirstVertex, occluded)}},
        {"Reservoir",
         {FIELD(Reservoir, point), FIELD(Reservoir, weight), FIELD(Reservoir, confidence), FIELD(Reservoir, target),
          FIELD(Reservoir, favor)}},
        {"CandidateRequest",
         {FIELD(CandidateRequest, pixel), FIELD(CandidateRequest, needs), FIELD(CandidateRequest, share),
          FIELD(CandidateRequest, near_sum)}},
        {"LightPoint", {FIELD(LightPoint, light), FIELD(LightPoint, uv)}},
        {"ReuseSurface",
         {FIELD(ReuseSurface, position), FIELD(ReuseSurface, geometric_normal), FIELD(ReuseSurface, normal),
          FIELD(ReuseSurface, wo), FIELD(ReuseSurface, diffuse), FIELD(ReuseSurface, f0), FIELD(ReuseSurface, rest)}},
        {"Dispatch",
         {FIELD(Dispatch, origin), FIELD(Dispatch, first_sample), FIELD(Dispatch, sample_count),
          FIELD(Dispatch, ray_capacity), FIELD(Dispatch, first_ray), FIELD(Dispatch, first_path),
          FIELD(Dispatch, vertices_per_path), FIELD(Dispatch, region), FIELD(Dispatch, path_capacity),
          FIELD(Dispatch, wave), FIELD(Dispatch, pass)}},
        {"WavePath",
         {FIELD(WavePath, origin), FIELD(WavePath, pdf_direction), FIELD(WavePath, direction),
          FIELD(WavePath, alpha_key), FIELD(WavePath, throughput), FIELD(WavePath, state), FIELD(WavePath, reference),
          FIELD(WavePath, rays), FIELD(WavePath, radiance), FIELD(WavePath, facing)}},
        {"WaveShadow",
         {FIELD(WaveShadow, origin), FIELD(WaveShadow, t_max), FIELD(WaveShadow, direction),
          FIELD(WaveShadow, alpha_key), FIELD(WaveShadow, radiance), FIELD(WaveShadow, path)}},
        {"WaveCounts", {FIELD(WaveCounts, rays), FIELD(WaveCounts, shading), FIELD(WaveCounts, shadows)}},
        {"Hit",
         {FIELD(Hit, instance), FIELD(Hit, geometry), FIELD(Hit, primitive), FIELD(Hit, barycentrics), FIELD(Hit, t)}},
        {"FirstHit", {FIELD(FirstHit, albedo), FIELD(FirstHit, normal), FIELD(FirstHit, depth)}},
        {"RecordedRay",
         {FIELD(RecordedRay, origin), FIELD(RecordedRay, t_max), FIELD(RecordedRay, direction),
          FIELD(RecordedRay, alpha_key)}},
        {"PathQuery", {FIELD(PathQuery, pixel), FIELD(PathQuery, sample_index)}},
        {"PathSummary", {FIELD(PathSummary, radiance), FIELD(PathSummary, vertices), FIELD(PathSummary, signature)}},
        {"PathVertexRecord",
         {FIELD(PathVertexRecord, direction), FIELD(PathVertexRecord, instance), FIELD(PathVertexRecord, position),
          FIELD(PathVertexRecord, geometry), FIELD(PathVertexRecord, normal), FIELD(PathVertexRecord, primitive),
          FIELD(PathVertexRecord, emission), FIELD(PathVertexRecord, emission_weight), FIELD(PathVertexRecord, direct),
          FIELD(PathVertexRecord, light_pdf), FIELD(PathVertexRecord, throughput), FIELD(PathVertexRecord, bsdf_pdf),
          FIELD(PathVertexRecord, barycentrics), FIELD(PathVertexRecord, t), FIELD(PathVertexRecord, survival),
          FIELD(PathVertexRecord, light), FIELD(PathVertexRecord, shadow), FIELD(PathVertexRecord, lobe),
          FIELD(PathVertexRecord, roulette)}},
        {"RayCounters", {FIELD(RayCounters, closest), FIELD(RayCounters, any), FIELD(RayCounters, impossible)}},
    };
}

Offsets address_offsets() {
    Offsets offsets;
#define ADD_OFFSET(Type, name) offsets[#name] = static_cast<std::uint32_t>(offsetof(SceneAddresses, name));
    SCENE_BUFFERS(ADD_OFFSET)
#undef ADD_OFFSET
#define ADD_OFFSET(Type, name, alignment, access) offsets[#name] = static_cast<std::uint32_t>(offsetof(SceneAddresses, name));
    DEVICE_ARRAYS(ADD_OFFSET)
#undef ADD_OFFSET
#define ADD_OFFSET(name) offsets[#name] = static_cast<std::uint32_t>(offsetof(SceneAddresses, name));
    DEVICE_BLOCKS(ADD_OFFSET)
#undef ADD_OFFSET
    return offsets;
}

}  // namespace

TEST_CASE("Shared structs lie in memory as the shaders see them") {
    const Layouts layouts = read_layouts(shader_binary("wave_shade.comp"));
    for (const auto& [name, offsets] : cpp_offsets()) {
        CAPTURE(name);
        const auto found = layouts.offsets.find(name);
        REQUIRE(found != layouts.offsets.end());
        CHECK(found->second == offsets);
    }
    CHECK(layouts.offsets.at("SceneAddresses") == address_offsets());
}

TEST_CASE("What the display pass is told lies in memory as its shader sees it") {
    const Layouts layouts = read_layouts(shader_binary("display.comp"));
    CHECK(layouts.offsets.at("DisplayFilm") == Offsets{FIELD(DisplayFilm, pixels), FIELD(DisplayFilm, moments),
                                                       FIELD(DisplayFilm, first_hits), FIELD(DisplayFilm, reservoirs),
                                                       FIELD(DisplayFilm, size)});
    CHECK(layouts.offsets.at("Display") ==
          Offsets{FIELD(Display, left), FIELD(Display, right), FIELD(Display, size), FIELD(Display, divider),
                  FIELD(Display, layer), FIELD(Display, flags), FIELD(Display, tonemap), FIELD(Display, exposure),
                  FIELD(Display, low), FIELD(Display, high)});
    CHECK(layouts.strides.at("Reservoir") == sizeof(shared::Reservoir));
}

TEST_CASE("Arrays of shared structs have the stride of their size") {
    const Layouts layouts = read_layouts(shader_binary("wave_shade.comp"));
#define CHECK_STRIDE(Type) CHECK(layouts.strides.at(#Type) == sizeof(shared::Type))
    CHECK_STRIDE(Instance);
    CHECK_STRIDE(Geometry);
    CHECK_STRIDE(Material);
    CHECK_STRIDE(TextureSlot);
    CHECK_STRIDE(EmissiveTriangle);
    CHECK_STRIDE(PunctualLight);
    CHECK_STRIDE(AliasEntry);
    CHECK_STRIDE(LightCluster);
    CHECK_STRIDE(ClusterPick);
    CHECK_STRIDE(LightNode);
    CHECK_STRIDE(LeafPick);
    CHECK_STRIDE(LightPlace);
    CHECK_STRIDE(RecordedRay);
    CHECK_STRIDE(FirstVertex);
    CHECK_STRIDE(Reservoir);
    CHECK_STRIDE(ReuseSurface);
    CHECK_STRIDE(WavePath);
    CHECK_STRIDE(WaveShadow);
    CHECK_STRIDE(WaveCounts);
    CHECK_STRIDE(Hit);
    CHECK_STRIDE(FirstHit);
    CHECK_STRIDE(PathQuery);
    CHECK_STRIDE(PathSummary);
    CHECK_STRIDE(PathVertexRecord);
}

}  // namespace diptych::core::tests
