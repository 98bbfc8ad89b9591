"""The C interface as ctypes sees it: bodice.h is its definition, and the library fills every default."""

from __future__ import annotations

import ctypes
import ctypes.util
import itertools
import os
import pathlib
from ctypes import c_double, c_int32, c_size_t, c_uint32, c_void_p
from typing import Callable, Optional, Tuple

import numpy as np

from ._structures import *  # noqa: F403: the structures and constants of bodice.h
from ._structures import ABI, ContextOptions, Garment, Mesh, Particles, Pose, Scalars, Vectors


class Error(ValueError):
    """What bodice refuses, in one sentence with its remedy. `status` is that of bodice.h."""

    status = 1  # BODICE_INVALID_ARGUMENT: found here, before the library was called


class Canceled(Error):
    """A progress callback or a ticket stopped the work."""

    status = 5


class OutOfMemory(Error, MemoryError):
    """An allocation failed; what was there before is as it was."""

    status = 8


def _open() -> ctypes.CDLL:
    named = os.environ.get("BODICE_LIBRARY")
    if named:
        try:
            return ctypes.CDLL(named)
        except OSError as error:
            raise ImportError(f"BODICE_LIBRARY names {named}, which cannot be loaded ({error}). Name libbodice.so.") from None
    for name in ("bodice", "bodice_frame"):
        beside = pathlib.Path(__file__).with_name(f"lib{name}.so")
        for file in (str(beside) if beside.exists() else None, f"lib{name}.so.{ABI}", ctypes.util.find_library(name)):
            try:
                if file:
                    return ctypes.CDLL(file)
            except OSError:  # not where the loader looks
                continue
    raise ImportError("libbodice is not found. Install bodice, or name the file in BODICE_LIBRARY.")


def _misfit(what: str) -> ImportError:
    """What importing with another library than that of this package raises."""
    return ImportError(f"{library._name} ({_build()}) is not of the version of this package (ABI {ABI}): {what}. "
                       "Install both from one version, or name the right library in BODICE_LIBRARY.")


def _build() -> str:
    """The library's line about itself."""
    try:
        library.bodice_build.restype = ctypes.c_char_p
    except AttributeError:
        raise ImportError(f"{library._name} is no library of bodice. Name libbodice.so in BODICE_LIBRARY.") from None
    return library.bodice_build().decode()


def names_of(name: Callable[[int], Optional[bytes]]) -> Tuple[str, ...]:
    """The names that a function of the library has for 0, 1, 2 and so on, up to the first number without one."""
    return tuple(known.decode() for known in iter(map(name, itertools.count()).__next__, None))


library = _open()
_is_whole = hasattr(library, "bodice_fit")  # else it is libbodice_frame


