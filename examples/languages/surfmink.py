"""surfmink from Python: numpy arrays in, numpy arrays out, nothing copied on the way in.

    make shared                                        # builds .build/libsurfmink.so
    SURFMINK_LIBRARY=.build/libsurfmink.so python3 examples/languages/cells.py

    import numpy, surfmink
    octant = numpy.array([[0., 0, 1], [1, 0, 0], [0, 1, 0]])
    surfmink.sphere(octant).mu[3]                      # 1: a triangle
    surfmink.sphere(corner, offset).mu[:, 6]           # of many outlines: mu_6 of each

One file to copy; needs numpy and the library. That is looked for at $SURFMINK_LIBRARY, beside this file, where
`make shared` puts it, and where the system looks for libraries. What L, S, mu, g and theta are, and which outlines are
refused, says surfmink.h.

plane, sphere, embedded and surface measure outlines,
curve_plane, curve_sphere and curve_embedded the smooth curves through the corners, with an estimate of their error,
gradient_plane, gradient_sphere and gradient_embedded outlines, and the gradient of an energy by corners and normals,
director_plane, director_sphere and director_embedded outlines, and their directions at the centre. All take
    corner    (N, 2) or (N, 3) numbers: the corners of all outlines, one outline after the other
    offset    (count + 1,) whole numbers: outline i has the corners offset[i] ... offset[i + 1] - 1.
              None: the corners are one outline
    max_rank  P >= 0
and return Results. A numpy array must be C-contiguous and float64 (offset: int64 or uint64), as it is handed to C as it
is: what would have to be copied is refused with a TypeError or ValueError that says how. Lists are converted.
Of one outline (offset=None) a refusal raises Refused; of many it is an entry in Results.status, and no other outline is
disturbed. Calls let other threads of Python run.
"""
import ctypes
import ctypes.util
import os

import numpy as np

# --- the C side -------------------------------------------------------------------------------------------------------

ABI = "0.3"  # of the library: numbers of the version that decide whether this file fits it


class _Functionals(ctypes.Structure):
    _fields_ = [(name, ctypes.c_double) for name in ("area", "length", "turning", "curvature", "condition")]


class _Results(ctypes.Structure):
    _fields_ = [(name, ctypes.c_void_p)
                for name in ("status", "bad", "length", "turning", "area", "mu", "g", "theta")]


class _Weights(ctypes.Structure):
    _fields_ = [(name, ctypes.c_void_p) for name in ("mu", "g", "theta", "length")] + [("shared", ctypes.c_size_t)]


_double_p = ctypes.POINTER(ctypes.c_double)
_Log = ctypes.CFUNCTYPE(ctypes.c_int, ctypes.c_void_p, _double_p, _double_p, _double_p, _double_p)
_Exp = ctypes.CFUNCTYPE(ctypes.c_int, ctypes.c_void_p, _double_p, _double_p, ctypes.c_double, _double_p)


class _Surface(ctypes.Structure):
    _fields_ = [("context", ctypes.c_void_p), ("stride", ctypes.c_size_t), ("log", _Log), ("exp", _Exp)]


