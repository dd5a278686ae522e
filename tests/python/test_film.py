import copy
import ctypes
import gc

import numpy as np
import pytest

import diptych as dp


@pytest.fixture
def film(floor):
    return dp.render(floor, spp=8, size=(16, 12), seed=1)


def test_arrays_are_read_only_views_of_the_films_memory(film):
    shapes = {"radiance": (3,), "standard_error": (3,), "albedo": (3,), "normal": (3,), "depth": ()}
    assert film.layers == list(shapes)
    for name, channels in shapes.items():
        array = film[name]
        assert array.shape == (12, 16, *channels) and array.dtype == np.float32
        assert not array.flags.writeable and not array.flags.owndata
        with pytest.raises(ValueError):
            array.setflags(write=True)
        # Two views start at one address: neither is a copy.
        assert array.__array_interface__["data"][0] == film[name].__array_interface__["data"][0]
    assert np.shares_memory(film.radiance, film["radiance"])
    assert np.shares_memory(film.radiance, film.copy().radiance)


def test_an_array_outlives_its_film_and_session(floor):
    with dp.Session(floor, size=(64, 48)) as session:
        session.render(4)
        array = session.film().radiance
        expected = array.copy()
    del session
    gc.collect()
    others = [np.full((48, 64, 3), i, np.float32) for i in range(50)]  # would take the place of freed memory
    assert np.array_equal(array, expected) and len(others) == 50


def test_numpy_takes_a_film_without_a_copy(film):
    assert film.__dlpack_device__() == (1, 0)
    array = np.from_dlpack(film)
    assert array.dtype == np.float32 and np.array_equal(array, film.radiance)
    assert np.shares_memory(array, film.radiance)


class Tensor(ctypes.Structure):
    """DLTensor of DLPack 1.0."""
    _fields_ = [("data", ctypes.c_void_p), ("device_type", ctypes.c_int32), ("device_id", ctypes.c_int32),
                ("ndim", ctypes.c_int32), ("code", ctypes.c_uint8), ("bits", ctypes.c_uint8),
                ("lanes", ctypes.c_uint16), ("shape", ctypes.POINTER(ctypes.c_int64)),
                ("strides", ctypes.POINTER(ctypes.c_int64)), ("byte_offset", ctypes.c_uint64)]

    def array(self):
        size = np.prod(self.shape[:self.ndim])
        floats = ctypes.cast(self.data + self.byte_offset, ctypes.POINTER(ctypes.c_float))
        return np.ctypeslib.as_array(floats, (size,)).reshape(self.shape[:self.ndim])


class Managed(ctypes.Structure):
    """DLManagedTensor."""


Managed._fields_ = [("tensor", Tensor), ("context", ctypes.c_void_p),
                    ("deleter", ctypes.CFUNCTYPE(None, ctypes.POINTER(Managed)))]


class Versioned(ctypes.Structure):
    """DLManagedTensorVersioned."""


Versioned._fields_ = [("major", ctypes.c_uint32), ("minor", ctypes.c_uint32), ("context", ctypes.c_void_p),
                      ("deleter", ctypes.CFUNCTYPE(None, ctypes.POINTER(Versioned))), ("flags", ctypes.c_uint64),
                      ("tensor", Tensor)]


def opened(capsule, kind=Managed):
    """What a consumer reads."""
    name = b"dltensor" if kind is Managed else b"dltensor_versioned"
    pointer = ctypes.pythonapi.PyCapsule_GetPointer
    pointer.restype, pointer.argtypes = ctypes.c_void_p, [ctypes.py_object, ctypes.c_char_p]
    return kind.from_address(pointer(capsule, name))


def consumed(capsule, kind=Managed):
    """What a consumer owns: it renames the capsule, and calls the deleter in the end."""
    managed = opened(capsule, kind)
    rename = ctypes.pythonapi.PyCapsule_SetName
    rename.argtypes = [ctypes.py_object, ctypes.c_char_p]
    name = b"used_dltensor" if kind is Managed else b"used_dltensor_versioned"
    rename(capsule, name)
    managed.name_that_must_live = name
    return managed


@pytest.mark.parametrize("name, channels", [("radiance", (3,)), ("albedo", (3,)), ("depth", ())])
def test_layers_are_capsules(film, name, channels):
    shape, strides = [12, 16, *channels], [48, 3, 1] if channels else [16, 1]
    for version, kind in ((None, Managed), ((0, 8), Managed), ((1, 0), Versioned), ((1, 1), Versioned),
                          ((2, 0), Versioned)):
        capsule = film.to_dlpack(name, max_version=version)
        managed = opened(capsule, kind)
        tensor = managed.tensor
        assert (tensor.device_type, tensor.device_id, tensor.code, tensor.bits, tensor.lanes) == (1, 0, 2, 32, 1)
        assert tensor.shape[:tensor.ndim] == shape and tensor.strides[:tensor.ndim] == strides
        assert np.shares_memory(tensor.array(), film[name]) and np.array_equal(tensor.array(), film[name])
        if kind is Versioned:
            assert (managed.major, managed.minor, managed.flags) == (1, 0, 1)  # read-only


