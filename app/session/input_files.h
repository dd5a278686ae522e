// The files that a command reads, and that it must not write over.
#pragma once

#include <filesystem>
#include <vector>

#include "render/request.h"

namespace diptych::core::app {

/// What a request reads: the scene with its buffers and textures, and the sky where that is a file.
std::vector<std::filesystem::path> input_files(const RenderRequest& request);

/// Throws an Error where one of the files to be written is one of `inputs`. Files are compared as the disk knows them,
/// so links and `./` make no difference.
void refuse_inputs(const std::vector<std::filesystem::path>& written, const std::vector<std::filesystem::path>& inputs);

/// The same for the inputs of a request, which are listed only where a file to be written exists already: listing them
/// reads the scene.
void refuse_inputs(const std::vector<std::filesystem::path>& written, const RenderRequest& request);

}  // namespace diptych::core::app
