// The Cornell box with one of its light's two triangles broken behind the importer's back: light samples of it are no
// radiance, and all else is sound.
#pragma once

#include "render_fixture.h"

namespace diptych::core::tests {

/// 32x24 pixels, direct light only. Rays that hit the light see the material, which is whole.
inline PackedScene packed_with_broken_light(Integrator integrator, std::uint32_t max_depth, float radiance) {
    RenderSettings settings = statistical_settings(32, 24, integrator, max_depth);
    settings.standard_error = false;
    PackedScene packed = pack_scene(load_own_scene("cornell"), settings);
    packed.emissive_triangles.at(0).radiance =
        shared::vec3(radiance, packed.emissive_triangles[0].radiance.y, radiance);
    return packed;
}

inline Film render_cpu(const PackedScene& packed, std::uint32_t spp) {
    const auto renderer = make_cpu_renderer(packed, 2);
    const std::atomic<bool> cancel{false};
    renderer->render(0, spp, cancel);
    return renderer->film();
}

/// What the film of a render of the broken light owes: samples dropped and counted, and nothing of them in what is
/// kept. `dark` is the film of the same scene and seed where the broken triangle is black in the channels that were
/// broken.
inline void check_drops(const Film& broken, const Film& dark, std::uint32_t spp) {
    const FilmTotals totals = film_totals(broken);
    const std::uint64_t all = broken.pixels.size() * spp;
    CHECK(totals.samples + totals.nonfinite == all);
    CHECK(totals.nonfinite > all / 10);
    CHECK(totals.nonfinite < all * 6 / 10);
    std::size_t unlike = 0;
    for (std::size_t i = 0; i < broken.pixels.size(); ++i) {
        const shared::FilmPixel& a = broken.pixels[i];
        const shared::FilmPixel& b = dark.pixels[i];
        CHECK(b.nonfinite == 0);
        // Dropped samples were black in the other film's red and blue, so those sums are equal to the bit.
        unlike += rounded(a.sum)[0] != rounded(b.sum)[0] || rounded(a.sum)[2] != rounded(b.sum)[2] || a.samples + a.nonfinite != spp ? 1 : 0;
    }
    CHECK(unlike == 0);
}

}  // namespace diptych::core::tests
