"""languages.py SURFMINK PATIC TISSUE H3: holds examples/languages/surfmink.py to what it says, by two commands and two
tissues. Needs numpy and the library."""
import math
import subprocess
import sys
import tempfile
import timeit
import traceback

sys.dont_write_bytecode = True
sys.path.insert(0, "examples/languages")

import numpy as np
import surfmink

command, patic, tissue_table, h3_table = sys.argv[1:]
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
upright = np.array([[0., 0, 0], [1, 0, 0], [0, 1, 0]]), np.array([[1., 0, 0], [1, 0, 1], [1, 0, 1]])


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
def arrays_as_people_have_them_are_measured_or_refused_by_name():
    closed = np.vstack([square, square[:1]])
    raises(surfmink.Refused, "coincident_corners|(corner 4)|surfmink.merge", surfmink.plane, closed)
    near(surfmink.plane(surfmink.merge(closed)).mu[4], 1)
    corner, offset = surfmink.merge(np.vstack([closed, square * 2]), [0, 5, 9])
    assert list(offset) == [0, 4, 8]
    near(corner[4:], square * 2, 0)
    twice = np.insert(closed, 2, closed[1] + [0, 1e-9], axis=0)
    near(surfmink.merge(twice, distance=1e-6), square, 0)
    assert len(surfmink.merge(twice)) == 5
    kept, normal = surfmink.merge(octant[[0, 0, 1, 2]], normal=octant[[0, 0, 1, 2]])
    near(normal, octant, 0)
    near(surfmink.plane(square.astype(int)).mu[4], 1)
    near(surfmink.plane([square, 3 * square, square[:3].astype(int)]).L, [4, 12, 2 + math.sqrt(2)])
    near(surfmink.sphere([octant, octant[::-1][[1, 0, 2]]]).mu[:, 3], [1, 1])
    near(surfmink.embedded([octant], [octant]).mu[0, 3], 1)
    near(surfmink.plane(square.tolist()).L, 4)
    raises(ValueError, "give either", surfmink.plane, [square], [0, 4])
    raises(ValueError, "normals is not like", surfmink.embedded, [octant], [octant[:2]])
    masked = np.ma.array(square, mask=[[0, 0], [0, 1], [0, 0], [0, 0]])
    for given in (masked, [square, masked]):
        raises(ValueError, "masked entries", surfmink.plane, given)
    near(surfmink.plane(masked[~masked.mask.any(axis=1)].data).area, .5)


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


def tissue():
    table = np.loadtxt(tissue_table, skiprows=4)
    return table[:, 1:4].copy(), table[:, 4:7].copy(), surfmink.offsets(table[:, 0])


@theorem
def the_command_says_the_same_to_the_last_bit():
    lines = subprocess.run([command, "--max-rank", "7", tissue_table], capture_output=True, text=True, check=True)
    names, *rows = [line.split("\t") for line in lines.stdout.splitlines()]
    cells = surfmink.embedded(*tissue(), max_rank=7).check()
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
    raises(TypeError, "max_rank is 2.5, not a whole number", surfmink.plane, square, max_rank=2.5)
    raises(TypeError, "offset has dtype float64, not int64", surfmink.plane, square, [0, 3.5])
    raises(TypeError, "is complex: numpy.column_stack", surfmink.plane, square[:, 0] + 1j)
    raises(surfmink.Refused, "upright_edge", surfmink.embedded, *upright)
    raises(surfmink.Refused, "opposite_normals|(corner 1)", surfmink.embedded, np.c_[square, 0 * square[:, 0]],
           np.array([[0., 0, 1], [0, 0, -1], [0, 0, 1], [0, 0, 1]]))


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
def masked_corners_are_refused_and_never_measured():
    masked = np.ma.masked_array(square, mask=[[0, 0], [0, 0], [1, 1], [0, 0]])
    raises(ValueError, "corner has masked entries|getdata(corner)", surfmink.plane, masked)
    raises(ValueError, "normal has masked entries", surfmink.embedded, upright[0],
           np.ma.masked_values(upright[1], 0))
    raises(ValueError, "outlines[1] has masked entries", surfmink.pack, [square, masked])
    near(surfmink.plane(np.ma.masked_array(square)).mu[4], 1)  # nothing is masked
    near(surfmink.plane(np.ma.getdata(masked)).mu[4], 1)


@theorem
def a_list_of_outlines_is_sent_to_pack():
    raises(ValueError, "surfmink.pack", surfmink.curve_plane, [square, square[:3]])
    raises(ValueError, "corner", surfmink.curve_plane, [square, square])
    corner, offset = surfmink.pack([square, [[0, 0], [2, 0], [0, 2]], square[:3].astype(int)])
    assert list(offset) == [0, 4, 7, 10] and corner.dtype == float
    near(surfmink.plane(corner, offset).L, [4, 4 + math.sqrt(8), 2 + math.sqrt(2)])


@theorem
def many_outlines_cost_less_in_one_call():
    corner, offset = surfmink.pack(1000 * [square])
    one = min(timeit.repeat(lambda: surfmink.plane(square), number=50, repeat=5)) / 50
    many = min(timeit.repeat(lambda: surfmink.plane(corner, offset), number=1, repeat=5)) / 1000
    assert many < one / 5, "%.1f us an outline alone, %.1f in a batch" % (1e6 * one, 1e6 * many)