# What is called of the library. A further function is a line here and a call of _library.
_array, _count, _int, _double = ctypes.c_void_p, ctypes.c_size_t, ctypes.c_int, ctypes.c_double
_w, _size_p, _out = ctypes.POINTER(_Functionals), ctypes.POINTER(ctypes.c_size_t), ctypes.POINTER(_Results)
_weights_p = ctypes.POINTER(_Weights)
_signatures = {
    "strerror": (ctypes.c_char_p, [_int]),
    "status_name": (ctypes.c_char_p, [_int]),
    "measure_plane": (_int, [_array, _count, _int, _array, _array, _w, _size_p]),
    "measure_sphere": (_int, [_array, _count, _double, _int, _array, _array, _w, _size_p]),
    "measure_embedded": (_int, [_array, _array, _count, _int, _array, _array, _w, _size_p]),
    "measure_surface": (_int, [ctypes.POINTER(_Surface), _array, _count, _array, _int, _array, _array, _w, _size_p]),
    "batch_plane": (_count, [_array, _array, _count, _int, _out, _array]),
    "batch_sphere": (_count, [_array, _array, _count, _double, _int, _out, _array]),
    "batch_embedded": (_count, [_array, _array, _array, _count, _int, _out, _array]),
    "curve_plane": (_int, [_array, _array, _count, _int, _int] + 4 * [_array] + [_w, _size_p]),
    "curve_sphere": (_int, [_array, _array, _count, _double, _int, _int] + 4 * [_array] + [_w, _size_p]),
    "curve_embedded": (_int, [_array, _array, _array, _count, _int, _int] + 4 * [_array] + [_w, _size_p]),
    "gradient_plane": (_int, [_array, _count, _int, _weights_p, _array, _array, _w, _array, _array, _size_p]),
    "gradient_sphere": (_int, [_array, _count, _double, _int, _weights_p, _array, _array, _w, _array, _array, _size_p]),
    "gradient_embedded": (_int, [_array, _array, _count, _int, _weights_p, _array, _array, _w] + 3 * [_array] +
                          [_size_p]),
    "batch_gradient_plane": (_count, [_array, _array, _count, _int, _weights_p, _out, _array, _array]),
    "batch_gradient_sphere": (_count, [_array, _array, _count, _double, _int, _weights_p, _out, _array, _array]),
    "batch_gradient_embedded": (_count, [_array, _array, _array, _count, _int, _weights_p, _out] + 3 * [_array]),
    "edges_plane": (_int, [_array, _count, _array, _array, _size_p]),
    "edges_sphere": (_int, [_array, _count, _double, _array, _array, _size_p]),
    "edges_embedded": (_int, [_array, _array, _count, _array, _array, _size_p]),
    "phases": (_int, [_array, _count, _int, _array]),
    "director_plane": (_int, [_array, _count, _array, _array, _array, _int] + 4 * [_array]),
    "director_sphere": (_int, [_array, _count, _array, _array, _array, _int] + 4 * [_array]),
    "director_embedded": (_int, [_array, _array, _count, _array, _array, _array, _int] + 5 * [_array]),
    "spectrum": (_int, [_array, _int, _array, _array, _array]),
    "angles": (_int, [_array, _int, _int, _array]),
    "from_lonlat": (_int, [_double, _double, _double, _array]),
    "regular_polygon": (_int, [ctypes.POINTER(_Surface), _array, _double, _double, _count, _array]),
    "edge_points": (_int, [ctypes.POINTER(_Surface), _array, _array, _count, _array]),
}


def _places():
    """Where the library may be, the best place first."""
    named = os.environ.get("SURFMINK_LIBRARY")
    if named:
        return [named]
    here = os.path.dirname(os.path.abspath(__file__))
    files = ["libsurfmink.so." + ABI, "libsurfmink.so", "libsurfmink." + ABI + ".dylib", "libsurfmink.dylib",
             "surfmink.dll"]
    folders = [here, os.path.join(here, os.pardir, os.pardir, ".build")] # the second one in a clone, after make shared
    beside = [os.path.join(folder, file) for folder in folders for file in files]
    beside = [place for place in beside if os.path.exists(place)]
    found = ctypes.util.find_library("surfmink")
    return beside + files + ([found] if found else [])


def _load():
    tried = []
    for place in _places():
        try:
            library = ctypes.CDLL(place)
        except OSError as error:
            tried.append("%s: %s" % (place, error))
            continue
        for name, (result, arguments) in _signatures.items():
            function = getattr(library, "surfmink_" + name, None)
            if function is None:
                raise ImportError("%s has no surfmink_%s: it is not of version %s" % (place, name, ABI))
            function.restype, function.argtypes = result, arguments
        return library
    raise ImportError("the library surfmink was not found; `make shared` builds it, and SURFMINK_LIBRARY=FILE or a "
                      "copy beside surfmink.py shows where it is. Tried:\n  " + "\n  ".join(tried))


_library = _load()

# --- statuses ---------------------------------------------------------------------------------------------------------

STATUS_NAMES = []  # of status 0, 1, 2, ...: "ok", "too_few_corners", ...
while _library.surfmink_status_name(len(STATUS_NAMES)):
    STATUS_NAMES.append(_library.surfmink_status_name(len(STATUS_NAMES)).decode())

