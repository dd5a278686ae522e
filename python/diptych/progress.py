"""What `progress=True` shows."""

from __future__ import annotations

import sys
from typing import Callable, Optional, TextIO, Union

from ._diptych import Progress

ProgressOption = Union[None, bool, Callable[[Progress], object]]


class ProgressLine:
    """One line on stderr, rewritten at each report."""

    def __init__(self, stream: Optional[TextIO] = None) -> None:
        self._stream = stream if stream is not None else sys.stderr
        self._width = 0

    def __call__(self, progress: Progress) -> None:
        parts = [f"{progress.spp} spp", f"{progress.seconds:.1f} s"]
        if progress.eta_seconds < float("inf"):
            parts.append(f"{progress.eta_seconds:.1f} s to go")
        if progress.relmse is not None:
            parts.append(f"relMSE {progress.relmse:.1e}")
        text = ", ".join(parts)
        self._stream.write("\r" + text.ljust(self._width))
        self._stream.flush()
        self._width = len(text)

    def end(self) -> None:
        if self._width > 0:
            self._stream.write("\n")


def callback_of(progress: ProgressOption) -> Optional[Callable[[Progress], object]]:
    """The callback of True is a line on stderr; None and False are no callback."""
    if progress is True:
        return ProgressLine()
    return progress if callable(progress) else None