@theorem
def other_arrays_are_handed_over_as_they_are():
    assert surfmink._doubles("corner", square, 2) is square
    for kind in (np.int64, np.uint64):
        offset = np.array([0, 4], kind)
        assert np.shares_memory(surfmink._offsets(offset, 4), offset)
    fixed = square.copy()
    fixed.flags.writeable = False
    near(surfmink.plane(fixed, [0, 4]).mu[0, 4], 1)


# --- smooth curves ----------------------------------------------------------------------------------------------------

def circle(n, colatitude=None, start=0.0):
    """n corners on the unit circle; or on a circle of the unit sphere about the third axis."""
    angle = start + np.arange(n) * 2 * math.pi / n
    around = np.c_[np.cos(angle), np.sin(angle)]
    if colatitude is None:
        return around
    return np.c_[math.sin(colatitude) * around, np.full(n, math.cos(colatitude))]


@theorem
def the_curve_through_points_of_a_circle_is_the_circle():
    colatitude = .7
    for n in (40, 80):
        flat, cap = circle(n), circle(n, colatitude)
        for curve, length, turning, area, estimated in (
                (surfmink.curve_plane(flat), 2 * math.pi, 2 * math.pi, math.pi, 0),
                (surfmink.curve_sphere(cap, radius=3.0), 6 * math.pi * math.sin(colatitude),
                 2 * math.pi * math.cos(colatitude), 18 * math.pi * (1 - math.cos(colatitude)), 0),
                (surfmink.curve_embedded(cap, 5 * cap), 2 * math.pi * math.sin(colatitude),
                 2 * math.pi * math.cos(colatitude), 2 * math.pi * (1 - math.cos(colatitude)), .01)):
            off = 1.5 * (2 * math.pi / n) ** 4
            near(curve.L, length, off * length / 100)
            near([curve.S, curve.w.turning], turning, off / 100)
            near(curve.area, area, off * area / 10 + estimated * area)
            near(curve.mu, [1, 0, 0, 0, 0, 0, 0], 1e-13)
            assert curve.error.shape == (7,) and abs(curve.L / length - 1) < 2 * curve.error[0] < 40 * off


@theorem
def order_2_is_the_polygon_and_order_4_nearer_to_the_curve_by_what_error_says():
    def flower(n):
        angle = .3 + np.arange(n) * 2 * math.pi / n
        return circle(n, start=.3) * (1 + .15 * np.cos(2 * angle) + .05 * np.sin(3 * angle))[:, None]
    fine = surfmink.curve_plane(flower(4000))
    curve, polygon = surfmink.curve_plane(flower(120)), surfmink.curve_plane(flower(120), order=2)
    near(polygon.mu, surfmink.plane(flower(120)).mu, 0)
    near(polygon.theta, surfmink.plane(flower(120)).theta, 0)
    for p in (2, 3, 5):
        assert 0 < abs(curve.mu[p] - fine.mu[p]) < abs(polygon.mu[p] - fine.mu[p]) / 100
        for measured in (curve, polygon):
            assert 1 / 20 < abs(measured.mu[p] - fine.mu[p]) / measured.error[p] <= 1
    tilted = np.c_[flower(120), np.zeros(120)] @ [[.6, .8, 0], [0, 0, -1], [.8, -.6, 0]]
    flat = surfmink.curve_embedded(tilted, np.tile([-.8, .6, 0], (120, 1)), max_rank=9)
    near(flat.mu[:7], curve.mu)
    near(flat.error[:7], curve.error)
    assert flat.mu.shape == flat.error.shape == flat.g.shape == (10,)


@theorem
def corners_of_a_curve_stay_sharp_where_they_are_said_to_be():
    half = circle(80)[:41]
    sharp = np.arange(41) % 40 == 0
    for flags in (sharp, sharp.astype(np.uint8), sharp.tolist()):
        near(surfmink.curve_plane(half, sharp=flags).L, math.pi + 2, 3e-7)
    assert abs(surfmink.curve_plane(half).L - math.pi - 2) > 1e-4
    near(surfmink.curve_plane(square, sharp=[True] * 4).mu, surfmink.plane(square).mu)
    near(surfmink.curve_sphere(octant, sharp=[1, 1, 1]).L, 3 * math.pi / 2)
    near(surfmink.curve_sphere(circle(80, 1.2)[:41], sharp=sharp).L, math.pi * math.sin(1.2) + 2.4, 1e-6)
    flat, up = np.c_[half, np.ones(41)], np.tile([0., 0, 1], (41, 1))
    near(surfmink.curve_embedded(flat, up, sharp=sharp).L, math.pi + 2, 3e-7)
    assert np.shares_memory(surfmink._sharp(sharp, 41), sharp)
    raises(TypeError, "sharp|int64|astype(bool)", surfmink.curve_plane, half, sharp=sharp.astype(int))
    raises(ValueError, "sharp|(2,)|(41,)", surfmink.curve_plane, half, sharp=[0, 40])
    raises(ValueError, "sharp|ascontiguousarray", surfmink.curve_plane, half, sharp=sharp[::-1])


