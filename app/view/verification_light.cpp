#include "view/verification_light.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "view/invalidation.h"

namespace diptych::core::app {

namespace {

constexpr double doubtful_from = 3;
constexpr double different_from = 4.5;
constexpr double rounding = 1e-5;  // of the means: what two compilers may make of the same sums

bool same_picture(const FilmFigures& a, const FilmFigures& b) {
    return a.version != 0 && a.version == b.version && a.width == b.width && a.height == b.height;
}

/// Of the largest of three, each two-sided.
double p_of_largest(double z) {
    const double one = std::erfc(z / std::sqrt(2.0));
    return -std::expm1(3 * std::log1p(-std::min(one, 1.0)));
}

Agreement judge(double z) {
    return z < doubtful_from ? Agreement::agree : z < different_from ? Agreement::doubtful : Agreement::differ;
}

const char* words(Agreement agreement) {
    return agreement == Agreement::agree ? "agree" : agreement == Agreement::doubtful ? "doubtful" : "differ";
}

}  // namespace

VerificationLight verification_light(const PanelShot& first, const PanelShot& second) {
    const FilmFigures& a = first.figures;
    const FilmFigures& b = second.figures;
    VerificationLight light;
    if (first.correlated || second.correlated) {
        light.agreement = Agreement::correlated;
        light.text = "no running test: the frames of restir are correlated";
        return light;
    }
    if (!same_picture(a, b) || a.spp < least_verified_samples || b.spp < least_verified_samples) {
        light.text = fmt::format("waiting for {} spp on both", least_verified_samples);
        return light;
    }
    if (!a.standard_error || !b.standard_error) {
        light.text = "no running test: there are no standard errors";
        return light;
    }
    for (std::size_t channel = 0; channel < light.z.size(); ++channel) {
        const double scale = std::max(std::abs(a.mean[channel]), std::abs(b.mean[channel]));
        const double error =
            std::hypot((*a.standard_error)[channel], (*b.standard_error)[channel], rounding * scale + 1e-12);
        light.z[channel] = (a.mean[channel] - b.mean[channel]) / error;
        light.largest = std::max(light.largest, std::abs(light.z[channel]));
    }
    light.p = p_of_largest(light.largest);
    light.agreement = judge(light.largest);
    light.text = fmt::format("z = {:.1f}: {}", light.largest, words(light.agreement));
    return light;
}

void ErrorHistory::add(const PanelShot& shot, double now) {
    const FilmFigures& figures = shot.figures;
    if (figures.version != version_) {
        const bool goes_on = !points_.empty() && figures.spp >= points_.back().spp && figures.version == shot.version &&
                             figures.width == width_ && invalidation(state_, shot.state) == Change::nothing;
        if (!goes_on) {
            points_.clear();
            begin_ = now;
        }
        version_ = figures.version;
        state_ = shot.state;
        width_ = figures.width;
    }
    const bool grown = points_.empty() || figures.spp > points_.back().spp;
    if (!figures.relmse || !grown || figures.spp < 2) {
        return;
    }
    points_.push_back({now - begin_, figures.spp, *figures.relmse});
    if (points_.size() > capacity_) {
        points_.pop_front();
    }
}

}  // namespace diptych::core::app
