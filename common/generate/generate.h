// The scenes that the project makes itself. Each is a pure function of its options.
#pragma once

#include "scene/scene.h"

#include <cstdint>
#include <optional>
#include <span>
#include <string>

namespace diptych::core {

struct GenerateOptions {
    std::uint64_t count = 1000;  // many-lights: how many emitters
    std::uint32_t seed = 1;      // many-lights: which street
};

/// Settings of a render that shows the scene as it is meant: what glTF cannot hold.
struct RecommendedSettings {
    std::string environment;                 // as RenderRequest::environment; empty: the default
    std::optional<std::uint32_t> max_depth;  // none: the default
};

struct GeneratedScene {
    Scene scene;
    RecommendedSettings recommended;
};

struct SceneGenerator {
    const char* name;
    const char* description;  // one line
    GeneratedScene (*generate)(const GenerateOptions& options);
};

/// All of them, in the order to list them.
std::span<const SceneGenerator> scene_generators();

/// Those at the extremes of numbers and files, of scenes/extremes: some overlap, some are broken, as no others are.
std::span<const SceneGenerator> extreme_scene_generators();

/// Throws Error, listing the names, where none is called `name`.
GeneratedScene generate_scene(const std::string& name, const GenerateOptions& options = {});

}  // namespace diptych::core
