// Opens scenes while the present one goes on being shown, and opens them again when their files change.
#pragma once

#include <condition_variable>
#include <filesystem>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <thread>
#include <vector>

#include "render/request.h"
#include "scene/default_camera.h"
#include "scene/scene.h"

namespace diptych::core::app {

/// When a file was last written; nothing where it is missing.
using FileStamp = std::optional<std::filesystem::file_time_type>;

/// A scene as loaded: with the request's environment, but neither its scale, rotation and sun, nor its viewpoint.
struct LoadedScene {
    std::uint64_t generation = 0;  // RenderedState::scene
    std::shared_ptr<const Scene> scene;
    RenderRequest request;  // that it was asked for with; settings.camera is an index into the scene's
    Bounds bounds;          // at rest
    std::vector<std::filesystem::path> files;  // that it is made of
    std::vector<FileStamp> stamps;             // of these, just before they were read
    bool reloaded = false;                     // a file changed, or the sky: camera and settings stay
};

/// Loads on the calling thread. Throws Error.
LoadedScene load_scene(const RenderRequest& request, std::uint64_t generation);

class SceneLoader {
public:
    SceneLoader();
    ~SceneLoader();
    SceneLoader(const SceneLoader&) = delete;
    SceneLoader& operator=(const SceneLoader&) = delete;

    /// Loads the request's scene and environment in the background; takes the place of a request that still waits.
    /// `reloads`: the scene that is shown, under another sky.
    void open(RenderRequest request, bool reloads = false);

    /// Watches these files, four times a second, and opens the request again once they have changed and then held still
    /// for one look. A scene that loads ends this: the files may be of one that is gone.
    void watch(const LoadedScene& loaded);

    /// What has come of it since the last call: a scene, or else an error line. Neither while nothing is done.
    std::optional<LoadedScene> take_scene();
    std::optional<std::string> take_error();

    /// The file being loaded; empty when idle.
    std::string loading() const;

private:
    void run();
    bool files_changed(std::unique_lock<std::mutex>& lock);

    mutable std::mutex mutex_;
    std::condition_variable wake_;
    std::optional<RenderRequest> wanted_;
    bool reload_ = false;
    std::optional<LoadedScene> loaded_;
    std::optional<std::string> error_;
    std::string loading_;
    RenderRequest watched_request_;
    std::vector<std::filesystem::path> watched_;
    std::vector<FileStamp> stamps_;    // as loaded
    std::vector<FileStamp> changing_;  // as of the last look, while they change
    std::uint64_t watches_ = 0;        // rises with each watch()
    std::uint64_t generation_ = 1;
    bool stop_ = false;
    std::thread thread_;
};

}  // namespace diptych::core::app
