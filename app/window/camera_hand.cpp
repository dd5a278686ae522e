#include "window/camera_hand.h"

#include <algorithm>
#include <cmath>
#include <glm/gtc/constants.hpp>

#include "render/film_statistics.h"
#include "view/camera_control.h"
#include "view/panel_worker.h"

namespace diptych::core::app {

namespace {

constexpr double click_reach = 4;                  // pixels
constexpr double wheel_rest = 0.15;                // seconds after which the wheel is taken to be at rest
constexpr double wheel_step = 0.88;                // of the distance, a notch
constexpr double longest_step = 0.1;               // seconds: a frame that took longer does not fling the camera away
constexpr double window_turn = glm::pi<double>();  // radians of a drag across the whole height

double diagonal_of(const LoadedScene& scene) {
    return is_empty(scene.bounds) ? 1 : std::max(glm::length(scene.bounds.hi - scene.bounds.lo), 1e-9);
}

}  // namespace

void CameraHand::follow_presses(const HandInput& input) {
    for (const MousePress& press : input.window->presses) {
        if (press.down && !drag_ && input.mouse_is_free) {
            drag_ =
                Drag{.button = press.button,
                     .pans = press.button == MouseButton::middle || (press.button == MouseButton::left && press.shift),
                     .start = press.at,
                     .last = press.at};
        } else if (!press.down && drag_ && drag_->button == press.button) {
            if (!drag_->moved && press.button == MouseButton::left &&
                glm::length(press.at - drag_->start) < click_reach) {
                click_ = Click{press.at};
            }
            released_at_ = press.at;
        }
    }
}

void CameraHand::drag_to(const glm::dvec2& at, const glm::dvec2& size, const LoadedScene& scene, ViewState& state) {
    drag_->moved = drag_->moved || glm::length(at - drag_->start) >= click_reach;
    if (!drag_->moved || at == drag_->last) {
        return;
    }
    Camera& camera = state.rendered.camera;
    const glm::dvec2 turn = (at - drag_->last) / size.y * window_turn;
    if (drag_->pans) {
        pan(camera, drag_->last / size, at / size, size.x / size.y,
            depth_of(camera, state.pivot, diagonal_of(scene) * 1e-3));
    } else if (drag_->button == MouseButton::left) {
        orbit(camera, state.pivot, -turn.x, turn.y);
    } else {
        look(camera, turn.x, turn.y);
    }
    drag_->last = at;
    state.follows_camera = false;
}

void CameraHand::update(const HandInput& input, const LoadedScene& scene, ViewState& state) {
    const glm::dvec2 size{std::max(input.window->width, 1), std::max(input.window->height, 1)};
    click_.reset();
    released_at_.reset();
    follow_presses(input);
    if (drag_) {
        drag_to(released_at_.value_or(input.window->cursor), size, scene, state);
    }
    Camera& camera = state.rendered.camera;
    still_ += input.seconds;
    if (input.window->scroll != 0 && input.mouse_is_free) {
        dolly(camera, state.pivot, std::pow(wheel_step, input.window->scroll), diagonal_of(scene));
        state.follows_camera = false;
        still_ = 0;
    }
    const bool flies = input.keys_are_free && input.steps != glm::dvec3(0);
    if (flies) {
        const double step =
            fly_speed(diagonal_of(scene)) * std::min(input.seconds, longest_step) * (input.fast ? 4 : 1);
        const glm::dvec3 before(camera.camera_to_world[3]);
        fly(camera, input.steps * step);
        state.pivot += glm::dvec3(camera.camera_to_world[3]) - before;
        state.follows_camera = false;
    }
    moving_ = (drag_ && drag_->moved && !released_at_) || flies || still_ < wheel_rest;
    if (released_at_) {
        drag_.reset();
    }
}

bool focus_at(const glm::dvec2& point, const KeptFilm& picture, ViewState& state) {
    const Film& film = picture.film;
    if (film.first_hits.empty()) {
        return false;
    }
    const int x = std::clamp(static_cast<int>(point.x * film.width), 0, film.width - 1);
    const int y = std::clamp(static_cast<int>(point.y * film.height), 0, film.height - 1);
    const std::size_t pixel =
        static_cast<std::size_t>(y) * static_cast<std::size_t>(film.width) + static_cast<std::size_t>(x);
    const double depth = mean_first_hit(film.pixels[pixel], film.first_hits[pixel]).depth;
    if (!(depth > 0) || !std::isfinite(depth)) {
        return false;
    }
    const double aspect = static_cast<double>(film.width) / film.height;
    const glm::dvec3 seen = point_seen(picture.camera, point, aspect, depth);
    if (!focus_on(state.rendered.camera, seen)) {
        return false;
    }
    state.pivot = seen;
    state.follows_camera = false;
    return true;
}

}  // namespace diptych::core::app
