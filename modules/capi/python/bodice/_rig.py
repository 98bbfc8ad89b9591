"""The bones of a program, and what binds the vertices of its mesh to them."""

from __future__ import annotations

import ctypes
import dataclasses
from typing import Optional, Sequence

import numpy as np

from . import _library as _c


@dataclasses.dataclass
class Rig:
    """Joints with the weights of a mesh's vertices. Proxies of such a skin follow the joints: Body.pose()."""

    bind: np.ndarray  #: (joints, 3, 4) or (joints, 4, 4): joint space to mesh space in the pose of the mesh, meters
    joint: np.ndarray  #: (n, k), indices of the joints of each vertex
    weight: np.ndarray  #: (n, k), zero where unused; sums are made 1
    names: Optional[Sequence[str]] = None  #: of joints; "joint_0" and so on if absent
    parents: Optional[Sequence[int]] = None  #: a joint before the child, -1 for a root; all are roots if absent

    def _structure(self):
        """The bodice_rig, and what must be kept as long as it is used."""
        pose, kept = _c.pose(self.bind)
        joint, weight = np.asarray(self.joint), np.ascontiguousarray(self.weight, np.float32)
        if joint.ndim != 2 or joint.dtype.kind not in "iu" or joint.shape != weight.shape:
            raise _c.Error(f"The joints are {joint.dtype} of shape {joint.shape}, the weights have {weight.shape}. "
                           "Pass (n, k) integers and (n, k) weights.")
        if joint.size and not 0 <= int(joint.min()) <= int(joint.max()) < pose.count:
            raise _c.Error(f"A vertex has joint {joint.min() if joint.min() < 0 else joint.max()}, and there are "
                           f"{pose.count} joints. Number them from 0.")
        joint = np.ascontiguousarray(joint, np.uint16)
        value = _c.defaults(_c.Rig)
        value.bind = ctypes.cast(ctypes.pointer(pose), ctypes.c_void_p)
        value.vertices, value.joints_per_vertex = joint.shape
        value.joint, value.weight = joint.ctypes.data, weight.ctypes.data
        kept = [pose, kept, joint, weight]
        for what, given in (("names", self.names), ("parents", self.parents)):
            if given is not None and len(given) != pose.count:
                raise _c.Error(f"The rig has {len(given)} {what} for {pose.count} joints. Pass one a joint.")
        if self.names is not None:
            names = (ctypes.c_char_p * pose.count)(*(name.encode() for name in self.names))
            value.names = ctypes.cast(names, ctypes.c_void_p)
            kept.append(names)
        if self.parents is not None:
            parents = np.ascontiguousarray(self.parents, np.int32)
            value.parents = parents.ctypes.data
            kept.append(parents)
        return value, kept
