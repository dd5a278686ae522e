// What `converge` is to measure: the methods, how far each goes, and whether a folder's results belong to it.
#pragma once

#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "commands/arguments/arguments.h"
#include "file_lock.h"
#include "measure/converge/plan.h"

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
std::vector<Method> planned_methods(const ConvergeOptions& options);

/// The method that --reference names, where that is no file.
Method planned_reference(const ConvergeOptions& options, const std::vector<Method>& methods);
bool reference_is_file(const ConvergeOptions& options);

/// All that the results depend on, the program and the scene's file included.
nlohmann::ordered_json plan_to_json(const ConvergeOptions& options, const std::vector<Method>& methods);

/// Makes the folder, and plan.json in it; refuses a folder that holds another plan's results, naming the first
/// difference, and one that another process measures into. The folder belongs to this process as long as it keeps the
/// lock. Throws Error.
[[nodiscard]] FileLock claim_folder(const ConvergeOptions& options, const nlohmann::ordered_json& plan);

}  // namespace diptych::core::app
