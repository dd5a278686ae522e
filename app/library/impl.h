// The public types' insides, and the way between them and those of common.
#pragma once

#include <atomic>
#include <memory>
#include <set>
#include <string>
#include <vector>

#include "diptych/diptych.h"
#include "gltf/import.h"
#include "measure/step_hook.h"
#include "render/film.h"
#include "render/film_parts.h"
#include "render/metadata.h"
#include "render/request.h"
#include "render/session.h"
#include "scene/scene.h"

DIPTYCH_BEGIN

/// What a user may edit of a scene.
struct Tables {
    std::vector<Material> materials;
    std::vector<Camera> cameras;
    std::vector<Light> lights;
    std::vector<Instance> instances;
    Environment environment;
    std::vector<Node> nodes;  // empty until somebody asks for them

    bool operator==(const Tables&) const = default;
};

struct SceneData {
    Tables tables;
    Tables synced;                         // what `content` says
    std::shared_ptr<core::Scene> content;  // written only while nobody else holds it
    core::FileNodes file_nodes;            // as `content` has them
    std::uint64_t revision = 0;            // of this process; 0 is the scene as its file has it

    /// The scene as edited, which stays as it is from then on. Throws Error where an edit is out of range.
    std::shared_ptr<const core::Scene> snapshot();

    /// `content`, to be written: a copy where a session holds it. It becomes another revision.
    core::Scene& own_content();
};

core::RenderSettings to_core(const Settings& settings);

/// What a film of this process shows.
struct FilmOrigin {
    std::uint64_t revision = 0;  // of the scene
    core::Moment moment;
};

/// Samples of one seed that a film has.
struct FilmSamples {
    std::uint32_t seed = 0;
    core::FilmPart part;
};

struct FilmData {
    FilmInfo info;
    core::Film film;          // without pixels where a file held no sums
    core::Metadata metadata;  // of the picture as it was made; counts are those of `info`
    std::vector<FilmSamples> samples;
    std::optional<FilmOrigin> origin;  // none where it was loaded
    core::LayeredImage developed;

    std::string name() const { return info.file.empty() ? "film" : info.file; }
    /// Whether its samples go on from one another.
    bool chained() const { return info.backend != Backend::oracle && core::chains_frames(to_core(info.settings)); }
};

struct SessionData {
    std::shared_ptr<SceneData> scene;
    std::shared_ptr<const core::Scene> content;
    std::uint64_t revision = 0;  // of the content
    BackendChoice choice;
    Settings settings;
    SessionOptions options;
    core::Moment moment;
    std::unique_ptr<core::Session> session;
    std::set<std::string> warned;
    core::SampleRanges samples;  // of the picture, those of the base among them
    double seconds = 0;          // of rendering it
    std::shared_ptr<const FilmData> base;  // that it goes on from
    std::string fingerprint;               // of what it shows; empty until it is asked for

    core::RenderSettings core_settings() const;
    core::RenderRequest request() const;
    bool chained() const { return choice.backend != Backend::oracle && core::chains_frames(to_core(settings)); }
    core::RenderOutcome outcome();
    void open();
    core::Session& running();  // opened again where opening it failed before
    void begin_picture();
    void follow_edits();
    void go_to(const core::Moment& next, const Settings& wanted);
    /// The first sample after those that are there.
    std::uint32_t done() const {
        return samples.empty() ? 0 : static_cast<std::uint32_t>(samples.ranges().back().end);
    }
};

struct Impl {
    static SceneData& data(const Scene& scene) { return *scene.data_; }
    static std::shared_ptr<SceneData> shared(const Scene& scene) { return scene.data_; }
    static SessionData& data(Session& session) { return *session.data_; }
    static const FilmData& data(const Film& film) { return *film.data_; }
    static std::shared_ptr<const FilmData> shared(const Film& film) { return film.data_; }
    static Scene make_scene(std::shared_ptr<core::Scene> content, core::FileNodes nodes);
    static Film make_film(std::shared_ptr<const FilmData> data) { return Film(std::move(data)); }
};

