"""import bodice, against distances to balls that numpy computes. Run with BODICE_LIBRARY set; skips aloud without numpy."""

import importlib.util
import json
import pathlib
import sys
import threading
import time
import unittest

try:
    import numpy as np
except ImportError:
    print("skipped: numpy is not installed for", sys.executable)
    sys.exit(0)

import bodice

CENTERS = np.array([[0.0, 1.6, 0.0], [0.1, 1.55, 0.02], [0.0, 1.4, -0.05]])
RADII = np.array([0.1, 0.08, 0.13])


def balls() -> bytes:
    """A proxy of balls, as a file has it."""
    ellipsoids = [{"part": part, "center": list(center), "radii": [radius] * 3,
                   "axes": [[1, 0, 0], [0, 1, 0], [0, 0, 1]]}
                  for part, center, radius in zip(("head", "torso_ul", "torso_ur"), CENTERS.tolist(), RADII.tolist())]
    return json.dumps({"format": "bodice-proxy", "version": 2, "tier": "solid", "metres_per_unit": 1.0, "up": "y",
                       "stature": 1.7, "margin": 0.0, "source_hash": "0" * 16, "ellipsoids": ellipsoids,
                       "relief": [], "texels": ""}).encode()


def truth(points, centers=CENTERS):
    return (np.linalg.norm(points[:, None] - centers, axis=2) - RADII).min(axis=1)


