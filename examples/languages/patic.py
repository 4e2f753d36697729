"""The p-atic field of a tissue from Python: numpy arrays in, numpy arrays out.

    mkdir -p .build
    cc -O2 -shared -fPIC -I. examples/languages/patic_shared.c -o .build/libpatic.so -lm

    import patic                                       # PATIC_LIBRARY=.build/libpatic.so
    f = patic.field(corner, offset, normal, rank=6, cells=1.5)
    f.order, f.direction                               # of each cell
    f.sum + f.boundary, f.chi                          # charges and boundary terms, and what they make up
    f.defects["x"], f.defects["charge"]

corner (N, 2) or (N, 3): the corners of all outlines, one outline after the other; offset (count + 1,); normal (N, 3) for
a surface in space, None in the plane, and radius=R for a sphere. The field is averaged over the cells within `ball`, a
length, or `cells` mean distances of neighbours. What is refused has a status besides 0 in f.status, zeros elsewhere.
"""
import ctypes
import os
import types

import numpy as np

_HERE = os.path.dirname(os.path.abspath(__file__))
_lib = ctypes.CDLL(os.environ.get("PATIC_LIBRARY", os.path.join(_HERE, "../../.build/libpatic.so")))


class _Arrays(ctypes.Structure):
    _fields_ = ([(name, ctypes.c_void_p) for name in
                 ("status", "centre", "normal", "direction", "mu", "order", "defect")]
                + [("defects", ctypes.c_long), ("chi", ctypes.c_long)]
                + [(name, ctypes.c_double) for name in ("sum", "boundary", "spacing")])


_lib.patic_measure.argtypes = [ctypes.c_int] + 3 * [ctypes.c_void_p] + [
    ctypes.c_size_t, ctypes.c_double, ctypes.c_int, ctypes.c_double, ctypes.c_double, ctypes.POINTER(_Arrays)]
_PLANE, _SPHERE, _EMBEDDED = 0, 1, 2


def field(corner, offset, normal=None, rank=2, *, ball=0.0, cells=None, radius=None, weld=-1.0):
    """The field of one rank; see above. Raises ValueError if the arrays do not fit together."""
    corner = np.ascontiguousarray(corner, float)
    offset = np.ascontiguousarray(offset, np.uintp)
    kind = _SPHERE if radius is not None else _PLANE if normal is None else _EMBEDDED
    if corner.ndim != 2 or corner.shape[1] != (2 if kind == _PLANE else 3):
        raise ValueError("corner is (N, 2) in the plane, (N, 3) with normals or on a sphere")
    if offset.ndim != 1 or len(offset) < 1 or offset[0] != 0 or offset[-1] != len(corner):
        raise ValueError("offset goes from 0 to the number of corners")
    if rank < 1 or ball < 0 or (cells is not None and cells < 0):
        raise ValueError("rank is at least 1, and no radius is negative")
    if kind == _EMBEDDED:
        normal = np.ascontiguousarray(normal, float)
        if normal.shape != corner.shape:
            raise ValueError("normal has the shape of corner")
    count = len(offset) - 1
    out = types.SimpleNamespace(
        status=np.zeros(count, np.intc), centre=np.zeros((count, 3)), normal=np.zeros((count, 3)),
        direction=np.zeros((count, 3)), mu=np.zeros(count), order=np.zeros(count))
    defect = np.zeros((len(corner) // 2 + count, 6))
    arrays = _Arrays(*(getattr(out, name).ctypes.data for name in
                       ("status", "centre", "normal", "direction", "mu", "order")), defect.ctypes.data)
    if _lib.patic_measure(kind, corner.ctypes.data, normal.ctypes.data if kind == _EMBEDDED else None,
                          offset.ctypes.data, count, radius or 1.0, rank, ball if cells is None else -float(cells),
                          weld, ctypes.byref(arrays)):
        raise ValueError("offset falls, or rank, radius or weld is no number")
    defect = defect[:arrays.defects]
    out.defects = {"x": defect[:, :3], "charge": defect[:, 3], "order": defect[:, 4], "margin": defect[:, 5]}
    out.chi, out.sum, out.boundary, out.spacing = arrays.chi, arrays.sum, arrays.boundary, arrays.spacing
    return out
