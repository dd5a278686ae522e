#include "measure/verify_sides.h"

#include <algorithm>
#include <limits>


namespace diptych::core {

VerifySide::VerifySide(const SideName& name, const VerifySubject& subject, const VerifySettings& settings,
                       const std::vector<std::uint32_t>& frames, const SeedPlan& seeds, std::uint32_t side,
                       std::uint32_t sample_count)
    : name_(name), tile_(settings.tile), seeds_(seeds), side_(side), run_count_(settings.runs),
      frame_spp_(settings.frame_spp), frames_(frames), guard_(subject.device_loss),
      runs_(std::max<std::size_t>(frames.size(), 1), std::vector<RunMeans>(settings.runs)) {
    RenderRequest request = subject.request;
    request.backend = name.backend;
    request.settings.integrator = name.integrator;
    request.oracle_mode = name.oracle_mode;
    request.settings.seed = seeds_.seed(side_, 0);
    request.settings.sample_count = sample_count;
    if (name.backend == "vulkan") {
        request.threads = 0;
    } else {
        request.device.clear();
        request.validation = false;
    }
    if (!frames.empty()) {
        moments_.emplace(subject.scene, request);
    }
    session_ = std::make_unique<Session>(
        guard_.open([&](const MakeRenderer&) { return subject.open(subject.scene, request, moments_.has_value()); }));
}

std::size_t VerifySide::place_of(std::optional<std::uint32_t> frame) const {
    return frame ? static_cast<std::size_t>(std::find(frames_.begin(), frames_.end(), *frame) - frames_.begin()) : 0;
}

const std::vector<RunMeans>& VerifySide::runs(std::optional<std::uint32_t> frame) const {
    return runs_[place_of(frame)];
}

std::uint64_t VerifySide::most_spp() const {
    return session_->chained() ? seeds_.parts() * frame_spp_ : std::numeric_limits<std::uint64_t>::max();
}

std::uint32_t VerifySide::first_seed(std::optional<std::uint32_t> frame) const {
    return seeds_.seed(side_, 0, session_->chained() ? 0 : place_of(frame));
}

bool VerifySide::extend(std::uint32_t samples, const std::atomic<bool>& cancel, const RunHook& hook) {
    const std::vector<std::vector<RunMeans>> runs_before = runs_;
    const std::uint64_t nonfinite_before = nonfinite_;
    if (session_->chained()) {
        seeds_.seed(side_, 0, (spp_ + samples - 1) / frame_spp_);
        for (std::uint32_t run = 0; run < run_count_ && !cancel; ++run) {
            hook(name_, run);
            for (std::uint32_t done = spp_; done < spp_ + samples && !cancel; done += frame_spp_) {
                play_chain(run, done, cancel);
            }
        }
    } else if (frames_.empty()) {
        render_runs(0, samples, cancel, hook);
    } else {
        for (std::size_t i = 0; i < frames_.size() && !cancel; ++i) {
            guard_.run(*session_, cancel, [&] { session_->show(moments_->at(frames_[i]), seeds_.seed(side_, 0, i)); });
            render_runs(i, samples, cancel, hook);
        }
    }
    if (cancel) {
        runs_ = runs_before;
        nonfinite_ = nonfinite_before;
        return false;
    }
    spp_ += samples;
    return true;
}

void VerifySide::render_runs(std::size_t frame, std::uint32_t samples, const std::atomic<bool>& cancel,
                             const RunHook& hook) {
    for (std::uint32_t run = 0; run < run_count_ && !cancel; ++run) {
        hook(name_, run);
        guard_.run(*session_, cancel, [&] {
            session_->restart(seeds_.seed(side_, run, frame));
            session_->render(spp_, samples, cancel);
            keep(frame, run, spp_, samples);
        });
    }
}

void VerifySide::play_chain(std::uint32_t run, std::uint32_t done, const std::atomic<bool>& cancel) {
    const std::uint32_t seed = seeds_.seed(side_, run, done / frame_spp_);
    std::size_t kept = 0;  // of the frames judged, which a chain that begins anew after a loss meets again
    guard_.run(*session_, cancel, [&] {
        for (std::uint32_t frame = 0, judged = 0; judged < frames_.size() && !cancel; ++frame) {
            session_->show(moments_->at(frame), frame == 0 ? std::optional(seed) : std::nullopt);
            session_->render(0, frame_spp_, cancel);
            if (frame == frames_[judged] && ++judged > kept) {
                keep(kept, run, done, frame_spp_);
                ++kept;
            }
        }
    });
}

void VerifySide::keep(std::size_t frame, std::uint32_t run, std::uint32_t done, std::uint32_t samples) {
    const Film film = session_->film();
    nonfinite_ += film_totals(film).nonfinite;
    add_to_run(film, tile_, done, samples, runs_[frame][run]);
}

}  // namespace diptych::core
