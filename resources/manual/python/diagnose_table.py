"""Diagnoses a measured table from arrays: which physical effects the robot model lacks.

    python3 diagnose_table.py TABLE.csv ROBOT.yaml [EFFECT…]
"""
import sys

import numpy as np

import capstan


def main(table, robot, effects):
    columns = np.genfromtxt(table, delimiter=",", names=True)  # or a dict of your own arrays
    result = capstan.diagnose(columns, robot, only=effects)
    print(f"{result.verdict}: {result.summary}")
    for cause in result.causes:
        numbers = ", ".join(f"{name} {value['value']:.4g} ± {value['sigma']:.2g} {value['unit']}"
                            for name, value in cause["parameters"].items())
        print(f"joint {cause['joint']}: {cause['effect']} ({numbers}), probability {cause['probability']:.3f}")
    for channel in result.report["channels"]:
        before, after = channel["refitted"]["rms"], channel["extended"]["rms"]
        print(f"{channel['name']:8} RMS residual {before:.3g} -> {after:.3g} {channel['unit']}")


if __name__ == "__main__":
    if len(sys.argv) < 3:
        sys.exit(__doc__)
    try:
        main(sys.argv[1], sys.argv[2], sys.argv[3:])
    except capstan.InputError as error:
        sys.exit(str(error))
