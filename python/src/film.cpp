// Films: their arrays are views of the film's own memory.
#include <cmath>
#include <cstdio>

#include "dlpack.h"

namespace diptych::python {

namespace {

constexpr const char* load_doc =
    "A film from a file. One that was saved with sums=True, or by the program with its sums, comes back to the bit:\n"
    "it merges, and a session goes on from it. Any other picture (.exr, .hdr, .png and more) is its radiance, with\n"
    "the standard error and the layers that an .exr has. memory_limit: bytes that the file may ask for; 0 is a\n"
    "quarter of the memory.\n\n"
    ">>> import diptych as dp, tempfile\n"
    ">>> scene = dp.Scene()\n"
    ">>> scene.environment.scale = (0.5, 0.5, 0.5)\n"
    ">>> film = dp.render(scene, spp=4, size=(3, 2))\n"
    ">>> with tempfile.TemporaryDirectory() as folder:\n"
    "...     film.save(folder + \"/film.exr\", sums=True)\n"
    "...     again = dp.Film.load(folder + \"/film.exr\")\n"
    ">>> again.spp, bool((again.sums == film.sums).all())\n"
    "(4, True)\n";

constexpr const char* film_doc = "What a session has rendered: a value. Arrays have row 0 on top.\n\n"
                                 ">>> import diptych as dp\n"
                                 ">>> scene = dp.Scene()\n"
                                 ">>> scene.environment.scale = (0.5, 0.5, 0.5)\n"
                                 ">>> film = dp.render(scene, spp=4, size=(3, 2))\n"
                                 ">>> film.radiance.shape, film.radiance.dtype, float(film.radiance[0, 0, 0])\n"
                                 "((2, 3, 3), dtype('float32'), 0.5)\n";

constexpr const char* dlpack_doc =
    "A DLPack capsule of a layer, float32 (h, w, 3) or (h, w), for libraries that take one, such as\n"
    "torch.from_dlpack(film.to_dlpack(\"albedo\")). Libraries that take an object, such as numpy.from_dlpack, get the\n"
    "radiance of the film itself.\n\n"
    "The capsule has the film's own memory, without a copy, and keeps it alive. Arrays of a film are not to be\n"
    "written: with max_version=(1, 0) or later the capsule says so by its read-only flag. The older capsule, which\n"
    "consumers of DLPack before 1.0 ask for, has no such flag; its consumer has to heed this page. copy=True gives\n"
    "memory of its own, which may be written. The memory is the processor's for films of Vulkan devices too, since\n"
    "the sums of a film become radiance there. A stream or another device raises BufferError.\n\n"
    ">>> import diptych as dp, numpy as np\n"
    ">>> scene = dp.Scene()\n"
    ">>> scene.environment.scale = (0.5, 0.5, 0.5)\n"
    ">>> film = dp.render(scene, spp=4, size=(3, 2))\n"
    ">>> np.from_dlpack(film).shape, film.__dlpack_device__()\n"
    "((2, 3, 3), (1, 0))\n";

/// Throws Error where the film has no such layer.
std::span<const float> values_of(const Film& film, const std::string& name) {
    const std::span<const float> values = film.layer(name);
    if (values.empty() && !film.has_sums()) {
        throw Error("the film has no layer " + name + ": " + film.info().file + " holds none");
    }
    if (values.empty()) {
        const char* setting = name == "standard_error" ? "standard_error" : "first_hit";
        throw Error("the film has no layer " + name + ": it was rendered with " + setting + "=False");
    }
    return values;
}

template <typename Integer>
std::vector<Integer> shape_of(const Film& film, std::size_t values) {
    std::vector<Integer> shape{film.height(), film.width()};
    if (values != static_cast<std::size_t>(film.height()) * static_cast<std::size_t>(film.width())) {
        shape.push_back(3);
    }
    return shape;
}

/// A copy of the film, which shares its memory, lives on in the array.
py::array layer(const Film& film, const std::string& name) {
    auto* owned = new Film(film);
    const py::capsule owner(owned, [](void* memory) { delete static_cast<Film*>(memory); });
    const std::span<const float> values = values_of(*owned, name);
    return view_of(values.data(), shape_of<py::ssize_t>(film, values.size()), owner);
}

void require_known(const Film& film, const std::string& name) {
    try {
        film.layer(name);
    } catch (const Error& error) {
        throw UnknownName(error.what());
    }
}

py::array named_layer(const Film& film, const std::string& name) {
    require_known(film, name);
    return layer(film, name);
}

py::capsule shared_layer(const Film& film, const std::string& name, const py::object& stream,
                         const DlpackVersion& max_version, const py::object& device, std::optional<bool> copy) {
    require_dlpack_device(stream, device);
    require_known(film, name);
    const auto owner = std::make_shared<const Film>(film);
    const std::span<const float> values = values_of(*owner, name);
    SharedArray array{values.data(), shape_of<std::int64_t>(film, values.size()), owner, false};
    if (copy.value_or(false)) {
        const auto own = std::make_shared<std::vector<float>>(values.begin(), values.end());
        array = {own->data(), std::move(array.shape), own, true};
    }
    return dlpack_capsule(std::move(array), max_version);
}

std::vector<std::string> layers(const Film& film) {
    std::vector<std::string> names;
    for (const char* name : {"radiance", "standard_error", "albedo", "normal", "depth"}) {
        if (!film.layer(name).empty()) {
            names.emplace_back(name);
        }
    }
    return names;
}

/// "2.1e-3"
std::string short_number(double value) {
    char text[32];
    std::snprintf(text, sizeof text, "%.1e", value);
    std::string result = text;
    const std::size_t exponent = result.find('e') + 2;
    while (result.size() > exponent + 1 && result[exponent] == '0') {
        result.erase(exponent, 1);
    }
    return result;
}

std::string shown(const Film& film) {
    const FilmInfo& info = film.info();
    std::string text = "<Film " + std::to_string(film.width()) + "x" + std::to_string(film.height()) + ", ";
    if (info.spp == 0 && !info.file.empty()) {  // a picture that does not say how it was made
        return text + info.file + ">";
    }
    text += std::to_string(info.spp) + " spp, " + name_of(info.backend);
    if (info.backend != Backend::oracle) {
        text += ":" + name_of(info.settings.integrator);
    }
    const double relmse = film.relmse_estimate();
    return text + (std::isnan(relmse) ? "" : ", relMSE " + short_number(relmse)) + ">";
}

py::bytes png(const Film& film) {
    const py::object folder = py::module_::import("tempfile").attr("TemporaryDirectory")();
    const py::object path = py::module_::import("pathlib").attr("Path")(folder.attr("name")) / py::str("film.png");
    film.save(py::str(path));
    return path.attr("read_bytes")();  // the folder is removed with its object
}

}  // namespace

void bind_film(py::module_& module) {
    const auto info = [](auto member) { return [member](const Film& film) { return film.info().*member; }; };
    py::class_<Film>(module, "Film", film_doc)
        .def_static(
            "load",
            [](const py::object& path, std::uint64_t memory_limit) {
                const std::string name = path_of(path);
                const py::gil_scoped_release others_run;
                return Film::load(name, memory_limit);
            },
            py::arg("path"), py::arg("memory_limit") = 0, load_doc)
        .def_property_readonly("file", info(&FilmInfo::file),
                               "That it was loaded from; empty for one that was rendered.")
        .def_property_readonly("width", &Film::width, "Pixels.")
        .def_property_readonly("height", &Film::height, "Pixels.")
        .def_property_readonly("scene", info(&FilmInfo::scene), "The scene's name.")
        .def_property_readonly("backend", [](const Film& film) { return name_of(film.info().backend); })
        .def_property_readonly("device", info(&FilmInfo::device), "The device's own name.")
        .def_property_readonly("settings", info(&FilmInfo::settings))
        .def_property_readonly("spp", info(&FilmInfo::spp), "Samples that every pixel has.")
        .def_property_readonly("samples", info(&FilmInfo::samples), "Samples averaged, over all pixels.")
        .def_property_readonly("nonfinite", info(&FilmInfo::nonfinite), "Samples dropped as not finite or negative.")
        .def_property_readonly("rays", info(&FilmInfo::rays))
        .def_property_readonly("seconds", info(&FilmInfo::seconds), "Of rendering.")
        .def_property_readonly(
            "radiance", [](const Film& film) { return layer(film, "radiance"); },
            "Float32 (h, w, 3), W/(sr m²), linear Rec.709: a read-only view without a copy.")
        .def_property_readonly(
            "standard_error", [](const Film& film) { return layer(film, "standard_error"); },
            "Float32 (h, w, 3): the standard error of radiance, a read-only view. NaN where a pixel has\n"
            "fewer than two samples. restir's samples depend on one another, so for restir this is no\n"
            "measure of the error.")
        .def("__getitem__", &named_layer, py::arg("layer"),
             "\"albedo\" or \"normal\", float32 (h, w, 3), or \"depth\", float32 (h, w), metres: means of the first "
             "hit.\n"
             "Also \"radiance\" and \"standard_error\". Read-only views.")
        .def("to_dlpack", &shared_layer, py::arg("layer") = "radiance", py::kw_only(), py::arg("stream") = py::none(),
             py::arg("max_version") = py::none(), py::arg("dl_device") = py::none(), py::arg("copy") = py::none(),
             dlpack_doc)
        .def(
            "__dlpack__",
            [](const Film& film, const py::object& stream, const DlpackVersion& max_version, const py::object& device,
               std::optional<bool> copy) {
                return shared_layer(film, "radiance", stream, max_version, device, copy);
            },
            py::kw_only(), py::arg("stream") = py::none(), py::arg("max_version") = py::none(),
            py::arg("dl_device") = py::none(), py::arg("copy") = py::none(), "to_dlpack(\"radiance\").")
        .def(
            "__dlpack_device__", [](const Film&) { return dlpack_device(); }, "(1, 0): the processor's memory.")
        .def_property_readonly("layers", &layers, "The names of the layers that the film has.")
        .def_property_readonly("has_sums", &Film::has_sums,
                               "Whether the film has the sums of its samples, by which films merge.")
        .def_property_readonly(
            "sums",
            [](const Film& film) {
                return array_of(film.sums(), {film.height(), film.width(), 3});
            },
            "Float64 (h, w, 3): the sums that radiance is the mean of. A copy. Raises Error where there are none.")
        .def_property_readonly(
            "sample_counts",
            [](const Film& film) {
                return array_of(film.sample_counts(), {film.height(), film.width()});
            },
            "Uint32 (h, w): the samples in each sum. A copy.")
        .def_property_readonly("relmse_estimate", &Film::relmse_estimate,
                               "Mean of variance / (radiance² + 0.01), by the standard errors; NaN without them.")
        .def(
            "merge", &Film::merge, py::arg("other"),
            "Adds the other film's samples, exactly, as if this film had taken them too. Raises Error, and changes "
            "nothing,\n"
            "where the films differ in scene, size or settings other than the seed, have samples in common or have no\n"
            "sums. Arrays taken before keep their values. diptych.merge also looks for samples that are missing.")
        .def(
            "copy", [](const Film& film) { return Film(film); },
            "A film that merges on its own; memory is shared till then.")
        .def("__copy__", [](const Film& film) { return Film(film); })
        .def(
            "save",
            [](const Film& film, const py::object& path, bool sums) {
                const std::string name = path_of(path);
                const py::gil_scoped_release others_run;
                film.save(name, {sums});
            },
            py::arg("path"), py::kw_only(), py::arg("sums") = false,
            "Writes .exr (all layers, float32), .hdr or .png (tone-mapped). The file appears whole or not at all.\n"
            "sums: keep the exact sums in the .exr, by which Film.load gets the film back to the bit.")
        .def(
            "tone_mapped",
            [](const Film& film, double exposure) {
                return array_of(tone_mapped(film, exposure), {film.height(), film.width(), 3});
            },
            py::arg("exposure") = 0.0, "Float32 (h, w, 3), display values from 0 to 1; exposure in EV, powers of two.")
        .def("__repr__", &shown)
        .def("_repr_png_", &png);
    module.def("merge", [](const std::vector<Film>& films, bool partial) {
        const py::gil_scoped_release others_run;
        return merge(films, {partial});
    });
}

}  // namespace diptych::python
