"""The scripts of the manual run and print their results."""

import os
import subprocess
import sys
import tempfile
import unittest

from support import EXAMPLES, ROBOT, data


class Examples(unittest.TestCase):
    def run_example(self, name, *arguments):
        with tempfile.TemporaryDirectory() as folder:
            ran = subprocess.run([sys.executable, "-W", "error", os.path.join(EXAMPLES, name), *arguments], cwd=folder,
                                 capture_output=True, text=True)
            self.assertEqual(ran.returncode, 0, ran.stderr)
            return ran.stdout, os.listdir(folder)

    def test_track_recordings(self):
        text, _ = self.run_example("track_recordings.py", data("images.capstan"), data("tips.csv"))
        self.assertEqual(text.count("NIS"), 2)

    def test_identify_robot(self):
        text, files = self.run_example("identify_robot.py", data("sinusoid.capstan"), "robot.yaml")
        self.assertIn("r_l1", text)
        self.assertIn("robot.yaml", files)

    def test_diagnose_table(self):
        text, _ = self.run_example("diagnose_table.py", data("sinusoid.csv"), ROBOT, "pulley_radius")
        self.assertIn("joint 1: pulley_radius", text)

    def test_learn_and_correct(self):
        text, files = self.run_example("learn_and_correct.py")
        self.assertIn("corrected", text)
        self.assertIn("arm.correction", files)

    def test_detect_and_register(self):
        text, files = self.run_example("detect_and_register.py", data("images.capstan"), "cameras", "registration.yaml")
        self.assertIn("pairs detected", text)
        self.assertIn("registration.yaml", files)

    def test_a_wrong_file_is_reported_without_a_traceback(self):
        ran = subprocess.run([sys.executable, os.path.join(EXAMPLES, "track_recordings.py"), "none.csv"],
                             capture_output=True, text=True)
        self.assertEqual(ran.returncode, 1)
        self.assertTrue(ran.stderr.startswith("none.csv: does not exist"), ran.stderr)


if __name__ == "__main__":
    unittest.main()
