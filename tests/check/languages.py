"""languages.py COMMAND TISSUE: holds examples/languages/surfmink.py to what it says. Needs numpy and the library."""
import math
import subprocess
import sys
import traceback

sys.dont_write_bytecode = True
sys.path.insert(0, "examples/languages")

import numpy as np
import surfmink

command, tissue_table = sys.argv[1:]
theorems = []


def theorem(statement):
    theorems.append(statement)
    return statement


def raises(kind, words, call, *arguments, **named):
    """The call raises this kind of error, with these words in its message; returns the error."""
    try:
        call(*arguments, **named)
    except kind as error:
        for word in words.split("|"):
            assert word in str(error), "%r lacks %r" % (str(error), word)
        return error
    raise AssertionError("%s was not raised" % kind.__name__)


def near(got, want, within=1e-14):
    error = np.max(np.abs(np.asarray(got) - np.asarray(want)))
    assert error <= within, "%r and %r differ by %g" % (got, want, error)


square = np.array([[0., 0], [1, 0], [1, 1], [0, 1]])
octant = np.array([[0., 0, 1], [1, 0, 0], [0, 1, 0]])


def blobs(count, dimension, seed, corners=None):
    """Round outlines of random corners; in space about the direction (1, 2, 2)."""
    random = np.random.default_rng(seed)
    frame = np.array([[2, -2, 1], [2, 1, -2]]) / 3 if dimension == 3 else np.eye(2)
    centre = np.array([1, 2, 2]) if dimension == 3 else np.zeros(2)
    outlines = []
    for _ in range(count):
        n = corners or int(random.integers(3, 12))
        angle = (np.arange(n) + random.uniform(0, .7, n)) * 2 * math.pi / n
        outlines.append(centre + (np.c_[np.cos(angle), np.sin(angle)] * random.uniform(.5, .6, (n, 1))) @ frame)
    return outlines


# --- what comes out ---------------------------------------------------------------------------------------------------

@theorem
def a_square_is_a_square():
    one = surfmink.plane(square, max_rank=8)
    near(one.mu, [1, 0, 0, 0, 1, 0, 0, 0, 1])
    near([one.L, one.S, one.area], [4, 2 * math.pi, 1])
    near(one.g[4], 4 + 0j)
    near(surfmink.angles(one.g, 4), np.arange(4) * math.pi / 2)
    near(surfmink.angles(one.g, 4, -1), (np.arange(4) + .5) * math.pi / 2)


@theorem
def an_octant_is_a_triangle_on_a_sphere_of_any_radius():
    for corner in (octant, 7 * octant, octant.tolist()):
        one = surfmink.sphere(corner, radius=2.0)
        near(one.mu, [1, 0, 0, 1, 0, 0, 1])
        near([one.L, one.S, one.area], [3 * math.pi, 3 * math.pi / 2, 2 * math.pi])
        near([one.w.curvature, one.w.condition], [math.pi / 2, 1])


@theorem
def on_an_embedded_sphere_corners_are_normals():
    near(surfmink.embedded(octant, 5 * octant).mu, [1, 0, 0, 1, 0, 0, 1])


@theorem
def a_batch_says_what_single_calls_say():
    for measure, dimension, seed in ((surfmink.plane, 2, 1), (surfmink.sphere, 3, 2), (surfmink.embedded, 3, 3)):
        outlines = blobs(70, dimension, seed) + blobs(3, dimension, seed, 200)
        corner, offset = surfmink.pack(outlines)
        many = measure(*[corner] * (2 if measure is surfmink.embedded else 1), offset, max_rank=12).check()
        for i, outline in enumerate(outlines):
            one = measure(*[outline] * (2 if measure is surfmink.embedded else 1), max_rank=12)
            near(many.mu[i], one.mu, 4e-14)
            near(many.g[i], one.g, 4e-14 * one.L)
            near(many.mu[i] * np.exp(1j * many.theta[i] * np.arange(13)), one.g / one.L, 4e-14)
            near([many.L[i], many.S[i], many.area[i]], [one.L, one.S, one.area], 4e-15 * 2 * math.pi)


