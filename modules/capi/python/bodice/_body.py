"""Proxies and exact distances, for queries, responses and poses."""

from __future__ import annotations

import ctypes
import dataclasses
import threading
from typing import TYPE_CHECKING, Optional, Sequence, Tuple, Union

import numpy as np

from . import _library as _c

if TYPE_CHECKING:
    from ._skin import Skin

Canceled, Error, OutOfMemory = _c.Canceled, _c.Error, _c.OutOfMemory


@dataclasses.dataclass
class Contacts:
    """The closest point of the surface for each of n points. Rows without a contact have ellipsoid -1."""

    distance: np.ndarray  #: (n,), meters, negative inside, +inf without a contact
    point: np.ndarray  #: (n, 3)
    normal: np.ndarray  #: (n, 3), outward, unit length: the gradient of the distance
    ellipsoid: np.ndarray  #: (n,), int64
    part: np.ndarray  #: (n,), uint8, index into Body.part_names; 255 without a contact


class Body:
    """A body proxy, at rest or in a pose. Queries of one body may overlap on several threads; poses must not.

    Attributes: `stature` (meters, as if the body stood upright), `hash` (of its geometry), `joints` (names of those that
    it is bound to, in the order of pose()), `part_names`. len() is the number of ellipsoids."""

    part_names: Tuple[str, ...] = _c.names_of(_c.library.bodice_part_name)

    def __init__(self, data: bytes, workers: int = 1):
        context = _c.make_context(workers)
        self._adopt(context, _c.Handle("bodice_proxy", _c.library.bodice_proxy_from_bytes, context, data, len(data)))

    def _adopt(self, context: "_c.Handle", proxy: "_c.Handle") -> None:
        self._context, self._proxy = context, proxy
        self._exact: Optional[Exact] = None
        self._posed = False
        self._collider = _c.Handle("bodice_collider", _c.library.bodice_collider_create, self._context, self._proxy)
        self._spare: list = []  # workspaces that no call uses
        self._lock = threading.Lock()
        info = _c.defaults(_c.ProxyInfo)
        _c.check(_c.library.bodice_proxy_get_info(self._proxy, ctypes.byref(info)))
        self.stature: float = info.stature_m
        self.hash: int = info.hash
        self.joints: Tuple[str, ...] = tuple(
            _c.library.bodice_proxy_joint_name(self._proxy, j).decode() for j in range(info.joints))
        self._ellipsoids = info.ellipsoids

    def __len__(self) -> int:
        """The number of ellipsoids."""
        return self._ellipsoids

    def ellipsoids(self) -> np.ndarray:
        """The ellipsoids at rest: center (3), axes (3, 3; an axis a row), radii (3), part and bone of each."""
        out = np.zeros(len(self), _c.ELLIPSOID)
        _c.check(_c.library.bodice_proxy_get_ellipsoids(self._proxy, out.ctypes.data, len(out)))
        return out

    def bind_matrices(self) -> np.ndarray:
        """(joints, 3, 4): joint space to body space, in the pose that the proxy was bound in."""
        out = np.zeros((len(self.joints), 3, 4))
        for joint in range(len(out)):
            _c.check(_c.library.bodice_proxy_get_bind(
                self._proxy, joint, out[joint].ctypes.data_as(ctypes.POINTER(ctypes.c_double))))
        return out

    def joint_weights(self) -> np.ndarray:
        """(ellipsoids, joints): by how much of each joint's motion the center of an ellipsoid moves. Rows add up to 1;
        one may hold a weight a little below 0, since it is the affine fit to the weights of the skin."""
        out = np.zeros((len(self), len(self.joints)))
        joint, weight = np.empty(out.shape[1], np.uint16), np.empty(out.shape[1], np.float32)
        count = ctypes.c_size_t()
        for ellipsoid, row in enumerate(out):
            _c.check(_c.library.bodice_proxy_get_joint_weights(
                self._proxy, ellipsoid, joint.ctypes.data, weight.ctypes.data, len(joint), ctypes.byref(count)))
            row[joint[:count.value]] = weight[:count.value]
        return out

    def bind(self, skin: Skin) -> Body:
        """The same proxy bound to the joints of the skin that it was fitted to, without another fit."""
        bound = ctypes.c_void_p()
        _c.check(_c.whole("bodice_proxy_bind")(self._context, self._proxy, skin._skin, ctypes.byref(bound)))
        body = Body.__new__(Body)
        body._adopt(self._context, _c.Handle.owning("bodice_proxy", bound))
        return body

    def to_bytes(self, json: bool = False) -> bytes:
        """The proxy as a file has it."""
        size = ctypes.c_size_t()
        _c.check(_c.library.bodice_proxy_to_bytes(self._proxy, int(json), None, 0, ctypes.byref(size)))
        data = ctypes.create_string_buffer(size.value)
        _c.check(_c.library.bodice_proxy_to_bytes(self._proxy, int(json), data, size.value, ctypes.byref(size)))
        return data.raw

    def signed_distance(self, points: np.ndarray, within: float = float("inf"), fast: bool = False,
                        exact: bool = False) -> np.ndarray:
        """(n, 3) -> (n,): meters to the surface, negative inside, +inf beyond `within` and for points that are not
        finite. `fast`: to first order, in half of the time. `exact`: the distance to the mesh itself, which is the
        reference; only of a body that was fitted here and not posed since, and hundreds of times slower."""
        if exact:
            return self._reference().signed_distance(points)
        points = _c.as_points(points)
        out = np.empty(len(points), points.dtype)
        self._query(points, within, fast, distance=_c.scalars(out))
        return out

    def contacts(self, points: np.ndarray, within: float = float("inf"), fast: bool = False,
                 exact: bool = False) -> Contacts:
        """The contact of each of (n, 3) points; `normal` is the gradient of the distance. `exact`: as there."""
        if exact:
            return self._reference().contacts(points)
        points = _c.as_points(points)
        n, kind = len(points), points.dtype
        found = Contacts(np.empty(n, kind), np.empty((n, 3), kind), np.empty((n, 3), kind), np.empty(n, np.uint32),
                         np.empty(n, np.uint8))
        self._query(points, within, fast, distance=_c.scalars(found.distance), point=_c.vectors(found.point),
                    normal=_c.vectors(found.normal), ellipsoid=found.ellipsoid.ctypes.data,
                    part=found.part.ctypes.data)
        found.ellipsoid = np.where(found.ellipsoid == _c.NO_ELLIPSOID, -1, found.ellipsoid.astype(np.int64))
        return found

    def resolve(self, positions: np.ndarray, velocities: Optional[np.ndarray] = None,
                safe: Optional[np.ndarray] = None, inverse_mass: Optional[np.ndarray] = None, *,
                thickness: float = 0.0, friction: float = 0.3) -> int:
        """Moves the particles (n, 3) out that are inside or nearer than the thickness, in place, and corrects their
        velocities. Those of inverse mass 0 stay. Returns the number of contacts."""
        particles = _c.particles(_c.as_points(positions, in_place=True))
        arrays = {"velocity": velocities, "safe": safe}
        for name, array in arrays.items():
            if array is not None:
                setattr(particles, name, _c.vectors(_c.as_points(array, len(positions), in_place=True)))
        if inverse_mass is not None:
            inverse_mass = _c.as_numbers(inverse_mass, len(positions))
            particles.inverse_mass = _c.scalars(inverse_mass)
        options, report = _c.defaults(_c.ResolveOptions), _c.defaults(_c.ContactReport)
        options.thickness_m, options.friction = thickness, friction
        with self._workspace() as workspace:
            _c.check(_c.library.bodice_resolve(self._collider, ctypes.byref(particles), ctypes.byref(options),
                                               workspace, ctypes.byref(report)))
        return report.contacts

    def pose(self, matrices: Union[np.ndarray, Sequence], dt: float = 0.0) -> None:
        """Poses a bound proxy: (joints, 3, 4) or (joints, 4, 4), joint space to world, in the order of `joints`. Of a
        proxy that is not bound: a matrix an ellipsoid, from rest to the world. `dt`: seconds since the last pose."""
        pose, _kept = _c.pose(matrices)
        pose.dt_s = dt
        move = _c.library.bodice_collider_pose if self.joints else _c.library.bodice_collider_move
        _c.check(move(self._collider, ctypes.byref(pose)))
        self._posed = True

    def cover(self, skin: np.ndarray, tolerance: float = 0.0007) -> int:
        """Raises relief where points (n, 3) of the posed skin, such as its vertices, are outside of the surface by more
        than `tolerance`; the next pose takes it back. Returns how many were outside. Tier `relief` alone."""
        particles, uncovered = _c.particles(_c.as_points(skin)), ctypes.c_size_t()
        _c.check(_c.library.bodice_collider_cover(self._collider, ctypes.byref(particles), tolerance,
                                                  ctypes.byref(uncovered)))
        return uncovered.value

    def _mesh(self) -> Tuple[np.ndarray, np.ndarray]:
        raise Error("A proxy from a file has no mesh. Use bodice.Exact(vertices, faces), or a body of bodice.fit().")

    def _reference(self) -> "Exact":
        with self._lock:
            if self._exact is None:
                self._exact = Exact(*self._mesh())
        if self._posed:
            raise Error("The body was posed, and exact distances are those of its mesh at rest. Use "
                        "bodice.Exact(vertices, faces) with the posed vertices.")
        return self._exact

    def _query(self, points: np.ndarray, within: float, fast: bool, **arrays) -> None:
        particles, contacts = _c.particles(points), _c.defaults(_c.ContactArrays)
        for name, array in arrays.items():
            setattr(contacts, name, array)
        options = _c.defaults(_c.QueryOptions)
        options.within_m, options.first_order = within, int(fast)
        with self._workspace() as workspace:
            _c.check(_c.library.bodice_query(self._collider, ctypes.byref(particles), ctypes.byref(options), workspace,
                                             ctypes.byref(contacts)))

    def _workspace(self) -> "_Borrowed":
        return _Borrowed(self)


