"""Body proxies in Python: fits, signed distances, contacts, poses and drapes, over the C interface of bodice.

    import bodice
    body = bodice.fit(vertices, faces)               # (n, 3) meters, (m, 3); or bodice.load("body.bodice")
    distance = body.signed_distance(points)          # (n, 3) -> (n,), meters, negative inside
    error = distance - body.signed_distance(points, exact=True)   # against the mesh itself
    contacts = body.contacts(points)                 # distance, point, normal (the gradient), ellipsoid, part
    body.landmarks["elbow_l"], body.measurements["waist"], body.parts
    body.pose(matrices)                              # (joints, 3, 4) or (joints, 4, 4), of a bound proxy
    positions, report = body.drape(garment_vertices, garment_faces)
    ticket = bodice.begin_fit(vertices, faces)       # beside the frames: ticket.done, ticket.result()
    session = bodice.Session(moves=True)             # frames of cloth on a body that walks

Arrays of numpy are read and written where they are, float32 and float64, with any strides; the interpreter's lock is
released meanwhile. Each failure raises bodice.Error with one sentence and its remedy.
"""

from __future__ import annotations

import os
from typing import Union

from . import _library as _c
from ._body import Body, Canceled, Contacts, Error, Exact, OutOfMemory
from ._rig import Rig
from ._session import Session
from ._skin import FittedBody, Garment, Progress, Skin, built_in, fit, load_skin
from ._ticket import Ticket, begin_fit

__all__ = ["Body", "Canceled", "Contacts", "Error", "Exact", "FittedBody", "Garment", "OutOfMemory", "Progress", "Rig", "Session", "Skin", "Ticket",
           "begin_fit", "build", "built_in", "fit", "load", "load_skin", "loads"]


def build() -> str:
    """One line about the library: version, ABI, compiler, instruction set in use."""
    return _c.library.bodice_build().decode()


def load(path: Union[str, "os.PathLike[str]"], workers: int = 1) -> "Body":
    """Reads a proxy from a file, binary or JSON. `workers`: threads a call; 0 is one a hardware thread."""
    with open(path, "rb") as file:
        return loads(file.read(), workers)


def loads(data: bytes, workers: int = 1) -> "Body":
    """Reads a proxy from bytes."""
    return Body(data, workers)
