// Standard streams that are closed, full or broken.
#include "catch.h"

#include <csignal>
#include <functional>

#include <fcntl.h>
#include <sys/wait.h>
#include <unistd.h>

#include <nlohmann/json.hpp>

#include "image/layered_image.h"
#include "process.h"

using namespace diptych::core;
using namespace diptych::core::tests;

namespace {

enum class Stream { file, closed, full, broken };

/// Puts the stream in the place of a descriptor of this process.
void place(Stream stream, int descriptor, const std::string& file) {
    int pipe_ends[2] = {-1, -1};
    int opened = -1;
    if (stream == Stream::broken && pipe(pipe_ends) == 0) {
        close(pipe_ends[0]);
        opened = pipe_ends[1];
    } else if (stream != Stream::closed) {
        opened = open(stream == Stream::full ? "/dev/full" : file.c_str(), O_WRONLY | O_CREAT | O_TRUNC, 0600);
    }
    close(descriptor);
    if (opened >= 0) {
        dup2(opened, descriptor);
        close(opened);
    }
}

ProcessResult run_with(const TemporaryFolder& folder, Stream out, Stream err, std::vector<std::string> words) {
    const std::string out_file = folder.file("out.txt"), err_file = folder.file("err.txt");
    words.insert(words.begin(), DIPTYCH_PROGRAM);
    write_text(out_file, "");
    write_text(err_file, "");
    const pid_t child = fork();
    if (child == 0) {
        std::signal(SIGPIPE, SIG_DFL);
        std::vector<char*> pointers;
        for (std::string& word : words) {
            pointers.push_back(word.data());
        }
        pointers.push_back(nullptr);
        if (out == Stream::closed && err == Stream::closed) {
            close(STDIN_FILENO);
        }
        place(out, STDOUT_FILENO, out_file);
        place(err, STDERR_FILENO, err_file);
        execv(pointers[0], pointers.data());
        _exit(127);
    }
    ProcessResult result;
    int status = 0;
    waitpid(child, &status, 0);
    result.exit_code = WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status);
    result.out = file_text(out_file);
    result.err = file_text(err_file);
    return result;
}

/// A render that has two warnings to give.
std::vector<std::string> render(const TemporaryFolder& folder) {
    std::filesystem::remove(folder.file("a.exr"));
    return {"render", write_bare_triangle(folder), "-o", folder.file("a.exr"), "--spp", "1", "--size", "16"};
}

void check_picture(const TemporaryFolder& folder) {
    CHECK(read_image(folder.file("a.exr")).color.width == 16);
}

constexpr const char* lost = "diptych: stdout: the results cannot be written: ";

}  // namespace

TEST_CASE("stderr that is closed, full or broken does not keep a render from its picture", "[app]") {
    const TemporaryFolder folder;
    for (const Stream err : {Stream::file, Stream::closed, Stream::full, Stream::broken}) {
        INFO("stream " << static_cast<int>(err));
        const ProcessResult result = run_with(folder, Stream::file, err, with(render(folder), {"--json"}));
        CHECK(result.exit_code == 0);
        CHECK(contains(result.err, "warning: ") == (err == Stream::file));
        CHECK(nlohmann::json::parse(result.out).at("spp") == 1);
        check_picture(folder);
    }
}

TEST_CASE("a log on a full disk does not keep a render from its picture", "[app]") {
    const TemporaryFolder folder;
    for (const Stream log : {Stream::closed, Stream::full}) {
        INFO("stream " << static_cast<int>(log));
        CHECK(run_with(folder, log, log, render(folder)).exit_code == 0);
        check_picture(folder);
    }
}

TEST_CASE("JSON that cannot be written is exit code 2, with the reason on stderr", "[app]") {
    const TemporaryFolder folder;
    const std::pair<Stream, std::string> cases[] = {{Stream::closed, "it is closed"},
                                                    {Stream::full, "No space left on device"},
                                                    {Stream::broken, "Broken pipe"}};
    for (const auto& [out, reason] : cases) {
        const ProcessResult result = run_with(folder, out, Stream::file, with(render(folder), {"--json"}));
        CHECK(result.exit_code == 2);
        CHECK(contains(result.err, lost + reason));
        check_picture(folder);
    }
}

TEST_CASE("a text of results that a full disk swallows is exit code 2, and a reader may leave early", "[app]") {
    const TemporaryFolder folder;
    for (const std::vector<std::string>& words :
         {std::vector<std::string>{"info", write_bare_triangle(folder)}, {"render", "--help"}, {"generate", "--list"}}) {
        INFO(words.front());
        CHECK(run_with(folder, Stream::file, Stream::file, words).exit_code == 0);
        const ProcessResult full = run_with(folder, Stream::full, Stream::file, words);
        CHECK(full.exit_code == 2);
        CHECK(contains(full.err, lost + std::string("No space left on device")));
        CHECK(run_with(folder, Stream::broken, Stream::file, words).exit_code == 0);
    }
}
