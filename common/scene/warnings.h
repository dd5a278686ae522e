// Warnings about a scene. Many objects may have the same fault, so warnings are counted by kind.
#pragma once

#include <cstddef>
#include <set>
#include <string>
#include <utility>
#include <vector>

namespace diptych::core {

/// One kind of fault, and the objects that have it.
struct Warning {
    std::string kind;         // what is wrong and what is done about it: "triangles have no area; dropped"
    std::string object;       // the first object that has the fault; empty where `kind` says it all
    std::string detail;       // more about the first object; may be empty
    std::size_t objects = 1;  // how many objects have the fault
    std::size_t amount = 0;   // of the first object, where the fault counts something; else 0
    std::size_t total = 0;    // sum of the amounts of all objects
};

class Warnings {
public:
    /// Counts `object` under `kind`, once however often it is added.
    void add(const std::string& kind, const std::string& object = {}, const std::string& detail = {});

    /// The same for a fault that occurs `amount` times in the object. An amount of 0 adds nothing.
    void add_amount(std::size_t amount, const std::string& kind, const std::string& object);

    void append(const Warnings& others);

    bool empty() const { return kinds_.empty(); }
    std::size_t size() const { return kinds_.size(); }

    /// One line a kind, in the order in which the kinds were first met:
    /// "meshes[0]: 2 triangles have no area; dropped (and 97 more objects; 196 in all)".
    std::vector<std::string> lines() const;

private:
    Warning* find_or_add(const std::string& kind, const std::string& object, const std::string& detail);

    std::vector<Warning> kinds_;
    std::set<std::pair<std::string, std::string>> counted_;  // kind and object
};

/// The line of one warning.
std::string line_of(const Warning& warning);

}  // namespace diptych::core