@theorem
def the_command_says_the_same_to_the_last_bit():
    lines = subprocess.run([command, "--max-rank", "7", tissue_table], capture_output=True, text=True, check=True)
    names, *rows = [line.split("\t") for line in lines.stdout.splitlines()]
    table = np.loadtxt(tissue_table, skiprows=4)
    corner, normal = table[:, 1:4].copy(), table[:, 4:7].copy()
    cells = surfmink.embedded(corner, normal, surfmink.offsets(table[:, 0]), max_rank=7).check()
    assert len(rows) == len(cells.L) == 400
    for i, row in enumerate(rows):
        field = dict(zip(names, row))
        assert float(field["L"]) == cells.L[i] and float(field["S"]) == cells.S[i]
        for p in range(1, 8):
            assert float(field["mu_%d" % p]) == cells.mu[i, p]
            assert float(field["theta_%d" % p]) == cells.theta[i, p]


# --- what is refused --------------------------------------------------------------------------------------------------

@theorem
def one_outline_that_is_wrong_raises_its_name_and_corner():
    error = raises(surfmink.Refused, "coincident_corners|(corner 2)", surfmink.plane, square[[0, 1, 1, 2]])
    assert (error.name, error.status, error.corner, error.outline) == ("coincident_corners", 3, 2, None)
    error = raises(surfmink.Refused, "clockwise", surfmink.plane, square[::-1].copy())
    assert error.corner is None
    raises(surfmink.Refused, "too_few_corners", surfmink.plane, square[:2])
    raises(surfmink.Refused, "bad_argument", surfmink.sphere, octant, radius=-1.0)
    raises(surfmink.Refused, "bad_argument", surfmink.plane, square, max_rank=-1)
    raises(surfmink.Refused, "upright_edge", surfmink.embedded, octant, octant - octant[[1, 2, 0]])


@theorem
def in_a_batch_it_is_an_entry_and_disturbs_no_other():
    corner, offset = surfmink.pack([square, square[::-1], square[[0, 1, 1, 2]], square])
    many = surfmink.plane(corner, offset)
    assert list(many.names) == ["ok", "clockwise", "coincident_corners", "ok"]
    assert list(many.ok) == [True, False, False, True]
    assert (many.bad[1], many.bad[2]) == (4, 2)
    assert np.isnan(many.mu[1:3]).all() and np.isnan(many.L[1:3]).all() and np.isnan(many.g[1:3]).all()
    near(many.mu[[0, 3], 4], 1)
    error = raises(surfmink.Refused, "outline 1: clockwise", many.check)
    assert (error.outline, error.corner) == (1, None)
    error = raises(surfmink.Refused, "outline 0: coincident_corners|(corner 2)",
                   surfmink.plane(corner, offset[2:]).check)


@theorem
def offsets_that_fall_are_refused_and_those_beyond_the_corners_never_reach_c():
    many = surfmink.plane(square, [0, 4, 2, 4])
    assert list(many.names) == ["ok", "bad_argument", "too_few_corners"]
    plane = surfmink.Surface(2, lambda x, y: (math.hypot(*(y - x)), y - x))
    assert list(surfmink.surface(plane, square, [0, 4, 2, 4]).names) == list(many.names)
    for offset in ([0, 5], [-1, 4], [0, 2 ** 62, 4]):
        raises(ValueError, "offset|between 0 and the number of corners, 4", surfmink.plane, square, offset)
    for measure in (surfmink.plane, surfmink.sphere):
        empty = measure(np.empty((0, 2 + (measure is surfmink.sphere))), [0])
        assert empty.mu.shape == (0, 7)


@theorem
def arrays_that_would_have_to_be_copied_are_refused_with_the_cure():
    raises(TypeError, "corner|float32|astype", surfmink.plane, square.astype(np.float32))
    raises(TypeError, "corner|astype", surfmink.plane, square.astype(">f8"))
    raises(ValueError, "corner|ascontiguousarray", surfmink.plane, np.asfortranarray(square))
    raises(ValueError, "corner|ascontiguousarray", surfmink.plane, square[::-1])
    raises(ValueError, "corner|(4, 2)|(corners, 3)", surfmink.sphere, square)
    raises(ValueError, "corner|(8,)", surfmink.plane, square.ravel())
    raises(ValueError, "3 corners, but 2 normals", surfmink.embedded, octant, octant[:2])
    raises(TypeError, "offset|int32|astype", surfmink.plane, square, np.array([0, 4], np.int32))
    raises(TypeError, "offset|float64", surfmink.plane, square, np.array([0., 4]))
    raises(ValueError, "offset|ascontiguousarray", surfmink.plane, square, np.array([4, 0])[::-1])
    raises(ValueError, "offset|(1, 2)", surfmink.plane, square, np.array([[0, 4]]))


