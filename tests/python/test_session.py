import signal
import subprocess
import sys
import threading
import time

import numpy as np
import pytest

import diptych as dp


@pytest.mark.parametrize("integrator", ["path", "restir"])
def test_calls_have_the_bits_of_one(cornell, backend, integrator):
    """And a call that names its first sample too."""
    films = []
    for parts in ([8], [1, 3, 4]):
        with dp.Session(cornell, backend=backend, integrator=integrator, size=(24, 16), seed=5) as session:
            for part in parts:
                assert session.render(part).spp == part
            films.append(session.film())
    assert np.array_equal(films[0].sums, films[1].sums) and films[1].spp == 8


def test_samples_are_named_by_their_number(floor):
    with dp.Session(floor, size=(16, 12)) as session:
        session.render(4, first=4)
        second = session.film()
        session.restart()
        session.render(4, first=0)
        first = session.film()
        with pytest.raises(dp.Error):
            session.render(4, first=2)  # 2 and 3 are there
        session.render(4)
        assert np.array_equal(session.film().sums, first.sums + second.sums)


def test_restart_gives_the_bits_of_a_new_session(floor):
    with dp.Session(floor, size=(16, 12), seed=3) as session:
        session.render(4)
        session.restart(seed=9)
        session.render(4)
        assert np.array_equal(session.film().sums, dp.render(floor, spp=4, size=(16, 12), seed=9).sums)


def test_settings_and_camera_change(floor):
    with dp.Session(floor, size=(16, 12), seed=3) as session:
        session.render(2)
        session.set_settings(integrator="direct", max_depth=1)
        assert session.settings == dp.Settings(size=(16, 12), seed=3, integrator="direct", max_depth=1)
        session.render(2)
        expected = dp.render(floor, spp=2, size=(16, 12), seed=3, integrator="direct", max_depth=1)
        assert np.array_equal(session.film().sums, expected.sums)
        session.set_camera(dp.look_at((0, 5, 1), (0, 0, 0)))
        session.render(2)
        assert not np.array_equal(session.film().sums, expected.sums)


def test_a_session_says_what_it_is(floor, backend):
    with dp.Session(floor, backend=backend, size=(8, 6)) as session:
        assert session.backend == backend and session.device
        assert session.capabilities.replay == (backend != "oracle")


def test_progress_is_reported_and_can_end_the_render(cornell):
    seen = []

    def stop_after_two(progress):
        seen.append(progress.spp)
        if len(seen) == 2:
            raise LookupError("enough")

    with dp.Session(cornell, size=(64, 64)) as session:
        with pytest.raises(LookupError, match="enough"):
            session.render(1_000_000, progress=stop_after_two)
        film = session.film()
        assert len(seen) == 2 and film.spp >= seen[1] > 0
        done = session.render(2)  # the session goes on
        assert session.film().spp == film.spp + done.spp


def test_progress_true_is_a_line_on_stderr(cornell, capfd):
    dp.render(cornell, size=(64, 64), spp=0, seconds=0.8, progress=True)
    shown = capfd.readouterr()
    assert shown.out == "" and "spp" in shown.err and shown.err.endswith("\n") and shown.err.count("\n") == 1


def test_a_render_ends_at_its_time_or_its_error(cornell):
    with dp.Session(cornell, size=(64, 64)) as session:
        began = time.monotonic()
        session.render(0, seconds=0.5)
        assert 0.4 < time.monotonic() - began < 5
        session.restart()
        session.render(0, relmse=0.05)
        assert session.film().relmse_estimate <= 0.05
        with pytest.raises(ValueError, match="count"):
            session.render(0)  # would never end


def test_a_closed_session_is_refused(floor):
    with dp.Session(floor, size=(8, 6)) as session:
        session.render(1)
    session.close()
    with pytest.raises(dp.Error, match="closed"):
        session.film()


def test_a_session_in_use_is_refused(cornell):
    with dp.Session(cornell, size=(64, 64)) as session:

        def reenter(progress):
            session.film()

        with pytest.raises(dp.Error, match="in use"):
            session.render(1_000_000, progress=reenter)


def test_other_threads_run_while_one_renders(cornell):
    """Python's lock is free: another thread counts on, and no pause is as long as the render."""
    ticks, done = [], threading.Event()

    def tick():
        while not done.is_set():
            ticks.append(time.monotonic())
            time.sleep(0.001)

    counter = threading.Thread(target=tick)
    with dp.Session(cornell, size=(64, 64), threads=1) as session:
        counter.start()
        began = time.monotonic()
        session.render(0, seconds=1)
        ended = time.monotonic()
        done.set()
        counter.join()
    inside = [moment for moment in ticks if began <= moment <= ended]
    assert len(inside) > 50 and max(np.diff(inside)) < 0.5 * (ended - began)


def test_sessions_render_at_once_in_threads(cornell):
    def film_of(seed):
        return dp.render(cornell, spp=8, size=(32, 32), seed=seed, threads=1)

    expected = [film_of(seed).sums for seed in (1, 2)]
    films = {}
    threads = [threading.Thread(target=lambda seed=seed: films.update({seed: film_of(seed)})) for seed in (1, 2)]
    for thread in threads:
        thread.start()
    for thread in threads:
        thread.join()
    assert np.array_equal(films[1].sums, expected[0]) and np.array_equal(films[2].sums, expected[1])


KEEPS_THE_FILM = """
import diptych as dp
scene = dp.load({scene!r})
with dp.Session(scene, backend={backend!r}, size=(64, 64)) as session:
    try:
        session.render(0, seconds=600, progress=lambda progress: print("going", flush=True))
    except KeyboardInterrupt:
        film = session.film()
        print("kept", film.spp, int(film.sample_counts.min()), float(film.radiance.mean()))
    session.render(1)
    print("went on by", session.film().spp - film.spp)
"""
RAISES = {"render": "dp.render(scene, spp=0, seconds=600, size=(64, 64))",
          "verify": "dp.verify(scene, 'cpu:path', 'cpu:path', runs=1000, spp=4096, size=(256, 256))"}


def interrupted(code, ready):
    """Runs the code, sends it Ctrl-C once it has printed the word, and returns what it did and how fast it ended."""
    process = subprocess.Popen([sys.executable, "-c", code], stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True)
    assert ready in process.stdout.readline()
    time.sleep(0.5)
    process.send_signal(signal.SIGINT)
    sent = time.monotonic()
    out, err = process.communicate(timeout=60)
    return out, err, process.returncode, time.monotonic() - sent


@pytest.mark.parametrize("panel", ["cpu", "vulkan"])
def test_ctrl_c_ends_a_render_and_keeps_its_film(panel, request):
    from conftest import SCENES
    if panel == "vulkan":
        request.getfixturevalue("vulkan")
    out, err, code, seconds = interrupted(
        KEEPS_THE_FILM.format(scene=str(SCENES / "cornell.gltf"), backend=panel), "going")
    kept = next(line.split() for line in out.splitlines() if line.startswith("kept"))
    assert int(kept[1]) > 0 and int(kept[2]) >= int(kept[1]) and float(kept[3]) > 0
    assert "went on by 1" in out and code == 0 and err == "" and seconds < 10


@pytest.mark.parametrize("call", RAISES)
def test_ctrl_c_raises_keyboard_interrupt(call):
    from conftest import SCENES
    code = f"import diptych as dp\nscene = dp.load({str(SCENES / 'cornell.gltf')!r})\nprint('ready', flush=True)\n"
    out, err, status, seconds = interrupted(code + RAISES[call], "ready")
    assert "KeyboardInterrupt" in err and status in (1, 130, -signal.SIGINT) and seconds < 10
