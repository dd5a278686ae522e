// One panel at work: a thread that owns a Renderer, takes the newest job, does the least that it asks for, and
// publishes what has grown.
#pragma once

#include <condition_variable>
#include <functional>
#include <future>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <thread>
#include <vector>

#include "pack/packed_scene.h"
#include "render/film_statistics.h"
#include "render/metadata.h"
#include "render/renderer.h"
#include "view/view_state.h"

namespace diptych::core {
struct DeviceFilm;  // vk_backend/renderer/device_film.h
}

namespace diptych::core::app {

class PanelEngine;

/// What a film as a whole says.
struct FilmFigures {
    std::uint64_t version = 0;  // of the job whose film was looked at
    std::uint32_t spp = 0;
    int width = 0;
    int height = 0;
    Rgb mean{};                         // radiance, of the image
    std::optional<Rgb> standard_error;  // of that mean; none where no moments are kept
    std::optional<double> relmse;       // estimated, likewise
    std::uint64_t nonfinite = 0;
    std::uint64_t rays = 0;
};

/// What a panel has to show; does not change once published. `film` and `device_film` stay as the last that there was
/// while errors last.
struct PanelShot {
    std::uint64_t version = 0;  // of the job that it shows; 0 before the first
    RenderedState state;        // of that job
    int width = 0;              // of the film, pixels: smaller than the state's in previews
    int height = 0;
    int divisor = 1;  // by which
    std::uint32_t spp = 0;
    bool correlated = false;           // a chain's: samples depend on one another, so that no standard error is known
    std::shared_ptr<const Film> film;  // on the host; of Vulkan only as often as it was looked at: figures say of when
    std::shared_ptr<const DeviceFilm> device_film;  // Vulkan's, else null
    FilmFigures figures;                            // of `film`
    double samples_per_second = 0;                  // over all pixels
    double rays_per_second = 0;
    double frame_milliseconds = 0;  // of the last samples taken in one go
    std::vector<PassTime> passes;   // seconds a sample, as of late
    RendererCosts costs;
    std::string backend;       // "cpu", "vulkan"
    std::string device;        // the device's own name
    std::string busy;          // "building acceleration structures", "compiling pipelines"; empty while sampling
    std::string error;         // one line; the panel stands still until another job or a recovery
    bool device_lost = false;  // the error asks for recover()
};

/// A film with what its file is to say of itself.
struct KeptFilm {
    Film film;
    RenderRequest request;  // repeats it, viewpoint included
    Camera camera;          // the same viewpoint
    RenderOutcome outcome;
};

/// Makes the renderer of a scene; runs on the worker's thread. The pack outlives what it returns; the scene may not.
using RendererFactory = std::function<std::unique_ptr<Renderer>(const PackedScene& packed)>;

class PanelWorker {
public:
    /// `seed_offset` is added to every job's seed, so that two panels that are compared draw apart.
    PanelWorker(std::string backend, RendererFactory factory, std::uint32_t seed_offset = 0);
    /// Cuts short what it does, and waits for that.
    ~PanelWorker();
    PanelWorker(const PanelWorker&) = delete;
    PanelWorker& operator=(const PanelWorker&) = delete;

    /// Takes the place of a job that still waits. One that is being rendered is cut short, a moving one not before its
    /// first whole sample.
    void post(ViewJob job);

    /// The latest; never null.
    std::shared_ptr<const PanelShot> shot() const;

    /// Called on the worker's thread after every shot, say to wake who waits for it. Set before the first job.
    void on_shot(std::function<void()> hook);

    /// Between two samples; the film stays as it is. Pixels count in the full picture: of a preview it is the one that
    /// covers them. The futures throw Error where there is no renderer, or it keeps no record.
    std::future<RecordedPath> record_path(const shared::PathQuery& query, std::uint32_t seed);
    /// The film as it is; of the newest job, once it has a sample. Error where none is coming.
    std::future<KeptFilm> film();

    /// Goes on with a renderer made anew by this factory, after a lost device; the last film is shown until there is
    /// another, and no shot says any more that the device was lost.
    void recover(RendererFactory factory);

    std::uint32_t seed_offset() const { return seed_offset_; }

private:
    void run(RendererFactory factory);
    /// What the engine is asked; false where it can answer only after its next sample. Null: there is no engine any
    /// more.
    using Question = std::function<bool(PanelEngine*)>;
    void request(Question question);

    const std::string backend_;
    const std::uint32_t seed_offset_;
    mutable std::mutex mutex_;
    std::condition_variable wake_;
    std::optional<ViewJob> waiting_;
    std::optional<RenderedState> taken_;  // of the job at hand
    std::vector<Question> requests_;
    std::optional<RendererFactory> factory_;  // for the thread to take
    std::function<void()> hook_;
    std::shared_ptr<const PanelShot> shot_ = std::make_shared<PanelShot>();
    std::atomic<bool> cancel_ = false;
    bool may_cancel_ = false;  // the job at hand has shown what it must
    bool stop_ = false;
    std::thread thread_;
};

}  // namespace diptych::core::app
