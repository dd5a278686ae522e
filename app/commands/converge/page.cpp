#include "commands/converge/page.h"

#include <fmt/format.h>

#include <cmath>
#include <cstdlib>
#include <fstream>
#include <iterator>

#include "image/atomic_file.h"
#include "measure/converge/method.h"
#include "page_texts.h"

namespace diptych::core::app {

namespace {

std::string base64(const std::string& bytes) {
    constexpr const char* digits = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    std::string text;
    text.reserve(bytes.size() / 3 * 4 + 4);
    for (std::size_t i = 0; i < bytes.size(); i += 3) {
        std::uint32_t group = 0;
        const std::size_t count = std::min<std::size_t>(3, bytes.size() - i);
        for (std::size_t k = 0; k < 3; ++k) {
            group = group << 8U | (k < count ? static_cast<unsigned char>(bytes[i + k]) : 0U);
        }
        for (std::size_t k = 0; k < 4; ++k) {
            text += k <= count ? digits[group >> (18 - 6 * k) & 63U] : '=';
        }
    }
    return text;
}

/// A PNG as a data URI; null where there is none.
nlohmann::ordered_json embedded(const std::string& path) {
    std::ifstream file(path, std::ios::binary);
    if (!file) {
        return nullptr;
    }
    const std::string bytes{std::istreambuf_iterator<char>(file), std::istreambuf_iterator<char>()};
    return "data:image/png;base64," + base64(bytes);
}

/// JSON that a script element can hold: no "</" ends it early.
std::string script_text(const nlohmann::ordered_json& json) {
    std::string text;
    for (const char c : json.dump(-1, ' ', false, nlohmann::ordered_json::error_handler_t::replace)) {
        text += c == '<' ? std::string("\\u003c") : std::string(1, c);
    }
    return text;
}

/// What a chart needs of the numbers: six digits.
nlohmann::ordered_json rounded(nlohmann::ordered_json json) {
    if (json.is_number_float()) {
        const double value = json;
        return std::isfinite(value) ? nlohmann::ordered_json(std::strtod(fmt::format("{:.6g}", value).c_str(), nullptr))
                                    : nullptr;
    }
    if (json.is_structured()) {
        for (auto& value : json) {
            value = rounded(value);
        }
    }
    return json;
}

std::string html_text(const std::string& plain) {
    std::string text;
    for (const char c : plain) {
        text += c == '<' ? "&lt;" : c == '>' ? "&gt;" : c == '&' ? "&amp;" : c == '"' ? "&quot;" : std::string(1, c);
    }
    return text;
}

/// The template with each {{NAME}} replaced, in one pass: what is put in is not looked at again.
std::string filled(std::string_view page, const std::map<std::string, std::string>& values) {
    std::string text;
    for (std::size_t at = 0;;) {
        const std::size_t open = page.find("{{", at);
        if (open == std::string_view::npos) {
            return text.append(page.substr(at));
        }
        const std::size_t close = page.find("}}", open);
        text.append(page.substr(at, open - at)).append(values.at(std::string(page.substr(open + 2, close - open - 2))));
        at = close + 2;
    }
}

}  // namespace

void write_page(const nlohmann::ordered_json& summary, const ConvergeState& state) {
    nlohmann::ordered_json pictures = {{"reference", {{"picture", embedded(state.path("pictures/reference.png"))}}}};
    for (const auto& method : summary.at("methods")) {
        const std::string stem = "pictures/" + file_stem(method.at("method"));
        pictures[method.at("method").get<std::string>()] = {{"picture", embedded(state.path(stem + ".png"))},
                                                            {"error", embedded(state.path(stem + "-error.png"))}};
    }
    const std::string scene = summary.at("scene");
    const std::string name =
        scene.substr(scene.find_last_of('/') == std::string::npos ? 0 : scene.find_last_of('/') + 1);
    write_file_atomically(state.path("index.html"),
                          filled(page_text("page.html"), {{"TITLE", html_text(name)},
                                                          {"STYLE", std::string(page_text("page.css"))},
                                                          {"DATA", script_text(rounded(summary))},
                                                          {"PICTURES", script_text(pictures)},
                                                          {"CHART", std::string(page_text("chart.js"))},
                                                          {"VIEWER", std::string(page_text("viewer.js"))},
                                                          {"SCRIPT", std::string(page_text("page.js"))}}));
}

}  // namespace diptych::core::app
