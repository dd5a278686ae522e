// A glTF file taken apart: the JSON as tinygltf's structures, the buffers' bytes, and the images still encoded.
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <nlohmann/json.hpp>
#include <string>
#include <tiny_gltf.h>
#include <vector>

#include "gltf/import.h"
#include "memory_budget.h"
#include "scene/warnings.h"

namespace diptych::core::gltf {

using Bytes = std::vector<std::uint8_t>;

/// An image as the file has it. `problem` says why there are no bytes; it matters only to those who need the image.
struct EncodedImage {
    std::string name;
    Bytes bytes;
    std::string problem;
};

struct Document {
    std::string file;
    std::filesystem::path folder;
    tinygltf::Model model;  // its `images`, `animations` and buffers' `uri` are empty: this project reads them
    std::vector<EncodedImage> images;
    nlohmann::json animations;  // an array, as it stands in the file
    bool strict = false;          // a warning is an error
    bool allow_external = false;  // URIs may lead out of the folder
    std::shared_ptr<MemoryBudget> budget;
    Warnings warnings;
};

/// Throws Error "file: object: reason".
[[noreturn]] void fail(const Document& document, const std::string& object, const std::string& reason);

/// Counts bytes that are about to be allocated for the object. Throws OverBudget "file: object: reason".
void ask_memory(const Document& document, const std::string& object, std::uint64_t bytes);

/// Counts `object` under the warning `kind` (warnings.h); `detail` is more about this object. Throws Error instead
/// where the document is read strictly.
void warn(Document& document, const std::string& object, const std::string& kind, const std::string& detail = {});

/// The same for a fault that occurs `amount` times in the object, which may be 0.
void warn_amount(Document& document, const std::string& object, std::size_t amount, const std::string& kind);

/// The same, into the warnings of a clip.
void warn(const Document& document, Warnings& warnings, const std::string& object, const std::string& kind,
          const std::string& detail = {});

/// "meshes[2]", or "meshes[2] (name)".
std::string label(const char* table, std::size_t index, const std::string& name = {});

/// True where `name` stands in extensionsUsed or extensionsRequired.
bool declares_extension(const Document& document, const std::string& name);

/// Reads a .gltf or .glb (told by its content) with its buffers and encoded images. Throws Error where the file, its
/// JSON or a buffer cannot be read, or where it requires an extension that the import lacks and
/// that is not among the ignored ones.
Document read_document(const std::filesystem::path& path, const GltfOptions& options = {});

}  // namespace diptych::core::gltf
