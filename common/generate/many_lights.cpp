// A street at night: two rows of houses with alleys between them, and N emitting triangles on fronts, alley walls and
// signs. Their power is log-uniform over six decades, and from any point most of them are hidden.
#include "error.h"
#include "generate/random.h"
#include "generate/scenes.h"
#include "generate/shapes.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>

namespace diptych::core {
namespace {

constexpr std::size_t palette_size = 48;
constexpr double decades = 6;
constexpr std::uint64_t most_emitters = 100'000'000;  // what one .bin and 32-bit indices hold with ease
constexpr double street_length = 150, half_street = 6;

/// A rectangle that bears emitters: corner, unit axes (u x v is its front), size in metres.
struct Panel {
    glm::dvec3 corner, u, v;
    double width, height;
    std::size_t building;

    std::uint64_t columns(double slot) const { return std::uint64_t(std::max(0.0, std::floor(width / slot))); }
    std::uint64_t slots(double slot) const {
        return columns(slot) * std::uint64_t(std::max(0.0, std::floor(height / slot)));
    }
};

struct Street {
    std::vector<Panel> panels;
    std::size_t buildings = 0;
};

glm::dmat4 box_placement(const glm::dvec3& low, const glm::dvec3& high) {
    glm::dmat4 out(1);
    for (int i = 0; i < 3; ++i) {
        out[i][i] = high[i] - low[i];
    }
    out[3] = glm::dvec4(low, 1);
    return out;
}

/// A sign across the front's normal; both its faces bear emitters.
void add_sign(Scene& scene, Street& street, int box, double side, double z, double low, double high) {
    const double near = side * (half_street - 0.03 + 0.05), far = side * (half_street - 1.4);
    const double left = std::min(near, far), right = std::max(near, far);
    add_instance(scene, "", box, box_placement({left, low, z - 0.1}, {right, high, z + 0.1}));
    const double width = right - left - 0.3;
    street.panels.push_back({{left + 0.15, low, z + 0.1}, {1, 0, 0}, {0, 1, 0}, width, high - low, street.buildings});
    street.panels.push_back({{right - 0.15, low, z - 0.1}, {-1, 0, 0}, {0, 1, 0}, width, high - low, street.buildings});
}

Street build_street(Scene& scene, GeneratorRandom& random) {
    Street street;
    const auto unit_box = [&](const char* name, const glm::vec3& color, float metallic, float roughness) {
        Primitive box;
        box.material = add_material(scene, make_material(name, color, metallic, roughness));
        add_box(box, glm::vec3(0), glm::vec3(1));
        return add_mesh(scene, name, {box});
    };
    const std::array<int, 4> houses{
        unit_box("brick", {0.42F, 0.2F, 0.14F}, 0, 0.9F), unit_box("plaster", {0.55F, 0.5F, 0.42F}, 0, 0.9F),
        unit_box("concrete", {0.35F, 0.35F, 0.36F}, 0, 0.8F), unit_box("slate", {0.16F, 0.19F, 0.24F}, 0, 0.5F)};
    const int ledge = unit_box("ledge", {0.3F, 0.29F, 0.27F}, 0, 0.8F);
    const int sign = unit_box("sign", {0.05F, 0.05F, 0.06F}, 0.9F, 0.35F);
    const int wall = unit_box("rear wall", {0.25F, 0.24F, 0.23F}, 0, 0.9F);
    Primitive ground;
    ground.material = add_material(scene, make_material("wet asphalt", {0.08F, 0.08F, 0.09F}, 0, 0.22F));
    add_quad(ground, {-40, 0, 30}, {40, 0, 30}, {40, 0, -190}, {-40, 0, -190});
    add_object(scene, "ground", {ground});

    for (const double side : {-1.0, 1.0}) {
        double z = 8;
        while (z > -street_length) {
            const double width = std::round(random.between(9, 14) * 4) / 4, depth = 13;
            const double height = std::round(random.between(11, 26) * 4) / 4;
            const double inner = side * half_street, outer = side * (half_street + depth);
            const double left = std::min(inner, outer), right = std::max(inner, outer);
            add_instance(scene, "", houses[random.below(houses.size())],
                         box_placement({left, -0.2, z - width}, {right, height, z}));
            for (double y = 3.6; y + 3 < height; y += 6.4) {
                add_instance(scene, "", ledge,
                             box_placement({std::min(inner - side * 0.5, inner + side * 0.2), y, z - width + 0.2},
                                           {std::max(inner - side * 0.5, inner + side * 0.2), y + 0.15, z - 0.2}));
            }
            const glm::dvec3 along(0, 0, side);  // the front's u axis, such that u x y faces the street
            street.panels.push_back(
                {{inner, 0.6, side > 0 ? z - width : z}, along, {0, 1, 0}, width, height - 1, street.buildings});
            street.panels.push_back({{left, 0.6, z}, {1, 0, 0}, {0, 1, 0}, depth, height - 1, street.buildings});
            street.panels.push_back(
                {{right, 0.6, z - width}, {-1, 0, 0}, {0, 1, 0}, depth, height - 1, street.buildings});
            add_sign(scene, street, sign, side, z - width * random.between(0.25, 0.75), 4.2, random.between(6.5, 9));
            ++street.buildings;
            z -= width + std::round(random.between(1.8, 3) * 4) / 4;
        }
        const double inner = side * (half_street + 14), outer = side * (half_street + 15);
        add_instance(scene, "", wall,
                     box_placement({std::min(inner, outer), -0.2, -180}, {std::max(inner, outer), 27, 12}));
    }
    add_instance(scene, "", wall, box_placement({-19.5, -0.3, -175}, {19.5, 24, -171}));
    return street;
}

/// Radiances over six decades, the strongest 1, each tint with a mean of 1 so that power goes by the level alone.
std::array<glm::vec3, palette_size> palette() {
    constexpr std::array<glm::dvec3, 6> tints{
        {{1, 0.75, 0.45}, {1, 0.55, 0.15}, {0.3, 0.9, 1}, {1, 0.25, 0.7}, {0.75, 0.85, 1}, {0.35, 1, 0.4}}};
    std::array<glm::vec3, palette_size> out;
    for (std::size_t i = 0; i < palette_size; ++i) {
        const glm::dvec3 tint = tints[(i * 5) % tints.size()];
        const double level = std::pow(10.0, decades * (double(i) / (palette_size - 1) - 1));
        out[i] = glm::vec3(tint * (3 * level / (tint.x + tint.y + tint.z)));
    }
    return out;
}

/// Which palette entry each rectangle has: one stratum each of the log-uniform distribution, shuffled.
std::vector<std::uint8_t> shuffled_levels(std::uint64_t count, GeneratorRandom& random) {
    std::vector<std::uint8_t> out(count);
    for (std::uint64_t i = 0; i < count; ++i) {
        out[i] = std::uint8_t(double(palette_size) * (double(i) + random.uniform()) / double(count));
    }
    for (std::uint64_t i = count; i > 1; --i) {
        std::swap(out[i - 1], out[random.below(i)]);
    }
    return out;
}

}  // namespace

GeneratedScene generate_many_lights(const GenerateOptions& options) {
    if (options.count < 1 || options.count > most_emitters) {
        throw Error("many-lights: `count` " + std::to_string(options.count) + " is not within 1 and " +
                    std::to_string(most_emitters));
    }
    GeneratedScene out;
    Scene& scene = out.scene;
    scene.name = "many-lights";
    GeneratorRandom random{options.seed};
    const Street street = build_street(scene, random);

    // Rectangles of two triangles, the last one halved where the count is odd, in slots of which a good third stay
    // dark.
    const std::uint64_t rectangles = (options.count + 1) / 2;
    double slot = 1.6;
    const auto slots = [&] {
        return std::accumulate(street.panels.begin(), street.panels.end(), std::uint64_t(0),
                               [&](std::uint64_t sum, const Panel& panel) { return sum + panel.slots(slot); });
    };
    while (slots() < rectangles + rectangles * 3 / 5) {
        slot *= 0.97;
    }
    const double width = 0.55 * slot, height = 0.7 * slot;

    // The whole street receives about the same power whatever the count; log-uniform levels have a mean of about max /
    // ln(10^6).
    constexpr double street_power = 3e4;  // W
    const double mean_level = (1 - std::pow(10.0, -decades)) / (decades * std::log(10.0));
    const double strongest =
        street_power / (3.14159265358979 * width * height * double(options.count) / 2 * mean_level);
    std::array<int, palette_size> materials{};
    const auto radiances = palette();
    for (std::size_t i = 0; i < palette_size; ++i) {
        materials[i] =
            add_material(scene, make_emitter("light " + std::to_string(i + 1), float(strongest) * radiances[i]));
    }

    const std::vector<std::uint8_t> levels = shuffled_levels(rectangles, random);
    std::vector<std::array<Primitive, palette_size>> emitters(street.buildings);
    std::uint64_t slots_left = slots(), wanted = rectangles;
    for (const Panel& panel : street.panels) {
        const std::uint64_t columns = panel.columns(slot), count = panel.slots(slot);
        for (std::uint64_t i = 0; i < count; ++i, --slots_left) {
            if (double(wanted) <= random.uniform() * double(slots_left)) {
                continue;  // selection sampling: exactly `wanted`
            }
            --wanted;
            Primitive& primitive = emitters[panel.building][levels[wanted]];
            constexpr double before_wall = 0.02;
            const glm::dvec3 corner = panel.corner + before_wall * glm::cross(panel.u, panel.v) +
                                      panel.u * (slot * (double(i % columns) + 0.225)) +
                                      panel.v * (slot * (double(i / columns) + 0.15));
            const glm::dvec3 across = width * panel.u, up = height * panel.v;
            add_quad(primitive, corner, corner + across, corner + across + up, corner + up);
            if (wanted == 0 && options.count % 2 == 1) {
                primitive.triangles.pop_back();
                primitive.positions.pop_back();
            }
        }
    }
    for (std::size_t building = 0; building < emitters.size(); ++building) {
        std::vector<Primitive> primitives;
        for (std::size_t i = 0; i < palette_size; ++i) {
            if (emitters[building][i].triangles.empty()) {
                continue;
            }
            emitters[building][i].material = materials[i];
            primitives.push_back(std::move(emitters[building][i]));
        }
        if (!primitives.empty()) {
            add_object(scene, "lights " + std::to_string(building + 1), std::move(primitives));
        }
    }
    scene.cameras.push_back(make_camera("camera", {2.2, 1.8, 4}, {-1.2, 4.2, -40}, 55));
    scene.cameras.push_back(make_camera("roofs", {0, 34, 26}, {0, 2, -50}, 50));
    return out;
}

}  // namespace diptych::core
