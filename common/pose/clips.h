// Which of a scene's clips play: Channel::plays.
#pragma once

#include <cstddef>
#include <string>

#include "scene/scene.h"
#include "scene/warnings.h"

namespace diptych::core {

/// Lets one clip play, an index into the animations, and forgets the warnings of the others.
void play_clip(Scene& scene, std::size_t clip);

/// Lets all clips play together. Where two of them move the same node, material or light, the earlier clip has it to
/// itself, and gets a warning that says so.
void play_all_clips(Scene& scene);

/// The clip of that very name, else of that index. Throws Error with the clips that there are.
std::size_t find_clip(const Scene& scene, const std::string& name_or_index);

/// The warnings of the clips that play.
Warnings clip_warnings(const Scene& scene);

}  // namespace diptych::core
