// OpenEXR files whose picture is not simply all of their first part.
#include <sys/resource.h>
#include <unistd.h>

#include <algorithm>
#include <fstream>
#include <limits>
#include <memory>

#include <OpenImageIO/deepdata.h>
#include <OpenImageIO/imageio.h>

#include "catch.h"
#include "exr_bytes.h"
#include "image/atomic_file.h"
#include "image/exr_header.h"
#include "image/layered_image.h"
#include "image/picture_name.h"
#include "image/size_claim.h"
#include "image_fixtures.h"
#include "sanitized.h"
#include "scene/environment_load.h"

using namespace diptych::core;
using namespace diptych::core::image_tests;

namespace {

constexpr PixelWindow whole{0, 0, 4, 2};

/// While it lives, this process may take so many bytes of address space beyond what it has. Sanitizers need theirs, and
/// are not limited.
class AddressSpaceLimit {
public:
    explicit AddressSpaceLimit(rlim_t more) {
        getrlimit(RLIMIT_AS, &old_);
        std::size_t pages = 0;
        std::ifstream("/proc/self/statm") >> pages;
        const rlimit limit{pages * static_cast<rlim_t>(sysconf(_SC_PAGESIZE)) + more, old_.rlim_max};
        if (!tests::sanitized) {
            setrlimit(RLIMIT_AS, &limit);
        }
    }
    AddressSpaceLimit(const AddressSpaceLimit&) = delete;
    AddressSpaceLimit& operator=(const AddressSpaceLimit&) = delete;
    ~AddressSpaceLimit() { setrlimit(RLIMIT_AS, &old_); }

private:
    rlimit old_{};
};

std::filesystem::path write(const TemporaryFolder& folder, const std::vector<ExrPart>& parts) {
    write_file_atomically(folder / "a.exr", exr_bytes(parts));
    return folder / "a.exr";
}

ExrPart named(const std::string& name, ExrPart part) {
    part.name = name;
    return part;
}

ExrPart with_chromaticities(ExrPart part, const std::vector<float>& chromaticities) {
    part.chromaticities = chromaticities;
    return part;
}

/// The first pixel, or the refusal, of which both readers say the same.
struct Read {
    std::vector<float> pixel;
    std::string layer;
    std::string refusal;
};

Read read(const std::filesystem::path& file, const std::string& layer = "") {
    Read result;
    result.refusal = error_of([&] {
        const LayeredImage image = read_image(file, layer);
        result.pixel.assign(image.color.data.begin(), image.color.data.begin() + 3);
        result.layer = image.layer;
    });
    const std::string name = file.string() + (layer.empty() ? "" : ":" + layer);
    std::vector<float> sky;
    const std::string sky_refusal = error_of([&] {
        const Environment map = load_environment(name);
        sky = {map.texels[0].x, map.texels[0].y, map.texels[0].z};
    });
    CHECK(sky_refusal == (result.refusal.empty() ? "" : "environment map " + result.refusal));
    if (result.refusal.empty()) {
        CHECK(sky == result.pixel);
    } else {
        CHECK(contains(result.refusal, "a.exr: cannot read: "));
    }
    return result;
}

Read read(const TemporaryFolder& folder, const std::vector<ExrPart>& parts, const std::string& layer = "") {
    return read(write(folder, parts), layer);
}

}  // namespace

