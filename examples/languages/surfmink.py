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
director_plane, director_sphere and director_embedded outlines, and their directions at the centre,
field_plane, field_sphere and field_embedded the p-atic field of a tissue, with its defects. All but these take
    corner    (N, 2) or (N, 3) numbers: the corners of all outlines, one outline after the other; plane, sphere and
              embedded also take a list of one such array an outline, and then no offset
    offset    (count + 1,) whole numbers: outline i has the corners offset[i] ... offset[i + 1] - 1.
              None: the corners are one outline
    max_rank  P >= 0
and return Results. A numpy array must be C-contiguous and float64 (offset: int64 or uint64), as it is handed to C as it
is: what would have to be copied is refused with a TypeError or ValueError that says how. So are masked entries. Lists
and whole numbers are converted; merge opens rings whose last corner is the first one again. A call costs tens of
microseconds, most of them in Python: measure many outlines in one.
Of one outline (offset=None) a refusal raises Refused; of many it is an entry in Results.status, and no other outline is
disturbed. Calls let other threads of Python run.
"""
import collections
import ctypes
import ctypes.util
import operator
import os

import numpy as np

# --- the C side -------------------------------------------------------------------------------------------------------

ABI = "0.4"  # of the library: numbers of the version that decide whether this file fits it


_double_p = ctypes.POINTER(ctypes.c_double)
_Log = ctypes.CFUNCTYPE(ctypes.c_int, ctypes.c_void_p, _double_p, _double_p, _double_p, _double_p)
_Exp = ctypes.CFUNCTYPE(ctypes.c_int, ctypes.c_void_p, _double_p, _double_p, ctypes.c_double, _double_p)


class _Surface(ctypes.Structure):
    _fields_ = [("context", ctypes.c_void_p), ("stride", ctypes.c_size_t), ("log", _Log), ("exp", _Exp)]


# What is called of the library: flat.h, and a few functions of surfmink.h. A further one is a line here and a call of
# _library.
_array, _count, _int, _double = ctypes.c_void_p, ctypes.c_size_t, ctypes.c_int, ctypes.c_double
_size_p, _surface_p = ctypes.POINTER(ctypes.c_size_t), ctypes.POINTER(_Surface)
_outline = [_int, _array, _array, _count, _double]  # kind, corner, normal, n, radius
_signatures = {
    "flat_strerror": (ctypes.c_char_p, [_int]),
    "flat_status_name": (ctypes.c_char_p, [_int]),
    "flat_measure": (_int, _outline + [_int] + 3 * [_array] + [_size_p]),
    "flat_measure_surface": (_int, [_surface_p, _array, _count, _int] + 3 * [_array] + [_size_p]),
    "flat_batch": (_count, _outline + [_array, _count, _int] + 9 * [_array]),
    "flat_curve": (_int, _outline + [_int, _array, _int] + 5 * [_array] + [_size_p]),
    "flat_gradient": (_count, _outline + [_array, _count, _int] + 4 * [_array] + [_int] + 9 * [_array]),
    "flat_director": (_int, _outline + [_int] + 8 * [_array] + [_size_p]),
    "flat_patic_scratch": (_count, [_array, _count, _int]),
    "flat_patic": (_int, _outline + [_array, _count, _int, _double, _double] + 8 * [_array] + [_size_p]
                   + 2 * [_array]),
    "spectrum": (_int, [_array, _int, _array, _array, _array]),
    "angles": (_int, [_array, _int, _int, _array]),
    "from_lonlat": (_int, [_double, _double, _double, _array]),
    "regular_polygon": (_int, [_surface_p, _array, _double, _double, _count, _array]),
    "edge_points": (_int, [_surface_p, _array, _array, _count, _array]),
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

def _name(status):
    return _library.surfmink_flat_status_name(status).decode()


STATUS_NAMES = []  # of status 0, 1, 2, ...: "ok", "too_few_corners", ...
while _name(len(STATUS_NAMES)):
    STATUS_NAMES.append(_name(len(STATUS_NAMES)))

OK = 0
_STATUS = {_name(status): status for status in [*range(len(STATUS_NAMES)), 64, 65, 100]}  # of fields, of curves
_CALLBACK_FAILED, _BAD_ARGUMENT = _STATUS["callback_failed"], _STATUS["bad_argument"]


class Refused(ValueError):
    """An outline that cannot be measured, or an argument without sense.

    name      what is wrong: one of STATUS_NAMES, or of curves "unlike_edges", of fields "overlaps", "meets_itself"
    status    its number
    corner    the corner to blame, or None where it is the whole outline or no outline at all
    outline   which outline of a batch, else None
    """

    def __init__(self, name, corner=None, outline=None):
        self.name = name
        self.status = _STATUS[name]
        self.corner = corner
        self.outline = outline
        self.hint = ""
        if name == "coincident_corners":
            self.hint = "; surfmink.merge(corner, offset) drops one of them, as the last one of closed rings"
        where = "" if outline is None else "outline %d: " % outline
        at = "" if corner is None else " (corner %d)" % corner
        super().__init__("%s%s: %s%s%s" % (where, name, _library.surfmink_flat_strerror(self.status).decode(), at,
                                           self.hint))


def _check(status, bad=None, n=None):
    if status != OK:
        raise Refused(_name(status), bad if bad is not None and bad < n else None)


# --- arguments --------------------------------------------------------------------------------------------------------

def _not_masked(name, array):
    """C would read the numbers under the mask as if they counted."""
    if isinstance(array, np.ma.MaskedArray) and np.ma.is_masked(array):
        raise ValueError("%s has masked entries: leave their outlines out, or take numpy.ma.getdata(%s) if the numbers "
                         "count" % (name, name))


def _numbers(name, array, kind):
    """The array with numbers of this kind, float or complex; never a copy of a numpy array."""
    _not_masked(name, array)
    if not isinstance(array, np.ndarray):
        try:
            array = np.array(array, dtype=kind)
        except ValueError as error:
            raise ValueError("%s is not one array of numbers; surfmink.pack makes one of a list of outlines" % name) \
                from error
    if array.dtype.kind == "c" and kind is float:
        raise TypeError("%s is complex: numpy.column_stack([%s.real, %s.imag]) makes x y of it" % (name, name, name))
    if array.dtype != kind:
        raise TypeError("%s has dtype %s, not %s: %s.astype(%s) makes a copy that has" % (
            name, array.dtype, np.dtype(kind), name, kind.__name__))
    return array


def _whole(array):
    """Whole numbers as doubles: pixels, say."""
    is_whole = isinstance(array, np.ndarray) and array.dtype.kind in "iu" and np.ma.getmask(array) is np.ma.nomask
    return array.astype(float) if is_whole else array


def _in_order(name, array):
    if not array.flags.c_contiguous or not array.flags.aligned:
        raise ValueError("%s does not lie in memory row after row: numpy.ascontiguousarray(%s) makes a copy that does"
                         % (name, name))
    return array


def _doubles(name, array, columns):
    """The array as C can read it, (n, columns) doubles one after the other; a numpy array is copied only if it has
    whole numbers."""
    array = _numbers(name, _whole(array), float)
    if array.ndim != 2 or (columns is not None and array.shape[1] != columns):
        raise ValueError("%s has the shape %s, not (corners, %s)%s" % (
            name, array.shape, columns or "stride",
            "; surfmink.pack makes corner and offset of a list of outlines" if array.ndim == 3 else ""))
    return _in_order(name, array)


def _listed(*arrays, offset):
    """Lists of one array an outline become corner and offset; arrays stay as they are."""
    first = arrays[0]
    is_list = isinstance(first, (list, tuple)) and len(first) > 0 and all(np.ndim(outline) == 2 for outline in first)
    if not is_list:
        return (*arrays, offset)
    if offset is not None:
        raise ValueError("a list of outlines has its own offset; give either")
    if any([len(one) for one in other] != [len(one) for one in first] for other in arrays[1:]):
        raise ValueError("the list of normals is not like that of corners")
    for outline in [one for array in arrays for one in array]:
        _numbers("an outline of the list", _whole(outline), float)
    packed = [pack(array) for array in arrays]
    return (*(array for array, _ in packed), packed[0][1])


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
        offset = np.array(offset)
        offset = offset.astype(np.int64) if offset.dtype.kind in "iu" or offset.size == 0 else offset
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
    try:
        max_rank = operator.index(max_rank)
    except TypeError as error:
        raise TypeError("max_rank is %r, not a whole number" % (max_rank,)) from error
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
    """The weights as C can read them, and whether they are shared: each one set for all `count` outlines, or each one
    for every outline. `given` are mu, g, theta and length, in this order; count is None for one outline alone. No copy
    of a numpy array."""
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
    return kept, int(all(shared.values()))


def _at(array):
    return None if array is None else array.ctypes.data


# --- results ----------------------------------------------------------------------------------------------------------

class Results:
    """What was measured. Arrays have one entry an outline; those of one outline (offset=None) have no such axis.

    L, S, area    length, total turning (2 pi - enclosed curvature); area, an estimate on embedded surfaces, NaN on a
                  Surface, which does not tell it
    mu, theta     (count, P + 1): mu_p in [0, 1]; angle of the first eigenvector at the middle of edge 0, from the outer
                  co-normal towards the edge, radians in (-pi/p, pi/p]: noise where mu_p is
    g             (count, P + 1) complex: irreducible components, as the library wrote them
    status, bad   0 or why it was refused; then the corner to blame, or the number of corners. Numbers of a refused
                  outline are NaN
    w             only of one outline: area, length, turning, curvature and condition, by these names
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

    @property
    def ok(self):
        """True where the outline was measured."""
        return self.status == OK

    @property
    def names(self):
        """Each status as a word: "ok", "clockwise", ..."""
        return np.vectorize(_name, otypes=[object])(self.status).astype(str)

    def check(self):
        """Raises Refused for the first outline that was refused; else returns the results."""
        refused = np.flatnonzero(self.status)
        if refused.size:
            i = int(refused[0])
            corner = int(self.bad[i])
            raise Refused(_name(int(self.status[i])), corner if corner < self._corners(i) else None, i)
        return self

    def _corners(self, i):
        return int(self._offset[i + 1]) - int(self._offset[i])

    def _of_one(self):
        for name in ("status", "bad") + self._of_each:
            setattr(self, name, getattr(self, name)[0])
        return self


