"""Detects the marker in the images of a session and registers the cameras from its positions.

    python3 detect_and_register.py SESSION.capstan CAMERAS REGISTRATION.yaml

CAMERAS: folder for the calibrations left.yaml and right.yaml. They are taken from the session.
"""
import os
import sys

import numpy as np

import capstan


def main(path, cameras, registration_file):
    session = capstan.open(path)
    os.makedirs(cameras, exist_ok=True)
    for side in ("left", "right"):
        with open(os.path.join(cameras, side + ".yaml"), "w") as file:
            file.write(getattr(session, "camera_" + side))

    detector = capstan.Detector()  # the green ball of the simulation; a marker file for your own
    pairs = [detector.detect_pair(left, right, search="region") for left, right in session.frames]
    joints = np.stack([np.interp(session.frames.t, session.joints["t"], session.joints["position"][:, joint])
                       for joint in range(3)], axis=1)
    tips = capstan.tip_positions(joints)

    table = {name: tips[:, axis] for axis, name in enumerate("xyz")}
    for side in range(2):
        name = ("left", "right")[side]
        table[name + "_u"] = [pair[side].u for pair in pairs]  # NaN where there is no marker
        table[name + "_v"] = [pair[side].v for pair in pairs]
    found = capstan.register(table, cameras=cameras)
    print(f"{sum(left.found and right.found for left, right in pairs)} of {len(pairs)} pairs detected, "
          f"{found.report['used']} used, RMS {1e3 * found.rms:.3f} mm")
    print("cameras at", np.round(1e3 * found.base_from_camera[:3, 3], 2), "mm in frame 0")
    if session.base_from_camera is not None:
        seen = np.linalg.inv(found.base_from_camera) @ np.c_[tips, np.ones(len(tips))].T  # in the camera's frame
        shift = (session.base_from_camera @ seen)[:3].T - tips
        print(f"{1e3 * np.linalg.norm(shift, axis=1).max():.2f} mm from the stored registration at the tip, or less")
    found.save(registration_file)
    rms = capstan.track(session, register=registration_file, estimates=False).rms["ukf"]
    print(f"UKF with it: {rms[0]:.3g} rad, {rms[1]:.3g} rad, {rms[2]:.3g} m")


if __name__ == "__main__":
    if len(sys.argv) != 4:
        sys.exit(__doc__)
    try:
        main(*sys.argv[1:])
    except capstan.InputError as error:
        sys.exit(str(error))
