// What the image tests share: a folder that goes away, noise with a seed, the message of an expected error.
#pragma once

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <random>
#include <string>

#include <unistd.h>

#include "catch.h"
#include "error.h"
#include "image/image.h"
#include "temporary_folder.h"

namespace diptych::core::image_tests {

#if DIPTYCH_CATCH_VERSION >= 3
using Catch::Approx;
#else
using Catch::Detail::Approx;
#endif

using tests::TemporaryFolder;

inline std::string bytes_of(const std::filesystem::path& path) {
    std::ifstream file(path, std::ios::binary);
    return {std::istreambuf_iterator<char>(file), {}};
}

inline Image random_image(int width, int height, int channels, unsigned seed, float low = 0.0f, float high = 1.0f) {
    std::mt19937 random(seed);
    std::uniform_real_distribution<float> uniform(low, high);
    Image image = make_image(width, height, channels);
    std::generate(image.data.begin(), image.data.end(), [&] { return uniform(random); });
    return image;
}

/// What the Error thrown by `call` says; empty if nothing was thrown.
template <typename Call>
std::string error_of(Call&& call) {
    try {
        call();
    } catch (const Error& error) {
        return error.what();
    }
    return {};
}

inline bool contains(const std::string& text, const std::string& part) {
    return text.find(part) != std::string::npos;
}

}  // namespace diptych::core::image_tests
