"""Joint angles of cable-driven surgical robots from motors and cameras.

The functions compute what the commands of ``capstan-cli`` of the same names compute, by the same code: the
attribute ``report`` of each result equals the document of ``capstan-cli … --json`` in every number. All numbers
are in SI units: rad, m, s, N. Joints count from 1 in names and from 0 in arrays.

Recordings and tables are given as the path of a file, or as columns in memory: a dict, a structured NumPy array or a
pandas DataFrame with the column names of the file. A two-dimensional entry ``q_m`` of shape (n, 3) stands for
the columns ``q_m1``, ``q_m2``, ``q_m3``. NaN marks a missing value.

A wrong file or argument raises :class:`InputError`, which has the place, the value and the remedy. Ctrl-C ends
long work within a second. Remarks on the data are in the attribute ``notices`` of the result, and are warnings
of the category :class:`Notice`.
"""

from ._errors import InputError, Notice
from ._native import software, version as __version__
from .correction import Correction, correct
from .detection import Detection, Detector, detect, read_image
from .diagnosis import Diagnosis, diagnose
from .identification import Identification, Parameter, identify
from .kinematics import tip_positions
from .learning import Learning, learn
from .registration import Registration, register
from .session import Session, open
from .tracking import GATES, Tracking, track

__all__ = [
    "GATES",
    "Correction",
    "Detection",
    "Detector",
    "Diagnosis",
    "Identification",
    "InputError",
    "Learning",
    "Notice",
    "Parameter",
    "Registration",
    "Session",
    "Tracking",
    "correct",
    "detect",
    "diagnose",
    "identify",
    "learn",
    "open",
    "read_image",
    "register",
    "software",
    "tip_positions",
    "track",
]
