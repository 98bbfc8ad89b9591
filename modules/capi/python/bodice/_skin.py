"""Skins: bodies from meshes and files, what is known of them, and the proxies fitted to them. Needs libbodice."""

from __future__ import annotations

import ctypes
import dataclasses
import os
import signal
import threading
from typing import Callable, Dict, List, Optional, Tuple, Union

import numpy as np

from . import _library as _c
from ._body import Body
from ._rig import Rig

#: Called with the name of the stage now and then, on any thread; true cancels.
Progress = Callable[[str], object]

TIERS = ("paper", "solid", "tight", "relief")
SHAPES = ("person", "any")


class Hook:
    """A progress hook for one call. Whatever it raises cancels the call and is raised there, Ctrl-C included."""

    def __init__(self, options, progress: Optional[Progress]):
        self._progress = progress
        self._raised: Optional[BaseException] = None
        # An interrupt that Python raised before _call has reached its try would be lost: it is noted in place of that.
        self._interrupted = False
        self._previous = None
        if (threading.current_thread() is threading.main_thread()
                and signal.getsignal(signal.SIGINT) is signal.default_int_handler):
            self._previous = signal.signal(signal.SIGINT, self._interrupt)
        self._function = _c.PROGRESS(self._call)
        options.progress = ctypes.cast(self._function, ctypes.c_void_p)

    def _interrupt(self, number, frame) -> None:
        self._interrupted = True

    def _call(self, host, stage: bytes) -> int:
        try:
            return int(self._interrupted or bool(self._progress and self._progress(stage.decode())))
        except BaseException as raised:  # it must not cross the library
            self._raised = raised
            return 1

    def begun(self, status: int) -> None:
        """After a call that leaves work running. What the hook raises in that work is for check(), at its end."""
        self._stop_listening()
        _c.check(status)

    def _stop_listening(self) -> None:
        if self._previous is not None:
            signal.signal(signal.SIGINT, self._previous)
            self._previous = None
        if self._interrupted:
            raise KeyboardInterrupt

    def check(self, status: int) -> None:
        """After a call that is over, or at the end of work that has begun()."""
        self._stop_listening()
        if self._raised is not None:
            raise self._raised
        _c.check(status)


def skin_options(rig: Optional[Rig], find_rig: bool, shape: str = SHAPES[0]):
    """A bodice_skin_options, and what must be kept as long as it is used."""
    if shape not in SHAPES:
        raise _c.Error(f"There is no shape {shape!r}. Give one of {', '.join(SHAPES)}.")
    options, kept = _c.defaults(_c.SkinOptions), None
    options.find_rig, options.shape = int(find_rig), SHAPES.index(shape)
    if rig is not None:
        kept = rig._structure()
        options.rig = ctypes.cast(ctypes.pointer(kept[0]), ctypes.c_void_p)
    return options, kept


def tier_number(tier: Optional[str]) -> int:
    if tier is not None and tier not in TIERS:
        raise _c.Error(f"There is no tier {tier!r}. Give one of {', '.join(TIERS)}.")
    return -1 if tier is None else TIERS.index(tier)


def fit_options(tier: Optional[str], target_error: Optional[float], max_ellipsoids: Optional[int],
                budget_us: Optional[float]):
    options = _c.defaults(_c.FitOptions)
    options.tier, options.max_ellipsoids = tier_number(tier), max_ellipsoids or 0
    options.target_error_m, options.budget_us = target_error or 0.0, budget_us or 0.0
    return options