OK = 0
_CALLBACK_FAILED = STATUS_NAMES.index("callback_failed")


class Refused(ValueError):
    """An outline that cannot be measured, or an argument without sense.

    name      what is wrong: one of STATUS_NAMES
    status    its number
    corner    the corner to blame, or None where it is the whole outline or no outline at all
    outline   which outline of a batch, else None
    """

    def __init__(self, name, corner=None, outline=None):
        self.name = name
        self.status = STATUS_NAMES.index(name)
        self.corner = corner
        self.outline = outline
        where = "" if outline is None else "outline %d: " % outline
        at = "" if corner is None else " (corner %d)" % corner
        super().__init__("%s%s: %s%s" % (where, name, _library.surfmink_strerror(self.status).decode(), at))


def _check(status, bad=None, n=None):
    if status != OK:
        raise Refused(STATUS_NAMES[status], bad if bad is not None and bad < n else None)


# --- arguments --------------------------------------------------------------------------------------------------------

def _numbers(name, array, kind):
    """The array with numbers of this kind, float or complex; never a copy of a numpy array."""
    if not isinstance(array, np.ndarray):
        array = np.array(array, dtype=kind)
    if array.dtype != kind:
        raise TypeError("%s has dtype %s, not %s: %s.astype(%s) makes a copy that has" % (
            name, array.dtype, np.dtype(kind), name, kind.__name__))
    return array


def _in_order(name, array):
    if not array.flags.c_contiguous or not array.flags.aligned:
        raise ValueError("%s does not lie in memory row after row: numpy.ascontiguousarray(%s) makes a copy that does"
                         % (name, name))
    return array


def _doubles(name, array, columns):
    """The array as C can read it, (n, columns) doubles one after the other; never a copy of a numpy array."""
    array = _numbers(name, array, float)
    if array.ndim != 2 or (columns is not None and array.shape[1] != columns):
        raise ValueError("%s has the shape %s, not (corners, %s)" % (name, array.shape, columns or "stride"))
    return _in_order(name, array)


def _with_normals(corner, normal):
    corner, normal = _doubles("corner", corner, 3), _doubles("normal", normal, 3)
    if len(corner) != len(normal):
        raise ValueError("%d corners, but %d normals" % (len(corner), len(normal)))
    return corner, normal


def _offsets(offset, corners):
    """The offsets as size_t; an array of 64-bit whole numbers is not copied."""
    if offset is None:
        return None
    if not isinstance(offset, np.ndarray):
        offset = np.array(offset, dtype=np.int64)
    if offset.dtype not in (np.int64, np.uint64) or offset.dtype.itemsize != np.dtype(np.uintp).itemsize:
        raise TypeError("offset has dtype %s, not int64: offset.astype(int) makes a copy that has" % offset.dtype)
    if offset.ndim != 1 or offset.size < 1:
        raise ValueError("offset has the shape %s, not (outlines + 1,)" % (offset.shape,))
    if not offset.flags.c_contiguous or not offset.flags.aligned:
        raise ValueError("offset does not lie in memory one after the other: numpy.ascontiguousarray(offset) makes a "
                         "copy that does")
    if offset.min() < 0 or offset.max() > corners:
        raise ValueError("offset has entries that are not between 0 and the number of corners, %d" % corners)
    return offset.view(np.uintp)


def _rank(max_rank):
    max_rank = int(max_rank)
    if not 0 <= max_rank < 2 ** 31 - 1:
        raise Refused("bad_argument")
    return max_rank


def _order(order):
    if order not in (2, 4):
        raise Refused("bad_argument")
    return int(order)


def _sharp(sharp, corners):
    """Which corners are sharp, one byte each; an array of bool or uint8 is not copied."""
    if sharp is None:
        return None
    if not isinstance(sharp, np.ndarray):
        sharp = np.array(sharp, dtype=bool)
    if sharp.dtype not in (np.bool_, np.uint8):
        raise TypeError("sharp has dtype %s, not bool: sharp.astype(bool) makes a copy that has" % sharp.dtype)
    if sharp.shape != (corners,):
        raise ValueError("sharp has the shape %s, not (%d,): True or False for each corner" % (sharp.shape, corners))
    return _in_order("sharp", sharp)


