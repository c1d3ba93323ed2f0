#!/usr/bin/env python3
"""Prints what a call from Python costs beside the work that it does.

    PYTHONPATH=build/release/python tests/benchmarks/python_overhead.py [SESSION.capstan]

SESSION: a session with images; default: one of 3 s is simulated by capstan-cli of the PATH or the variable CAPSTAN_CLI.
"""
import os
import statistics
import subprocess
import sys
import tempfile
import time

import numpy as np

import capstan

CLI = os.environ.get("CAPSTAN_CLI", "capstan-cli")


def seconds_of(call, rounds=9, calls=200):
    """Median over rounds of the mean duration of a call."""
    def round_():
        began = time.perf_counter()
        for _ in range(calls):
            call()
        return (time.perf_counter() - began) / calls

    round_()
    return statistics.median(round_() for _ in range(rounds))


def line(words, seconds, beside=None):
    ratio = "" if beside is None else f"   {100 * seconds / beside:6.2f} %"
    print(f"{words:62} {1e6 * seconds:10.1f} us{ratio}")


def detection(session):
    image = session.frames[0][0]
    detector = capstan.Detector()
    dot = np.zeros((1, 1, 3), np.uint8)
    whole = seconds_of(lambda: detector.detect(image))
    line(f"detect an image of {image.shape[1]} x {image.shape[0]}, whole search", whole, whole)
    line("  the same call without an image to search (the overhead)", seconds_of(lambda: detector.detect(dot)), whole)
    line("  a copy of the image, which is not made", seconds_of(image.copy), whole)
    line("capstan.detect, with a new detector", seconds_of(lambda: capstan.detect(image)), whole)
    line("decode a pair of images of the session", seconds_of(lambda: session.frames[5], calls=20))


def tracking(path):
    table = {"t": 0.001 * np.arange(2), "q_m": np.zeros((2, 3))}
    session = min(seconds_of(lambda: capstan.track(path), 3, 1) for _ in range(2))
    line("track the session", session, session)
    line("  without the columns of estimates", seconds_of(lambda: capstan.track(path, estimates=False), 3, 1), session)
    line("  the command line, with the start of its process",
         seconds_of(lambda: subprocess.run([CLI, "track", path], stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL,
                                           check=True), 3, 1), session)
    line("track two rows of arrays (set-up of pipeline and thread)", seconds_of(lambda: capstan.track(table), calls=20))


def main():
    with tempfile.TemporaryDirectory() as folder:
        path = sys.argv[1] if len(sys.argv) > 1 else os.path.join(folder, "session.capstan")
        if len(sys.argv) < 2:
            subprocess.run([CLI, "simulate", "--out", path, "--duration", "3"], check=True, stdout=subprocess.DEVNULL)
        detection(capstan.open(path))
        tracking(path)


if __name__ == "__main__":
    main()
