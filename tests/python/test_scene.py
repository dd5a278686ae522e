import warnings

import numpy as np
import pytest

import diptych as dp

SQUARE = np.array([(-2, 0, -2), (-2, 0, 2), (2, 0, 2), (2, 0, -2)], np.float32)
HALVES = np.array([(0, 1, 2), (0, 2, 3)], np.uint32)


def mean(scene, **settings):
    return dp.render(scene, spp=8, size=(16, 12), **settings).radiance.mean()


def test_an_edit_writes_through_and_is_seen(floor):
    with dp.Session(floor, size=(16, 12), integrator="direct") as session:
        session.render(8)
        before = session.film().radiance
        floor.materials["floor"].base_color = (0.5, 0.5, 0.5, 1)
        assert floor.materials[0].base_color == (0.5, 0.5, 0.5, 1)
        session.restart()
        session.render(8)
        after = session.film().radiance
    # A diffuse floor with a weak gloss: half the base colour is between half and all of the light.
    assert 0.5 * before.mean() < after.mean() < 0.6 * before.mean()
    with dp.Session(floor, size=(16, 12), integrator="direct") as session:
        session.render(8)
        assert np.array_equal(session.film().radiance, after)


@pytest.mark.parametrize("edit, factor", [
    (lambda scene: setattr(scene.lights["lamp"], "intensity", (60, 60, 60)), 3),
    (lambda scene: setattr(scene.lights[-1], "intensity", np.array([10, 10, 10])), 0.5),
    (lambda scene: scene.lights.clear(), 0),
    (lambda scene: scene.lights.append(dp.Light(position=(0, 2, 0), intensity=(20, 20, 20))), 2),
    (lambda scene: scene.instances.clear(), 0),
])
def test_lights_and_instances_are_edited(floor, edit, factor):
    before = mean(floor, integrator="direct", max_depth=1)
    edit(floor)
    assert mean(floor, integrator="direct", max_depth=1) == pytest.approx(factor * before, rel=1e-3)


def test_an_edited_camera_is_seen(floor):
    before = dp.render(floor, spp=4, size=(16, 12)).radiance
    floor.cameras[0].position = (1, 1.5, 4)
    floor.cameras[0].vertical_fov = 0.5
    assert not np.array_equal(dp.render(floor, spp=4, size=(16, 12)).radiance, before)


def test_the_camera_is_chosen_by_name(floor):
    floor.cameras.append(dp.look_at((0, 9, 0.1), (0, 0, 0)))
    floor.cameras[1].name = "top"
    by_name = dp.render(floor, spp=2, size=(8, 6), camera="top")
    assert by_name.settings.camera == 1
    assert np.array_equal(by_name.radiance, dp.render(floor, spp=2, size=(8, 6), camera=1).radiance)


def test_elements_are_found_by_index_and_by_name(floor):
    assert floor.materials.names() == ["floor"] and "floor" in floor.materials and "wall" not in floor.materials
    assert [light.name for light in floor.lights] == ["lamp"]
    assert floor.lights.index("lamp") == 0
    with pytest.raises(KeyError) as caught:
        floor.materials["wall"]
    assert isinstance(caught.value, dp.Error) and "wall" in str(caught.value) and "floor" in str(caught.value)
    with pytest.raises(IndexError):
        floor.lights[1]
    lamp = floor.lights[0]
    del floor.lights[0]
    with pytest.raises(IndexError, match="deleted"):
        lamp.intensity


def test_an_appended_element_is_the_scenes():
    scene = dp.Scene()
    lamp = dp.Light(name="a")
    scene.lights.append(lamp)
    for i in range(100):  # the scene's list moves in memory
        scene.lights.append(dp.Light())
    lamp.name = "b"
    assert scene.lights[0].name == "b"
    other = dp.Scene()
    other.lights.append(lamp)  # a copy, as it is another scene's
    lamp.name = "c"
    assert other.lights[0].name == "b" and scene.lights[0].name == "c"


def test_single_precision_reads_as_it_was_written(floor):
    for value in (0.3, 0.1, 1 / 3, 1e-7):
        floor.materials[0].roughness = value
        read = floor.materials[0].roughness
        assert np.float32(read) == np.float32(value) and len(repr(read)) <= len(repr(value))
    floor.materials[0].emission = (0.1, 0.2, 17.2)
    assert floor.materials[0].emission == (0.1, 0.2, 17.2)
    assert dp.Settings(near_share=0.3).near_share == 0.3


def test_parts_of_a_value_cannot_be_edited_in_vain(floor):
    with pytest.raises(TypeError):
        floor.materials[0].base_color[0] = 0
    with pytest.raises(ValueError):
        floor.cameras[0].camera_to_world[0, 3] = 1
    with pytest.raises(AttributeError):
        floor.materials[0].base_color_texture.texture = 0
    with pytest.raises(AttributeError):
        floor.materials[0].colour = (1, 1, 1)
    with pytest.raises(TypeError, match="colour"):
        dp.Material(colour=(1, 1, 1))


