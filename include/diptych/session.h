// A scene on one backend.
#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <stop_token>
#include <string>
#include <vector>

#include "diptych/film.h"
#include "diptych/scene.h"
#include "diptych/settings.h"

DIPTYCH_BEGIN

/// What a backend can do beside rendering a picture at rest.
struct Capabilities {
    bool temporal_reuse = false;   // restir goes on from moment to moment
    bool settings_change = false;  // set_settings keeps what the settings do not touch, instead of building anew
    bool replay = false;           // paths can be recorded
};

struct Progress {
    std::uint32_t spp = 0;  // done, of every pixel
    double seconds = 0;
    double eta_seconds = 0;  // infinite while unknown
    double samples_per_second = 0;
    double rays_per_second = 0;
    std::optional<double> relmse;  // estimate
};

struct RenderOptions {
    std::function<void(const Progress&)> progress;  // about every quarter of a second, from the thread that renders
    std::stop_token stop;                           // may be set from any thread
    double seconds = 0;                             // stop after so long; 0 is no limit
    double relmse = 0;                              // stop at this estimate, from 16 samples on; 0 is no limit
};

struct RenderResult {
    std::uint32_t spp = 0;  // that every pixel was given by this call
    double seconds = 0;
    bool stopped = false;  // by the token, before the end
};

struct SessionOptions {
    std::function<void(const std::string& line)> warnings;  // what was left out of the scene, once each
};

// The implementation's.
struct SessionData;

/// Used by one thread at a time, and may be moved between threads. Several sessions run at once. After DeviceLost a
/// session can only be destroyed, and after a move only be assigned or destroyed. Other errors leave it usable; where
/// the call had begun to change the picture, the film is empty.
class DIPTYCH_EXPORT Session {
public:
    /// Builds acceleration structures and pipelines. Throws NoDevice; SettingError for settings out of range or options
    /// of another backend; Error where the scene cannot be rendered.
    Session(const Scene& scene, const BackendChoice& backend = {}, const Settings& settings = {},
            const SessionOptions& options = {});
    Session(Session&&) noexcept;
    Session& operator=(Session&&) noexcept;
    ~Session();

    /// Adds the next `count` samples to every pixel: consecutive calls have the bits of one. 0 is no limit, where the
    /// options set one. Edits of the scene since the last call begin another picture first. The film so far stays whole
    /// whatever happens. Throws SettingError where nothing limits the render or the settings keep no standard errors
    /// for `relmse`; Error where an edit is out of range; DeviceLost.
    RenderResult render(std::uint32_t count, const RenderOptions& options = {});

    /// The same with samples first .. first+count-1, for films that are merged later. Throws Error where the film has
    /// samples from `first` on.
    RenderResult render_range(std::uint32_t first, std::uint32_t count, const RenderOptions& options = {});

    /// A copy of what has been rendered.
    Film film() const;

    /// Goes on from a film of this very picture, of this process or of a file: it has those samples from then on, and
    /// the next ones follow them, to the bits of a session that took them all. The panels may differ. Throws Error
    /// where the film is of another picture or seed, has no sums, or where this picture has samples already;
    /// SettingError for restir with temporal reuse, whose samples go on from one another.
    void resume(const Film& film);

    /// Empties the film, with another seed where one is given. What follows has the bits of a new session.
    void restart(std::optional<std::uint32_t> seed = {});

    /// Puts the scene at a moment of its animations, in seconds, or back at rest, and begins another picture. Only what
    /// moves is updated. restir goes on from the picture before. Throws Error where the number is not finite.
    void pose(std::optional<double> seconds);

    /// What the scene is seen through from now on, whatever Settings::camera says; none gives that one back. Begins
    /// another picture. Throws Error where the camera is out of range.
    void set_camera(const std::optional<Camera>& camera);
    /// Begins another picture under other settings. What they do not touch stays. Throws SettingError.
    void set_settings(const Settings& settings);

    const Settings& settings() const;
    Backend backend() const;
    std::string device() const;  // the device's own name
    Capabilities capabilities() const;

private:
    friend struct Impl;
    std::unique_ptr<SessionData> data_;
};

DIPTYCH_END
