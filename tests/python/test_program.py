"""The package against the program: the same bits, and no time lost."""

import json
import statistics
import time

import numpy as np
import pytest

import diptych as dp
from conftest import SCENES


@pytest.mark.parametrize("scene, panel, integrator, options, settings", [
    ("cornell", "cpu", "path", ["--sampler", "hammersley", "--mis", "balance", "--light-sampler", "uniform", "--max-depth", 3],
     {"sampler": "hammersley", "mis": "balance", "light_sampler": "uniform", "max_depth": 3}),
    ("brdf-grid", "cpu", "path", [], {}),
    ("brdf-grid", "cpu", "restir", ["--spatial-passes", 2, "--reuse-mis", "balance"],
     {"spatial_passes": 2, "reuse_mis": "balance"}),
    ("brdf-grid", "vulkan", "path", [], {}),
    ("cornell", "vulkan", "restir", [], {}),
    ("cornell", "oracle", None, [], {}),
])
def test_a_film_has_the_bits_of_the_programs(program, tmp_path, request, scene, panel, integrator, options, settings):
    if panel == "vulkan":
        request.getfixturevalue("vulkan")
    if integrator:
        options, settings = ["--integrator", integrator, *options], {"integrator": integrator, **settings}
    path, file, own = SCENES / f"{scene}.gltf", tmp_path / "program.exr", tmp_path / "python.exr"
    program("render", path, "--backend", panel, "--spp", 4, "--seed", 7, "--size", "32x24", "-o", file, *options)
    dp.render(dp.load(path), backend=panel, spp=4, seed=7, size=(32, 24), **settings).save(own)
    same = dp.compare(own, file)
    assert (same.mse, same.fraction_equal, same.nonfinite) == (0, 1, 0)


@pytest.mark.nightly
def test_a_render_takes_the_programs_time(program, tmp_path):
    """A render of some 5 s, in turn with the program's by its own clock: the median of the ratios is 1.01 at most."""
    path, spp, settings = SCENES / "cornell.gltf", 64, {"size": (256, 256), "seed": 1}
    while dp.render(dp.load(path), spp=spp, **settings).seconds < 4:
        spp *= 2

    def of_program():
        text = program("render", path, "--spp", spp, "--size", "256x256", "--seed", 1, "-o", tmp_path / "film.exr",
                       "--json")
        return json.loads(text)["seconds"]

    def of_python():
        with dp.Session(dp.load(path), **settings) as session:
            began = time.monotonic()
            session.render(spp)
            return time.monotonic() - began

    ratios = [of_python() / of_program() for _ in range(7)]
    print("ratios:", np.round(ratios, 4))
    assert statistics.median(ratios) <= 1.01
