// Films in files: back to the bit, merged, gone on from; the program's files among them.
#include <cmath>
#include <cstdlib>
#include <fstream>
#include <iterator>

#include "library/library_fixture.h"

using namespace library_tests;

namespace {

dp::Film part_of(const dp::Scene& scene, std::uint32_t first, std::uint32_t count,
                 const dp::Settings& settings = small_settings()) {
    dp::Session session(scene, {}, settings);
    session.render_range(first, count);
    return session.film();
}

/// Runs the program on the Cornell box, 24 x 16.
void program(const std::string& arguments) {
    const std::string command = std::string(DIPTYCH_PROGRAM) + " render " + source_dir +
                                "/scenes/cornell.gltf --backend cpu --size 24x16 --max-depth 3 " + arguments +
                                " >/dev/null 2>&1";
    REQUIRE(std::system(command.c_str()) == 0);
}

}  // namespace

TEST_CASE("A film that is saved with its sums comes back to the bit") {
    const Folder folder;
    dp::Settings settings = small_settings(dp::Integrator::ris);
    settings.seed = 7;
    settings.mis = dp::MisHeuristic::balance;
    settings.resampling.near_share = 0.3F;
    settings.resampling.neighbors = 3;
    const dp::Film film = part_of(small_scene(), 0, 5, settings);
    film.save(folder.file("film.exr"), {.sums = true});
    const dp::Film again = dp::Film::load(folder.file("film.exr"));
    CHECK(again.has_sums());
    CHECK(same_bits(again, film));
    CHECK(again.info().file == folder.file("film.exr"));
    CHECK(again.info().settings == film.info().settings);
    CHECK(again.info().spp == 5);
    CHECK(again.info().samples == film.info().samples);
    CHECK(again.info().rays == film.info().rays);
    CHECK(again.info().seconds == film.info().seconds);
    CHECK(again.info().device == film.info().device);
    CHECK(again.relmse_estimate() == film.relmse_estimate());
    again.save(folder.file("again.exr"), {.sums = true});
    const auto bytes = [&](const char* name) {
        std::ifstream file(folder.file(name), std::ios::binary);
        return std::string(std::istreambuf_iterator<char>(file), {});
    };
    CHECK(bytes("again.exr") == bytes("film.exr"));
}

TEST_CASE("A film's file asks for no more memory than it may") {
    const Folder folder;
    const std::string path = folder.file("film.exr");
    part_of(small_scene(), 0, 2).save(path, {.sums = true});
    const std::uint64_t bytes = 24 * 16 * 236;  // sums, moments and first hits
    CHECK(dp::Film::load(path, bytes).has_sums());
    CHECK(message_of([&] { dp::Film::load(path, bytes - 1); }) ==
          path + ": cannot read its film: asks for 88.5 KB, and a file may ask for 88.5 KB (`memory_limit`)");
}

TEST_CASE("Films from files merge with films of this process and with one another, to the bits of one render") {
    const Folder folder;
    const dp::Scene scene = small_scene();
    const dp::Film whole = part_of(scene, 0, 12);
    std::vector<dp::Film> parts;
    for (const std::uint32_t first : {0U, 4U, 8U}) {
        const std::string name = folder.file("part" + std::to_string(first) + ".exr");
        part_of(scene, first, 4).save(name, {.sums = true});
        parts.push_back(dp::Film::load(name));
    }
    CHECK(same_bits(dp::merge({parts[2], parts[0], parts[1]}), whole));
    dp::Film grown = part_of(scene, 0, 4);
    grown.merge(parts[2]);
    grown.merge(parts[1]);
    CHECK(same_bits(grown, whole));
    grown.save(folder.file("grown.exr"), {.sums = true});
    const dp::Film again = dp::Film::load(folder.file("grown.exr"));
    CHECK(again.info().spp == 12);
    CHECK(same_bits(again, whole));
    CHECK_THROWS_WITH(grown.merge(again), Catch::Contains("has samples 0:4 in common with"));
}

