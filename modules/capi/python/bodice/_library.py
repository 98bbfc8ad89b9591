"""The C interface as ctypes sees it: bodice.h is its definition, and the library fills every default."""

from __future__ import annotations

import ctypes
import ctypes.util
import os
import pathlib
from ctypes import c_double, c_float, c_int32, c_size_t, c_ssize_t, c_uint32, c_uint64, c_void_p

import numpy as np

PARTS = 15
LANDMARKS = 28
MEASUREMENTS = 26
NO_ELLIPSOID = 0xFFFFFFFF
ABI = 1


class Error(ValueError):
    """What bodice refuses, in one sentence with its remedy."""


def _open() -> ctypes.CDLL:
    here = pathlib.Path(__file__)
    beside = [here.with_name(f"lib{name}.so") for name in ("bodice", "bodice_frame")]
    for name in (os.environ.get("BODICE_LIBRARY"), *(str(file) for file in beside if file.exists()),
                 ctypes.util.find_library("bodice"), ctypes.util.find_library("bodice_frame")):
        if name:
            return ctypes.CDLL(name)
    raise ImportError("libbodice is not found. Install bodice, or name the file in BODICE_LIBRARY.")


class Head(ctypes.Structure):
    _fields_ = [("struct_size", c_uint32), ("cookie", c_uint32)]


class Vectors(ctypes.Structure):
    _fields_ = [("x", c_void_p), ("y", c_void_p), ("z", c_void_p), ("stride", c_ssize_t), ("scalar", c_int32),
                ("reserved", c_int32)]


class Scalars(ctypes.Structure):
    _fields_ = [("data", c_void_p), ("stride", c_ssize_t), ("scalar", c_int32), ("reserved", c_int32)]


class ContextOptions(ctypes.Structure):
    kind = 1
    _fields_ = [("head", Head), ("abi", c_uint32), ("workers", c_int32), ("host", c_void_p), ("log_level", c_int32),
                ("reserved", c_int32), ("log", c_void_p), ("allocate", c_void_p), ("release", c_void_p),
                ("now_ns", c_void_p), ("enqueue", c_void_p), ("finish", c_void_p), ("tasks_in_flight", c_int32),
                ("reserved2", c_int32)]


class ProxyInfo(ctypes.Structure):
    kind = 2
    _fields_ = [("head", Head), ("ellipsoids", c_uint32), ("joints", c_uint32), ("tier", c_int32),
                ("reserved", c_int32), ("stature_m", c_double), ("margin_m", c_double), ("hash", c_uint64),
                ("bytes", c_uint64)]


class Pose(ctypes.Structure):
    kind = 3
    _fields_ = [("head", Head), ("matrices", c_void_p), ("stride", c_ssize_t), ("count", c_uint32),
                ("scalar", c_int32), ("layout", c_int32), ("tables", c_int32), ("dt_s", c_double)]


class Particles(ctypes.Structure):
    kind = 4
    _fields_ = [("head", Head), ("count", c_size_t), ("index", c_void_p), ("elements", c_size_t),
                ("position", Vectors), ("velocity", Vectors), ("safe", Vectors), ("inverse_mass", Scalars),
                ("mask", c_void_p), ("mask_stride", c_ssize_t), ("space", c_int32), ("reserved", c_int32)]


class ContactArrays(ctypes.Structure):
    kind = 5
    _fields_ = [("head", Head), ("contact", c_void_p), ("contact_stride", c_ssize_t), ("distance", Scalars),
                ("point", Vectors), ("normal", Vectors), ("ellipsoid", c_void_p), ("part", c_void_p)]


class QueryOptions(ctypes.Structure):
    kind = 6
    _fields_ = [("head", Head), ("within_m", c_float), ("first_order", c_int32)]


class ResolveOptions(ctypes.Structure):
    kind = 7
    _fields_ = [("head", Head), ("thickness_m", c_float), ("friction", c_float), ("max_push_m", c_float),
                ("blend_m", c_float), ("paper", c_int32), ("reserved", c_int32)]


class ContactReport(ctypes.Structure):
    kind = 8
    _fields_ = [("head", Head), ("contacts", c_uint64), ("contacts_by_part", c_uint64 * PARTS),
                ("unresolved", c_uint64), ("pending", c_uint64), ("pinched", c_uint64), ("not_finite", c_uint64),
                ("pinned", c_uint64), ("deepest_m", c_float), ("reserved", c_int32)]


class Mesh(ctypes.Structure):
    kind = 9
    _fields_ = [("head", Head), ("position", Vectors), ("vertices", c_size_t), ("index", c_void_p),
                ("triangles", c_size_t), ("index_bytes", c_int32), ("reserved", c_int32)]


