#include "pack/fingerprint.h"

#include <fmt/format.h>

#include "digest.h"

namespace diptych::core {

namespace {

template <class T>
std::uint64_t digest_of_values(const T* values, std::size_t count, std::uint64_t hash) {
    static_assert(sizeof(T) % 4 == 0);  // packed without padding, whose bytes would be anything
    return digest_of({reinterpret_cast<const unsigned char*>(values), count * sizeof(T)}, hash);
}

}  // namespace

std::string scene_fingerprint(const PackedScene& packed) {
    std::uint64_t hash = digest_of({});
#define ADD_BUFFER(Type, name) hash = digest_of_values(packed.name.data(), packed.name.size(), hash ^ packed.name.size());
    SCENE_BUFFERS(ADD_BUFFER)
#undef ADD_BUFFER
    hash = digest_of_values(&packed.constants.camera, 1, hash);
    hash = digest_of_values(&packed.constants.environment, 1, hash);
    return fmt::format("{:016x}", hash);
}

}  // namespace diptych::core
