#include "pack/emission_mean.h"

#include <cassert>

#include "leaves.h"

namespace diptych::core {
namespace shared {
namespace {

/// The hooks of hooks.md that reading a material needs; it traces nothing.
struct EmissionKernel {
    const PackedScene& packed;
    const RenderConstants& constants;

    bool feature(uint bit) const { return (packed.features & bit) != 0; }
    uint features() const { return packed.features; }

#define DEFINE_LOAD(Type, name)                                                                                        \
    const Type& load_##name(uint index) const {                                                                        \
        assert(index < packed.name.size());                                                                            \
        return packed.name[index];                                                                                     \
    }
    SCENE_BUFFERS(DEFINE_LOAD)
#undef DEFINE_LOAD

#define RECORD(field, value)
#include "lights/emission.kernel.h"
#undef RECORD
};

}  // namespace
}  // namespace shared

double EmissionMean::luminance(const shared::EmissiveTriangle& light) const {
    shared::EmissionKernel kernel{packed_, packed_.constants};
    // A fixed lattice over the triangle: the R2 sequence (Roberts 2018), folded along the diagonal.
    constexpr int count = 64;
    double sum = 0;
    for (int i = 0; i < count; ++i) {
        double u = 0.5 + i * 0.7548776662466927;
        double v = 0.5 + i * 0.5698402909980532;
        u -= static_cast<int>(u);
        v -= static_cast<int>(v);
        const bool fold = u + v > 1;
        const glm::vec2 barycentrics(fold ? 1 - u : u, fold ? 1 - v : v);
        sum += shared::luminance(kernel.emitter_radiance(light, barycentrics));
    }
    return sum / count;
}

}  // namespace diptych::core
