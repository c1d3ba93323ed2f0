"""Tracks measured tables with the command line and reads estimates and errors into pandas.

    python3 track.py ROBOT.yaml TABLE.csv…
"""
import json
import os
import subprocess
import sys
import tempfile

import pandas as pd

CLI = os.environ.get("CAPSTAN_CLI", "capstan-cli")


def track(table, robot):
    """Returns estimates as a DataFrame indexed by time [s], and the report of `capstan-cli track --json`."""
    with tempfile.TemporaryDirectory() as folder:
        estimates = os.path.join(folder, "estimates.csv")
        done = subprocess.run(
            [CLI, "track", table, "--robot", robot, "--out", estimates, "--json", "-"],
            capture_output=True, text=True)
        if done.returncode != 0:
            raise ValueError(done.stderr.strip())  # names file, line, value and remedy
        return pd.read_csv(estimates).set_index("t"), json.loads(done.stdout)


def main(robot, tables):
    rows = []
    for table in tables:
        estimates, report = track(table, robot)
        rms = report["rms"]  # rad, rad, m
        rows += [{"table": os.path.basename(table), "joint": j + 1, "kinematics": rms["kin"][j],
                  "camera": rms["cam"][j], "UKF": rms["ukf"][j]} for j in range(3)]
        print(f"{table}: {len(estimates)} rows", file=sys.stderr)
    print(pd.DataFrame(rows).to_csv(index=False), end="")


if __name__ == "__main__":
    if len(sys.argv) < 3:
        sys.exit(__doc__)
    try:
        main(sys.argv[1], sys.argv[2:])
    except ValueError as error:
        sys.exit(str(error))
