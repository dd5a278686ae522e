#include "spirv_accesses.h"

#include <vector>

#include "error.h"

namespace diptych::core::tests {
namespace {

using Words = std::span<const std::uint32_t>;

// SPIR-V 1.5, sections 3.7 and 3.32
enum Op : std::uint32_t {
    op_name = 5,
    op_member_name = 6,
    op_type_array = 28,
    op_type_runtime_array = 29,
    op_type_struct = 30,
    op_type_pointer = 32,
    op_constant = 43,
    op_function_call = 57,
    op_variable = 59,
    op_load = 61,
    op_store = 62,
    op_copy_memory = 63,
    op_access_chain = 65,
    op_in_bounds_access_chain = 66,
    op_convert_to_pointer = 120,
    op_bitcast = 124,
    op_atomic_load = 227,
    op_atomic_store = 228,
    op_atomic_xor = 242,
    op_type_acceleration_structure = 5341,
};

enum Storage : std::uint32_t { uniform_constant = 0, uniform = 2, storage_buffer = 12, physical_storage_buffer = 5349 };

class Reader {
public:
    explicit Reader(Words spirv) : spirv_(spirv) {
        each([this](std::uint32_t op, Words words) { define(op, words); });
        each([this](std::uint32_t op, Words words) { note(op, words); });
    }

    std::map<std::string, Accesses> found;

private:
    struct Chain {
        std::uint32_t base;
        Words indices;
    };

    template <class Visit>
    void each(const Visit& visit) const {
        for (std::size_t at = 5; at < spirv_.size(); at += spirv_[at] >> 16U) {
            visit(spirv_[at] & 0xffffU, spirv_.subspan(at, spirv_[at] >> 16U));
        }
    }

    static std::string text(Words words) { return reinterpret_cast<const char*>(words.data()); }

    void define(std::uint32_t op, Words words) {
        switch (op) {
        case op_name:
            names_[words[1]] = text(words.subspan(2));
            break;
        case op_member_name:
            member_names_[{words[1], words[2]}] = text(words.subspan(3));
            break;
        case op_type_array:
        case op_type_runtime_array:
        case op_type_struct:
        case op_type_pointer:
        case op_type_acceleration_structure:
            types_[words[1]] = words;
            break;
        case op_constant:
            constants_[words[2]] = words[3];
            break;
        case op_access_chain:
        case op_in_bounds_access_chain:
            chains_[words[2]] = {words[3], words.subspan(4)};
            pointers_[words[2]] = words[1];
            break;
        case op_variable:
        case op_load:
        case op_convert_to_pointer:
        case op_bitcast:
            pointers_[words[2]] = words[1];
            break;
        default:
            break;
        }
    }

    void note(std::uint32_t op, Words words) {
        if (op == op_load) {
            access(words[3], true, false);
        } else if (op == op_store || op == op_atomic_store) {
            access(words[1], false, true);
        } else if (op == op_copy_memory) {
            access(words[1], false, true);
            access(words[2], true, false);
        } else if (op == op_atomic_load) {
            access(words[3], true, false);
        } else if (op > op_atomic_store && op <= op_atomic_xor) {
            access(words[3], false, true);
        } else if (op == op_function_call) {
            for (const std::uint32_t argument : words.subspan(4)) {
                if (const auto type = pointers_.find(argument); type != pointers_.end() && is_memory(type->second)) {
                    throw Error("a pointer is handed to a function, where this reader does not follow it");
                }
            }
        }
    }

    bool is_memory(std::uint32_t type) const {
        const auto found_type = types_.find(type);
        if (found_type == types_.end() || (found_type->second[0] & 0xffffU) != op_type_pointer) {
            return false;
        }
        const std::uint32_t storage = found_type->second[2];
        return storage == uniform || storage == storage_buffer || storage == physical_storage_buffer;
    }

    void access(std::uint32_t pointer, bool reads, bool writes) {
        const auto type = pointers_.find(pointer);
        if (type == pointers_.end()) {
            return;  // a parameter of a function, which points to no such memory: see op_function_call
        }
        const Words pointed = types_.at(type->second);
        std::string name;
        if (is_memory(type->second)) {
            name = name_of(pointer);
        } else if (pointed[2] == uniform_constant && types_.contains(pointed[3]) &&
                   (types_.at(pointed[3])[0] & 0xffffU) == op_type_acceleration_structure) {
            name = "structures";
        } else {
            return;
        }
        found[name].reads |= reads;
        found[name].writes |= writes;
    }

    std::string name_of(std::uint32_t pointer) const {
        std::vector<std::uint32_t> indices;
        std::uint32_t base = pointer;
        for (auto chain = chains_.find(base); chain != chains_.end(); chain = chains_.find(base)) {
            indices.insert(indices.begin(), chain->second.indices.begin(), chain->second.indices.end());
            base = chain->second.base;
        }
        if (!pointers_.contains(base)) {
            throw Error("a pointer comes from where this reader does not follow it");
        }
        std::uint32_t type = types_.at(pointers_.at(base))[3];
        std::string name = names_.contains(type) ? names_.at(type) : "";
        if (name.ends_with("_buffer")) {
            name.resize(name.size() - std::string("_buffer").size());
        }
        bool in_element = false;
        for (const std::uint32_t index : indices) {
            const auto of_type = types_.find(type);
            if (of_type == types_.end()) {
                break;  // a vector
            }
            const std::uint32_t op = of_type->second[0] & 0xffffU;
            if (op == op_type_struct) {
                const std::uint32_t member = constants_.at(index);
                if (in_element) {
                    return name + "." + member_names_.at({type, member});
                }
                type = of_type->second[2 + member];
            } else {
                in_element = true;
                type = of_type->second[2];
            }
        }
        return name;
    }

    Words spirv_;
    std::map<std::uint32_t, std::string> names_;
    std::map<std::pair<std::uint32_t, std::uint32_t>, std::string> member_names_;
    std::map<std::uint32_t, Words> types_;
    std::map<std::uint32_t, std::uint32_t> constants_;
    std::map<std::uint32_t, Chain> chains_;
    std::map<std::uint32_t, std::uint32_t> pointers_;  // results that may be pointers, and their types
};

}  // namespace

std::map<std::string, Accesses> memory_accesses(std::span<const std::uint32_t> spirv) {
    return Reader(spirv).found;
}

}  // namespace diptych::core::tests
