"""learn(): a correction of commands from tables of tip poses."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any, Iterable, Union

from . import _native
from ._errors import InputError, require_one_of, require_range
from ._inputs import Path, Progress, Table, tables_of
from .correction import Correction


@dataclass(frozen=True)
class Learning:
    """Result of :func:`learn`.

    Attributes:
        report: the document of ``capstan-cli learn --json`` (manual: json.md).
        model: the learned correction.
    """

    report: dict[str, Any]
    model: Correction


def learn(train: Table | Iterable[Table], *, test: Table | Iterable[Table] = (), hold_out: float = 0.0,
          method: str = "auto", towards: str = "command", kernel: str = "matern", cleaning: bool = True,
          weights: bool = True, alignment: bool = True, members: int = 3, inducing: int = 1000,
          onto: Union[Correction, Path, None] = None, threads: int = 2, seed: int = 1,
          progress: Progress = None) -> Learning:
    """Learns which command reaches a desired pose.

    Args:
        train: tables of tip poses, files or columns: ``traj``; ``t_cam_s`` [s], ``cam_x``, ``cam_y``, ``cam_z`` [m],
            ``cam_qx`` … ``cam_qw``; and the same of ``cmd`` or ``robot`` (manual: learning.md).
        test: tables of other trajectories, on which errors are measured.
        hold_out: share of the training trajectories [%] held out for an evaluation; 0: none, else 1 to 90.
        method: ``offset``: rigid offset only; ``none``, ``velocity``, ``history``: a Gaussian process with this motion
            among its inputs; ``auto``: velocity or history, whichever has the smaller error.
        towards: poses that the observed poses are compared with: ``command`` or ``robot``.
        kernel: ``matern`` (Matérn 3/2) or ``rbf`` (squared exponential).
        cleaning: reject outliers.
        weights: weight states by how well models of other trajectories predict them.
        alignment: compensate the clock offset of observations behind commands.
        members: number of averaged processes, 1 to 20.
        inducing: number of inducing points of each process, 20 to 20000.
        onto: existing model to add the motions to, without retraining.
        threads: number of worker threads, 1 to 64.
        seed: random seed.
        progress: called with the finished share and a phrase.

    Raises:
        InputError: for a table or an argument that cannot be used.
    """
    require_one_of("method", method, ("auto", "offset", "none", "velocity", "history"))
    require_one_of("towards", towards, ("command", "robot"))
    require_one_of("kernel", kernel, ("rbf", "matern"))
    require_range("members", members, 1, 20)
    require_range("inducing", inducing, 20, 20000)
    require_range("threads", threads, 1, 64)
    if hold_out != 0.0:
        require_range("hold_out", hold_out, 1.0, 90.0)
    tables = tables_of(train)
    if not tables:
        raise InputError("train: is empty. Give one or more tables of tip poses", key="train", reason="is empty",
                         remedy="Give one or more tables of tip poses")
    if onto is not None and not isinstance(onto, Correction):
        onto = Correction(onto)
    result = _native.learn(
        tables, test=tables_of(test, "test arrays"), hold_out=hold_out, method=method, towards=towards, kernel=kernel,
        cleaning=cleaning, weights=weights, alignment=alignment, members=members, inducing=inducing, threads=threads,
        seed=seed, onto=None if onto is None else onto._model, progress=progress)
    return Learning(result["report"], Correction._of(result["model"]))
