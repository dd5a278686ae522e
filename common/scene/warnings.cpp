#include "scene/warnings.h"

#include <algorithm>

namespace diptych::core {

// Null where the object is counted already.
Warning* Warnings::find_or_add(const std::string& kind, const std::string& object, const std::string& detail) {
    if (!counted_.emplace(kind, object).second) {
        return nullptr;
    }
    const auto known = std::find_if(kinds_.begin(), kinds_.end(), [&](const Warning& w) { return w.kind == kind; });
    if (known != kinds_.end()) {
        ++known->objects;
        return &*known;
    }
    return &kinds_.emplace_back(Warning{.kind = kind, .object = object, .detail = detail});
}

void Warnings::add(const std::string& kind, const std::string& object, const std::string& detail) {
    find_or_add(kind, object, detail);
}

void Warnings::add_amount(std::size_t amount, const std::string& kind, const std::string& object) {
    if (amount == 0) {
        return;
    }
    if (Warning* warning = find_or_add(kind, object, {})) {
        warning->amount = warning->objects == 1 ? amount : warning->amount;
        warning->total += amount;
    }
}

void Warnings::append(const Warnings& others) {
    for (const Warning& other : others.kinds_) {
        if (Warning* warning = find_or_add(other.kind, other.object, other.detail)) {
            warning->objects += other.objects - 1;
            warning->amount = warning->amount == 0 ? other.amount : warning->amount;
            warning->total += other.total;
        }
    }
    counted_.insert(others.counted_.begin(), others.counted_.end());
}

std::vector<std::string> Warnings::lines() const {
    std::vector<std::string> lines;
    std::transform(kinds_.begin(), kinds_.end(), std::back_inserter(lines), line_of);
    return lines;
}

std::string line_of(const Warning& warning) {
    std::string line = warning.object.empty() ? "" : warning.object + ": ";
    line += (warning.amount > 0 ? std::to_string(warning.amount) + " " : "") + warning.kind;
    line += warning.detail.empty() ? "" : ": " + warning.detail;
    if (warning.objects > 1) {
        line += " (and " + std::to_string(warning.objects - 1) + " more object" + (warning.objects > 2 ? "s" : "");
        line += (warning.total > 0 ? "; " + std::to_string(warning.total) + " in all" : "") + ")";
    }
    return line;
}

}  // namespace diptych::core
