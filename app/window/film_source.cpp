#include "window/film_source.h"

namespace diptych::app {

DeviceFilm FilmSource::film_of(const FrameLoop& loop, Panel panel) {
    const std::shared_ptr<const PanelShot> shot = loop.shot(panel);
    if (shot == nullptr || !loop.shows(panel)) {
        return {};
    }
    if (shot->device_film != nullptr) {
        return *shot->device_film;
    }
    if (shot->film == nullptr) {
        return {};
    }
    if (uploaded_ != shot->film) {
        on_device_ = uploader_.upload(*shot->film);
        uploaded_ = shot->film;
    }
    return on_device_;
}

}  // namespace diptych::app