@theorem
def many_curves_are_each_of_them():
    one, wrong = circle(30) * (1, 2), circle(30)[::-1]
    corner, offset = surfmink.pack([one, wrong, circle(12)[[0, 1, 1, 2, 3]], circle(12)])
    sharp = np.zeros(len(corner), bool)
    sharp[7] = True
    many = surfmink.curve_plane(corner, offset, max_rank=3, sharp=sharp)
    assert list(many.names) == ["ok", "clockwise", "coincident_corners", "ok"] and list(many.bad[1:3]) == [30, 2]
    for i, single in ((0, surfmink.curve_plane(one, max_rank=3, sharp=sharp[:30])),
                      (3, surfmink.curve_plane(circle(12), max_rank=3))):
        for name in ("mu", "error", "g", "theta", "L", "S", "area"):
            near(getattr(many, name)[i], getattr(single, name), 0)
    assert many.error.shape == (4, 4) and np.isnan(many.error[1:3]).all() and np.isnan(many.mu[1:3]).all()
    raises(surfmink.Refused, "outline 1: clockwise", many.check)
    ball = circle(12, .5)
    near(surfmink.curve_sphere(ball, [0, 12], 2.0).L[0], surfmink.curve_sphere(ball, radius=2.0).L, 0)
    near(surfmink.curve_embedded(ball, ball, [0, 12]).L[0], surfmink.curve_embedded(ball, ball).L, 0)


@theorem
def a_curve_that_is_wrong_raises_its_name_and_corner():
    error = raises(surfmink.Refused, "coincident_corners|(corner 2)", surfmink.curve_plane, circle(9)[[0, 1, 1, 2, 5]])
    assert (error.corner, error.outline) == (2, None)
    raises(surfmink.Refused, "bad_argument", surfmink.curve_plane, circle(9), order=3)
    raises(surfmink.Refused, "bad_argument", surfmink.curve_plane, circle(9), order=2 ** 32 + 4)
    raises(surfmink.Refused, "bad_argument", surfmink.curve_sphere, circle(9, .5), radius=0.0)
    raises(surfmink.Refused, "too_few_corners", surfmink.curve_embedded, octant[:2], octant[:2])
    raises(TypeError, "float32", surfmink.curve_plane, circle(9).astype(np.float32))
    raises(ValueError, "3 corners, but 2 normals", surfmink.curve_embedded, octant, octant[:2])


# --- gradients --------------------------------------------------------------------------------------------------------

surfaces = {"plane": (surfmink.plane, surfmink.gradient_plane, {}),
            "sphere": (surfmink.sphere, surfmink.gradient_sphere, {"radius": 2.0}),
            "embedded": (surfmink.embedded, surfmink.gradient_embedded, {})}


def outline_on(kind, seed, corners=7):
    """The arrays of an outline without any symmetry; its normals are not its corners."""
    corner = blobs(1, 2 if kind == "plane" else 3, seed, corners)[0]
    return [corner, blobs(1, 3, seed + 1, corners)[0] / 5] if kind == "embedded" else [corner]


def some_weights(seed, max_rank, count=()):
    random = np.random.default_rng(seed)
    shape = count + (max_rank + 1,)
    return {"mu": random.normal(size=shape), "theta": random.normal(size=shape), "length": random.normal(size=count),
            "g": random.normal(size=shape) + 1j * random.normal(size=shape)}


def energy(measured, weights):
    """Linear in what is measured; of each outline."""
    return ((measured.mu @ weights["mu"] if "mu" in weights else 0) +
            (measured.theta @ weights["theta"] if "theta" in weights else 0) +
            (measured.L * weights["length"] if "length" in weights else 0) +
            ((measured.g @ np.conj(weights["g"])).real if "g" in weights else 0))


def differences(measure, arrays, which, weights, named, h=1e-4):
    """Central differences of fourth order: the energy by each number of one of the arrays, all moved in one batch."""
    shape, n = arrays[which].shape, len(arrays[0])
    moves = h * np.eye(arrays[which].size).reshape(-1, *shape)
    moves = np.concatenate([moves, -moves, 2 * moves, -2 * moves])
    stacks = [np.concatenate(array + moves * (which == k)) for k, array in enumerate(arrays)]
    moved = measure(*stacks, np.arange(len(moves) + 1) * n, max_rank=5, **named).check()
    up, down, far_up, far_down = energy(moved, weights).reshape(4, *shape)
    return (8 * (up - down) - (far_up - far_down)) / (12 * h)


@theorem
def a_gradient_is_what_central_differences_say():
    for seed, (kind, (measure, gradient, named)) in enumerate(surfaces.items()):
        arrays, everything = outline_on(kind, seed), some_weights(seed, 5)
        everything["mu"][1] = everything["theta"][1] = 0  # mu_1 is near 0, and differences near noise
        for weights in [everything] + [{name: everything[name]} for name in everything]:
            got = gradient(*arrays, max_rank=5, **named, **weights)
            assert (got.by_normal is None) == (kind != "embedded")
            for which, by in enumerate([got.by_corner, got.by_normal][:len(arrays)]):
                assert by.shape == arrays[which].shape
                near(by, differences(measure, arrays, which, weights, named), 1e-9)
                if weights is everything:
                    assert np.max(np.abs(by)) > .1


