import numpy as np
import pytest

import diptych as dp


@pytest.fixture(scope="module")
def curve():
    from conftest import lit_floor
    scene = lit_floor()
    scene.environment.scale = (1, 1, 1)
    steps = []
    curve = dp.converge(scene, ["cpu:path:independent", "cpu:brdf"], runs=8, spp_max=16, size=(24, 16), max_depth=2,
                        progress=lambda step, done, steps_: steps.append((step, done, steps_)))
    assert len(steps) > 16 and steps[3][1] == 3 and all(step[1] < step[2] for step in steps)
    return curve


def test_a_curve_has_columns_and_intervals(curve):
    table = curve.table()
    assert list(table["method"]) == ["cpu:path:independent"] * 5 + ["cpu:brdf"] * 5
    assert all(column.shape == (10,) for column in table.values()) and table["relmse"].dtype == np.float64
    assert (table["relmse_low"] <= table["relmse"]).all() and (table["relmse"] <= table["relmse_high"]).all()
    path = curve.table("cpu:path:independent")
    assert path["spp"].tolist() == [1, 2, 4, 8, 16] and (np.diff(path["device_seconds"]) > 0).all()
    slope = np.polyfit(np.log(path["spp"]), np.log(path["mse_net"]), 1)[0]
    assert slope == pytest.approx(curve.methods[0].slope_mse.value, abs=0.1) == pytest.approx(-1, abs=0.3)
    table["relmse"][:] = 0  # a copy
    assert curve.table()["relmse"].all()
    with pytest.raises(KeyError, match="cpu:ris"):
        curve.table("cpu:ris")


def test_a_curve_says_what_it_found(curve):
    path = curve.methods[0]
    assert (path.method, path.runs, curve.size) == ("cpu:path:independent", 8, (24, 16))
    assert curve.reference_spp == 256 and curve.reference_relmse > 0
    assert not path.bias_significant and path.target in ("reached", "earlier", "later", "unknown")
    assert "none seen" in path.bias_text
    assert "cpu:brdf" in str(curve) and "<" not in repr(curve)


def test_a_curve_is_a_page(curve, tmp_path):
    curve.page(tmp_path / "out.html")
    text = (tmp_path / "out.html").read_text()
    assert text.startswith("<!DOCTYPE html>") and "data:image/png;base64," in text and "cpu:brdf" in text
    assert [path.name for path in tmp_path.iterdir()] == ["out.html"]
    with pytest.raises(dp.Error, match="nowhere"):
        curve.page(tmp_path / "nowhere" / "out.html")


def test_references_are_films_files_or_methods(floor, tmp_path):
    floor.environment.scale = (1, 1, 1)
    film = dp.render(floor, spp=256, size=(8, 6))
    film.save(tmp_path / "film.exr")
    arguments = {"methods": ["cpu:path"], "runs": 4, "spp_max": 2, "size": (8, 6)}
    for reference, name in [(film, "film"), (tmp_path / "film.exr", str(tmp_path / "film.exr")),
                            ("cpu:direct", "cpu:direct")]:
        curve = dp.converge(floor, reference=reference, **arguments)
        assert curve.reference == name and not curve.methods[0].bias_significant
    floor.environment.scale = (1.2, 1.2, 1.2)
    brighter = dp.converge(floor, reference=film, **arguments).methods[0]
    assert brighter.bias_significant and brighter.bias_p < 0.01 and "% of a pixel" in brighter.bias_text
    with pytest.raises(dp.Error, match="8x6 pixels, but 6x8"):
        dp.converge(floor, reference=film, **{**arguments, "size": (6, 8)})


@pytest.mark.parametrize("call, arguments, error, says", [
    (dp.converge, {"methods": ["gpu:path"]}, ValueError, "gpu:path"),
    (dp.converge, {"methods": ["cpu:path"], "runs": 1}, ValueError, "runs is 1"),
    (dp.converge, {"integrator": "path"}, TypeError, "integrator"),
    (dp.bench, {"integrators": ["photon"]}, ValueError, "photon"),
    (dp.bench, {"frames": 4}, ValueError, "frames 4"),
    (dp.bench, {"backend": "oracle"}, ValueError, "oracle"),
    (dp.bench, {"integrator": "path"}, TypeError, "integrator"),
])
def test_what_cannot_be_measured_is_refused(floor, call, arguments, error, says):
    with pytest.raises(error, match=says):
        call(floor, **{"size": (8, 6), **arguments})


@pytest.mark.parametrize("call", [dp.converge, dp.bench])
def test_an_exception_of_the_callback_ends_the_measurement(floor, call):
    def stop(step, done, steps):
        raise LookupError("enough")

    with pytest.raises(LookupError, match="enough"):
        call(floor, size=(8, 6), progress=stop)


def test_bench_gives_rates(cornell):
    speed = dp.bench(cornell, integrators=["brdf", "restir"], frames=5, size=(16, 16), max_depth=2)
    assert (speed.backend, speed.frames) == ("cpu", 5) and [rate.integrator for rate in speed.integrators] == [
        "brdf", "restir"]
    brdf, restir = speed.integrators
    assert brdf.samples_per_second == pytest.approx(1000 * 16 * 16 / brdf.milliseconds)
    assert brdf.cost_relative_to_brdf == 1 and brdf.share_of_bare > 0 and restir.bare_rays_per_second is None
    assert speed["restir"] is restir and str(speed).startswith("cpu at 16x16")
    with pytest.raises(KeyError, match="path"):
        speed["path"]
