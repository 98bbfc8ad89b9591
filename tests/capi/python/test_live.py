"""Rigs of the program, tickets and sessions. Needs libbodice; skips aloud without numpy."""

import sys
import threading
import time
import unittest
from unittest import mock

try:
    import numpy as np
except ImportError:
    print("skipped: numpy is not installed for", sys.executable)
    sys.exit(0)

import bodice
from bodice import _library, _ticket


def sheet(above: float, n: int = 30):
    """A square of cloth, a meter wide, at a height: vertices and faces."""
    x, z = np.meshgrid(np.linspace(-0.5, 0.5, n), np.linspace(-0.5, 0.5, n), indexing="ij")
    a = (np.arange(n - 1)[:, None] * n + np.arange(n - 1)).ravel()
    faces = np.concatenate([np.stack([a, a + 1, a + n], 1), np.stack([a + 1, a + n + 1, a + n], 1)])
    return np.stack([x.ravel(), np.full(n * n, above), z.ravel()], 1), faces


@unittest.skipUnless(_library._is_whole, "the library is libbodice_frame")
class Live(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        skin = bodice.built_in(stature=1.7)
        cls.vertices, cls.faces = skin.vertices, skin.faces

    def test_a_proxy_follows_the_bones_of_the_program(self):
        # Two bones: the right arm, and everything else.
        skin = bodice.Skin(self.vertices, self.faces)
        arm = [bodice.Body.part_names.index(name) for name in bodice.Body.part_names
               if name.endswith("_r") and "arm" in name]
        self.assertGreater(len(arm), 1)
        bind = np.tile(np.eye(4), (2, 1, 1))
        bind[1, :3, 3] = skin.landmarks["elbow_r"]
        on_arm = np.isin(skin.parts, arm)
        rig = bodice.Rig(bind, np.stack([np.zeros(len(on_arm), int), np.ones(len(on_arm), int)], 1),
                         np.stack([~on_arm, on_arm], 1).astype(float), names=["rest", "arm"], parents=[-1, 0])
        body = bodice.fit(self.vertices, self.faces, "solid", rig=rig)
        self.assertEqual(list(body.joints), ["rest", "arm"])
        self.assertLess(np.abs(body.bind_matrices() - bind[:, :3]).max(), 1e-6)
        hand = self.vertices[skin.parts == bodice.Body.part_names.index("forearm_r")]
        # Lower down, the closest may be an ellipsoid of the shoulders that stands for skin of the arm as well.
        head = self.vertices[self.vertices[:, 1] > skin.landmarks["crown"][1] - 0.1]
        before = body.signed_distance(hand), body.signed_distance(head)
        moved = bind.copy()
        moved[1, 0, 3] -= 0.5  # the arm alone, half a meter to its side
        body.pose(moved)
        self.assertLess(np.abs(body.signed_distance(hand + [-0.5, 0, 0]) - before[0]).max(), 1e-4)
        self.assertLess(np.abs(body.signed_distance(head) - before[1]).max(), 1e-4)

    def test_a_rig_that_does_not_fit_is_one_sentence(self):
        n = len(self.vertices)
        bind, joint, weight = np.eye(4)[None], np.zeros((n, 1), int), np.ones((n, 1))
        for rig, word in ((bodice.Rig(bind, joint[:-1], weight[:-1]), "vertices"),
                          (bodice.Rig(bind, joint + 1, weight), "joint 1"),
                          (bodice.Rig(bind, joint - 1, weight), "joint -1"),
                          (bodice.Rig(bind, joint, weight[:, 0]), "shape"),
                          (bodice.Rig(bind, joint, weight * np.nan), "weight"),
                          (bodice.Rig(bind, joint, weight, names=["a", "b"]), "names"),
                          (bodice.Rig(bind * 0.0, joint, weight), "bind")):
            with self.assertRaisesRegex(bodice.Error, word):
                bodice.Skin(self.vertices, self.faces, rig=rig)

    def test_a_ticket_gives_the_bits_of_a_fit(self):
        ticket = bodice.begin_fit(self.vertices, self.faces, "solid")
        turns = 0
        while not ticket.done:
            turns += 1
            time.sleep(0.001)
        self.assertGreater(turns, 0)
        body = ticket.result()
        self.assertIs(ticket.result(), body)
        self.assertEqual(body.hash, bodice.fit(self.vertices, self.faces, "solid").hash)
        self.assertAlmostEqual(body.skin.stature, 1.7, delta=0.03)
        del ticket
        self.assertTrue(np.isfinite(body.signed_distance(self.vertices)).all())

    def test_tickets_end_by_cancel_by_hook_and_by_being_dropped(self):
        ticket = bodice.begin_fit(self.vertices, self.faces)
        ticket.cancel()
        with self.assertRaisesRegex(bodice.Error, "stopped|canceled"):  # by the stage that notices it
            ticket.result()

        def refuse(stage):
            raise RuntimeError(stage)

        ticket = bodice.begin_fit(self.vertices, self.faces, progress=refuse)
        with self.assertRaisesRegex(RuntimeError, "repair"):
            ticket.result()
        ticket = self._begun_after_the_hook(refuse)
        with self.assertRaisesRegex(RuntimeError, "repair"):
            ticket.result()
        began = time.perf_counter()
        del ticket
        bodice.begin_fit(self.vertices, self.faces, progress=lambda stage: None)  # dropped at once
        self.assertLess(time.perf_counter() - began, 5.0)
        with self.assertRaisesRegex(bodice.Error, "shape"):
            bodice.begin_fit(self.vertices, self.faces.ravel())

    def _begun_after_the_hook(self, refuse):
        """A ticket with a hook that has raised before the call that begins the work returns."""
        refused = threading.Event()

        def refuse_first(stage):
            refused.set()
            refuse(stage)

        whole = _ticket._c.whole

        def slow(name):
            def begin(*arguments):
                status = whole(name)(*arguments)
                self.assertTrue(refused.wait(60.0))
                time.sleep(0.05)
                return status
            return begin

        with mock.patch.object(_ticket._c, "whole", slow):
            return bodice.begin_fit(self.vertices, self.faces, progress=refuse_first)

    def test_a_session_dresses_plays_pauses_and_seeks(self):
        session = bodice.Session("solid", moves=True, workers=1)
        self.assertEqual(session.poll(), "idle")
        with self.assertRaisesRegex(bodice.Error, "no body"):
            session.body()
        session.submit(self.vertices, self.faces)
        cloth, faces = sheet(self.vertices[:, 1].max() + 0.02)
        session.dress(bodice.Garment(cloth, faces), bodice.Garment(cloth + [0, 0.01, 0], faces, name="second"))
        for _ in range(20):
            report = session.step()
        self.assertEqual((session.poll(), report["has_body"], report["vertices"]), ("ready", 1, 2 * len(cloth)))
        end = session.positions()
        self.assertEqual(end.shape, (2 * len(cloth), 3))
        self.assertLess(end[:, 1].min(), cloth[0, 1] - 0.1)
        self.assertGreater(session.body().signed_distance(end).min(), -0.002)
        into = np.empty((2 * len(cloth), 3), np.float32)
        self.assertIs(session.positions(into), into)
        self.assertLess(np.abs(into - end).max(), 1e-5)
        state = session.hash
        session.step()
        self.assertNotEqual(session.hash, state)

        session.play("walk")
        while session.step()["clip_s"] < 0.05:
            pass
        session.pause()
        stands = session.step()["clip_s"]
        self.assertEqual(session.step()["clip_s"], stands)
        session.resume()
        session.seek(0.5, ramp=0.0)
        self.assertAlmostEqual(session.step(0.02)["clip_s"], 0.52)

    def test_what_fails_beside_the_frames_is_raised_by_poll(self):
        session = bodice.Session(workers=1)
        session.submit_file("no/such/body.obj")
        session.step()
        with self.assertRaisesRegex(bodice.Error, "no.such.body"):
            session.poll()
        with self.assertRaisesRegex(bodice.Error, "moves"):
            session.play("walk")
        with self.assertRaisesRegex(bodice.Error, "tier"):
            bodice.Session("best")
        with self.assertRaisesRegex(bodice.Error, "chain mail"):
            bodice.Session(fabric="chain mail")
        with self.assertRaises(bodice.Error):
            session.dress(bodice.Garment(self.vertices, self.faces + len(self.vertices)))


if __name__ == "__main__":
    unittest.main()