def _weights(given, max_rank, count):
    """The weights as C can read them: each one set for all `count` outlines, or each one for every outline. `given` are
    mu, g, theta and length, in this order; count is None for one outline alone. No copy of a numpy array."""
    kept, shared = [], {}
    for name, array in zip(("mu", "g", "theta", "length"), given):
        if array is not None:
            array = _numbers(name, array, complex if name == "g" else float)
            one = () if name == "length" else (max_rank + 1,)
            if array.shape != one and (count is None or array.shape != (count,) + one):
                raise ValueError("%s has the shape %s, not %s%s" % (
                    name, array.shape, one, "" if count is None else " or %s" % ((count,) + one,)))
            shared[name] = array.shape == one
            _in_order(name, array)
        kept.append(array)
    if len(set(shared.values())) == 2:
        raise ValueError("%s: one for all outlines, but %s: one of each; numpy.full(shape, value) makes one of each" % (
            ", ".join(name for name in shared if shared[name]),
            ", ".join(name for name in shared if not shared[name])))
    weights = _Weights(*(_at(array) for array in kept), all(shared.values()))
    weights.kept = kept  # the struct has only their addresses
    return weights


def _at(array):
    return None if array is None else array.ctypes.data


# --- results ----------------------------------------------------------------------------------------------------------

class Results:
    """What was measured. Arrays have one entry an outline; those of one outline (offset=None) have no such axis.

    L, S, area    length, total turning (2 pi - enclosed curvature); area, 0 where the surface does not tell it
    mu, theta     (count, P + 1): mu_p in [0, 1]; angle of the first eigenvector at the middle of edge 0, from the outer
                  co-normal towards the edge, radians in (-pi/p, pi/p]: noise where mu_p is
    g             (count, P + 1) complex: irreducible components, as the library wrote them
    status, bad   0 or why it was refused; then the corner to blame, or the number of corners. Numbers of a refused
                  outline are NaN
    w             only of one outline: area, length, turning, curvature and condition
    What is not asked for is None:
    error                   of curves (count, P + 1): how far mu_p may be off; error[0] is that of L, over L
    by_corner, by_normal    of gradients: dE/dx_i and dE/dn_i, as corner (N, 2 or 3) and normal (N, 3); no axis for
                            outlines. NaN where no outline was measured
    centre, mean_normal     of directors (count, 2 or 3): means of points and of unit normals; no normal in the plane
    direction, coherence    of directors (count, P + 1, 2 or 3), unit; (count, P + 1), how well the edges agree on it: 1
                            if all do. The first eigenvector of rank p at the centre, the others follow in steps of
                            2 pi / p: noise where mu_p or the coherence is. 0 for rank 0
    """

    _of_each = ("L", "S", "area", "mu", "theta", "g")  # arrays of numbers with an axis for outlines

    def __init__(self, count, max_rank, **more):
        """more: further arrays, with the shape of each without the axis for outlines."""
        self.status = np.zeros(count, dtype=np.intc)
        self.bad = np.zeros(count, dtype=np.uintp)
        self.L, self.S, self.area = (np.full(count, np.nan) for _ in range(3))
        self.mu, self.theta = (np.full((count, max_rank + 1), np.nan) for _ in range(2))
        self.g = np.full((count, max_rank + 1), complex(np.nan, np.nan))
        self.w = self.error = self.by_corner = self.by_normal = None
        self.centre = self.mean_normal = self.direction = self.coherence = None
        for name, shape in more.items():
            setattr(self, name, np.full((count,) + shape, np.nan))
        self._of_each += tuple(more)

    def _addresses(self):
        return _Results(*(_at(a) for a in (self.status, self.bad, self.L, self.S, self.area, self.mu, self.g,
                                           self.theta)))

    @property
    def ok(self):
        """True where the outline was measured."""
        return self.status == OK

    @property
    def names(self):
        """Each status as a word: "ok", "clockwise", ..."""
        return np.array(STATUS_NAMES)[self.status]

    def check(self):
        """Raises Refused for the first outline that was refused; else returns the results."""
        refused = np.flatnonzero(self.status)
        if refused.size:
            i = int(refused[0])
            corner = int(self.bad[i])
            raise Refused(STATUS_NAMES[self.status[i]], corner if corner < self._corners(i) else None, i)
        return self

    def _corners(self, i):
        return int(self._offset[i + 1]) - int(self._offset[i])

    def _of_one(self):
        for name in ("status", "bad") + self._of_each:
            setattr(self, name, getattr(self, name)[0])
        return self


