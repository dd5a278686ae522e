"""Sessions with keywords for the settings, and the one call that renders a film."""

from __future__ import annotations

import os
from typing import TYPE_CHECKING, Any, Dict, Iterable, Literal, Mapping, Optional, Tuple, TypedDict, Union

from . import _diptych
from ._diptych import Film, RenderResult, Scene, Settings
from .progress import ProgressLine, ProgressOption, callback_of

if TYPE_CHECKING:
    from typing_extensions import Unpack

Backend = Literal["cpu", "vulkan", "oracle"]


class SettingChanges(TypedDict, total=False):
    """Keywords that name settings; diptych.Settings explains each. A camera may be given by its name."""

    integrator: Literal["brdf", "direct", "path", "ris", "restir"]
    size: Tuple[int, int]
    max_depth: int
    seed: int
    camera: Union[int, str]
    sampler: Literal["independent", "hammersley", "sobol"]
    sample_count: int
    mis: Literal["power", "balance"]
    light_sampler: Literal["uniform", "power", "spatial"]
    brdf: Literal["ggx", "blinn-phong"]
    normal_maps: Literal["shading", "microfacet"]
    standard_error: bool
    first_hit: bool
    candidates: int
    near_share: float
    bsdf_candidate: bool
    temporal: bool
    spatial_passes: int
    neighbors: int
    reuse_radius: float
    confidence_cap: float
    reuse_mis: Literal["pairwise", "balance", "1-over-z", "biased-1-over-m"]
    reuse_visibility: Literal["shading", "target", "biased-initial", "biased-final"]


def changed(settings: Settings, scene: Scene, changes: Mapping[str, Any]) -> Settings:
    """The settings with the changes, where a camera's name stands for its index in the scene."""
    resolved: Dict[str, Any] = dict(changes)
    if isinstance(resolved.get("camera"), str):
        resolved["camera"] = scene.cameras.index(resolved["camera"])
    return settings.replace(**resolved)


class Session(_diptych.Session):
    """A scene on one backend, and the film that grows on it.

    backend: "cpu", "vulkan" or "oracle". device: of vulkan, an index or a part of the name; empty is the best. threads:
    of cpu and oracle; 0 is one a core. validation: of vulkan, the validation layers. Other keywords are settings (see
    diptych.Settings).

    A session sees edits of its scene at its next render. It is used by one thread at a time; several sessions may
    render at once in several threads, since Python's lock is free while they render.

    >>> import diptych as dp
    >>> scene = dp.Scene()
    >>> scene.environment.scale = (1, 1, 1)
    >>> with dp.Session(scene, size=(4, 3), seed=1) as session:
    ...     for samples in (2, 6):  # the same bits as one call of 8
    ...         done = session.render(samples)
    ...     film = session.film()
    >>> film.spp
    8
    """

    def __init__(
        self,
        scene: Scene,
        *,
        backend: Backend = "cpu",
        device: str = "",
        threads: int = 0,
        validation: bool = False,
        **settings: Unpack[SettingChanges],
    ) -> None:
        self._scene = scene
        super().__init__(scene, backend, device, threads, validation, changed(Settings(), scene, settings))

    def render(
        self,
        count: int,
        first: Optional[int] = None,
        progress: ProgressOption = None,
        seconds: float = 0,
        relmse: float = 0,
    ) -> RenderResult:
        """Adds the next count samples to every pixel, or samples first, first + 1 and so on.

        progress: True shows a line on stderr; a callable gets a diptych.Progress about every quarter of a second, and
        what it raises ends the render and is raised here. seconds and relmse end the render after so long, or at this
        estimate of the error; count may then be 0, which is no limit.

        Ctrl-C ends the render and raises KeyboardInterrupt. The film so far stays whole: film() returns it.
        """
        callback = callback_of(progress)
        try:
            return super().render(count, first, callback, seconds, relmse)
        finally:
            if isinstance(callback, ProgressLine):
                callback.end()

    def set_settings(self, settings: Optional[Settings] = None, **changes: Unpack[SettingChanges]) -> None:
        """Begins another picture under other settings: all of those given, or the present ones with changes.

        What the settings do not touch stays.
        """
        super().set_settings(changed(settings if settings is not None else self.settings, self._scene, changes))

    def __enter__(self) -> Session:
        return self

    def __exit__(self, *exception: object) -> None:
        self.close()


def render(
    scene: Scene,
    *,
    spp: int = 64,
    backend: Backend = "cpu",
    device: str = "",
    threads: int = 0,
    progress: ProgressOption = None,
    seconds: float = 0,
    relmse: float = 0,
    **settings: Unpack[SettingChanges],
) -> Film:
    """Renders spp samples a pixel and returns the film.

    Keywords are those of diptych.Session and of its render. Ctrl-C raises KeyboardInterrupt, and the film is lost:
    a Session keeps it.

    >>> import diptych as dp
    >>> scene = dp.Scene()
    >>> scene.environment.scale = (0.25, 0.5, 1)
    >>> film = dp.render(scene, integrator="path", spp=2, size=(4, 3))
    >>> film.radiance[0, 0].tolist()  # W/(sr m²)
    [0.25, 0.5, 1.0]
    """
    if spp > 0:
        settings.setdefault("sample_count", spp)
    with Session(scene, backend=backend, device=device, threads=threads, **settings) as session:
        session.render(spp, progress=progress, seconds=seconds, relmse=relmse)
        return session.film()


def merge(films: Iterable[Union[Film, str, os.PathLike[str]]], *, partial: bool = False) -> Film:
    """The films, or films in files, as one: the same bits as one render of all their samples, in whatever order.

    Raises Error, which names the films, where they are not of one picture, have samples in common, or have no sums;
    and, unless partial, where samples are missing before the last one.

    >>> import diptych as dp
    >>> scene = dp.Scene()
    >>> scene.environment.scale = (1, 1, 1)
    >>> with dp.Session(scene, size=(4, 3)) as session:
    ...     parts = []
    ...     for first in (0, 8):
    ...         session.restart()
    ...         done = session.render(8, first=first)
    ...         parts.append(session.film())
    >>> dp.merge(parts).spp
    16
    """
    return _diptych.merge([film if isinstance(film, Film) else Film.load(film) for film in films], partial)
