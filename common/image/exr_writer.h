// Writes EXR files of one part, in rows, as 'OpenEXR File Layout' has them. Not by OpenImageIO, because that keeps every
// string that an attribute ever had until the process ends, and encodes the picture on its way through several copies.
#pragma once

#include <functional>
#include <map>
#include <span>
#include <string>
#include <vector>

#include "image/byte_sink.h"

namespace diptych::core {

/// Lossless, both. Without compression, a picture is written as fast as the disk takes it.
enum class ExrCompression { off, zip };

struct ExrPicture {
    int width = 0;
    int height = 0;
    std::vector<std::string> channels;  // float32
    std::map<std::string, std::string> attributes;
    ExrCompression compression = ExrCompression::zip;
    /// Gives rows first .. first+count-1, channels interleaved. Asked for from the top, each row once.
    std::function<void(int first, int count, std::span<float> values)> rows;
};

/// Compresses on all cores. No picture is in memory as a whole. Equal pictures give equal bytes. Throws what `rows` and
/// the sink throw.
void write_exr_file(const ExrPicture& picture, ByteSink& sink);

}  // namespace diptych::core