_Functionals = collections.namedtuple("_Functionals", "area length turning curvature condition")


class _Outlines:
    """Corners with all that C wants to know of them: kind, corner, normal, n, radius."""

    def __init__(self, kind, corner, normal=None, radius=1.0):
        self.kind, self.corner, self.normal, self.radius = kind, corner, normal, radius

    def __len__(self):
        return len(self.corner)

    def __getitem__(self, rows):
        return _Outlines(self.kind, self.corner[rows], None if self.normal is None else self.normal[rows], self.radius)

    def in_c(self):
        return self.kind, _at(self.corner), _at(self.normal), len(self.corner), self.radius


def _plane(corner):
    return _Outlines(0, _doubles("corner", corner, 2))


def _sphere(corner, radius):
    return _Outlines(1, _doubles("corner", corner, 3), radius=radius)


def _embedded(corner, normal):
    return _Outlines(2, *_with_normals(corner, normal))


def _one(n, max_rank, call):
    """One outline, as call((mu, g, w), bad) measures it and returns a status."""
    results, w, bad = Results(1, max_rank), np.empty(5), ctypes.c_size_t(0)
    _check(call((_at(results.mu), _at(results.g), _at(w)), ctypes.byref(bad)), bad.value, n)
    _check(_library.surfmink_spectrum(_at(results.g), max_rank, None, None, _at(results.theta)))
    results.w = _Functionals(*w)
    results.L[0], results.S[0], results.area[0] = results.w.length, results.w.turning, results.w.area
    return results._of_one()


