#include "window/film_source.h"

namespace diptych::core::app {

DeviceFilm FilmSource::film_of(const FrameLoop& loop, Panel panel) {
    const std::shared_ptr<const PanelShot> shot = loop.shot(panel);
    if (shot == nullptr || !loop.shows(panel)) {
        return {};
    }
    if (shot->device_film != nullptr && shot->device_film->gpu == gpu_) {
        return *shot->device_film;
    }
    if (shot->film == nullptr) {
        return {};
    }
    Upload& upload = uploads_[static_cast<std::size_t>(panel)];
    if (upload.film != shot->film) {
        upload.on_device = upload.uploader.upload(*shot->film);
        upload.film = shot->film;
    }
    return upload.on_device;
}

}  // namespace diptych::core::app
