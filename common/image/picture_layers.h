// Which channels of a file are the picture: by their names, never by their order.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "image/chromaticities.h"

namespace diptych::core {

/// What the header of one part (EXR), or of a whole file, says.
struct PicturePart {
    std::string name;  // may be empty
    std::vector<std::string> channels;
    bool deep = false;
    std::optional<Chromaticities> chromaticities;
};

struct ChosenPicture {
    size_t part = 0;
    std::vector<int> channels;    // three of them, or one that is grey
    bool xyz = false;             // the three are CIE XYZ
    std::string layer;            // its name; empty for the plain channels of an unnamed part
    bool by_elimination = false;  // nobody named the layer, and the file holds others
};

/// A layer is what comes before the last dot of channels' names; channels without a dot are plain. In a file of several
/// parts a layer's name begins with that of its part. A layer is a picture if it holds R, G, B; or Y without X and Z
/// and without chroma; or X, Y, Z where the chromaticities say that these are CIE XYZ.
///
/// Where `layer` is empty, the picture is the plain R, G, B; else another plain picture; else the only layer that is a
/// picture. Throws a std::runtime_error with the reason, and with the names to choose from, where there is none or
/// more than one.
ChosenPicture choose_picture(const std::vector<PicturePart>& parts, const std::string& layer);

}  // namespace diptych::core
