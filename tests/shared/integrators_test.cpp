#include "path/integrators.h"

#include "catch.h"

using namespace diptych::core::shared;

TEST_CASE("Every integrator does what its name says") {
    struct Row {
        uint integrator;
        bool material, lights, mis, resamples, reuses;
    };
    const Row rows[] = {{INTEGRATOR_BRDF, true, false, false, false, false},
                        {INTEGRATOR_DIRECT, false, true, false, false, false},
                        {INTEGRATOR_PATH, true, true, true, false, false},
                        {INTEGRATOR_RIS, true, true, true, true, false},
                        {INTEGRATOR_RESTIR, true, true, true, true, true}};
    for (const Row& row : rows) {
        CAPTURE(row.integrator);
        CHECK(samples_material(row.integrator) == row.material);
        CHECK(samples_lights(row.integrator) == row.lights);
        CHECK(weighs_by_mis(row.integrator) == row.mis);
        CHECK(resamples_lights(row.integrator) == row.resamples);
        CHECK(reuses_reservoirs(row.integrator) == row.reuses);
    }
}
