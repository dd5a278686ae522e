// The samples of a picture that earlier runs have left in files, and the files that this run leaves.
#pragma once

#include <future>
#include <optional>
#include <string>

#include "render/film_file.h"
#include "render/metadata.h"
#include "render/request.h"
#include "render/session.h"

namespace diptych::core::app {

/// What a user asks of the files beside a picture's own.
struct WorkFiles {
    std::string checkpoint;   // written as the picture grows; empty is none
    double every = 60;        // seconds between two of them
    std::string resume;       // samples to go on from; empty is what lies beside the output
    bool overwrite = false;   // begin anew, and replace whatever is there
    std::string fallback_folder;  // for what cannot be written to its place (save_picture.h)
};

/// "out.part.exr" for "out.png": where unfinished work goes.
std::string part_path(const std::string& output);

/// Samples per pixel that a picture's metadata tell; 0 where the file is missing or does not tell.
std::uint64_t samples_in(const std::string& path);

/// Throws Error where the output is a picture of more samples than are asked for, or one of its inputs.
void refuse_to_lose(const RenderRequest& request, const WorkFiles& files);

/// Samples to go on from.
struct KeptWork {
    std::string path;  // where they were; empty where there are none
    Film film;         // every pixel with the same samples
    std::uint32_t spp = 0;
    double seconds = 0;
    std::uint64_t look_at = 0;  // ProgressiveTarget's; 0 where it is not known
};

/// Samples of this picture that `files` or the part beside the output hold; the most that one file has. Where a run was
/// cut short within a sample, the session takes that sample of the pixels that lack it. `metadata` are those that the
/// picture will have. Throws Error where a file holds another picture, or more than is asked for.
KeptWork find_kept_work(Session& session, const RenderRequest& request, const WorkFiles& files,
                        const std::map<std::string, std::string>& metadata);

/// Writes films in the background.
class Checkpoints {
public:
    /// `write` may be called from another thread, one call at a time.
    Checkpoints(double every, std::function<void(const Film&)> write);
    ~Checkpoints();

    /// Writes a copy of the film if it is time and the one before has been written.
    void offer(const Film& film);

private:
    double every_;
    double next_;
    std::function<void(const Film&)> write_;
    std::future<void> writing_;
};

}  // namespace diptych::core::app
