"""register(): the cameras' pose from points in both frames."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import numpy as np

from . import _native
from ._errors import warn
from ._inputs import Path, Table, path_of, table_of


@dataclass(frozen=True)
class Registration:
    """Result of :func:`register`.

    Attributes:
        report: the document of ``capstan-cli register --json``.
        base_from_camera: transform of points [m] from the left camera's frame into the base frame, shape (4, 4).
    """

    report: dict[str, Any]
    base_from_camera: np.ndarray

    @property
    def rms(self) -> float:
        """RMS distance of the pairs used [m]."""
        return self.report["rms"]

    @property
    def covariance(self) -> np.ndarray:
        """Covariance of (rotation vector [rad], translation [m]) in base axes, shape (6, 6)."""
        return np.array(self.report["covariance"], dtype=float)

    @property
    def residuals(self) -> np.ndarray:
        """Distance of each row's pair from the fit, shape (n,) [m]; NaN: the row has no pair."""
        return np.array(self.report["residuals"], dtype=float)

    @property
    def rejected(self) -> list[int]:
        """Rows that were rejected as outliers, from 0."""
        return self.report["rejected"]

    def save(self, path: Path) -> None:
        """Writes the registration file for ``track(register=…)``."""
        _native.write_registration(self.base_from_camera, path_of(path))


def register(pairs: Table, *, poses: Table | None = None, cameras: Path | None = None,
             exchange: bool = False) -> Registration:
    """Registers the cameras from a table of point pairs.

    Args:
        pairs: a file or columns: the tip in the base frame as ``x``, ``y``, ``z`` [m], and the marker as ``cam_x``,
            ``cam_y``, ``cam_z`` [m, left camera's frame] or as ``left_u``, ``left_v``, ``right_u``, ``right_v`` [px].
        poses: a table with ``x``, ``y``, ``z`` row by row, where `pairs` has only the marker.
        cameras: folder or file of the calibrated cameras, for pixels.
        exchange: take the left pixels as right and the right as left.

    Raises:
        InputError: for tables that cannot be used, and for pairs that give no registration.
    """
    result = _native.register(table_of(pairs), poses=None if poses is None else table_of(poses, "poses"),
                              cameras=path_of(cameras), exchange=exchange)
    if result["report"]["warning"]:
        warn([result["report"]["warning"]])
    return Registration(**result)