def _declare() -> None:
    for name in ("bodice_last_error", "bodice_build", "bodice_part_name", "bodice_proxy_joint_name"):
        getattr(library, name).restype = ctypes.c_char_p
    arguments = {
        "bodice_fill_defaults": [c_int32, c_void_p, c_size_t],
        "bodice_context_create": [c_void_p, c_void_p],
        "bodice_proxy_from_bytes": [c_void_p, ctypes.c_char_p, c_size_t, c_void_p],
        "bodice_proxy_to_bytes": [c_void_p, c_int32, c_void_p, c_size_t, c_void_p],
        "bodice_proxy_get_info": [c_void_p, c_void_p],
        "bodice_proxy_get_ellipsoids": [c_void_p, c_void_p, c_size_t],
        "bodice_proxy_joint_name": [c_void_p, c_uint32],
        "bodice_proxy_get_bind": [c_void_p, c_uint32, c_void_p],
        "bodice_proxy_get_joint_weights": [c_void_p, c_uint32, c_void_p, c_void_p, c_size_t, c_void_p],
        "bodice_part_name": [c_int32],
        "bodice_collider_create": [c_void_p, c_void_p, c_void_p],
        "bodice_collider_pose": [c_void_p, c_void_p],
        "bodice_collider_move": [c_void_p, c_void_p],
        "bodice_collider_cover": [c_void_p, c_void_p, c_float, c_void_p],
        "bodice_workspace_create": [c_void_p, c_void_p],
        "bodice_query": [c_void_p] * 5,
        "bodice_resolve": [c_void_p] * 5,
        "bodice_exact_create": [c_void_p] * 3,
        "bodice_exact_query": [c_void_p] * 3,
    }
    whole_arguments = {
        "bodice_skin_from_mesh": [c_void_p] * 4,
        "bodice_skin_from_file": [c_void_p, ctypes.c_char_p, c_void_p, c_void_p],
        "bodice_skin_built_in": [c_void_p, c_int32, c_double, c_void_p, c_void_p],
        "bodice_skin_get_info": [c_void_p] * 2,
        "bodice_skin_get_mesh": [c_void_p, c_void_p, c_size_t, c_void_p, c_size_t],
        "bodice_skin_get_vertex_of_input": [c_void_p, c_void_p, c_size_t],
        "bodice_skin_get_parts": [c_void_p, c_void_p, c_size_t],
        "bodice_skin_get_landmarks": [c_void_p, c_void_p, c_size_t],
        "bodice_skin_get_measurements": [c_void_p, c_void_p, c_size_t],
        "bodice_skin_warning": [c_void_p, c_uint32],
        "bodice_skin_joint_name": [c_void_p, c_uint32],
        "bodice_skin_joint_parent": [c_void_p, c_uint32],
        "bodice_landmark_name": [c_int32],
        "bodice_measurement_name": [c_int32],
        "bodice_fit": [c_void_p] * 5,
        "bodice_proxy_bind": [c_void_p] * 4,
        "bodice_drape": [c_void_p] * 4 + [c_size_t] + [c_void_p] * 3,
        "bodice_fit_begin": [c_void_p] * 5,
        "bodice_ticket_poll": [c_void_p] * 2,
        "bodice_ticket_cancel": [c_void_p],
        "bodice_ticket_take": [c_void_p] * 4,
        "bodice_session_create": [c_void_p] * 3,
        "bodice_session_submit": [c_void_p] * 2,
        "bodice_session_submit_file": [c_void_p, ctypes.c_char_p],
        "bodice_session_poll": [c_void_p] * 2,
        "bodice_session_dress": [c_void_p] * 2 + [c_size_t],
        "bodice_session_play": [c_void_p, ctypes.c_char_p, ctypes.c_char_p],
        "bodice_session_pause": [c_void_p],
        "bodice_session_resume": [c_void_p],
        "bodice_session_seek": [c_void_p, c_double, c_double],
        "bodice_session_step": [c_void_p, c_double, c_void_p],
        "bodice_session_get_positions": [c_void_p, c_void_p, c_size_t],
        "bodice_session_get_proxy": [c_void_p] * 2,
        "bodice_session_get_hash": [c_void_p] * 2,
    }
    handles = ["context", "proxy", "collider", "workspace", "exact"]
    if _is_whole:
        arguments.update(whole_arguments)
        handles += ["skin", "ticket", "session"]
        for name in ("bodice_skin_warning", "bodice_skin_joint_name", "bodice_landmark_name", "bodice_measurement_name"):
            getattr(library, name).restype = ctypes.c_char_p
    for name, types in arguments.items():
        getattr(library, name).argtypes = types
    for handle in handles:
        destroy = getattr(library, f"bodice_{handle}_destroy")
        destroy.argtypes, destroy.restype = [c_void_p], None


if f", ABI {ABI}," not in _build():
    raise _misfit("the ABI differs")
try:
    _declare()
except AttributeError as error:  # the loader's own text names the function that is not there
    raise _misfit(str(error).rpartition("undefined symbol: ")[2] + " is missing") from None


def check(status: int) -> None:
    """Raises the sentence of a call that failed."""
    if status != 0:
        kind = {Canceled.status: Canceled, OutOfMemory.status: OutOfMemory}.get(status, Error)
        error = kind(library.bodice_last_error().decode())
        error.status = status
        raise error


class Handle:
    """A handle of the library, released with the object."""

    def __init__(self, kind: str, create, *arguments, check=check):
        self._as_parameter_ = c_void_p()
        self._destroy = getattr(library, f"{kind}_destroy")
        check(create(*arguments, ctypes.byref(self._as_parameter_)))

    @classmethod
    def owning(cls, kind: str, handle: c_void_p) -> "Handle":
        """Takes a handle that a call has made."""
        self = cls.__new__(cls)
        self._as_parameter_, self._destroy = handle, getattr(library, f"{kind}_destroy")
        return self

    def __del__(self):
        if self._as_parameter_:
            self._destroy(self._as_parameter_)


def defaults(structure):
    """A structure with its defaults."""
    value = structure()
    check(library.bodice_fill_defaults(structure.kind, ctypes.byref(value), ctypes.sizeof(value)))
    return value


def whole(name: str):
    """A function of libbodice."""
    if not _is_whole:
        raise Error("This library is libbodice_frame, which makes no bodies. Install libbodice.")
    return getattr(library, name)