/// Runs `work`; what it throws becomes the library's own.
template <class Work>
auto guarded(const Work& work) {
    try {
        return work();
    } catch (const Error&) {
        throw;
    } catch (const core::NoDevice& error) {
        throw NoDevice(error.what());
    } catch (const core::OutOfMemory& error) {
        throw OutOfMemory(error.what());
    } catch (const core::DeviceLost& error) {
        throw DeviceLost(error.what());
    } catch (const core::Error& error) {
        throw Error(error.what());
    }
}

/// Sets `flag` once the token says so, as long as it lives.
class StopFlag {
public:
    explicit StopFlag(const std::stop_token& token) : callback_(token, [this] { flag_ = true; }) {}
    const std::atomic<bool>& flag() const { return flag_; }

private:
    std::atomic<bool> flag_{false};
    std::stop_callback<std::function<void()>> callback_;
};

/// Throws Error where a film cannot be added to: it has no sums, or sums of no whole samples.
void require_sums(const FilmData& data);

/// Counts an engine's steps for a program. Must outlive its hook.
class StepCount {
public:
    using Progress = std::function<void(const std::string& step, int done, int steps)>;
    StepCount(const Progress& progress, int steps) : progress_(progress), steps_(steps) {}
    core::StepHook hook() const {
        return [this](const std::string& step) {
            if (progress_) {
                progress_(step, done_++, steps_);
            }
        };
    }

private:
    const Progress& progress_;
    int steps_;
    mutable int done_ = 0;
};

// measure.cpp: what engines render, without layers, and how they open it.
core::RenderRequest measured_request(const core::Scene& content, const Settings& settings, const std::string& device,
                                     int threads);
core::Session open_measured(const core::Scene& scene, const core::RenderRequest& request, bool plays);

// convert.cpp
Tables tables_of(const core::Scene& scene, const core::FileNodes& nodes);
/// Writes what differs between the tables into the scene; `before` is what the scene says. `nodes` are those after it.
void apply(const Tables& before, const Tables& after, const core::FileNodes& nodes, core::Scene& scene);
core::Camera to_core(const Camera& camera);
core::PunctualLight to_core(const Light& light);
Light from_core(const core::PunctualLight& light);
Camera from_core(const core::Camera& camera);
Environment from_core(const core::Environment& environment);
glm::dmat4 to_core(const Matrix& matrix);
Matrix from_core(const glm::dmat4& matrix);
Settings from_core(const core::RenderSettings& settings);
std::string core_name(Backend backend);

// nodes.cpp
std::vector<Node> nodes_of(const core::Scene& scene, const core::FileNodes& nodes);
/// The file's nodes as the edited table has them. Throws Error where an animated node's matrix is no product of
/// translation, rotation and scale, or a transform is not finite.
core::FileNodes edited_nodes(const Tables& before, const Tables& after, const core::FileNodes& nodes);
/// Moves what hangs in the nodes from where `before` places it to where `after` does. What stands elsewhere was placed
/// by itself, and hangs in no node from now on. Throws Error, and changes nothing, where a camera or a light is left
/// without a direction.
void follow_nodes(const core::FileNodes& before, const core::FileNodes& after, Tables& tables);
/// The same where no node was edited; places the nodes only where a row may have let go of one.
void let_go_of_nodes(const Tables& before, const core::FileNodes& nodes, Tables& tables);

// validate.cpp: throw Error naming object, field and value.
/// "materials[2] 'paint'".
std::string object(const char* table, std::size_t index, const std::string& name);
/// `synced` is what the scene says.
void check(const Tables& tables, const Tables& synced, const core::Scene& scene, std::size_t nodes);
void check(const Camera& camera);
void check(const Settings& settings, std::size_t cameras);
void check(const BackendChoice& choice);

DIPTYCH_END
