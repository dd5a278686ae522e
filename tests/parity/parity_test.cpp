// Level 0: every shared function gives on the device what it gives in C++.
#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <string>

#include "catch.h"
#include "pipelines/compute_shader.h"
#include "probe_inputs.h"
#include "probe_list.h"
#include "memory/readback.h"
#include "test_shader_binaries.h"
#include "memory/upload.h"
#include "vulkan_device.h"

namespace diptych::core::tests {
namespace {

using shared::ProbeInput;
using shared::ProbeOutput;

struct Probe {
    const char* name;
    double bound;
    double diverging;
    const char* why;
    void (*run)(const ProbeInput&, ProbeOutput&);
};

#define ENTRY(name, bound, diverging, why) {#name, bound, diverging, why, shared::probe_##name},

/// The probes of one shader.
struct Group {
    const char* shader;
    std::vector<Probe> probes;
};

std::vector<Group> all_groups() {
    return {{"parity_numbers.comp", {NUMBER_PROBES(ENTRY)}},
            {"parity_sampling.comp", {SAMPLING_PROBES(ENTRY)}},
            {"parity_bsdf.comp", {BSDF_PROBES(ENTRY)}},
            {"parity_surface.comp", {SURFACE_PROBES(ENTRY)}},
            {"parity_resampling.comp", {RESAMPLING_PROBES(ENTRY)}}};
}

struct Difference {
    std::uint64_t inexact = 0;    // words that should be the same and are not
    std::uint64_t diverged = 0;   // inputs whose path differs
    std::uint64_t too_sharp = 0;  // inputs some of whose values were left out
    double largest = 0;           // in 2^-23 of the scale
    std::uint32_t worst_input = 0;
    std::uint32_t worst_value = 0;
};

/// In units of 2^-23 of the scale. What differs by less than the least normal number does not: denormals may be
/// flushed.
double units_apart(float device, float host, float scale) {
    if (device == host || (std::isnan(device) && std::isnan(host))) {
        return 0;
    }
    const double apart = std::abs(static_cast<double>(device) - static_cast<double>(host));
    if (!std::isfinite(apart)) {
        return INFINITY;
    }
    return apart < 0x1p-126 ? 0 : apart / (static_cast<double>(scale) * 0x1p-23);
}

void compare(const ProbeOutput& device, const ProbeOutput& host, std::uint32_t input, Difference& d) {
    if (device.path != host.path) {
        ++d.diverged;
        return;
    }
    if (device.exact_count != host.exact_count || device.value_count != host.value_count) {
        ++d.inexact;
        return;
    }
    d.too_sharp += host.too_sharp;
    for (std::uint32_t i = 0; i < host.exact_count; ++i) {
        if (device.exact[i] != host.exact[i]) {
            ++d.inexact;
            d.worst_input = input;
            d.worst_value = i;
        }
    }
    for (std::uint32_t i = 0; i < host.value_count; ++i) {
        const double apart = units_apart(device.value[i], host.value[i], host.scale[i]);
        if (!(apart <= d.largest)) {
            d.largest = std::isnan(apart) ? INFINITY : apart;
            d.worst_input = input;
            d.worst_value = i;
        }
    }
}

Difference compare_outputs(const Probe& probe, std::span<const ProbeInput> inputs,
                           std::span<const ProbeOutput> outputs) {
    Difference difference;
    for (std::uint32_t i = 0; i < inputs.size(); ++i) {
        ProbeOutput host{};
        probe.run(inputs[i], host);
        compare(outputs[i], host, i, difference);
    }
    return difference;
}

std::string described(const ProbeInput& p) {
    std::string text;
    for (std::size_t i = 0; i < sizeof(p) / 4; ++i) {
        char word[40];
        const auto bits = reinterpret_cast<const std::uint32_t*>(&p)[i];
        std::snprintf(word, sizeof(word), "%s%g", i % 8 == 0 ? "\n  " : " ",
                      static_cast<double>(std::bit_cast<float>(bits)));
        text += word;
    }
    return text;
}

void add(Difference& all, const Difference& d) {
    all.inexact += d.inexact;
    all.diverged += d.diverged;
    all.too_sharp += d.too_sharp;
    all.largest = std::max(all.largest, d.largest);
}

/// The group's probes over `count` inputs, in batches.
std::vector<Difference> compare_group(const Gpu& gpu, const Group& group, std::uint32_t seed, std::uint32_t count) {
    constexpr std::uint32_t batch = 1U << 17U;
    ComputeShader shader(gpu, test_shader_binary(group.shader), 2);
    std::vector<Difference> all(group.probes.size());
    for (std::uint32_t done = 0; done < count; done += batch) {
        const std::vector<ProbeInput> inputs = make_probe_inputs(seed + done, std::min(batch, count - done));
        Uploader uploader(gpu);
        const Buffer input_buffer =
            upload_array(gpu, uploader, Purpose::other, std::span(inputs), vk::BufferUsageFlagBits::eStorageBuffer);
        uploader.finish();
        const Buffer output_buffer = make_storage(gpu, inputs.size() * sizeof(ProbeOutput));
        const Buffer* const buffers[] = {&input_buffer, &output_buffer};
        for (std::uint32_t i = 0; i < group.probes.size(); ++i) {
            const Probe& probe = group.probes[i];
            shader.run(buffers, static_cast<std::uint32_t>(inputs.size()), i);
            const Difference d = compare_outputs(probe, inputs, read_array<ProbeOutput>(gpu, output_buffer));
            INFO(probe.name << ": value " << d.worst_value << " of input " << d.worst_input
                            << described(inputs[d.worst_input]));
            CHECK(d.inexact == 0);
            CHECK(d.largest <= probe.bound);
            add(all[i], d);
        }
    }
    return all;
}

/// Prints the table where asked to.
void check_parity(std::uint32_t seed, std::uint32_t count, bool print) {
    const auto opened = open_gpu({.device = "", .validation = has_validation_layer()});
    const Gpu& gpu = *opened;
    for (const Group& group : all_groups()) {
        const std::vector<Difference> differences = compare_group(gpu, group, seed, count);
        for (std::uint32_t i = 0; i < group.probes.size(); ++i) {
            const Probe& probe = group.probes[i];
            const Difference& d = differences[i];
            INFO(probe.name << ": of " << count << ", " << d.diverged << " took another path, " << d.too_sharp
                            << " were too sharp to compare");
            CHECK(static_cast<double>(d.diverged) <= probe.diverging * 1e-6 * count + (probe.diverging > 0 ? 4 : 0));
            CHECK(d.too_sharp < count / 3);
            if (print) {
                const double per_million = 1e6 / count;
                std::printf("| %s | %g | %.3g | %g | %.3g | %.3g | %s |\n", probe.name, probe.bound, d.largest,
                            probe.diverging, static_cast<double>(d.diverged) * per_million,
                            static_cast<double>(d.too_sharp) * per_million, probe.why);
            }
        }
    }
    check_no_validation_messages();
}

}  // namespace

TEST_CASE("Every shared function gives on the device what it gives in C++") {
    NEED_VULKAN();
    check_parity(1, 1U << 15U, std::getenv("DIPTYCH_TABLE") != nullptr);
}

TEST_CASE("Every shared function gives on the device what it gives in C++, over 4 million inputs", "[nightly]") {
    NEED_VULKAN();
    check_parity(1000, 1U << 22U, true);
}

}  // namespace diptych::core::tests
