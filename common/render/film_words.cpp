#include "render/film_words.h"

#include <algorithm>
#include <array>
#include <span>
#include <stdexcept>

namespace diptych::core {

namespace {

/// Names of the words of a sum (numbers/exact_sum.h) in the order of its struct.
std::vector<std::string> exact_sum_words(const std::string& name) {
    std::vector<std::string> names;
    for (const char* half : {"low", "high"}) {
        for (const char* bin : {"0", "1", "2"}) {
            for (const char* channel : {"r", "g", "b"}) {
                names.push_back(name + "." + half + bin + channel);
            }
        }
    }
    names.push_back(name + ".base");
    return names;
}

std::vector<std::string> fixed_sum_words(const std::string& name) {
    return {name + ".low_x", name + ".low_y", name + ".low_z", name + ".high_x", name + ".high_y", name + ".high_z"};
}

void append(std::vector<std::string>& names, const std::vector<std::string>& more) {
    names.insert(names.end(), more.begin(), more.end());
}

const std::vector<std::string>& pixel_words() {
    static const std::vector<std::string> names = [] {
        std::vector<std::string> all = exact_sum_words("radiance");
        append(all, {"samples", "nonfinite", "rays", "ray_wraps"});
        return all;
    }();
    return names;
}

const std::vector<std::string>& moment_words() {
    static const std::vector<std::string> names = exact_sum_words("squares");
    return names;
}

const std::vector<std::string>& first_hit_words() {
    static const std::vector<std::string> names = [] {
        std::vector<std::string> all = fixed_sum_words("albedo");
        append(all, fixed_sum_words("normal"));
        append(all, {"depth.low0", "depth.low1", "depth.high0", "depth.high1", "depth.base"});
        return all;
    }();
    return names;
}

/// An array of structs of words, and the names of the words of one.
struct Words {
    std::span<std::uint32_t> words;
    const std::vector<std::string>* names;

    std::size_t stride() const { return names->size(); }
};

template <class Struct>
Words words_of(std::vector<Struct>& structs, const std::vector<std::string>& names) {
    static_assert(sizeof(Struct) % sizeof(std::uint32_t) == 0);
    return {{reinterpret_cast<std::uint32_t*>(structs.data()), structs.size() * sizeof(Struct) / sizeof(std::uint32_t)},
            &names};
}

std::array<Words, 3> all_words(Film& film) {
    static_assert(sizeof(shared::FilmPixel) == 4 * 23 && sizeof(shared::FilmMoments) == 4 * 19 &&
                  sizeof(shared::FilmFirstHit) == 4 * 17);
    return {words_of(film.pixels, pixel_words()), words_of(film.moments, moment_words()),
            words_of(film.first_hits, first_hit_words())};
}

}  // namespace

void check_bases(const Film& film) {
    constexpr shared::uint most = 128;
    const auto is_good = [&](std::size_t i) {
        return film.pixels[i].sum.base <= most && (film.moments.empty() || film.moments[i].squares.base <= most) &&
               (film.first_hits.empty() || film.first_hits[i].depth.base <= most);
    };
    for (std::size_t i = 0; i < film.pixels.size(); ++i) {
        if (!is_good(i)) {
            throw std::runtime_error("the sum of a pixel is out of range");
        }
    }
}

Film film_of_words(const WordChannels& words, bool moments, bool first_hits, MemoryBudget& budget) {
    Film film;
    film.width = words.width;
    film.height = words.height;
    const std::size_t count = static_cast<std::size_t>(words.width) * static_cast<std::size_t>(words.height);
    budget.ask(film_bytes(count, moments, first_hits));
    film.pixels.resize(count);
    film.moments.resize(moments ? count : 0);
    film.first_hits.resize(first_hits ? count : 0);
    const auto targets = all_words(film);
    for (std::size_t channel = 0; channel < words.names.size(); ++channel) {
        const std::string& name = words.names[channel];
        const auto known = std::find_if(targets.begin(), targets.end(), [&](const auto& target) {
            return !target.words.empty() && std::count(target.names->begin(), target.names->end(), name) > 0;
        });
        if (known == targets.end()) {
            throw std::runtime_error("its film has an unknown channel '" + name + "'");
        }
        const auto at = std::find(known->names->begin(), known->names->end(), name) - known->names->begin();
        for (std::size_t i = 0; i < count; ++i) {
            known->words[i * known->stride() + static_cast<std::size_t>(at)] =
                words.data[i * words.names.size() + channel];
        }
    }
    check_bases(film);
    return film;
}

}  // namespace diptych::core
