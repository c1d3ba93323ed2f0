"""Learns a correction of commands and applies it to a desired motion.

    python3 learn_and_correct.py [POSES.csv]      without a table: poses of an arm with a known error
"""
import sys

import numpy as np

import capstan


def sample_poses(trajectories=12, rows=60):
    """Columns of observed and commanded poses: commands are 5 mm beside the observations, and off by up to 3 mm by
    a smooth function of the position."""
    random = np.random.default_rng(1)
    t = 0.01 * np.arange(rows)
    table = {"traj": np.repeat(np.arange(trajectories), rows)}
    swing = [np.sin(random.uniform(2, 4, 3) * t[:, None] + random.uniform(0, 6.28, 3)) for _ in range(trajectories)]
    observed = np.concatenate([random.uniform(-0.03, 0.03, 3) + 0.015 * one for one in swing])
    commanded = observed + [0.005, 0.0, 0.0]
    commanded[:, 1] += 0.003 * np.sin(40 * observed[:, 0])
    observed = observed + 2e-5 * random.standard_normal(observed.shape)
    stamps = np.concatenate([5.0 * trajectory + t for trajectory in range(trajectories)])
    for name, positions in (("cam", observed), ("cmd", commanded)):
        table[f"t_{name}_s"] = stamps
        for axis, letter in enumerate("xyz"):
            table[f"{name}_{letter}"] = positions[:, axis]
            table[f"{name}_q{letter}"] = np.zeros(len(stamps))
        table[f"{name}_qw"] = np.ones(len(stamps))
    return table


def main(poses):
    # Small and fast; with the defaults, learning of a large table takes a minute or two.
    learned = capstan.learn(poses, method="none", members=1, inducing=200, weights=False, hold_out=20)
    errors = learned.report["held_out"]["clean"]
    for step in ("none", "offset", "corrected"):
        print(f"{step:10} mean error {1e3 * errors[step]['distance']['mean']:.3f} mm on held-out trajectories")
    learned.model.save("arm.correction")  # also for capstan-cli correct
    desired = {"x": [0.0, 0.005], "y": [0.0, 0.0], "z": [0.0, 0.0],
               "qx": [0.0, 0.0], "qy": [0.0, 0.0], "qz": [0.0, 0.0], "qw": [1.0, 1.0]}
    commands = capstan.correct("arm.correction", desired)
    for position, confidence in zip(commands["position"], commands["confidence"]):
        print("command", np.round(1e3 * position, 3), f"mm, confidence {confidence:.2f}")


if __name__ == "__main__":
    try:
        main(sys.argv[1] if len(sys.argv) > 1 else sample_poses())
    except capstan.InputError as error:
        sys.exit(str(error))
