"""Arrays as input give what the file with the same numbers gives; images are not copied."""

import os
import subprocess
import tempfile
import unittest

import numpy as np
from support import CLI, ROBOT, columns_of, data, without_times

import capstan


def without_title(report):
    return {key: value for key, value in report.items() if key != "title"}


class Arrays(unittest.TestCase):
    def test_track(self):
        columns = columns_of(data("tips.csv"))
        of_file, of_arrays = capstan.track(data("tips.csv")), capstan.track(columns)
        self.assertEqual(without_title(of_arrays.report), without_title(of_file.report))
        for name, values in of_file.estimates.items():
            np.testing.assert_array_equal(of_arrays.estimates[name], values)

    def test_forms_of_a_table(self):
        columns = columns_of(data("tips.csv"))
        joints = {name: np.stack([columns[f"{name}{i}"] for i in (1, 2, 3)], axis=1) for name in ("q_m", "q", "p_c")}
        grouped = {name: column for name, column in columns.items() if name.rstrip("123") not in joints} | joints
        structured = np.rec.fromarrays(list(columns.values()), names=list(columns))
        expected = without_title(capstan.track(columns, estimates=False).report)
        self.assertEqual(without_title(capstan.track(grouped, estimates=False).report), expected)
        self.assertEqual(without_title(capstan.track(structured, estimates=False).report), expected)

    def test_data_frame(self):
        try:
            import pandas
        except ImportError:
            self.skipTest("pandas is not installed")
        frame = pandas.read_csv(data("tips.csv"), float_precision="round_trip")
        expected = without_title(capstan.track(data("tips.csv"), estimates=False).report)
        self.assertEqual(without_title(capstan.track(frame, estimates=False).report), expected)

    def test_units(self):
        columns = columns_of(data("tips.csv"))
        degrees = {name: np.degrees(column) if name.startswith("q_m") else column for name, column in columns.items()}
        with self.assertRaisesRegex(capstan.InputError, "read_as"):
            capstan.track(degrees)
        rms = capstan.track(degrees, read_as={"q_m": "deg"}, estimates=False).rms["ukf"]
        np.testing.assert_allclose(rms, capstan.track(columns, estimates=False).rms["ukf"], rtol=1e-6)

    def test_identify(self):
        of_file = capstan.identify(data("sinusoid.csv"), ROBOT, method="dual-ukf", parameters="r_l1")
        of_arrays = capstan.identify(columns_of(data("sinusoid.csv")), ROBOT, method="dual-ukf", parameters="r_l1")
        self.assertEqual(of_arrays.report, of_file.report)

    def test_diagnose(self):
        options = {"only": ["pulley_radius"], "filter": False}
        of_file = capstan.diagnose(data("sinusoid.csv"), ROBOT, **options)
        of_arrays = capstan.diagnose(columns_of(data("sinusoid.csv")), ROBOT, **options)
        reports = [without_times(found.report) for found in (of_arrays, of_file)]
        self.assertEqual([report.pop("recordings") for report in reports], [["arrays"], ["sinusoid.csv"]])
        self.assertEqual(*reports)

    def test_learn_and_correct(self):
        options = {"method": "none", "members": 1, "inducing": 100, "weights": False}
        of_file = capstan.learn(data("poses.csv"), **options)
        of_arrays = capstan.learn(columns_of(data("poses.csv")), **options)
        self.assertEqual(of_arrays.report, of_file.report)
        self.assertEqual(of_arrays.model.source["files"], ["arrays"])
        desired = columns_of(data("desired.csv"))
        for mode in ("poses", "path", "end_point"):
            expected = of_file.model.correct(data("desired.csv"), mode=mode)
            found = of_arrays.model.correct(desired, mode=mode)
            for name, values in expected.items():
                np.testing.assert_array_equal(found[name], values)
        with tempfile.TemporaryDirectory() as folder:
            model, commands = os.path.join(folder, "arm.correction"), os.path.join(folder, "commands.csv")
            of_file.model.save(model)
            subprocess.run([CLI, "correct", "--model", model, data("desired.csv"), commands], check=True,
                           stdout=subprocess.DEVNULL)
            table = columns_of(commands)  # nine digits
        positions = capstan.correct(of_file.model, desired)["position"]
        for axis, name in enumerate("xyz"):
            np.testing.assert_allclose(positions[:, axis], table[name], rtol=1e-8, atol=1e-12)

    def test_register(self):
        self.assertEqual(capstan.register(columns_of(data("pairs.csv"))).report, capstan.register(data("pairs.csv")).report)

    def test_images_are_not_copied(self):
        left, right = capstan.open(data("images.capstan")).frames[0]
        self.assertFalse(left.flags.owndata)  # the decoder's memory
        padded = np.zeros((left.shape[0], left.shape[1] + 8, 3), np.uint8)
        padded[:, : left.shape[1]] = left
        for image in (padded[:, : left.shape[1]], left[:, ::-1][:, ::-1], np.asfortranarray(left)):
            self.assertEqual(capstan.detect(image), capstan.detect(left))
        self.assertTrue(capstan.detect(right).found)


if __name__ == "__main__":
    unittest.main()