@theorem
def a_gradient_measures_what_measuring_says_one_outline_to_the_bit():
    for kind, (measure, gradient, named) in surfaces.items():
        arrays = outline_on(kind, 7)
        for offset in (None, [0, 4, 7]):
            got = gradient(*arrays, offset, max_rank=9, mu=np.ones(10), **named)
            want = measure(*arrays, offset, max_rank=9, **named)
            for name in ("mu", "g", "L", "S", "area") + ("theta",) * (offset is None):
                near(getattr(got, name), getattr(want, name), 0 if offset is None else 1e-13)
            turns = 1j * np.arange(10)
            near(got.mu * np.exp(turns * got.theta), want.mu * np.exp(turns * want.theta), 1e-13)


@theorem
def moving_turning_and_scaling_cost_what_they_must():
    for kind, (measure, gradient, named) in surfaces.items():
        arrays, weights = outline_on(kind, 17), some_weights(4, 6)
        got = gradient(*arrays, **named, **weights)
        pairs = list(zip(arrays, [got.by_corner, got.by_normal]))
        within = 1e-13 * sum(np.sum(np.abs(x)) * np.max(np.abs(by)) for x, by in pairs)
        if kind == "sphere":
            near(np.sum(arrays[0] * got.by_corner, axis=1), 0, within)
        else:
            near(got.by_corner.sum(axis=0), 0, within)
            near(np.sum(arrays[0] * got.by_corner), got.L * weights["length"] + (got.g @ np.conj(weights["g"])).real,
                 within)
        for a, b in ((0, 1), (1, 2), (2, 0))[:1 if kind == "plane" else 3]:
            near(sum(np.sum(x[:, a] * by[:, b] - x[:, b] * by[:, a]) for x, by in pairs), 0, within)
        if kind == "embedded":
            near(np.sum(arrays[1] * got.by_normal, axis=1), 0, within)


@theorem
def gradients_of_many_are_those_of_each_with_weights_for_all_or_of_each():
    for kind, (measure, gradient, named) in surfaces.items():
        arrays = [np.concatenate(parts) for parts in zip(*(outline_on(kind, seed, 3 + seed) for seed in range(9)))]
        offset = np.cumsum([0] + [3 + seed for seed in range(9)])
        for count in ((), (9,)):
            weights = some_weights(5, 6, count)
            many = gradient(*arrays, offset, **named, **weights).check()
            assert many.by_corner.shape == arrays[0].shape and many.mu.shape == (9, 7)
            for i in range(9):
                rows = slice(offset[i], offset[i + 1])
                one = gradient(*(array[rows] for array in arrays), **named,
                               **{name: w[i] if count else w for name, w in weights.items()})
                scale = np.max(np.abs(one.by_corner))
                near(many.by_corner[rows], one.by_corner, 1e-11 * scale)
                near(many.mu[i], one.mu, 1e-13)
                if kind == "embedded":
                    near(many.by_normal[rows], one.by_normal, 1e-11 * scale)


@theorem
def no_gradient_of_what_is_refused_and_no_harm_to_others():
    corner, offset = surfmink.pack([square, square[::-1], square[[0, 1, 1, 2]], square * (2, 1)])
    many = surfmink.gradient_plane(corner, offset, length=1)
    assert list(many.names) == ["ok", "clockwise", "coincident_corners", "ok"] and list(many.bad[1:3]) == [4, 2]
    assert list(np.isnan(many.by_corner).all(axis=1)) == 4 * [False] + 8 * [True] + 4 * [False]
    near(many.by_corner[[0, 1, 2, 3]], [[-1, -1], [1, -1], [1, 1], [-1, 1]])
    near(many.by_corner[12:], many.by_corner[:4])
    error = raises(surfmink.Refused, "coincident_corners|(corner 2)", surfmink.gradient_plane, corner[8:12], length=1)
    assert (error.corner, error.outline) == (2, None)
    raises(surfmink.Refused, "bad_argument", surfmink.gradient_sphere, octant, radius=-1.0)
    raises(surfmink.Refused, "zero_normal|(corner 1)", surfmink.gradient_embedded, octant, octant * [[1], [0], [1]])
    raises(surfmink.Refused, "outline 0: zero_normal|(corner 1)",
           surfmink.gradient_embedded(octant, octant * [[1], [0], [1]], [0, 3]).check)
    near(surfmink.gradient_plane(square).by_corner, 0, 0)
    assert surfmink.gradient_plane(np.empty((0, 2)), [0], mu=np.ones(7)).by_corner.shape == (0, 2)


