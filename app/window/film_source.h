// The panels' films on the device of the window.
#pragma once

#include <memory>

#include "device_film.h"
#include "view/frame_loop.h"

namespace diptych::app {

class FilmSource {
public:
    explicit FilmSource(std::shared_ptr<Gpu> gpu) : uploader_(std::move(gpu)) {}

    /// The newest film of a panel, uploaded where it lies on the host; nothing of a panel that is not shown or has none
    /// yet.
    DeviceFilm film_of(const FrameLoop& loop, Panel panel);

private:
    FilmUploader uploader_;
    std::shared_ptr<const Film> uploaded_;
    DeviceFilm on_device_;  // what was uploaded
};

}  // namespace diptych::app