def test_a_copy_may_be_written(film):
    capsule = film.to_dlpack(max_version=(1, 0), copy=True)
    managed = opened(capsule, Versioned)
    before = film.radiance.copy()
    assert managed.flags == 2 and np.array_equal(managed.tensor.array(), before)  # copied
    managed.tensor.array()[:] = 0
    assert np.array_equal(film.radiance, before)


@pytest.mark.parametrize("version, kind", [(None, Managed), ((1, 0), Versioned)])
def test_a_capsule_keeps_the_film_alive_until_its_consumer_lets_go(floor, version, kind):
    def resident():
        with open("/proc/self/statm") as file:
            return int(file.read().split()[1]) * 4096

    size = (1024, 1024)  # some hundred bytes a pixel
    film = dp.render(floor, spp=1, size=size)
    capsule, expected = film.__dlpack__(max_version=version), film.radiance.copy()
    del film
    gc.collect()
    managed = consumed(capsule, kind)
    del capsule
    gc.collect()
    assert np.array_equal(managed.tensor.array(), expected)
    held = resident()
    managed.deleter(managed)
    assert held - resident() > 12 * size[0] * size[1]
    film = dp.render(floor, spp=1, size=size)  # a capsule that nobody takes frees it likewise
    capsule = film.__dlpack__(max_version=version)
    del film
    held = resident()
    del capsule
    assert held - resident() > 12 * size[0] * size[1]


@pytest.mark.parametrize("arguments", [{"stream": 1}, {"dl_device": (2, 0)}])
def test_what_dlpack_cannot_give_is_a_buffer_error(film, arguments):
    for export in (film.to_dlpack, film.__dlpack__):
        with pytest.raises(BufferError, match="processor's memory"):
            export(**arguments)
    assert film.__dlpack__(dl_device=(1, 0), copy=False) is not None
    with pytest.raises(KeyError, match="noise"):
        film.to_dlpack("noise")
    for version in ("1.0", (1,), 1):
        with pytest.raises(TypeError):
            film.to_dlpack(max_version=version)
    bare = dp.render(dp.Scene(), spp=1, size=(2, 2), first_hit=False)
    with pytest.raises(dp.Error, match="first_hit=False"):
        bare.to_dlpack("albedo")


def test_radiance_is_the_mean_of_the_sums(film):
    mean = film.sums / film.sample_counts[..., None]
    np.testing.assert_allclose(film.radiance, mean, rtol=1e-6)
    assert film.sums.dtype == np.float64 and film.sample_counts.dtype == np.uint32
    assert (film.sample_counts == 8).all() and film.samples == 8 * 16 * 12


def test_the_standard_error_is_that_of_many_runs(floor):
    floor.environment.scale = (1, 1, 1)
    floor.lights.clear()  # light from the sky alone is noisy
    runs = [dp.render(floor, spp=16, size=(16, 12), seed=seed, sampler="independent") for seed in range(40)]
    spread = np.std([run.radiance for run in runs], axis=0, ddof=1)
    stated = np.sqrt(np.mean([run.standard_error**2 for run in runs], axis=0))
    lit = spread > 0.02
    assert lit.sum() > 100
    assert np.median(stated[lit] / spread[lit]) == pytest.approx(1, rel=0.1)


def test_first_hits_are_the_floors(film):
    assert film["depth"][0, 0] == 0 and film["depth"][6, 8] == pytest.approx(4.3, abs=0.5)  # (0, 1.5, 4) to (0, 0, 0)
    assert film["normal"][6, 8] == pytest.approx((0, 1, 0), abs=1e-5)
    assert film["albedo"][6, 8] == pytest.approx((1, 1, 1), abs=1e-5)


def test_layers_that_were_not_kept_are_refused_by_name(floor):
    film = dp.render(floor, spp=2, size=(8, 6), standard_error=False, first_hit=False)
    assert film.layers == ["radiance"] and np.isnan(film.relmse_estimate)
    with pytest.raises(dp.Error, match="standard_error"):
        film.standard_error
    with pytest.raises(dp.Error, match="albedo"):
        film["albedo"]
    with pytest.raises(KeyError, match="shadow"):
        film["shadow"]


def test_merging_adds_samples_and_leaves_arrays_as_they_were(floor):
    first, second, both = (dp.render(floor, spp=8, size=(16, 12), seed=seed) for seed in (1, 2, 1))
    view = both.radiance
    both.merge(second)
    assert both.spp == 16 and np.array_equal(both.sums, first.sums + second.sums)
    assert np.array_equal(view, first.radiance) and not np.array_equal(both.radiance, view)


