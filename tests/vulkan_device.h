// The Vulkan device that tests run on, under validation where its layer is installed.
#pragma once

#include "catch.h"

namespace diptych::core::tests {

/// Whether a usable Vulkan device exists.
bool has_vulkan();

/// Whether the validation layer is installed. Where it is, every test of a device is one of validation too; where it is
/// not, only tests of the messages themselves are skipped.
bool has_validation_layer();

/// Fails on any validation message since the last call. Says LEFT OUT, and asserts nothing, where there is no layer.
void check_no_validation_messages();

}  // namespace diptych::core::tests

/// Leaves the test case where there is no device.
#define NEED_VULKAN()                                                                                                  \
    do {                                                                                                               \
        if (!diptych::core::tests::has_vulkan()) {                                                                     \
            SKIP_TEST("no Vulkan device with ray tracing; mesa-vulkan-drivers 24.3 or later brings one");              \
        }                                                                                                              \
    } while (false)

/// Leaves the test case where there is no device, or no validation layer for it.
#define NEED_VALIDATION()                                                                                              \
    do {                                                                                                               \
        NEED_VULKAN();                                                                                                 \
        if (!diptych::core::tests::has_validation_layer()) {                                                           \
            SKIP_TEST("the Vulkan validation layer is not installed (package vulkan-validationlayers)");               \
        }                                                                                                              \
    } while (false)