@theorem
def weights_are_handed_over_as_they_are_or_refused_with_the_cure():
    weights = some_weights(6, 6, (2,))
    given = [weights[name] for name in ("mu", "g", "theta", "length")]
    kept, shared = surfmink._weights(given, 6, 2)
    assert all(k is w for k, w in zip(kept, given)) and shared == 0
    assert surfmink._weights((given[0][1], None, None, 2), 6, 2)[1] == 1
    near(surfmink.gradient_plane(square * (2, 1), mu=[0, 0, 0, 0, 0, 0, 1]).by_corner,
         surfmink.gradient_plane(square * (2, 1), mu=np.eye(7)[6]).by_corner, 0)
    def call(**named):
        return surfmink.gradient_plane, square, [0, 4], 6, *[named.get(k) for k in ("mu", "g", "theta", "length")]
    raises(TypeError, "mu|float32|astype(float)", *call(mu=np.ones(7, np.float32)))
    raises(TypeError, "g|float64|complex128|astype(complex)", *call(g=np.ones(7)))
    raises(TypeError, "length|int64|astype(float)", *call(length=np.array([1])))
    raises(ValueError, "theta|ascontiguousarray", *call(theta=np.ones(14)[::2]))
    raises(ValueError, "theta|(6,)|(7,) or (1, 7)", *call(theta=np.ones(6)))
    raises(ValueError, "g|(2, 7)", *call(g=np.ones((2, 7), complex)))
    raises(ValueError, "length|(2,)", *call(length=[1, 2]))
    raises(ValueError, "mu: one for all|length: one of each|numpy.full", *call(mu=np.ones(7), length=[1]))
    raises(ValueError, "mu|(1, 7), not (7,)", surfmink.gradient_plane, square, mu=np.ones((1, 7)))
    raises(ValueError, "corner|ascontiguousarray", surfmink.gradient_plane, square[::-1])
    raises(TypeError, "corner|float32", surfmink.gradient_sphere, octant.astype(np.float32))
    raises(ValueError, "3 corners, but 2 normals", surfmink.gradient_embedded, octant, octant[:2])


@theorem
def gradients_are_written_where_they_are_returned():
    written = []
    real = surfmink._library
    class Listening:
        def __getattr__(self, name):
            def call(*arguments):
                if "gradient" in name:
                    written.extend(arguments)
                return getattr(real, name)(*arguments)
            return call
    surfmink._library = Listening()
    try:
        for offset in (None, [0, 3]):
            written.clear()
            corner, normal = octant.copy(), 2 * octant
            got = surfmink.gradient_embedded(corner, normal, offset, mu=np.ones(7))
            for array in (corner, normal, got.by_corner, got.by_normal):
                assert array.ctypes.data in written and array.flags.owndata
    finally:
        surfmink._library = real


# --- directions at the centre -----------------------------------------------------------------------------------------

@theorem
def a_regular_polygon_points_at_its_sides():
    for n in (3, 4, 5, 6):
        for start in (.0, .4):
            flat = surfmink.director_plane(circle(n, start=start) + (3, 4), max_rank=12)
            cap, ball = circle(n, .5, start), 2.5 * circle(n, .5, start)
            round_ = surfmink.director_sphere(cap, radius=2.5, max_rank=12)
            chords = surfmink.director_embedded(ball, cap, max_rank=12)
            near(flat.centre, [3, 4])
            near(round_.centre, [0, 0, 2.5])
            near(chords.centre, [0, 0, 2.5 * math.cos(.5)])
            assert flat.mean_normal is None
            for got in (flat, round_, chords):
                for p in (n, 2 * n):
                    near((got.direction[p, :2] @ [1, 1j]) ** p, np.exp(1j * p * (start + math.pi / n)), 1e-13)
                    near(got.coherence[p], 1)
                    near(got.mu[p], 1)
                near(got.direction[0], 0, 0)
            for got in (round_, chords):
                near(got.mean_normal, [0, 0, 1])
                near(got.direction[:, 2], 0)


@theorem
def directions_turn_with_the_outline_and_are_those_of_the_eigenvectors_in_the_plane():
    corner = blobs(1, 2, 31, 8)[0]
    one = surfmink.director_plane(corner, max_rank=5)
    near(one.mu, surfmink.plane(corner, max_rank=5).mu, 0)
    edge = corner[1] - corner[0]
    co_normal = math.atan2(-edge[0], edge[1])
    for p in range(1, 6):
        near(one.coherence[p], 1)
        if p > 1:
            near((one.direction[p] @ [1, 1j]) ** p, np.exp(1j * p * (co_normal + one.theta[p])), 1e-12)
    turned = surfmink.director_plane(corner @ [[0, 1], [-1, 0]], max_rank=5)
    for p in range(2, 6):
        near((turned.direction[p] @ [1, 1j]) ** p, (one.direction[p] @ [1, 1j] * 1j) ** p, 1e-12)
    for kind, director, named in (("sphere", surfmink.director_sphere, {"radius": 2.0}),
                                  ("embedded", surfmink.director_embedded, {})):
        got = director(*outline_on(kind, 33), **named)
        near(got.direction[1:] @ got.mean_normal, 0)
        near(np.linalg.norm(got.direction[1:], axis=1), 1)
        assert got.direction.shape == (7, 3) and np.all(got.coherence <= 1 + 1e-14) and got.coherence[6] < 1 - 1e-6


