// What `converge` is to measure: the methods, how far each goes, and whether a folder's results belong to it.
#pragma once

#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "commands/arguments/arguments.h"
#include "file_lock.h"
#include "measure/converge/method.h"
#include "measure/converge/reference.h"

namespace diptych::core::app {

/// The options as typed; see add_converge for what they mean.
struct ConvergeOptions : ConvergeSettings {
    RenderArguments arguments;
    std::vector<std::string> methods{"cpu:brdf", "cpu:direct", "cpu:path"};
    std::string reference = "auto";
    std::string folder;
    int page_side = 512;  // of a picture within the page, at most
    std::uint32_t seed = 1;
    bool json = false;
    std::string on_device_lost = "stop";
    std::string command;  // as typed
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
/// difference, and one that another process measures into. The folder belongs to this process as long as it keeps the
/// lock. Throws Error.
[[nodiscard]] FileLock claim_folder(const ConvergeOptions& options, const nlohmann::ordered_json& plan);

/// The picture that --reference names, of the given size with three channels. Throws Error.
ReferencePicture load_reference(const std::string& path, int width, int height, std::uint64_t memory_limit);

}  // namespace diptych::core::app
