// DLPack 1.0, the exchange of arrays between libraries of Python: https://dmlc.github.io/dlpack. The structs below are
// that page's, a stable binary interface.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <utility>
#include <vector>

#include "bindings.h"

namespace diptych::python {

/// Memory of the processor, float32, row-major. A capsule made of it keeps `owner` alive until its consumer lets go.
struct SharedArray {
    const float* data;
    std::vector<std::int64_t> shape;
    std::shared_ptr<const void> owner;
    bool copied = false;  // nobody else has this memory, so that it may be written
};

/// Major and minor version of DLPack that a consumer knows.
using DlpackVersion = std::optional<std::pair<int, int>>;

/// The pair that __dlpack_device__ returns.
py::tuple dlpack_device();

/// Throws BufferError where a consumer asks for a stream or for another device than the processor.
void require_dlpack_device(const py::object& stream, const py::object& device);

/// A capsule of DLPack 1.0, which says whether the memory may be written, where max_version allows it; else the older
/// one, which cannot say so.
py::capsule dlpack_capsule(SharedArray array, const DlpackVersion& max_version);

}  // namespace diptych::python
