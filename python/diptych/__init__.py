"""Diptych, a renderer with two panels that tests whether both converge to the same image.

Distances are metres, +Y is up, angles are radians, colours are linear Rec.709, radiance is W/(sr m²). Pictures are
NumPy arrays of shape (height, width, channels) with row 0 on top.

>>> import diptych as dp
>>> scene = dp.Scene()
>>> floor = [(-2, 0, -2), (-2, 0, 2), (2, 0, 2), (2, 0, -2)]
>>> scene.add_mesh(floor, [(0, 1, 2), (0, 2, 3)], material=dp.Material(name="floor", metallic=0))
0
>>> scene.lights.append(dp.Light(name="lamp", position=(0, 2, 0), intensity=(20, 20, 20)))
>>> scene.cameras.append(dp.look_at((0, 1, 4), (0, 0, 0)))
>>> film = dp.render(scene, spp=4, size=(32, 18))
>>> film.radiance.shape
(18, 32, 3)
"""

from ._diptych import (
    Camera,
    Capabilities,
    DeviceLost,
    Environment,
    Error,
    Film,
    Instance,
    Interrupted,
    Light,
    Material,
    NoDevice,
    Node,
    OutOfMemory,
    Progress,
    RenderResult,
    ReplayVertex,
    Scene,
    SceneWarning,
    SettingError,
    Settings,
    TextureSlot,
    UnknownName,
    __version__,
    devices,
    load,
    load_environment,
    look_at,
)
from .convergence import Convergence, Estimate, MethodConvergence, converge
from .measure import Comparison, Replay, Verdict, compare, replay, verify
from .rates import Bench, IntegratorRate, bench
from .rendering import Session, merge, render

__all__ = [
    "Bench",
    "Camera",
    "Capabilities",
    "Comparison",
    "Convergence",
    "DeviceLost",
    "Environment",
    "Error",
    "Estimate",
    "Film",
    "Instance",
    "IntegratorRate",
    "Interrupted",
    "Light",
    "Material",
    "MethodConvergence",
    "NoDevice",
    "Node",
    "OutOfMemory",
    "Progress",
    "RenderResult",
    "Replay",
    "ReplayVertex",
    "Scene",
    "SceneWarning",
    "Session",
    "SettingError",
    "Settings",
    "TextureSlot",
    "UnknownName",
    "Verdict",
    "__version__",
    "bench",
    "compare",
    "converge",
    "devices",
    "load",
    "load_environment",
    "look_at",
    "merge",
    "render",
    "replay",
    "verify",
]
