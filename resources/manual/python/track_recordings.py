"""Tracks recordings and prints the errors of kinematics, cameras and filter.

    python3 track_recordings.py RECORDING…
"""
import sys

import numpy as np

import capstan


def main(recordings):
    print(f"{'recording':24} {'joint':>5} {'kinematics':>11} {'camera':>9} {'UKF':>9}")
    for recording in recordings:
        tracked = capstan.track(recording)
        rms = tracked.rms  # rad, rad, m
        for joint in range(3):
            scale, unit = (np.degrees(1.0), "deg") if joint < 2 else (1e3, "mm")
            kin, cam, ukf = (scale * rms[source][joint] for source in ("kin", "cam", "ukf"))
            print(f"{tracked.report['title'][:24]:24} {joint + 1:5} {kin:11.4f} {cam:9.4f} {ukf:9.4f} {unit}")
        rows = tracked.estimates
        used = np.mean(rows["gate"][rows["camera"]] == capstan.GATES.index("camera"))
        print(f"{len(rows['t'])} rows, {100 * used:.1f} % of the camera samples used, NIS: {tracked.nis_verdict}")


if __name__ == "__main__":
    if len(sys.argv) < 2:
        sys.exit(__doc__)
    try:
        main(sys.argv[1:])
    except capstan.InputError as error:
        sys.exit(str(error))  # names file, line, value and remedy
