#include "gltf/accessor.h"

#include <algorithm>
#include <cstring>
#include <limits>
#include <type_traits>

namespace diptych::core::gltf {
namespace {

// The most elements that an accessor may have without bytes in the file to back them. Other attributes of the same
// primitive need bytes for each of theirs, so more than the file has bytes make no sense.
std::size_t max_implied_elements(const tinygltf::Model& model) {
    std::size_t bytes = std::size_t{1} << 16;
    for (const tinygltf::Buffer& buffer : model.buffers) {
        bytes += buffer.data.size();
    }
    return bytes;
}

struct Span {
    const std::uint8_t* data = nullptr;
    std::size_t stride = 0;
};

// Where `count` elements of `size` bytes lie, after every range on the way has been checked.
Span find_span(const Document& document, int view_index, std::size_t offset, std::size_t count, std::size_t size,
               const std::string& object) {
    const tinygltf::Model& model = document.model;
    if (view_index < 0 || static_cast<std::size_t>(view_index) >= model.bufferViews.size()) {
        fail(document, object, "there is no bufferViews[" + std::to_string(view_index) + "]");
    }
    const std::string view_name = "bufferViews[" + std::to_string(view_index) + "]";
    const tinygltf::BufferView& view = model.bufferViews[static_cast<std::size_t>(view_index)];
    if (view.buffer < 0 || static_cast<std::size_t>(view.buffer) >= model.buffers.size()) {
        fail(document, object, view_name + " names buffers[" + std::to_string(view.buffer) + "], which is not there");
    }
    const Bytes& bytes = model.buffers[static_cast<std::size_t>(view.buffer)].data;
    if (view.byteOffset > bytes.size() || view.byteLength > bytes.size() - view.byteOffset) {
        fail(document, object, view_name + " ends past its buffer of " + std::to_string(bytes.size()) + " bytes");
    }
    const std::size_t stride = view.byteStride == 0 ? size : view.byteStride;
    if (stride < size) {
        fail(document, object,
             view_name + " has a byteStride of " + std::to_string(stride) + " for elements of " + std::to_string(size) +
                 " bytes");
    }
    const std::size_t available = offset > view.byteLength ? 0 : view.byteLength - offset;
    if (count > 0 && (available < size || (count - 1) > (available - size) / stride)) {
        fail(document, object,
             std::to_string(count) + " elements at offset " + std::to_string(offset) + " end past " + view_name +
                 " of " + std::to_string(view.byteLength) + " bytes");
    }
    if (count == 0) {
        return {bytes.data(), stride};
    }
    return {bytes.data() + view.byteOffset + offset, stride};
}

template <typename Stored>
Stored load(const std::uint8_t* at) {
    Stored value;
    std::memcpy(&value, at, sizeof value);
    return value;
}

template <typename Stored, typename Number>
Number convert(Stored value, bool normalized) {
    if constexpr (std::is_same_v<Stored, float> || !std::is_same_v<Number, float>) {
        return static_cast<Number>(value);
    } else {
        if (!normalized) {
            return static_cast<float>(value);
        }
        const auto largest = static_cast<double>(std::numeric_limits<Stored>::max());
        return static_cast<float>(std::max(static_cast<double>(value) / largest, -1.0));
    }
}

template <typename Stored, typename Number>
void copy(Span from, std::size_t count, std::size_t components, bool normalized, Number* to) {
    for (std::size_t i = 0; i < count; ++i) {
        for (std::size_t c = 0; c < components; ++c) {
            *to++ = convert<Stored, Number>(load<Stored>(from.data + i * from.stride + c * sizeof(Stored)), normalized);
        }
    }
}

template <typename Number>
void copy_typed(Span from, int type, std::size_t count, std::size_t components, bool normalized, Number* to) {
    switch (type) {
    case TINYGLTF_COMPONENT_TYPE_BYTE:
        return copy<std::int8_t>(from, count, components, normalized, to);
    case TINYGLTF_COMPONENT_TYPE_UNSIGNED_BYTE:
        return copy<std::uint8_t>(from, count, components, normalized, to);
    case TINYGLTF_COMPONENT_TYPE_SHORT:
        return copy<std::int16_t>(from, count, components, normalized, to);
    case TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT:
        return copy<std::uint16_t>(from, count, components, normalized, to);
    case TINYGLTF_COMPONENT_TYPE_UNSIGNED_INT:
        return copy<std::uint32_t>(from, count, components, normalized, to);
    default:
        return copy<float>(from, count, components, normalized, to);
    }
}

std::size_t component_size(const Document& document, int type, const std::string& object) {
    switch (type) {
    case TINYGLTF_COMPONENT_TYPE_BYTE:
    case TINYGLTF_COMPONENT_TYPE_UNSIGNED_BYTE:
        return 1;
    case TINYGLTF_COMPONENT_TYPE_SHORT:
    case TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT:
        return 2;
    case TINYGLTF_COMPONENT_TYPE_UNSIGNED_INT:
    case TINYGLTF_COMPONENT_TYPE_FLOAT:
        return 4;
    default:
        fail(document, object, "has componentType " + std::to_string(type) + ", which glTF 2.0 does not have");
    }
}

bool is_unsigned(int type) {
    return type == TINYGLTF_COMPONENT_TYPE_UNSIGNED_BYTE || type == TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT ||
           type == TINYGLTF_COMPONENT_TYPE_UNSIGNED_INT;
}

template <typename Number>
void apply_sparse(const Document& document, const tinygltf::Accessor& accessor, std::size_t components,
                  std::size_t size, const std::string& object, std::vector<Number>& numbers) {
    const auto& sparse = accessor.sparse;
    if (sparse.count < 0 || static_cast<std::size_t>(sparse.count) > accessor.count) {
        fail(document, object,
             "sparse.count is " + std::to_string(sparse.count) + " of " + std::to_string(accessor.count));
    }
    if (sparse.indices.byteOffset < 0 || sparse.values.byteOffset < 0) {
        fail(document, object, "sparse has a negative byteOffset");
    }
    if (!is_unsigned(sparse.indices.componentType)) {
        fail(document, object, "sparse.indices.componentType is not an unsigned integer");
    }
    const auto count = static_cast<std::size_t>(sparse.count);
    const Span index_span =
        find_span(document, sparse.indices.bufferView, static_cast<std::size_t>(sparse.indices.byteOffset), count,
                  component_size(document, sparse.indices.componentType, object), object + ".sparse.indices");
    const Span value_span =
        find_span(document, sparse.values.bufferView, static_cast<std::size_t>(sparse.values.byteOffset), count, size,
                  object + ".sparse.values");
    ask_memory(document, object, bytes_of(count, sizeof(std::uint32_t) + components * sizeof(Number)));
    std::vector<std::uint32_t> indices(count);
    copy_typed(index_span, sparse.indices.componentType, count, 1, false, indices.data());
    std::vector<Number> values(count * components);
    copy_typed(value_span, accessor.componentType, count, components, accessor.normalized, values.data());
    for (std::size_t i = 0; i < count; ++i) {
        if (indices[i] >= accessor.count || (i > 0 && indices[i] <= indices[i - 1])) {
            fail(document, object,
                 "sparse index " + std::to_string(indices[i]) + " is out of order, or not below " +
                     std::to_string(accessor.count));
        }
        std::copy_n(values.begin() + static_cast<std::ptrdiff_t>(i * components), components,
                    numbers.begin() + static_cast<std::ptrdiff_t>(indices[i] * components));
    }
}

template <typename Number>
std::vector<Number> read(const Document& document, const tinygltf::Accessor& accessor, std::size_t components,
                         const std::string& object) {
    const std::int32_t have = tinygltf::GetNumComponentsInType(static_cast<std::uint32_t>(accessor.type));
    if (have < 0 || static_cast<std::size_t>(have) != components) {
        fail(document, object,
             "has " + std::to_string(have) + " components where " + std::to_string(components) + " are needed");
    }
    const std::size_t size = component_size(document, accessor.componentType, object) * components;
    Span span;
    if (accessor.bufferView >= 0) {
        span = find_span(document, accessor.bufferView, accessor.byteOffset, accessor.count, size, object);
    } else if (const std::size_t most = max_implied_elements(document.model); accessor.count > most) {
        fail(document, object,
             "has " + std::to_string(accessor.count) + " elements and no buffer view; a file of this size may have " +
                 std::to_string(most));
    }
    ask_memory(document, object, bytes_of(accessor.count, components * sizeof(Number)));
    std::vector<Number> numbers(accessor.count * components);
    if (span.data != nullptr) {
        copy_typed(span, accessor.componentType, accessor.count, components, accessor.normalized, numbers.data());
    }
    if (accessor.sparse.isSparse) {
        apply_sparse(document, accessor, components, size, object, numbers);
    }
    return numbers;
}

}  // namespace

const tinygltf::Accessor& find_accessor(const Document& document, int index, const std::string& object) {
    if (index < 0 || static_cast<std::size_t>(index) >= document.model.accessors.size()) {
        fail(document, object, "there is no accessors[" + std::to_string(index) + "]");
    }
    return document.model.accessors[static_cast<std::size_t>(index)];
}

std::vector<float> read_numbers(const Document& document, int index, std::size_t components,
                                const std::string& object) {
    return read<float>(document, find_accessor(document, index, object), components, object);
}

std::vector<std::uint32_t> read_integers(const Document& document, int index, std::size_t components,
                                         const std::string& object) {
    const tinygltf::Accessor& accessor = find_accessor(document, index, object);
    if (!is_unsigned(accessor.componentType)) {
        fail(document, object,
             "has componentType " + std::to_string(accessor.componentType) + " where an unsigned integer is needed");
    }
    return read<std::uint32_t>(document, accessor, components, object);
}

}  // namespace diptych::core::gltf