@pytest.mark.parametrize("field, value, error", [
    ("base_color", (1, 1, 1), TypeError), ("roughness", "rough", TypeError), ("alpha_mode", "glass", ValueError),
    ("base_color_texture", 3, TypeError),
])
def test_a_wrong_value_is_refused_by_the_fields_name(floor, field, value, error):
    with pytest.raises(error, match=field):
        setattr(floor.materials[0], field, value)


def test_matrices_are_indexed_by_row_and_column():
    moved = np.eye(4)
    moved[:3, 3] = (1, 2, 3)
    light = dp.Light(light_to_world=moved)
    assert light.position == (1, 2, 3) and np.array_equal(light.light_to_world, moved)
    with pytest.raises(ValueError, match="4 x 4"):
        light.light_to_world = np.eye(3)


def test_a_mesh_is_placed_by_its_transform(floor):
    raised = np.eye(4)
    raised[1, 3] = 0.5
    depth = dp.render(floor, spp=4, size=(16, 12))["depth"][6, 8]
    floor.add_mesh(SQUARE, HALVES, material="floor", transform=raised, name="step")
    assert dp.render(floor, spp=4, size=(16, 12))["depth"][6, 8] < depth
    assert (floor.mesh_count, floor.triangle_count, floor.instances["step"].position) == (2, 4, (0, 0.5, 0))


@pytest.mark.parametrize("change, says", [
    ({"positions": SQUARE[:, :2]}, r"positions: wants float32 \(n, 3\), not \(4, 2\)"),
    ({"positions": SQUARE.astype(complex)}, "positions: wants float32"),
    ({"positions": [("a", "b", "c")]}, "positions: wants float32"),
    ({"positions": SQUARE * np.float32("nan")}, "finite"),
    pytest.param({"positions": SQUARE.astype(float) * 1e300}, "finite",
                 marks=pytest.mark.filterwarnings("ignore:overflow")),
    ({"triangles": HALVES.astype(float)}, "triangles: wants integers"),
    ({"triangles": HALVES.ravel()}, r"triangles: wants integers \(n, 3\), not \(6,\)"),
    ({"triangles": HALVES + 1}, "4"),
    ({"triangles": -HALVES.astype(int)}, "-3 is out of range"),
    ({"triangles": HALVES.astype(int) + 2**32}, "out of range"),
    ({"normals": SQUARE[:3]}, "normals"),
    ({"uvs": SQUARE}, "uvs: wants float32"),
    ({"uvs": SQUARE[:2, :2]}, "(?i)uvs|texture coordinates"),
    ({"transform": np.eye(3)}, "transform: wants 4 x 4"),
])
def test_a_wrong_array_is_refused_and_adds_nothing(floor, change, says):
    arguments = {"positions": SQUARE, "triangles": HALVES, "material": dp.Material(name="new"), **change}
    with pytest.raises(ValueError, match=says) as caught:
        floor.add_mesh(**arguments)
    assert isinstance(caught.value, dp.Error)
    assert (floor.mesh_count, len(floor.materials), len(floor.instances)) == (1, 1, 1)
    assert np.isfinite(mean(floor))


def test_a_material_joins_by_itself_its_index_or_its_name(floor):
    paint = dp.Material(name="paint")
    floor.add_mesh(SQUARE, HALVES, material=paint)
    floor.add_mesh(SQUARE, HALVES, material=paint)  # the scene's by now
    floor.add_mesh(SQUARE, HALVES, material=1)
    assert floor.materials.names() == ["floor", "paint"]
    paint.roughness = 0.25
    assert floor.materials["paint"].roughness == 0.25
    with pytest.raises(KeyError, match="varnish"):
        floor.add_mesh(SQUARE, HALVES, material="varnish")
    with pytest.raises(IndexError):
        floor.add_mesh(SQUARE, HALVES, material=2)


def test_a_mesh_is_a_copy_of_any_array_of_its_shape(floor):
    wide = np.zeros((4, 6), np.float64)
    wide[:, ::2] = SQUARE
    strided = wide[:, ::2]  # neither float32 nor contiguous
    other = dp.Scene()
    other.add_mesh(strided, HALVES.astype(np.int64), material=dp.Material(name="floor", metallic=0))
    other.lights.append(floor.lights[0])
    other.cameras.append(floor.cameras[0])
    wide[:] = 0
    expected, film = (dp.render(scene, spp=2, size=(16, 12)) for scene in (floor, other))
    assert np.array_equal(expected.radiance, film.radiance)


