"""Identifies the constants of a robot from a recording, and tracks the recording again with them.

    python3 identify_robot.py RECORDING ROBOT.yaml
"""
import sys

import capstan


def main(recording, robot_file):
    found = capstan.identify(recording, progress=lambda share, doing: print(f"\r{100 * share:3.0f} %", end="",
                                                                            file=sys.stderr))
    print(file=sys.stderr)
    for parameter in found.parameters:
        state = f"± {parameter.sigma:.2g}" if parameter.seen else "not observable in this motion"
        print(f"{parameter.name:6} {parameter.value:12.6g} {state}")
    found.save_robot(robot_file)
    for name, robot in (("nominal", None), ("identified", robot_file)):
        rms = capstan.track(recording, estimator_robot=robot, estimates=False).rms["ukf"]
        print(f"UKF with the {name} robot: {rms[0]:.3g} rad, {rms[1]:.3g} rad, {rms[2]:.3g} m")


if __name__ == "__main__":
    if len(sys.argv) != 3:
        sys.exit(__doc__)
    try:
        main(*sys.argv[1:])
    except capstan.InputError as error:
        sys.exit(str(error))
