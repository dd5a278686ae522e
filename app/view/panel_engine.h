// What a panel's thread does between looks at its mailbox: one renderer, kept up with the state it is to show.
#pragma once

#include <atomic>
#include <memory>
#include <optional>
#include <string>

#include "render/session.h"
#include "view/frame_budget.h"
#include "view/invalidation.h"
#include "view/panel_worker.h"

namespace diptych::core::app {

/// What a panel renders the state with: the preview's size, its own seed, and what chains of frames need and cannot
/// have.
RenderSettings panel_settings(const RenderSettings& settings, std::uint32_t seed_offset, int divisor);

/// Used by one thread. What goes wrong is in the shots; nothing but record_path and film throws.
class PanelEngine {
public:
    using Publish = std::function<void(std::shared_ptr<const PanelShot>)>;

    PanelEngine(std::string backend, std::uint32_t seed_offset, RendererFactory factory, Publish publish);

    /// Goes on with another renderer, made at once where there was a job.
    void recover(RendererFactory factory);

    /// Brings the renderer to the job's state by the least that this takes.
    void apply(const ViewJob& job);

    bool wants_samples() const {
        return job_ && !job_->paused && session_ && shot_.error.empty() && samples_left() > 0;
    }

    bool has_picture() const { return session_ && applied_ && samples_ > 0; }

    /// Whether the job is one of many that follow one another, and has shown nothing yet.
    bool owes_first_sample() const { return wants_samples() && job_->moving && samples_ == 0; }

    /// One sample of a new picture at rest, else as many as fit a frame, and a shot of them. A cancel leaves the film
    /// for the next job to clear.
    void advance(const std::atomic<bool>& cancel);

    /// When the next samples are due, by now_seconds: at once, but a frame later for what moves, as another job will have
    /// come by then.
    double resumes() const { return resumes_; }

    RecordedPath record_path(shared::PathQuery query, std::uint32_t seed);
    KeptFilm film();

private:
    /// When a costly look at something is next due: at most so often, and for at most such a share of the time.
    struct Pace {
        double interval;  // seconds
        double share;
        double next = 0;

        bool due(double now) const { return now >= next; }
        void spent(double begin, double end);
    };

    template <class Work>
    void guarded(const Work& work);
    void open_scene();
    void begin_picture();
    void learn(std::uint32_t samples, double seconds);
    void publish(bool first);
    void look();
    void say_busy(const std::string& what);
    /// Samples that still have an index.
    std::uint32_t samples_left() const { return ~0U - (session_ ? session_->first_sample() : 0) - samples_; }
    RenderSettings settings() const { return panel_settings(job_->state.request.settings, seed_offset_, divisor_); }

    RendererFactory factory_;
    const std::uint32_t seed_offset_;
    Publish publish_;
    std::optional<ViewJob> job_;
    std::optional<RenderedState> applied_;  // what the renderer shows; none where it shows nothing sound
    std::shared_ptr<const Scene> scene_;    // the session's
    std::optional<Session> session_;
    PanelShot shot_;
    PanelSpeed speed_;
    bool relearns_ = false;  // the speed is that of other settings
    int divisor_ = 1;
    std::uint32_t samples_ = 0;  // of the picture
    double resumes_ = 0;  // in now_seconds
    bool spoiled_ = false;             // some pixels have samples of a chunk that was cut short
    Pace host_films_{1.0 / 30, 0.25};  // of renderers without a film on a device
    Pace looks_{0.25, 0.05};           // at figures
    Pace device_looks_{1, 0.02};
    std::uint64_t looked_rays_ = 0;
    double looked_at_ = 0;
    std::vector<PassTime> passes_before_;
    std::uint32_t passes_from_ = 0;
};

}  // namespace diptych::core::app
