// The panels' films on the device of the window.
#pragma once

#include <array>
#include <memory>

#include "renderer/device_film.h"
#include "view/frame_loop.h"

namespace diptych::core::app {

class FilmSource {
public:
    explicit FilmSource(std::shared_ptr<Gpu> gpu) : gpu_(std::move(gpu)), uploads_{Upload(gpu_), Upload(gpu_)} {}

    /// The newest film of a panel, uploaded where it lies on the host, or on a device that was lost; nothing of a panel
    /// that is not shown or has none yet.
    DeviceFilm film_of(const FrameLoop& loop, Panel panel);

private:
    /// Of one panel: two that are shown side by side are in memory of their own.
    struct Upload {
        explicit Upload(std::shared_ptr<Gpu> gpu) : uploader(std::move(gpu)) {}

        FilmUploader uploader;
        std::shared_ptr<const Film> film;
        DeviceFilm on_device;
    };

    std::shared_ptr<Gpu> gpu_;
    std::array<Upload, 2> uploads_;
};

}  // namespace diptych::core::app
