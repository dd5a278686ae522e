#include "image/radiance_file.h"

#include <array>
#include <cmath>
#include <cstdint>
#include <stdexcept>
#include <string>
#include <vector>

#include "image/radiance_header.h"
#include "image/size_claim.h"
#include "input_file.h"

namespace diptych::core {
namespace {

using Rgbe = std::array<std::uint8_t, 4>;

constexpr size_t least_new_rle = 8, most_new_rle = 0x7fff;  // pixels of a scanline that may be in the newer encoding

/// The bytes that follow the header, taken in order.
class Bytes {
public:
    explicit Bytes(std::string_view bytes) : bytes_(bytes) {}

    size_t left() const { return bytes_.size() - at_; }
    std::uint8_t peek(size_t ahead) const { return static_cast<std::uint8_t>(bytes_[at_ + ahead]); }
    std::uint8_t next() {
        if (at_ == bytes_.size()) {
            throw std::runtime_error("the file ends early");
        }
        return static_cast<std::uint8_t>(bytes_[at_++]);
    }
    Rgbe next_pixel() {
        Rgbe pixel;
        for (std::uint8_t& byte : pixel) {
            byte = next();
        }
        return pixel;
    }

private:
    std::string_view bytes_;
    size_t at_ = 0;
};

/// Pixels one by one; (1, 1, 1, n) repeats the one before n times, and each such pixel in a row counts 256 times as
/// much as the last.
void read_old_scanline(Bytes& bytes, std::vector<Rgbe>& line) {
    unsigned shift = 0;
    for (size_t x = 0; x < line.size();) {
        const Rgbe pixel = bytes.next_pixel();
        if (pixel[0] != 1 || pixel[1] != 1 || pixel[2] != 1) {
            line[x++] = pixel;
            shift = 0;
            continue;
        }
        const size_t count = shift < 32 ? static_cast<size_t>(pixel[3]) << shift : 0;
        if (x == 0 || count > line.size() - x) {
            throw std::runtime_error("a run of pixels does not fit");
        }
        for (const size_t end = x + count; x < end; ++x) {
            line[x] = line[x - 1];
        }
        shift += 8;
    }
}

/// The four components one after the other, each in runs (128 + n, value) and literals (n, n values).
void read_new_scanline(Bytes& bytes, std::vector<Rgbe>& line) {
    bytes.next_pixel();  // 2, 2 and the length
    for (size_t component = 0; component < 4; ++component) {
        for (size_t x = 0; x < line.size();) {
            const size_t code = bytes.next();
            const bool run = code > 128;
            const size_t count = run ? code - 128 : code;
            if (count == 0 || count > line.size() - x) {
                throw std::runtime_error("a run of bytes does not fit");
            }
            const std::uint8_t repeated = run ? bytes.next() : 0;
            for (const size_t end = x + count; x < end; ++x) {
                line[x][component] = run ? repeated : bytes.next();
            }
        }
    }
}

void read_scanline(Bytes& bytes, std::vector<Rgbe>& line) {
    const bool may_be_new = line.size() >= least_new_rle && line.size() <= most_new_rle && bytes.left() >= 4 &&
                            bytes.peek(0) == 2 && bytes.peek(1) == 2 && bytes.peek(2) < 128;
    if (!may_be_new) {
        return read_old_scanline(bytes, line);
    }
    if (static_cast<size_t>(bytes.peek(2) << 8 | bytes.peek(3)) != line.size()) {
        throw std::runtime_error("its length is not that of the resolution line");
    }
    read_new_scanline(bytes, line);
}

Image read_pixels(Bytes bytes, const RadianceHeader& header) {
    Image image = make_image(header.width(), header.height(), 3);
    std::vector<Rgbe> line(static_cast<size_t>(header.pixels.size));
    for (int i = 0; i < header.scanlines.size; ++i) {
        try {
            read_scanline(bytes, line);
        } catch (const std::runtime_error& error) {
            throw std::runtime_error("scanline " + std::to_string(i) + " of " + std::to_string(header.scanlines.size) +
                                     ": " + error.what());
        }
        for (int j = 0; j < header.pixels.size; ++j) {
            const int along = header.pixels.place(j), across = header.scanlines.place(i);
            const int x = header.scanlines.vertical ? along : across, y = header.scanlines.vertical ? across : along;
            const Rgbe& pixel = line[static_cast<size_t>(j)];
            for (int c = 0; c < 3 && pixel[3] != 0; ++c) {
                image.at(x, y, c) = static_cast<float>(std::ldexp(pixel[static_cast<size_t>(c)], pixel[3] - 136) /
                                                       header.multiplied[c]);
            }
        }
    }
    return image;
}

/// A scanline of several pixels takes at least a pixel and a run of it.
void check_size(const RadianceHeader& header, size_t bytes_of_pixels, size_t bytes_of_file) {
    const size_t least = static_cast<size_t>(header.scanlines.size) * (header.pixels.size == 1 ? 4 : 8);
    if (bytes_of_pixels < least) {
        throw std::runtime_error(std::to_string(header.width()) + "x" + std::to_string(header.height()) +
                                 " pixels take at least " + std::to_string(least) +
                                 " bytes, and the header is followed by " + std::to_string(bytes_of_pixels));
    }
    if (const std::string reason = size_claim_problem(header.width(), header.height(), 3, bytes_of_file);
        !reason.empty()) {
        throw std::runtime_error(reason);
    }
}

}  // namespace

bool is_radiance(std::string_view first_bytes) {
    return first_bytes.substr(0, 2) == "#?";
}

Image read_radiance(const std::filesystem::path& path, MemoryBudget& budget) {
    const std::vector<std::uint8_t> content = read_file(path, budget);
    const std::string_view bytes(reinterpret_cast<const char*>(content.data()), content.size());
    const RadianceHeader header = read_radiance_header(bytes);
    check_size(header, bytes.size() - header.size, bytes.size());
    budget.ask(2 * float_bytes(header.width(), header.height(), 3));  // as stored, and the picture made of it
    Image image = read_pixels(Bytes(bytes.substr(header.size)), header);
    if (header.xyz) {
        convert_color(image, xyz_to_rec709());
    } else if (header.primaries && !same_chromaticities(*header.primaries, rec709)) {
        convert_color(image, to_rec709(*header.primaries));
    }
    return image;
}

}  // namespace diptych::core