TEST_CASE("Parts that overlap, are missing or of another picture are refused by name, and nothing changes") {
    const Folder folder;
    const dp::Scene scene = small_scene();
    const auto saved = [&](const char* name, const dp::Film& film) {
        film.save(folder.file(name), {.sums = true});
        return dp::Film::load(folder.file(name));
    };
    dp::Film film = saved("a.exr", part_of(scene, 0, 4));
    const dp::Film before = film;
    const std::string a = folder.file("a.exr"), b = folder.file("b.exr");
    const auto refusal = [&](const dp::Film& other) {
        const std::string message = message_of([&] { film.merge(other); });
        CHECK(same_bits(film, before));
        return message;
    };
    CHECK(refusal(saved("b.exr", part_of(scene, 2, 4))) == b + ": has samples 2:4 in common with " + a);
    dp::Settings settings = small_settings();
    settings.max_depth = 2;
    CHECK(refusal(saved("b.exr", part_of(scene, 4, 4, settings))) ==
          b + ": is no part of the same picture as " + a + ": max_depth is 3 and 2");
    dp::Scene redder = small_scene();
    redder.material("red").base_color = {0.9F, 0.1F, 0.1F, 1};
    const std::string foreign = ": is no part of the same picture as " + a +
                                ": the scene's content, its camera or its sky differs";
    CHECK(refusal(saved("b.exr", part_of(redder, 4, 4))) == b + foreign);
    CHECK(refusal(part_of(redder, 4, 4)) == "film" + foreign);
    CHECK(message_of([&] { dp::merge({film, saved("b.exr", part_of(scene, 6, 2))}); }) ==
          "merge: no film has samples 4:6 of seed 0; `partial` merges what is there");
    CHECK(dp::merge({film, dp::Film::load(b)}, {.partial = true}).info().spp == 6);
    CHECK_THROWS_WITH(dp::merge({}), Catch::Contains("there are no films"));
}

TEST_CASE("Films of several seeds add up, and their sums stay out of files") {
    const Folder folder;
    dp::Settings settings = small_settings();
    const dp::Film first = part_of(small_scene(), 0, 4, settings);
    settings.seed = 1;
    part_of(small_scene(), 0, 4, settings).save(folder.file("b.exr"), {.sums = true});
    dp::Film film = first;
    film.merge(dp::Film::load(folder.file("b.exr")));
    CHECK(film.info().spp == 8);
    CHECK_THROWS_WITH(film.save(folder.file("c.exr"), {.sums = true}), Catch::Contains("samples of seeds 0 and 1"));
    film.save(folder.file("c.exr"));
    CHECK(dp::Film::load(folder.file("c.exr")).info().spp == 8);
}

TEST_CASE("Films of restir in files add up where their seeds differ, and are refused where they do not") {
    const Folder folder;
    dp::Settings settings = small_settings(dp::Integrator::restir);
    const dp::Film film = part_of(small_scene(), 0, 3, settings);
    film.save(folder.file("a.exr"), {.sums = true});
    dp::Film again = dp::Film::load(folder.file("a.exr"));
    CHECK(same_bits(again, film));
    CHECK(message_of([&] { again.merge(film); }) == "film: its samples go on from one another, and " +
                                                        folder.file("a.exr") + " has some of the same seed 0");
    settings.seed = 1;
    again.merge(part_of(small_scene(), 0, 3, settings));
    CHECK(again.info().spp == 6);
}

