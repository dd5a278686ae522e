#include "render/lasting_picture.h"

#include <fmt/format.h>

#include "render/merge_films.h"

namespace diptych::core {

LastingPicture::LastingPicture(Session& session, LossGuard& guard, const std::atomic<bool>& cancel,
                               std::function<void()> begin, std::uint32_t first)
    : session_(session), guard_(guard), cancel_(cancel), begin_(std::move(begin)), first_(first), next_(first),
      end_(first), kept_end_(first), last_device_(session.renderer().device()), devices_(last_device_) {}

void LastingPicture::render(std::uint32_t first, std::uint32_t count, const std::atomic<bool>& cancel) {
    end_ = first + count;
    outlast([&] { render_missing(cancel); });
}

/// Renders what was asked for and is not in the session's film, after a loss more than the last call's samples.
void LastingPicture::render_missing(const std::atomic<bool>& cancel) const {
    if (next_ < end_) {
        session_.render(next_, end_ - next_, cancel);
        next_ = end_;
    }
}

Film LastingPicture::film() const {
    read();
    return kept_;
}

Film LastingPicture::take_film() {
    read();
    return std::move(kept_);
}

void LastingPicture::read() const {
    outlast([&] {
        render_missing(cancel_);
        Film film = session_.film();
        if (base_.pixels.empty()) {
            kept_ = std::move(film);
        } else {
            kept_ = base_;
            merge_films(film, kept_);
        }
        kept_end_ = end_;
    });
}

void LastingPicture::outlast(const std::function<void()>& work) const {
    const double seconds = session_.renderer().device_seconds();
    guard_.run(session_, cancel_, work, [&] {
        lost_seconds_ += seconds;
        go_on_after_loss();
    });
}

void LastingPicture::go_on_after_loss() const {
    const bool chains = chains_frames(session_.settings());
    base_ = chains ? Film() : kept_;
    next_ = chains ? first_ : kept_end_;
    const std::string device = session_.renderer().device();
    if (next_ == first_) {
        devices_ = device;
    } else if (device != last_device_) {
        devices_ += fmt::format("; {} from sample {} on", device, next_);
    }
    last_device_ = device;
    if (chains && begin_) {
        begin_();
    }
}

}  // namespace diptych::core