def garments(worn):
    """An array of bodice_garment for a sequence of Garment, and what must be kept as long as it is used."""
    array, kept = (Garment * len(worn))(), []
    for value, one in zip(array, worn):
        ctypes.memmove(ctypes.byref(value), ctypes.byref(defaults(Garment)), ctypes.sizeof(Garment))
        shape, arrays = mesh(as_points(one.vertices), one.faces)
        held = np.ascontiguousarray([] if one.held is None else one.held, np.uint32)
        name = one.name.encode()
        value.name, value.mesh = name, ctypes.cast(ctypes.pointer(shape), c_void_p)
        if len(held):
            value.held, value.held_count = held.ctypes.data, len(held)
        kept += [shape, arrays, held, name]
    return array, kept


def make_context(workers: int) -> Handle:
    options = defaults(ContextOptions)
    options.workers = workers
    return Handle("bodice_context", library.bodice_context_create, ctypes.byref(options))


def as_dict(report) -> dict:
    """The numbers of a report by name."""
    return {name: getattr(report, name) for name, *_ in report._fields_ if name != "head"}


def scalar_of(array: np.ndarray) -> int:
    return int(array.dtype == np.float64)


def as_points(points, count=None, in_place: bool = False) -> np.ndarray:
    """An (n, 3) array of floats that the library can read where it is; copied only if it must be, and may be."""
    array = np.asarray(points)
    if array.ndim != 2 or array.shape[1] != 3 or (count is not None and len(array) != count):
        raise Error(f"The points have the shape {array.shape}. Pass ({'n' if count is None else count}, 3).")
    fits = array.dtype in (np.float32, np.float64) and array.dtype.isnative
    fits = fits and (len(array) < 2 or abs(array.strides[0]) >= array.itemsize)
    if in_place and not (isinstance(points, np.ndarray) and fits and array.flags.writeable):
        raise Error("These points cannot be moved in place. Pass a writable array of float32 or float64.")
    return array if fits else np.array(array, np.float64 if array.dtype != np.float32 else np.float32)


def as_numbers(numbers, count: int) -> np.ndarray:
    array = np.asarray(numbers)
    if array.shape != (count,):
        raise Error(f"The numbers have the shape {array.shape}. Pass ({count},).")
    return array if array.dtype in (np.float32, np.float64) and array.strides[0] else np.array(array, np.float64)


def vectors(array: np.ndarray) -> Vectors:
    x = array.ctypes.data
    return Vectors(x, x + array.strides[1], x + 2 * array.strides[1], array.strides[0], scalar_of(array), 0)


def scalars(array: np.ndarray) -> Scalars:
    return Scalars(array.ctypes.data, array.strides[0], scalar_of(array), 0)


def particles(points: np.ndarray) -> Particles:
    value = defaults(Particles)
    value.count = len(points)
    if len(points):
        value.position = vectors(points)
    return value


def pose(matrices) -> tuple:
    """A bodice_pose of (joints, 3, 4) or (joints, 4, 4) matrices, and what must be kept as long as it is used."""
    matrices = np.asarray(matrices)
    if matrices.dtype not in (np.float32, np.float64):
        matrices = matrices.astype(np.float64)
    if matrices.ndim != 3 or matrices.shape[1:] not in ((3, 4), (4, 4)):
        raise Error(f"The matrices have the shape {matrices.shape}. Pass (joints, 3, 4) or (joints, 4, 4).")
    matrices = np.ascontiguousarray(matrices)
    value = defaults(Pose)
    value.matrices, value.count = matrices.ctypes.data, len(matrices)
    value.scalar, value.layout = scalar_of(matrices), int(matrices.shape[1] == 4)
    return value, matrices


def mesh(points: np.ndarray, faces):
    """A mesh of an array of as_points(), and what must be kept as long as it is used."""
    faces = np.asarray(faces)
    if faces.ndim != 2 or faces.shape[1] != 3 or faces.dtype.kind not in "iu" or (faces.size and faces.min() < 0):
        raise Error(f"The faces are {faces.dtype} of shape {faces.shape}. Pass (m, 3) integers, zero or more.")
    faces = faces.astype(faces.dtype.newbyteorder("="), copy=False)
    faces = np.ascontiguousarray(faces if faces.itemsize in (2, 4, 8) else faces.astype(np.uint32))
    value = defaults(Mesh)
    if len(points):
        value.position = vectors(points)
    value.vertices, value.triangles = len(points), len(faces)
    value.index, value.index_bytes = faces.ctypes.data, faces.itemsize
    return value, (points, faces)
