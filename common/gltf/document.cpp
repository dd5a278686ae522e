#include "gltf/document.h"

#include <algorithm>
#include <array>
#include <limits>
#include <nlohmann/json.hpp>
#include <optional>

#include "error.h"
#include "input_file.h"
#include "one_line.h"
#include "gltf/bytes.h"
#include "gltf/parse.h"
#include "gltf/schema.h"

namespace diptych::core::gltf {
namespace {

using ParsedJson = nlohmann::json;

constexpr std::array<const char*, 9> supported_extensions{
    "EXT_texture_webp",  "KHR_animation_pointer",  "KHR_lights_punctual", "KHR_materials_emissive_strength",
    "KHR_materials_ior", "KHR_materials_specular", "KHR_materials_unlit", "KHR_mesh_quantization",
    "KHR_texture_transform"};

template <class List>
bool contains(const List& list, const std::string& word) {
    return std::find(list.begin(), list.end(), word) != list.end();
}

void check_version(const Document& document, const ParsedJson& root) {
    const auto asset = root.find("asset");
    if (asset == root.end() || !asset->is_object() || !asset->contains("version") || !(*asset)["version"].is_string()) {
        fail(document, "asset.version", "is missing");
    }
    const std::string& version = (*asset)["version"].get_ref<const std::string&>();
    if (version.rfind("2.", 0) != 0) {
        fail(document, "asset.version", "is " + one_line(version) + "; only 2.0 is supported");
    }
    const auto minimum = asset->find("minVersion");
    if (minimum != asset->end() && minimum->is_string() && *minimum != "2.0") {
        fail(document, "asset.minVersion", "is " + one_line(minimum->get<std::string>()) + "; only 2.0 is supported");
    }
}

ParsedJson take_array(ParsedJson& root, const char* table) {
    const auto found = root.find(table);
    if (found == root.end()) {
        return ParsedJson::array();
    }
    ParsedJson taken = std::move(*found);
    root.erase(found);
    return taken.is_array() ? taken : ParsedJson::array();
}

// A non-negative integer of a JSON object.
std::optional<std::uint64_t> unsigned_member(const ParsedJson& object, const char* key) {
    const auto found = object.find(key);
    if (found == object.end() || !found->is_number_unsigned()) {
        return std::nullopt;
    }
    return found->get<std::uint64_t>();
}

std::string string_member(const ParsedJson& object, const char* key) {
    const auto found = object.find(key);
    return found != object.end() && found->is_string() ? found->get<std::string>() : std::string();
}

void read_buffers(Document& document, const ParsedJson& buffers, std::optional<Bytes> binary) {
    for (std::size_t i = 0; i < buffers.size(); ++i) {
        const ParsedJson& entry = buffers[i];
        const std::string object = label("buffers", i, entry.is_object() ? string_member(entry, "name") : "");
        if (!entry.is_object()) {
            fail(document, object, "is not an object");
        }
        const std::optional<std::uint64_t> length = unsigned_member(entry, "byteLength");
        if (!length) {
            fail(document, object + ".byteLength", "is missing or not a positive integer");
        }
        tinygltf::Buffer buffer;
        if (entry.contains("uri")) {
            try {
                buffer.data = read_uri(string_member(entry, "uri"), {document.folder, document.allow_external, *document.budget});
            } catch (const Error& error) {
                fail(document, object + ".uri", error.what());
            }
        } else if (i == 0 && binary) {
            ask_memory(document, object, binary->size());
            buffer.data = *std::move(binary);
            binary.reset();
        } else {
            warn(document, object, "has neither a URI nor a binary chunk");
            document.model.buffers.push_back(std::move(buffer));
            continue;
        }
        if (*length > buffer.data.size()) {
            fail(document, object,
                 "byteLength is " + std::to_string(*length) + ", but there are " + std::to_string(buffer.data.size()) +
                     " bytes");
        }
        buffer.data.resize(*length);
        document.model.buffers.push_back(std::move(buffer));
    }
}

Bytes view_bytes(const Document& document, std::uint64_t index) {
    if (index >= document.model.bufferViews.size()) {
        throw Error("there is no bufferViews[" + std::to_string(index) + "]");
    }
    const tinygltf::BufferView& view = document.model.bufferViews[index];
    if (view.buffer < 0 || static_cast<std::size_t>(view.buffer) >= document.model.buffers.size()) {
        throw Error("bufferViews[" + std::to_string(index) + "] names no buffer");
    }
    const Bytes& data = document.model.buffers[static_cast<std::size_t>(view.buffer)].data;
    if (view.byteOffset > data.size() || view.byteLength > data.size() - view.byteOffset) {
        throw Error("bufferViews[" + std::to_string(index) + "] ends past its buffer");
    }
    document.budget->ask(view.byteLength);
    const auto begin = data.begin() + static_cast<std::ptrdiff_t>(view.byteOffset);
    return {begin, begin + static_cast<std::ptrdiff_t>(view.byteLength)};
}

void read_images(Document& document, const ParsedJson& images) {
    for (const ParsedJson& entry : images) {
        EncodedImage image;
        try {
            if (!entry.is_object()) {
                throw Error("is not an object");
            }
            image.name = string_member(entry, "name");
            const std::string uri = string_member(entry, "uri");
            if (image.name.empty() && uri.rfind("data:", 0) != 0) {
                image.name = decode_percent(uri);
            }
            if (entry.contains("uri")) {
                image.bytes = read_uri(uri, {document.folder, document.allow_external, *document.budget});
            } else if (const std::optional<std::uint64_t> view = unsigned_member(entry, "bufferView")) {
                image.bytes = view_bytes(document, *view);
            } else {
                throw Error("has neither a URI nor a buffer view");
            }
        } catch (const RefusedUri& error) {
            fail(document, label("images", document.images.size(), image.name) + ".uri", error.what());
        } catch (const OverBudget& error) {
            fail(document, label("images", document.images.size(), image.name), error.what());
        } catch (const Error& error) {
            image.problem = error.what();
        }
        document.images.push_back(std::move(image));
    }
}

std::vector<std::string> strings_of(const ParsedJson& root, const char* key) {
    std::vector<std::string> strings;
    if (const auto found = root.find(key); found != root.end() && found->is_array()) {
        for (const ParsedJson& entry : *found) {
            if (entry.is_string()) {
                strings.push_back(one_line(entry.get<std::string>()));
            }
        }
    }
    return strings;
}

// Whether every texture of KHR_texture_basisu, which is not supported, has another image to fall back on.
bool textures_have_fallbacks(const ParsedJson& root) {
    const auto textures = root.find("textures");
    return textures == root.end() || !textures->is_array() ||
           std::all_of(textures->begin(), textures->end(), [](const ParsedJson& texture) {
               const ParsedJson extensions = texture.is_object() ? texture.value("extensions", ParsedJson()) : ParsedJson();
               return !extensions.is_object() || !extensions.contains("KHR_texture_basisu") ||
                      texture.contains("source") || extensions.contains("EXT_texture_webp");
           });
}

void check_extensions(Document& document, const ParsedJson& root, const std::vector<std::string>& ignored) {
    const std::vector<std::string> required = strings_of(root, "extensionsRequired");
    for (const std::string& extension : required) {
        if (contains(supported_extensions, extension)) {
            continue;
        }
        if (extension == "KHR_texture_basisu" && !contains(ignored, extension) && textures_have_fallbacks(root)) {
            warn(document, "extensionsRequired", extension + " is not supported; its textures' other images are used");
            continue;
        }
        if (!contains(ignored, extension)) {
            fail(document, "extensionsRequired",
                 "needs " + extension + ", which is not supported (`ignored_extensions` " + extension +
                     " does without it)");
        }
        document.warnings.add(extension + " is ignored, as asked for", document.file + ": extensionsRequired");
    }
    for (const std::string& extension : strings_of(root, "extensionsUsed")) {
        if (!contains(supported_extensions, extension) && !contains(required, extension)) {
            warn(document, "extensionsUsed", extension + " is not supported and is left out");
        }
    }
    for (const std::string& extension : ignored) {
        if (!contains(required, extension) || contains(supported_extensions, extension)) {
            warn(document, "extensionsRequired",
                 "there is no " + extension + " to ignore: it is not required, or supported");
        }
    }
}

// tinygltf leaves a remark on what it dropped even where it reports success.
void pass_on_remarks(Document& document, const std::string& remarks) {
    std::size_t begin = 0;
    while (begin < remarks.size()) {
        const std::size_t end = std::min(remarks.find('\n', begin), remarks.size());
        const std::string line = one_line(remarks.substr(begin, end - begin));
        if (!line.empty() && line.find("inverseBindMatrices") == std::string::npos) {
            warn(document, "JSON", line);
        }
        begin = end + 1;
    }
}

}  // namespace

void fail(const Document& document, const std::string& object, const std::string& reason) {
    throw Error(one_line(document.file + ": " + object + ": " + reason));
}

void ask_memory(const Document& document, const std::string& object, std::uint64_t bytes) {
    try {
        document.budget->ask(bytes);
    } catch (const OverBudget& error) {
        throw OverBudget(one_line(document.file + ": " + object + ": " + error.what()));
    }
}

void warn(const Document& document, Warnings& warnings, const std::string& object, const std::string& kind,
          const std::string& detail) {
    if (document.strict) {
        fail(document, object, kind + (detail.empty() ? "" : ": " + detail));
    }
    warnings.add(one_line(kind), one_line(document.file + ": " + object), one_line(detail));
}

void warn(Document& document, const std::string& object, const std::string& kind, const std::string& detail) {
    warn(document, document.warnings, object, kind, detail);
}

void warn_amount(Document& document, const std::string& object, std::size_t amount, const std::string& kind) {
    if (document.strict && amount > 0) {
        fail(document, object, std::to_string(amount) + " " + kind);
    }
    document.warnings.add_amount(amount, kind, one_line(document.file + ": " + object));
}

std::string label(const char* table, std::size_t index, const std::string& name) {
    const std::string text = std::string(table) + "[" + std::to_string(index) + "]";
    return name.empty() ? text : text + " (" + one_line(name) + ")";
}

bool declares_extension(const Document& document, const std::string& name) {
    return contains(document.model.extensionsUsed, name) || contains(document.model.extensionsRequired, name);
}

Document read_document(const std::filesystem::path& path, const GltfOptions& options) {
    Document document;
    document.strict = options.strict;
    document.allow_external = options.allow_external;
    document.budget = std::make_shared<MemoryBudget>(options.memory_limit);
    document.file = path.string();
    document.folder = path.parent_path();
    Bytes bytes;
    GlbChunks chunks;
    try {
        bytes = read_file(path, *document.budget);
        if (bytes.empty()) {
            throw Error("the file is empty");
        }
        if (is_glb(bytes)) {
            chunks = split_glb(bytes);
        } else {
            chunks.json = {reinterpret_cast<const char*>(bytes.data()), bytes.size()};
        }
    } catch (const Error& error) {
        throw Error(document.file + ": " + error.what());
    }
    ParsedJson root = parse_json(document, chunks.json);
    check_version(document, root);
    check_types(document, root);
    check_extensions(document, root, options.ignored_extensions);
    const ParsedJson buffers = take_array(root, "buffers");
    const ParsedJson images = take_array(root, "images");
    document.animations = take_array(root, "animations");
    root.erase("extras");

    const std::string text = root.dump();
    if (text.size() > std::numeric_limits<unsigned int>::max()) {
        fail(document, "JSON", "has more than 4 GB");
    }
    std::string errors;
    std::string warnings;
    tinygltf::TinyGLTF reader;
    const bool read = reader.LoadASCIIFromString(&document.model, &errors, &warnings, text.data(),
                                                 static_cast<unsigned int>(text.size()), ".");
    if (!read) {
        fail(document, "JSON",
             errors.empty() ? "an object lacks a required property, such as a skin its joints" : one_line(errors));
    }
    pass_on_remarks(document, errors + warnings);
    read_buffers(document, buffers, std::move(chunks.binary));
    read_images(document, images);
    return document;
}

}  // namespace diptych::core::gltf
