// Warnings are counted by kind, and each kind is one line.
#include "scene/warnings.h"

#include "catch.h"

using namespace diptych::core;

TEST_CASE("warnings of one kind are one line with the first object and how many more", "[warnings]") {
    Warnings warnings;
    CHECK(warnings.empty());
    warnings.add("is bent", "nodes[0]", "by 3");
    warnings.add("has no name", "nodes[0]");
    warnings.add("is bent", "nodes[1]", "by 4");
    warnings.add("is bent", "nodes[1]", "by 5");  // known
    warnings.add("the scene is empty");
    CHECK(warnings.lines() == std::vector<std::string>{"nodes[0]: is bent: by 3 (and 1 more object)",
                                                       "nodes[0]: has no name", "the scene is empty"});
    for (int i = 0; i < 96; ++i) {
        warnings.add("has no name", "nodes[" + std::to_string(i + 1) + "]");
    }
    CHECK(warnings.size() == 3);
    CHECK(warnings.lines()[1] == "nodes[0]: has no name (and 96 more objects)");
}

TEST_CASE("amounts are those of the first object and of all", "[warnings]") {
    Warnings warnings;
    warnings.add_amount(0, "triangles are flat", "a");
    CHECK(warnings.empty());
    warnings.add_amount(2, "triangles are flat", "b");
    CHECK(warnings.lines().at(0) == "b: 2 triangles are flat");
    warnings.add_amount(5, "triangles are flat", "c");
    warnings.add_amount(7, "triangles are flat", "d");
    CHECK(warnings.lines().at(0) == "b: 2 triangles are flat (and 2 more objects; 14 in all)");
}

TEST_CASE("warnings of several places are counted together", "[warnings]") {
    Warnings all;
    all.add("is bent", "a");
    Warnings others;
    others.add_amount(3, "holes", "c");
    others.add_amount(4, "holes", "d");
    others.add("is bent", "b");
    all.append(others);
    CHECK(all.lines() == std::vector<std::string>{"a: is bent (and 1 more object)",
                                                  "c: 3 holes (and 1 more object; 7 in all)"});
}
