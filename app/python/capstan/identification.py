"""identify(): pulley radius, cable stiffness, damping and friction from a recording."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any, Iterable

import numpy as np

from . import _native
from ._errors import InputError, require_one_of, require_range, warn
from ._inputs import Path, Progress, ReadAs, Table, path_of, read_as_of, recordings_of, tables_of, write_text


@dataclass(frozen=True)
class Parameter:
    """An identified parameter, in SI units.

    Attributes:
        name: ``r_l1``, ``k_e2``, …
        value, sigma: estimate and its standard deviation.
        nominal: value in the nominal robot file.
        seen: True: observable in this motion.
    """

    name: str
    value: float
    sigma: float
    nominal: float
    seen: bool


@dataclass(frozen=True)
class Identification:
    """Result of :func:`identify`.

    Attributes:
        report: the document of ``capstan-cli identify --json`` (manual: json.md).
        trace: estimates of the dual UKF over time: ``names`` (list of p names), ``t`` of shape (n,) [s],
            ``value`` and ``sigma`` of shape (n, p); None: the method was not run.
        robot: text of the identified robot file (YAML); empty: nothing was identified.
        tracking: text of a file of filter options with the identified delay of the camera (YAML); empty: none.
        notices: remarks on the recordings and on the result.
    """

    report: dict[str, Any]
    trace: dict[str, Any] | None
    robot: str
    tracking: str
    notices: list[str]

    @property
    def parameters(self) -> list[Parameter]:
        """Parameters of the chosen method; empty: nothing was identified."""
        if "drive" in self.report:
            found = self.report["drive"]["parameters"]
        else:
            method = {"dual-ukf": "dual_ukf", "batch": "batch"}.get(self.report["result"] or "")
            found = self.report[method]["parameters"] if method else []
        number = lambda value: float("nan") if value is None else value  # noqa: E731
        return [Parameter(one["name"], number(one["value"]), number(one["sigma"]), number(one["nominal"]),
                          one["seen"]) for one in found]

    def save_robot(self, path: Path) -> None:
        """Writes the identified robot file. Raises InputError if nothing was identified."""
        if not self.robot:
            raise InputError("nothing was identified: there is no robot file to write", reason="nothing was identified")
        write_text(path, self.robot)

    def save_tracking(self, path: Path) -> None:
        """Writes the filter options with the identified delay, for ``track(options=…)``."""
        if not self.tracking:
            raise InputError("no delay of the camera was identified", reason="no delay was identified")
        write_text(path, self.tracking)


def identify(recordings: Table | Iterable[Table], robot: Path | None = None, *, method: str = "both",
             parameters: str | None = None, options: Path | None = None, exact_camera: bool = False,
             read_as: ReadAs = None, held_out: Table | Iterable[Table] = (), offsets: str = "file", threads: int = 2,
             progress: Progress = None) -> Identification:
    """Identifies constants of a robot from recordings with cameras, or with the load of a robot of one joint.

    Args:
        recordings: one recording or a list, as for track(): motors and cameras of one robot and rig. Joint encoders
            are not used. A robot of one joint is different: its tables have ``t``, ``q_m``, ``q`` and ``tau_ext``.
        robot: nominal robot file; a session contains its own.
        method: ``dual-ukf``, ``batch`` or ``both``.
        parameters: ``"r_l,k_e"`` of all joints, or ``"r_l1,k_e2"`` of one; default: ``r_l,k_e,b_e,f_c``; of a robot of
            one joint: all.
        options: file of priors and goals (resources/identification/default.yaml).
        exact_camera: assume that registration and clock of the cameras are exact, as in the UKF paper.
        read_as: units of tables that are not in SI.
        held_out: tables for evaluation only, of a robot of one joint.
        offsets: zeros of the encoder of a robot of one joint: ``file`` (one for each table) or ``shared``.
        threads: number of worker threads of the batch method, 1 to 64.
        progress: called with the finished share and a phrase.

    Raises:
        InputError: for a file or an argument that cannot be used.
    """
    require_one_of("method", method, ("dual-ukf", "batch", "both"))
    require_one_of("offsets", offsets, ("file", "shared"))
    require_range("threads", threads, 1, 64)
    tables = recordings_of(recordings)
    result = _native.identify(
        tables, robot=path_of(robot), read_as=read_as_of(read_as), method=method, parameters=parameters or "",
        options=path_of(options), exact_camera=exact_camera, threads=threads,
        held_out=tables_of(held_out, "held-out arrays"), offsets=offsets, progress=progress)
    result["notices"] = warn(result["notices"])
    return Identification(**result)
