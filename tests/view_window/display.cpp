#include "display.h"

#include <fcntl.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <sstream>
#include <stdexcept>

namespace diptych::core::tests {

namespace {

bool is_installed(const std::string& program) {
    std::istringstream folders(std::getenv("PATH") != nullptr ? std::getenv("PATH") : "");
    for (std::string folder; std::getline(folders, folder, ':');) {
        if (access((std::filesystem::path(folder) / program).c_str(), X_OK) == 0) {
            return true;
        }
    }
    return false;
}

[[noreturn]] void become(std::vector<std::string> words) {
    std::vector<char*> pointers;
    for (std::string& word : words) {
        pointers.push_back(word.data());
    }
    pointers.push_back(nullptr);
    execvp(pointers[0], pointers.data());
    _exit(127);
}

std::string read_all(int descriptor, char until) {
    std::string text;
    for (char c = 0; read(descriptor, &c, 1) == 1 && c != until;) {
        text += c;
    }
    return text;
}

}  // namespace

bool has_virtual_display() {
    return is_installed("Xvfb") && is_installed("xdotool");
}

VirtualDisplay::VirtualDisplay(int width, int height) {
    std::array<int, 2> ends{};
    if (pipe(ends.data()) != 0) {
        throw std::runtime_error("no pipe");
    }
    child_ = fork();
    if (child_ == 0) {
        close(ends[0]);
        const int nowhere = open("/dev/null", O_WRONLY);
        dup2(nowhere, STDERR_FILENO);
        become({"Xvfb", "-displayfd", std::to_string(ends[1]), "-screen", "0",
                std::to_string(width) + "x" + std::to_string(height) + "x24", "-nolisten", "tcp", "-noreset"});
    }
    close(ends[1]);
    const std::string number = read_all(ends[0], '\n');  // once the display takes programs; empty where it has ended
    close(ends[0]);
    name_ = number.empty() ? "" : ":" + number;
}

VirtualDisplay::~VirtualDisplay() {
    kill(child_, SIGTERM);
    waitpid(child_, nullptr, 0);
}

std::string VirtualDisplay::hand(const std::vector<std::string>& arguments) const {
    std::array<int, 2> ends{};
    if (pipe(ends.data()) != 0) {
        throw std::runtime_error("no pipe");
    }
    const int child = fork();
    if (child == 0) {
        setenv("DISPLAY", name_.c_str(), 1);
        dup2(ends[1], STDOUT_FILENO);
        close(ends[0]);
        close(ends[1]);
        std::vector<std::string> words = {"xdotool"};
        words.insert(words.end(), arguments.begin(), arguments.end());
        become(std::move(words));
    }
    close(ends[1]);
    std::string text = read_all(ends[0], '\0');
    close(ends[0]);
    waitpid(child, nullptr, 0);
    while (!text.empty() && text.back() == '\n') {
        text.pop_back();
    }
    return text;
}

}  // namespace diptych::core::tests
