#include <bit>
#include <cmath>
#include <csignal>
#include <cstdint>
#include <limits>

#include <sys/resource.h>

#include "catch.h"
#include "image/atomic_file.h"
#include "image/layered_image.h"
#include "image_fixtures.h"

using namespace diptych::core;
using namespace diptych::core::image_tests;

namespace {

bool same_bits(const Image& a, const Image& b) {
    return a.same_shape(b) && a.data.size() == b.data.size() &&
           std::equal(a.data.begin(), a.data.end(), b.data.begin(),
                      [](float x, float y) { return std::bit_cast<uint32_t>(x) == std::bit_cast<uint32_t>(y); });
}

LayeredImage all_layers(int width, int height) {
    LayeredImage layers;
    layers.color = random_image(width, height, 3, 1, -1.0f, 1e6f);
    layers.standard_error = random_image(width, height, 3, 2);
    layers.albedo = random_image(width, height, 3, 3);
    layers.normal = random_image(width, height, 3, 4, -1.0f, 1.0f);
    layers.depth = random_image(width, height, 1, 5, 0.0f, 1e9f);
    layers.metadata = {{"scene", "a \"quoted\" name.gltf"},
                       {"seed", "42"},
                       {"lines", "one\ntwo\\three\t"},
                       {"with space:x", "naïve"},
                       {"long", std::string(5000, 'x')}};
    return layers;
}

/// While it lives, no file of this process grows past the given size, as on a full disk.
class FileSizeLimit {
public:
    explicit FileSizeLimit(rlim_t bytes) {
        old_handler_ = std::signal(SIGXFSZ, SIG_IGN);
        getrlimit(RLIMIT_FSIZE, &old_limit_);
        const rlimit limit{bytes, old_limit_.rlim_max};
        setrlimit(RLIMIT_FSIZE, &limit);
    }
    FileSizeLimit(const FileSizeLimit&) = delete;
    FileSizeLimit& operator=(const FileSizeLimit&) = delete;
    ~FileSizeLimit() {
        setrlimit(RLIMIT_FSIZE, &old_limit_);
        std::signal(SIGXFSZ, old_handler_);
    }

private:
    rlimit old_limit_{};
    void (*old_handler_)(int);
};

}  // namespace

TEST_CASE("EXR keeps every layer, every bit and the metadata", "[image]") {
    const TemporaryFolder folder;
    LayeredImage written = all_layers(37, 21);
    const float specials[] = {0.0f,
                              -0.0f,
                              1e-42f,
                              -3e38f,
                              std::numeric_limits<float>::infinity(),
                              -std::numeric_limits<float>::infinity(),
                              std::numeric_limits<float>::quiet_NaN()};
    std::copy(std::begin(specials), std::end(specials), written.color.data.begin() + 5);
    std::copy(std::begin(specials), std::end(specials), written.depth->data.begin() + 9);
    write_exr(folder / "a.exr", written);
    const LayeredImage read = read_image(folder / "a.exr");

    CHECK(same_bits(read.color, written.color));
    REQUIRE((read.standard_error && read.albedo && read.normal && read.depth));
    CHECK(same_bits(*read.standard_error, *written.standard_error));
    CHECK(same_bits(*read.albedo, *written.albedo));
    CHECK(same_bits(*read.normal, *written.normal));
    CHECK(same_bits(*read.depth, *written.depth));
    CHECK(read.metadata == written.metadata);
    CHECK(folder.file_count() == 1);

    write_exr(folder / "again.exr", written);
    CHECK(bytes_of(folder / "a.exr") == bytes_of(folder / "again.exr"));
    CHECK(read_raw(folder / "a.exr").attributes.count("DateTime") == 0);
}

TEST_CASE("EXR without layers reads as colour alone", "[image]") {
    const TemporaryFolder folder;
    LayeredImage written;
    written.color = random_image(5, 3, 3, 7);
    written.metadata = {{"seed", "1"}, {"empty", ""}};
    write_exr(folder / "a.exr", written);
    const LayeredImage read = read_image(folder / "a.exr");
    CHECK(same_bits(read.color, written.color));
    CHECK_FALSE((read.standard_error || read.albedo || read.normal || read.depth));
    CHECK(read.metadata == std::map<std::string, std::string>{{"seed", "1"}});
}

