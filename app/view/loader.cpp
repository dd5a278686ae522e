#include "view/loader.h"

#include <algorithm>
#include <chrono>
#include <utility>

#include "error.h"
#include "console/option_names.h"
#include "one_line.h"
#include "session/input_files.h"
#include "session/scene_setup.h"

namespace diptych::core::app {

namespace {

constexpr auto between_looks = std::chrono::milliseconds(250);

std::vector<FileStamp> stamps_of(const std::vector<std::filesystem::path>& files) {
    std::vector<FileStamp> stamps;
    for (const std::filesystem::path& file : files) {
        std::error_code missing;
        const std::filesystem::file_time_type time = std::filesystem::last_write_time(file, missing);
        stamps.push_back(missing ? FileStamp{} : FileStamp(time));
    }
    return stamps;
}

}  // namespace

LoadedScene load_scene(const RenderRequest& request, std::uint64_t generation) {
    LoadedScene loaded;
    loaded.generation = generation;
    loaded.request = request;
    // Before it is read: what changes meanwhile is read again.
    loaded.files = input_files(request);
    loaded.stamps = stamps_of(loaded.files);
    auto scene = std::make_shared<Scene>(load_requested(loaded.request));
    loaded.bounds = scene_bounds(*scene);
    loaded.scene = std::move(scene);
    return loaded;
}

SceneLoader::SceneLoader() : thread_([this] { run(); }) {}

SceneLoader::~SceneLoader() {
    {
        const std::lock_guard lock(mutex_);
        stop_ = true;
    }
    wake_.notify_one();
    thread_.join();
}

void SceneLoader::open(RenderRequest request, bool reloads) {
    {
        const std::lock_guard lock(mutex_);
        loading_ = request.scene;
        wanted_ = std::move(request);
        reload_ = reloads;
    }
    wake_.notify_one();
}

void SceneLoader::watch(const LoadedScene& loaded) {
    const std::lock_guard lock(mutex_);
    watched_request_ = loaded.request;
    watched_ = loaded.files;
    stamps_ = loaded.stamps;
    changing_.clear();
    ++watches_;
    generation_ = std::max(generation_, loaded.generation);
}

std::optional<LoadedScene> SceneLoader::take_scene() {
    const std::lock_guard lock(mutex_);
    return std::exchange(loaded_, {});
}

std::optional<std::string> SceneLoader::take_error() {
    const std::lock_guard lock(mutex_);
    return std::exchange(error_, {});
}

std::string SceneLoader::loading() const {
    const std::lock_guard lock(mutex_);
    return loading_;
}

/// Looks without the lock: a file on a slow disk keeps nobody waiting.
bool SceneLoader::files_changed(std::unique_lock<std::mutex>& lock) {
    const std::vector<std::filesystem::path> files = watched_;
    const std::uint64_t watch = watches_;
    lock.unlock();
    std::vector<FileStamp> now = stamps_of(files);
    lock.lock();
    if (wanted_ || watch != watches_) {
        return false;  // of what is shown no more
    }
    if (now == stamps_) {
        changing_.clear();
        return false;
    }
    if (now != changing_) {
        changing_ = std::move(now);
        return false;
    }
    stamps_ = now;  // what fails to load is not tried again before it changes again
    changing_.clear();
    return true;
}

void SceneLoader::run() {
    std::unique_lock lock(mutex_);
    while (!stop_) {
        wake_.wait_for(lock, between_looks, [&] { return stop_ || wanted_; });
        if (!stop_ && !wanted_ && files_changed(lock)) {
            wanted_ = watched_request_;
            reload_ = true;
        }
        if (stop_ || !wanted_) {
            continue;
        }
        const RenderRequest request = *std::exchange(wanted_, {});
        const bool reload = reload_;
        const std::uint64_t generation = ++generation_;
        loading_ = request.scene;
        lock.unlock();
        std::optional<LoadedScene> loaded;
        std::string error;
        try {
            loaded = load_scene(request, generation);
            loaded->reloaded = reload;
        } catch (const std::exception& failure) {
            error = one_line(with_option_names(failure.what()));
        }
        lock.lock();
        if (!wanted_) {
            loading_.clear();
        }
        if (loaded) {
            loaded_ = std::move(loaded);
            watched_.clear();
            stamps_.clear();
        } else {
            error_ = error;
        }
    }
}

}  // namespace diptych::core::app