TEST_CASE("the data window of an EXR is placed in its display window", "[image]") {
    const TemporaryFolder folder;
    ExrPart part = constant_part({2, -1, 3, 3}, {{"R", 1.0f}, {"G", 2.0f}, {"B", 3.0f}});
    part.channels["R"] = {1, 2, 3, 4, 5, 6, 7, 8, 9};
    part.display = {-1, 0, 5, 4};
    const LayeredImage image = read_image(write(folder, {part}));
    REQUIRE(image.color.width == 5);
    REQUIRE(image.color.height == 4);
    const std::vector<float> reds = {0, 0, 0, 4, 5, 0, 0, 0, 7, 8, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0};
    for (int y = 0; y < 4; ++y) {
        for (int x = 0; x < 5; ++x) {
            const float red = reds[static_cast<size_t>(5 * y + x)];
            CHECK(image.color.at(x, y, 0) == red);
            CHECK(image.color.at(x, y, 2) == (red > 0 ? 3 : 0));
        }
    }
    CHECK(image.display == PixelWindow{-1, 0, 5, 4});
    CHECK(image.data == PixelWindow{2, 0, 2, 2});
    const Environment map = load_environment(folder / "a.exr");
    REQUIRE(map.width == 5);
    CHECK(map.texels[4] == glm::vec3(5, 2, 3));
    CHECK(map.texels[0] == glm::vec3(0));

    part.display = {100, 100, 2, 1};  // that shows none of the data
    CHECK(read(folder, {part}).pixel == std::vector<float>{0, 0, 0});
    part.display = {0, 0, 1 << 20, 1 << 20};
    CHECK(contains(read(folder, {part}).refusal, "1048576x1048576 pixels are more than Diptych reads"));
    part.display = {0, 0, 4096, 2160};  // as of an empty frame that its program cropped to a pixel
    CHECK(read(folder, {part}).refusal.empty());
    part.display = {0, 0, 1 << 14, 1 << 13};
    CHECK(contains(read(folder, {part}).refusal, "cannot hold the 16384x8192 pixels that its header claims"));
}

