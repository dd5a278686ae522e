// Radiance pictures from their bytes: which way up they are, what their header says of radiance, both kinds of runs.
#include <array>
#include <cmath>
#include <cstdint>

#include "catch.h"
#include "image/atomic_file.h"
#include "image/layered_image.h"
#include "image_fixtures.h"

using namespace diptych::core;
using namespace diptych::core::image_tests;

namespace {

const std::string plain_header = "#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n\n";

/// Mantissas with the exponent of 1: (128, 128, 128) is 0.5^8 * 128 * 2 = 1.
std::string rgbe(int r, int g, int b, int e = 129) {
    return {static_cast<char>(r), static_cast<char>(g), static_cast<char>(b), static_cast<char>(e)};
}

Image read_bytes(const TemporaryFolder& folder, const std::string& bytes, const std::string& name = "a.hdr") {
    write_file_atomically(folder / name, bytes);
    return read_image(folder / name).color;
}

std::string refusal(const TemporaryFolder& folder, const std::string& bytes) {
    const std::string error = error_of([&] { read_bytes(folder, bytes); });
    CHECK(contains(error, "a.hdr: cannot read: "));
    CHECK_FALSE(contains(error, "\n"));
    return error;
}

std::array<float, 3> pixel_of(const TemporaryFolder& folder, const std::string& header, const std::string& pixel) {
    const Image image = read_bytes(folder, header + "-Y 1 +X 1\n" + pixel);
    REQUIRE(image.data.size() == 3);
    return {image.data[0], image.data[1], image.data[2]};
}

}  // namespace

TEST_CASE("a Radiance picture is upright whatever its resolution line", "[image]") {
    // Three columns, two rows; the red of the pixel at x, y is 16 * y + x + 64.
    struct Orientation {
        const char* line;
        std::array<int, 6> reds;  // in the order of the file
    };
    const std::vector<Orientation> orientations = {
        {"-Y 2 +X 3", {64, 65, 66, 80, 81, 82}}, {"-Y 2 -X 3", {66, 65, 64, 82, 81, 80}},
        {"+Y 2 +X 3", {80, 81, 82, 64, 65, 66}}, {"+Y 2 -X 3", {82, 81, 80, 66, 65, 64}},
        {"+X 3 -Y 2", {64, 80, 65, 81, 66, 82}}, {"-X 3 -Y 2", {66, 82, 65, 81, 64, 80}},
        {"+X 3 +Y 2", {80, 64, 81, 65, 82, 66}}, {"-X 3 +Y 2", {82, 66, 81, 65, 80, 64}},
    };
    const TemporaryFolder folder;
    for (const Orientation& orientation : orientations) {
        INFO(orientation.line);
        std::string bytes = plain_header + orientation.line + "\n";
        for (const int red : orientation.reds) {
            bytes += rgbe(red, 0, 0);
        }
        const Image image = read_bytes(folder, bytes);
        REQUIRE(image.width == 3);
        REQUIRE(image.height == 2);
        for (int y = 0; y < 2; ++y) {
            for (int x = 0; x < 3; ++x) {
                CHECK(image.at(x, y, 0) == static_cast<float>(16 * y + x + 64) / 128);
            }
        }
    }
}

TEST_CASE("EXPOSURE and COLORCORR of a Radiance picture are divided out", "[image]") {
    const TemporaryFolder folder;
    const std::string format = "FORMAT=32-bit_rle_rgbe\n";
    const auto read = [&](const std::string& lines) {
        return pixel_of(folder, "#?RADIANCE\n" + format + lines + "\n", rgbe(128, 64, 32));
    };
    CHECK(read("") == std::array<float, 3>{1, 0.5f, 0.25f});
    CHECK(read("EXPOSURE=4\n") == std::array<float, 3>{0.25f, 0.125f, 0.0625f});
    CHECK(read("EXPOSURE=4\npfilt -1\nEXPOSURE= 0.5\n") == std::array<float, 3>{0.5f, 0.25f, 0.125f});
    CHECK(read("EXPOSURE=2\nCOLORCORR=1 0.5 0.25\n") == std::array<float, 3>{0.5f, 0.5f, 0.5f});
    // Headers of the pictures that went into this one are indented, and say nothing of it.
    CHECK(read("\tEXPOSURE=4\nGAMMA=1\n# EXPOSURE=4\nPRIMARIES=0 0 0 0 0 0 0 0\nPIXASPECT=1\n") == std::array<float, 3>{1, 0.5f, 0.25f});
    CHECK(pixel_of(folder, plain_header, rgbe(128, 64, 32, 0)) == std::array<float, 3>{0, 0, 0});
}

TEST_CASE("colours of a Radiance picture become Rec.709", "[image]") {
    const TemporaryFolder folder;
    const auto close = [](const std::array<float, 3>& a, const std::array<double, 3>& b) {
        for (size_t c = 0; c < 3; ++c) {
            CHECK(a[c] == Approx(b[c]).margin(2e-3));
        }
    };
    const std::string xyze = "#?RADIANCE\nFORMAT=32-bit_rle_xyze\n\n";
    // The columns of IEC 61966-2-1, equation (7), from CIE XYZ to linear sRGB.
    close(pixel_of(folder, xyze, rgbe(128, 0, 0)), {3.2406, -0.9689, 0.0557});
    close(pixel_of(folder, xyze, rgbe(0, 128, 0)), {-1.5372, 1.8758, -0.2040});
    close(pixel_of(folder, xyze, rgbe(0, 0, 128)), {-0.4986, 0.0415, 1.0570});

    // Rec.2020 to Rec.709: ITU-R BT.2087-0, annex 2.
    const std::string wide = "#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n"
                             "PRIMARIES= 0.708 0.292 0.170 0.797 0.131 0.046 0.3127 0.3290\n\n";
    close(pixel_of(folder, wide, rgbe(128, 0, 0)), {1.6605, -0.1246, -0.0182});
    close(pixel_of(folder, wide, rgbe(0, 128, 0)), {-0.5876, 1.1329, -0.1006});
    close(pixel_of(folder, wide, rgbe(128, 128, 128)), {1, 1, 1});
}