class SkinOptions(ctypes.Structure):
    kind = 11
    _fields_ = [("head", Head), ("rig", c_void_p), ("find_rig", c_int32), ("reserved", c_int32),
                ("progress", c_void_p), ("host", c_void_p)]


class SkinInfo(ctypes.Structure):
    kind = 12
    _fields_ = [("head", Head), ("stature_m", c_double), ("up", c_double * 3), ("vertices", c_uint32),
                ("triangles", c_uint32), ("input_vertices", c_uint32), ("joints", c_uint32), ("warnings", c_uint32),
                ("reserved", c_uint32)]


class FitOptions(ctypes.Structure):
    kind = 13
    _fields_ = [("head", Head), ("tier", c_int32), ("max_ellipsoids", c_int32), ("target_error_m", c_double),
                ("budget_us", c_double), ("time_budget_s", c_double), ("covering", c_int32), ("bind", c_int32),
                ("progress", c_void_p), ("host", c_void_p)]


class FitReport(ctypes.Structure):
    kind = 14
    _fields_ = [("head", Head), ("gap_mean_m", c_double), ("gap_p95_m", c_double), ("gap_max_m", c_double),
                ("interior_covered", c_double), ("skin_outside", c_double), ("skin_outside_depth_m", c_double),
                ("seconds", c_double), ("ellipsoids", c_uint32), ("warnings", c_uint32)]


class Garment(ctypes.Structure):
    kind = 15
    _fields_ = [("head", Head), ("name", ctypes.c_char_p), ("mesh", c_void_p), ("held", c_void_p),
                ("held_count", c_size_t)]


class DrapeOptions(ctypes.Structure):
    kind = 18
    _fields_ = [("head", Head), ("frames", c_int32), ("substeps", c_int32), ("dt_s", c_double),
                ("thickness_m", c_double), ("fabric", ctypes.c_char_p), ("motion", ctypes.c_char_p),
                ("progress", c_void_p), ("host", c_void_p)]


class DrapeReport(ctypes.Structure):
    kind = 19
    _fields_ = [("head", Head), ("hash", c_uint64), ("penetration_over_1mm", c_uint64),
                ("penetration_end_m", c_double), ("penetration_max_m", c_double), ("stretch_p95", c_double),
                ("thickness_m", c_double), ("frame_ms", c_double)]


#: The type of a progress hook.
PROGRESS = ctypes.CFUNCTYPE(c_int32, c_void_p, ctypes.c_char_p)
#: bodice_landmark as numpy has it.
LANDMARK = np.dtype([("position", np.float64, 3), ("confidence", np.float64), ("vertex", np.uint32),
                     ("reserved", np.int32)])
#: bodice_ellipsoid as numpy has it.
ELLIPSOID = np.dtype([("center", np.float64, 3), ("axes", np.float64, (3, 3)), ("radii", np.float64, 3),
                      ("part", np.int32), ("bone", np.int32)])

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
        "bodice_part_name": [c_int32],
        "bodice_collider_create": [c_void_p, c_void_p, c_void_p],
        "bodice_collider_pose": [c_void_p, c_void_p],
        "bodice_collider_move": [c_void_p, c_void_p],
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
        "bodice_landmark_name": [c_int32],
        "bodice_measurement_name": [c_int32],
        "bodice_fit": [c_void_p] * 5,
        "bodice_drape": [c_void_p] * 4 + [c_size_t] + [c_void_p] * 3,
    }
    handles = ["context", "proxy", "collider", "workspace", "exact"]
    if _is_whole:
        arguments.update(whole_arguments)
        handles.append("skin")
        for name in ("bodice_skin_warning", "bodice_landmark_name", "bodice_measurement_name"):
            getattr(library, name).restype = ctypes.c_char_p
    for name, types in arguments.items():
        getattr(library, name).argtypes = types
    for handle in handles:
        destroy = getattr(library, f"bodice_{handle}_destroy")
        destroy.argtypes, destroy.restype = [c_void_p], None


_declare()


def check(status: int) -> None:
    """Raises the sentence of a call that failed."""
    if status != 0:
        raise Error(library.bodice_last_error().decode())


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


def mesh(points: np.ndarray, faces):
    """A mesh of an array of as_points(), and what must be kept as long as it is used."""
    faces = np.asarray(faces)
    if faces.ndim != 2 or faces.shape[1] != 3 or faces.dtype.kind not in "iu" or (faces.size and faces.min() < 0):
        raise Error(f"The faces are {faces.dtype} of shape {faces.shape}. Pass (m, 3) integers, zero or more.")
    faces = np.ascontiguousarray(faces if faces.itemsize in (2, 4, 8) else faces.astype(np.uint32))
    value = defaults(Mesh)
    if len(points):
        value.position = vectors(points)
    value.vertices, value.triangles = len(points), len(faces)
    value.index, value.index_bytes = faces.ctypes.data, faces.itemsize
    return value, (points, faces)
