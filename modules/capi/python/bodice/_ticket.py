"""Fits beside what the program does meanwhile."""

from __future__ import annotations

import ctypes
import time
import weakref
from typing import Optional

import numpy as np

from . import _library as _c
from ._rig import Rig
from ._skin import FittedBody, Hook, Progress, Skin, fit_options, skin_options


class Ticket:
    """A fit on a thread of its own, which bodice.begin_fit() has begun. All calls come from one thread."""

    _wait_s = 0.005  # between looks, so that Ctrl-C ends a wait

    def __init__(self, context: "_c.Handle", handle: ctypes.c_void_p, hook: Hook):
        self._context, self._handle, self._hook = context, handle, hook
        self._body: Optional[FittedBody] = None
        # The hook lives as long as the thread that calls it, which this ends.
        self._end = weakref.finalize(self, lambda hook: _c.library.bodice_ticket_destroy(handle), hook)

    @property
    def done(self) -> bool:
        """Whether the work is over. No cost: for every frame."""
        done = ctypes.c_int32()
        _c.check(_c.library.bodice_ticket_poll(self._handle, ctypes.byref(done)))
        return bool(done.value)

    def cancel(self) -> None:
        """Requests that the work stop; result() then raises."""
        _c.check(_c.library.bodice_ticket_cancel(self._handle))

    def result(self) -> FittedBody:
        """Waits for the end. Raises what has stopped the work; Ctrl-C ends the wait and not the work."""
        while not self.done:
            time.sleep(self._wait_s)
        if self._body is None:
            skin, proxy, report = ctypes.c_void_p(), ctypes.c_void_p(), _c.defaults(_c.FitReport)
            self._hook.check(_c.library.bodice_ticket_take(self._handle, ctypes.byref(skin), ctypes.byref(proxy),
                                                           ctypes.byref(report)))
            self._body = FittedBody(self._context, _c.Handle.owning("bodice_proxy", proxy),
                                    Skin._owning(self._context, skin), _c.as_dict(report))
        return self._body


def begin_fit(vertices: np.ndarray, faces: np.ndarray, tier: Optional[str] = None, *,
              target_error: Optional[float] = None, max_ellipsoids: Optional[int] = None,
              budget_us: Optional[float] = None, rig: Optional[Rig] = None, find_rig: bool = False,
              shape: str = "person", workers: int = 0, progress: Optional[Progress] = None) -> Ticket:
    """bodice.fit() that returns at once; the arrays are copied. Refuses a mesh that cannot be."""
    begin = _c.whole("bodice_fit_begin")
    context = _c.make_context(workers)
    mesh, _kept = _c.mesh(_c.as_points(vertices), faces)
    options, _kept_rig = skin_options(rig, find_rig, shape)
    wanted = fit_options(tier, target_error, max_ellipsoids, budget_us)
    hook, handle = Hook(options, progress), ctypes.c_void_p()
    status = begin(context, ctypes.byref(mesh), ctypes.byref(options), ctypes.byref(wanted), ctypes.byref(handle))
    # The ticket comes before what may raise: it is what ends the thread that calls the hook.
    ticket = Ticket(context, handle, hook)
    hook.begun(status)
    return ticket