class Skin:
    """The repaired mesh of a body with its landmarks and parts. Any pose and up axis; coordinates are meters.

    `vertices` (n, 3), `faces` (m, 3). `rig`: the bones of the program, which its proxies follow; `find_rig`: the body
    gets a skeleton for that. `shape`: "person", or "any" for a thing such as a chair, with clusters as parts.

    Attributes: `stature` (meters, as if the body stood upright), `up` (unit vector from feet to head), `warnings` (what
    was repaired or is doubtful, a sentence each), `joints` (names of the joints of its rig, in the order of a fitted
    proxy's) and `joint_parents` (the joint that each hangs on, which comes before it; -1 for a root)."""

    def __init__(self, vertices: np.ndarray, faces: np.ndarray, *, rig: Optional[Rig] = None, find_rig: bool = False,
                 shape: str = "person", workers: int = 0, progress: Optional[Progress] = None):
        points = _c.as_points(vertices)
        mesh, _kept = _c.mesh(points, faces)
        self._make(_c.whole("bodice_skin_from_mesh"), (ctypes.byref(mesh),), find_rig, workers, progress, rig, shape)

    @classmethod
    def _by(cls, name: str, arguments: tuple, find_rig: bool, workers: int, progress: Optional[Progress],
            shape: str = "person") -> "Skin":
        skin = cls.__new__(cls)
        skin._make(_c.whole(name), arguments, find_rig, workers, progress, shape=shape)
        return skin

    def _make(self, create, arguments, find_rig, workers, progress, rig=None, shape="person") -> None:
        context = _c.make_context(workers)
        options, _kept = skin_options(rig, find_rig, shape)
        hook = Hook(options, progress)
        self._adopt(context, _c.Handle("bodice_skin", create, context, *arguments, ctypes.byref(options),
                                       check=hook.check))

    @classmethod
    def _owning(cls, context: "_c.Handle", handle: ctypes.c_void_p) -> "Skin":
        skin = cls.__new__(cls)
        skin._adopt(context, _c.Handle.owning("bodice_skin", handle))
        return skin

    def _adopt(self, context: "_c.Handle", skin: "_c.Handle") -> None:
        self._context, self._skin = context, skin
        info = _c.defaults(_c.SkinInfo)
        _c.check(_c.library.bodice_skin_get_info(self._skin, ctypes.byref(info)))
        self.stature: float = info.stature_m
        self.up: np.ndarray = np.array(info.up)
        self.warnings: List[str] = [_c.library.bodice_skin_warning(self._skin, i).decode()
                                    for i in range(info.warnings)]
        self.joints: Tuple[str, ...] = tuple(
            _c.library.bodice_skin_joint_name(self._skin, j).decode() for j in range(info.joints))
        self.joint_parents: Tuple[int, ...] = tuple(
            _c.library.bodice_skin_joint_parent(self._skin, j) for j in range(info.joints))
        self._sizes = info.vertices, info.triangles, info.input_vertices

    @property
    def vertices(self) -> np.ndarray:
        """(v, 3), meters: the repaired mesh."""
        out = np.empty((self._sizes[0], 3))
        _c.check(_c.library.bodice_skin_get_mesh(self._skin, out.ctypes.data, len(out), None, 0))
        return out

    @property
    def faces(self) -> np.ndarray:
        """(f, 3), wound counter-clockwise seen from outside."""
        out = np.empty((self._sizes[1], 3), np.uint32)
        _c.check(_c.library.bodice_skin_get_mesh(self._skin, None, 0, out.ctypes.data, len(out)))
        return out

    @property
    def vertex_of_input(self) -> np.ndarray:
        """(n,), int64: the vertex of this skin for each vertex that was given; -1 where repair has dropped it."""
        out = np.empty(self._sizes[2], np.uint32)
        _c.check(_c.library.bodice_skin_get_vertex_of_input(self._skin, out.ctypes.data, len(out)))
        return np.where(out == _c.NO_ELLIPSOID, -1, out.astype(np.int64))

    @property
    def parts(self) -> np.ndarray:
        """(n,), uint8: index into Body.part_names of each vertex that was given; 255 where repair has dropped it."""
        part = np.empty(self._sizes[0], np.uint8)
        _c.check(_c.library.bodice_skin_get_parts(self._skin, part.ctypes.data, len(part)))
        vertex = self.vertex_of_input
        return np.where(vertex < 0, 255, part[vertex]).astype(np.uint8)

    def _landmarks(self) -> Dict[str, np.void]:
        names = _c.names_of(_c.library.bodice_landmark_name)
        out = np.zeros(len(names), _c.LANDMARK)
        _c.check(_c.library.bodice_skin_get_landmarks(self._skin, out.ctypes.data, len(out)))
        return dict(zip(names, out))

    @property
    def landmarks(self) -> Dict[str, np.ndarray]:
        """Position (3,) of each landmark that was found, by name, such as "elbow_l"."""
        return {name: mark["position"].copy() for name, mark in self._landmarks().items() if mark["confidence"] > 0.0}

    @property
    def confidence(self) -> Dict[str, float]:
        """Confidence of each landmark, from 0 (not found) to 1."""
        return {name: float(mark["confidence"]) for name, mark in self._landmarks().items()}

    @property
    def measurements(self) -> Dict[str, float]:
        """Measurements for garments by name, meters and radians, NaN where one could not be taken.
        modules/anatomy/MEASUREMENTS.md defines them."""
        names = _c.names_of(_c.library.bodice_measurement_name)
        out = np.empty(len(names))
        _c.check(_c.library.bodice_skin_get_measurements(self._skin, out.ctypes.data, len(out)))
        return dict(zip(names, map(float, out)))

    def fit(self, tier: Optional[str] = None, *, target_error: Optional[float] = None,
            max_ellipsoids: Optional[int] = None, budget_us: Optional[float] = None,
            progress: Optional[Progress] = None) -> "FittedBody":
        """Fits a proxy. `tier`: "paper", "solid", "tight" or "relief" (default); `target_error`: wanted mean gap to the
        skin, meters; `budget_us`: wanted time of a query of 10,000 points."""
        options, report = fit_options(tier, target_error, max_ellipsoids, budget_us), _c.defaults(_c.FitReport)
        hook = Hook(options, progress)
        proxy = ctypes.c_void_p()
        hook.check(_c.library.bodice_fit(self._context, self._skin, ctypes.byref(options), ctypes.byref(proxy),
                                         ctypes.byref(report)))
        return FittedBody(self._context, _c.Handle.owning("bodice_proxy", proxy), self, _c.as_dict(report))