TEST_CASE("a header may claim what is in proportion to its file", "[image]") {
    CHECK(size_claim_problem(2048, 2048, 4, 500).empty());
    CHECK(contains(size_claim_problem(2048, 2049, 4, 500), "500 bytes cannot hold the 2048x2049 pixels"));
    CHECK(size_claim_problem(16384, 16384, 3, 100'000).empty());
    CHECK(size_claim_problem(8192, 4320, 3, 500, display_grant).empty());  // an empty frame, cropped to a pixel
    CHECK(contains(size_claim_problem(131073, 1, 1, 1'000'000), "131072 a side"));
    CHECK(contains(size_claim_problem(16385, 16384, 1, 1'000'000'000), "268435456 in all"));
    CHECK(contains(size_claim_problem(0, 8, 3, 500), "no pixels"));
}

TEST_CASE("an attribute of an EXR claims no more bytes than the file has", "[image]") {
    const TemporaryFolder folder;
    const ExrPart grey = constant_part(whole, {{"Y", 0.5F}});
    for (const std::vector<ExrPart>& parts : {std::vector{grey}, {named("a", grey), named("b", grey)}}) {
        std::string bytes = exr_bytes(parts);
        const std::string attribute("pixelAspectRatio\0float\0", 23);
        const std::size_t claim = bytes.rfind(attribute) + attribute.size();  // in the last part
        write_file_atomically(folder / "a.exr", bytes);
        CHECK(exr_header_problem(folder / "a.exr").empty());
        bytes.replace(claim, 4, std::string("\0\0\0\x60", 4));
        write_file_atomically(folder / "a.exr", bytes);
        CHECK(contains(read(folder / "a.exr").refusal, "'pixelAspectRatio' claims 1610612736 bytes"));
    }
}

TEST_CASE("an attribute of an EXR claims as many bytes as its value has", "[image]") {
    const TemporaryFolder folder;
    const std::string good = exr_bytes({constant_part(whole, {{"Y", 0.5F}})});
    const auto refusal = [&](const std::string& attribute, int more) {
        std::string bytes = good;
        const std::size_t claim = bytes.find(attribute) + attribute.size();
        REQUIRE(claim >= attribute.size());
        bytes[claim] = static_cast<char>(bytes[claim] + more);
        write_file_atomically(folder / "a.exr", bytes);
        return read(folder / "a.exr").refusal;
    };
    // OpenEXR reads these by their contents: what follows would be taken for the next attribute.
    for (const auto& [name, type] : {std::pair("channels", "chlist"), {"dataWindow", "box2i"}, {"lineOrder", "lineOrder"},
                                     {"pixelAspectRatio", "float"}, {"screenWindowCenter", "v2f"}}) {
        const std::string attribute = std::string(name) + '\0' + type + '\0';
        CAPTURE(name);
        CHECK(refusal(attribute, 0).empty());
        CHECK(contains(refusal(attribute, 4), std::string("'") + name + "' of type '" + type + "' does not have"));
    }
}

TEST_CASE("an EXR is refused before a block of its rows is allocated that it cannot hold", "[image]") {
    const TemporaryFolder folder;
    std::string bytes = exr_bytes({constant_part(whole, {{"B", 0.5F}, {"G", 0.5F}, {"R", 0.5F}})});
    const auto set = [&](const std::string& attribute, std::size_t at, const std::string& value) {
        const std::size_t begin = bytes.find(attribute);
        REQUIRE(begin != std::string::npos);
        bytes.replace(begin + attribute.size() + 4 + at, value.size(), value);
        write_file_atomically(folder / "a.exr", bytes);
        return exr_header_problem(folder / "a.exr");
    };
    const std::string window("dataWindow\0box2i\0", 17);
    const std::string compression("compression\0compression\0", 24);
    CHECK(set(window, 8, std::string("\xff\xff\1\0\0\0\0\0", 8)).empty());  // a row of 131072 pixels, 1.5 MB
    CHECK(contains(set(compression, 0, "\x9"), "cannot hold the 131072x256 pixels"));
    CHECK(contains(set(window, 8, std::string("\0\0\x0f\0", 4)), "131072 a side"));
}

TEST_CASE("reading a wide EXR takes memory for the rows that it has", "[image]") {
    const TemporaryFolder folder;
    const std::string file = folder / "wide.exr";
    constexpr int width = 100'000;
    constexpr int height = 3;
    constexpr int channels = 25;
    // 256 rows of the three channels that are read would take 300 MB.
    OIIO::ImageSpec spec(width, height, channels, OIIO::TypeFloat);
    spec.channelnames = {"B", "G", "R"};
    for (char name = 'a'; spec.channelnames.size() < channels; ++name) {
        spec.channelnames.emplace_back(1, name);
    }
    if (GENERATE(false, true)) {  // of which some are converted
        spec.channelformats.assign(channels, OIIO::TypeFloat);
        std::fill_n(spec.channelformats.begin(), 2, OIIO::TypeHalf);
        spec.channelformats[3] = OIIO::TypeUInt32;
    }
    spec.attribute("compression", "none");  // OpenEXR allocates a compressed block of rows for each of its threads
    std::vector<float> pixels;
    for (int pixel = 0; pixel < width * height; ++pixel) {
        for (int channel = 0; channel < channels; ++channel) {
            pixels.push_back(static_cast<float>((pixel / 7 + channel) % 2048));
        }
    }
    const std::unique_ptr<OIIO::ImageOutput> output = OIIO::ImageOutput::create(file);
    REQUIRE((output && output->open(file, spec)));
    REQUIRE(output->write_image(OIIO::TypeFloat, pixels.data()));
    REQUIRE(output->close());

    read(folder, {constant_part(whole, {{"Y", 1.0F}})});  // starts the threads, which reserve memory
    LayeredImage image;
    {
        const AddressSpaceLimit limit(250'000'000);
        image = read_image(file);
    }
    REQUIRE(image.color.width == width);
    REQUIRE(image.color.height == height);
    std::size_t wrong = 0;
    for (std::size_t pixel = 0; pixel < pixels.size() / channels; ++pixel) {
        for (std::size_t channel = 0; channel < 3; ++channel) {
            wrong += image.color.data[3 * pixel + channel] != pixels[channels * pixel + 2 - channel];
        }
    }
    CHECK(wrong == 0);
}

TEST_CASE("a list of strings or a preview in an EXR has the size that it claims", "[image]") {
    const TemporaryFolder folder;
    const std::string good = exr_bytes({constant_part(whole, {{"Y", 0.5F}})});
    const auto problem = [&](const std::string& type, const std::string& value) {
        std::string attribute = std::string("more") + '\0' + type + '\0';
        attribute += {static_cast<char>(value.size()), 0, 0, 0};
        std::string bytes = good;
        bytes.insert(8, attribute + value);  // behind the magic number and the version
        write_file_atomically(folder / "a.exr", bytes);
        return exr_header_problem(folder / "a.exr");
    };
    const std::string pixel = std::string("\1\0\0\0\1\0\0\0abcd", 12);
    CHECK(problem("preview", pixel).empty());
    CHECK(contains(problem("preview", std::string("\0\0\1\0\0\0\1\0abcd", 12)), "'more' of type 'preview'"));
    CHECK(problem("stringvector", std::string("\2\0\0\0ab\0\0\0\0", 10)).empty());
    CHECK(contains(problem("stringvector", std::string("\2\0\0\x60" "ab", 6)), "'more' of type 'stringvector'"));
    CHECK(problem("of another program", "abc").empty());
}

TEST_CASE("a picture is read by the reader of its format alone", "[image]") {
    const TemporaryFolder folder;
    const auto refusal = [&](const char* name, const std::string& bytes) -> std::string {
        write_file_atomically(folder / name, bytes);
        try {
            read_image(folder / name);
            return "";
        } catch (const Error& error) {
            return error.what();
        }
    };
    std::string bytes = exr_bytes({constant_part(whole, {{"Y", 0.5F}})});
    CHECK(refusal("a.png", bytes).empty());  // its bytes name the format, not its extension
    bytes[4] = 99;                           // a version that does not exist
    for (const char* name : {"a.exr", "a.dcm", "a.mp4"}) {
        CHECK(contains(refusal(name, bytes), "version"));
    }
    CHECK(contains(refusal("a.unknown", "no picture"), "known picture format"));
    // Its reader allocates the canvas when it opens the file.
    CHECK(contains(refusal("a.gif", std::string("GIF89a\0\x20\0\x20\0\0\0", 13)), "cannot hold the 8192x8192 pixels"));
}

TEST_CASE("names in an EXR do not break the line that refuses it", "[image]") {
    const TemporaryFolder folder;
    const Read refused = read(folder, {constant_part(whole, {{"U\n\x1b[2J", 1.0F}})});
    CHECK(contains(refused.refusal, "it holds U  [2J, neither"));
}

TEST_CASE("layers and parts of an EXR are chosen by name", "[image]") {
    const TemporaryFolder folder;
    const std::map<std::string, float> rgb = {{"R", 1.0f}, {"G", 2.0f}, {"B", 3.0f}};
    const std::vector<float> picture = {1, 2, 3};
    const auto layered = [&](const std::string& layer, float scale) {
        std::map<std::string, float> channels;
        for (const auto& [name, value] : rgb) {
            channels[layer + "." + name] = scale * value;
        }
        return channels;
    };
    std::map<std::string, float> two = layered("albedo", 2);
    two.merge(layered("beauty", 1));

    // Several layers and none is plain.
    CHECK(contains(read(folder, {constant_part(whole, two)}).refusal, "name one as FILE:LAYER (albedo, beauty)"));
    CHECK(read(folder, {constant_part(whole, two)}, "beauty").pixel == picture);
    CHECK(read(folder, {constant_part(whole, two)}, "albedo").pixel == std::vector<float>{2, 4, 6});
    CHECK(contains(read(folder, {constant_part(whole, two)}, "specular").refusal,
                   "no layer 'specular'; its pictures are albedo, beauty"));

    // Plain channels are the picture, whatever lies beside them.
    std::map<std::string, float> plain = two;
    plain.insert(rgb.begin(), rgb.end());
    plain["Z"] = 7;
    CHECK(read(folder, {constant_part(whole, plain)}).pixel == picture);
    CHECK(read(folder, {constant_part(whole, plain)}).layer.empty());

    // The only layer that can be the picture is, and is named.
    std::map<std::string, float> one = layered("View.Combined", 1);
    one["View.Depth.V"] = 7;
    CHECK(read(folder, {constant_part(whole, one)}).pixel == picture);
    CHECK(read(folder, {constant_part(whole, one)}).layer == "View.Combined");
    CHECK(contains(read(folder, {constant_part(whole, one)}, "View.Depth").refusal, "layer 'View.Depth': it holds V"));

    const ExrPart depth = named("depth", constant_part(whole, {{"Z", 7.0f}}));
    const ExrPart beauty = named("beauty", constant_part(whole, rgb));
    const ExrPart albedo = named("albedo", constant_part(whole, {{"R", 4.0f}, {"G", 5.0f}, {"B", 6.0f}}));
    CHECK(read(folder, {depth, beauty}).pixel == picture);
    CHECK(read(folder, {depth, beauty}).layer == "beauty");
    CHECK(contains(read(folder, {albedo, depth, beauty}).refusal, "(albedo, beauty)"));
    CHECK(read(folder, {albedo, depth, beauty}, "beauty").pixel == picture);
    CHECK(read(folder, {albedo, named("lamps", constant_part(whole, layered("key", 1)))}, "lamps.key").pixel ==
          picture);
}

TEST_CASE("an EXR's layer is asked for behind the file's name", "[image]") {
    const TemporaryFolder folder;
    const std::string file = write(folder, {constant_part(whole, {{"Y", 1.0f}})});
    const auto split = [](const std::string& text) {
        const PictureName name = picture_name(text);
        return std::pair(name.file.string(), name.layer);
    };
    CHECK(split(file) == std::pair(file, std::string()));
    CHECK(split(file + ":beauty") == std::pair(file, std::string("beauty")));
    CHECK(split(file + ":light:key") == std::pair(file, std::string("light:key")));
    CHECK(split(file + "x:beauty") == std::pair(file + "x:beauty", std::string()));
    write_file_atomically(folder / "a.exr:beauty", bytes_of(file));  // a file's own name comes first
    CHECK(split(file + ":beauty") == std::pair(file + ":beauty", std::string()));
    CHECK(split(file + ":beauty:b") == std::pair(file + ":beauty", std::string("b")));
    write_png(folder / "a.png", make_image(2, 1, 3));
    CHECK(contains(error_of([&] { read_image(folder / "a.png", "beauty"); }), "only EXR files have layers"));
}

TEST_CASE("an EXR that is not a picture is refused by what it is", "[image]") {
    const TemporaryFolder folder;
    const auto refusal = [&](const std::map<std::string, float>& channels) {
        return read(folder, {constant_part(whole, channels)}).refusal;
    };
    CHECK(contains(refusal({{"R", 1.0f}, {"G", 1.0f}}), "it holds R, G, neither R, G, B nor Y"));
    CHECK(contains(refusal({{"Z", 1.0f}}), "it holds Z, neither"));
    CHECK(contains(refusal({{"depth", 1.0f}, {"nx", 1.0f}, {"ny", 1.0f}}), "it holds depth, nx, ny, neither"));
    CHECK(contains(refusal({{"X", 1.0f}, {"Y", 1.0f}, {"Z", 1.0f}}), "no chromaticities say that they are CIE XYZ"));
    // From 2.5 on OpenImageIO calls these channels R, G, B, converts what is subsampled and refuses the rest in its own words.
    const std::string chroma = refusal({{"Y", 1.0f}, {"RY", 1.0f}, {"BY", 1.0f}});
    CHECK((contains(chroma, "luminance with chroma") || contains(chroma, "subsampling")));
    CHECK(contains(refusal({{"Y", 1.0f}, {"X", 1.0f}}), "neither"));
    CHECK(contains(refusal({{"N.X", 1.0f}, {"N.Y", 1.0f}, {"N.Z", 1.0f}, {"A", 1.0f}}), "'N': channels X, Y, Z may be"));
    CHECK(read(folder, {constant_part(whole, {{"Y", 2.0f}})}).pixel == std::vector<float>{2, 2, 2});
    CHECK(read(folder, {constant_part(whole, {{"Y", 2.0f}, {"A", 1.0f}})}).pixel == std::vector<float>{2, 2, 2});

    OIIO::ImageSpec spec(4, 2, 5, OIIO::TypeFloat);
    spec.channelnames = {"R", "G", "B", "A", "Z"};
    spec.deep = true;
    const std::string file = folder / "a.exr";
    const std::unique_ptr<OIIO::ImageOutput> output = OIIO::ImageOutput::create(file);
    REQUIRE((output && output->open(file, spec)));
    REQUIRE(output->write_deep_image(OIIO::DeepData(spec)));
    REQUIRE(output->close());
    CHECK(contains(read(file).refusal, "deep data, with any number of samples a pixel, is not a picture"));
}

TEST_CASE("an EXR of other chromaticities becomes Rec.709", "[image]") {
    const TemporaryFolder folder;
    const auto check = [&](const std::vector<float>& chromaticities, const std::map<std::string, float>& channels,
                           const std::vector<double>& expected) {
        const LayeredImage image =
            read_image(write(folder, {with_chromaticities(constant_part(whole, channels), chromaticities)}));
        for (int c = 0; c < 3; ++c) {
            CHECK(image.color.at(3, 1, c) == Approx(expected[static_cast<size_t>(c)]).margin(5e-5));
        }
    };
    const auto rgb = [](float r, float g, float b) {
        return std::map<std::string, float>{{"R", r}, {"G", g}, {"B", b}};
    };
    const std::vector<float> rec2020 = {0.708f, 0.292f, 0.170f, 0.797f, 0.131f, 0.046f, 0.3127f, 0.3290f};
    check(rec2020, rgb(1, 0, 0), {1.6605, -0.1246, -0.0182});  // ITU-R BT.2087-0, annex 2
    check(rec2020, rgb(0, 1, 0), {-0.5876, 1.1329, -0.1006});
    check(rec2020, rgb(0, 0, 1), {-0.0728, -0.0083, 1.1187});
    // AP0 has a white of its own; white stays white. The matrix is that of the OpenColorIO configuration for ACES 1.0.3.
    const std::vector<float> ap0 = {0.7347f, 0.2653f, 0.0f, 1.0f, 0.0001f, -0.0770f, 0.32168f, 0.33767f};
    check(ap0, rgb(1, 0, 0), {2.521686, -0.276480, -0.015378});
    check(ap0, rgb(0, 1, 0), {-1.134131, 1.372719, -0.152975});
    check(ap0, rgb(0, 0, 1), {-0.387555, -0.096239, 1.168353});
    check(ap0, rgb(0.5f, 0.5f, 0.5f), {0.5, 0.5, 0.5});
    // CIE XYZ by name, and by primaries alone; the white that is given is white.
    const std::vector<float> xyz = {1, 0, 0, 1, 0, 0, 1 / 3.0f, 1 / 3.0f};
    check(xyz, {{"X", 1.0f}, {"Y", 1.0f}, {"Z", 1.0f}}, {1, 1, 1});
    check(xyz, rgb(1, 1, 1), {1, 1, 1});
    std::vector<float> xyz_d65 = xyz;
    xyz_d65[6] = 0.3127f, xyz_d65[7] = 0.3290f;
    check(xyz_d65, {{"X", 1.0f}, {"Y", 0.0f}, {"Z", 0.0f}}, {3.2410, -0.9692, 0.0556});
    check(xyz_d65, {{"X", 0.95046f}, {"Y", 1.0f}, {"Z", 1.08906f}}, {1, 1, 1});
    // Rec.709's own leave every bit; grey has no colour to convert.
    check({0.64f, 0.33f, 0.30f, 0.60f, 0.15f, 0.06f, 0.3127f, 0.3290f}, rgb(0.1f, 1e-30f, 7), {0.1, 1e-30, 7});
    check(rec2020, {{"Y", 0.25f}}, {0.25, 0.25, 0.25});

    const std::vector<float> no_space = {0.3f, 0.3f, 0.3f, 0.3f, 0.3f, 0.3f, 0.3f, 0.3f};
    CHECK(contains(read(folder, {with_chromaticities(constant_part(whole, rgb(1, 1, 1)), no_space)}).refusal,
                   "chromaticities span no colour space"));
}

TEST_CASE("a texel of a sky that is not finite is refused with its place", "[environment]") {
    const TemporaryFolder folder;
    const float infinity = std::numeric_limits<float>::infinity();
    const auto refusal = [&](float value, const std::string& channel, const std::vector<float>& chromaticities) {
        ExrPart part = constant_part({1, 1, 2, 1}, {{"a.R", 1.0f}, {"a.G", 1.0f}, {"a.B", 1.0f}});
        part.channels[channel][1] = value;
        part.display = whole;
        part.chromaticities = chromaticities;
        const std::filesystem::path file = write(folder, {part});
        return error_of([&] { load_environment(file); });
    };
    CHECK(contains(refusal(infinity, "a.G", {}), "a.exr: texel 2,1 (from the top left), channel a.G: inf is no radiance"));
    CHECK(contains(refusal(-infinity, "a.R", {}), "channel a.R: -inf"));
    CHECK(contains(refusal(std::numeric_limits<float>::quiet_NaN(), "a.B", {}), "texel 2,1"));
    const std::vector<float> rec2020 = {0.708f, 0.292f, 0.170f, 0.797f, 0.131f, 0.046f, 0.3127f, 0.3290f};
    CHECK(contains(refusal(infinity, "a.B", rec2020), "channel a.B: inf"));
    CHECK(refusal(65504, "a.B", rec2020).empty());
}
