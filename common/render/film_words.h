// The film of words of 32 bits with names, as files of earlier versions hold them.
#pragma once

#include "image/word_channels.h"
#include "memory_budget.h"
#include "render/film.h"

namespace diptych::core {

/// The film of such words; channels that are missing are 0. A film has moments where `moments` says so, and first hits
/// likewise. Asks the budget for the film before it is allocated. Throws std::runtime_error where a channel is unknown
/// or the film is too large.
Film film_of_words(const WordChannels& words, bool moments, bool first_hits, MemoryBudget& budget);

/// Throws std::runtime_error where the highest digit of a sum is beyond the range of doubles, which the oracle sums:
/// merging takes a step for each digit.
void check_bases(const Film& film);

}  // namespace diptych::core
