"""The file's node tree."""

import json

import numpy as np
import pytest

import diptych as dp
from conftest import SCENES

pytestmark = pytest.mark.filterwarnings("ignore:.*has no triangles")


@pytest.fixture
def crane(tmp_path):
    """A camera and a lamp at the end of an arm."""
    tree = {
        "asset": {"version": "2.0"}, "scene": 0, "scenes": [{"nodes": [2]}],
        "cameras": [{"type": "perspective", "perspective": {"yfov": 0.8, "znear": 0.1}}],
        "extensionsUsed": ["KHR_lights_punctual"],
        "extensions": {"KHR_lights_punctual": {"lights": [{"type": "point", "intensity": 5}]}},
        "nodes": [
            {"name": "eye", "camera": 0, "translation": [0, 0, 2]},
            {"name": "lamp", "translation": [1, 0, 0], "extensions": {"KHR_lights_punctual": {"light": 0}}},
            {"name": "crane", "children": [0, 1], "translation": [0, 3, 0]},
        ],
    }
    path = tmp_path / "crane.gltf"
    path.write_text(json.dumps(tree))
    return dp.load(path, complete=False)


def see(scene):
    """Edits are seen at a render."""
    return dp.render(scene, spp=2, size=(16, 12))


def turned(angle, *position):
    """About +Y."""
    matrix = np.eye(4)
    matrix[0, 0] = matrix[2, 2] = np.cos(angle)
    matrix[0, 2] = np.sin(angle)
    matrix[2, 0] = -np.sin(angle)
    matrix[:3, 3] = position
    return matrix


def test_the_tree_is_the_files(crane):
    nodes = crane.nodes
    assert nodes.names() == ["eye", "lamp", "crane"] and len(nodes) == 3 and "lamp" in nodes
    assert [node.index for node in nodes] == [0, 1, 2] and nodes[-1] == nodes["crane"]
    assert nodes["crane"].parent is None and nodes["eye"].parent == nodes["crane"]
    assert nodes["crane"].children == [nodes[0], nodes[1]] and not nodes["eye"].children
    assert np.array_equal(nodes["eye"].node_to_parent, turned(0, 0, 0, 2)) and nodes["lamp"].position == (1, 0, 0)
    assert nodes["eye"].cameras == [crane.cameras["eye"]] and nodes["lamp"].lights == [crane.lights["lamp"]]
    assert not nodes["crane"].cameras and not nodes["crane"].instances and crane.cameras[0].node == 0
    assert repr(nodes[2]) == "Node(name='crane')" and not any(node.animated for node in nodes)
    with pytest.raises(KeyError, match="did you mean 'crane'"):
        nodes["crame"]
    with pytest.raises(IndexError):
        nodes[3]
    assert len(dp.Scene().nodes) == 0


def test_what_hangs_below_an_edited_node_moves(crane):
    arm = turned(0.5, 1, 2, 3)
    crane.nodes["crane"].node_to_parent = arm
    see(crane)
    np.testing.assert_allclose(crane.cameras["eye"].camera_to_world, arm @ turned(0, 0, 0, 2), atol=1e-12)
    np.testing.assert_allclose(crane.lights["lamp"].position, (arm @ (1, 0, 0, 1))[:3], atol=1e-12)
    crane.nodes["lamp"].position = (0, 0, 0)
    see(crane)
    np.testing.assert_allclose(crane.lights["lamp"].position, (1, 2, 3), atol=1e-12)


def test_an_edited_matrix_wins_over_its_node(crane):
    crane.lights["lamp"].position = (9, 9, 9)
    crane.nodes["crane"].position = (0, 5, 0)
    see(crane)
    assert crane.lights["lamp"].position == (9, 9, 9) and crane.lights["lamp"].node == -1
    assert crane.cameras["eye"].position == (0, 5, 2) and not crane.nodes["lamp"].lights


@pytest.mark.parametrize("matrix, says", [
    (np.full((4, 4), np.nan), "'crane': node_to_parent is nan"),
    (np.diag((1, 1, 1, 2.0)), "'crane': node_to_parent has to be affine"),
    (np.diag((0, 0, 0, 1.0)), "'eye': its nodes' transform leaves no direction"),
])
def test_a_matrix_that_places_nothing_is_refused_by_name(crane, matrix, says):
    crane.nodes["crane"].node_to_parent = matrix
    with pytest.raises(dp.Error, match=says):
        see(crane)
    crane.nodes["crane"].node_to_parent = np.eye(4)
    see(crane)
    assert crane.cameras["eye"].position == (0, 0, 2)


def test_wrong_values_and_what_cannot_be_edited(crane):
    with pytest.raises(ValueError, match="4 x 4"):
        crane.nodes[0].node_to_parent = np.eye(3)
    with pytest.raises(TypeError, match="position"):
        crane.nodes[0].position = "here"
    for name in ("parent", "children", "animated", "cameras", "index"):
        with pytest.raises(AttributeError):
            setattr(crane.nodes[0], name, None)
    with pytest.raises(TypeError):
        del crane.nodes[0]
    with pytest.raises(TypeError):
        dp.Node()
    with pytest.raises(ValueError):
        crane.nodes[0].node_to_parent[0, 3] = 1


def test_a_node_moves_what_is_rendered_and_an_animation_sets_its_part():
    scene = dp.load(SCENES / "moving-light.gltf")
    occluder = scene.nodes["occluder"]
    assert occluder.animated and not scene.nodes["block"].animated
    assert [instance.mesh for instance in occluder.instances] == [scene.instances["occluder"].mesh]
    with dp.Session(scene, size=(16, 12), first_hit=True) as session:
        def depth(moment):
            session.pose(moment)
            session.render(2)
            return session.film()["depth"]

        rest, posed = depth(None), depth(1)
        occluder.position = (5, 50, 5)  # both translation and rotation are the animation's
        assert not np.array_equal(depth(None), rest) and np.array_equal(depth(1), posed)
        scene.nodes["block"].position = (0, 50, 0)
        assert not np.array_equal(depth(1), posed)
