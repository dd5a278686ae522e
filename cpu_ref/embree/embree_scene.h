// A packed scene's acceleration structures on the CPU, over Embree 3 or 4.
#pragma once

#if DIPTYCH_EMBREE_VERSION >= 4
#include <embree4/rtcore.h>
#else
#include <embree3/rtcore.h>
#endif

#include <array>
#include <atomic>
#include <cstdint>
#include <glm/glm.hpp>
#include <memory>
#include <string>
#include <type_traits>
#include <vector>

namespace diptych::core {

struct PackedScene;

/// A ray's nearest hit; `instance` is ~0 on a miss. Ids count as in hooks.md.
struct EmbreeHit {
    std::uint32_t instance;
    std::uint32_t geometry;
    std::uint32_t primitive;
    float u;
    float v;
    float t;
};

/// One Embree scene a mesh, instanced under a root. Vertices and indices are shared with the packed scene, which must
/// outlive this.
class EmbreeScene {
public:
    /// Throws Error with Embree's own words where a device or a build fails.
    explicit EmbreeScene(const PackedScene& packed);

    /// Nearest hit with t in (0, infinity).
    EmbreeHit closest(const glm::vec3& origin, const glm::vec3& direction, std::uint32_t alpha_key) const;

    /// Nearest hit in (0, t_max) among the emitters alone (emitter_corners.h), where the settings search them;
    /// `primitive` is the light's id, ~0 on a miss.
    EmbreeHit emitter(const glm::vec3& origin, const glm::vec3& direction, float t_max) const;

    /// Whether anything lies in (0, t_max).
    bool any(const glm::vec3& origin, const glm::vec3& direction, float t_max, std::uint32_t alpha_key) const;

    /// The same in the moment before, which is this one unless PackedScene::keeps_previous.
    bool any_previous(const glm::vec3& origin, const glm::vec3& direction, float t_max, std::uint32_t alpha_key) const;

    /// Places the instances as another moment has them. Meshes stay; the root is rebuilt where any instance moved.
    /// Throws Error where there are more or fewer of them.
    void move_to(const PackedScene& moment);

    /// The same scene under other settings: its instances and the moment before, if it keeps one, which is this one
    /// then. Hits in materials with alpha are put to `packed` from now on; vertices and indices stay those of the
    /// first. Throws Error likewise.
    void reconfigure(const PackedScene& packed);

    /// Bytes that Embree holds for its structures.
    std::uint64_t bytes() const { return static_cast<std::uint64_t>(bytes_->load()); }

private:
    struct ReleaseDevice {
        void operator()(RTCDevice d) const { rtcReleaseDevice(d); }
    };
    struct ReleaseScene {
        void operator()(RTCScene s) const { rtcReleaseScene(s); }
    };
    using DevicePtr = std::unique_ptr<std::remove_pointer_t<RTCDevice>, ReleaseDevice>;
    using ScenePtr = std::unique_ptr<std::remove_pointer_t<RTCScene>, ReleaseScene>;

    /// Where an instance stands in a root.
    struct Placement {
        std::array<glm::vec4, 3> rows;
        bool shown;
        bool operator==(const Placement&) const = default;
    };
    struct Root {
        ScenePtr scene;
        std::vector<Placement> placements;
        std::uint64_t revision = 0;  // of the instances
    };

    static Placement placement(const PackedScene& packed, std::size_t instance);
    static void place(RTCGeometry geometry, const Placement& placement);
    ScenePtr build_mesh(const PackedScene& packed, std::size_t mesh) const;
    Root build_root(const PackedScene& packed) const;
    void require_instances(const PackedScene& packed) const;
    static void place_all(const PackedScene& packed, Root& root);
    void place_emitters(const PackedScene& packed);
    bool occluded(RTCScene root, const glm::vec3& origin, const glm::vec3& direction, float t_max,
                  std::uint32_t alpha_key) const;
    void check(const char* what) const;

    std::unique_ptr<std::atomic<std::int64_t>> bytes_;  // Embree's monitor counts here
    DevicePtr device_;
    std::vector<ScenePtr> meshes_;
    Root root_;
    Root previous_;
    ScenePtr emitters_;
    std::uint64_t emitter_revision_ = 0;
};

/// Embree's version as text, such as "3.13.5".
std::string embree_version();

}  // namespace diptych::core