def _one(function, n, max_rank, arguments):
    """One outline by surfmink_measure_*: `arguments` come before those that are the same for all surfaces."""
    results, w, bad = Results(1, max_rank), _Functionals(), ctypes.c_size_t(0)
    status = function(*arguments, max_rank, _at(results.mu), _at(results.g), ctypes.byref(w), ctypes.byref(bad))
    _check(status, bad.value, n)
    _check(_library.surfmink_spectrum(_at(results.g), max_rank, None, None, _at(results.theta)))
    results.w, results.L[0], results.S[0], results.area[0] = w, w.length, w.turning, w.area
    return results._of_one()


def _many(corner, offset, max_rank, flat, call):
    """Many by surfmink_batch_*, as call((offset, count), (max_rank, out, scratch)) does it. Outlines of more than 64
    corners, unless flat, go faster with memory to work in."""
    results = Results(offset.size - 1, max_rank)
    results._offset = offset
    long = not flat and np.any(offset[1:] > offset[:-1] + np.uintp(64))
    scratch = np.empty(2 * len(corner)) if long else None
    call((_at(offset), offset.size - 1), (max_rank, ctypes.byref(results._addresses()), _at(scratch)))
    return results


def _each(one, corners, offset, max_rank, **more):
    """Outlines one by one: one(rows) measures that of these corners, or raises Refused. more: as of Results."""
    if offset is None:
        return one(slice(0, corners))
    results = Results(offset.size - 1, max_rank, **more)
    results._offset = offset
    for i in range(offset.size - 1):
        if offset[i + 1] < offset[i] or offset[i + 1] > offset[-1]:
            results.status[i] = STATUS_NAMES.index("bad_argument")
            continue
        try:
            single = one(slice(int(offset[i]), int(offset[i + 1])))
        except Refused as refused:
            results.status[i] = refused.status
            results.bad[i] = results._corners(i) if refused.corner is None else refused.corner
            continue
        for name in results._of_each:
            getattr(results, name)[i] = getattr(single, name)
    return results


# --- the four kinds of surfaces ---------------------------------------------------------------------------------------

def plane(corner, offset=None, max_rank=6):
    """Outlines of the plane. corner (N, 2)."""
    corner, max_rank = _doubles("corner", corner, 2), _rank(max_rank)
    offset = _offsets(offset, len(corner))
    if offset is None:
        return _one(_library.surfmink_measure_plane, len(corner), max_rank, (_at(corner), len(corner)))
    return _many(corner, offset, max_rank, True,
                 lambda which, rest: _library.surfmink_batch_plane(_at(corner), *which, *rest))


def sphere(corner, offset=None, radius=1.0, max_rank=6):
    """Outlines of great-circle arcs. corner (N, 3), of which only directions count; radius gives the unit of L."""
    corner, max_rank = _doubles("corner", corner, 3), _rank(max_rank)
    offset = _offsets(offset, len(corner))
    if offset is None:
        return _one(_library.surfmink_measure_sphere, len(corner), max_rank, (_at(corner), len(corner), radius))
    return _many(corner, offset, max_rank, False,
                 lambda which, rest: _library.surfmink_batch_sphere(_at(corner), *which, radius, *rest))


def embedded(corner, normal, offset=None, max_rank=6):
    """Outlines of straight chords on a surface in space. corner (N, 3), outer normals (N, 3) of any length."""
    (corner, normal), max_rank = _with_normals(corner, normal), _rank(max_rank)
    offset = _offsets(offset, len(corner))
    if offset is None:
        return _one(_library.surfmink_measure_embedded, len(corner), max_rank, (_at(corner), _at(normal), len(corner)))
    return _many(corner, offset, max_rank, False,
                 lambda which, rest: _library.surfmink_batch_embedded(_at(corner), _at(normal), *which, *rest))