def _measure(outlines, offset, max_rank):
    """Outlines of more than 128 corners go faster with memory to work in."""
    max_rank = _rank(max_rank)
    offset = _offsets(offset, len(outlines))
    if offset is None:
        return _one(len(outlines), max_rank,
                    lambda out, bad: _library.surfmink_flat_measure(*outlines.in_c(), max_rank, *out, bad))
    results = Results(offset.size - 1, max_rank)
    results._offset = offset
    scratch = np.empty(2 * len(outlines)) if np.any(offset[1:] > offset[:-1] + np.uintp(128)) else None
    _library.surfmink_flat_batch(*outlines.in_c(), _at(offset), offset.size - 1, max_rank, *(_at(a) for a in (
        results.status, results.bad, results.L, results.S, results.area, results.mu, results.g, results.theta,
        scratch)))
    return results


def _each(one, corners, offset, max_rank, **more):
    """Outlines one by one: one(rows) measures that of these corners, or raises Refused. more: as of Results."""
    if offset is None:
        return one(slice(0, corners))
    results = Results(offset.size - 1, max_rank, **more)
    results._offset = offset
    for i in range(offset.size - 1):
        if offset[i + 1] < offset[i]:
            results.status[i] = _BAD_ARGUMENT
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
    corner, offset = _listed(corner, offset=offset)
    return _measure(_plane(corner), offset, max_rank)


