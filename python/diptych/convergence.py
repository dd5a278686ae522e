"""How does the error of several methods fall over samples and over time?"""

from __future__ import annotations

import os
import pathlib
from dataclasses import dataclass, field
from typing import TYPE_CHECKING, Any, Callable, Dict, Iterable, List, Literal, NamedTuple, Optional, Tuple, Union

import numpy as np
import numpy.typing as npt

from . import _diptych
from ._diptych import Film, Scene, Settings
from .rendering import SettingChanges, changed

if TYPE_CHECKING:
    from typing_extensions import Unpack

Columns = Dict[str, npt.NDArray[Any]]


class Estimate(NamedTuple):
    """A value with the ends of its 95 % confidence interval; NaN is unknown."""

    value: float
    low: float
    high: float


@dataclass(frozen=True)
class MethodConvergence:
    """What the runs of one method say."""

    method: str
    device: str
    """Its own name."""
    runs: int
    slope_mse: Estimate
    """Of log MSE over log samples: -1 for independent samples."""
    slope_relmse: Estimate
    bias_p: float
    """p of the squared bias after the most samples, corrected for the number of methods; NaN is not tested."""
    bias_significant: bool
    """Whether bias_p is below 0.01."""
    bias_text: str
    """What to make of the bias."""
    target: Literal["reached", "earlier", "later", "unknown"]
    """Whether the method reached the target at target_seconds, or before the first or after the last measured time."""
    target_seconds: float


@dataclass(frozen=True, eq=False)
class Convergence:
    """The errors of several methods over samples and time. str() is the table that the program's `converge` prints."""

    scene: str
    size: Tuple[int, int]
    methods: List[MethodConvergence]
    reference: str
    """What errors are measured against."""
    reference_spp: int
    """0 is unknown."""
    reference_relmse: float
    """Of the reference itself; 0 where it is not known."""
    target_relmse: float
    text: str
    _columns: Columns = field(repr=False)
    _html: str = field(repr=False)

    def table(self, method: Optional[str] = None) -> Columns:
        """The columns of summary.csv (docs/converge.md) by name, a row for each method and sample count.

        method: only its rows. "method" is an array of names, and all others are float64 (rows,): "spp",
        "device_seconds" and "wall_seconds" (medians), "relmse" with "relmse_low" and "relmse_high" (95 % interval),
        "relmse_net" (without the reference's noise), "relative_bias_squared" with its "_error" and "relative_bias_p"
        and so on. NaN is unknown.
        """
        if method is None:
            return {name: column.copy() for name, column in self._columns.items()}
        rows = self._columns["method"] == method
        if not rows.any():
            raise _diptych.UnknownName(f"converge: {method} was not measured")
        return {name: column[rows] for name, column in self._columns.items()}

    def page(self, path: Union[str, os.PathLike[str]]) -> None:
        """Writes the report with charts and pictures: one HTML file that needs no other."""
        target = pathlib.Path(path)
        partial = target.with_name(f".{target.name}.{os.getpid()}")
        try:
            partial.write_text(self._html, encoding="utf-8")
            partial.replace(target)
        except OSError as error:
            partial.unlink(missing_ok=True)
            raise _diptych.Error(f"{target}: cannot write: {error.strerror}") from error

    def __str__(self) -> str:
        return self.text


def converge(
    scene: Scene,
    methods: Iterable[str] = ("cpu:brdf", "cpu:direct", "cpu:path"),
    *,
    seconds: float = 0,
    spp_max: int = 256,
    runs: int = 16,
    reference: Union[Film, str, os.PathLike[str]] = "auto",
    target_relmse: float = 0,
    picture_seconds: float = 0,
    device: str = "",
    threads: int = 0,
    progress: Optional[Callable[[str, int, int], object]] = None,
    **settings: Unpack[SettingChanges],
) -> Convergence:
    """Renders each method's runs and measures their errors after 1, 2, 4, 8... samples a pixel.

    methods: "BACKEND:INTEGRATOR", "BACKEND:INTEGRATOR:SAMPLER", "oracle" or "oracle:MODE". runs: of each method, each
    with its own seed; at least 2. spp_max: samples a pixel of a run, rounded down to a power of two; with seconds,
    instead as many as the method renders in so long. reference: a film, a picture's file, or a method that renders 16
    times the samples of a run; "auto" is path, on a backend for which it is not measured, or with the other MIS
    weights. target_relmse: that times are told to; 0 is what half of the methods reach. picture_seconds: of rendering
    that the page's pictures show; 0 is the shortest of the runs. progress: called before each step with what it is to
    do, the steps done and all steps, from another thread. Other keywords are settings; all seeds derive from the seed.

    Ctrl-C raises KeyboardInterrupt.

    >>> import diptych as dp
    >>> scene = dp.Scene()
    >>> scene.environment.scale = (1, 1, 1)
    >>> scene.add_mesh([(-1, 0, -1), (0, 0, 1), (1, 0, -1)], [(0, 1, 2)])
    0
    >>> scene.cameras.append(dp.look_at((0, 2, 2), (0, 0, 0)))
    >>> curve = dp.converge(scene, ["cpu:path", "cpu:direct"], runs=3, spp_max=8, size=(16, 12))
    >>> curve.table("cpu:path")["spp"].tolist()
    [1.0, 2.0, 4.0, 8.0]
    """
    if "integrator" in settings:
        raise TypeError("integrator: methods name theirs, as in \"cpu:path\"")
    members = _diptych.converge(
        scene, list(methods), seconds, spp_max, runs, reference, target_relmse, picture_seconds, device, threads,
        changed(Settings(), scene, settings), progress,
    )
    members["_columns"], members["_html"] = members.pop("columns"), members.pop("html")
    for method in members["methods"]:
        method["slope_mse"], method["slope_relmse"] = Estimate(*method["slope_mse"]), Estimate(*method["slope_relmse"])
    members["methods"] = [MethodConvergence(**method) for method in members["methods"]]
    return Convergence(**members)
