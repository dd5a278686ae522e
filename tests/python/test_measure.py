import numpy as np
import pytest

import diptych as dp


def test_one_image_passes(floor):
    seen = []
    verdict = dp.verify(floor, "cpu:path", "cpu:direct", runs=8, spp=16, size=(32, 24), max_depth=1, max_half_width=1,
                        max_tile_half_width=10, progress=lambda run, runs: seen.append((run, runs)))
    assert verdict.verdict == "PASS", verdict
    assert abs(verdict.bias_percent) <= 3 * verdict.ci95 and verdict.p > 1e-3
    assert verdict.p_values.shape == (2, 2) and str(verdict).startswith("PASS")
    assert len(seen) >= 8 and seen[-1][1] >= 8


def test_a_biased_setting_fails(cornell):
    verdict = dp.verify(cornell, "cpu:restir", "cpu:path", runs=16, spp=16, size=(48, 48),
                        reuse_visibility="biased-initial", reuse_mis="biased-1-over-m", reuse_radius=30, neighbors=8)
    assert verdict.verdict == "FAIL" and verdict.p <= 1e-3 and verdict.p_values.shape == (3, 3)
    assert abs(verdict.bias_percent) > verdict.ci95 or np.nanmin(verdict.p_values) <= 1e-3


def test_the_device_passes_against_the_oracle(floor, vulkan):
    verdict = dp.verify(floor, "vulkan:path", "oracle", runs=8, spp=16, size=(32, 24), max_half_width=1,
                        max_tile_half_width=10)
    assert verdict.verdict == "PASS", verdict


@pytest.mark.parametrize("arguments, error, says", [
    ({"a": "gpu:path"}, ValueError, "gpu"), ({"a": "cpu:photon"}, ValueError, "photon"),
    ({"runs": 2}, dp.Error, "runs"),
    ({"integrator": "path"}, TypeError, "integrator"),
])
def test_what_cannot_be_verified_is_refused(floor, arguments, error, says):
    with pytest.raises(error, match=says):
        dp.verify(floor, **{"a": "cpu:path", "b": "cpu:path", "size": (8, 6), "spp": 1, **arguments})


def test_an_exception_of_the_callback_ends_verify(floor):
    def stop(run, runs):
        raise LookupError("enough")

    with pytest.raises(LookupError, match="enough"):
        dp.verify(floor, "cpu:path", "cpu:path", runs=8, spp=1, size=(8, 6), progress=stop)


def test_compare_measures_what_numpy_does(floor):
    a, b = (dp.render(floor, spp=4, size=(16, 12), seed=seed, sampler="independent") for seed in (1, 2))
    floor.environment.scale = (1, 0.5, 0.25)
    bright = dp.render(floor, spp=4, size=(16, 12), seed=3)
    for first, second in [(a, b), (bright, a)]:
        result = dp.compare(first, second)
        x, y = first.radiance.astype(float), second.radiance.astype(float)
        assert result.mse == pytest.approx(np.mean((x - y) ** 2), rel=1e-4)
        assert result.relmse == pytest.approx(np.mean((x - y) ** 2 / (y**2 + 0.01)), rel=1e-4)
        assert result.mean_ratio == pytest.approx(x.mean((0, 1)) / y.mean((0, 1)), rel=1e-4)
    assert result.nonfinite == 0 and result.fraction_equal < 1


def test_pictures_of_two_sizes_are_refused(floor):
    a, b = (dp.render(floor, spp=1, size=size) for size in ((8, 6), (6, 8)))
    with pytest.raises(dp.Error):
        dp.compare(a, b)
    with pytest.raises(TypeError, match="two films or two files"):
        dp.compare(a, "b.exr")


def test_replay_shows_the_path_of_the_film(floor):
    """A film of one sample is the radiance of its paths."""
    with dp.Session(floor, size=(16, 12)) as a, dp.Session(floor, size=(16, 12)) as b:
        a.render(1)
        film = a.film()
        same = dp.replay(a, b, pixel=(8, 10))
        assert np.array_equal(a.film().sums, film.sums)
        assert same.parts_at is None and same.radiance[0] == same.radiance[1]
        np.testing.assert_allclose(same.radiance[0], film.radiance[10, 8], rtol=1e-5)
        assert same.vertices[0][0].position[1] == pytest.approx(0, abs=1e-5) and same.text
        with pytest.raises(dp.Error):
            dp.replay(a, b, pixel=(16, 0))


def test_replay_finds_where_paths_part(floor):
    other = floor.copy()
    other.lights[0].intensity = (40, 20, 20)
    with dp.Session(floor, size=(16, 12)) as a, dp.Session(other, size=(16, 12)) as b:
        assert dp.replay(a, b, pixel=(8, 10)).parts_at is not None


def test_replay_of_what_keeps_no_paths_is_refused(floor):
    with dp.Session(floor, size=(8, 6)) as a, dp.Session(floor, size=(8, 6), backend="oracle") as b:
        with pytest.raises(dp.Error):
            dp.replay(a, b, pixel=(0, 0))
