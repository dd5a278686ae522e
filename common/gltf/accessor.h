// Accessors: checked reading of typed arrays out of buffers, sparse ones included.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "gltf/document.h"

namespace diptych::core::gltf {

/// The accessor a primitive or a skin names. Throws Error in the name of `object` where there is none of that index.
const tinygltf::Accessor& find_accessor(const Document& document, int index, const std::string& object);

/// All components of an accessor, element by element: normalised integers as [0, 1] or [-1, 1], other numbers as they
/// are. `components` is the count that an element must have. Throws Error in the name of `object` where the type is
/// another, a range ends outside its buffer, or a sparse index is out of range or order.
std::vector<float> read_numbers(const Document& document, int index, std::size_t components, const std::string& object);

/// An accessor of unsigned integers (scalar, or of `components` each). Throws Error as above.
std::vector<std::uint32_t> read_integers(const Document& document, int index, std::size_t components,
                                         const std::string& object);

}  // namespace diptych::core::gltf
