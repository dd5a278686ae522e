// What `converge` is to measure: the methods, how far each goes, and whether a folder's results belong to it.
#pragma once

#include <cstdint>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "commands/arguments/arguments.h"
#include "render/seeds.h"

namespace diptych::app {

/// The options as typed; see add_converge for what they mean.
struct ConvergeOptions {
    RenderArguments arguments;
    std::vector<std::string> methods{"cpu:brdf", "cpu:direct", "cpu:path"};
    std::string reference = "auto";
    std::string folder;
    std::uint32_t runs = 16;
    std::uint32_t spp_max = 256;
    double seconds = 0;          // 0: spp_max is the limit
    double picture_seconds = 0;  // 0: as long as the fastest method's whole run
    double target_relmse = 0;    // 0: what every method reaches
    int page_side = 512;         // of a picture within the page, at most
    std::uint32_t seed = 1;
    bool json = false;
    std::string command;  // as typed
};

/// Blocks of a reference that `converge` renders itself: each has a seed of its own and as many samples as the longest
/// run of any method, so their mean has 16 times as many, and their spread says how far it is off, whatever the
/// sampler.
inline constexpr std::uint32_t reference_blocks = 16;

/// One way of rendering the scene.
struct Method {
    std::string name;       // BACKEND:INTEGRATOR or BACKEND:INTEGRATOR:SAMPLER, as asked for
    RenderRequest request;  // with the seed of run 0
    SeedPlan seeds;
    std::uint32_t place = 0;         // among the sides of `seeds`
    std::uint32_t picture_seed = 0;  // of its picture, which is no run

    /// Of a run, or of a block of a reference. All counts of samples of a run share it: they are one unit of the
    /// statistics.
    std::uint32_t seed_of(std::uint32_t run) const { return seeds.seed(place, run); }

    bool chained() const { return request.backend != "oracle" && request.settings.integrator == Integrator::restir; }
    bool laid_out() const { return request.backend != "oracle" && request.settings.sampler == SamplerKind::hammersley; }
};

/// Options that contradict one another are refused; names become settings. Throws Error.
void check_converge_options(ConvergeOptions& options);

/// Throws Error for a method that does not exist or is named twice. Needs the scene prepared, for size and camera.
std::vector<Method> plan_methods(const ConvergeOptions& options);

/// What --reference names, where that is no file; `auto` is `path` on a backend for which it is not among the methods,
/// else `path` with the other MIS weights. Always over scrambled Sobol' sets, with seeds of its own.
Method plan_reference(const ConvergeOptions& options, const std::vector<Method>& methods);
bool reference_is_file(const ConvergeOptions& options);

/// All that the results depend on, the program and the scene's file included.
nlohmann::ordered_json plan_to_json(const ConvergeOptions& options, const std::vector<Method>& methods);

/// Makes the folder, and plan.json in it; refuses a folder that holds another plan's results, naming the first
/// difference. Throws Error.
void claim_folder(const ConvergeOptions& options, const nlohmann::ordered_json& plan);

/// ':' and '/' become '-'.
std::string file_stem(const std::string& method);

}  // namespace diptych::app
