"""What the tests of the Python package share: data, the command line, comparisons."""

import json
import os
import subprocess

import numpy as np

CLI = os.environ["CAPSTAN_CLI"]
DATA = os.environ["CAPSTAN_PYTHON_DATA"]
ROBOT = os.path.join(os.environ["CAPSTAN_RESOURCES"], "robots", "raven2_left.yaml")
JAW = os.path.join(os.path.dirname(__file__), "..", "core", "identification", "data", "davinci_jaw.yaml")
EXAMPLES = os.path.join(os.environ["CAPSTAN_RESOURCES"], "manual", "python")


def data(name):
    """A file that data.py made."""
    return os.path.join(DATA, name)


def cli(*arguments):
    """Runs the command line. Returns its document of --json."""
    ran = subprocess.run([CLI, *map(str, arguments), "--json", "-"], capture_output=True, text=True)
    if ran.returncode != 0:
        raise AssertionError(f"exit code {ran.returncode}: {ran.stderr}")
    return json.loads(ran.stdout)


def columns_of(table):
    """The columns of a CSV of numbers as a dict of arrays."""
    rows = np.genfromtxt(table, delimiter=",", names=True)
    return {name: np.ascontiguousarray(rows[name]) for name in rows.dtype.names}


def without_times(report):
    """A report of diagnose() without the durations of its stages."""
    return {key: value for key, value in report.items() if key != "stages"}


def bytes_of(path):
    with open(path, "rb") as file:
        return file.read()
