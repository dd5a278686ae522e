// Where rays start and end: surfaces that must not shadow themselves, lamps close and far, meshes that must not leak.
#include "case_scenes.h"
#include "references.h"
#include "render/film_statistics.h"

namespace diptych::core::stability {

namespace {

std::uint32_t spp_of(Effort effort) {
    return effort == Effort::quick ? 16 : 256;
}

int side_of(Effort effort) {
    return effort == Effort::quick ? 32 : 64;
}

/// A rotation without a zero in it.
glm::dmat4 askew() {
    const glm::dmat3 about_y(0.8, 0, -0.6, 0, 1, 0, 0.6, 0, 0.8);
    const glm::dmat3 about_x(1, 0, 0, 0, 12.0 / 13, 5.0 / 13, 0, -5.0 / 13, 12.0 / 13);
    return glm::dmat4(about_y * about_x);
}

/// Vertices moved by a transform and then rounded, as files hold them.
void bake(Primitive& p, const glm::dmat4& transform) {
    p.normals.clear();
    for (glm::vec3& v : p.positions) {
        v = glm::vec3(transform * glm::dvec4(v, 1));
    }
}

Primitive tetrahedron(int material) {
    Primitive p;
    p.material = material;
    p.positions = {{1, 1, 1}, {-1, 1, -1}, {1, -1, -1}, {-1, -1, 1}};
    p.triangles = {{0, 2, 1}, {0, 1, 3}, {0, 3, 2}, {1, 2, 3}};
    return p;
}

/// Under a white sky a white convex body is as bright as the sky, unless a ray that leaves it meets it again: how many
/// did.
Measured count_self_hits(Backend& backend, Primitive body, const dvec3& eye, const dvec3& target, Effort effort) {
    Scene scene;
    scene.name = "convex";
    add_material(scene, diffuse(1));
    add_sky(scene, 1);
    add_object(scene, "body", {std::move(body)});
    add_camera(scene, eye, target, 45);
    RenderSettings settings = settings_of(side_of(effort), side_of(effort), 1);
    settings.integrator = Integrator::brdf;
    const Film film = render(backend, scene, settings, spp_of(effort));
    Measured m;
    m.nonfinite = film_totals(film).nonfinite;
    m.evaluations = film_totals(film).samples;
    for (const shared::FilmPixel& pixel : film.pixels) {
        m.error += std::abs(
            std::round(static_cast<double>(pixel.samples) - rounded(pixel.sum)[0]));
    }
    return m;
}

Measured measure_scale(Backend& backend, double scale, Effort effort) {
    Measured m;
    for (int shape = 0; shape < 2; ++shape) {
        Primitive body;
        if (shape == 0) {
            body = make_sphere(1, 32, 16, 0);
        } else {
            body.material = 0;
            add_box(body, glm::vec3(-0.8F), glm::vec3(0.8F));
        }
        bake(body, glm::dmat4(glm::dmat3(scale)) * askew());
        const Measured one = count_self_hits(backend, body, dvec3(0.5, 1.5, 3) * scale, dvec3(0), effort);
        m.error += one.error;
        m.nonfinite += one.nonfinite;
        m.evaluations += one.evaluations;
        m.where += one.error > 0 ? (shape == 0 ? "sphere " : "box ") : "";
    }
    return m;
}

/// A tetrahedron of edge 2.8 whose vertices are far from their mesh's origin.
Measured measure_vertex_offset(Backend& backend, double offset, Effort effort) {
    const dvec3 middle(offset, 0.3 * offset, -0.7 * offset);
    Primitive body = tetrahedron(0);
    bake(body, translation(middle.x, middle.y, middle.z) * askew());
    return count_self_hits(backend, body, middle + dvec3(0.5, 1.5, 4), middle, effort);
}

/// A room in which every wall emits 0.25 and reflects half: one is lit by what it sees of itself.
Measured measure_furnace_of(Backend& backend, const Primitive& walls, const glm::dmat4& placed, const dvec3& eye,
                            const dvec3& target, Effort effort) {
    Scene scene;
    scene.name = "furnace";
    Material glow = diffuse(0.5F);
    glow.emission = glm::vec3(0.25F);
    add_material(scene, glow);
    add_object(scene, "room", {walls}, placed);
    add_camera(scene, eye, target, 60);
    RenderSettings settings = settings_of(side_of(effort), side_of(effort), 3);
    settings.integrator = Integrator::brdf;
    return judge_mean(render(backend, scene, settings, spp_of(effort)), 0.25 * (1 - std::pow(0.5, 4)) / 0.5);
}

Measured measure_furnace(Backend& backend, double scale, Effort effort) {
    Primitive walls = room(glm::vec3(-1), glm::vec3(1), 0);
    bake(walls, glm::dmat4(glm::dmat3(scale)) * askew());
    return measure_furnace_of(backend, walls, glm::dmat4(1), dvec3(0.1, 0.2, 0.5) * scale, dvec3(0, -0.1, -1) * scale,
                              effort);
}

/// A furnace of so many units, which matrices [A t] place. One coordinate of t, about the camera, is little more than
/// A's entries and the others are thousands of them: who inverts the matrix by elimination takes that coordinate for a
/// pivot, and rounds the inverse of A to ulps of |t| / |A|.
Measured measure_placed_furnace(Backend& backend, double units, Effort effort) {
    const auto half = static_cast<float>(units);
    const Primitive walls = room(glm::vec3(-half), glm::vec3(half), 0);
    Measured m;
    for (const glm::dmat4& linear : {glm::dmat4(1), askew()}) {
        for (int axis = 0; axis < 3; ++axis) {
            dvec3 eye = dvec3(-0.5, 0.6, 0.4) * units;
            eye[axis] = -std::min(0.4 * units, 1.2);
            const Measured one = measure_furnace_of(backend, walls, linear, eye, dvec3(0), effort);
            m.nonfinite += one.nonfinite;
            m.evaluations += one.evaluations;
            worsen(m, one.error, fmt::format("small {}: {}", "xyz"[axis], one.where));
        }
    }
    return m;
}

/// Of a level floor, below the middle of a square lamp as wide as it is high.
Measured measure_lamp(Backend& backend, const Primitive& floor, double height, Effort effort) {
    Scene scene;
    scene.name = "lamp";
    add_material(scene, diffuse(0.5F));
    const int lamp = add_material(scene, make_emitter("lamp", glm::vec3(1)));
    add_object(scene, "floor", {floor});
    add_object(scene, "lamp", {level_square({0, height, 0}, height / 2, false, lamp)});
    const double near = std::min(height, 1.0);
    add_camera(scene, {0.9 * near, 0.6 * near, 0.3 * near}, dvec3(0), 1e-3);
    const Film film = render(backend, scene, settings_of(8, 8, 1), effort == Effort::quick ? 1024 : 65536);
    return judge_mean(film, 0.5 / 3.14159265358979 * square_irradiance(0.5, 1));
}

Measured measure_lamp_height(Backend& backend, double height, Effort effort) {
    return measure_lamp(backend, level_square(dvec3(0), std::max(10.0, 4 * height), true, 0), height, effort);
}

/// The floor reaches so far, and farther on one side.
Measured measure_floor_width(Backend& backend, double width, Effort effort) {
    return measure_lamp(backend, level_square(dvec3(0.3, 0, -0.2) * width, width, true, 0), 1, effort);
}

/// Inside a closed black room under a bright sky: whatever is seen came through a seam.
Measured count_leaks(Backend& backend, const Primitive& walls, const dvec3& eye, const dvec3& target, Effort effort,
                     std::uint32_t depth, double degrees = 100) {
    Scene scene;
    scene.name = "dark room";
    add_material(scene, diffuse(depth > 0 ? 0.5F : 0.0F));
    add_sky(scene, 1);
    add_object(scene, "room", {walls});
    add_camera(scene, eye, target, degrees);
    const Film film =
        render(backend, scene, settings_of(2 * side_of(effort), 2 * side_of(effort), depth), spp_of(effort));
    Measured m;
    m.nonfinite = film_totals(film).nonfinite;
    m.evaluations = film_totals(film).samples;
    const double light = mean_of(film);
    worsen(m, light, fmt::format("{:.3g} of the sky", light));
    return m;
}

/// Walls that meet at edges, with shadow rays along them.
Measured measure_seams(Backend& backend, double scale, Effort effort) {
    Primitive walls = room(glm::vec3(-1), glm::vec3(1), 0);
    bake(walls, glm::dmat4(glm::dmat3(scale)) * askew());
    return count_leaks(backend, walls, dvec3(0.1, 0.2, 0.5) * scale, dvec3(0, -0.1, -1) * scale, effort, 3);
}

/// The same, seen as the few ulps about an edge: a point there is beyond one of both walls as soon as it is rounded
/// outwards.
Measured measure_edge(Backend& backend, double scale, Effort effort) {
    Primitive walls = room(glm::vec3(-1), glm::vec3(1), 0);
    const glm::dmat4 placed = glm::dmat4(glm::dmat3(scale)) * askew();
    bake(walls, placed);
    const dvec3 edge = placed * glm::dvec4(1, 0.3, -1, 1);
    return count_leaks(backend, walls, dvec3(0.1, 0.2, 0.5) * scale, edge, effort, 3, 2e-4);
}

/// A fine sphere around the camera, its vertices moved and rounded: rays aimed everywhere must meet it.
Measured measure_watertight(Backend& backend, double share, Effort effort) {
    const dvec3 middle = share * dvec3(148376, 1234, -223423);
    Primitive walls = make_sphere(1, 128, 64, 0);
    bake(walls, translation(middle.x, middle.y, middle.z));
    return count_leaks(backend, walls, middle, middle + dvec3(0.2, 0.1, -1), effort, 0);
}

/// The furnace of every scale, far from the origin by its instance, as scenes are: only the camera is near.
Measured measure_distance(Backend& backend, double offset, Effort effort) {
    Scene scene;
    scene.name = "far furnace";
    Material glow = diffuse(0.5F);
    glow.emission = glm::vec3(0.25F);
    add_material(scene, glow);
    const dvec3 middle(offset, 0.3 * offset, -0.7 * offset);
    const glm::dmat4 there = translation(middle.x, middle.y, middle.z) * askew();
    add_object(scene, "room", {room(glm::vec3(-1), glm::vec3(1), 0)}, there);
    Primitive ball = make_sphere(0.35F, 24, 12, 0);
    ball.normals.clear();
    add_object(scene, "ball", {ball}, there * translation(-0.3, -0.2, -0.4));
    add_camera(scene, middle + dvec3(0.1, 0.2, 0.5), middle + dvec3(0, -0.1, -1), 60);
    RenderSettings settings = settings_of(side_of(effort), side_of(effort), 3);
    settings.integrator = Integrator::brdf;
    return judge_mean(render(backend, scene, settings, spp_of(effort)), 0.25 * (1 - std::pow(0.5, 4)) / 0.5);
}

/// A furnace whose vertices are that far from their mesh's origin.
Measured measure_vertex_distance(Backend& backend, double offset, Effort effort) {
    Scene scene;
    scene.name = "far vertices";
    Material glow = diffuse(0.5F);
    glow.emission = glm::vec3(0.25F);
    add_material(scene, glow);
    const dvec3 middle(offset, 0.3 * offset, -0.7 * offset);
    Primitive walls = room(glm::vec3(-1), glm::vec3(1), 0);
    bake(walls, translation(middle.x, middle.y, middle.z) * askew());
    add_object(scene, "room", {walls});
    add_camera(scene, middle + dvec3(0.1, 0.2, 0.5), middle + dvec3(0, -0.1, -1), 60);
    RenderSettings settings = settings_of(side_of(effort), side_of(effort), 3);
    settings.integrator = Integrator::brdf;
    return judge_mean(render(backend, scene, settings, spp_of(effort)), 0.25 * (1 - std::pow(0.5, 4)) / 0.5);
}

/// A square lamp cut into needles of so many to one, with triangles of no area strewn in.
Measured measure_needle_lamp(Backend& backend, double aspect, Effort effort) {
    Scene scene;
    scene.name = "needles";
    const int grey = add_material(scene, diffuse(0.5F));
    const int lamp = add_material(scene, make_emitter("lamp", glm::vec3(1)));
    add_object(scene, "floor", {level_square(dvec3(0), 10, true, grey)});
    Primitive needles;
    needles.material = lamp;
    // Sixteen needles in the middle, the rest of the square on both sides of them.
    const double width = 1 / aspect;
    std::vector<double> cuts = {-0.5};
    for (int i = 0; i <= 16; ++i) {
        cuts.push_back((i - 8) * width);
    }
    cuts.push_back(0.5);
    for (std::size_t i = 0; i + 1 < cuts.size(); ++i) {
        const auto a = static_cast<float>(std::clamp(cuts[i], -0.5, 0.5));
        const auto b = static_cast<float>(std::clamp(cuts[i + 1], -0.5, 0.5));
        add_quad(needles, {a, 1, -0.5F}, {b, 1, -0.5F}, {b, 1, 0.5F}, {a, 1, 0.5F});
        add_quad(needles, {a, 1, -0.5F}, {a, 1, 0.5F}, {a, 1, 0.5F}, {a, 1, -0.5F});
    }
    add_object(scene, "lamp", {needles});
    add_camera(scene, {0.9, 0.6, 0.3}, dvec3(0), 1e-3);
    const Film film = render(backend, scene, settings_of(8, 8, 1), effort == Effort::quick ? 1024 : 65536);
    return judge_mean(film, 0.5 / 3.14159265358979 * square_irradiance(0.5, 1));
}

}  // namespace

void add_ray_cases(std::vector<Case>& cases) {
    cases.push_back({"self-intersection",
                     "convex bodies of any size",
                     {"scale", 1e-6, 1e6, true, 2, 13},
                     0,
                     "self-hits",
                     measure_scale});
    cases.push_back({"self-intersection",
                     "a convex body whose vertices are far from their origin",
                     {"offset", 1, 1e6, true, 2, 7},
                     0,
                     "self-hits",
                     measure_vertex_offset});
    cases.push_back({"self-intersection",
                     "a furnace of any size",
                     {"scale", 1e-6, 1e6, true, 2, 13},
                     1e-5,
                     "relative",
                     measure_furnace});
    cases.push_back({"self-intersection",
                     "a furnace of many units, placed by a matrix",
                     {"units", 1, 1e6, true, 3, 13},
                     1e-5,
                     "relative",
                     measure_placed_furnace});
    cases.push_back({"shadow epsilon",
                     "a lamp close to a floor and far from it",
                     {"height", 1e-3, 1e5, true, 3, 9},
                     3e-3,
                     "relative",
                     measure_lamp_height});
    cases.push_back({"shadow epsilon",
                     "no light through the edges of a room",
                     {"scale", 1e-6, 1e6, true, 2, 13},
                     0,
                     "light leaked",
                     measure_seams});
    cases.push_back({"shadow epsilon",
                     "no light through an edge that is looked at",
                     {"scale", 1e-6, 1e6, true, 2, 13},
                     0,
                     "light leaked",
                     measure_edge});
    cases.push_back({"watertightness",
                     "a fine sphere moved to (148376, 1234, -223423)",
                     {"share of the way", 0, 1, false, 2, 5},
                     2e-5,
                     "misses",
                     measure_watertight});
    cases.push_back({"degenerate triangles",
                     "a lamp of needles and of triangles without area",
                     {"aspect", 32, 1e6, true, 2, 6},
                     3e-3,
                     "relative",
                     measure_needle_lamp});
    cases.push_back({"huge coordinates",
                     "a furnace far from the origin",
                     {"offset", 1, 1e7, true, 2, 8},
                     1e-5,
                     "relative",
                     measure_distance});
    cases.push_back({"huge coordinates",
                     "a lamp above a floor of two triangles",
                     {"width", 10, 1e7, true, 2, 7},
                     3e-3,
                     "relative",
                     measure_floor_width});
    cases.push_back({"huge coordinates",
                     "a furnace whose vertices are far from their origin",
                     {"offset", 1, 1e5, true, 2, 6},
                     1e-5,
                     "relative",
                     measure_vertex_distance});
}

}  // namespace diptych::core::stability
