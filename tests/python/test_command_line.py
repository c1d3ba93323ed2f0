"""The package gives the numbers of the command line, to the last bit."""

import glob
import os
import tempfile
import unittest

import numpy as np
from support import JAW, ROBOT, bytes_of, cli, columns_of, data, without_times

import capstan


class CommandLine(unittest.TestCase):
    maxDiff = 2000

    def test_track_gives_the_same_document(self):
        for recording in (data("images.capstan"), data("tips.capstan"), data("tips.csv")):
            self.assertEqual(capstan.track(recording).report, cli("track", recording), recording)

    def test_track_takes_the_same_options(self):
        recording = data("images.capstan")
        tracked = capstan.track(recording, estimator_robot=ROBOT, register="kinematics", occlude=40,
                                fail_motor=["2@1.5:lost"], whole_frame=True)
        self.assertEqual(tracked.report, cli("track", recording, "--estimator-robot", ROBOT, "--register", "kinematics",
                                             "--occlude", 40, "--fail-motor", "2@1.5:lost", "--whole-frame"))
        self.assertIn("registered against kinematics", tracked.registration)

    def test_estimates_are_those_of_the_file(self):
        with tempfile.TemporaryDirectory() as folder:
            file = os.path.join(folder, "estimates.csv")
            cli("track", data("images.capstan"), "--out", file)
            rows = np.genfromtxt(file, delimiter=",", names=True, dtype=None, encoding="utf-8")
        estimates = capstan.track(data("images.capstan")).estimates
        for name in ("t", "t_cam", "nis"):
            np.testing.assert_array_equal(estimates[name], rows[name], name)
        np.testing.assert_array_equal(estimates["camera"], rows["camera"] == 1)
        for name in ("q_kin", "q_cam", "q_ukf", "dq_ukf", "sigma_ukf", "q"):
            for joint in range(3):
                np.testing.assert_array_equal(estimates[name][:, joint], rows[f"{name}{joint + 1}"], name)
        words = [capstan.GATES[code].replace("_", " ") for code in estimates["gate"]]
        self.assertEqual(words, list(rows["gate"]))

    def test_identify_gives_the_same_document_and_files(self):
        with tempfile.TemporaryDirectory() as folder:
            robot, trace, tracking = (os.path.join(folder, name) for name in ("robot.yaml", "trace.csv", "options.yaml"))
            document = cli("identify", data("sinusoid.capstan"), "--parameters", "r_l,k_e", "--out", robot, "--trace",
                           trace, "--tracking-out", tracking)
            found = capstan.identify(data("sinusoid.capstan"), parameters="r_l,k_e")
            self.assertEqual(found.report, document)
            self.assertEqual(found.robot.encode(), bytes_of(robot))
            self.assertEqual(found.tracking.encode(), bytes_of(tracking))
            columns = columns_of(trace)
        for i, name in enumerate(found.trace["names"]):
            np.testing.assert_array_equal(found.trace["value"][:, i], columns[name])
            np.testing.assert_array_equal(found.trace["sigma"][:, i], columns["sigma_" + name])
        radius = found.parameters[0]
        self.assertEqual((radius.name, radius.seen), ("r_l1", True))
        self.assertEqual(radius.value, document[document["result"].replace("-", "_")]["parameters"][0]["value"])

    def test_identify_of_a_robot_of_one_joint(self):
        training, held_out = [data("jaw_a.csv"), data("jaw_b.csv")], data("jaw_c.csv")
        with tempfile.TemporaryDirectory() as folder:
            robot = os.path.join(folder, "robot.yaml")
            document = cli("identify", *training, "--held-out", held_out, "--robot", JAW, "--parameters", "r_l,k_c,f_c",
                           "--offsets", "shared", "--out", robot)
            options = {"parameters": "r_l,k_c,f_c", "offsets": "shared"}
            found = capstan.identify(training, JAW, held_out=held_out, **options)
            for report in (found.report, document):
                report["drive"].pop("seconds")  # computing time
            self.assertEqual(found.report, document)
            self.assertEqual(found.robot.encode(), bytes_of(robot))
        self.assertEqual([parameter.name for parameter in found.parameters][:2], ["r_l", "k_c"])
        arrays = capstan.identify([columns_of(table) for table in training], JAW, held_out=columns_of(held_out), **options)
        self.assertEqual(arrays.report["drive"]["parameters"], document["drive"]["parameters"])

    def test_diagnose_gives_the_same_document_and_robot(self):
        with tempfile.TemporaryDirectory() as folder:
            robot = os.path.join(folder, "robot.yaml")
            document = cli("diagnose", data("sinusoid.csv"), "--robot", ROBOT, "--only", "pulley_radius", "--no-filter",
                           "--out", robot)
            found = capstan.diagnose(data("sinusoid.csv"), ROBOT, only=["pulley_radius"], filter=False)
            self.assertEqual(without_times(found.report), without_times(document))
            self.assertEqual(found.robot.encode(), bytes_of(robot))
        self.assertEqual(found.verdict, "found")
        self.assertEqual((found.causes[0]["effect"], found.causes[0]["joint"]), ("pulley_radius", 1))

    def test_learn_gives_the_same_document_and_model(self):
        options = {"method": "none", "members": 1, "inducing": 100, "weights": False}
        with tempfile.TemporaryDirectory() as folder:
            theirs, ours = (os.path.join(folder, name) for name in ("theirs.correction", "ours.correction"))
            document = cli("learn", "--train", data("train_poses.csv"), "--test", data("test_poses.csv"), "--hold-out", 20,
                           "--method", "none", "--members", 1, "--inducing", 100, "--no-weights", "--model", theirs)
            learned = capstan.learn(data("train_poses.csv"), test=data("test_poses.csv"), hold_out=20, **options)
            self.assertEqual(learned.report, document)
            learned.model.save(ours)
            self.assertEqual(bytes_of(ours), bytes_of(theirs))

    def test_detect_gives_the_same_document(self):
        left, right = (sorted(glob.glob(os.path.join(data("frames"), f"*{side}*.png")))[:5] for side in ("left", "right"))
        self.assertEqual(len(left), 5)
        for search in ("frame", "region"):
            document = cli("detect", *left, "--right", *right, "--search", search)
            detector = capstan.Detector()
            for row, one, other in zip(document["rows"], left, right):
                for side, found in zip(("left", "right"), detector.detect_pair(one, other, search=search)):
                    self.assertTrue(found.found)
                    for key, value in row[side].items():
                        self.assertEqual(getattr(found, key), value)
        self.assertEqual(capstan.detect(left[0]), capstan.detect(capstan.read_image(left[0])))

    def test_register_gives_the_same_document_and_file(self):
        with tempfile.TemporaryDirectory() as folder:
            theirs, ours = (os.path.join(folder, name) for name in ("theirs.yaml", "ours.yaml"))
            document = cli("register", data("pairs.csv"), "--out", theirs)
            found = capstan.register(data("pairs.csv"))
            self.assertEqual(found.report, document)
            found.save(ours)
            self.assertEqual(bytes_of(ours), bytes_of(theirs))
        self.assertEqual(found.rejected, [7])
        self.assertEqual(found.covariance.shape, (6, 6))


if __name__ == "__main__":
    unittest.main()
