// How the film lies in the device's memory: in blocks of 32 pixels, word by word, so that neighbouring invocations read
// neighbouring words. A struct after a struct costs ten times as many memory transactions.
#ifndef FILM_LAYOUT_H
#define FILM_LAYOUT_H

#include "language/compat.h"

SHARED_BEGIN

CONST uint FILM_BLOCK = 32u;  // pixels
CONST uint FILM_PIXEL_WORDS = 23u;
CONST uint FILM_MOMENTS_WORDS = 19u;
CONST uint FILM_FIRST_HIT_WORDS = 17u;

/// Place of a word of a pixel's struct, of so many words.
FN uint film_word(uint pixel, uint words, uint word) {
    return (pixel / FILM_BLOCK * words + word) * FILM_BLOCK + pixel % FILM_BLOCK;
}

SHARED_END

#endif
