// The table of passes, from which barriers are made, against what the shaders do.
#include "passes/pass_table.h"

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <set>
#include <string>
#include <vector>

#include "catch.h"
#include "language/scene_buffers.h"
#include "shader_binaries.h"
#include "spirv_accesses.h"

namespace diptych::core::tests {
namespace {

using Touched = std::set<std::pair<Resource, Effect>>;

struct NamedResource {
    std::string_view name;
    Resource resource;
};

// A buffer of several resources has several rows.
constexpr NamedResource named_resources[] = {
#define SCENE_NAME(Type, name) {#name, Resource::scene},
    SCENE_BUFFERS(SCENE_NAME)
#undef SCENE_NAME
        {"grouped_geometries", Resource::scene},
    {"SceneAddresses", Resource::scene},
    {"Constants", Resource::scene},
    {"structures", Resource::structures},
    {"FilmWords", Resource::film},
    {"Reservoirs", Resource::reservoirs},
    {"Histogram", Resource::histogram},
    {"first_vertices", Resource::first_vertices},
    {"reservoirs", Resource::reservoirs},
    {"reuse_surfaces", Resource::reuse_surfaces},
    {"candidate_list", Resource::candidate_list},
    {"wave_paths", Resource::wave_paths},
    {"wave_paths", Resource::wave_radiance},
    {"wave_paths.radiance", Resource::wave_radiance},
    {"wave_first_hits", Resource::wave_first_hits},
    {"wave_queues", Resource::wave_queues},
    {"wave_hits", Resource::wave_hits},
    {"wave_shadows", Resource::wave_shadows},
    {"wave_counts", Resource::wave_counts},
    {"recorded_rays", Resource::recorded_rays},
    {"ray_counters", Resource::recorded_rays},
    {"path_queries", Resource::path_queries},
    {"path_vertices", Resource::path_records},
    {"path_summaries", Resource::path_records},
};

std::vector<Resource> resources_named(std::string_view name) {
    std::vector<Resource> found;
    for (const NamedResource& known : named_resources) {
        if (known.name == name) {
            found.push_back(known.resource);
        }
    }
    return found;
}

/// Of a buffer, or of the member of its elements that is accessed alone; of one without a row, the first of the whole.
std::vector<Resource> resources_of(std::string_view name) {
    std::vector<Resource> found = resources_named(name);
    if (found.empty()) {
        found = resources_named(name.substr(0, name.find('.')));
        found.resize(std::min<std::size_t>(found.size(), 1));
    }
    INFO("memory that is no resource of the table: " << name);
    REQUIRE_FALSE(found.empty());
    return found;
}

/// Appends are writes to the shader.
Touched declared(const PassUses& pass) {
    Touched touched;
    for (const Use& use : pass.uses) {
        touched.emplace(use.resource, use.effect == Effect::append ? Effect::write : use.effect);
    }
    return touched;
}

void add_accesses(std::string_view shader, Touched& touched) {
    for (const auto& [name, accesses] : memory_accesses(shader_binary(shader))) {
        for (const Resource resource : resources_of(name)) {
            if (accesses.reads) {
                touched.emplace(resource, Effect::read);
            }
            if (accesses.writes) {
                touched.emplace(resource, Effect::write);
            }
        }
    }
}

Touched done(std::string_view shader) {
    Touched touched;
    add_accesses(shader, touched);
    if (shader.ends_with(".rgen")) {
        for (const char* called : {"closest.rchit", "closest.rmiss", "shadow.rmiss", "closest.rahit", "shadow.rahit"}) {
            add_accesses(called, touched);
        }
    }
    return touched;
}

std::string text_of(const Touched& touched) {
    std::string text;
    for (const auto& [resource, effect] : touched) {
        text += (effect == Effect::read ? " reads " : " writes ") + std::to_string(static_cast<int>(resource));
    }
    return text;
}

}  // namespace

TEST_CASE("Passes declare what their shaders read and write, no less and no more") {
    for (const PassUses& pass : pass_table()) {
        INFO(pass.shader);
        CHECK(text_of(declared(pass)) == text_of(done(pass.shader)));
        for (const Use& use : pass.uses) {
            CHECK((use.effect != Effect::append || use.resource == Resource::recorded_rays));
            CHECK((use.unit == Unit::compute) == pass.shader.ends_with(".comp"));
        }
    }
}

TEST_CASE("Every shader that begins a pass is in the table of passes") {
    std::set<std::string> listed;
    for (const PassUses& pass : pass_table()) {
        listed.emplace(pass.shader);
    }
    std::set<std::string> present;
    for (const auto& file : std::filesystem::directory_iterator(DIPTYCH_SOURCE_DIR "/shaders")) {
        if (file.path().extension() == ".rgen" || file.path().extension() == ".comp") {
            present.insert(file.path().filename().string());
        }
    }
    CHECK(present == listed);
}

// Images and the window's frames are not resources of the table: their barriers change layouts too.
TEST_CASE("Barriers of the device's memory are recorded in one place alone") {
    const std::set<std::string> exempt = {"recorder.cpp", "display_pass.cpp"};
    for (const auto& file : std::filesystem::recursive_directory_iterator(DIPTYCH_SOURCE_DIR "/vk_backend")) {
        if (!file.is_regular_file()) {
            continue;
        }
        std::ifstream stream(file.path());
        const std::string text{std::istreambuf_iterator<char>(stream), {}};
        INFO(file.path().filename());
        CHECK((text.find("pipelineBarrier") == std::string::npos) == !exempt.contains(file.path().filename().string()));
    }
}

}  // namespace diptych::core::tests