def test_a_texture_is_read_where_it_is_mapped():
    """A floor of four texels, seen from above: each quarter shows its own."""
    colors = np.array([[(255, 0, 0), (0, 255, 0)], [(0, 0, 255), (255, 255, 255)]], np.uint8)
    scene = dp.Scene()
    texture = scene.add_texture(np.repeat(np.repeat(colors, 8, axis=0), 8, axis=1), name="quarters")
    paint = dp.Material(unlit=True, base_color_texture=dp.TextureSlot(texture))
    corners = np.array([(-1, 0, -1), (-1, 0, 1), (1, 0, 1), (1, 0, -1)], np.float32)
    scene.add_mesh(corners, HALVES, uvs=[(0, 0), (0, 1), (1, 1), (1, 0)], material=paint)
    scene.cameras.append(dp.look_at((0, 3, 0), (0, 0, 0), up=(0, 0, -1), vertical_fov=2 * np.arctan(1 / 3)))
    film = dp.render(scene, spp=4, size=(8, 8))
    for row, column in np.ndindex(2, 2):
        np.testing.assert_allclose(film.radiance[2 + 4 * row, 2 + 4 * column], colors[row, column] / 255, atol=1e-6)
    with pytest.raises(ValueError, match="uint8"):
        scene.add_texture(np.zeros((2, 2, 3), np.float32))


def test_an_environments_map_is_set_and_read():
    scene = dp.Scene()
    texels = np.full((4, 8, 3), (1, 2, 3), np.float32)
    scene.environment = dp.Environment(scale=(2, 1, 1), map=texels)
    texels[:] = 0
    view = scene.environment.map
    assert view.shape == (4, 8, 3) and tuple(view[0, 0]) == (1, 2, 3) and not view.flags.writeable
    np.testing.assert_allclose(dp.render(scene, spp=2, size=(4, 3)).radiance[0, 0], (2, 2, 3), rtol=1e-5)
    scene.environment.map = None
    scene.environment.scale = (0.5, 0.5, 0.5)
    np.testing.assert_allclose(dp.render(scene, spp=2, size=(4, 3)).radiance[0, 0], 0.5)
    assert tuple(view[0, 0]) == (1, 2, 3)
    with pytest.raises(ValueError, match="map"):
        scene.environment.map = np.zeros((4, 8))


def test_a_sun_is_a_light(floor):
    floor.lights.clear()
    sun = floor.add_sun(azimuth=0, elevation=90, irradiance=np.pi)
    assert sun.kind == "directional" and len(floor.lights) == 1
    assert mean(floor, integrator="direct", max_depth=1) > 0.1


def test_a_copy_is_a_scene_of_its_own(floor):
    copy = floor.copy()
    copy.lights[0].intensity = (0, 0, 0)
    assert floor.lights[0].intensity == (20, 20, 20) and mean(copy) == 0 < mean(floor)


def test_a_file_that_cannot_be_loaded_is_named(tmp_path):
    with pytest.raises(dp.Error, match="missing.gltf"):
        dp.load(tmp_path / "missing.gltf")
    (tmp_path / "bad.gltf").write_text('{"asset": {"version": "2.0"}, "extensionsRequired": ["EXT_nonsense"]}')
    with pytest.raises(dp.Error, match="EXT_nonsense"):
        dp.load(tmp_path / "bad.gltf")


def test_a_file_asks_for_no_more_memory_than_it_may(tmp_path):
    from conftest import SCENES

    scene = SCENES / "cornell.gltf"
    with pytest.raises(dp.Error, match=r"cornell.gltf.*may ask for 100 bytes \(`memory_limit`\)"):
        dp.load(scene, memory_limit=100)
    assert dp.load(scene, memory_limit=1 << 30).mesh_count > 0
    sky = tmp_path / "sky.hdr"
    sky.write_bytes(b"#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n\n-Y 1 +X 2\n" + bytes([128] * 8))
    assert dp.load_environment(sky).map.shape == (1, 2, 3)
    with pytest.raises(dp.Error, match="memory_limit"):
        dp.load_environment(sky, memory_limit=70)


def test_what_a_file_asks_in_vain_is_a_warning(tmp_path):
    (tmp_path / "odd.gltf").write_text('{"asset": {"version": "2.0"}, "extensionsUsed": ["EXT_nonsense"], '
                                       '"extensionsRequired": ["EXT_nonsense"]}')
    with pytest.warns(dp.SceneWarning) as issued:
        dp.load(tmp_path / "odd.gltf", ignore_extensions=["EXT_nonsense"])
    assert any("EXT_nonsense" in str(each.message) for each in issued)
    assert {each.filename for each in issued} == {__file__}  # the line that loads is the one to blame
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        with pytest.raises(dp.SceneWarning):
            dp.load(tmp_path / "odd.gltf", ignore_extensions=["EXT_nonsense"])


def test_an_animation_moves_the_scene():
    from conftest import SCENES
    scene = dp.load(SCENES / "moving-light.gltf")
    assert scene.duration > 0 and scene.animations
    with dp.Session(scene, size=(16, 9)) as session:
        pictures = []
        for moment in (0, scene.duration / 2, 0):
            session.pose(moment)
            session.render(4)
            pictures.append(session.film().radiance)
    assert np.array_equal(pictures[0], pictures[2]) and not np.array_equal(pictures[0], pictures[1])
