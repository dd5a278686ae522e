// The renders that `verify` compares: every side renders its runs, each with a seed of its own.
#pragma once

#include <atomic>
#include <functional>
#include <memory>
#include <optional>
#include <vector>

#include "render/device_loss.h"
#include "render/film_tiles.h"
#include "render/frames.h"
#include "render/seeds.h"
#include "render/session.h"
#include "measure/open_session.h"
#include "measure/verify_settings.h"

namespace diptych::core {

/// What is rendered, and on what.
struct VerifySubject {
    const Scene& scene;  // at rest
    RenderRequest request;  // its settings and sequence, device and threads
    OpenSession open;
    DeviceLossPolicy device_loss = {};  // a run whose device is lost is rendered again
};

/// Called before each run of a side, from the thread that renders it.
using RunHook = std::function<void(const SideName& side, std::uint32_t run)>;

class VerifySide {
public:
    /// Run k has the seeds of run k of the given side of `seeds`: one for each chain that it plays, or for each frame
    /// judged. `frames` are those of a sequence to be judged, in rising order; none: the scene at rest. `sample_count`
    /// is what a Hammersley set is laid out for. The subject's scene must live as long. Throws NoDevice and Error.
    VerifySide(const SideName& name, const VerifySubject& subject, const VerifySettings& settings,
               const std::vector<std::uint32_t>& frames, const SeedPlan& seeds, std::uint32_t side,
               std::uint32_t sample_count);

    /// Adds so many samples a pixel to every run of every frame; false, and as it was before, where `cancel` came in
    /// between. A run of restir's plays chains anew from frame 0, of frame_spp samples a frame and seeds of their own,
    /// until the frames judged have their samples. Throws Error before that where there are not enough seeds, and
    /// DeviceLost as the subject has it.
    bool extend(std::uint32_t samples, const std::atomic<bool>& cancel, const RunHook& hook);

    const SideName& name() const { return name_; }
    const std::vector<RunMeans>& runs(std::optional<std::uint32_t> frame) const;
    std::uint32_t spp() const { return spp_; }
    /// Samples a pixel that there are seeds for.
    std::uint64_t most_spp() const;
    /// Of the first run of that frame; of its first chain.
    std::uint32_t first_seed(std::optional<std::uint32_t> frame) const;
    std::uint64_t nonfinite() const { return nonfinite_; }  // samples dropped, over all runs
    std::string device() const { return session_->renderer().device(); }

private:
    void render_runs(std::size_t frame, std::uint32_t samples, const std::atomic<bool>& cancel, const RunHook& hook);
    void play_chain(std::uint32_t run, std::uint32_t done, const std::atomic<bool>& cancel);
    std::size_t place_of(std::optional<std::uint32_t> frame) const;
    void keep(std::size_t frame, std::uint32_t run, std::uint32_t done, std::uint32_t samples);

    SideName name_;
    int tile_;
    SeedPlan seeds_;
    std::uint32_t side_;
    std::uint32_t run_count_;
    std::uint32_t frame_spp_;
    std::vector<std::uint32_t> frames_;
    std::optional<FrameMoments> moments_;  // of a sequence
    std::unique_ptr<Session> session_;
    LossGuard guard_;
    std::vector<std::vector<RunMeans>> runs_;  // of each frame judged; one at rest
    std::uint32_t spp_ = 0;
    std::uint64_t nonfinite_ = 0;
};

}  // namespace diptych::core