class Surface:
    """Any surface, by two functions of Python: for trying surfaces out, as calls of Python are slow.

    stride              numbers a point
    log(x, y)           the geodesic from x to y: returns (length, (a, b)), with its direction at x in an oriented
                        orthonormal frame there of your choice, the same one each time
    exp(x, (a, b), d)   the point at distance d from x in that direction; only for regular_polygon and edge_points
    x and y are arrays of `stride` numbers. Raise Refused(name) to refuse an outline by name; any other exception ends
    the measurement and is raised again from it.
    """

    def __init__(self, stride, log, exp=None):
        self.stride, self.log, self.exp = int(stride), log, exp
        self._error = None
        self._struct = _Surface(None, self.stride, _Log(self._log), _Exp(self._exp) if exp else _Exp())

    def _guarded(self, answer):
        try:
            answer()
            return OK
        except Refused as refused:
            return refused.status or _CALLBACK_FAILED
        except BaseException as error:  # it must not pass through C
            self._error = error
            return _CALLBACK_FAILED

    def _point(self, x):
        return np.ctypeslib.as_array(x, (self.stride,)).copy()

    def _log(self, context, x, y, length, direction):
        def answer():
            distance, (a, b) = self.log(self._point(x), self._point(y))
            length[0], direction[0], direction[1] = distance, a, b
        return self._guarded(answer)

    def _exp(self, context, x, direction, length, y):
        def answer():
            point = self.exp(self._point(x), (direction[0], direction[1]), length)
            for i in range(self.stride):
                y[i] = point[i]
        return self._guarded(answer)

    def _call(self, function, *arguments):
        self._error = None
        status = function(ctypes.byref(self._struct), *arguments)
        if self._error is not None:
            raise self._error
        return status

    def regular_polygon(self, centre, distance, n, angle=0.0):
        """n corners at a distance from a centre, counter-clockwise: (n, stride)."""
        corner = np.empty((n, self.stride))
        centre = _doubles("centre", np.array(centre, float).reshape(1, -1), self.stride)
        _check(self._call(_library.surfmink_regular_polygon, _at(centre), distance, angle, n, _at(corner)))
        return corner

    def edge_points(self, x, y, m):
        """m points of the geodesic from x to y, without y: (m, stride)."""
        point = np.empty((m, self.stride))
        x, y = (_doubles("x", np.array(end, float).reshape(1, -1), self.stride) for end in (x, y))
        _check(self._call(_library.surfmink_edge_points, _at(x), _at(y), m, _at(point)))
        return point


def surface(surface, corner, offset=None, max_rank=6):
    """Geodesic outlines of a Surface. corner (N, stride). Outlines are measured one by one."""
    corner, max_rank = _doubles("corner", corner, surface.stride), _rank(max_rank)
    offset = _offsets(offset, len(corner))

    def function(*arguments):
        return surface._call(_library.surfmink_measure_surface, *arguments)

    def one(rows):
        n = rows.stop - rows.start
        scratch = np.empty(2 * n or 1)
        return _one(function, n, max_rank, (_at(corner[rows]), n, _at(scratch)))
    return _each(one, len(corner), offset, max_rank)


# --- smooth curves ----------------------------------------------------------------------------------------------------

def _curve(function, arrays, radius, offset, max_rank, order, sharp):
    """arrays: corners, and normals if there are any; radius: () where there is none."""
    corners, max_rank, order = len(arrays[0]), _rank(max_rank), _order(order)
    offset, sharp = _offsets(offset, corners), _sharp(sharp, corners)

    def one(rows):
        n = rows.stop - rows.start
        error, scratch = np.empty(max_rank + 1), np.empty(8 * n or 1)
        inputs = [_at(a[rows]) for a in arrays] + [None if sharp is None else _at(sharp[rows]), n]

        def curve(rank, mu, *rest):
            return function(*inputs, *radius, order, rank, _at(scratch), mu, _at(error), *rest)
        results = _one(curve, n, max_rank, ())
        results.error = error
        return results
    return _each(one, corners, offset, max_rank, error=(max_rank + 1,))


