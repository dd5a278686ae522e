// The samples of a picture that one of several processes takes.
#pragma once

#include "commands/render/picture_work.h"
#include "ranks/team.h"
#include "render/device_loss.h"

namespace diptych::core::app {

/// The session's film, and which samples it holds.
class RankShare {
public:
    /// All must live as long.
    RankShare(Team& team, Session& session, PictureWork& work, const WorkFiles& files, LossGuard& guard);

    /// Renders a block. A device that is lost takes the samples so far with it, and the other ranks are told; where it
    /// is not opened again, this rank gives up.
    void render(const SampleRange& block);

    /// A film without samples where this rank has given up.
    std::shared_ptr<const Film> film();

    /// Waits for a checkpoint that is being written.
    void finish_checkpoint() { checkpoints_.finish(); }

    /// Writes the samples as this rank's part; returns how many there are. Nothing is written where there are none.
    std::uint64_t save(double seconds);

private:
    struct Snapshot {
        std::shared_ptr<const Film> film;
        SampleRanges samples;
        std::uint64_t uneven_from = 0;
    };
    Snapshot snapshot();
    void write(const Snapshot& snapshot, double seconds) const;

    Team& team_;
    Session& session_;
    PictureWork& work_;
    LossGuard& guard_;
    bool keeps_checkpoints_;
    std::string path_;
    std::string device_;
    Checkpoints checkpoints_;
    SampleRanges samples_;             // whole blocks
    std::optional<SampleRange> begun_;  // a block that was cut short
    bool gave_up_ = false;
};

}  // namespace diptych::core::app
