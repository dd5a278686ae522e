#include "gltf/parse.h"

#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

namespace diptych::core::gltf {
namespace {

using ParsedJson = nlohmann::json;

// Far deeper than any glTF, and shallow enough for functions that recurse over the document.
constexpr std::size_t max_json_depth = 128;

/// Builds the document from the parser's events. The library's own parser with a callback searches an object's siblings
/// after each object, which takes quadratic time; the one without a callback limits no depth and lets the last of two
/// members with one name win.
class Builder final : public nlohmann::json_sax<ParsedJson> {
public:
    explicit Builder(const Document& document) : document_(document) {}

    ParsedJson take() { return std::move(root_); }

    bool null() override { return add(nullptr); }
    bool boolean(bool value) override { return add(value); }
    bool number_integer(std::int64_t value) override { return add(value); }
    bool number_unsigned(std::uint64_t value) override { return add(value); }
    bool number_float(double value, const std::string&) override { return add(value); }
    bool string(std::string& value) override { return add(std::move(value)); }
    bool binary(ParsedJson::binary_t&) override { return false; }  // not in text
    bool start_object(std::size_t) override { return open(ParsedJson::object()); }
    bool start_array(std::size_t) override { return open(ParsedJson::array()); }
    bool end_object() override { return close(); }
    bool end_array() override { return close(); }

    bool key(std::string& name) override {
        Level& level = open_.back();
        const auto [member, added] = level.container->get_ref<ParsedJson::object_t&>().emplace(name, nullptr);
        level.name = &member->first;
        level.member = &member->second;
        if (!added) {
            fail(document_, pointer(), "stands twice in one object");
        }
        return true;
    }

    bool parse_error(std::size_t, const std::string& token, const nlohmann::detail::exception& error) override {
        constexpr int number_overflow = 406;
        if (error.id == number_overflow) {
            fail(document_, pointer(), "is out of range: " + token.substr(0, 40));
        }
        fail(document_, "JSON", error.what());
    }

private:
    struct Level {
        ParsedJson* container;
        const std::string* name = nullptr;  // of an object: the member that is being read
        ParsedJson* member = nullptr;
    };

    ParsedJson& place(ParsedJson&& value) {
        if (open_.empty()) {
            return root_ = std::move(value);
        }
        const Level& level = open_.back();
        return level.name != nullptr ? *level.member = std::move(value)
                                     : level.container->get_ref<ParsedJson::array_t&>().emplace_back(std::move(value));
    }

    bool add(ParsedJson&& value) {
        place(std::move(value));
        return true;
    }

    bool open(ParsedJson&& container) {
        if (open_.size() == max_json_depth) {
            fail(document_, "JSON", "nested deeper than " + std::to_string(max_json_depth) + " levels");
        }
        open_.push_back({&place(std::move(container))});
        return true;
    }

    bool close() {
        open_.pop_back();
        return true;
    }

    /// Of the value that is being read.
    std::string pointer() const {
        std::string text;
        for (std::size_t i = 0; i < open_.size(); ++i) {
            // In an array, an inner container stands there already, and the innermost value does not.
            const std::size_t index = open_[i].container->size() - (i + 1 < open_.size() ? 1 : 0);
            text += pointer_part(open_[i].name != nullptr ? *open_[i].name : std::to_string(index));
        }
        return text;
    }

    const Document& document_;
    ParsedJson root_;
    std::vector<Level> open_;
};

}  // namespace

ParsedJson parse_json(const Document& document, std::string_view text) {
    Builder builder(document);
    ParsedJson::sax_parse(text.begin(), text.end(), &builder);
    ParsedJson root = builder.take();
    if (!root.is_object()) {
        fail(document, "JSON", "the root is not an object");
    }
    return root;
}

std::string pointer_part(std::string_view name) {
    std::string part = "/";
    for (const char c : name) {
        part += c == '~' ? "~0" : c == '/' ? "~1" : std::string(1, c);
    }
    return part;
}

}  // namespace diptych::core::gltf
