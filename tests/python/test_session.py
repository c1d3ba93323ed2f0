"""A session file as arrays."""

import contextlib
import glob
import os
import shutil
import sqlite3
import tempfile
import unittest

import numpy as np
from support import cli, data

import capstan


class Session(unittest.TestCase):
    def setUp(self):
        self.session = capstan.open(data("images.capstan"))

    def test_header(self):
        info = cli("info", data("images.capstan"))
        for name in ("title", "created", "software", "first_t", "last_t", "reference", "width", "height"):
            self.assertEqual(getattr(self.session, name), info[name])
        self.assertIn("joints", self.session.robot)
        self.assertEqual(self.session.base_from_camera.shape, (4, 4))
        self.assertIn(self.session.title, repr(self.session))

    def test_columns_are_those_of_the_database(self):
        database = sqlite3.connect(data("images.capstan"))
        rows = np.array(database.execute("SELECT t, q_m1, q_m2, q_m3, tau_m1 FROM motor ORDER BY seq").fetchall(), float)
        np.testing.assert_array_equal(self.session.t, rows[:, 0])
        np.testing.assert_array_equal(self.session.motors["position"], rows[:, 1:4])
        np.testing.assert_array_equal(self.session.motors["torque"][:, 0], rows[:, 4])
        rows = np.array(database.execute("SELECT t, q1, q2, q3 FROM joint ORDER BY seq").fetchall(), float)
        np.testing.assert_array_equal(self.session.joints["t"], rows[:, 0])
        np.testing.assert_array_equal(self.session.joints["position"], rows[:, 1:])
        self.assertEqual(len(self.session.estimates["t"]), 0)
        self.assertEqual(self.session.tips["position"].shape, (0, 3))
        database.close()

    def test_images_are_those_of_the_converted_files(self):
        for side in (0, 1):
            files = sorted(glob.glob(os.path.join(data("frames"), f"*{('left', 'right')[side]}*.png")))
            self.assertEqual(len(files), len(self.session.frames))
            for index in (0, 11, -1):
                np.testing.assert_array_equal(self.session.frames[index][side], capstan.read_image(files[index]))
        self.assertEqual(len(list(self.session.frames)), len(self.session.frames))
        with self.assertRaises(IndexError):
            self.session.frames[10000]

    def test_a_changed_row_is_refused(self):
        with tempfile.TemporaryDirectory() as folder:
            copy = os.path.join(folder, "copy.capstan")
            shutil.copy(data("images.capstan"), copy)
            with contextlib.closing(sqlite3.connect(copy)) as database, database:
                for table, column in (("motor", "q_m2"), ("frame", "t")):
                    database.execute(f"UPDATE {table} SET {column} = {column} + 1e-9"
                                     f" WHERE seq = (SELECT seq FROM {table} ORDER BY seq LIMIT 1 OFFSET 5)")
            session = capstan.open(copy)
            for read in (lambda: session.motors, lambda: session.frames[5]):
                with self.assertRaisesRegex(capstan.InputError, "damaged") as caught:
                    read()
                self.assertEqual(caught.exception.file, copy)
            np.testing.assert_array_equal(session.frames[1][0], self.session.frames[1][0])

    def test_an_image_outlives_its_session(self):
        image = capstan.open(data("images.capstan")).frames[3][0]
        np.testing.assert_array_equal(image, self.session.frames[3][0])

    def test_a_session_can_be_tracked(self):
        self.assertEqual(capstan.track(self.session, estimates=False).report["title"], self.session.title)

    def test_tips_are_those_of_forward_kinematics(self):
        tips = capstan.open(data("tips.capstan"))
        times = tips.tips["t"]
        joints = np.stack([np.interp(times, tips.joints["t"], tips.joints["position"][:, i]) for i in range(3)], axis=1)
        seen = np.isfinite(tips.tips["position"]).all(axis=1)
        distance = np.linalg.norm(capstan.tip_positions(joints)[seen] - tips.tips["position"][seen], axis=1)
        self.assertLess(np.median(distance), 3e-3)  # noise and registration of the simulated cameras
        np.testing.assert_array_equal(capstan.tip_positions(joints[5]), capstan.tip_positions(joints)[5])


if __name__ == "__main__":
    unittest.main()
