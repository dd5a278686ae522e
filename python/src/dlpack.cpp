#include "dlpack.h"

namespace diptych::python {

namespace {

constexpr std::int32_t cpu_device = 1;  // kDLCPU
constexpr std::uint8_t float_code = 2;  // kDLFloat
constexpr std::uint64_t read_only = 1;  // DLPACK_FLAG_BITMASK_READ_ONLY
constexpr std::uint64_t is_copied = 2;  // DLPACK_FLAG_BITMASK_IS_COPIED

struct DLDevice {
    std::int32_t device_type;
    std::int32_t device_id;
};

struct DLDataType {
    std::uint8_t code;
    std::uint8_t bits;
    std::uint16_t lanes;
};

struct DLTensor {
    void* data;
    DLDevice device;
    std::int32_t ndim;
    DLDataType dtype;
    std::int64_t* shape;
    std::int64_t* strides;  // in elements
    std::uint64_t byte_offset;
};

struct DLManagedTensor {
    DLTensor dl_tensor;
    void* manager_ctx;
    void (*deleter)(DLManagedTensor* self);
};

struct DLPackVersion {
    std::uint32_t major;
    std::uint32_t minor;
};

struct DLManagedTensorVersioned {
    DLPackVersion version;
    void* manager_ctx;
    void (*deleter)(DLManagedTensorVersioned* self);
    std::uint64_t flags;
    DLTensor dl_tensor;
};

static_assert(sizeof(void*) != 8 || (sizeof(DLTensor) == 48 && sizeof(DLManagedTensor) == 64 &&
                                     sizeof(DLManagedTensorVersioned) == 80));

/// What a capsule holds; the consumer frees it by its deleter, in any thread.
template <typename Managed>
struct Held {
    explicit Held(SharedArray given) : array(std::move(given)), strides(array.shape.size(), 1) {
        for (std::size_t i = strides.size(); i-- > 1;) {
            strides[i - 1] = strides[i] * array.shape[i];
        }
        managed.manager_ctx = this;
        managed.deleter = [](Managed* self) { delete static_cast<Held*>(self->manager_ctx); };
        // The struct has no const. What may be done with the memory, flags say.
        managed.dl_tensor = {const_cast<float*>(array.data),
                             {cpu_device, 0},
                             static_cast<std::int32_t>(array.shape.size()),
                             {float_code, 32, 1},
                             array.shape.data(),
                             strides.data(),
                             0};
    }

    SharedArray array;
    std::vector<std::int64_t> strides;
    Managed managed{};
};

template <typename Managed>
constexpr const char* capsule_name = "dltensor";
template <>
constexpr const char* capsule_name<DLManagedTensorVersioned> = "dltensor_versioned";

template <typename Managed>
py::capsule capsule_of(std::unique_ptr<Held<Managed>> held) {
    PyObject* capsule = PyCapsule_New(&held->managed, capsule_name<Managed>, [](PyObject* self) {
        // A consumer renames the capsule, and frees what it holds itself.
        if (PyCapsule_IsValid(self, capsule_name<Managed>) != 0) {
            auto* managed = static_cast<Managed*>(PyCapsule_GetPointer(self, capsule_name<Managed>));
            managed->deleter(managed);
        }
    });
    if (capsule == nullptr) {
        throw py::error_already_set();
    }
    held.release();  // the capsule's from here on
    return py::reinterpret_steal<py::capsule>(capsule);
}

}  // namespace

py::tuple dlpack_device() {
    return py::make_tuple(cpu_device, 0);
}

void require_dlpack_device(const py::object& stream, const py::object& device) {
    if (!stream.is_none()) {
        throw py::buffer_error("stream: a film lies in the processor's memory, where there are none");
    }
    if (!device.is_none() && !device.equal(dlpack_device())) {
        throw py::buffer_error("dl_device: a film lies in the processor's memory, (1, 0)");
    }
}

py::capsule dlpack_capsule(SharedArray array, const DlpackVersion& max_version) {
    if (!max_version || max_version->first < 1) {
        return capsule_of(std::make_unique<Held<DLManagedTensor>>(std::move(array)));
    }
    auto held = std::make_unique<Held<DLManagedTensorVersioned>>(std::move(array));
    held->managed.version = {1, 0};
    held->managed.flags = held->array.copied ? is_copied : read_only;
    return capsule_of(std::move(held));
}

}  // namespace diptych::python