class Exact:
    """The exact signed distance to a triangle mesh: slow, in double precision, the reference for a proxy.

    `vertices` (n, 3), meters; `faces` (m, 3), wound counter-clockwise seen from outside. The mesh should be closed.
    Calls may overlap on several threads."""

    def __init__(self, vertices: np.ndarray, faces: np.ndarray, workers: int = 0):
        points = _c.as_points(vertices)
        mesh, kept = _c.mesh(points, faces)
        self._context = _c.make_context(workers)
        self._exact = _c.Handle("bodice_exact", _c.library.bodice_exact_create, self._context, ctypes.byref(mesh))

    def signed_distance(self, points: np.ndarray) -> np.ndarray:
        """(n, 3) -> (n,): meters to the mesh, negative inside."""
        return self.contacts(points).distance

    def contacts(self, points: np.ndarray) -> Contacts:
        """The closest point of the mesh to each of (n, 3) points; `ellipsoid` is the triangle, `part` is 255."""
        points = _c.as_points(points)
        n, kind = len(points), points.dtype
        found = Contacts(np.empty(n, kind), np.empty((n, 3), kind), np.empty((n, 3), kind), np.empty(n, np.uint32),
                         np.full(n, 255, np.uint8))
        arrays = _c.defaults(_c.ContactArrays)
        arrays.distance, arrays.point = _c.scalars(found.distance), _c.vectors(found.point)
        arrays.normal, arrays.ellipsoid = _c.vectors(found.normal), found.ellipsoid.ctypes.data
        particles = _c.particles(points)
        _c.check(_c.library.bodice_exact_query(self._exact, ctypes.byref(particles), ctypes.byref(arrays)))
        found.ellipsoid = np.where(found.ellipsoid == _c.NO_ELLIPSOID, -1, found.ellipsoid.astype(np.int64))
        return found


class _Borrowed:
    """A workspace for one call: calls on several threads must not share one."""

    def __init__(self, body: Body):
        self._body = body

    def __enter__(self):
        with self._body._lock:
            if self._body._spare:
                self._workspace = self._body._spare.pop()
                return self._workspace
        self._workspace = _c.Handle("bodice_workspace", _c.library.bodice_workspace_create, self._body._context)
        return self._workspace

    def __exit__(self, *failure) -> None:
        with self._body._lock:
            self._body._spare.append(self._workspace)
