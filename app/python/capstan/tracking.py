"""track(): joint angles of a recording by kinematics, cameras and the unscented Kalman filter."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any, Sequence

import numpy as np

from . import _native
from ._errors import warn
from ._inputs import Path, Progress, ReadAs, Table, path_of, read_as_of, table_of

#: Names of the codes in ``Tracking.estimates["gate"]``. ``GATES[0]``: the filter observed the camera; the others
#: are the reasons why it observed transmission kinematics.
GATES: tuple[str, ...] = _native.gates


@dataclass(frozen=True)
class Tracking:
    """Result of :func:`track`.

    Attributes:
        report: the document of ``capstan-cli track --json`` (manual: json.md).
        estimates: columns with one row per motor sample and per camera sample, n rows; NaN: unknown.

            ========== ======= ================================================================
            t          (n,)    time [s]
            camera     (n,)    bool; True: row of a camera sample
            t_cam      (n,)    time stamp of the camera sample [s]
            q_kin      (n, 3)  joints by transmission kinematics [rad, rad, m]
            q_cam      (n, 3)  joints from the cameras, at t_cam [rad, rad, m]
            q_ukf      (n, 3)  filtered joints [rad, rad, m]
            dq_ukf     (n, 3)  filtered joint velocities [rad/s, rad/s, m/s]
            sigma_ukf  (n, 3)  standard deviations of q_ukf [rad, rad, m]
            q          (n, 3)  joint encoders, the reference [rad, rad, m]
            gate       (n,)    int8; index into GATES
            nis        (n,)    normalised innovation squared of the camera sample
            ========== ======= ================================================================
        base_from_camera: transform of points [m] from the left camera's frame into frame 0, shape (4, 4); None: the
            cameras are not registered.
        registration: how the cameras were registered, with its residual; empty: as stored.
        notices: remarks on the recording.
    """

    report: dict[str, Any]
    estimates: dict[str, np.ndarray]
    base_from_camera: np.ndarray | None
    registration: str
    notices: list[str]

    @property
    def rms(self) -> dict[str, np.ndarray]:
        """RMS errors of ``kin``, ``cam`` and ``ukf`` against the joint encoders, each of shape (3,) [rad, rad, m]."""
        return {name: np.array(values, dtype=float) for name, values in self.report["rms"].items()}

    @property
    def nis_verdict(self) -> str | None:
        """``pass``, ``cautious`` or ``FAIL, too high``; None: no camera sample was accepted."""
        return self.report["nis_verdict"]


def track(recording: Table, robot: Path | None = None, *, read_as: ReadAs = None, topics: str = "",
          estimator_robot: Path | None = None, options: Path | None = None, register: Path = "stored",
          mounting: Path | None = None, occlude: float = 0.0, fail_motor: Sequence[str] = (),
          failed_motor: Sequence[int] = (), whole_frame: bool = False, estimates: bool = True,
          progress: Progress = None) -> Tracking:
    """Estimates the joint angles of a recording.

    Args:
        recording: session, measured table, RAVEN-II motor log or ROS bag, or the columns of a measured table:
            ``t`` [s], ``q_m`` [rad], and where measured ``dq_m`` [rad/s], ``tau_m`` [N·m], ``q`` [rad, rad, m],
            ``p_c`` [m, frame 0] (manual: measured-table.md).
        robot: nominal robot file; default: the left RAVEN-II. A session contains its own.
        read_as: units of a table that is not in SI, as in ``{"q_m": "deg"}``.
        topics: topics of a ROS bag, ``"motors=/arm/motors,left=none"``.
        estimator_robot: robot file that the filter assumes; default: the nominal robot.
        options: file of filter options; a session contains its own.
        register: how the cameras are registered: ``stored``, ``hard-stop``, ``kinematics``, or a file.
        mounting: registration file with the known rotation for ``register="hard-stop"``.
        occlude: share of the time in which both cameras are blocked [%], 0 to 95.
        fail_motor: failures of motor encoders, as in ``"2@60"`` (motor 2 freezes at 60 s) or ``"2@60:lost"``.
        failed_motor: motors (1, 2, 3) whose encoders are not used.
        whole_frame: search the whole of every image, without regions of interest.
        estimates: False: without the columns of estimates, which saves memory.
        progress: called with the finished share and a phrase.

    Raises:
        InputError: for a file or an argument that cannot be used, and for a recording without motor samples.
    """
    result = _native.track(
        table_of(recording), robot=path_of(robot), read_as=read_as_of(read_as), topics=topics,
        estimator_robot=path_of(estimator_robot), options=path_of(options), register=path_of(register),
        mounting=path_of(mounting), occlude=occlude, fail_motor=list(fail_motor), failed_motor=list(failed_motor),
        whole_frame=whole_frame, estimates=estimates, progress=progress)
    result["notices"] = warn(result["notices"])
    return Tracking(**result)