def curve_plane(corner, offset=None, max_rank=6, order=4, sharp=None):
    """Smooth curves of the plane. corner (N, 2) on the curve; sharp (N,) of bool, True where the curve itself has a
    corner; order 4, or 2 for the polygon. 20 corners or so for each bend. Outlines are measured one by one."""
    return _curve(_library.surfmink_curve_plane, (_doubles("corner", corner, 2),), (), offset, max_rank, order, sharp)


def curve_sphere(corner, offset=None, radius=1.0, max_rank=6, order=4, sharp=None):
    """Smooth curves of the sphere. corner (N, 3), the rest as in sphere and curve_plane."""
    return _curve(_library.surfmink_curve_sphere, (_doubles("corner", corner, 3),), (radius,), offset, max_rank, order,
                  sharp)


def curve_embedded(corner, normal, offset=None, max_rank=6, order=4, sharp=None):
    """Smooth curves of a surface in space. corner (N, 3), normal (N, 3) exact ones, the rest as in curve_plane."""
    return _curve(_library.surfmink_curve_embedded, _with_normals(corner, normal), (), offset, max_rank, order, sharp)


# --- gradients --------------------------------------------------------------------------------------------------------

def _gradient(kind, arrays, radius, offset, max_rank, given):
    """kind: of surface; arrays and radius as in _curve; given: as in _weights."""
    corner, max_rank = arrays[0], _rank(max_rank)
    offset = _offsets(offset, len(corner))
    weights = _weights(given, max_rank, None if offset is None else offset.size - 1)
    gradients = [np.full(a.shape, np.nan) for a in arrays]
    scratch = np.empty(6 * len(corner) or 1)
    inputs, outputs = [_at(a) for a in arrays], [_at(a) for a in gradients] + [_at(scratch)]

    def single(rank, *measured_and_bad):
        function = getattr(_library, "surfmink_gradient_" + kind)
        *measured, bad = measured_and_bad
        return function(*inputs, len(corner), *radius, rank, ctypes.byref(weights), *measured, *outputs, bad)

    def batch(which, rest):
        function = getattr(_library, "surfmink_batch_gradient_" + kind)
        function(*inputs, *which, *radius, rest[0], ctypes.byref(weights), rest[1], *outputs)
    if offset is None:
        results = _one(single, len(corner), max_rank, ())
    else:
        results = _many(corner, offset, max_rank, True, batch)
    results.by_corner, results.by_normal = gradients if len(gradients) == 2 else (gradients[0], None)
    return results


def gradient_plane(corner, offset=None, max_rank=6, mu=None, g=None, theta=None, length=None):
    """Measures as plane, and how an energy E of what is measured changes with the corners: by_corner (N, 2), minus the
    force. corner (N, 2). The rest are the derivatives of E, None where it does not depend on that:
    mu, theta     (P + 1,): dE/dmu_p, dE/dtheta_p; the first of each does not count
    g             (P + 1,) complex: dE by the real and by the imaginary part of g_p
    length        a number: dE/dL
    With offset they are for all outlines; or all have an axis more in front, (count, P + 1) and (count,): of each."""
    return _gradient("plane", (_doubles("corner", corner, 2),), (), offset, max_rank, (mu, g, theta, length))


def gradient_sphere(corner, offset=None, radius=1.0, max_rank=6, mu=None, g=None, theta=None, length=None):
    """The same as of sphere: by_corner (N, 3), orthogonal to the corners."""
    return _gradient("sphere", (_doubles("corner", corner, 3),), (radius,), offset, max_rank, (mu, g, theta, length))


def gradient_embedded(corner, normal, offset=None, max_rank=6, mu=None, g=None, theta=None, length=None):
    """The same as of embedded: by_corner (N, 3) at fixed normals, and by_normal (N, 3), orthogonal to the normals.
    Where normals are a function of corners, add the derivative of that function times by_normal."""
    return _gradient("embedded", _with_normals(corner, normal), (), offset, max_rank, (mu, g, theta, length))