TEST_CASE("PNG holds display values within half a code and reads as linear", "[image]") {
    const TemporaryFolder folder;
    Image display = random_image(64, 48, 3, 11, -0.2f, 1.2f);
    display.data[0] = std::numeric_limits<float>::quiet_NaN();
    display.data[1] = std::numeric_limits<float>::infinity();
    write_png(folder / "a.PNG", display);
    const RawImage raw = read_raw(folder / "a.PNG");
    const LayeredImage read = read_image(folder / "a.PNG");
    REQUIRE(raw.srgb_encoded);
    REQUIRE(raw.image.same_shape(display));
    CHECK(raw.image.data[0] == 0.0f);
    CHECK(raw.image.data[1] == 1.0f);
    float worst = 0.0f;
    bool decoded = true;
    for (size_t i = 2; i < display.data.size(); ++i) {
        worst = std::max(worst, std::abs(raw.image.data[i] - std::clamp(display.data[i], 0.0f, 1.0f)));
        decoded = decoded && read.color.data[i] == srgb_decoded(raw.image.data[i]);
    }
    CHECK(worst <= 0.5f / 255.0f + 1e-6f);
    CHECK(decoded);
}

TEST_CASE("Grey PNG reads as three equal channels", "[image]") {
    const TemporaryFolder folder;
    write_png(folder / "grey.png", make_image(3, 2, 1, 128.0f / 255.0f));
    const LayeredImage read = read_image(folder / "grey.png");
    REQUIRE(read.color.channels == 3);
    for (const float value : read.color.data) {
        CHECK(value == Approx(0.2158605).epsilon(1e-5));
    }
}

TEST_CASE("sRGB decoding matches IEC 61966-2-1", "[image]") {
    CHECK(srgb_decoded(0.0f) == 0.0f);
    CHECK(srgb_decoded(1.0f) == 1.0f);
    CHECK(srgb_decoded(0.04f) == Approx(0.04 / 12.92).epsilon(1e-6));
    CHECK(srgb_decoded(0.5f) == Approx(0.21404114).epsilon(1e-6));
}

TEST_CASE("HDR keeps linear values to the precision of its shared exponent", "[image]") {
    const TemporaryFolder folder;
    Image linear = random_image(33, 17, 3, 13, 0.0f, 50.0f);
    linear.data[0] = -1.0f;
    linear.data[1] = std::numeric_limits<float>::quiet_NaN();
    linear.data[5] = 2.0e4f;
    write_hdr(folder / "a.hdr", linear);
    const Image read = read_image(folder / "a.hdr").color;
    REQUIRE(read.same_shape(linear));
    CHECK(read.data[0] == 0.0f);
    CHECK(read.data[1] == 0.0f);
    bool close = true;
    for (int y = 0; y < linear.height; ++y) {
        for (int x = 1; x < linear.width; ++x) {
            const float largest = std::max({linear.at(x, y, 0), linear.at(x, y, 1), linear.at(x, y, 2)});
            for (int channel = 0; channel < 3; ++channel) {
                close = close && std::abs(read.at(x, y, channel) - linear.at(x, y, channel)) <= largest / 128.0f;
            }
        }
    }
    CHECK(close);
}

TEST_CASE("Unreadable pictures are refused with file and reason", "[image]") {
    const TemporaryFolder folder;
    const auto refusal = [](const std::filesystem::path& path) { return error_of([&] { read_image(path); }); };
    CHECK(contains(refusal(folder / "none.exr"), "none.exr: cannot read: no such file"));
    CHECK(contains(refusal(folder / "."), "it is a folder"));
    write_file_atomically(folder / "text.exr", "not a picture");
    CHECK(contains(refusal(folder / "text.exr"), "text.exr: cannot read: "));

    LayeredImage layers;
    layers.color = random_image(64, 64, 3, 3);
    write_exr(folder / "whole.exr", layers);
    const std::string whole = bytes_of(folder / "whole.exr");
    write_file_atomically(folder / "half.exr", std::string_view(whole).substr(0, whole.size() / 2));
    CHECK(contains(refusal(folder / "half.exr"), "half.exr: cannot read: "));
    CHECK_FALSE(contains(refusal(folder / "half.exr"), "\n"));

    write_exr_channels(folder / "odd.exr", make_image(2, 2, 2), {"U", "V"}, {});
    CHECK(contains(refusal(folder / "odd.exr"), "it holds U, V, neither R, G, B nor Y"));
}

