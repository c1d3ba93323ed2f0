"""Errors are exceptions with place, value and remedy."""

import os
import pickle
import tempfile
import unittest
import warnings

import numpy as np
from support import ROBOT, columns_of, data

import capstan


class Errors(unittest.TestCase):
    def refused(self, function, *arguments, **options):
        with self.assertRaises(capstan.InputError) as caught:
            function(*arguments, **options)
        return caught.exception

    def test_a_cell_has_file_line_column_value_and_remedy(self):
        with tempfile.TemporaryDirectory() as folder:
            table = os.path.join(folder, "table.csv")
            with open(table, "w") as file:
                file.write("t,q_m1,q_m2,q_m3\n0,0,0,0\n0.001,0,nan,0\n")
            error = self.refused(capstan.track, table)
            self.assertEqual((error.file, error.line, error.key, error.value), (table, 3, "q_m2", "nan"))
            self.assertTrue(error.remedy)
            self.assertIn(f"{table}:3: q_m2 = nan", str(error))
            self.assertIsInstance(error, ValueError)
            copy = pickle.loads(pickle.dumps(error))
            self.assertEqual((str(copy), copy.line, copy.remedy), (str(error), 3, error.remedy))

    def test_a_missing_file(self):
        for function in (capstan.track, capstan.identify, capstan.diagnose, capstan.learn, capstan.detect,
                         capstan.register, capstan.open, capstan.Correction):
            error = self.refused(function, "no/such/file.capstan")
            self.assertEqual(error.file, "no/such/file.capstan", function)

    def test_arrays(self):
        t = 0.001 * np.arange(4)
        joints = np.zeros((4, 3))
        infinite = joints.copy()
        infinite[2, 1] = np.inf
        error = self.refused(capstan.track, {"t": t, "q_m": infinite})
        self.assertEqual((error.file, error.line, error.key, error.value), ("arrays", None, "q_m2, row 3", "inf"))
        error = self.refused(capstan.track, {"t": t[:3], "q_m": joints})
        self.assertEqual((error.key, error.value), ("q_m1", "4 rows"))
        error = self.refused(capstan.track, {"t": t[::-1], "q_m": joints})
        self.assertEqual(error.key, "t, row 2")
        self.assertIn("Sort the rows", error.remedy)
        self.assertEqual(self.refused(capstan.track, {"q_m": joints}).key, "t")
        self.assertEqual(self.refused(capstan.track, {"t": [], "q_m": np.zeros((0, 3))}).reason, "has no rows")
        self.assertEqual(self.refused(capstan.track, {"t": t, "q_m": ["a"] * 4}).key, "q_m")
        self.assertEqual(self.refused(capstan.track, np.zeros((4, 4))).key, "arrays")
        self.assertIn("dict", self.refused(capstan.track, 5).remedy)

    def test_the_same_arrays_twice(self):
        columns = columns_of(data("sinusoid.csv"))
        for function in (capstan.identify, capstan.diagnose):
            self.assertIn("count twice", str(self.refused(function, [columns, dict(columns)], ROBOT)))
        self.assertIn("no test", str(self.refused(capstan.learn, data("poses.csv"), test=data("poses.csv"))))
        self.assertIn("together", str(self.refused(capstan.diagnose, [columns, data("tips.csv")], ROBOT)))

    def test_options_have_their_python_names(self):
        error = self.refused(capstan.track, data("tips.csv"), read_as="q_m=furlong")
        self.assertEqual(error.key, "read_as")
        self.assertNotIn("--", str(error))
        error = self.refused(capstan.track, data("tips.capstan"), ROBOT)
        self.assertEqual((error.key, error.value), ("robot", ROBOT))
        self.assertIn("estimator_robot", error.remedy)
        error = self.refused(capstan.identify, data("sinusoid.capstan"), parameters="r_l9")
        self.assertEqual(error.key, "parameters")

    def test_arguments(self):
        for function, options in ((capstan.identify, {"method": "best"}), (capstan.identify, {"threads": 0}),
                                  (capstan.diagnose, {"zeros": "none"}), (capstan.diagnose, {"effort": 0}),
                                  (capstan.learn, {"kernel": "linear"}), (capstan.learn, {"hold_out": 99}),
                                  (capstan.track, {"occlude": 96}), (capstan.track, {"failed_motor": [4]}),
                                  (capstan.track, {"fail_motor": ["9@1"]})):
            error = self.refused(function, data("tips.csv"), **options)
            self.assertEqual(error.key, next(iter(options)))
            self.assertTrue(error.remedy)

    def test_images(self):
        error = self.refused(capstan.detect, np.zeros((4, 4)))
        self.assertEqual(error.key, "left")
        self.assertIn("uint8", error.remedy)
        with tempfile.TemporaryDirectory() as folder:
            self.assertFalse(capstan.detect(np.zeros((40, 40, 3), np.uint8)).found)
            image = os.path.join(folder, "image.png")
            with open(image, "w") as file:
                file.write("no image")
            self.assertEqual(self.refused(capstan.detect, image).file, image)

    def test_notices_are_warnings(self):
        columns = columns_of(data("tips.csv"))
        with warnings.catch_warnings(record=True) as caught:
            warnings.simplefilter("always")
            tracked = capstan.track(columns | {"temperature": np.zeros(len(columns["t"]))}, estimates=False)
        self.assertEqual([str(one.message) for one in caught], tracked.notices)
        self.assertTrue(issubclass(caught[0].category, capstan.Notice))
        self.assertIn("temperature", tracked.notices[0])
        self.assertEqual(os.path.basename(caught[0].filename), os.path.basename(__file__))


if __name__ == "__main__":
    unittest.main()
