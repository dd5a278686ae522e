// A film as bytes without most of its zeros. Few of a film's bits vary between neighbouring pixels: bins that hold no
// digit are 0, bins that do have zeros below or above it, and albedo and normal are those of the same surface. So a block
// of pixels stores, of each word of their structs, only the bytes that differ somewhere in the block.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

#include "render/film.h"

namespace diptych::core {

/// Pixels that are packed together; the last block of a film may have fewer.
inline constexpr std::size_t block_pixels = 256;

/// The most bytes that so many pixels of a film with these layers may take.
std::size_t most_packed_bytes(const Film& film, std::size_t pixels);

/// The least, which bounds what the bytes of a file can claim to be.
std::size_t least_packed_bytes(const Film& film, std::size_t pixels);

/// Pixels first .. first+count-1; `first` is a multiple of block_pixels. Returns how many bytes they took.
std::size_t pack_pixels(const Film& film, std::size_t first, std::size_t count, std::span<unsigned char> bytes);

/// The inverse, into a film of the same layers. Throws std::runtime_error where these bytes are no such pixels.
void unpack_pixels(std::span<const unsigned char> bytes, std::size_t first, std::size_t count, Film& film);

}  // namespace diptych::core
