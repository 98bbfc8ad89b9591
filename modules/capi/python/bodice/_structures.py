"""The structures of bodice.h as ctypes sees them; `kind` is what bodice_fill_defaults() calls each."""

from __future__ import annotations

import ctypes
from ctypes import c_double, c_float, c_int32, c_size_t, c_ssize_t, c_uint32, c_uint64, c_void_p

import numpy as np

PARTS = 15
NO_ELLIPSOID = 0xFFFFFFFF
ABI = 1


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


class Rig(ctypes.Structure):
    kind = 10
    _fields_ = [("head", Head), ("bind", c_void_p), ("names", c_void_p), ("parents", c_void_p),
                ("vertices", c_size_t), ("joint", c_void_p), ("weight", c_void_p), ("joints_per_vertex", c_uint32),
                ("reserved", c_int32)]


class SkinOptions(ctypes.Structure):
    kind = 11
    _fields_ = [("head", Head), ("rig", c_void_p), ("find_rig", c_int32), ("shape", c_int32),
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


class SessionOptions(ctypes.Structure):
    kind = 16
    _fields_ = [("head", Head), ("tier", c_int32), ("max_ellipsoids", c_int32), ("moves", c_int32),
                ("substeps", c_int32), ("fabric", ctypes.c_char_p), ("thickness_m", c_double)]


class StepReport(ctypes.Structure):
    kind = 17
    _fields_ = [("head", Head), ("has_body", c_int32), ("refinement", c_int32), ("proxy_hash", c_uint64),
                ("vertices", c_uint64), ("contacts", c_uint64), ("step_ms", c_double), ("clip_s", c_double)]


class DrapeOptions(ctypes.Structure):
    kind = 18
    _fields_ = [("head", Head), ("frames", c_int32), ("substeps", c_int32), ("dt_s", c_double),
                ("thickness_m", c_double), ("fabric", ctypes.c_char_p), ("motion", ctypes.c_char_p),
                ("progress", c_void_p), ("host", c_void_p), ("tack_m", c_double), ("find_position", c_int32),
                ("hold", c_int32)]


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
