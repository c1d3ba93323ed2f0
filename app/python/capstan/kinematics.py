"""tip_positions(): forward kinematics of the arm."""

from __future__ import annotations

import numpy as np

from . import _native
from ._inputs import Path, path_of


def tip_positions(joints: np.ndarray, robot: Path | None = None) -> np.ndarray:
    """Centre of the marker on the tool in frame 0, by the robot's forward kinematics.

    Args:
        joints: q1, q2, q3 [rad, rad, m], shape (n, 3) or (3,).
        robot: robot file; default: the left RAVEN-II.

    Returns:
        Positions [m], shape (n, 3) or (3,); NaN where a joint is NaN.
    """
    rows = np.asarray(joints, dtype=np.float64)
    return _native.tips(np.atleast_2d(rows), path_of(robot)).reshape(rows.shape)
