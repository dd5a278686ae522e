// A maze of perfect mirrors under small coloured lamps: long chains of specular reflection, which no light sampling can
// shorten.
#include "generate/random.h"
#include "generate/scenes.h"
#include "generate/shapes.h"

#include <array>
#include <vector>

namespace diptych::core {
namespace {

constexpr int cells = 7;
constexpr float cell = 1.6F, height = 2.4F;

/// Which walls stand: `across` between cells (x, z - 1) and (x, z), `along` between (x - 1, z) and (x, z).
struct Maze {
    std::array<std::array<bool, cells + 1>, cells + 1> across{}, along{};
};

Maze carve_maze(GeneratorRandom& random) {
    Maze maze;
    for (auto& row : maze.across) {
        row.fill(true);
    }
    for (auto& row : maze.along) {
        row.fill(true);
    }
    const auto wall_between = [&](glm::ivec2 a, glm::ivec2 b) -> bool& {
        if (a.x == b.x) {
            return maze.across[std::size_t(a.x)][std::size_t(std::max(a.y, b.y))];
        }
        return maze.along[std::size_t(std::max(a.x, b.x))][std::size_t(a.y)];
    };
    constexpr std::array<glm::ivec2, 4> steps{{{1, 0}, {-1, 0}, {0, 1}, {0, -1}}};
    const auto inside = [](glm::ivec2 p) { return p.x >= 0 && p.y >= 0 && p.x < cells && p.y < cells; };
    std::array<std::array<bool, cells>, cells> seen{};
    std::vector<glm::ivec2> path{{cells / 2, cells - 1}};
    seen[cells / 2][cells - 1] = true;
    while (!path.empty()) {
        std::vector<glm::ivec2> open;
        for (const glm::ivec2& step : steps) {
            const glm::ivec2 to = path.back() + step;
            if (inside(to) && !seen[std::size_t(to.x)][std::size_t(to.y)]) {
                open.push_back(to);
            }
        }
        if (open.empty()) {
            path.pop_back();
            continue;
        }
        const glm::ivec2 to = open[random.below(open.size())];
        wall_between(path.back(), to) = false;
        seen[std::size_t(to.x)][std::size_t(to.y)] = true;
        path.push_back(to);
    }
    // The middle aisle is what the camera looks down, and loops let light through.
    for (int z = 2; z < cells; ++z) {
        maze.across[cells / 2][std::size_t(z)] = false;
    }
    for (int i = 0; i < 10; ++i) {
        const auto x = 1 + random.below(cells - 1), z = random.below(cells);
        maze.along[x][z] = false;
    }
    return maze;
}

Primitive box_of(const glm::vec3& low, const glm::vec3& high, int material) {
    Primitive out;
    out.material = material;
    add_box(out, low, high);
    return out;
}

}  // namespace

GeneratedScene generate_mirror_maze(const GenerateOptions& options) {
    GeneratedScene out;
    Scene& scene = out.scene;
    scene.name = "mirror-maze";
    GeneratorRandom random{options.seed + 20U};
    const Maze maze = carve_maze(random);

    const int floor = add_material(scene, make_material("floor", {0.35F, 0.33F, 0.3F}, 0, 0.7F));
    const int ceiling = add_material(scene, make_material("ceiling", {0.55F, 0.55F, 0.6F}, 0, 1));
    const int post = add_material(scene, make_material("post", {0.12F, 0.1F, 0.09F}, 0, 0.4F));
    constexpr float half = cell * cells / 2, rim = half + 0.2F;
    Primitive shell;
    shell.material = floor;
    add_quad(shell, {-rim, 0, rim}, {rim, 0, rim}, {rim, 0, -rim}, {-rim, 0, -rim});
    Primitive lid;
    lid.material = ceiling;
    add_quad(lid, {-rim, height, -rim}, {rim, height, -rim}, {rim, height, rim}, {-rim, height, rim});
    add_object(scene, "floor", {shell});
    add_object(scene, "ceiling", {lid});

    // Walls end inside posts and beyond floor and ceiling, so no two faces share a plane.
    constexpr std::array<glm::vec3, 4> tints{
        {{0.95F, 0.95F, 0.95F}, {0.95F, 0.8F, 0.5F}, {0.6F, 0.85F, 0.95F}, {0.95F, 0.65F, 0.7F}}};
    constexpr std::array<const char*, 4> tint_names{"silver", "gold", "blue", "rose"};
    std::array<int, 4> across{}, along{};
    for (std::size_t i = 0; i < tints.size(); ++i) {
        const std::string name = tint_names[i];
        const int mirror = add_material(scene, make_material(name, tints[i], 1, 0));
        constexpr float reach = cell / 2 - 0.02F, thick = 0.025F, low = -0.05F, high = height + 0.05F;
        across[i] = add_mesh(scene, name + " across", {box_of({-reach, low, -thick}, {reach, high, thick}, mirror)});
        along[i] = add_mesh(scene, name + " along", {box_of({-thick, low, -reach}, {thick, high, reach}, mirror)});
    }
    const int post_mesh =
        add_mesh(scene, "post", {box_of({-0.05F, -0.06F, -0.05F}, {0.05F, height + 0.06F, 0.05F}, post)});
    const auto place = [](double x, double z) {
        return translation(double(cell) * (x - cells / 2.0), 0, double(cell) * (z - cells / 2.0));
    };
    for (int x = 0; x <= cells; ++x) {
        for (int z = 0; z <= cells; ++z) {
            const auto i = std::size_t(x), j = std::size_t(z);
            add_instance(scene, "", post_mesh, place(x, z));
            if (x < cells && maze.across[i][j]) {
                add_instance(scene, "", across[random.below(4)], place(x + 0.5, z));
            }
            if (z < cells && maze.along[i][j]) {
                add_instance(scene, "", along[random.below(4)], place(x, z + 0.5));
            }
        }
    }

    constexpr std::array<glm::vec3, 4> glows{{{150, 130, 100}, {150, 40, 60}, {40, 90, 180}, {50, 150, 80}}};
    constexpr std::array<const char*, 4> glow_names{"warm lamp", "red lamp", "blue lamp", "green lamp"};
    for (std::size_t i = 0; i < glows.size(); ++i) {
        const int light = add_material(scene, make_emitter(glow_names[i], glows[i]));
        Primitive lamp;
        lamp.material = light;
        constexpr float r = 0.12F;
        add_quad(lamp, {-r, 0, -r}, {r, 0, -r}, {r, 0, r}, {-r, 0, r});
        const int mesh = add_mesh(scene, glow_names[i], {lamp});
        for (int x = 0; x < cells; ++x) {
            for (int z = 0; z < cells; ++z) {
                if (std::size_t(x + 2 * z) % 4 == i && (x + z) % 2 == 0) {
                    add_instance(scene, "", mesh, place(x + 0.5, z + 0.5) * translation(0, double(height) - 0.01, 0));
                }
            }
        }
    }
    const double end = double(cell) * (cells / 2.0 - 0.3);
    scene.cameras.push_back(make_camera("camera", {0.25, 1.5, end}, {-0.25, 1.3, 0}, 60));
    return out;
}

}  // namespace diptych::core