@theorem
def centres_and_mean_normals_are_means_by_length():
    def mean(length, points):
        return length @ ((points + np.roll(points, -1, axis=0)) / 2) / length.sum()
    def lengths(corner):
        return np.linalg.norm(np.roll(corner, -1, axis=0) - corner, axis=1)
    corner = np.array([[0., 0], [3, 0], [3, 1], [1, 2]])
    near(surfmink.director_plane(corner).centre, mean(lengths(corner), corner))
    corner, normal = outline_on("embedded", 41)
    chords = surfmink.director_embedded(corner, normal)
    near(chords.centre, mean(lengths(corner), corner))
    unit = corner / np.linalg.norm(corner, axis=1, keepdims=True)
    arc = 2 * np.arcsin(lengths(unit) / 2)
    middle = unit + np.roll(unit, -1, axis=0)
    want = arc @ (middle / np.linalg.norm(middle, axis=1, keepdims=True))
    got = surfmink.director_sphere(corner, radius=3.0)
    near(got.mean_normal, want / np.linalg.norm(want))
    near(got.centre, 3 * got.mean_normal)


@theorem
def directors_of_many_are_those_of_each():
    cap = circle(6, .5)
    corner = np.concatenate([cap, cap[::-1], cap[[0, 1, 1]]])
    many = surfmink.director_sphere(corner, [0, 6, 12, 15], 2.0, max_rank=3)
    one = surfmink.director_sphere(cap, radius=2.0, max_rank=3)
    assert list(many.names) == ["ok", "clockwise", "coincident_corners"] and list(many.bad[1:]) == [6, 2]
    for name in ("centre", "mean_normal", "direction", "coherence", "mu", "theta", "L"):
        near(getattr(many, name)[0], getattr(one, name), 0)
        assert np.isnan(getattr(many, name)[1:]).all()
    assert many.direction.shape == (3, 4, 3) and many.centre.shape == (3, 3) and many.coherence.shape == (3, 4)
    flat = surfmink.director_plane(*surfmink.pack([square, square[::-1]]))
    assert list(flat.names) == ["ok", "clockwise"] and flat.mean_normal is None and flat.direction.shape == (2, 7, 2)
    near(flat.centre[0], .5)
    assert np.isnan(flat.centre[1]).all()
    error = raises(surfmink.Refused, "antipodal_corners|(corner 1)", surfmink.director_sphere,
                   np.array([[0., 0, 1], [0, 0, -1], [1, 0, 0]]))
    assert error.outline is None
    raises(surfmink.Refused, "upright_edge", surfmink.director_embedded, *upright)
    flat, normal = np.c_[[0., 1, 2, 2, 0], [0., 0, 0, 2, 2], np.zeros(5)], np.tile([0., 0, 1], (5, 1))
    normal[1] *= -1
    raises(surfmink.Refused, "opposite_normals|(corner 1)", surfmink.director_embedded, flat, normal)
    many = surfmink.director_embedded(flat, normal, [0, 5])
    assert list(many.names) == ["opposite_normals"] and many.bad[0] == 1 and np.isnan(many.mu).all()
    raises(TypeError, "float32", surfmink.director_plane, square.astype(np.float32))
    raises(ValueError, "ascontiguousarray", surfmink.director_plane, square[::-1])


# --- the field of a tissue --------------------------------------------------------------------------------------------

def solid(faces):
    """A Platonic solid as a tissue: the corners of its faces, counter-clockwise from outside; on the unit sphere."""
    return surfmink.pack([np.array(face) / np.linalg.norm(face[0]) for face in faces])


signs = [-1., 1.]
octahedron = solid([[(a, 0, 0), (0, b, 0), (0, 0, c)][::int(a * b * c)] for a in signs for b in signs for c in signs])
cube = solid([[np.roll((a, b, c), k) for b, c in ((-1, -1), (1, -1), (1, 1), (-1, 1))[::int(a)]]
              for a in signs for k in range(3)])
sheet = [square + (column, row) for row in range(3) for column in range(4)]  # of squares


@theorem
def charges_of_a_closed_tissue_sum_to_2():
    for corner, offset in (octahedron, cube):
        for rank in (1, 2, 3, 4, 5, 6, 12, 1000):
            for ball in (0, 1.6):
                for field in (surfmink.field_sphere(corner, offset, 3.0, rank, 3 * ball),
                              surfmink.field_embedded(corner, 2 * corner, offset, rank, ball)):
                    field.check()
                    near([field.charges, field.chi, field.boundary, field.components], [2, 2, 0, 1])
                    near(np.sum(field.defects.charge), 2)
                    k = rank * field.defects.charge
                    near(k, np.rint(k), 1e-12)
                    assert field.defects.x.shape == (len(k), 3) and np.all(np.abs(field.defects.charge) > 0)


@theorem
def each_corner_of_a_solid_has_its_share_of_2():
    for (corner, offset), rank, corners in ((octahedron, 6, 6), (cube, 4, 8)):
        field = surfmink.field_sphere(corner, offset, 5.0, rank)
        x, charge, order, margin = field.defects
        near(charge, np.full(corners, 2 / corners))
        near([order, margin], 1, 1e-12)
        want = 5 * np.unique(corner, axis=0)
        near(x[np.lexsort(x.T.round(9)[::-1])], want, 1e-13)
        near(field.mu, 1, 1e-12)
        near(field.order, 1, 1e-12)
        near(np.linalg.norm(field.centre, axis=1), 5, 1e-13)
        near(field.centre, 5 * field.mean_normal, 1e-13)
        near(np.linalg.norm(field.direction, axis=1), 1)
        near(np.sum(field.direction * field.mean_normal, axis=1), 0)
        near(field.spacing, 5 * math.acos(1 / 3 if corners == 6 else 0), 1e-13)


