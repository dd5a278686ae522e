#include "ranks/film_exchange.h"

#include <algorithm>

#include "render/merge_films.h"

namespace diptych::core {

namespace {

constexpr std::size_t piece_pixels = 32768;  // 7 MB with all layers: the receiver adds one while the next is on its way

template <class Struct>
std::span<const Struct> part_of(const std::vector<Struct>& structs, std::size_t first, std::size_t count) {
    return std::span(structs).subspan(structs.empty() ? 0 : first, structs.empty() ? 0 : count);
}

bool send(Team& team, int to, std::uint64_t attempt, const Film& film) {
    for (std::size_t first = 0; first < film.pixels.size(); first += piece_pixels) {
        const std::size_t count = std::min(piece_pixels, film.pixels.size() - first);
        WordWriter writer;
        writer.put(attempt).put(std::uint64_t{first}).put(std::uint64_t{count});
        writer.put_structs(part_of(film.pixels, first, count));
        writer.put_structs(part_of(film.moments, first, count));
        writer.put_structs(part_of(film.first_hits, first, count));
        if (!team.send_film(to, writer.take())) {
            return false;
        }
    }
    return true;
}

bool receive(Team& team, int from, std::uint64_t attempt, Film& into) {
    for (std::size_t done = 0; done < into.pixels.size();) {
        const std::optional<std::vector<std::uint32_t>> words = team.receive_film(from, attempt);
        if (!words) {
            return false;
        }
        WordReader reader(*words);
        reader.number();
        const std::size_t first = reader.number();
        Film piece;
        piece.pixels.resize(reader.number());
        piece.moments.resize(into.moments.empty() ? 0 : piece.pixels.size());
        piece.first_hits.resize(into.first_hits.empty() ? 0 : piece.pixels.size());
        reader.read_structs(std::span(piece.pixels));
        reader.read_structs(std::span(piece.moments));
        reader.read_structs(std::span(piece.first_hits));
        merge_pixels(piece, first, into);
        done += piece.pixels.size();
    }
    return true;
}

}  // namespace

std::shared_ptr<const Film> merge_films_of_ranks(Team& team, const Order& order, std::shared_ptr<const Film> own) {
    const auto place = std::find(order.ranks.begin(), order.ranks.end(), team.place().rank);
    const auto index = static_cast<std::size_t>(place - order.ranks.begin());
    std::shared_ptr<Film> sum;
    for (std::size_t step = 1; step < order.ranks.size(); step *= 2) {
        if (index % (2 * step) != 0) {
            return send(team, order.ranks[index - step], order.attempt, sum ? *sum : *own) ? std::make_shared<Film>()
                                                                                          : nullptr;
        }
        if (index + step < order.ranks.size()) {
            sum = sum ? sum : std::make_shared<Film>(*own);
            if (!receive(team, order.ranks[index + step], order.attempt, *sum)) {
                return nullptr;
            }
        }
    }
    return sum ? sum : own;
}

}  // namespace diptych::core
