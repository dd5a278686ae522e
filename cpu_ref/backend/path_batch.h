// Paths that are taken a step at a time together.
#pragma once

#include "backend/cpu_kernel.h"
#include "backend/triangle_lanes.h"

namespace diptych::core {

/// One sample each of neighbouring pixels. Every step is done for all paths before the next one, so that points on
/// emitters come from vector code and one path's work fills the time that another's waits. A path depends on nothing
/// but its pixel and sample, so its company changes nothing.
template <class Kernel>
class PathBatch {
public:
    static constexpr int size = TriangleLanes::width;

    explicit PathBatch(Kernel& kernel) : kernel_(kernel) {}

    /// Sample `sample` of `count` <= size pixels of row y, from x on.
    void trace(shared::uint x, shared::uint y, int count, shared::uint sample) {
        for (int i = 0; i < count; ++i) {
            paths_[i] = kernel_.begin_path({x + static_cast<shared::uint>(i), y}, sample);
            alive_[i] = i;
        }
        alive_count_ = count;
        while (alive_count_ > 0) {
            arrive();
            pick_lights();
            sample_emitters();
            leave();
        }
    }

    /// What the i-th path has found.
    const typename Kernel::PathSample& found(int i) const { return paths_[i].found; }

private:
    using PathState = typename Kernel::PathState;
    using Vertex = typename Kernel::Vertex;

    /// Traces the paths' rays. Those that scatter where they end are alive_ then, the k-th of them at vertices_[k].
    void arrive() {
        shared::Hit hits[size];
        for (int k = 0; k < alive_count_; ++k) {
            const PathState& path = paths_[alive_[k]];
            hits[k] = kernel_.trace_closest(path.origin, path.direction, kernel_.next_ray_key(path));
        }
        int arrived = 0;
        for (int k = 0; k < alive_count_; ++k) {
            if (kernel_.arrive_at_vertex(paths_[alive_[k]], hits[k], vertices_[arrived])) {
                alive_[arrived++] = alive_[k];
            }
        }
        alive_count_ = arrived;
    }

    /// On its own, so that the processor overlaps the searches of several vertices.
    void pick_lights() {
        for (int k = 0; k < alive_count_; ++k) {
            kernel_.pick_vertex_light(vertices_[k]);
        }
    }

    void sample_emitters() {
        int vertex_of[size];
        int used = 0;
        for (int k = 0; k < alive_count_; ++k) {
            const Vertex& v = vertices_[k];
            if (kernel_.is_emitter(v.light.id)) {
                lanes_.put(used, kernel_.load_emissive_triangles(v.light.id), v.position,
                           kernel_.light_point_draws(v.draws));
                vertex_of[used++] = k;
            }
        }
        if (used > 0) {
            lanes_.sample();
        }
        for (int lane = 0; lane < used; ++lane) {
            Vertex& v = vertices_[vertex_of[lane]];
            v.on_emitter = lanes_.get(lane);
            if (!(v.on_emitter.pdf > 0)) {
                v.on_emitter = kernel_.sample_emitter_point(kernel_.load_emissive_triangles(v.light.id), v.position,
                                                            kernel_.light_point_draws(v.draws));
            }
        }
    }

    /// Scatters the paths and traces their shadow rays. Those that go on are alive_ then.
    void leave() {
        for (int k = 0; k < alive_count_; ++k) {
            kernel_.leave_vertex(paths_[alive_[k]], vertices_[k]);
        }
        int left = 0;
        for (int k = 0; k < alive_count_; ++k) {
            PathState& path = paths_[alive_[k]];
            if (kernel_.awaits_shadow_ray(path)) {
                kernel_.settle_direct_light(path, kernel_.trace_any(path.origin, path.direct.direction,
                                                                    path.direct.t_max, kernel_.shadow_ray_key(path)));
            }
            alive_[left] = alive_[k];
            left += path.goes_on ? 1 : 0;
        }
        alive_count_ = left;
    }

    Kernel& kernel_;
    PathState paths_[size];
    Vertex vertices_[size];
    TriangleLanes lanes_;
    int alive_[size];  // indices of the paths that go on
    int alive_count_ = 0;
};

}  // namespace diptych::core