def sphere(corner, offset=None, radius=1.0, max_rank=6):
    """Outlines of great-circle arcs. corner (N, 3), of which only directions count; radius gives the unit of L."""
    corner, offset = _listed(corner, offset=offset)
    return _measure(_sphere(corner, radius), offset, max_rank)


def embedded(corner, normal, offset=None, max_rank=6):
    """Outlines of straight chords on a surface in space. corner (N, 3), outer normals (N, 3) of any length."""
    corner, normal, offset = _listed(corner, normal, offset=offset)
    return _measure(_embedded(corner, normal), offset, max_rank)


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

    def one(rows):
        n = rows.stop - rows.start
        return _one(n, max_rank, lambda out, bad: surface._call(
            _library.surfmink_flat_measure_surface, _at(corner[rows]), n, max_rank, *out, bad))
    return _each(one, len(corner), offset, max_rank)


# --- smooth curves ----------------------------------------------------------------------------------------------------

def _curve(outlines, offset, max_rank, order, sharp):
    max_rank, order = _rank(max_rank), _order(order)
    offset, sharp = _offsets(offset, len(outlines)), _sharp(sharp, len(outlines))

    def one(rows):
        these, error = outlines[rows], np.empty(max_rank + 1)
        scratch = np.empty(12 * len(these) + 8 * (max_rank + 2))
        flags = None if sharp is None else _at(sharp[rows])

        def call(out, bad):
            mu, *rest = out
            return _library.surfmink_flat_curve(*these.in_c(), order, flags, max_rank, mu, _at(error), *rest,
                                                _at(scratch), bad)
        results = _one(len(these), max_rank, call)
        results.error = error
        return results
    return _each(one, len(outlines), offset, max_rank, error=(max_rank + 1,))


def curve_plane(corner, offset=None, max_rank=6, order=4, sharp=None):
    """Smooth curves of the plane. corner (N, 2) on the curve; sharp (N,) of bool, True where the curve itself has a
    corner; order 4, or 2 for the polygon. 20 corners or so for each bend. Outlines are measured one by one."""
    return _curve(_plane(corner), offset, max_rank, order, sharp)


def curve_sphere(corner, offset=None, radius=1.0, max_rank=6, order=4, sharp=None):
    """Smooth curves of the sphere. corner (N, 3), the rest as in sphere and curve_plane."""
    return _curve(_sphere(corner, radius), offset, max_rank, order, sharp)


def curve_embedded(corner, normal, offset=None, max_rank=6, order=4, sharp=None):
    """Smooth curves of a surface in space. corner (N, 3), normal (N, 3) exact ones, the rest as in curve_plane."""
    return _curve(_embedded(corner, normal), offset, max_rank, order, sharp)


# --- gradients --------------------------------------------------------------------------------------------------------

def _gradient(outlines, offset, max_rank, given):
    """given: as in _weights."""
    max_rank = _rank(max_rank)
    offset = _offsets(offset, len(outlines))
    ends = np.array([0, len(outlines)], dtype=np.uintp) if offset is None else offset
    weights, shared = _weights(given, max_rank, None if offset is None else offset.size - 1)
    results, w = Results(ends.size - 1, max_rank), np.full((ends.size - 1, 5), np.nan)
    results._offset = ends
    results.by_corner = np.full(outlines.corner.shape, np.nan)
    results.by_normal = None if outlines.normal is None else np.full(outlines.normal.shape, np.nan)
    scratch = np.empty(4 * len(outlines) + (2 * max_rank + 2) * (ends.size - 1) + 1)
    _library.surfmink_flat_gradient(
        *outlines.in_c(), _at(ends), ends.size - 1, max_rank, *(_at(a) for a in weights), shared, *(_at(a) for a in (
            results.status, results.bad, results.mu, results.g, results.theta, w, results.by_corner, results.by_normal,
            scratch)))
    results.area, results.L, results.S = (w[:, k].copy() for k in range(3))
    if offset is not None:
        return results
    _check(int(results.status[0]), int(results.bad[0]), len(outlines))
    results.w = _Functionals(*w[0])
    return results._of_one()


