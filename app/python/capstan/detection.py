"""detect(): the coloured marker in images."""

from __future__ import annotations

import os
from dataclasses import dataclass
from typing import Any, Union

import numpy as np

from . import _native
from ._errors import require_one_of
from ._inputs import Path, path_of

#: An image: a file, or an array of shape (height, width, 3), type uint8, in the order BGR.
Image = Union[Path, np.ndarray]


@dataclass(frozen=True)
class Detection:
    """Marker in an image. Pixels are those of the whole image, with the lens's distortion.

    Attributes:
        found: True: the marker was found; else the numbers are NaN.
        u, v: column and row of the centre [px].
        radius: radius of the fitted circle [px].
        sigma: standard deviation of the centre, per axis [px].
        circularity: 4π area / perimeter² of the contour.
        area: area of the blob [px].
        reason: why there is no marker; None: it was found.
    """

    found: bool
    u: float = float("nan")
    v: float = float("nan")
    radius: float = float("nan")
    sigma: float = float("nan")
    circularity: float = float("nan")
    area: int = 0
    reason: str | None = None

    @classmethod
    def _of(cls, found: dict[str, Any]) -> "Detection":
        return cls("reason" not in found, **found)


def _given(image: Image | None) -> Any:
    return os.fspath(image) if isinstance(image, (str, os.PathLike)) else image


class Detector:
    """Finds a marker in many images. It keeps its buffers, and for ``region`` the marker of the pair before."""

    def __init__(self, marker: Path | None = None) -> None:
        """`marker`: marker file (``capstan-cli marker``); default: the green ball of the simulation."""
        self._finder = _native.Finder(path_of(marker))

    @property
    def options(self) -> dict[str, float]:
        """Limits of colour and shape, with the names of a marker file."""
        return self._finder.options()

    def detect(self, image: Image) -> Detection:
        """The marker in one whole image. Raises InputError for a file that is no image, or an array of another
        shape or type.
        """
        return Detection._of(self._finder.find(_given(image), None, False)[0])

    def detect_pair(self, left: Image, right: Image, *, search: str = "frame") -> tuple[Detection, Detection]:
        """The marker in a pair of images.

        Args:
            left, right: images of the two cameras.
            search: ``frame``: the whole of each image; ``region``: around the marker of the pair before, then the whole.
        """
        require_one_of("search", search, ("frame", "region"))
        first, second = self._finder.find(_given(left), _given(right), search == "region")
        return Detection._of(first), Detection._of(second)


def detect(image: Image, marker: Path | None = None) -> Detection:
    """The marker in one image; for many images use a :class:`Detector`.

    Args:
        image: a file, or an array of shape (height, width, 3), uint8, BGR. An array is not copied.
        marker: marker file; default: the green ball of the simulation.
    """
    return Detector(marker).detect(image)


def read_image(path: Path) -> np.ndarray:
    """An image file as an array of shape (height, width, 3), uint8, BGR. Raises InputError if it is no image."""
    return _native.read_image(os.fspath(path))
