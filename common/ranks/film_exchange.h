// Films of ranks as one film.
#pragma once

#include <memory>

#include "ranks/team.h"
#include "render/film.h"

namespace diptych::core {

/// Adds up the films of order.ranks in a binary tree, exactly; all of these ranks call it with the film of their own
/// samples. Returns the sum on the first of them, and an empty film on the others. Returns null where a rank has died
/// or all are to stop: then Team::next has another order.
std::shared_ptr<const Film> merge_films_of_ranks(Team& team, const Order& order, std::shared_ptr<const Film> own);

}  // namespace diptych::core
