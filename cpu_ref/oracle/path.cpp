#include "oracle/path.h"

#include <cmath>
#include <limits>

namespace diptych::oracle {

namespace {

/// Lights up to so many are all asked at each vertex; of more, one is picked uniformly.
constexpr std::size_t few_lights = 4;
/// Scatterings after which Russian roulette begins, so that long paths end: Arvo and Kirk 1990.
constexpr unsigned roulette_depth = 16;

struct Vertex {
    const Surface& surface;
    std::size_t triangle;
};

class PathTracer {
public:
    PathTracer(const Paths& paths, Random& random, std::span<dvec3> by_depth)
        : paths_(paths), random_(random), by_depth_(by_depth) {}

    PathResult trace(Ray ray);

private:
    void add(unsigned depth, const dvec3& radiance);
    bool survives(unsigned depth);
    std::uint64_t new_coin() { return paths_.world.has_alpha ? random_.bits() : 0; }
    Ray ray_from(const Vertex& vertex, const dvec3& direction);
    dvec3 from_punctual(const Vertex& vertex, const PunctualLight& light);
    dvec3 from_punctuals(const Vertex& vertex);
    dvec3 from_emitters(const Vertex& vertex);
    Scattered scatter(const Surface& surface);
    Scattered scatter_uniformly(const Surface& surface);

    const Paths& paths_;
    Random& random_;
    std::span<dvec3> by_depth_;
    PathResult result_;
    dvec3 throughput_{1};
};

void PathTracer::add(unsigned depth, const dvec3& radiance) {
    const dvec3 arrived = throughput_ * radiance;
    result_.radiance += arrived;
    if (!by_depth_.empty()) {
        by_depth_[depth] += arrived;
    }
}

/// Whether the path goes on after its scattering number `depth` + 1.
bool PathTracer::survives(unsigned depth) {
    if (!std::isfinite(throughput_.x + throughput_.y + throughput_.z)) {
        result_.radiance = dvec3(std::numeric_limits<double>::quiet_NaN());  // to be counted, even where no light follows
        return false;
    }
    if (throughput_ == dvec3(0) || depth < roulette_depth) {
        return throughput_ != dvec3(0);
    }
    const double chance = glm::min(largest(throughput_), 0.95);
    throughput_ /= chance;
    return random_.uniform() < chance;
}

Ray PathTracer::ray_from(const Vertex& vertex, const dvec3& direction) {
    Ray ray;
    ray.origin = vertex.surface.position;
    ray.direction = direction;
    ray.from = vertex.triangle;
    ray.coin = new_coin();
    return ray;
}

dvec3 PathTracer::from_punctual(const Vertex& vertex, const PunctualLight& light) {
    const PunctualSample sample = sample_punctual(paths_.world, light, vertex.surface.position);
    const dvec3 f = evaluate(vertex.surface.facets, vertex.surface.bsdf, vertex.surface.o, sample.direction);
    const dvec3 value = f * sample.irradiance;
    if (value == dvec3(0)) {
        return value;
    }
    Ray ray = ray_from(vertex, sample.direction);
    ray.t_max = sample.distance;
    ++result_.rays;
    return paths_.traversal.any(ray) ? dvec3(0) : value;
}

dvec3 PathTracer::from_punctuals(const Vertex& vertex) {
    const std::vector<PunctualLight>& lights = paths_.world.scene->lights;
    if (lights.size() > few_lights) {
        return from_punctual(vertex, lights[random_.below(lights.size())]) * double(lights.size());
    }
    dvec3 sum(0);
    for (const PunctualLight& light : lights) {
        sum += from_punctual(vertex, light);
    }
    return sum;
}

dvec3 PathTracer::from_emitters(const Vertex& vertex) {
    const Emitters::Point point = paths_.emitters.sample(random_);
    const Triangle& emitter = paths_.world.triangles[point.triangle];
    const dvec3 to = point_on(emitter, point.barycentrics) - vertex.surface.position;
    const double distance = length(to);
    if (point.triangle == vertex.triangle || !(distance > 0)) {
        return dvec3(0);
    }
    const dvec3 direction = to / distance;
    const double geometry = std::abs(dot(direction, emitter.front)) / (distance * distance);
    const dvec3 f = evaluate(vertex.surface.facets, vertex.surface.bsdf, vertex.surface.o, direction);
    const dvec3 value = f * emitted(paths_.world, emitter, point.barycentrics, -direction) *
                        (geometry * paths_.emitters.total_area() * coverage(paths_.world, emitter, point.barycentrics));
    if (value == dvec3(0)) {
        return value;
    }
    Ray ray = ray_from(vertex, direction);
    ray.to = point.triangle;
    ray.t_max = distance * (1 - 1e-9);
    ++result_.rays;
    return paths_.traversal.any(ray) ? dvec3(0) : value;
}

Scattered PathTracer::scatter_uniformly(const Surface& surface) {
    if (surface.bsdf.is_mirror() && random_.uniform() < 0.5) {
        Scattered drawn = sample(surface.facets, surface.bsdf, surface.o, true, random_);
        drawn.weight *= 2.0;
        return drawn;
    }
    Scattered drawn;
    const double cosine = random_.uniform();
    drawn.i = around(surface.normal, cosine, 2 * pi * random_.uniform());
    drawn.weight = evaluate(surface.facets, surface.bsdf, surface.o, drawn.i) * (2 * pi);
    drawn.weight *= surface.bsdf.is_mirror() ? 2.0 : 1.0;
    return drawn;
}

Scattered PathTracer::scatter(const Surface& surface) {
    return paths_.mode == Mode::hemisphere ? scatter_uniformly(surface)
                                           : sample(surface.facets, surface.bsdf, surface.o, false, random_);
}

PathResult PathTracer::trace(Ray ray) {
    bool emission_counts = true;
    const dvec3 eye = ray.origin;
    ray.coin = new_coin();
    for (unsigned depth = 0;; ++depth) {
        ++result_.rays;
        const std::optional<Hit> hit = paths_.traversal.closest(ray);
        if (!hit) {
            add(depth, environment_radiance(paths_.world.scene->environment, ray.direction));
            return result_;
        }
        const Surface surface = make_surface(paths_.world, paths_.model, *hit, -ray.direction);
        if (depth == 0) {
            result_.first = {surface.base_color, surface.facets.p, length(surface.position - eye)};
        }
        if (emission_counts) {
            add(depth, surface.emission);
        }
        if (!surface.scatters || depth == paths_.max_depth) {
            return result_;
        }
        const Vertex vertex{surface, hit->triangle};
        add(depth + 1, from_punctuals(vertex));
        if (paths_.mode == Mode::area && !paths_.emitters.empty()) {
            add(depth + 1, from_emitters(vertex));
        }
        const Scattered next = scatter(surface);
        throughput_ *= next.weight;
        if (!survives(depth)) {
            return result_;
        }
        emission_counts = paths_.mode != Mode::area || next.mirrored;
        ray = ray_from(vertex, next.i);
    }
}

}  // namespace

PathResult trace_path(const Paths& paths, Ray ray, Random& random, std::span<dvec3> by_depth) {
    return PathTracer(paths, random, by_depth).trace(ray);
}

}  // namespace diptych::oracle