@theorem
def twelve_pentagons_of_a_grid_of_hexagons_have_a_sixth_each():
    with open(h3_table) as file:
        rows = [line.split() for line in file if line[0] in "0123456789"]
    corner = surfmink.from_lonlat([float(row[1]) for row in rows], [float(row[2]) for row in rows])
    offset = surfmink.offsets([row[0] for row in rows])
    field = surfmink.field_sphere(corner, offset, rank=6).check()
    near(field.defects.charge, np.full(12, 1 / 6))
    near([field.charges, field.chi], 2)
    pentagon = np.flatnonzero(field.order == 0)
    near(field.direction[pentagon], 0, 0)
    near(field.mu[pentagon], 0, 1e-12)
    near(field.defects.x[np.lexsort(field.defects.x.T)], field.centre[pentagon][np.lexsort(field.centre[pentagon].T)])


@theorem
def the_command_finds_the_same_field_to_the_last_bit():
    for rank, name, ball in ((6, "1.5c", {"cells": 1.5}), (2, "30", {"ball": 30.}), (3, "0", {})):
        with tempfile.NamedTemporaryFile("r") as file:
            lines = subprocess.run([patic, "--rank", str(rank), "--radius", name, "--defects", file.name, tissue_table],
                                   capture_output=True, text=True, check=True).stdout.splitlines()
            defects = [line.split("\t") for line in file.read().splitlines()]
        columns = dict(zip(lines[0].split("\t"), zip(*(line.split("\t") for line in lines[1:]))))
        field = surfmink.field_embedded(*tissue(), rank=rank, **ball).check()
        assert len(columns["id"]) == len(field.order) == 400 and len(defects) - 1 == len(field.defects.charge) > 10
        for names, got in (("mu", field.mu), ("order", field.order), ("x y z", field.centre),
                           ("nx ny nz", field.mean_normal), ("dx dy dz", field.direction)):
            near(got.T, np.squeeze([np.array(columns[name], float) for name in names.split()]), 0)
        columns = dict(zip(defects[0], zip(*defects[1:])))
        for names, got in (("x y z", field.defects.x), ("charge", field.defects.charge),
                           ("order", field.defects.order), ("margin", field.defects.margin)):
            near(got.T, np.squeeze([np.array(columns[name], float) for name in names.split()]), 0)
        near([field.charges, field.boundary, field.chi], [2, 0, 2], 1e-14)


@theorem
def a_cell_that_is_refused_is_a_hole():
    twice, crossed = sheet[5], square[[0, 2, 1, 3]] + (9, 9)
    whole = surfmink.field_plane(*surfmink.pack(sheet), 4)
    some = surfmink.field_plane(*surfmink.pack(sheet + [twice, crossed, square[[0, 1, 1, 2]]]), 4)
    assert list(some.names) == 12 * ["ok"] + ["overlaps", "crosses_itself", "coincident_corners"]
    for name in ("mu", "order", "centre", "mean_normal", "direction"):
        near(getattr(some, name)[:12], getattr(whole, name), 0)
        assert np.isnan(getattr(some, name)[12:]).all()
    error = raises(surfmink.Refused, "outline 12: overlaps: an edge of it belongs to another cell", some.check)
    assert (error.status, error.outline, error.corner) == (64, 12, None)
    assert some.bad[14] == 2 and surfmink.Refused("meets_itself").status == 65
    ring = surfmink.field_plane(*surfmink.pack(sheet[:5] + [sheet[5][::-1]] + sheet[6:]), 4)
    for field, chi in ((whole, 1), (some, 1), (ring, 0)):
        near([field.charges + field.boundary, field.chi, field.components], [chi, chi, 1], 1e-13)
        near(field.spacing, 1)
        assert len(field.defects.charge) == 0
    near(whole.centre, np.array([cell.mean(axis=0) for cell in sheet]) @ np.eye(2, 3))
    near(whole.mean_normal, [[0, 0, 1]] * 12, 0)


@theorem
def a_ball_is_a_length_or_so_many_cells():
    corner, offset = surfmink.pack(sheet)
    corner = corner + .1 * np.sin(7 * corner[:, ::-1] + (1, 2))  # shared corners stay the same points
    raw = surfmink.field_plane(corner, offset, 2)
    near(raw.order, raw.mu, 1e-15)
    for cells in (1.2, 3.0, 1e9):
        one = surfmink.field_plane(corner, offset, 2, cells=cells)
        near(one.order, surfmink.field_plane(corner, offset, 2, cells * raw.spacing).order, 0)
        near(one.mu, raw.mu, 0)
        assert np.max(np.abs(one.order - raw.order)) > .01
    everywhere = one.order * np.exp(2j * np.arctan2(one.direction[:, 1], one.direction[:, 0]))
    length = surfmink.plane(corner, offset).L
    each = raw.mu * np.exp(2j * np.arctan2(raw.direction[:, 1], raw.direction[:, 0]))
    near(everywhere, length @ each / length.sum(), 1e-13)
    apart = corner + 1e-3 * np.cos(np.arange(len(corner)))[:, None]  # no two corners are the same
    assert surfmink.field_plane(apart, offset, 2).components == 12
    assert surfmink.field_plane(apart, offset, 2, weld=.01).components == 1
    assert surfmink.field_plane(corner, offset, 2, weld=0).components == 1