def test_films_that_do_not_belong_together_are_refused(film, floor):
    before = film.sums
    others = {"size": dp.render(floor, spp=2, size=(8, 6), seed=2), "integrator": dp.render(floor, spp=2, size=(16, 12),
              seed=2, integrator="direct"), "same samples": dp.render(floor, spp=2, size=(16, 12), seed=1)}
    for reason, other in others.items():
        with pytest.raises(dp.Error):
            film.merge(other)
        assert np.array_equal(film.sums, before), reason


def test_a_copy_merges_on_its_own(floor):
    film = dp.render(floor, spp=2, size=(8, 6), seed=1)
    other = copy.copy(film)
    other.merge(dp.render(floor, spp=2, size=(8, 6), seed=2))
    assert (film.spp, other.spp) == (2, 4)


def test_a_saved_film_is_the_film(film, tmp_path):
    film.save(tmp_path / "film.exr")
    film.save(str(tmp_path / "film.hdr"))
    dim = dp.compare(tmp_path / "film.exr", tmp_path / "film.exr")
    assert (dim.mse, dim.fraction_equal) == (0, 1)
    assert dp.compare(tmp_path / "film.hdr", tmp_path / "film.exr").relmse < 1e-4  # .hdr keeps 8 bits
    with pytest.raises(dp.Error, match="film.docx"):
        film.save(tmp_path / "film.docx")
    with pytest.raises(dp.Error, match="nowhere"):
        film.save(tmp_path / "nowhere" / "film.exr")
    assert sorted(path.name for path in tmp_path.iterdir()) == ["film.exr", "film.hdr"]


def test_a_film_shows_itself(film):
    assert repr(film).startswith("<Film 16x12, 8 spp, cpu:path, relMSE ")
    png = film._repr_png_()
    assert png[:8] == b"\x89PNG\r\n\x1a\n"
    assert (int.from_bytes(png[16:20], "big"), int.from_bytes(png[20:24], "big"), png[24]) == (16, 12, 8)
    shown = film.tone_mapped()
    assert shown.shape == (12, 16, 3) and 0 <= shown.min() and shown.max() <= 1
    assert film.tone_mapped(exposure=2).mean() > shown.mean()


def test_a_film_says_how_it_was_made(film):
    assert (film.width, film.height, film.spp, film.backend, film.nonfinite) == (16, 12, 8, "cpu", 0)
    assert film.settings == dp.Settings(size=(16, 12), seed=1, sample_count=8)
    assert film.rays > film.samples and film.seconds > 0


def test_a_film_comes_back_from_its_file(film, floor, tmp_path):
    film.save(tmp_path / "film.exr", sums=True)
    again = dp.Film.load(tmp_path / "film.exr")
    assert again.has_sums and np.array_equal(again.sums, film.sums) and again.settings == film.settings
    assert (again.file, film.file, again.spp) == (str(tmp_path / "film.exr"), "", 8)
    assert repr(again) == repr(film) and again._repr_png_() == film._repr_png_()
    with dp.Session(floor, size=(16, 12), seed=1) as session:
        session.resume(again)
        session.render(4)
        grown = session.film()
        session.restart()
        session.render(12)
        assert np.array_equal(grown.sums, session.film().sums) and grown.spp == 12
    with pytest.raises(dp.Error, match="another|common|part of the same|has samples"):
        grown.merge(again)


def test_parts_merge_and_gaps_are_named(floor, tmp_path):
    with dp.Session(floor, size=(16, 12)) as session:
        for part, (first, count) in enumerate([(0, 4), (4, 4), (8, 8)]):
            session.restart()
            session.render(count, first=first)
            session.film().save(tmp_path / f"{part}.exr", sums=True)
        session.restart()
        session.render(16)
        whole = session.film()
    paths = [tmp_path / f"{part}.exr" for part in (2, 0, 1)]
    assert np.array_equal(dp.merge(paths).sums, whole.sums)
    with pytest.raises(dp.Error, match="no film has samples 4:8 of seed 0"):
        dp.merge(paths[:2])
    assert dp.merge([dp.Film.load(path) for path in paths[:2]], partial=True).spp == 12


def test_a_picture_without_sums_is_its_layers(film, tmp_path):
    film.save(tmp_path / "film.exr")
    film.save(tmp_path / "film.png")
    exr, png = dp.Film.load(tmp_path / "film.exr"), dp.Film.load(tmp_path / "film.png")
    assert exr.layers == film.layers and np.array_equal(exr.radiance, film.radiance) and exr.spp == 8
    assert png.layers == ["radiance"] and repr(png) == f"<Film 16x12, {tmp_path / 'film.png'}>"
    for picture in (exr, png):
        with pytest.raises(dp.Error, match="without the sums"):
            picture.sums
        with pytest.raises(dp.Error, match="cannot be merged"):
            picture.merge(film)
    with pytest.raises(dp.Error, match="film.png holds none"):
        png["depth"]
