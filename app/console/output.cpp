#include "console/output.h"

#include <atomic>
#include <cerrno>
#include <cstring>

#include <poll.h>
#include <unistd.h>

#include "console/process_start.h"

namespace diptych::core::app {

namespace {

constexpr int message_patience_milliseconds = 100;
constexpr int no_limit = -1;

std::atomic<bool> silent = false;
int loss = 0;  // an errno: of the first result that was lost

/// False where the stream stays full for so long. It can be set not to block by another process that has it too.
bool await_space(int stream, int milliseconds) {
    pollfd wanted = {stream, POLLOUT, 0};
    const int ready = poll(&wanted, 1, milliseconds);
    return ready > 0 || (ready < 0 && errno == EINTR);
}

/// 0, or the errno of what went wrong.
int write_all(int stream, std::string_view text, int patience) {
    while (!silent && !text.empty()) {
        const ssize_t written = ::write(stream, text.data(), text.size());
        if (written >= 0) {
            text.remove_prefix(static_cast<std::size_t>(written));
        } else if (errno == EAGAIN ? !await_space(stream, patience) : errno != EINTR) {
            return errno;
        }
    }
    return 0;
}

void note_loss(int code) {
    loss = loss == 0 ? code : loss;
}

}  // namespace

void write_message(std::string_view text) {
    write_all(STDERR_FILENO, text, message_patience_milliseconds);
}

void write_note(std::string_view text) {
    write_all(STDOUT_FILENO, text, message_patience_milliseconds);
}

void write_result(std::string_view text) {
    const int code = write_all(STDOUT_FILENO, text, no_limit);
    note_loss(code == EPIPE ? 0 : code);
}

void write_data(std::string_view text) {
    note_loss(stdout_was_closed() && !silent ? EBADF : write_all(STDOUT_FILENO, text, no_limit));
}

void silence_output() {
    silent = true;
}

std::string reason_of_loss() {
    return loss == 0 ? "" : loss == EBADF ? "it is closed" : std::strerror(loss);
}

}  // namespace diptych::core::app
