"""diagnose(): where a robot model disagrees with recordings, and the causes."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any, Iterable, Sequence

import numpy as np

from . import _native
from ._errors import require_one_of, require_range, warn
from ._inputs import Path, Progress, ReadAs, Table, path_of, read_as_of, recordings_of, write_text


@dataclass(frozen=True)
class Diagnosis:
    """Result of :func:`diagnose`.

    Attributes:
        report: the document of ``capstan-cli diagnose --json`` (manual: json.md).
        robot: text of the extended robot file (YAML): the refitted robot with all effects.
        next: proposed motion that distinguishes the most probable causes: ``t`` [s] and ``q1``, ``q2``, … [rad or m],
            each of shape (n,); None: none is proposed.
        next_text: the same as a trajectory file (CSV) for ``capstan-cli simulate --trajectory``; empty: none.
        notices: remarks on the recordings.
    """

    report: dict[str, Any]
    robot: str
    next: dict[str, np.ndarray] | None
    next_text: str
    notices: list[str]

    @property
    def verdict(self) -> str:
        """``found``, ``several``, ``tie``, ``nothing`` or ``unexplained``."""
        return self.report["verdict"]

    @property
    def summary(self) -> str:
        """The verdict in one or two sentences."""
        return self.report["summary"]

    @property
    def causes(self) -> list[dict[str, Any]]:
        """Material effects: ``effect``, ``joint``, ``parameters``, ``probability``, … (manual: json.md)."""
        return self.report["causes"]

    def save_robot(self, path: Path) -> None:
        """Writes the extended robot file."""
        write_text(path, self.robot)


def diagnose(recordings: Table | Iterable[Table], robot: Path | None = None, *, only: Sequence[str] = (),
             effort: float = 1.0, towards: str | None = None, skip_start: float = 0.0, zeros: str | None = None,
             material: str | None = None, read_as: ReadAs = None, filter: bool = True, threads: int = 2, seed: int = 1,
             progress: Progress = None) -> Diagnosis:
    """Finds where a robot model disagrees with recordings, the causes, and how much modelling them helps.

    Args:
        recordings: recordings of one robot, files or columns of measured tables; or one table of tip poses (columns
            ``traj``, ``t_cam_s``, ``cam_x``, …).
        robot: nominal robot file; a session contains its own.
        only: names of the effects to consider; default: all (manual: effects.md).
        effort: factor on the limit of the search for causes, 0.01 to 1e6.
        towards: for tip poses: ``kinematics`` or ``command``; default: kinematics, if the table has it.
        skip_start: initial time of each recording that is simulated but not compared [s].
        zeros: zeros of joint encoders: ``known``, ``shared`` or ``each``; default: each.
        material: smallest displacement of a joint that makes an effect a cause, as in ``"0.02deg,0.02mm"``.
        read_as: units of tables that are not in SI.
        filter: also compute how much the error of the Kalman filter falls with the extended robot.
        threads: number of worker threads, 1 to 64.
        seed: random seed of the bootstraps.
        progress: called with the finished share and a phrase.

    Raises:
        InputError: for a file or an argument that cannot be used.
    """
    if towards is not None:
        require_one_of("towards", towards, ("kinematics", "command"))
    if zeros is not None:
        require_one_of("zeros", zeros, ("known", "shared", "each"))
    require_range("effort", effort, 0.01, 1e6)
    require_range("skip_start", skip_start, 0.0, 1e6)
    require_range("threads", threads, 1, 64)
    tables = recordings_of(recordings)
    result = _native.diagnose(
        tables, robot=path_of(robot), read_as=read_as_of(read_as), towards=towards or "", zeros=zeros or "",
        material=material or "", only=list(only), effort=effort, skip_start=skip_start, threads=threads, seed=seed,
        filter=filter, progress=progress)
    result["notices"] = warn(result["notices"])
    return Diagnosis(**result)
