// One picture on its way: what earlier runs have left of it, what becomes of it, and the files that it leaves.
#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <string>

#include "commands/render/kept_work.h"
#include "commands/render/save_picture.h"
#include "render/progressive.h"

namespace diptych::core::app {

class PictureWork {
public:
    /// All must live as long.
    PictureWork(Session& session, const RenderRequest& request, const WorkFiles& files);

    /// Looks for samples to go on from. Throws Error.
    void find_kept();
    const KeptWork& kept() const { return kept_; }

    /// Whether another process can go on with this picture. Frames that go on from one another are no such pictures:
    /// another process has not seen those before.
    bool resumable() const { return resumable_; }

    /// Samples that are to be in the picture; up to 2^32 - 1 where only the time is limited.
    SampleRange wanted() const;

    /// Whether samples are missing before some that were kept, as after a run of several ranks.
    bool has_gap() const;

    /// The first samples without a gap that are left to do; none where the samples that were kept are all.
    std::optional<ProgressiveTarget> target() const;

    /// Writes checkpoints of what it is shown, where they are asked for. The samples of target() are under way.
    std::function<void(const Film&)> checkpoints();

    /// Counts the samples of target(), which have been rendered, among those that were kept.
    void keep(const Film& film, const ProgressiveResult& result);

    /// The film with the samples that were kept.
    std::shared_ptr<const Film> whole(std::shared_ptr<const Film> film) const;

    /// How the render went, of which that whole film has come.
    RenderOutcome outcome_of(const ProgressiveResult& result, const Film& film, const std::string& device) const;

    /// The same of a film that has just these samples of every pixel, and where it is uneven more from a sample on.
    RenderOutcome outcome_of(const SampleRanges& samples, std::uint64_t uneven_from, const Film& film,
                             const std::string& device) const;

    /// Writes what is finished to the output, and what is not beside it.
    SavedPicture save(const Film& film, const RenderOutcome& outcome);

    /// Writes sums to any file, as a part that can be gone on with; from any thread, once fingerprint() was called.
    SavedPicture save_sums(const Film& film, const RenderOutcome& outcome, const std::string& path) const;

    /// Of the scene, for files with sums.
    const std::string& fingerprint();

    /// Where unfinished work is kept: the checkpoint, or the part beside the output.
    std::string unfinished() const { return checkpoint().empty() ? part_path(request_.output) : checkpoint(); }

    /// Puts what was kept into unfinished(), where it lies in parts of ranks or in several files.
    void gather_kept();

private:
    std::string checkpoint() const { return resumable_ ? files_.checkpoint : std::string(); }
    std::string unfinished_path(const RenderOutcome& outcome) const;
    void remove_kept_parts(const std::string& but) const;

    Session& session_;
    const RenderRequest& request_;
    const WorkFiles& files_;
    bool resumable_;
    std::string fingerprint_;
    KeptWork kept_;
};

}  // namespace diptych::core::app