class Distances(unittest.TestCase):
    def setUp(self):
        self.body = bodice.loads(balls())
        self.points = np.random.default_rng(1).uniform(-0.3, 0.3, (5000, 3)) + [0, 1.5, 0]

    def test_any_type_and_layout_gives_the_distance(self):
        expected = truth(self.points)
        wide = np.zeros((5000, 7))
        wide[:, 1:6:2] = self.points
        for points in (self.points, self.points.astype(np.float32), np.asfortranarray(self.points), wide[:, 1:6:2],
                       self.points[::-1], self.points.tolist()):
            got = self.body.signed_distance(points)
            wanted = expected[::-1] if points is not self.points and np.array_equal(points, self.points[::-1]) else expected
            self.assertLess(np.abs(got - wanted).max(), 1e-6)
        self.assertEqual(self.body.signed_distance(self.points.astype(np.float32)).dtype, np.float32)
        self.assertEqual(len(self.body.signed_distance(np.zeros((0, 3)))), 0)

    def test_contacts_have_the_gradient_the_part_and_a_point_on_the_surface(self):
        contacts = self.body.contacts(self.points)
        step = 1e-4
        smooth = np.ones(len(self.points), bool)
        gradient = np.empty((5000, 3))
        for axis in range(3):
            shift = np.zeros(3)
            shift[axis] = step
            gradient[:, axis] = (truth(self.points + shift) - truth(self.points - shift)) / (2 * step)
        smooth = np.abs(np.linalg.norm(gradient, axis=1) - 1.0) < 1e-3  # not at a crease
        self.assertGreater(smooth.mean(), 0.95)
        self.assertLess(np.abs(contacts.normal - gradient)[smooth].max(), 1e-2)
        self.assertLess(np.abs(truth(contacts.point[contacts.distance > 0])).max(), 1e-6)
        owner = (np.linalg.norm(self.points[:, None] - CENTERS, axis=2) - RADII).argmin(axis=1)
        self.assertGreater((contacts.ellipsoid == owner).mean(), 0.999)
        self.assertEqual(bodice.Body.part_names[contacts.part[0]], ("head", "torso_ul", "torso_ur")[owner[0]])

    def test_a_limit_leaves_far_points_without_contact(self):
        contacts = self.body.contacts(self.points, within=0.02)
        far = truth(self.points) > 0.0201
        self.assertTrue((contacts.ellipsoid[far] == -1).all())
        self.assertTrue(np.isinf(contacts.distance[far]).all())

    def test_particles_are_moved_in_place_and_pinned_ones_stay(self):
        positions = self.points.astype(np.float32)
        before = positions.copy()
        inverse_mass = np.ones(5000)
        inverse_mass[::2] = 0
        self.assertGreater(self.body.resolve(positions, inverse_mass=inverse_mass, thickness=0.001), 50)
        self.assertGreater(truth(positions[1::2].astype(float)).min(), 0.001 - 1e-5)
        self.assertTrue((positions[::2] == before[::2]).all())
        with self.assertRaisesRegex(bodice.Error, "in place"):
            self.body.resolve(positions.tolist())

    def test_a_pose_moves_each_ellipsoid_and_a_shear_is_named(self):
        matrices = np.repeat(np.eye(4, dtype=np.float32)[None], 3, axis=0)
        matrices[1, :3, 3] = 0.05, 0.1, 0.0
        self.body.pose(matrices)
        moved = CENTERS + [[0, 0, 0], [0.05, 0.1, 0.0], [0, 0, 0]]
        self.assertLess(np.abs(self.body.signed_distance(self.points) - truth(self.points, moved)).max(), 1e-6)
        matrices[2, 0, 1] = 0.3
        with self.assertRaisesRegex(bodice.Error, "ellipsoid 2 shears"):
            self.body.pose(matrices)

    def test_what_cannot_be_is_one_sentence(self):
        with self.assertRaisesRegex(bodice.Error, "shape"):
            self.body.signed_distance(np.zeros((4, 2)))
        with self.assertRaises(bodice.Error):
            bodice.loads(b"not a proxy")
        again = bodice.loads(self.body.to_bytes())
        self.assertEqual(again.hash, self.body.hash)
        self.assertEqual(len(again), 3)
        self.assertTrue(np.allclose(again.ellipsoids()["center"], CENTERS))

    def test_a_proxy_from_a_file_has_no_mesh_to_be_exact_by(self):
        with self.assertRaisesRegex(bodice.Error, "has no mesh"):
            self.body.signed_distance(self.points, exact=True)

    def test_the_exact_distance_is_that_of_the_mesh(self):
        corners = np.array([[x, y, z] for x in (-1, 1) for y in (-1, 1) for z in (-1, 1)], float)
        faces = np.array([[0, 1, 3], [0, 3, 2], [4, 6, 7], [4, 7, 5], [0, 4, 5], [0, 5, 1], [2, 3, 7], [2, 7, 6],
                          [0, 2, 6], [0, 6, 4], [1, 5, 7], [1, 7, 3]])
        points = np.random.default_rng(2).uniform(-2, 2, (400, 3))
        outside = np.abs(points) - 1
        expected = np.linalg.norm(np.maximum(outside, 0), axis=1) + np.minimum(outside.max(axis=1), 0)
        for kind in (np.int64, np.uint8, np.uint16):
            cube = bodice.Exact(corners, faces.astype(kind))
            self.assertLess(np.abs(cube.signed_distance(points) - expected).max(), 1e-12)
        contacts = cube.contacts(points)
        self.assertTrue(np.allclose(np.linalg.norm(points - contacts.point, axis=1), np.abs(expected)))
        with self.assertRaisesRegex(bodice.Error, "Triangle 3 refers to vertex 8"):
            bodice.Exact(corners, np.where(np.arange(36).reshape(12, 3) == 10, 8, faces))
        with self.assertRaisesRegex(bodice.Error, "zero or more"):
            bodice.Exact(corners, -faces)

    def test_the_example_of_a_loss_takes_points_out_of_the_body(self):
        sys.path.insert(0, str(pathlib.Path(__file__).parents[3] / "examples"))
        import collision_loss

        targets = self.points[:500]
        points, losses = collision_loss.descend(self.body, targets + 0.01, targets)
        self.assertLess(losses[-1], 0.5 * losses[0])
        self.assertGreater((truth(targets) < 0).sum(), 2 * (truth(points) < -0.001).sum())
        page = collision_loss.page(self.body, targets + 0.01, points, losses)
        inside = int((self.body.signed_distance(points) < 0.0).sum())
        self.assertIn(f"after: {inside} of {len(points)} points inside", page)
        self.assertEqual(page.count("<circle"), 2 * len(points))

    @unittest.skipUnless(importlib.util.find_spec("torch"), "torch is not installed")
    def test_torch_differentiates_the_distance(self):
        sys.path.insert(0, str(pathlib.Path(__file__).parents[3] / "examples"))
        import collision_loss_torch
        import torch

        points = torch.from_numpy(self.points[:300].copy()).requires_grad_(True)
        collision_loss_torch.SignedDistance.apply(points, self.body).sum().backward()
        h = 1e-3  # distances are floats: a smaller step is lost in their rounding
        for axis in range(3):
            step = np.zeros(3)
            step[axis] = h
            slope = (truth(self.points[:300] + step) - truth(self.points[:300] - step)) / (2 * h)
            difference = np.abs(points.grad[:, axis].numpy() - slope)
            self.assertLess(np.median(difference), 2e-3)  # where the closest ellipsoid changes there is no slope
            self.assertLess(np.mean(difference > 0.05), 0.05)
        targets = torch.from_numpy(self.points[:500])
        moved, losses = collision_loss_torch.descend(self.body, targets + 0.01, targets)
        self.assertLess(losses[-1], 0.5 * losses[0])
        self.assertGreater((truth(targets.numpy()) < 0).sum(), 2 * (truth(moved.numpy()) < -0.001).sum())

    def test_other_threads_run_during_a_call(self):
        many = np.repeat(self.points, 400, axis=0)
        ticks, done = [], threading.Event()
        thread = threading.Thread(target=lambda: (self.body.signed_distance(many), done.set()))
        thread.start()
        while not done.is_set():
            ticks.append(time.perf_counter())
            time.sleep(0)
        thread.join()
        self.assertGreater(len(ticks), 10)


if __name__ == "__main__":
    print(bodice.build())
    unittest.main()