@theorem
def other_arrays_are_handed_over_as_they_are():
    assert surfmink._doubles("corner", square, 2) is square
    for kind in (np.int64, np.uint64):
        offset = np.array([0, 4], kind)
        assert np.shares_memory(surfmink._offsets(offset, 4), offset)
    fixed = square.copy()
    fixed.flags.writeable = False
    near(surfmink.plane(fixed, [0, 4]).mu[0, 4], 1)


# --- surfaces of one's own --------------------------------------------------------------------------------------------

def sphere_log(x, y):
    """In the frame of a point that is not a pole: towards the east, towards the north."""
    east = np.array([-x[1], x[0], 0]) / math.hypot(x[0], x[1])
    north = np.cross(x, east)
    a, b = y @ east, y @ north
    return math.atan2(math.hypot(a, b), x @ y), (a, b)


def sphere_exp(x, direction, length):
    east = np.array([-x[1], x[0], 0]) / math.hypot(x[0], x[1])
    north = np.cross(x, east)
    return math.cos(length) * x + math.sin(length) * (direction[0] * east + direction[1] * north)


@theorem
def a_sphere_in_python_is_the_sphere():
    mine = surfmink.Surface(3, sphere_log, sphere_exp)
    outlines = [o / np.linalg.norm(o, axis=1, keepdims=True) for o in blobs(20, 3, 5)]
    corner, offset = surfmink.pack(outlines)
    got, want = surfmink.surface(mine, corner, offset).check(), surfmink.sphere(corner, offset).check()
    near(got.mu, want.mu, 1e-13)
    near(got.S, want.S, 1e-13)
    near(got.g, want.g, 1e-13)
    heptagon = mine.regular_polygon([.6, 0, .8], .7, 7)
    near(surfmink.surface(mine, heptagon, max_rank=7).mu, [1, 0, 0, 0, 0, 0, 0, 1])
    points = mine.edge_points(outlines[0][0], outlines[0][1], 3)
    near(points[0], outlines[0][0])
    assert points.shape == (3, 3)


@theorem
def what_a_callback_raises_is_raised():
    def broken(x, y):
        return 1 / 0
    def empty(x, y):
        return None
    def refuses(x, y):
        raise surfmink.Refused("antipodal_corners")
    raises(ZeroDivisionError, "zero", surfmink.surface, surfmink.Surface(2, broken), square)
    raises(TypeError, "", surfmink.surface, surfmink.Surface(2, empty), square)
    raises(surfmink.Refused, "antipodal_corners", surfmink.surface, surfmink.Surface(2, refuses), square)
    assert list(surfmink.surface(surfmink.Surface(2, refuses), square, [0, 4]).names) == ["antipodal_corners"]
    raises(surfmink.Refused, "bad_argument", surfmink.Surface(2, broken).regular_polygon, [0, 0], 1, 5)
    raises(surfmink.Refused, "callback_failed", surfmink.surface,
           surfmink.Surface(2, lambda x, y: (math.nan, (1, 0))), square)


@theorem
def longitude_and_latitude():
    near(surfmink.from_lonlat([0, 90, 180], [0, 0, 90]), [[1, 0, 0], [0, 1, 0], [0, 0, 1]], 0)
    raises(surfmink.Refused, "bad_argument|(corner 1)", surfmink.from_lonlat, [0, 0], [0, 91])


passed = 0
for statement in theorems:
    try:
        statement()
        passed += 1
    except Exception:
        print("FAILED %s" % statement.__name__)
        traceback.print_exc(file=sys.stdout)
print("%d passed, %d failed" % (passed, len(theorems) - passed))
sys.exit(passed < len(theorems))
