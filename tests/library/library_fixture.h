// Scenes and films for tests of the public interface.
#pragma once

#include <diptych/diptych.h>

#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "catch.h"

namespace library_tests {

namespace dp = diptych;

inline const std::string source_dir = DIPTYCH_SOURCE_DIR;

/// A white floor and a red wall, and between them and the camera a small lamp that shines on the wall.
dp::Scene small_scene();

/// 24 x 16 pixels, depth 3.
dp::Settings small_settings(dp::Integrator integrator = dp::Integrator::path);

/// Those of the two panels that this machine has.
std::vector<dp::Backend> panels();

/// Whether every array of both films has the same bits.
bool same_bits(const dp::Film& a, const dp::Film& b);

dp::Film rendered(const dp::Scene& scene, dp::Backend backend, const dp::Settings& settings, std::uint32_t spp);

/// What the dp::Error says that the call throws; empty where it throws none.
std::string message_of(const std::function<void()>& call);

/// Goes when it does.
struct Folder {
    Folder();
    ~Folder();
    std::string file(const std::string& name) const { return (path / name).string(); }
    std::filesystem::path path;
};

}  // namespace library_tests
