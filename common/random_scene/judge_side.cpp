#include "random_scene/judge_side.h"

#include <algorithm>

#include "pose/pose.h"

namespace diptych {

namespace {

constexpr int tile = 8;
const std::atomic<bool> never{false};  // cancelled

}  // namespace

RandomSide::RandomSide(const RandomScene& random, const Scene& read, const Renderers::Make& make,
                       const RenderSettings& settings, std::vector<std::uint32_t> frames, std::uint32_t runs,
                       std::uint32_t first_seed)
    : scene_(read), settings_(settings), frames_(std::move(frames)), first_seed_(first_seed),
      runs_(std::max<std::size_t>(frames_.size(), 1), std::vector<RunMeans>(runs)) {
    settings_.moves = random.frames > 0 && chains_frames(settings);
    packed_ = pack_scene(scene_, settings_);  // at rest, so that the origin depends on no frame
    renderer_ = make(scene_, packed_, settings_);
    chained_ = settings_.moves && renderer_->backend() != "oracle";
}

void RandomSide::extend_to(std::uint32_t spp) {
    if (spp <= spp_) {
        return;
    }
    if (chained_) {
        for (std::size_t run = 0; run < runs_[0].size(); ++run) {
            for (std::uint32_t chain = spp_; chain < spp; ++chain) {
                play_chain(run, chain);
            }
        }
    } else {
        for (std::size_t place = 0; place < runs_.size(); ++place) {
            if (!frames_.empty()) {
                show(frames_[place]);
            }
            render_still(place, spp);
        }
    }
    spp_ = spp;
}

void RandomSide::show(std::uint32_t frame) {
    pose_scene(scene_, frame / random_fps);
    pack_moment(scene_, settings_, packed_);
    renderer_->move_to(packed_);
}

void RandomSide::render_still(std::size_t place, std::uint32_t spp) {
    const std::size_t runs = runs_[place].size();
    for (std::size_t run = 0; run < runs; ++run) {
        renderer_->restart(first_seed_ + std::uint32_t(place * runs + run));
        renderer_->render(spp_, spp - spp_, never);
        keep(place, run, spp_, spp - spp_);
    }
}

void RandomSide::play_chain(std::size_t run, std::uint32_t chain) {
    for (std::uint32_t frame = 0, place = 0; place < frames_.size(); ++frame) {
        show(frame);
        if (frame == 0) {
            renderer_->restart(first_seed_ + std::uint32_t(chain * runs_[0].size() + run));
        } else {
            renderer_->clear_film();
        }
        renderer_->render(frame, 1, never);
        if (frame == frames_[place]) {
            keep(place, run, chain, 1);
            ++place;
        }
    }
}

void RandomSide::keep(std::size_t place, std::size_t run, std::uint32_t done, std::uint32_t samples) {
    const Film film = renderer_->film();
    nonfinite_ += film_totals(film).nonfinite;
    const RunMeans means = tile_means(film, tile);
    RunMeans& kept = runs_[place][run];
    kept = done == 0 ? means : merge_means(kept, done, means, samples);
}

}  // namespace diptych