def gradient_plane(corner, offset=None, max_rank=6, mu=None, g=None, theta=None, length=None):
    """Measures as plane, and how an energy E of what is measured changes with the corners: by_corner (N, 2), minus the
    force. corner (N, 2). The rest are the derivatives of E, None where it does not depend on that:
    mu, theta     (P + 1,): dE/dmu_p, dE/dtheta_p; the first of each does not count
    g             (P + 1,) complex: dE by the real and by the imaginary part of g_p
    length        a number: dE/dL
    With offset they are for all outlines; or all have an axis more in front, (count, P + 1) and (count,): of each."""
    return _gradient(_plane(corner), offset, max_rank, (mu, g, theta, length))


def gradient_sphere(corner, offset=None, radius=1.0, max_rank=6, mu=None, g=None, theta=None, length=None):
    """The same as of sphere: by_corner (N, 3), orthogonal to the corners."""
    return _gradient(_sphere(corner, radius), offset, max_rank, (mu, g, theta, length))


def gradient_embedded(corner, normal, offset=None, max_rank=6, mu=None, g=None, theta=None, length=None):
    """The same as of embedded: by_corner (N, 3) at fixed normals, and by_normal (N, 3), orthogonal to the normals.
    Where normals are a function of corners, add the derivative of that function times by_normal."""
    return _gradient(_embedded(corner, normal), offset, max_rank, (mu, g, theta, length))


# --- directions at the centre -----------------------------------------------------------------------------------------

def _director(outlines, offset, max_rank):
    dimension, max_rank = outlines.corner.shape[1], _rank(max_rank)
    offset = _offsets(offset, len(outlines))
    shapes = {"centre": (dimension,), "mean_normal": (3,), "direction": (max_rank + 1, dimension),
              "coherence": (max_rank + 1,)}

    def one(rows):
        these = outlines[rows]
        centre, mean_normal = np.empty(3), np.empty(3)
        direction, coherence = np.empty(shapes["direction"]), np.empty(max_rank + 1)
        scratch = np.empty(2 * len(these) + 2 * max_rank + 2)
        results = _one(len(these), max_rank, lambda out, bad: _library.surfmink_flat_director(
            *these.in_c(), max_rank, *out, _at(centre), _at(mean_normal), _at(direction), _at(coherence), _at(scratch),
            bad))
        results.centre, results.direction, results.coherence = centre[:dimension], direction, coherence
        if dimension == 3:
            results.mean_normal = mean_normal
        return results
    if dimension == 2:
        del shapes["mean_normal"]
    return _each(one, len(outlines), offset, max_rank, **shapes)


def director_plane(corner, offset=None, max_rank=6):
    """Measures as plane, and the directions of each outline at its centre, one for each rank. corner (N, 2). Outlines
    are measured one by one."""
    return _director(_plane(corner), offset, max_rank)


def director_sphere(corner, offset=None, radius=1.0, max_rank=6):
    """The same as of sphere: directions are orthogonal to mean_normal; the centre is at the radius."""
    return _director(_sphere(corner, radius), offset, max_rank)


def director_embedded(corner, normal, offset=None, max_rank=6):
    """The same as of embedded: directions are orthogonal to mean_normal."""
    return _director(_embedded(corner, normal), offset, max_rank)


# --- the field of a tissue --------------------------------------------------------------------------------------------

Defects = collections.namedtuple("Defects", "x charge order margin")


class Field(Results):
    """The p-atic field of a tissue: patic.h, and docs/field.md, say what it is.

    status, bad, ok, names, check    as of Results
    centre, mean_normal     (count, 3)
    mu, order               (count,): mu_rank of each outline; |z| of the field, of its mean if there is a ball
    direction               (count, 3), unit: one of `rank`; 0 where there is none
    defects                 x (m, 3), charge, order and margin (m,): charges that are not 0
    components, chi         of the tissue; its Euler characteristic
    charges, boundary       sum of the charges, and of the terms of boundaries. Together they are chi, but where cells
                            are too large for the curvature
    spacing                 mean distance of neighbours
    """

    def __init__(self, offset):
        count = offset.size - 1
        self._offset = offset
        self.status = np.zeros(count, dtype=np.intc)
        self.bad = np.zeros(count, dtype=np.uintp)
        self.mu, self.order = (np.full(count, np.nan) for _ in range(2))
        self.centre, self.mean_normal, self.direction = (np.full((count, 3), np.nan) for _ in range(3))


