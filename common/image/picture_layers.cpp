#include "image/picture_layers.h"

#include <algorithm>
#include <stdexcept>

namespace diptych::core {
namespace {

enum class Kind { Rgb, Xyz, Grey, None };

struct Layer {
    size_t part = 0;
    std::string prefix;  // in the channels' names
    std::string name;    // as a user gives it
    std::vector<std::string> components;
    std::vector<int> channels;  // of the components
    std::vector<int> picture;   // those that are the picture
    Kind kind = Kind::None;
    std::string problem;  // why it is no picture
};

std::string joined(const std::vector<std::string>& names) {
    constexpr size_t most = 12;
    std::string text;
    for (size_t i = 0; i < std::min(names.size(), most); ++i) {
        text += (i > 0 ? ", " : "") + names[i];
    }
    return names.size() > most ? text + " and " + std::to_string(names.size() - most) + " more" : text;
}

int channel(const Layer& layer, std::initializer_list<const char*> names) {
    for (const char* name : names) {
        const auto found = std::find(layer.components.begin(), layer.components.end(), name);
        if (found != layer.components.end()) {
            return layer.channels[static_cast<size_t>(found - layer.components.begin())];
        }
    }
    return -1;
}

void judge(const PicturePart& part, Layer& layer) {
    const auto take = [&](Kind kind, std::vector<int> channels) {
        layer.kind = kind;
        layer.picture = std::move(channels);
    };
    const int r = channel(layer, {"R", "r", "red", "Red"}), g = channel(layer, {"G", "g", "green", "Green"}),
              b = channel(layer, {"B", "b", "blue", "Blue"});
    const int x = channel(layer, {"X"}), y = channel(layer, {"Y"}), z = channel(layer, {"Z"});
    if (part.deep) {
        layer.problem = "deep data, with any number of samples a pixel, is not a picture";
    } else if (r >= 0 && g >= 0 && b >= 0) {
        take(Kind::Rgb, {r, g, b});
    } else if (channel(layer, {"RY"}) >= 0 || channel(layer, {"BY"}) >= 0) {
        layer.problem = "luminance with chroma (Y, RY, BY) is not supported: store R, G, B";
    } else if (y >= 0 && x < 0 && z < 0) {
        take(Kind::Grey, {y});
    } else if (x >= 0 && y >= 0 && z >= 0 && part.chromaticities && primaries_are_xyz(*part.chromaticities)) {
        take(Kind::Xyz, {x, y, z});
    } else if (x >= 0 && y >= 0 && z >= 0) {
        layer.problem = "channels X, Y, Z may be positions: no chromaticities say that they are CIE XYZ";
    } else {
        layer.problem = "it holds " + joined(layer.components) + ", neither R, G, B nor Y";
    }
}

std::string layer_name(const std::string& part, const std::string& prefix) {
    if (part.empty() || prefix == part || prefix.compare(0, part.size() + 1, part + ".") == 0) {
        return prefix;
    }
    return prefix.empty() ? part : part + "." + prefix;
}

std::vector<Layer> layers_of(const std::vector<PicturePart>& parts) {
    std::vector<Layer> layers;
    for (size_t part = 0; part < parts.size(); ++part) {
        const size_t first = layers.size();
        for (size_t i = 0; i < parts[part].channels.size(); ++i) {
            const std::string& name = parts[part].channels[i];
            const size_t dot = name.rfind('.');
            const std::string prefix = dot == std::string::npos ? "" : name.substr(0, dot);
            auto layer = std::find_if(layers.begin() + static_cast<std::ptrdiff_t>(first), layers.end(),
                                      [&](const Layer& other) { return other.prefix == prefix; });
            if (layer == layers.end()) {
                layers.push_back({part, prefix, layer_name(parts[part].name, prefix), {}, {}, {}, Kind::None, ""});
                layer = layers.end() - 1;
            }
            layer->components.push_back(dot == std::string::npos ? name : name.substr(dot + 1));
            layer->channels.push_back(static_cast<int>(i));
        }
        for (size_t i = first; i < layers.size(); ++i) {
            judge(parts[part], layers[i]);
        }
    }
    return layers;
}

std::vector<std::string> names_of_pictures(const std::vector<Layer>& layers) {
    std::vector<std::string> names;
    for (const Layer& layer : layers) {
        if (layer.kind != Kind::None && !layer.name.empty()) {
            names.push_back(layer.name);
        }
    }
    return names;
}

[[noreturn]] void fail_without_picture(const std::vector<Layer>& layers) {
    if (layers.size() == 1) {
        throw std::runtime_error(layers[0].problem);
    }
    std::vector<std::string> names;
    for (const Layer& layer : layers) {
        names.push_back((layer.name.empty() ? "" : "'" + layer.name + "': ") + layer.problem);
    }
    throw std::runtime_error("none of its layers is a picture (" + joined(names) + ")");
}

ChosenPicture chosen(const Layer& layer, bool by_elimination) {
    return {layer.part, layer.picture, layer.kind == Kind::Xyz, layer.name, by_elimination};
}

ChosenPicture choose_by_name(const std::vector<Layer>& layers, const std::string& name) {
    const auto found =
        std::find_if(layers.begin(), layers.end(), [&](const Layer& layer) { return layer.name == name; });
    if (found == layers.end()) {
        const std::vector<std::string> names = names_of_pictures(layers);
        throw std::runtime_error("it has no layer '" + name + "'" +
                                 (names.empty() ? "" : "; its pictures are " + joined(names)));
    }
    if (found->kind == Kind::None) {
        throw std::runtime_error("layer '" + name + "': " + found->problem);
    }
    return chosen(*found, false);
}

}  // namespace

ChosenPicture choose_picture(const std::vector<PicturePart>& parts, const std::string& layer) {
    const std::vector<Layer> layers = layers_of(parts);
    if (!layer.empty()) {
        return choose_by_name(layers, layer);
    }
    const auto matching = [&](auto&& wanted) {
        std::vector<const Layer*> found;
        for (const Layer& candidate : layers) {
            if (candidate.kind != Kind::None && wanted(candidate)) {
                found.push_back(&candidate);
            }
        }
        return found;
    };
    std::vector<const Layer*> found = matching([](const Layer& l) { return l.prefix.empty() && l.kind == Kind::Rgb; });
    if (found.empty()) {
        found = matching([](const Layer& l) { return l.prefix.empty(); });
    }
    if (found.empty()) {
        found = matching([](const Layer&) { return true; });
    }
    if (found.empty()) {
        fail_without_picture(layers);
    }
    if (found.size() > 1) {
        throw std::runtime_error("several of its layers may be the picture: name one as FILE:LAYER (" +
                                 joined(names_of_pictures(layers)) + ")");
    }
    const bool plain_of_one_part = found[0]->prefix.empty() && parts.size() == 1;
    return chosen(*found[0], layers.size() > 1 && !plain_of_one_part);
}

}  // namespace diptych::core
