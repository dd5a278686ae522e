#include "render/session.h"

#include <algorithm>
#include <utility>

#include "clock.h"
#include "error.h"
#include "pose/pose.h"

namespace diptych::core {

Session::Session(const Scene& scene, const RenderSettings& settings, MakeRenderer make, SessionHooks hooks)
    : source_(&scene), make_(std::move(make)), hooks_(std::move(hooks)), settings_(settings) {
    pack_anew();
    say("building acceleration structures and pipelines");
    renderer_ = make_(scene, *packed_, settings_);
}

Session::Session(const Scene& scene, const RenderSettings& settings, MakeRenderer make, const Moment& moment,
                 SessionHooks hooks)
    : source_(&scene), make_(std::move(make)), hooks_(std::move(hooks)), settings_(settings), moment_(moment),
      own_(std::make_unique<Scene>(scene)) {
    pack_anew();
    say("building acceleration structures and pipelines");
    renderer_ = make_(*own_, *packed_, settings_);
    chained_ = chains_frames(settings_) && renderer_->capabilities().chains;
}

void Session::say(const std::string& what) const {
    if (hooks_.busy) {
        hooks_.busy(what);
    }
}

/// `own_` stands at rest.
void Session::pack_at_rest() {
    if (own_) {
        Moment at_rest = moment_;
        at_rest.seconds.reset();
        put_moment(*source_, at_rest, settings_.camera, *own_);
    }
    auto packed = std::make_unique<PackedScene>(pack_scene(scene(), settings_));
    if (hooks_.warn) {
        hooks_.warn(packed->warnings);
    }
    if (renderer_) {
        // Settings change neither, and a renderer may refer to those that it was made from.
        packed->positions.swap(packed_->positions);
        packed->triangles.swap(packed_->triangles);
    }
    if (moment_.seconds && moves(*source_)) {
        put_moment(*source_, moment_, settings_.camera, *own_);
        pack_moment(*own_, settings_, *packed);
        pack_moment(*own_, settings_, *packed);  // once more: the moment before is this one
    }
    if (renderer_) {
        renderer_->reconfigure(*packed);
    }
    packed_ = std::move(packed);
}

void Session::pack_anew() {
    say("packing the scene");
    const double begin = now_seconds();
    pack_at_rest();
    pack_seconds_ = now_seconds() - begin;
}

Change Session::change_to(const Moment& moment, const RenderSettings& settings) const {
    return change_between(moment_, settings_, moment, settings);
}

void Session::show(const Moment& moment, std::optional<std::uint32_t> seed) {
    const Change change = change_to(moment, settings_);
    if (!own_ || change == Change::settings) {
        throw Error(source_->name + ": this moment wants another pack");
    }
    const bool moved_before = moment_.seconds.has_value();
    moment_ = moment;
    const double begin = now_seconds();
    double packed_at = begin;
    if (change >= Change::view) {
        if (moved_before && !moment.seconds) {
            *own_ = *source_;
        }
        put_moment(*source_, moment, settings_.camera, *own_);
        if (change == Change::view) {
            pack_view(*own_, settings_, *packed_);
        } else {
            pack_moment(*own_, settings_, *packed_);
        }
        packed_at = now_seconds();
        renderer_->move_to(*packed_);
    } else {
        settle();  // a chain's next picture stands where this one does
    }
    const bool goes_on = chained_ && !seed;
    if (goes_on) {
        renderer_->clear_film();
    } else {
        settings_.seed = seed.value_or(settings_.seed);
        renderer_->restart(settings_.seed);
    }
    begin_picture(goes_on);
    unsettled_ = chained_ && settings_.moves;
    pack_seconds_ = packed_at - begin;
    move_seconds_ = now_seconds() - packed_at;
}

void Session::set(const RenderSettings& settings, const Moment& moment) {
    const bool moved_before = moment_.seconds.has_value();
    settings_ = settings;
    moment_ = moment;
    const double begin = now_seconds();
    if (own_ && moved_before && !moment.seconds) {
        *own_ = *source_;
    }
    if (own_) {
        put_moment(*source_, moment_, settings_.camera, *own_);
    }
    if (repack_settings(scene(), settings_, *packed_)) {
        renderer_->reconfigure(*packed_);
    } else {
        say("packing the scene");
        if (own_ && moves(*source_)) {
            *own_ = *source_;
        }
        pack_at_rest();
    }
    pack_seconds_ = now_seconds() - begin;
    chained_ = own_ && chains_frames(settings_) && renderer_->capabilities().chains;
    begin_picture(false);
}

void Session::edit(const Scene& scene) {
    const double begin = now_seconds();
    source_ = &scene;
    if (own_) {
        *own_ = scene;
    }
    pack_at_rest();
    pack_seconds_ = now_seconds() - begin;
    begin_picture(false);
}

void Session::restart(std::uint32_t seed) {
    settle();
    settings_.seed = seed;
    renderer_->restart(seed);
    begin_picture(false);
}

void Session::renew(MakeRenderer make) {
    if (make) {
        make_ = std::move(make);
    }
    say("building acceleration structures and pipelines");
    renderer_.reset();
    renderer_ = make_(scene(), *packed_, settings_);
    renderer_->restart(settings_.seed);  // which the pack may not know
    chained_ = own_ && chains_frames(settings_) && renderer_->capabilities().chains;
    begin_picture(false);
}

void Session::next_picture() {
    renderer_->clear_film();
    begin_picture(true);
}

void Session::begin_picture(bool goes_on) {
    first_ = goes_on ? first_ + done_ : 0;
    done_ = 0;
    unsettled_ = false;
}

/// Has samples look back to this same moment from now on.
void Session::settle() {
    if (std::exchange(unsettled_, false)) {
        pack_view(*own_, settings_, *packed_);  // nothing has moved since
        renderer_->move_to(*packed_);
    }
}

void Session::render(std::uint32_t first, std::uint32_t count, const std::atomic<bool>& cancel) {
    if (unsettled_ && first == 0 && count > 1) {
        render(0, 1, cancel);
        if (cancel) {
            return;
        }
        first = 1;
        count -= 1;
    }
    if (first > 0) {
        settle();
    }
    renderer_->render(first_ + first, count, cancel);
    done_ = std::max(done_, first + count);
}

}  // namespace diptych::core
