"""Are two renderings the same? Statistically, as pictures, or path by path."""

from __future__ import annotations

import os
from dataclasses import dataclass
from typing import TYPE_CHECKING, Callable, List, Literal, Optional, Tuple, Union

import numpy as np
import numpy.typing as npt

from . import _diptych
from ._diptych import Film, ReplayVertex, Scene, Settings
from .rendering import SettingChanges, changed

if TYPE_CHECKING:
    from typing_extensions import Unpack

Rgb = Tuple[float, float, float]


@dataclass(frozen=True, eq=False)
class Verdict:
    """What is known of the difference between two sides' expectations."""

    verdict: Literal["PASS", "FAIL", "INCONCLUSIVE"]
    reason: str
    bias_percent: float
    """a - b, mean over the image and the channels, in percent of b's mean."""
    ci95: float
    """Half width of the 95 % confidence interval of bias_percent."""
    p: float
    """The least p-value of the tests, adjusted for their number; at most alpha is a FAIL."""
    min_detectable_percent: float
    """The bias of the image mean that would be found with 90 % power."""
    p_values: npt.NDArray[np.float64]
    """(tiles down, tiles across): of each tile, row 0 on top; NaN where both sides are black."""

    def __str__(self) -> str:
        return f"{self.verdict}: {self.reason}; bias {self.bias_percent:.3g} ± {self.ci95:.2g} %"


@dataclass(frozen=True)
class Comparison:
    """How far picture a is from the reference b. NaN is unknown."""

    mse: float
    """Mean of (a - b)²."""
    relmse: float
    """Mean of (a - b)² / (b² + 0.01)."""
    mean_ratio: Rgb
    """mean(a) / mean(b) of each channel."""
    z: Rgb
    """Difference of the means over its standard error; means something for independent pictures alone."""
    fraction_equal: float
    """Share of the pixels that agree to 0.1 %."""
    nonfinite: int
    """Pixels left out."""


@dataclass(frozen=True)
class Replay:
    """One path, traced in two sessions from the same random numbers."""

    radiance: Tuple[Rgb, Rgb]
    """Of the whole path in each session, W/(sr m²)."""
    vertices: Tuple[List[ReplayVertex], List[ReplayVertex]]
    parts_at: Optional[int]
    """The vertex from which the two paths differ, or None."""
    text: str
    """The finding in one line."""


def verify(
    scene: Scene,
    a: str = "vulkan:restir",
    b: str = "cpu:path",
    *,
    runs: int = 32,
    spp: int = 64,
    alpha: float = 1e-3,
    max_half_width: float = 0.1,
    max_tile_half_width: float = 1,
    tile: int = 16,
    device: str = "",
    threads: int = 0,
    progress: Optional[Callable[[int, int], object]] = None,
    **settings: Unpack[SettingChanges],
) -> Verdict:
    """Renders both sides and tests whether they converge to the same image.

    a, b: "BACKEND:INTEGRATOR", or "oracle"; b is the reference. runs: of each side, each with its own seed, at least 3.
    spp: samples a pixel of each run. alpha: the chance that unbiased sides FAIL. max_half_width: in percent of the
    image's mean; a PASS needs a 95 % confidence interval as narrow. max_tile_half_width: in percent of a tile's mean;
    half of the tiles must be as narrow. tile: pixels a side. progress: called with (run, runs) before each run, from
    another thread. Other keywords are settings; the integrators are the sides', and the seed is the first of all runs'.

    Ctrl-C raises KeyboardInterrupt.

    >>> import diptych as dp
    >>> scene = dp.Scene()
    >>> scene.environment.scale = (1, 1, 1)
    >>> dp.verify(scene, "cpu:path", "oracle", runs=3, spp=1, size=(16, 16)).verdict
    'PASS'
    """
    if "integrator" in settings:
        raise TypeError("integrator: the sides name theirs, as in a=\"cpu:path\"")
    settings.setdefault("sample_count", spp)
    members = _diptych.verify(
        scene, a, b, runs, spp, changed(Settings(), scene, settings), alpha, max_half_width, max_tile_half_width, tile,
        device, threads, progress,
    )
    return Verdict(**members)


def compare(a: Union[Film, str, os.PathLike[str]], b: Union[Film, str, os.PathLike[str]]) -> Comparison:
    """Compares two films of one size, or two files: EXR or any picture; "FILE:LAYER" names a layer of an EXR.

    >>> import diptych as dp
    >>> scene = dp.Scene()
    >>> scene.environment.scale = (1, 1, 1)
    >>> film = dp.render(scene, spp=2, size=(4, 3))
    >>> dp.compare(film, film).fraction_equal
    1.0
    """
    if isinstance(a, Film) and isinstance(b, Film):
        return Comparison(**_diptych.compare(a, b))
    if isinstance(a, Film) or isinstance(b, Film):
        raise TypeError("compare: wants two films or two files")
    return Comparison(**_diptych.compare(os.fspath(a), os.fspath(b)))


def replay(
    a: _diptych.Session, b: _diptych.Session, pixel: Tuple[int, int], sample: int = 0, *, tolerance: float = 1e-3
) -> Replay:
    """Traces one path in both sessions and finds where the two differ. Films stay as they are.

    pixel: (x, y) from the top left. sample: which of the pixel's. tolerance: relative; smaller differences are
    rounding.

    >>> import diptych as dp
    >>> scene = dp.Scene()
    >>> scene.environment.scale = (1, 1, 1)
    >>> with dp.Session(scene, size=(4, 3)) as a, dp.Session(scene, size=(4, 3)) as b:
    ...     print(dp.replay(a, b, pixel=(1, 2)).parts_at)
    None
    """
    return Replay(**_diptych.replay(a, b, pixel, sample, tolerance))
