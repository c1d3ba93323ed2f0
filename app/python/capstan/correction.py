"""Correction: a learned model, and the commands that it gives for desired poses."""

from __future__ import annotations

import os
from typing import Any, Union

import numpy as np

from . import _native
from ._errors import require_one_of, warn
from ._inputs import Path, Progress, Table, table_of

#: Confidence below which the correction of a pose is little more than the rigid offset.
LOW_CONFIDENCE: float = _native.low_confidence


class Correction:
    """A model that :func:`learn` or ``capstan-cli learn`` learned: the command for which the cameras observe a
    desired pose.
    """

    def __init__(self, path: Path) -> None:
        """Reads the file of a model. Raises InputError if it is no such file, or damaged."""
        self._model = _native.Correction.read(os.fspath(path))

    @classmethod
    def _of(cls, model: Any) -> "Correction":
        correction = cls.__new__(cls)
        correction._model = model
        return correction

    def save(self, path: Path) -> None:
        """Writes the model for ``capstan-cli correct``; the same bytes as ``capstan-cli learn --model``."""
        self._model.write(os.fspath(path))

    @property
    def offset(self) -> np.ndarray:
        """Rigid offset from the cameras' frame into the commands' frame, shape (4, 4)."""
        return self._model.offset()

    @property
    def rigid(self) -> bool:
        """True: the model is the rigid offset alone, which has no confidence."""
        return self._model.rigid()

    @property
    def source(self) -> dict[str, Any]:
        """Source of the training data: ``files``, ``towards``, ``clock_offset`` [s], ``states``, ``rejected``,
        ``software``.
        """
        return self._model.source()

    def correct(self, desired: Table, *, mode: str = "poses", progress: Progress = None) -> dict[str, Any]:
        """Commands for desired poses.

        Args:
            desired: a file or columns: ``x``, ``y``, ``z`` [m] and ``qx``, ``qy``, ``qz``, ``qw`` (unit quaternion) in
                the cameras' frame; optionally ``t_s`` [s] and ``traj``. Without ``t_s`` the arm is at rest.
            mode: ``poses``: each pose by itself; ``path``: trajectories are planned motions, and each waypoint is
                corrected with its velocity; ``end_point``: only the end points of straight motions are corrected.
            progress: called with the finished share and a phrase.

        Returns:
            Columns with one row per pose: ``traj`` (n,), ``t`` (n,) [s] or None, ``position`` (n, 3) [m] and
            ``quaternion`` (n, 4) (x, y, z, w) of the command, ``sigma`` (n, 6) [m, m, m, rad, rad, rad] (only for
            ``poses``, else None), ``confidence`` (n,), 0 to 1.

        Raises:
            InputError: for a table that cannot be used, and for poses far from all learned ones.
        """
        require_one_of("mode", mode, ("poses", "path", "end_point"))
        commands = self._model.correct(table_of(desired), mode, progress)
        far = int(np.count_nonzero(commands["confidence"] < LOW_CONFIDENCE))
        if far and not self.rigid:
            warn([f"{far} of {len(commands['confidence'])} poses are far from the learned poses "
                  f"(confidence below {LOW_CONFIDENCE:g})"])
        return commands


def correct(model: Union[Correction, Path], desired: Table, *, mode: str = "poses",
            progress: Progress = None) -> dict[str, Any]:
    """:meth:`Correction.correct` of a model or of the file of a model."""
    correction = model if isinstance(model, Correction) else Correction(model)
    return correction.correct(desired, mode=mode, progress=progress)
