"""Makes the data of the tests with the command line, into the folder of the variable CAPSTAN_PYTHON_DATA."""

import os
import shutil
import subprocess
import sys

import numpy as np

from support import CLI, DATA, EXAMPLES, data


def run(*arguments):
    subprocess.run([CLI, *arguments], check=True, stdout=subprocess.DEVNULL)


def simulate(name, *more):
    run("simulate", "--out", data(name), *more)


def write_table(name, columns):
    np.savetxt(data(name), np.column_stack(list(columns.values())), delimiter=",", header=",".join(columns), comments="",
               fmt="%.17g")


def write_poses():
    sys.path.insert(0, EXAMPLES)
    import learn_and_correct

    poses = learn_and_correct.sample_poses()
    write_table("poses.csv", poses)
    write_table("test_poses.csv", {name: column[poses["traj"] > 8] for name, column in poses.items()})
    write_table("train_poses.csv", {name: column[poses["traj"] <= 8] for name, column in poses.items()})
    path = poses["traj"] == 2
    write_table("desired.csv", {"traj": poses["traj"][path], "t_s": poses["t_cam_s"][path],
                                **{part: poses["cam_" + part][path] for part in ("x", "y", "z", "qx", "qy", "qz", "qw")}})


def write_pairs():
    random = np.random.default_rng(5)
    camera = random.uniform(-0.05, 0.05, (30, 3)) + [0.0, 0.0, 0.3]
    angle = 0.4
    rotation = np.array([[np.cos(angle), -np.sin(angle), 0.0], [np.sin(angle), np.cos(angle), 0.0], [0.0, 0.0, 1.0]])
    base = camera @ rotation.T + [0.1, -0.2, 0.05] + 2e-4 * random.standard_normal((30, 3))
    base[7] += 0.03  # an outlier
    columns = {name: base[:, i] for i, name in enumerate("xyz")}
    columns.update({"cam_" + name: camera[:, i] for i, name in enumerate("xyz")})
    write_table("pairs.csv", columns)


def write_jaw(name, load, frequency):
    """A jaw with a linear spring of 2 N·m/rad at the spindle, a gear of 0.9 and friction at the joint."""
    gear, stiffness, friction, motor = 0.9, 2.0, 0.03, 0.02
    t = 0.01 * np.arange(600)
    motors = 0.5 - 0.5 * np.cos(2 * np.pi * frequency * t)
    joints, joint = np.zeros(len(t)), 0.0
    for row, position in enumerate(motors):
        low, high = (gear * (torque * gear / stiffness - position) for torque in (-load - friction, -load + friction))
        joint = joints[row] = np.clip(joint, low, high)
    speed = np.pi * frequency * np.sin(2 * np.pi * frequency * t)
    torque = stiffness * (motors + joints / gear) + motor * np.tanh(speed / 0.02)
    write_table(name, {"t": t, "q_m1": motors, "tau_m1": torque, "q1": 1.2 + joints, "tau_ext1": np.full(len(t), -load)})


def main():
    shutil.rmtree(DATA, ignore_errors=True)
    os.makedirs(DATA)
    simulate("images.capstan", "--duration", "3", "--seed", "7")
    run("convert", data("images.capstan"), data("frames"), "--to", "png")
    simulate("tips.capstan", "--duration", "12", "--seed", "3", "--no-images")
    run("convert", data("tips.capstan"), data("tips.csv"))
    simulate("sinusoid.capstan", "--trajectory", "sinusoid", "--duration", "6", "--seed", "3", "--no-images")
    run("convert", data("sinusoid.capstan"), data("sinusoid.csv"))
    write_poses()
    write_pairs()
    write_jaw("jaw_a.csv", 0.0, 0.3)
    write_jaw("jaw_b.csv", 0.1, 0.6)
    write_jaw("jaw_c.csv", 0.05, 0.4)


if __name__ == "__main__":
    main()