TEST_CASE("Outputs that cannot be written are refused before the work starts", "[image]") {
    const TemporaryFolder folder;
    const auto refusal = [](const std::filesystem::path& path) { return error_of([&] { check_writable(path); }); };
    for (const char* name : {"a.exr", "b.PNG", "c.hdr"}) {
        CHECK(refusal(folder / name).empty());
    }
    CHECK(folder.file_count() == 0);
    CHECK(contains(refusal(folder / "a.jpg"), "unknown extension '.jpg' (known: .exr, .png, .hdr)"));
    CHECK(contains(refusal(folder / "a"), "unknown extension ''"));
    CHECK(contains(refusal(folder / "missing/a.exr"), "missing' does not exist"));
    write_file_atomically(folder / "file", "x");
    CHECK(contains(refusal(folder / "file/a.exr"), "is not a folder"));
    std::filesystem::create_directory(folder / "d.exr");
    CHECK(contains(refusal(folder / "d.exr"), "it is a folder"));
    CHECK(folder.file_count() == 2);
    if (geteuid() != 0) {
        std::filesystem::permissions(folder / "d.exr", std::filesystem::perms::owner_read);
        CHECK(contains(refusal(folder / "d.exr/a.exr"), "Permission denied"));
    }
    CHECK(contains(refusal("/proc/self/a.exr"), "/proc/self/a.exr: cannot write: "));
}

TEST_CASE("A failed write leaves the old file and nothing else", "[image]") {
    const TemporaryFolder folder;
    LayeredImage layers;
    layers.color = make_image(256, 256, 3, 0.5f);
    write_exr(folder / "a.exr", layers);
    write_png(folder / "a.png", layers.color);
    write_hdr(folder / "a.hdr", layers.color);
    const std::string old_exr = bytes_of(folder / "a.exr");
    const std::string old_png = bytes_of(folder / "a.png");
    const std::string old_hdr = bytes_of(folder / "a.hdr");
    layers.color = random_image(256, 256, 3, 17);
    std::string exr_error, png_error, hdr_error;
    {
        const FileSizeLimit limit(4096);
        exr_error = error_of([&] { write_exr(folder / "a.exr", layers); });
        png_error = error_of([&] { write_png(folder / "a.png", layers.color); });
        hdr_error = error_of([&] { write_hdr(folder / "a.hdr", layers.color); });
    }
    CHECK(contains(exr_error, "a.exr: cannot write: File too large"));
    CHECK(contains(png_error, "a.png: cannot write: File too large"));
    CHECK(contains(hdr_error, "a.hdr: cannot write: File too large"));
    CHECK(bytes_of(folder / "a.exr") == old_exr);
    CHECK(bytes_of(folder / "a.png") == old_png);
    CHECK(bytes_of(folder / "a.hdr") == old_hdr);
    CHECK(folder.file_count() == 3);

    layers.albedo = make_image(256, 255, 3);
    CHECK(contains(error_of([&] { write_exr(folder / "a.exr", layers); }), "'albedo' is 256x255x3, not 256x256x3"));
    CHECK(contains(error_of([&] { write_png(folder / "b.png", make_image(2, 2, 2)); }), "2 channels"));
    CHECK(contains(error_of([&] { write_hdr(folder / "missing/b.hdr", layers.color); }), "missing' does not exist"));
    CHECK(bytes_of(folder / "a.exr") == old_exr);
    CHECK(folder.file_count() == 3);
}