TEST_CASE("A picture without sums is its layers, and says that it cannot merge") {
    const Folder folder;
    const dp::Film film = part_of(small_scene(), 0, 4);
    film.save(folder.file("a.exr"));
    film.save(folder.file("a.png"));
    dp::Film exr = dp::Film::load(folder.file("a.exr"));
    CHECK_FALSE(exr.has_sums());
    const auto equal = [](std::span<const float> x, std::span<const float> y) {
        return !x.empty() && std::equal(x.begin(), x.end(), y.begin(), y.end());
    };
    for (const char* layer : {"radiance", "standard_error", "albedo", "normal", "depth"}) {
        CHECK(equal(exr.layer(layer), film.layer(layer)));
    }
    CHECK(exr.info().settings == film.info().settings);
    CHECK(exr.info().spp == 4);
    CHECK(std::isnan(exr.relmse_estimate()));
    const std::string name = folder.file("a.exr") + ": is a picture without the sums of its samples";
    CHECK(message_of([&] { exr.merge(film); }) == name + ", and cannot be merged or gone on from");
    CHECK(message_of([&] { dp::Film(film).merge(exr); }) == name + ", and cannot be merged or gone on from");
    CHECK(message_of([&] { exr.sums(); }) == name);
    CHECK_THROWS_WITH(exr.save(folder.file("b.exr"), {.sums = true}), Catch::Contains("has no sums to save"));
    exr.save(folder.file("b.exr"));
    CHECK(dp::compare(folder.file("b.exr"), folder.file("a.exr")).mse == 0);

    const dp::Film png = dp::Film::load(folder.file("a.png"));
    CHECK(png.radiance().size() == film.radiance().size());
    CHECK(png.standard_error().empty());
    CHECK(png.layer("depth").empty());
    CHECK(dp::compare(png, png).mse == 0);
    CHECK_THROWS_WITH(dp::Film::load(folder.file("none.exr")), Catch::Contains("none.exr"));
    CHECK_THROWS_WITH(film.save(folder.file("a.png"), {.sums = true}), Catch::Contains("only .exr can"));
}

TEST_CASE("A session goes on from a film in a file, to the bits of one that took all samples") {
    const Folder folder;
    const dp::Scene scene = small_scene();
    for (const dp::Backend backend : panels()) {
        INFO(dp::name_of(backend));
        dp::BackendChoice choice;
        choice.backend = backend;
        dp::Session session(scene, choice, small_settings());
        session.render(5);
        session.film().save(folder.file("film.exr"), {.sums = true});
        session.restart();
        session.render(9);
        const dp::Film whole = session.film();
        session.restart();
        session.resume(dp::Film::load(folder.file("film.exr")));
        CHECK(session.film().info().spp == 5);
        CHECK(session.render(4).spp == 4);
        CHECK(same_bits(session.film(), whole));
        CHECK(session.film().info().rays == whole.info().rays);
        CHECK_THROWS_WITH(session.resume(whole), Catch::Contains("has samples already"));
        session.restart();  // and the film is gone
        session.render(9);
        CHECK(same_bits(session.film(), whole));
    }
    dp::Settings settings = small_settings();
    settings.seed = 3;
    dp::Session other(scene, {}, settings);
    CHECK_THROWS_WITH(other.resume(dp::Film::load(folder.file("film.exr"))), Catch::Contains("seed is 3 and 0"));
    dp::Session restir(scene, {}, small_settings(dp::Integrator::restir));
    CHECK_THROWS_AS(restir.resume(restir.film()), dp::SettingError);
}

TEST_CASE("Parts that the program renders and parts of the library are parts of one picture") {
    const Folder folder;
    program("--samples 0:4 -o " + folder.file("program.exr"));
    program("--spp 8 --sums -o " + folder.file("whole.exr"));
    const dp::Scene scene = dp::load(source_dir + "/scenes/cornell.gltf");
    const dp::Film rest = part_of(scene, 4, 4);
    rest.save(folder.file("library.exr"), {.sums = true});
    const dp::Film whole = dp::Film::load(folder.file("whole.exr"));
    dp::Film film = dp::Film::load(folder.file("program.exr"));
    film.merge(rest);
    CHECK(same_bits(film, whole));
    CHECK(film.info().settings.size == std::array{24, 16});

    const std::string parts = folder.file("program.exr") + " " + folder.file("library.exr");
    const std::string merge =
        DIPTYCH_PROGRAM " merge " + parts + " --sums -o " + folder.file("merged.exr") + " >/dev/null 2>&1";
    REQUIRE(std::system(merge.c_str()) == 0);
    CHECK(same_bits(dp::Film::load(folder.file("merged.exr")), whole));

    dp::Session session(scene, {}, small_settings());
    session.resume(dp::Film::load(folder.file("program.exr")));
    session.render(4);
    CHECK(same_bits(session.film(), whole));
}