# --- directions at the centre -----------------------------------------------------------------------------------------

def _director(kind, arrays, radius, offset, max_rank):
    corners, dimension, max_rank = len(arrays[0]), arrays[0].shape[1], _rank(max_rank)
    offset = _offsets(offset, corners)
    measure, edges, director = (getattr(_library, "surfmink_%s_%s" % (step, kind))
                                for step in ("measure", "edges", "director"))
    shapes = {"centre": (dimension,), "mean_normal": (dimension,), "direction": (max_rank + 1, dimension),
              "coherence": (max_rank + 1,)}
    if kind == "plane":
        del shapes["mean_normal"]
    written = [name for name in shapes if not (kind == "sphere" and name == "centre")]

    def one(rows):
        n = rows.stop - rows.start
        inputs = [_at(a[rows]) for a in arrays] + [n]
        results = _one(measure, n, max_rank, (*inputs, *radius))
        length, phase, bad = np.empty(n), np.empty(n), ctypes.c_size_t(0)
        _check(edges(*inputs, *radius, _at(length), _at(phase), ctypes.byref(bad)), bad.value, n)
        _check(_library.surfmink_phases(_at(phase), n, 0, _at(phase)))
        for name in written:
            setattr(results, name, np.empty(shapes[name]))
        _check(director(*inputs, _at(length), _at(phase), _at(results.g), max_rank, _at(phase),
                        *(_at(getattr(results, name)) for name in written)))
        if kind == "sphere":
            results.centre = radius[0] * results.mean_normal
        return results
    return _each(one, corners, offset, max_rank, **shapes)


def director_plane(corner, offset=None, max_rank=6):
    """Measures as plane, and the directions of each outline at its centre, one for each rank. corner (N, 2). Outlines
    are measured one by one."""
    return _director("plane", (_doubles("corner", corner, 2),), (), offset, max_rank)


def director_sphere(corner, offset=None, radius=1.0, max_rank=6):
    """The same as of sphere: directions are orthogonal to mean_normal; the centre is at the radius."""
    return _director("sphere", (_doubles("corner", corner, 3),), (radius,), offset, max_rank)


def director_embedded(corner, normal, offset=None, max_rank=6):
    """The same as of embedded: directions are orthogonal to mean_normal."""
    return _director("embedded", _with_normals(corner, normal), (), offset, max_rank)


# --- helpers ----------------------------------------------------------------------------------------------------------

def pack(outlines):
    """A list of (n, columns) arrays as (corner, offset) for one call. This copies."""
    offset = np.zeros(len(outlines) + 1, dtype=np.int64)
    np.cumsum([len(outline) for outline in outlines], out=offset[1:])
    return np.concatenate([np.asarray(outline, dtype=np.float64) for outline in outlines]), offset


def offsets(ids):
    """Offsets of a table with one corner a row: rows that follow each other with the same id are one outline."""
    ids = np.asarray(ids)
    if ids.size == 0:
        return np.zeros(1, dtype=np.int64)
    return np.concatenate(([0], np.flatnonzero(ids[1:] != ids[:-1]) + 1, [ids.size])).astype(np.int64)


def from_lonlat(lon, lat, radius=1.0):
    """Points of the sphere at longitudes and latitudes in degrees: (N, 3)."""
    lon, lat = np.broadcast_arrays(np.atleast_1d(np.asarray(lon, float)), np.atleast_1d(np.asarray(lat, float)))
    point = np.empty((lon.size, 3))
    for i in range(lon.size):
        _check(_library.surfmink_from_lonlat(lon.flat[i], lat.flat[i], radius, point.ctypes.data + 24 * i), i, lon.size)
    return point


def angles(g, p, sign=1):
    """The p eigenvector angles of rank p of one outline: g as in Results, sign of the eigenvalue."""
    g = np.ascontiguousarray(g, dtype=np.complex128)
    if g.ndim != 1 or not 1 <= p < g.size:
        raise ValueError("g has the shape %s: rank %d is not in it" % (g.shape, p))
    theta = np.empty(p)
    _check(_library.surfmink_angles(_at(g), p, sign, _at(theta)))
    return theta