def _field(outlines, offset, rank, ball, cells, weld):
    rank, offset = _rank(rank), _offsets(offset, len(outlines))
    if offset is None:
        raise ValueError("a field needs offset, which says where each cell begins")
    if offset[0] != 0 or np.any(offset[1:] < offset[:-1]):
        raise ValueError("offset of a field begins with 0 and does not fall")
    if cells is not None and ball != 0:
        raise ValueError("ball and cells are the same distance in two units: give one of them")
    if ball < 0 or (cells is not None and cells < 0) or (weld is not None and weld < 0):
        raise Refused("bad_argument")
    field, totals, found = Field(offset), np.full(5, np.nan), ctypes.c_size_t(0)
    count = offset.size - 1
    defect = np.full((len(outlines) // 2 + count, 6), np.nan)
    scratch = np.empty(_library.surfmink_flat_patic_scratch(_at(offset), count, rank))
    _check(_library.surfmink_flat_patic(
        *outlines.in_c(), _at(offset), count, rank, -1.0 if weld is None else weld, -cells if cells else ball,
        *(_at(a) for a in (field.status, field.bad, field.centre, field.mean_normal, field.direction, field.mu,
                           field.order, defect)), ctypes.byref(found), _at(totals), _at(scratch)))
    defect = defect[:found.value]
    field.defects = Defects(defect[:, :3], *defect[:, 3:].T)
    field.components, field.chi = int(totals[0]), int(totals[1])
    field.charges, field.boundary, field.spacing = (float(total) for total in totals[2:])
    return field


def field_plane(corner, offset, rank=2, ball=0.0, cells=None, weld=None):
    """The field of one rank, 1 to 1000, of a tissue whose outlines share their corners. corner (N, 2).
    ball     mean over the cells within this distance; or
    cells    the same in mean distances of neighbours, as 1.5
    weld     corners nearer than this are one; None: than 1e-6 of the mean edge"""
    return _field(_plane(corner), offset, rank, ball, cells, weld)


def field_sphere(corner, offset, radius=1.0, rank=2, ball=0.0, cells=None, weld=None):
    """The same of a tissue on a sphere. corner (N, 3), of which only directions count."""
    return _field(_sphere(corner, radius), offset, rank, ball, cells, weld)


def field_embedded(corner, normal, offset, rank=2, ball=0.0, cells=None, weld=None):
    """The same of a tissue on a surface in space. corner (N, 3), outer normals (N, 3)."""
    return _field(_embedded(corner, normal), offset, rank, ball, cells, weld)


# --- helpers ----------------------------------------------------------------------------------------------------------

def pack(outlines):
    """A list of (n, columns) arrays as (corner, offset) for one call. This copies, and takes numbers of any kind."""
    for i, outline in enumerate(outlines):
        _not_masked("outlines[%d]" % i, outline)
    offset = np.zeros(len(outlines) + 1, dtype=np.int64)
    np.cumsum([len(outline) for outline in outlines], out=offset[1:])
    return np.concatenate([np.asarray(outline, dtype=np.float64) for outline in outlines]), offset


def merge(corner, offset=None, distance=0.0, normal=None):
    """Without corners that lie within `distance` of the one before, or at the end of the first one: rings that are
    closed are opened. Returns (corner, offset), or only corner of one outline; with normals (corner, normal, offset)."""
    corner, offset_given = _doubles("corner", corner, None), offset
    if normal is not None:
        corner, normal = _with_normals(corner, normal)
    offset = _offsets([0, len(corner)] if offset is None else offset, len(corner)).astype(np.int64)
    kept, count = [], [0]
    for first, end in zip(offset[:-1], offset[1:]):
        rows = []
        for i in range(first, end):
            if not rows or not np.linalg.norm(corner[i] - corner[rows[-1]]) <= distance:
                rows.append(i)
        while len(rows) > 1 and np.linalg.norm(corner[rows[0]] - corner[rows[-1]]) <= distance:
            rows.pop()
        kept += rows
        count.append(len(kept))
    some = (corner[kept],) + (() if normal is None else (normal[kept],))
    if offset_given is not None:
        some += (np.array(count),)
    return some if len(some) > 1 else some[0]


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
