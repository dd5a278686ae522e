#include "oracle/path.h"

#include <cmath>
#include <limits>

namespace diptych::core::oracle {

namespace {

/// Lights up to so many are all asked at each vertex; of more, one is picked uniformly.
constexpr std::size_t few_lights = 4;
/// Scatterings after which Russian roulette begins, so that long paths end: Arvo and Kirk 1990.
constexpr unsigned roulette_depth = 16;

struct Vertex {
    const Surface& surface;
    std::size_t triangle;
};

/// Of the material's draws at the vertex, a steradian.
double scatter_density(const Vertex& vertex, const dvec3& direction) {
    return density(vertex.surface.normals, vertex.surface.bsdf, vertex.surface.o, direction);
}

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
    dvec3 from_sky(const Vertex& vertex);
    double share_of_emission(const Ray& ray, const Hit& hit) const;
    double share_of_sky(const dvec3& direction) const;
    Scattered scatter(const Surface& surface);
    Scattered scatter_uniformly(const Surface& surface);

    const Paths& paths_;
    Random& random_;
    std::span<dvec3> by_depth_;
    PathResult result_;
    dvec3 throughput_{1};
    bool unrivalled_ = true;  // the ray came from the camera or off a mirror: no light sample finds what it finds
    double density_ = 0;      // else, in mode mis: of its direction, a steradian
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
        result_.radiance =
            dvec3(std::numeric_limits<double>::quiet_NaN());  // to be counted, even where no light follows
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
    const dvec3 f = evaluate(vertex.surface.normals, vertex.surface.bsdf, vertex.surface.o, sample.direction);
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
    const dvec3 f = evaluate(vertex.surface.normals, vertex.surface.bsdf, vertex.surface.o, direction);
    dvec3 value = f * emitted(paths_.world, emitter, point.barycentrics, -direction) *
                  (geometry / point.density * coverage(paths_.world, emitter, point.barycentrics));
    if (value == dvec3(0)) {
        return value;
    }
    if (paths_.mode == Mode::mis) {
        value *= point.density / (point.density + scatter_density(vertex, direction) * geometry);
    }
    Ray ray = ray_from(vertex, direction);
    ray.to = point.triangle;
    ray.t_max = distance * (1 - 1e-9);
    ++result_.rays;
    return paths_.traversal.any(ray) ? dvec3(0) : value;
}

dvec3 PathTracer::from_sky(const Vertex& vertex) {
    const SkyMap::Direction sample = paths_.sky.sample(random_);
    const dvec3 f = evaluate(vertex.surface.normals, vertex.surface.bsdf, vertex.surface.o, sample.direction);
    if (f == dvec3(0)) {
        return f;
    }
    const dvec3 value = f * environment_radiance(paths_.world.scene->environment, sample.direction) /
                        (sample.density + scatter_density(vertex, sample.direction));
    ++result_.rays;
    return paths_.traversal.any(ray_from(vertex, sample.direction)) ? dvec3(0) : value;
}

/// The part of a hit's emission that is left to the ray, where light samples have theirs.
double PathTracer::share_of_emission(const Ray& ray, const Hit& hit) const {
    if (unrivalled_ || paths_.mode == Mode::bsdf || paths_.mode == Mode::hemisphere) {
        return 1;
    }
    if (paths_.mode == Mode::area) {
        return 0;
    }
    const double rival = paths_.emitters.density(hit.triangle);
    const double geometry = std::abs(dot(ray.direction, paths_.world.triangles[hit.triangle].front)) / (hit.t * hit.t);
    return rival > 0 ? density_ * geometry / (density_ * geometry + rival) : 1;
}

double PathTracer::share_of_sky(const dvec3& direction) const {
    const double rival = unrivalled_ || paths_.mode != Mode::mis ? 0 : paths_.sky.density(direction);
    return rival > 0 ? density_ / (density_ + rival) : 1;
}

Scattered PathTracer::scatter_uniformly(const Surface& surface) {
    if (surface.bsdf.is_mirror() && random_.uniform() < 0.5) {
        Scattered drawn = sample(surface.normals, surface.bsdf, surface.o, true, random_);
        drawn.weight *= 2.0;
        return drawn;
    }
    Scattered drawn;
    const double cosine = random_.uniform();
    drawn.i = around(surface.normal, cosine, 2 * pi * random_.uniform());
    drawn.weight = evaluate(surface.normals, surface.bsdf, surface.o, drawn.i) * (2 * pi);
    drawn.weight *= surface.bsdf.is_mirror() ? 2.0 : 1.0;
    return drawn;
}

Scattered PathTracer::scatter(const Surface& surface) {
    return paths_.mode == Mode::hemisphere ? scatter_uniformly(surface)
                                           : sample(surface.normals, surface.bsdf, surface.o, false, random_);
}

PathResult PathTracer::trace(Ray ray) {
    const dvec3 eye = ray.origin;
    ray.coin = new_coin();
    for (unsigned depth = 0;; ++depth) {
        ++result_.rays;
        const std::optional<Hit> hit = paths_.traversal.closest(ray);
        if (!hit) {
            const dvec3 radiance = environment_radiance(paths_.world.scene->environment, ray.direction);
            add(depth, radiance * share_of_sky(ray.direction));
            return result_;
        }
        const Surface surface = make_surface(paths_.world, paths_.model, paths_.normal_maps, *hit, -ray.direction);
        if (depth == 0) {
            result_.first = {surface.base_color, shown_normal(surface.normals), length(surface.position - eye)};
        }
        if (surface.emission != dvec3(0)) {
            add(depth, surface.emission * share_of_emission(ray, *hit));
        }
        if (!surface.scatters || depth == paths_.max_depth) {
            return result_;
        }
        const Vertex vertex{surface, hit->triangle};
        add(depth + 1, from_punctuals(vertex));
        const bool samples_emitters = paths_.mode == Mode::area || paths_.mode == Mode::mis;
        if (samples_emitters && !paths_.emitters.empty()) {
            add(depth + 1, from_emitters(vertex));
        }
        if (paths_.mode == Mode::mis && !paths_.sky.empty()) {
            add(depth + 1, from_sky(vertex));
        }
        const Scattered next = scatter(surface);
        throughput_ *= next.weight;
        if (!survives(depth)) {
            return result_;
        }
        unrivalled_ = next.mirrored;
        density_ = paths_.mode == Mode::mis && !next.mirrored ? scatter_density(vertex, next.i) : 0;
        ray = ray_from(vertex, next.i);
    }
}

}  // namespace

PathResult trace_path(const Paths& paths, Ray ray, Random& random, std::span<dvec3> by_depth) {
    return PathTracer(paths, random, by_depth).trace(ray);
}

}  // namespace diptych::core::oracle
