"""A try-on in motion: frames of cloth on the calling thread, and bodies prepared beside them."""

from __future__ import annotations

import ctypes
import os
from typing import Dict, Optional, Union

import numpy as np

from . import _library as _c
from ._body import Body
from ._skin import Garment, tier_number

STATES = ("idle", "working", "ready")


class Session:
    """One body, its garments and its frames. All calls come from one thread.

        session = bodice.Session(moves=True)
        session.submit(vertices, faces)            # prepared beside the frames, first coarse, then finer
        session.dress(bodice.Garment(dress_vertices, dress_faces))
        session.play("walk")
        while running:
            report = session.step(1 / 60)
            session.positions(out)

    `moves`: bodies get a rig and play motions. `workers`: threads, 0 for one a hardware thread; with one, nothing runs
    beside the frames, and the first step after a submission does the work. Others: see bodice_session_options."""

    def __init__(self, tier: Optional[str] = None, *, max_ellipsoids: Optional[int] = None, moves: bool = False,
                 substeps: int = 8, fabric: str = "cotton", thickness: float = 0.001, workers: int = 0):
        create = _c.whole("bodice_session_create")
        self._context = _c.make_context(workers)
        options = _c.defaults(_c.SessionOptions)
        options.tier, options.max_ellipsoids, options.moves = tier_number(tier), max_ellipsoids or 0, int(moves)
        options.substeps, options.fabric, options.thickness_m = substeps, fabric.encode(), thickness
        self._session = _c.Handle("bodice_session", create, self._context, ctypes.byref(options))
        self._vertices = 0

    def submit(self, vertices: np.ndarray, faces: np.ndarray) -> None:
        """Prepares a body (meters, y up); each of its proxies takes effect between two steps. Work on an earlier body
        is canceled."""
        mesh, _kept = _c.mesh(_c.as_points(vertices), faces)
        _c.check(_c.library.bodice_session_submit(self._session, ctypes.byref(mesh)))

    def submit_file(self, path: Union[str, "os.PathLike[str]"]) -> None:
        """The same for a body file, which is read beside the frames; a file that is not good fails a later poll()."""
        _c.check(_c.library.bodice_session_submit_file(self._session, os.fsencode(path)))

    def poll(self) -> str:
        """"idle" before the first body, "working", or "ready". Raises what has stopped the preparation."""
        state = ctypes.c_int32()
        _c.check(_c.library.bodice_session_poll(self._session, ctypes.byref(state)))
        return STATES[state.value]

    def dress(self, *garments: Garment) -> None:
        """Replaces the garments, between two steps."""
        array, _kept = _c.garments(garments)
        _c.check(_c.library.bodice_session_dress(self._session, array, len(array)))
        self._vertices = sum(len(garment.vertices) for garment in garments)

    def play(self, motion: str, clip: Optional[str] = None) -> None:
        """Plays a made motion ("walk", "run", "turn", "sit", "dance", ...) or one of a file. Needs `moves`; a motion that
        is not found fails a later poll()."""
        _c.check(_c.library.bodice_session_play(self._session, motion.encode(), clip.encode() if clip else None))

    def pause(self) -> None:
        """Frames go on, but the body stays in its pose until resume()."""
        _c.check(_c.library.bodice_session_pause(self._session))

    def resume(self) -> None:
        """Ends pause()."""
        _c.check(_c.library.bodice_session_resume(self._session))

    def seek(self, time: float, ramp: float = 0.5) -> None:
        """Moves to a second of the motion, over `ramp` seconds so that garments can follow; zero jumps."""
        _c.check(_c.library.bodice_session_seek(self._session, time, ramp))

    def step(self, dt: float = 1.0 / 60.0) -> Dict[str, float]:
        """Takes what has become ready, then runs `dt` seconds of motion and cloth. See bodice_step_report."""
        report = _c.defaults(_c.StepReport)
        _c.check(_c.library.bodice_session_step(self._session, dt, ctypes.byref(report)))
        return _c.as_dict(report)

    def positions(self, out: Optional[np.ndarray] = None) -> np.ndarray:
        """(n, 3): the vertices of all garments, garment after garment; into `out` where it is given."""
        out = np.empty((self._vertices, 3)) if out is None else _c.as_points(out, self._vertices, in_place=True)
        if len(out):
            to = _c.vectors(out)
            _c.check(_c.library.bodice_session_get_positions(self._session, ctypes.byref(to), len(out)))
        return out

    def body(self) -> Body:
        """The proxy in use, at rest. Raises before the first one."""
        proxy = ctypes.c_void_p()
        _c.check(_c.library.bodice_session_get_proxy(self._session, ctypes.byref(proxy)))
        body = Body.__new__(Body)
        body._adopt(_c.make_context(1), _c.Handle.owning("bodice_proxy", proxy))
        return body

    @property
    def hash(self) -> int:
        """Of the state of all garments: equal bits have equal hashes."""
        value = ctypes.c_uint64()
        _c.check(_c.library.bodice_session_get_hash(self._session, ctypes.byref(value)))
        return value.value
