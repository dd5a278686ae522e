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

    /// What is left to do; none where the samples that were kept are all.
    std::optional<ProgressiveTarget> target() const;

    /// Writes checkpoints of what it is shown, where they are asked for.
    std::function<void(const Film&)> checkpoints();

    /// The film with the samples that were kept.
    std::shared_ptr<const Film> whole(std::shared_ptr<const Film> film) const;

    /// How the render went, of which that whole film has come.
    RenderOutcome outcome_of(const ProgressiveResult& result, const Film& film, const std::string& device) const;

    /// Writes what is finished to the output, and what is not beside it.
    SavedPicture save(const Film& film, const RenderOutcome& outcome);

private:
    std::string checkpoint() const { return resumable_ ? files_.checkpoint : std::string(); }
    const std::string& fingerprint();
    std::string unfinished_path(const RenderOutcome& outcome) const;

    Session& session_;
    const RenderRequest& request_;
    const WorkFiles& files_;
    bool resumable_;
    std::string fingerprint_;
    KeptWork kept_;
};

}  // namespace diptych::core::app
