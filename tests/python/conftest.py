"""What the tests share: small scenes, the program, and whether there is a Vulkan device."""

import os
import pathlib
import subprocess

import pytest

import diptych as dp

ROOT = pathlib.Path(__file__).resolve().parents[2]
SCENES = ROOT / "scenes"


def lit_floor():
    """Two triangles, a lamp and a camera."""
    scene = dp.Scene()
    square = [(-2, 0, -2), (-2, 0, 2), (2, 0, 2), (2, 0, -2)]
    scene.add_mesh(square, [(0, 1, 2), (0, 2, 3)], material=dp.Material(name="floor", metallic=0))
    scene.lights.append(dp.Light(name="lamp", position=(0, 2, 0), intensity=(20, 20, 20)))
    scene.cameras.append(dp.look_at((0, 1.5, 4), (0, 0, 0)))
    return scene


@pytest.fixture
def floor():
    return lit_floor()


@pytest.fixture
def cornell():
    return dp.load(SCENES / "cornell.gltf")


@pytest.fixture(params=["cpu", "vulkan", "oracle"])
def backend(request):
    if request.param == "vulkan":
        request.getfixturevalue("vulkan")
    return request.param


@pytest.fixture
def vulkan():
    if not dp.devices():
        pytest.skip("no Vulkan device with ray tracing")
    return "vulkan"


@pytest.fixture
def program():
    """Runs the command line's program."""
    path = os.environ.get("DIPTYCH_PROGRAM", "")
    if not os.path.exists(path):
        pytest.skip("DIPTYCH_PROGRAM names no program")

    def run(*arguments):
        return subprocess.run([path, *map(str, arguments)], check=True, capture_output=True, text=True).stdout

    return run
