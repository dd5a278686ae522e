// Command lines that make a picture or a path again.
#pragma once

#include <cstdint>
#include <string>

#include "path/path_record.h"
#include "render/metadata.h"

namespace diptych::core::app {

/// As one word for a shell.
std::string shell_quoted(const std::string& word);

/// The command line that repeats a render of `spp` samples to the bit: every setting that matters, shell-quoted, files
/// as given.
std::string repeat_command(const RenderRequest& request, std::uint32_t spp);

/// The command line that replays one of its paths.
std::string replay_command(const RenderRequest& request, const shared::PathQuery& path);

/// This program, for the metadata of its pictures.
PictureMaker this_program();

}  // namespace diptych::core::app
