"""Session: a recorded session file as arrays."""

from __future__ import annotations

import os
from functools import cached_property
from typing import Iterator, Union

import numpy as np

from . import _native

Path = Union[str, os.PathLike[str]]


def _joints(columns: dict[str, np.ndarray], prefix: str) -> np.ndarray:
    return np.stack([columns[f"{prefix}{i}"] for i in (1, 2, 3)], axis=1)


class Frames:
    """Pairs of images of a session, in order of arrival: ``len(frames)``, ``frames[i]``, ``for left, right in frames``.

    Attributes:
        t: time stamps of the exposures, shape (n,) [s].
        t_arrival: times of arrival, shape (n,) [s].
    """

    def __init__(self, path: str) -> None:
        columns = _native.session_table(path, "frame")
        self.t: np.ndarray = columns["t"]
        self.t_arrival: np.ndarray = columns["t_arrival"]
        self._images = _native.Images(path)

    def __len__(self) -> int:
        return len(self.t)

    def __getitem__(self, index: int) -> tuple[np.ndarray | None, np.ndarray | None]:
        """Left and right image, each of shape (height, width, 3), uint8, BGR; None: this camera gave no image.
        Each access decodes the images; the arrays own them.
        """
        return self._images.at(float(self.t[index]))

    def __iter__(self) -> Iterator[tuple[np.ndarray | None, np.ndarray | None]]:
        return (self[i] for i in range(len(self)))


class Session:
    """A session file (``.capstan``). Columns are read when they are first used. Joints in rad, rad, m; NaN: no value.

    Attributes:
        path: path of the file.
        title, created, software: texts of the header.
        robot: text of the nominal robot file (YAML).
        camera_left, camera_right: texts of the calibrations (ROS camera_info); empty: no images.
        truth: text of the truth file of a simulation; empty: not simulated.
        base_from_camera: stored registration, shape (4, 4); None: none.
        reference: True: the robot has joint encoders.
        own_kinematics: True: the joint columns are the robot's own kinematics, which is no reference.
        first_t, last_t: time of the first and the last sample [s].
        width, height: size of the images [px]; 0: no images.
        events: list of (t [s], kind, text).
    """

    path: str
    title: str
    created: str
    software: str
    robot: str
    camera_left: str
    camera_right: str
    truth: str
    base_from_camera: np.ndarray | None
    reference: bool
    own_kinematics: bool
    first_t: float
    last_t: float
    width: int
    height: int
    events: list[tuple[float, str, str]]

    def __init__(self, path: Path) -> None:
        """Opens the file without changing it. Raises InputError if it is no session, or damaged."""
        self.path = os.fspath(path)
        self.__dict__.update(_native.session_summary(self.path))

    def __repr__(self) -> str:
        return f"<capstan.Session {self.title!r}, {self.first_t:.3f} to {self.last_t:.3f} s>"

    def _table(self, name: str) -> dict[str, np.ndarray]:
        return _native.session_table(self.path, name)

    @cached_property
    def motors(self) -> dict[str, np.ndarray]:
        """Motor samples: ``t`` (n,) [s], ``position`` (n, 3) from the hard stop [rad], ``velocity`` (n, 3) [rad/s],
        ``torque`` (n, 3) [N·m].
        """
        columns = self._table("motor")
        return {"t": columns["t"], "position": _joints(columns, "q_m"), "velocity": _joints(columns, "dq_m"),
                "torque": _joints(columns, "tau_m")}

    @property
    def t(self) -> np.ndarray:
        """Times of the motor samples, shape (n,) [s]."""
        return self.motors["t"]

    @cached_property
    def joints(self) -> dict[str, np.ndarray]:
        """Joint encoders, the reference: ``t`` (n,) [s], ``position`` (n, 3) [rad, rad, m]."""
        columns = self._table("joint")
        return {"t": columns["t"], "position": _joints(columns, "q")}

    @cached_property
    def tips(self) -> dict[str, np.ndarray]:
        """Tip positions of another camera system: ``t``, ``t_arrival`` (n,) [s], ``position`` (n, 3) [m, frame 0]."""
        columns = self._table("tip")
        return {"t": columns["t"], "t_arrival": columns["t_arrival"], "position": _joints(columns, "p_c")}

    @cached_property
    def estimates(self) -> dict[str, np.ndarray]:
        """Stored output of the pipeline: ``t``, ``t_cam`` (n,) [s]; ``q_kin``, ``q_cam``, ``sigma_cam``, ``q_ukf``,
        ``dq_ukf``, ``sigma_ukf``, ``q`` (n, 3) [rad, rad, m]; ``gate`` (n,) int8, index into GATES; ``camera`` (n,)
        bool; ``nis``, ``nees`` (n,).
        """
        columns = self._table("estimate")
        names = {"q_kin": "q_link_kin", "q_cam": "q_link_cam", "sigma_cam": "q_link_cam_sigma", "q_ukf": "q_link_ukf",
                 "dq_ukf": "dq_link_ukf", "sigma_ukf": "q_link_ukf_sigma", "q": "q_link_true"}
        result: dict[str, np.ndarray] = {"t": columns["t"], "t_cam": columns["t_cam"]}
        result.update({name: _joints(columns, prefix) for name, prefix in names.items()})
        result.update(gate=columns["gate"].astype(np.int8), camera=columns["camera_updated"] != 0,
                      nis=columns["nis"], nees=columns["nees"])
        return result

    @cached_property
    def frames(self) -> Frames:
        """Pairs of images by index."""
        return Frames(self.path)


def open(path: Path) -> Session:
    """Opens a session file. Raises InputError if it is no session, or damaged."""
    return Session(path)
