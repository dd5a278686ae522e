// What --json says of a picture.
#pragma once

#include <nlohmann/json.hpp>

#include "commands/render/save_picture.h"
#include "render/film_statistics.h"
#include "render/metadata.h"
#include "render/renderer.h"
#include "render/request.h"

namespace diptych::core::app {

nlohmann::ordered_json json_of(const RenderRequest& request, const RenderOutcome& outcome, const SavedPicture& saved,
                               const Renderer& renderer, const Film& film, const FilmTotals& totals,
                               std::uint32_t features);

}  // namespace diptych::core::app