@dataclasses.dataclass
class Garment:
    """A garment in the coordinates of its body, meters, y up."""

    vertices: np.ndarray  #: (n, 3)
    faces: np.ndarray  #: (m, 3)
    held: Optional[np.ndarray] = None  #: vertices that stay with the body, such as a waistband
    name: str = "garment"  #: for messages


class FittedBody(Body):
    """A proxy together with the skin that it was fitted to.

    Attributes: `skin`, and `report` (gaps between proxy and skin in meters, shares, seconds: see bodice_fit_report)."""

    def __init__(self, context, proxy, skin: Skin, report: Dict[str, float]):
        self._adopt(context, proxy)
        self.skin = skin
        self.report = report

    landmarks = property(lambda self: self.skin.landmarks, doc="See Skin.landmarks.")
    measurements = property(lambda self: self.skin.measurements, doc="See Skin.measurements.")
    parts = property(lambda self: self.skin.parts, doc="See Skin.parts.")

    def _mesh(self) -> Tuple[np.ndarray, np.ndarray]:
        return self.skin.vertices, self.skin.faces

    def drape(self, vertices: np.ndarray, faces: np.ndarray, held: Optional[np.ndarray] = None, *,
              frames: int = 120, dt: float = 1.0 / 60.0, fabric: str = "cotton", motion: Optional[str] = None,
              tack: Optional[float] = None, find_position: bool = False, hold: bool = False,
              progress: Optional[Progress] = None) -> Tuple[np.ndarray, Dict[str, float]]:
        """Drapes a garment (meters, y up, worn by this body at rest); `held`: vertices that stay with the body.
        `motion` ("walk", "sit", a file, ...) needs a skin with a rig. `tack`: pieces of the garment this near to each
        other stay together, meters (0.006; 0: none do). `find_position`: unit, axes and position of the garment are found.
        `hold`: where nothing is held, it is held as a wearer does, a skirt by its waistband. Returns the positions
        (n, 3) at the end, and the numbers of the drape: see bodice_drape_report."""
        points = _c.as_points(vertices)
        worn, _kept = _c.garments([Garment(points, faces, held)])
        options = _c.defaults(_c.DrapeOptions)
        options.find_position, options.hold = int(find_position), int(hold)
        if tack is not None:
            options.tack_m = tack
        options.frames, options.dt_s, options.fabric = frames, dt, fabric.encode()
        options.motion = motion.encode() if motion else None
        hook, report = Hook(options, progress), _c.defaults(_c.DrapeReport)
        out = np.empty((len(points), 3))
        to = _c.vectors(out)
        hook.check(_c.library.bodice_drape(self._context, self.skin._skin, self._proxy, worn, 1,
                                           ctypes.byref(options), ctypes.byref(to), ctypes.byref(report)))
        return out, _c.as_dict(report)


def load_skin(path: Union[str, "os.PathLike[str]"], *, find_rig: bool = False, shape: str = "person", workers: int = 0,
              progress: Optional[Progress] = None) -> Skin:
    """A skin from an OBJ, PLY, STL, glTF/GLB, FBX or Collada file in any unit; meters with y up. A rig of the file is
    taken along. `shape`: as of Skin."""
    return Skin._by("bodice_skin_from_file", (os.fsencode(path),), find_rig, workers, progress, shape)


def built_in(female: bool = True, stature: float = 1.68, *, find_rig: bool = False, workers: int = 0) -> Skin:
    """The skin of the built-in body, to try things out."""
    return Skin._by("bodice_skin_built_in", (int(female), stature), find_rig, workers, None)


def fit(vertices: np.ndarray, faces: np.ndarray, tier: Optional[str] = None, *,
        target_error: Optional[float] = None, max_ellipsoids: Optional[int] = None, budget_us: Optional[float] = None,
        rig: Optional[Rig] = None, find_rig: bool = False, shape: str = "person", workers: int = 0,
        progress: Optional[Progress] = None) -> FittedBody:
    """From a mesh to a body: Skin(vertices, faces).fit(...). 1 to 3 seconds; tier "solid" takes half a second."""
    skin = Skin(vertices, faces, rig=rig, find_rig=find_rig, shape=shape, workers=workers, progress=progress)
    return skin.fit(tier, target_error=target_error, max_ellipsoids=max_ellipsoids, budget_us=budget_us,
                    progress=progress)