TEST_CASE("runs of both kinds in Radiance pictures are read", "[image]") {
    const TemporaryFolder folder;
    // (1, 1, 1, n) repeats the last pixel n times, and 256 n times where it follows another run.
    const Image old_runs = read_bytes(folder, plain_header + "-Y 2 +X 300\n" + rgbe(64, 0, 0) + rgbe(1, 1, 1, 43) +
                                                  rgbe(1, 1, 1, 1) + rgbe(128, 0, 0) + rgbe(1, 1, 1, 2) +
                                                  rgbe(32, 0, 0) + rgbe(1, 1, 1, 40) + rgbe(1, 1, 1, 1));
    REQUIRE(old_runs.width == 300);
    CHECK(old_runs.at(0, 0, 0) == 0.5f);
    CHECK(old_runs.at(299, 0, 0) == 0.5f);
    CHECK(old_runs.at(2, 1, 0) == 1);
    CHECK(old_runs.at(3, 1, 0) == 0.25f);
    CHECK(old_runs.at(299, 1, 0) == 0.25f);

    const auto run = [](int count, int value) {
        return std::string{static_cast<char>(128 + count), static_cast<char>(value)};
    };
    const std::string literals = std::string("\x03", 1) + std::string("\x20\x40\x60", 3);
    const Image new_runs = read_bytes(folder, plain_header + "-Y 1 +X 8\n" + std::string("\2\2\0\x08", 4) + literals +
                                                  run(5, 128) + run(8, 64) + run(8, 0) + run(8, 129));
    CHECK(new_runs.at(1, 0, 0) == 0.5f);
    CHECK(new_runs.at(7, 0, 0) == 1);
    CHECK(new_runs.at(7, 0, 1) == 0.5f);
    CHECK(new_runs.at(7, 0, 2) == 0);
}

TEST_CASE("Radiance pictures that are wrong are refused by what is wrong", "[image]") {
    const TemporaryFolder folder;
    const auto header = [](const std::string& line) { return "#?RADIANCE\n" + line + "\n\n-Y 1 +X 1\n"; };
    const std::string pixel = rgbe(1, 2, 3), format = "FORMAT=32-bit_rle_rgbe\n";
    CHECK(contains(refusal(folder, header("EXPOSURE=1") + pixel), "no FORMAT line"));
    CHECK(contains(refusal(folder, header("FORMAT=ascii") + pixel), "'FORMAT=ascii' is neither"));
    CHECK(contains(refusal(folder, header(format + "EXPOSURE=0") + pixel), "'EXPOSURE=0' divides"));
    CHECK(contains(refusal(folder, header(format + "EXPOSURE=big") + pixel), "'EXPOSURE=big' wants 1 numbers"));
    CHECK(contains(refusal(folder, header(format + "COLORCORR=1 1") + pixel), "wants 3 numbers"));
    CHECK(contains(refusal(folder, header(format + "GAMMA=2.2") + pixel), "'GAMMA=2.2' says"));
    CHECK(contains(refusal(folder, header(format + "PRIMARIES=1 1 1 1 1 1 1 1") + pixel), "spans no colour space"));
    CHECK(contains(refusal(folder, "#?RADIANCE\n" + format), "the header has no end"));
    for (const std::string line :
         {"-Y 1 +Y 1", "-Y 0 +X 1", "-Y -1 +X 1", "Y 1 X 1", "-Y 1", "", "-Y 9999999999 +X 1"}) {
        CHECK(contains(refusal(folder, plain_header + line + "\n" + pixel), "the resolution line '" + line + "'"));
    }
    CHECK(contains(refusal(folder, plain_header + "-Y 2 +X 2\n" + pixel + pixel + pixel + rgbe(1, 1, 1, 9)),
                   "scanline 1 of 2: a run of pixels does not fit"));
    CHECK(contains(refusal(folder, plain_header + "-Y 2 +X 4\n" + pixel + pixel + pixel + pixel + pixel),
                   "scanline 1 of 2: the file ends early"));
    CHECK(contains(refusal(folder, plain_header + "-Y 1 +X 8\n" + std::string("\2\2\0\x09", 4) + pixel),
                   "scanline 0 of 1: its length is not that of the resolution line"));
    CHECK(contains(refusal(folder, plain_header + "-Y 1 +X 8\n" + std::string("\2\2\0\x08\0\0\0\0", 8)),
                   "scanline 0 of 1: a run of bytes does not fit"));
}

TEST_CASE("a Radiance picture that a few bytes claim to hold is refused before its memory is taken", "[image]") {
    const TemporaryFolder folder;
    const std::string two = rgbe(1, 2, 3) + rgbe(1, 1, 1, 255);
    CHECK(contains(refusal(folder, plain_header + "-Y 16000 +X 16000\n" + two),
                   "16000x16000 pixels take at least 128000 bytes, and the header is followed by 8"));
    CHECK(contains(refusal(folder, plain_header + "-Y 1 +X 2147483647\n" + two), "more than Diptych reads"));
    CHECK(contains(refusal(folder, plain_header + "-Y 1024 +X 131072\n" + std::string(8192, '\x7f')),
                   "cannot hold the 131072x1024 pixels that its header claims"));
}
