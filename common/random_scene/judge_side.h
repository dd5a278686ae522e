// One renderer's runs of a random scene, at rest or at the frames of its sequence.
#pragma once

#include <memory>
#include <vector>

#include "random_scene/judge.h"
#include "render/film_tiles.h"

namespace diptych::core {

class RandomSide {
public:
    /// `read` is the random scene as its file says it, and must live as long. Judges `frames`, in rising order; none: the scene at rest. Seeds
    /// begin with `first_seed`, one for each run and chain or frame.
    RandomSide(const RandomScene& random, const Scene& read, const MakeRenderer& make,
               const RenderSettings& settings, std::vector<std::uint32_t> frames, std::uint32_t runs,
               std::uint32_t first_seed);

    /// Adds samples to every run of every frame until it has so many. Where frames go on from one another, each sample
    /// is a chain of its own from frame 0 on, of one sample a frame.
    void extend_to(std::uint32_t spp);

    /// Of the frame at that place in `frames`; 0 at rest.
    const std::vector<RunMeans>& runs(std::size_t place) const { return runs_[place]; }
    std::uint32_t spp() const { return spp_; }
    std::uint64_t nonfinite() const { return nonfinite_; }

private:
    void render_still(std::size_t place, std::uint32_t spp);
    void play_chain(std::size_t run, std::uint32_t chain);
    void keep(std::size_t place, std::size_t run, std::uint32_t done, std::uint32_t samples);

    std::vector<std::uint32_t> frames_;
    std::uint32_t first_seed_;
    std::unique_ptr<Session> session_;
    std::vector<std::vector<RunMeans>> runs_;
    std::uint32_t spp_ = 0;
    std::uint64_t nonfinite_ = 0;
};

}  // namespace diptych::core