@theorem
def arguments_of_a_field_without_sense_are_refused():
    corner, offset = surfmink.pack(sheet)
    field = surfmink.field_plane
    for named in ({"rank": 0}, {"rank": 1001}, {"rank": 2 ** 31 - 2}, {"rank": -1}, {"ball": -1.0}, {"cells": -1.0},
                  {"weld": -1.0}, {"ball": math.nan}, {"cells": math.nan}, {"weld": math.nan}, {"weld": math.inf}):
        raises(surfmink.Refused, "bad_argument", field, corner, offset, **named)
    raises(ValueError, "give one", field, corner, offset, ball=1.0, cells=1.0)
    raises(ValueError, "offset", field, corner, None)
    for wrong in ([4, 8], [0, 8, 4], [0, 49]):
        raises(ValueError, "offset", field, corner, wrong)
        into, scratch = np.array(wrong, np.uintp), np.empty(5000)
        assert surfmink._STATUS["bad_argument"] == surfmink._library.surfmink_flat_patic(
            *surfmink._plane(corner).in_c(), into.ctypes.data, len(wrong) - 1, 2, -1.0, 0.0, *8 * [None], None, None,
            None, scratch.ctypes.data)
    raises(TypeError, "float32", field, corner.astype(np.float32), offset)
    raises(ValueError, "3 corners, but 2 normals", surfmink.field_embedded, octant, octant[:2], [0, 3])
    empty = field(np.empty((0, 2)), [0])
    assert (empty.components, empty.chi, empty.order.shape, len(empty.defects.charge)) == (0, 0, (0,), 0)
    one = field(square, [0, 4], 4)
    near([one.components, one.chi, one.charges, one.boundary, one.spacing], [1, 1, 0, 1, 0])
    bare = surfmink.field_sphere(corner[:3] @ np.eye(2, 3), [0, 3], -1.0)
    assert list(bare.names) == ["bad_argument"]


# --- memory -----------------------------------------------------------------------------------------------------------

@theorem
def nothing_is_written_beyond_the_memory_that_is_handed_over():
    guards = []
    class Guarded:
        """numpy, but arrays for C end in memory that must stay as it is."""
        def __getattr__(self, name):
            return getattr(np, name)
        def full(self, shape, value, dtype=float):
            size = int(np.prod(shape))
            whole = np.full(size + 4000, 7.25, np.result_type(dtype, type(value)))
            whole[:size] = value
            guards.append(whole[size:])
            return whole[:size].reshape(shape)
        def empty(self, shape):
            return self.full(shape, 0.0)
    surfmink.np = Guarded()
    try:
        for n in (3, 8, 200):
            for size in (1, 1e-200):  # the second one is measured with twice the digits
                flat, cap = circle(n) * size, circle(n, .5)
                ball = cap * size
                for offset in (None, [0, n]):
                    surfmink.sphere(cap, offset)
                    weights = some_weights(1, 9)
                    for arrays, kind in (([flat], "plane"), ([cap], "sphere"), ([ball, cap], "embedded")):
                        for does, named in (("curve", {}), ("gradient", weights), ("director", {})):
                            measured = getattr(surfmink, does + "_" + kind)(*arrays, offset, max_rank=9, **named)
                            assert np.all(measured.status == 0)
        for rank in (1, 6, 1000):
            for corner, offset in (octahedron, cube, (circle(200, .5), [0, 200])):
                assert surfmink.field_embedded(corner, corner, offset, rank, cells=2).ok.all()
        for measure in (surfmink.plane, surfmink.gradient_plane, surfmink.curve_plane):  # not the largest last
            assert list(measure(circle(200), [0, 200, 3]).names) == ["ok", "bad_argument"]
    finally:
        surfmink.np = np
    assert len(guards) > 500
    for guard in guards:
        near(guard, 7.25, 0)


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
def an_area_that_is_not_known_is_not_a_number():
    plane = surfmink.Surface(2, lambda x, y: (math.hypot(*(y - x)), y - x))
    one, many = surfmink.surface(plane, square), surfmink.surface(plane, square, [0, 4])
    assert math.isnan(one.area) and math.isnan(one.w.area) and np.isnan(many.area).all()
    near([one.L, one.w.length, many.L[0]], 4)
    cap = circle(40, .1)  # of embedded outlines it is an estimate, of second order in the size
    near(surfmink.embedded(cap, cap, [0, 40]).area[0] / surfmink.sphere(cap).area, 1, 1e-4)


@theorem
def a_curve_may_have_edges_too_unlike():
    unlike = np.insert(circle(40), 1, circle(40)[0] + [0, 1e-9], axis=0)
    error = raises(surfmink.Refused, "unlike_edges", surfmink.curve_plane, unlike)
    assert error.status == 100 and "unlike_edges" not in surfmink.STATUS_NAMES
    assert list(surfmink.curve_plane(unlike, [0, 41]).names) == ["unlike_edges"]


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
