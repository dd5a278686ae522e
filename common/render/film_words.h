// A film as words of 32 bits with names, for files.
#pragma once

#include "image/word_channels.h"
#include "render/film.h"

namespace diptych::core {

/// All words of all pixels. Words that are 0 in every pixel are left out.
WordChannels film_words(const Film& film);

/// The film of such words; channels that are missing are 0. A film has moments where `moments` says so, and first hits
/// likewise. Throws std::runtime_error where a channel is unknown.
Film film_of_words(const WordChannels& words, bool moments, bool first_hits);

}  // namespace diptych::core
