// A scene on one backend, kept up with the moment and the settings that it is to show. Everything that renders goes
// through a session.
#pragma once

#include <atomic>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "pack/packed_scene.h"
#include "render/moment.h"
#include "render/renderer.h"

namespace diptych::core {

/// Makes a backend's renderer of a scene and of its pack under these settings; both outlive it.
using MakeRenderer =
    std::function<std::unique_ptr<Renderer>(const Scene& scene, const PackedScene& packed, const RenderSettings&)>;

struct SessionHooks {
    BusyHook busy = {};
    std::function<void(const std::vector<std::string>& lines)> warn;  // of each pack: what was left out
};

/// Used by one thread at a time. A scene is packed at rest first, so that origin and radius depend on no moment. A session
/// of which a member has thrown can only be destroyed, or renewed after DeviceLost.
class Session {
public:
    /// A session at rest, for a scene that stays as it is: nothing of it is copied. `scene` must live as long.
    Session(const Scene& scene, const RenderSettings& settings, MakeRenderer make, SessionHooks hooks = {});

    /// A session that may be shown other moments, `moment` first; it keeps a copy of the scene. Where frames go on from
    /// one another (chains_frames), settings.moves says whether any of them is to look back to the one before.
    Session(const Scene& scene, const RenderSettings& settings, MakeRenderer make, const Moment& moment,
            SessionHooks hooks = {});

    Session(Session&&) = default;
    Session& operator=(Session&&) = delete;  // the renderer may still read what would be overwritten
    ~Session() = default;

    Renderer& renderer() { return *renderer_; }
    const Renderer& renderer() const { return *renderer_; }
    const PackedScene& packed() const { return *packed_; }
    const Scene& scene() const { return own_ ? *own_ : *source_; }  // as it stands
    const RenderSettings& settings() const { return settings_; }
    double pack_seconds() const { return pack_seconds_; }  // of the last pack or moment
    double move_seconds() const { return move_seconds_; }  // of the renderer, to the last moment

    /// Whether each moment that is shown goes on from the one before, as restir's do.
    bool chained() const { return chained_; }

    /// What show and set would have to do.
    Change change_to(const Moment& moment, const RenderSettings& settings) const;

    /// Begins a picture of another moment, by the least that it takes: with that seed, or going on with the chain's
    /// samples or the settings' seed. Throws Error where the moment asks for other lights or another kind of camera:
    /// those are set's.
    void show(const Moment& moment, std::optional<std::uint32_t> seed = {});

    /// Begins a picture under other settings, history gone; the scene stays, and what does not depend on them with it.
    void set(const RenderSettings& settings, const Moment& moment);

    /// Begins a picture of an edited copy of the scene, which must live as long: the same but for lights, cameras, the
    /// environment, and of materials all that editable_in_place allows.
    void edit(const Scene& scene);

    /// Begins a picture with another seed, history gone.
    void restart(std::uint32_t seed);

    /// Makes the renderer anew, by `make` from now on if it is given, at the same moment, with the same settings and
    /// seed. A picture begins, history gone.
    void renew(MakeRenderer make = {});

    /// Begins the next picture of a chain at the same moment.
    void next_picture();

    /// Adds samples first .. first+count-1 of the picture to every pixel. Of a chain only the first looks back to the
    /// moment before. See Renderer::render for what `cancel` leaves.
    void render(std::uint32_t first, std::uint32_t count, const std::atomic<bool>& cancel);

    /// Whether the picture's next sample looks back to the moment before, as those after it will not.
    bool looks_back() const { return unsettled_; }

    /// Index of the picture's first sample among those of its chain.
    std::uint32_t first_sample() const { return first_; }

    Film film() const { return renderer_->film(); }

private:
    void pack_at_rest();
    void pack_anew();
    void begin_picture(bool goes_on);
    void settle();
    void say(const std::string& what) const;

    const Scene* source_;  // at rest
    MakeRenderer make_;
    SessionHooks hooks_;
    RenderSettings settings_;
    Moment moment_;
    std::unique_ptr<Scene> own_;  // at the moment; none where nothing changes
    std::unique_ptr<PackedScene> packed_;
    std::unique_ptr<Renderer> renderer_;
    bool chained_ = false;
    bool unsettled_ = false;  // the picture's samples but the first are to look back to this same moment
    std::uint32_t first_ = 0;
    std::uint32_t done_ = 0;  // samples of the picture
    double pack_seconds_ = 0;
    double move_seconds_ = 0;
};

/// Whether a renderer of one scene can go on with the other: the same meshes and instances, and the same triangles with
/// alpha. `edited` is a copy of `scene`, whose meshes are not compared.
bool editable_in_place(const Scene& scene, const Scene& edited);

}  // namespace diptych::core
