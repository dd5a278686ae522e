#include <CLI/CLI.hpp>

#include <algorithm>
#include <memory>

#include "commands/arguments/arguments.h"
#include "commands/command.h"
#include "commands/info/devices_info.h"
#include "error.h"
#include "pack/features.h"
#include "pack/packed_scene.h"
#include "session/open_session.h"
#include "render/film.h"
#include "console/output.h"
#include "console/option_names.h"
#include "console/report.h"
#include "pose/clips.h"
#include "scene/default_camera.h"
#include "pose/pose.h"
#include "session/scene_setup.h"

namespace diptych::core::app {

namespace {

constexpr const char* info_examples = R"(Examples:
  diptych info scene.gltf
  diptych info scene.gltf --integrator brdf --brdf blinn-phong --json
  diptych info scene.gltf --backend vulkan --size 1920x1080
  diptych info --devices
What a scene needs depends on the integrator, the BRDF, the environment and the size, so the options of render
apply. The memory is what render needs with these options. The acceleration structures are built on the backend to
measure their size.)";

struct InfoOptions {
    RenderArguments arguments;
    bool layers = true;
    bool devices = false;
    bool json = false;
};

struct Counts {
    std::size_t triangles = 0;         // as stored
    std::size_t placed_triangles = 0;  // as seen, instances counted
};

std::size_t mesh_triangles(const Mesh& mesh) {
    std::size_t triangles = 0;
    for (const Primitive& primitive : mesh.primitives) {
        triangles += primitive.triangles.size();
    }
    return triangles;
}

Counts count_triangles(const Scene& scene) {
    Counts counts;
    for (const Mesh& mesh : scene.meshes) {
        counts.triangles += mesh_triangles(mesh);
    }
    for (const Instance& instance : scene.instances) {
        counts.placed_triangles += mesh_triangles(scene.meshes[static_cast<std::size_t>(instance.mesh)]);
    }
    return counts;
}

struct BufferSize {
    const char* name;
    std::uint64_t bytes;
};

/// The scene's buffers, then the film's, those that are empty left out.
std::vector<BufferSize> buffer_sizes(const PackedScene& packed, const RenderSettings& settings, bool on_device) {
    std::vector<BufferSize> sizes;
    const auto add = [&](const char* name, std::uint64_t bytes) {
        if (bytes > 0) {
            sizes.push_back({name, bytes});
        }
    };
#define ADD_BUFFER(Type, name) add(#name, packed.name.size() * sizeof(packed.name[0]));
    SCENE_BUFFERS(ADD_BUFFER)
#undef ADD_BUFFER
    std::uint64_t pixels = static_cast<std::uint64_t>(settings.width) * static_cast<std::uint64_t>(settings.height);
    if (on_device) {
        constexpr std::uint64_t block = 32;  // shaders/film_layout.h
        pixels = (pixels + block - 1) / block * block;
    }
    const auto feature = [&](std::uint32_t bit) { return (packed.features & bit) != 0; };
    add("film", pixels * sizeof(shared::FilmPixel));
    add("film_moments", feature(shared::FEATURE_STANDARD_ERROR) ? pixels * sizeof(shared::FilmMoments) : 0);
    add("film_first_hits", feature(shared::FEATURE_FIRST_HIT_LAYERS) ? pixels * sizeof(shared::FilmFirstHit) : 0);
    return sizes;
}

/// The renderer is built for the size of its acceleration structures; scratch memory of builds is not counted.
nlohmann::ordered_json gather(const Session& session) {
    const Scene& scene = session.scene();
    const PackedScene& packed = session.packed();
    const RenderSettings& settings = session.settings();
    const Counts counts = count_triangles(scene);
    const Bounds bounds = scene_bounds(scene);
    nlohmann::ordered_json json;
    json["scene"] = scene.name;
    json["triangles"] = counts.triangles;
    json["placed_triangles"] = counts.placed_triangles;
    json["meshes"] = scene.meshes.size();
    json["instances"] = scene.instances.size();
    json["lights"] = packed.constants.light_count;
    json["emissive_triangles"] = packed.constants.emissive_triangle_count;
    json["punctual_lights"] = packed.constants.punctual_light_count;
    json["materials"] = scene.materials.size();
    json["textures"] = scene.textures.size();
    json["images"] = scene.images.size();
    json["cameras"] = nlohmann::ordered_json::array();
    for (const Camera& camera : scene.cameras) {
        json["cameras"].push_back(camera.name);
    }
    json["animations"] = scene.animations.size();
    json["clips"] = nlohmann::ordered_json::array();
    for (std::size_t i = 0; i < scene.animations.size(); ++i) {
        const Animation& clip = scene.animations[i];
        json["clips"].push_back({{"index", i},
                                 {"name", clip.name},
                                 {"seconds", duration(clip)},
                                 {"channels", clip.channels.size()}});
    }
    json["animation_seconds"] = duration(scene);
    if (!is_empty(bounds)) {
        json["bounds"] = {{bounds.lo.x, bounds.lo.y, bounds.lo.z}, {bounds.hi.x, bounds.hi.y, bounds.hi.z}};
    }
    json["width"] = settings.width;
    json["height"] = settings.height;
    json["features"] = feature_names(packed.features);
    json["left_out"] = feature_names(~packed.features);
    std::uint64_t bytes = 0;
    json["buffers"] = nlohmann::ordered_json::object();
    for (const BufferSize& buffer : buffer_sizes(packed, settings, session.renderer().backend() == "vulkan")) {
        json["buffers"][buffer.name] = buffer.bytes;
        bytes += buffer.bytes;
    }
    const Renderer& renderer = session.renderer();
    json["backend"] = renderer.backend();
    json["device"] = renderer.device();
    const RendererCosts costs = renderer.costs();
    json["acceleration_structures"] = costs.acceleration_bytes;
    json["between_passes"] = costs.pass_bytes;
    json["bytes"] = bytes + costs.acceleration_bytes + costs.pass_bytes;
    Warnings warnings = scene.warnings;
    warnings.append(clip_warnings(scene));
    std::vector<std::string> lines = warnings.lines();
    lines.insert(lines.end(), packed.warnings.begin(), packed.warnings.end());
    std::transform(lines.begin(), lines.end(), lines.begin(), with_option_names);
    json["warnings"] = lines;
    return json;
}

std::string words(const nlohmann::ordered_json& list) {
    std::string text;
    for (const auto& word : list) {
        text += (text.empty() ? "" : ", ") + word.get<std::string>();
    }
    return text.empty() ? "nothing" : text;
}

void print_info(const nlohmann::ordered_json& json) {
    const auto number = [&](const char* name) { return json.at(name).get<std::uint64_t>(); };
    print_result("{}\n", json.at("scene").get<std::string>());
    print_result("  triangles   {} stored in {} meshes, {} placed by {} instances\n", number("triangles"),
                 number("meshes"), number("placed_triangles"), number("instances"));
    print_result("  lights      {}: {} emissive triangles, {} punctual\n", number("lights"),
                 number("emissive_triangles"), number("punctual_lights"));
    print_result("  materials   {}, textures {} of {} images\n", number("materials"), number("textures"),
                 number("images"));
    print_result("  cameras     {}\n", words(json.at("cameras")));
    if (number("animations") > 0) {
        print_result("  animations  {}, {} s long\n", number("animations"), json.at("animation_seconds").get<double>());
        for (const auto& clip : json.at("clips")) {
            print_result("    {:<3} '{}', {} s, {} channels\n", clip.at("index").get<std::size_t>(),
                         clip.at("name").get<std::string>(), clip.at("seconds").get<double>(),
                         clip.at("channels").get<std::size_t>());
        }
    }
    if (json.contains("bounds")) {
        print_result("  bounds      {} to {}\n", json["bounds"][0].dump(), json["bounds"][1].dump());
    }
    print_result("  needs       {}\n", words(json.at("features")));
    print_result("  left out    {}\n", words(json.at("left_out")));
    print_result("  memory      {} at {}x{} on {}\n", byte_text(json.at("bytes").get<double>()), number("width"),
                 number("height"), json.at("backend").get<std::string>());
    const auto part = [](const std::string& name, const nlohmann::ordered_json& bytes) {
        print_result("    {:<23} {:>12}\n", name, byte_text(bytes.get<double>()));
    };
    for (const auto& [name, bytes] : json.at("buffers").items()) {
        part(name, bytes);
    }
    part("acceleration structures", json.at("acceleration_structures"));
    if (number("between_passes") > 0) {
        part("between passes", json.at("between_passes"));
    }
}

int run_info(InfoOptions options) {
    if (options.devices) {
        return print_devices(options.json);
    }
    RenderRequest& request = options.arguments.request;
    if (request.scene.empty()) {
        throw Error("info: needs a scene, or --devices");
    }
    resolve_names(options.arguments);
    request.settings.standard_error = options.layers;
    request.settings.first_hit_layers = options.layers;
    const Scene scene = prepare_scene(options.arguments);
    report_warnings(clip_warnings(scene));
    const nlohmann::ordered_json json = gather(open_session(scene, request));
    if (options.json) {
        print_json(json);
    } else {
        print_info(json);
    }
    return exit_done;
}

}  // namespace

void add_info(CLI::App& app, Run& run) {
    CLI::App* command = app.add_subcommand("info", "Show what a scene contains and needs, or list the devices");
    auto options = std::make_shared<InfoOptions>();
    command->add_option("scene", options->arguments.request.scene, ".gltf or .glb file");
    command->add_flag("--devices", options->devices, "List the devices, and what each lacks for rendering");
    add_integrator_option(*command, options->arguments);
    add_scene_options(*command, options->arguments);
    add_backend_options(*command, options->arguments);
    command->add_flag("--layers,!--no-layers", options->layers,
                      "Count the layers beside colour in the memory; on by default");
    command->add_flag("--json", options->json, "Print the results as JSON");
    command->footer(info_examples);
    command->callback([options, &run] { run = [options] { return run_info(*options); }; });
}

}  // namespace diptych::core::app
