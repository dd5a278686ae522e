#include "random_scene/judge_side.h"

#include <algorithm>

namespace diptych::core {

namespace {

constexpr int tile = 8;
const std::atomic<bool> never{false};  // cancelled

Moment moment_of(std::uint32_t frame) {
    Moment moment;
    moment.seconds = frame / random_fps;
    return moment;
}

}  // namespace

RandomSide::RandomSide(const RandomScene& random, const Scene& read, const MakeRenderer& make,
                       const RenderSettings& settings, std::vector<std::uint32_t> frames, std::uint32_t runs,
                       std::uint32_t first_seed)
    : frames_(std::move(frames)), first_seed_(first_seed),
      runs_(std::max<std::size_t>(frames_.size(), 1), std::vector<RunMeans>(runs)) {
    RenderSettings asked = settings;
    asked.moves = random.frames > 0 && chains_frames(settings);
    session_ = frames_.empty() ? std::make_unique<Session>(read, asked, make)
                               : std::make_unique<Session>(read, asked, make, Moment());
}

void RandomSide::extend_to(std::uint32_t spp) {
    if (spp <= spp_) {
        return;
    }
    if (session_->chained()) {
        for (std::size_t run = 0; run < runs_[0].size(); ++run) {
            for (std::uint32_t chain = spp_; chain < spp; ++chain) {
                play_chain(run, chain);
            }
        }
    } else {
        for (std::size_t place = 0; place < runs_.size(); ++place) {
            if (!frames_.empty()) {
                session_->show(moment_of(frames_[place]));
            }
            render_still(place, spp);
        }
    }
    spp_ = spp;
}

void RandomSide::render_still(std::size_t place, std::uint32_t spp) {
    const std::size_t runs = runs_[place].size();
    for (std::size_t run = 0; run < runs; ++run) {
        session_->restart(first_seed_ + std::uint32_t(place * runs + run));
        session_->render(spp_, spp - spp_, never);
        keep(place, run, spp_, spp - spp_);
    }
}

void RandomSide::play_chain(std::size_t run, std::uint32_t chain) {
    for (std::uint32_t frame = 0, place = 0; place < frames_.size(); ++frame) {
        const std::uint32_t seed = first_seed_ + std::uint32_t(chain * runs_[0].size() + run);
        session_->show(moment_of(frame), frame == 0 ? std::optional(seed) : std::nullopt);
        session_->render(0, 1, never);
        if (frame == frames_[place]) {
            keep(place, run, chain, 1);
            ++place;
        }
    }
}

void RandomSide::keep(std::size_t place, std::size_t run, std::uint32_t done, std::uint32_t samples) {
    const Film film = session_->film();
    nonfinite_ += film_totals(film).nonfinite;
    add_to_run(film, tile, done, samples, runs_[place][run]);
}

}  // namespace diptych::core
