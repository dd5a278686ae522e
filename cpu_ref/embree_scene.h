// A packed scene's acceleration structures on the CPU, over Embree 3 or 4.
#pragma once

#if DIPTYCH_EMBREE_VERSION >= 4
#include <embree4/rtcore.h>
#else
#include <embree3/rtcore.h>
#endif

#include <atomic>
#include <cstdint>
#include <glm/glm.hpp>
#include <memory>
#include <string>
#include <type_traits>
#include <vector>

namespace diptych {

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

/// One Embree scene a mesh, instanced under a root. Vertices and indices are shared with the packed scene, which must outlive this.
class EmbreeScene {
public:
    /// Throws Error with Embree's own words where a device or a build fails.
    explicit EmbreeScene(const PackedScene& packed);

    /// Nearest hit with t in (0, infinity).
    EmbreeHit closest(const glm::vec3& origin, const glm::vec3& direction, std::uint32_t alpha_key) const;

    /// Whether anything lies in (0, t_max).
    bool any(const glm::vec3& origin, const glm::vec3& direction, float t_max, std::uint32_t alpha_key) const;

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

    ScenePtr build_mesh(const PackedScene& packed, std::size_t mesh) const;
    ScenePtr build_root(const PackedScene& packed) const;
    void check(const char* what) const;

    std::unique_ptr<std::atomic<std::int64_t>> bytes_;  // Embree's monitor counts here
    DevicePtr device_;
    std::vector<ScenePtr> meshes_;
    ScenePtr root_;
};

/// Embree's version as text, such as "3.13.5".
std::string embree_version();

}  // namespace diptych
