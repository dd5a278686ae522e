import os
import re
import subprocess
import sys

import pytest

import diptych as dp
from diptych.rendering import SettingChanges


def test_every_setting_is_a_keyword_with_a_type():
    names = [name for name in vars(dp.Settings) if isinstance(vars(dp.Settings)[name], property)]
    assert sorted(names) == sorted(SettingChanges.__annotations__)
    for name in names:
        assert vars(dp.Settings)[name].__doc__


def test_settings_are_values():
    settings = dp.Settings(integrator="restir", near_share=0.25)
    assert settings == dp.Settings().replace(near_share=0.25, integrator="restir") != dp.Settings()
    assert repr(settings) == "Settings(integrator='restir', near_share=0.25)"
    with pytest.raises(AttributeError):
        settings.seed = 1


def test_choices_are_the_programs(program):
    text = program("render", "--help")
    for name, option in [("integrator", "integrator"), ("sampler", "sampler"), ("mis", "mis"), ("brdf", "brdf"),
                         ("reuse_mis", "reuse-mis"), ("reuse_visibility", "reuse-visibility")]:
        with pytest.raises(ValueError) as caught:
            dp.Settings(**{name: "none"})
        described = text[text.index(f"--{option} "):]
        for choice in re.search("there are only (.*)", str(caught.value))[1].split(", "):
            assert choice in described, (name, choice)
            assert getattr(dp.Settings(**{name: choice}), name) == choice


def test_ranges_are_the_programs(program):
    """Those with two ends stand in the program's help."""
    text = program("render", "--help")
    described = {name.replace("-", "_"): (float(least), float(most)) for name, least, most in
                 re.findall(r"--([a-z-]+) (?:(?!\n +-)[^\[])*?in \[(\S+) - (\S+)\]", text)}
    ranges = {name: ends for name, ends in dp.Settings.ranges.items() if name in described}
    assert ranges == {name: described[name] for name in ranges} and len(ranges) >= 5


@pytest.mark.parametrize("name, value, error", [
    ("integrator", "photon", ValueError), ("integrator", 3, ValueError), ("size", (0, 4), ValueError),
    ("size", 512, TypeError), ("size", (32768, 32768), ValueError), ("max_depth", -1, ValueError),
    ("max_depth", 2.5, TypeError), ("max_depth", 2**70, ValueError), ("seed", 2**32, ValueError),
    ("near_share", 1.5, ValueError), ("near_share", float("nan"), ValueError), ("reuse_radius", 0, ValueError),
    ("temporal", 1, TypeError), ("neighbours", 4, TypeError),
])
def test_a_wrong_setting_is_refused_by_its_name(floor, name, value, error):
    with pytest.raises(error, match=name) as caught:
        dp.render(floor, spp=1, **{name: value})
    assert isinstance(caught.value, dp.Error) == (error is ValueError)


def test_the_message_is_the_programs():
    with pytest.raises(dp.SettingError, match="^integrator photon: there are only brdf, direct, path, ris, restir$"):
        dp.Settings(integrator="photon")


@pytest.mark.parametrize("arguments, says", [({"backend": "gpu"}, "cpu, vulkan, oracle"), ({"camera": 7}, "camera"),
                                             ({"device": "x"}, "device: goes with backend vulkan"),
                                             ({"backend": "vulkan", "threads": 2}, "threads: goes with backend cpu"),
                                             ({"validation": True}, "validation: goes with backend vulkan"),
                                             ({"camera": "side"}, "side")])
def test_what_a_session_cannot_have_is_refused(floor, arguments, says):
    with pytest.raises(dp.Error, match=says):
        dp.Session(floor, **arguments)


def test_a_device_that_is_not_there_is_refused(floor, vulkan):
    with pytest.raises(dp.Error, match="abacus"):
        dp.Session(floor, backend="vulkan", device="abacus")


def test_the_exceptions_form_a_tree():
    for special in (dp.SettingError, dp.UnknownName, dp.NoDevice, dp.OutOfMemory, dp.DeviceLost, dp.Interrupted):
        assert issubclass(special, dp.Error)
    assert issubclass(dp.SettingError, ValueError) and issubclass(dp.UnknownName, KeyError)
    assert issubclass(dp.OutOfMemory, MemoryError)
    assert str(dp.UnknownName("plain text")) == "plain text"


def in_a_new_process(code, **environment):
    return subprocess.run([sys.executable, "-c", "import diptych as dp\n" + code], env={**os.environ, **environment},
                          capture_output=True, text=True, timeout=120)


def test_a_picture_without_room_is_out_of_memory_and_says_what_would_fit(vulkan):
    if "llvmpipe" not in dp.devices()[0]:
        pytest.skip("a limit of the process limits no other device's memory")
    ended = in_a_new_process("import resource\n"
                             "resource.setrlimit(resource.RLIMIT_AS, (4 << 30, 4 << 30))\n"
                             "scene = dp.Scene()\n"
                             "scene.environment.scale = (1, 1, 1)\n"
                             "try: dp.Session(scene, backend='vulkan', size=(8192, 8192))\n"
                             "except dp.OutOfMemory as error: print(isinstance(error, MemoryError), error)\n")
    assert ended.returncode == 0, ended.stderr
    assert re.match(r"True .*out of memory: .* at once: the film .* `size` of \d+x\d+ would fit", ended.stdout)



def test_a_machine_without_a_device_says_so():
    result = in_a_new_process("print(dp.devices())\n"
                              "try: dp.Session(dp.Scene(), backend='vulkan')\n"
                              "except dp.NoDevice as error: print(type(error).__mro__[1] is dp.Error, error)\n",
                              VK_DRIVER_FILES="/nonexistent.json", VK_ICD_FILENAMES="/nonexistent.json")
    assert result.stdout.startswith("[]\nTrue ") and result.returncode == 0, result.stdout + result.stderr


def test_a_session_that_is_left_open_ends_with_the_process(backend):
    result = in_a_new_process(f"session = dp.Session(dp.Scene(), backend={backend!r}, size=(8, 6))\n"
                              "session.render(2)\nfilm = session.film()\nview = film.radiance\n")
    assert (result.returncode, result.stderr) == (0, "")


def test_importing_is_light():
    """OpenImageIO, with its hundreds of libraries, is loaded at the first picture."""
    code = "maps = open('/proc/self/maps').read()\nassert 'libdiptych.so' in maps and 'OpenImageIO' not in maps\n"
    assert in_a_new_process(code).returncode == 0
