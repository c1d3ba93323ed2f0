#!/usr/bin/env python3
"""scikit-learn's GaussianProcessRegressor on what learning_study wrote into a folder: the same states, kernel and
hyperparameters. Prints one JSON object."""
import json
import pathlib
import sys
import time

import numpy as np
from sklearn.gaussian_process import GaussianProcessRegressor
from sklearn.gaussian_process.kernels import RBF, ConstantKernel, WhiteKernel


def kernel_of(packed):
    """ln sigma_f, ln sigma_n, ln lengths."""
    p = np.exp(packed)
    wide = (1e-8, 1e12)
    return ConstantKernel(p[0] ** 2, wide) * RBF(p[2:], wide) + WhiteKernel(p[1] ** 2, wide)


def table(path):
    return np.loadtxt(path, delimiter=",", ndmin=2)


def geodesic(a, b):
    """Angle between the turns of two lists of rotation vectors."""
    from scipy.spatial.transform import Rotation

    return (Rotation.from_rotvec(a).inv() * Rotation.from_rotvec(b)).magnitude()


def split_errors(folder):
    """Means of distance and angle on held-out states, all and clean; 12 features, 6 targets, clean."""
    train, test, scale = table(folder / "train.csv"), table(folder / "test.csv"), table(folder / "scale.csv")[0]
    parameters = table(folder / "parameters.csv")
    told = np.empty((len(test), 6))
    for k in range(6):
        process = GaussianProcessRegressor(kernel_of(parameters[k]), alpha=0.0, optimizer=None)
        process.fit(train[:, :12], train[:, 12 + k])
        told[:, k] = process.predict(test[:, :12])
    off, is_off = told * scale, test[:, 12:18] * scale
    distance = np.linalg.norm((off - is_off)[:, :3], axis=1)
    angle = geodesic(off[:, 3:], is_off[:, 3:])
    clean = test[:, 18] > 0
    return {
        "dirty": [distance.mean(), angle.mean()],
        "clean": [distance[clean].mean(), angle[clean].mean()],
    }


def likelihood(folder):
    """Seconds of one likelihood with gradient, the best of three, and its value."""
    data, start = table(folder / "train.csv"), table(folder / "start.csv")[0]
    process = GaussianProcessRegressor(kernel_of(start), alpha=0.0, optimizer=None)
    process.fit(data[:, :-1], data[:, -1])
    best, value = np.inf, 0.0
    for _ in range(3):
        begin = time.perf_counter()
        value, _ = process.log_marginal_likelihood(process.kernel_.theta, eval_gradient=True)
        best = min(best, time.perf_counter() - begin)
    return {"seconds": best, "value": -value}


def training(folder):
    """Seconds to the most likely hyperparameters, and there the likelihood and predictions."""
    data, start, at = table(folder / "train.csv"), table(folder / "start.csv")[0], table(folder / "at.csv")
    begin = time.perf_counter()
    process = GaussianProcessRegressor(kernel_of(start), alpha=0.0)
    process.fit(data[:, :-1], data[:, -1])
    seconds = time.perf_counter() - begin
    theirs = -process.log_marginal_likelihood_value_
    fixed = GaussianProcessRegressor(kernel_of(table(folder / "found.csv")[0]), alpha=0.0, optimizer=None)
    fixed.fit(data[:, :-1], data[:, -1])
    mean, deviation = fixed.predict(at, return_std=True)
    noise = np.exp(2.0 * table(folder / "found.csv")[0][1])
    return {
        "seconds": seconds,
        "value": theirs,
        "mean": mean.tolist(),
        "variance": (deviation**2 - noise).tolist(),
    }


def main():
    folder = pathlib.Path(sys.argv[1])
    kinds = {"split": split_errors, "likelihood": likelihood, "training": training}
    answer = {}
    for one in sorted(path for path in folder.iterdir() if path.is_dir()):
        answer[one.name] = kinds[one.name.split("_")[0]](one)
    json.dump(answer, sys.stdout)


if __name__ == "__main__":
    main()
