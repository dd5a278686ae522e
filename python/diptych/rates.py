"""How fast does a backend render a scene?"""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING, Callable, Dict, Iterable, List, Literal, Optional

from . import _diptych
from ._diptych import Scene, Settings
from .rendering import SettingChanges, changed

if TYPE_CHECKING:
    from typing_extensions import Unpack


@dataclass(frozen=True)
class IntegratorRate:
    """One integrator's speed: medians over the frames."""

    integrator: str
    milliseconds: float
    """Of one sample a pixel."""
    samples_per_second: float
    rays_per_second: float
    bare_rays_per_second: Optional[float]
    """The same rays traced once more and nothing else. None for ris and restir."""
    share_of_bare: Optional[float]
    """The share of the integrator's time that bare tracing takes: near 1, traversal limits the integrator, and shading
    otherwise. None for ris and restir."""
    cost_relative_to_brdf: Optional[float]
    """Of a sample; None where brdf was not measured."""
    build_seconds: float
    """Of acceleration structures and uploads."""
    compile_seconds: float
    """Of pipelines."""
    passes: Dict[str, float]
    """Milliseconds of each pass, of one sample a pixel."""
    bytes: int
    """Of buffers, acceleration structures and film."""


@dataclass(frozen=True)
class Bench:
    """The speed of a backend on one scene. str() is the table that the program's `bench` prints."""

    backend: str
    device: str
    frames: int
    """Of each integrator."""
    integrators: List[IntegratorRate]
    text: str

    def __getitem__(self, integrator: str) -> IntegratorRate:
        """The rate of an integrator. Raises UnknownName."""
        for rate in self.integrators:
            if rate.integrator == integrator:
                return rate
        raise _diptych.UnknownName(f"bench: {integrator} was not measured")

    def __str__(self) -> str:
        return self.text.rstrip("\n")


def bench(
    scene: Scene,
    *,
    integrators: Iterable[str] = ("brdf", "direct", "path"),
    spp: int = 1,
    frames: int = 9,
    backend: Literal["cpu", "vulkan"] = "cpu",
    device: str = "",
    threads: int = 0,
    progress: Optional[Callable[[str, int, int], object]] = None,
    **settings: Unpack[SettingChanges],
) -> Bench:
    """Measures how fast a backend renders the scene, integrator by integrator. They take turns.

    spp: samples a pixel of one frame. frames: of each integrator, of which the median counts; at least 5. progress:
    called before each step with what it is to do, the steps done and all steps, from another thread. Other keywords are
    settings. Ctrl-C raises KeyboardInterrupt.

    >>> import diptych as dp
    >>> scene = dp.Scene()
    >>> scene.environment.scale = (1, 1, 1)
    >>> speed = dp.bench(scene, integrators=["path"], frames=5, size=(8, 6))
    >>> speed["path"].samples_per_second > 0, 0 < speed["path"].share_of_bare
    (True, True)
    """
    if "integrator" in settings:
        raise TypeError("integrator: integrators name what is measured")
    members = _diptych.bench(
        scene, list(integrators), spp, frames, backend, device, threads, changed(Settings(), scene, settings), progress
    )
    members["integrators"] = [IntegratorRate(**rate) for rate in members["integrators"]]
    return Bench(**members)
