"""bodice.fit and what comes with it, on the built-in body. Needs libbodice; skips aloud without numpy."""

import contextlib
import functools
import io
import math
import os
import pathlib
import signal
import sys
import tempfile
import threading
import unittest

try:
    import numpy as np
except ImportError:
    print("skipped: numpy is not installed for", sys.executable)
    sys.exit(0)

import bodice
from bodice import _library


@unittest.skipUnless(_library._is_whole, "the library is libbodice_frame")
class Fits(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        skin = bodice.built_in(stature=1.7)
        cls.vertices, cls.faces = skin.vertices, skin.faces
        cls.body = bodice.fit(cls.vertices, cls.faces, "solid")

    @classmethod
    @functools.cache
    def fine(cls):
        """The same body in the default tier, relief, fitted once for the tests that only read it."""
        return cls.body.skin.fit()

    def test_the_body_is_known(self):
        skin = self.body.skin
        self.assertAlmostEqual(skin.stature, 1.7, delta=0.03)
        self.assertGreater(skin.up[1], 0.99)
        self.assertLess(np.abs(skin.vertices[skin.vertex_of_input] - self.vertices).max(), 1e-5)
        self.assertEqual(len(self.body.parts), len(self.vertices))
        self.assertEqual(set(self.body.parts), set(range(15)))
        marks = self.body.landmarks
        self.assertAlmostEqual(marks["crown"][1], self.vertices[:, 1].max(), delta=0.01)
        self.assertGreater(marks["elbow_l"][0], 0.1)  # the left is at +x
        self.assertLess(marks["elbow_r"][0], -0.1)
        head = self.vertices[self.body.parts == bodice.Body.part_names.index("head")]
        self.assertGreater(head[:, 1].min(), 1.3)
        self.assertEqual(len(skin.confidence), 28)
        self.assertTrue(0.5 < self.body.measurements["waist"] < 1.2)
        self.assertAlmostEqual(self.body.measurements["height"], 1.7, delta=0.03)

    def test_the_example_of_a_pose_runs(self):
        sys.path.insert(0, str(pathlib.Path(__file__).parents[3] / "examples"))
        import fit_and_pose

        printed = io.StringIO()
        with contextlib.redirect_stdout(printed):
            self.assertTrue(fit_and_pose.main())
        self.assertIn("took over", printed.getvalue())

    def test_a_thing_is_fitted_without_being_a_person(self):
        grid = np.stack(np.meshgrid(*[np.linspace(-1.0, 1.0, 13)] * 2), axis=-1).reshape(-1, 2)
        face = np.array([[i, i + 1, i + 14, i, i + 14, i + 13] for i in range(12 * 13) if i % 13 < 12]).reshape(-1, 3)
        sides, faces = [], []
        for axis in range(3):
            for sign in (1.0, -1.0):
                side = np.empty((len(grid), 3))
                side[:, axis], side[:, (axis + 1) % 3], side[:, (axis + 2) % 3] = sign, grid[:, 0], grid[:, 1]
                faces.append((face if sign > 0 else face[:, ::-1]) + len(grid) * len(sides))
                sides.append(0.2 * side)
        cube, faces = np.concatenate(sides), np.concatenate(faces)
        with self.assertRaisesRegex(bodice.Error, "No human body"):
            bodice.fit(cube, faces)
        with self.assertRaisesRegex(bodice.Error, "no shape 'cube'. Give one of person, any"):
            bodice.fit(cube, faces, shape="cube")
        points = np.random.default_rng(4).uniform(-0.3, 0.3, (2000, 3))
        beyond = np.abs(points) - 0.2
        exact = np.linalg.norm(np.maximum(beyond, 0.0), axis=1) + np.minimum(beyond.max(axis=1), 0.0)
        for body in (bodice.fit(cube, faces, shape="any"), bodice.begin_fit(cube, faces, shape="any").result()):
            near = np.abs(exact) < 0.03
            self.assertLess(np.abs(body.signed_distance(points) - exact)[near].mean(), 0.002)
        with self.assertRaisesRegex(bodice.Error, "no measurements"):
            body.measurements

    def test_the_error_of_the_proxy_is_what_the_report_states(self):
        random = np.random.default_rng(3)
        corners = self.vertices[self.faces[random.integers(0, len(self.faces), 3000)]]
        points = corners.mean(axis=1) + random.normal(0, 0.003, (3000, 3))
        error = self.body.signed_distance(points) - self.body.signed_distance(points, exact=True)
        self.assertLess(np.abs(error).mean(), 2 * self.body.report["gap_mean_m"])
        self.assertGreater(np.abs(error).mean(), 0.3 * self.body.report["gap_mean_m"])
        fine = self.fine()
        error = fine.signed_distance(points) - fine.signed_distance(points, exact=True)
        self.assertLess(np.abs(error).mean(), 0.001)
        self.assertEqual(bodice.loads(fine.to_bytes()).hash, fine.hash)

    def test_the_python_block_of_the_readme_runs(self):
        text = (pathlib.Path(__file__).parents[3] / "README.md").read_text()
        block = text.split("```python\n")[1].split("```")[0]
        with tempfile.TemporaryDirectory() as folder:
            obj = pathlib.Path(folder, "body.obj")
            obj.write_text("".join(f"v {x} {y} {z}\n" for x, y, z in self.vertices) +
                           "".join(f"f {a} {b} {c}\n" for a, b, c in self.faces + 1))
            names, printed = {}, io.StringIO()
            with contextlib.redirect_stdout(printed):
                exec(block.replace("body.obj", str(obj)), names)
        distance = names["body"].signed_distance(names["points"])
        self.assertIn(str(distance), printed.getvalue())
        self.assertGreater((distance > 0.0).mean(), 0.4)

    def test_centimeters_and_wrong_shapes_are_one_sentence(self):
        with self.assertRaisesRegex(bodice.Error, "0.01"):
            bodice.fit(self.vertices * 100, self.faces)
        with self.assertRaisesRegex(bodice.Error, "no tier"):
            bodice.fit(self.vertices, self.faces, "best")
        with self.assertRaisesRegex(bodice.Error, "shape"):
            bodice.fit(self.vertices, self.faces.reshape(-1))
        with self.assertRaisesRegex(bodice.Error, "no.such.file"):
            bodice.load_skin("no/such.file")

    def test_progress_is_heard_cancels_and_may_raise(self):
        stages = []
        bodice.fit(self.vertices, self.faces, "solid", progress=stages.append)
        self.assertEqual([s for i, s in enumerate(stages) if i == 0 or s != stages[i - 1]],
                         ["repair", "segment", "fit"])
        with self.assertRaises(bodice.Error):
            bodice.fit(self.vertices, self.faces, progress=lambda stage: True)

        def interrupt(stage):
            raise KeyboardInterrupt

        with self.assertRaises(KeyboardInterrupt):
            bodice.fit(self.vertices, self.faces, progress=interrupt)

    def test_ctrl_c_ends_a_fit_wherever_it_comes(self):
        for wait_s in (0.02, 0.1, 0.15, 0.2):
            timer = threading.Timer(wait_s, os.kill, (os.getpid(), signal.SIGINT))
            with self.assertRaises(KeyboardInterrupt):
                timer.start()  # here, since a busy machine may take until the signal to go on
                bodice.fit(self.vertices, self.faces)
                timer.join()
            self.assertIs(signal.getsignal(signal.SIGINT), signal.default_int_handler)

    def test_failures_have_their_status_and_kind(self):
        with self.assertRaises(bodice.Canceled) as raised:
            bodice.fit(self.vertices, self.faces, progress=lambda stage: True)
        self.assertEqual(raised.exception.status, 5)
        with self.assertRaises(bodice.Error) as raised:
            bodice.load_skin("no/such.file")
        self.assertEqual(raised.exception.status, 2)

    def test_faces_of_another_byte_order_are_the_same_mesh(self):
        plain = bodice.Exact(self.vertices, self.faces).signed_distance([[0.0, 1.0, 0.0]])
        swapped = bodice.Exact(self.vertices, self.faces.astype(">i4")).signed_distance([[0.0, 1.0, 0.0]])
        self.assertEqual(plain[0], swapped[0])

    def test_a_found_skeleton_carries_the_proxy(self):
        body = bodice.fit(self.vertices, self.faces, "solid", find_rig=True)
        self.assertGreater(len(body.joints), 15)
        self.assertEqual(body.skin.joints, body.joints)
        parent = dict(zip(body.joints, (body.joints[p] if p >= 0 else None for p in body.skin.joint_parents)))
        self.assertEqual([parent[name] for name in ("pelvis", "calf_l", "hand_r")], [None, "thigh_l", "forearm_r"])
        points = self.vertices[::50]
        rest = body.signed_distance(points)
        moved = body.bind_matrices()
        moved[:, 0, 3] += 1.0
        body.pose(moved)
        self.assertLess(np.abs(body.signed_distance(points + [1.0, 0, 0]) - rest).max(), 1e-4)
        with self.assertRaisesRegex(bodice.Error, "was posed"):
            body.signed_distance(points, exact=True)

    def test_a_cover_raises_relief_to_points_above_it(self):
        body = bodice.Body(self.fine().to_bytes())
        at = body.contacts(self.vertices)
        above = at.point + 0.002 * at.normal
        self.assertGreater(body.cover(above), 0.9 * len(above))
        self.assertLess(np.percentile(body.signed_distance(above), 95), 0.0008)
        self.assertEqual(body.cover(at.point - 0.002 * at.normal), 0)
        with self.assertRaisesRegex(bodice.Error, "tolerance"):
            body.cover(above, -1.0)

    def test_a_saved_proxy_is_bound_without_another_fit(self):
        saved = bodice.Body(self.body.to_bytes())
        self.assertEqual(saved.joint_weights().shape, (len(saved), 0))
        with self.assertRaisesRegex(bodice.Error, "has no rig"):
            saved.bind(self.body.skin)
        bound = saved.bind(bodice.Skin(self.vertices, self.faces, find_rig=True))
        weights = bound.joint_weights()
        np.testing.assert_allclose(weights.sum(axis=1), 1.0, atol=1e-5)
        bones = bound.ellipsoids()["bone"]
        self.assertGreater((weights.argmax(axis=1) == bones).mean(), 0.9)
        with self.assertRaisesRegex(bodice.Error, "not of this skin"):
            saved.bind(bodice.Skin(self.vertices + [1.0, 0, 0], self.faces, find_rig=True))

    def test_a_sheet_falls_onto_the_shoulders_and_stays_outside(self):
        n = 40
        grid = np.stack(np.meshgrid(np.linspace(-0.5, 0.5, n), np.linspace(-0.5, 0.5, n), indexing="ij"), -1)
        neck = self.body.landmarks["crown"]
        sheet = np.empty((n * n, 3))
        sheet[:, 0], sheet[:, 2], sheet[:, 1] = grid[..., 0].ravel(), grid[..., 1].ravel(), neck[1] + 0.02
        a = (np.arange(n - 1)[:, None] * n + np.arange(n - 1)).ravel()
        faces = np.concatenate([np.stack([a, a + 1, a + n], 1), np.stack([a + 1, a + n + 1, a + n], 1)])
        end, report = self.body.drape(sheet, faces, frames=30)
        self.assertEqual(end.shape, sheet.shape)
        self.assertTrue(np.isfinite(end).all())
        self.assertLess(end[:, 1].min(), neck[1] - 0.1)
        self.assertLess(report["penetration_end_m"], 0.01)
        self.assertGreater(self.body.signed_distance(end).min(), -0.002)
        self.assertTrue(math.isfinite(report["frame_ms"]))


if __name__ == "__main__":
    unittest.main()
