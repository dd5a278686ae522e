#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include "commands/arguments/arguments.h"
#include "error.h"

namespace diptych::core::app {

namespace {

using Numbers = std::vector<double>;

/// An option of three numbers between commas.
CLI::Option* add_triple(CLI::App& command, const char* name, const char* type, const char* help,
                        const std::function<void(const glm::dvec3&)>& take) {
    return command
        .add_option_function<Numbers>(
            name,
            [take](const Numbers& n) {
                take({n[0], n[1], n[2]});
            },
            help)
        ->type_name(type)
        ->delimiter(',')
        ->expected(3)
        ->check(finite_number());
}

Sun sun_of(const glm::dvec3& numbers) {
    if (!ranges::sun_elevation.accepted.holds(numbers.y) || !ranges::sun_irradiance.accepted.holds(numbers.z)) {
        throw Error(fmt::format("--sun {},{},{}: needs an elevation from -90 to 90 degrees and an irradiance from 0 up",
                                numbers.x, numbers.y, numbers.z));
    }
    return {.azimuth = numbers.x, .elevation = numbers.y, .irradiance = numbers.z};
}

}  // namespace

void add_viewpoint_options(CLI::App& command, RenderArguments& arguments) {
    RenderRequest& request = arguments.request;
    Viewpoint& viewpoint = request.viewpoint;
    add_triple(command, "--eye", "X,Y,Z", "Camera position, metres; use with --look-at",
               [&](const glm::dvec3& point) { viewpoint.eye = point; });
    add_triple(command, "--look-at", "X,Y,Z", "Point that the camera looks at, metres",
               [&](const glm::dvec3& point) { viewpoint.look_at = point; });
    add_triple(command, "--up", "X,Y,Z", "Up direction of the picture; default: 0,1,0",
               [&](const glm::dvec3& direction) { viewpoint.up = direction; });
    command
        .add_option(option_of(ranges::fov), viewpoint.fov, "Vertical field of view of a perspective camera, degrees")
        ->check(accepted_by(ranges::fov));
    command
        .add_option(option_of(ranges::view_height), viewpoint.view_height,
                    "Height of an orthographic camera's view, metres")
        ->check(accepted_by(ranges::view_height));
    add_triple(command, "--sun", "AZIMUTH,ELEVATION,IRRADIANCE",
               "Directional light: azimuth from -Z toward +X and elevation in degrees, irradiance in W/m^2",
               [&](const glm::dvec3& numbers) { request.sun = sun_of(numbers); });
}

}  // namespace diptych::core::app
