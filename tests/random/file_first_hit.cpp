// What a ray from the camera shows first, by the file alone: textures, normal maps, alpha.
#include <algorithm>
#include <cmath>

#include "file_scene.h"

namespace diptych::core::tests {

using nlohmann::json;

namespace {

double to_linear(double srgb) {
    return srgb <= 0.04045 ? srgb / 12.92 : std::pow((srgb + 0.055) / 1.055, 2.4);
}

int wrapped(int i, int size, int mode) {
    if (mode == 33071) {
        return std::clamp(i, 0, size - 1);
    }
    const int period = mode == 33648 ? 2 * size : size;
    const int at = (i % period + period) % period;
    return at < size ? at : period - 1 - at;
}

FileVertex between(const FileTriangle& triangle, double u, double v) {
    const auto& [a, b, c] = triangle.vertices;
    const auto mix = [&](const auto& x, const auto& y, const auto& z) { return (1 - u - v) * x + u * y + v * z; };
    FileVertex out;
    out.position = mix(a.position, b.position, c.position);
    out.color = mix(a.color, b.color, c.color);
    for (int set = 0; set < 2; ++set) {
        out.uv[set] = mix(a.uv[set], b.uv[set], c.uv[set]);
    }
    if (a.normal) {
        out.normal = mix(*a.normal, *b.normal, *c.normal);
    }
    if (a.tangent) {
        out.tangent = mix(*a.tangent, *b.tangent, *c.tangent);
    }
    return out;
}

/// The normal seen from `to_eye`, at a cosine of 10^-3 at least; the triangle's where that lies below the surface.
glm::dvec3 bent(const glm::dvec3& n, const glm::dvec3& facing, const glm::dvec3& to_eye) {
    constexpr double least = 1e-3;
    if (dot(n, to_eye) >= least) {
        return n;
    }
    const glm::dvec3 across = normalize(n - dot(n, to_eye) * to_eye);
    const glm::dvec3 out = least * to_eye + std::sqrt(1 - least * least) * across;
    return dot(out, facing) > 0 ? out : facing;
}

}  // namespace

glm::dvec4 FileScene::texel(const json& slot, const FileVertex& at, bool srgb) const {
    if (slot.is_null()) {
        return glm::dvec4(1);
    }
    const json& texture = document_.at("textures").at(slot.at("index").get<std::size_t>());
    const json& sampler = document_.at("samplers").at(texture.at("sampler").get<std::size_t>());
    const Image& image = images_.at(texture.at("source").get<std::size_t>());
    glm::dvec2 uv = at.uv[slot.value("texCoord", 0)];
    if (slot.contains("extensions")) {
        const json& transform = slot.at("extensions").at("KHR_texture_transform");
        const double angle = transform.value("rotation", 0.0);
        const glm::dvec2 p = uv * vector_of<2>(transform, "scale", {1, 1});
        uv = vector_of<2>(transform, "offset", {0, 0}) +
             glm::dvec2(std::cos(angle) * p.x + std::sin(angle) * p.y, std::cos(angle) * p.y - std::sin(angle) * p.x);
    }
    const auto fetch = [&](int x, int y) {
        const int column = wrapped(x, image.width, sampler.at("wrapS"));
        const int row = wrapped(y, image.height, sampler.at("wrapT"));
        glm::dvec4 out(1);
        for (int c = 0; c < image.channels; ++c) {
            const double value = image.at(column, row, c);
            out[c] = srgb && c < 3 ? to_linear(value) : value;
        }
        return out;
    };
    const glm::dvec2 place = uv * glm::dvec2(image.width, image.height);
    if (sampler.at("magFilter") == 9728) {
        return fetch(int(std::floor(place.x)), int(std::floor(place.y)));
    }
    const glm::dvec2 low = glm::floor(place - 0.5);
    const glm::dvec2 f = place - 0.5 - low;
    const int x = int(low.x);
    const int y = int(low.y);
    return glm::mix(glm::mix(fetch(x, y), fetch(x + 1, y), f.x), glm::mix(fetch(x, y + 1), fetch(x + 1, y + 1), f.x), f.y);
}

glm::dvec4 FileScene::base_color(const json& material, const FileVertex& at) const {
    const json surface = material.value("pbrMetallicRoughness", json::object());
    return vector_of<4>(surface, "baseColorFactor", glm::dvec4(1)) * at.color *
           texel(surface.value("baseColorTexture", json()), at, true);
}

/// The mapped normal where there is a map and a tangent, on the viewer's side and above the surface.
glm::dvec3 FileScene::normal(const FileTriangle& triangle, const FileVertex& at, const glm::dvec3& to_eye) const {
    const glm::dmat3& m = triangle.to_world;
    const auto& [a, b, c] = triangle.vertices;
    const bool mirrored = determinant(m) < 0;
    const glm::dvec3 front = (mirrored ? -1.0 : 1.0) * normalize(cross(b.position - a.position, c.position - a.position));
    const glm::dvec3 facing = dot(front, to_eye) < 0 ? -front : front;
    const glm::dvec3 smooth = at.normal ? normalize(inverse(transpose(m)) * *at.normal) : front;
    const double side = dot(smooth, facing) < 0 ? -1 : 1;
    const json slot = triangle.material.value("normalTexture", json());
    if (slot.is_null() || !at.tangent || !at.normal) {
        return bent(side * smooth, facing, to_eye);
    }
    const glm::dvec3 along = m * glm::dvec3(*at.tangent);
    const glm::dvec3 t = normalize(along - dot(along, smooth) * smooth);
    const glm::dvec3 bitangent = cross(smooth, t) * ((at.tangent->w < 0) != mirrored ? -1.0 : 1.0);
    const double scale = slot.value("scale", 1.0);
    const glm::dvec3 v = 2.0 * glm::dvec3(texel(slot, at, false)) - 1.0;
    const glm::dvec3 p = side * normalize(scale * v.x * t + scale * v.y * bitangent + v.z * smooth);
    constexpr double least = 0.01;  // of its cosine to the surface's normal
    if (dot(p, facing) >= least) {
        return p;
    }
    return normalize(p - dot(p, facing) * facing) * std::sqrt(1 - least * least) + least * facing;
}

FirstHitMeans FileScene::first_hit(int camera, glm::dvec2 film, double aspect) const {
    const json& lens = document_.at("cameras").at(std::size_t(camera));
    const glm::dvec2 plane((2 * film.x - 1) * aspect, 1 - 2 * film.y);
    const bool parallel = lens.at("type") == "orthographic";
    const double half = parallel ? lens.at("orthographic").at("ymag").get<double>()
                                 : std::tan(lens.at("perspective").at("yfov").get<double>() / 2);
    const glm::dmat4 frame = cameras_.at(std::size_t(camera));
    const glm::dvec3 origin(frame * (parallel ? glm::dvec4(plane * half, 0, 1) : glm::dvec4(0, 0, 0, 1)));
    const glm::dvec3 direction =
        normalize(glm::dvec3(frame * (parallel ? glm::dvec4(0, 0, -1, 0) : glm::dvec4(plane * half, -1, 0))));
    struct Met {
        double t, u, v;
        const FileTriangle* triangle;
    };
    std::vector<Met> met;
    for (const FileTriangle& triangle : triangles_) {
        const glm::dvec3 a = triangle.vertices[0].position;
        const glm::dmat3 edges(triangle.vertices[1].position - a, triangle.vertices[2].position - a, -direction);
        const glm::dvec3 solution = inverse(edges) * (origin - a);  // u, v, t
        if (solution.x >= 0 && solution.y >= 0 && solution.x + solution.y <= 1 && solution.z > 0) {
            met.push_back({solution.z, solution.x, solution.y, &triangle});
        }
    }
    std::sort(met.begin(), met.end(), [](const Met& a, const Met& b) { return a.t < b.t; });
    FirstHitMeans out;
    double left = 1;  // of the ray, past the alpha of what was met
    for (const Met& hit : met) {
        const json& material = hit.triangle->material;
        const FileVertex at = between(*hit.triangle, hit.u, hit.v);
        const glm::dvec4 color = base_color(material, at);
        const std::string mode = material.value("alphaMode", "OPAQUE");
        const double alpha = mode == "OPAQUE" ? 1
                             : mode == "BLEND" ? std::clamp(color.a, 0.0, 1.0)
                                               : color.a >= material.value("alphaCutoff", 0.5);
        out.albedo += left * alpha * glm::dvec3(color);
        out.normal += left * alpha * normal(*hit.triangle, at, -direction);
        out.depth += left * alpha * hit.t;
        left *= 1 - alpha;
    }
    return out;
}

}  // namespace diptych::core::tests
