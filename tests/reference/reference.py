#!/usr/bin/env python3
"""reference.py: makes the reference values of the tests again, in 50 digits, and compares them with the files.

    python3 tests/reference/reference.py                    all values of all files, 8 minutes
    python3 tests/reference/reference.py --sample           a random part of every file, in less than 30 seconds
    python3 tests/reference/reference.py --sample 7         the same part again
    python3 tests/reference/reference.py --write DIRECTORY  all values, and files with them in DIRECTORY
    python3 tests/reference/reference.py corr4 sweeps       files whose name contains one of these words

Runs from the root of the repository; needs Python 3 and mpmath. The formulas are those of the paper, in the form in
which the paper has them: logarithms on the sphere, projected differences, the sums of section 3. Fifty digits forgive
what costs half of the digits in doubles. Nothing is shared with surfmink.h.

Inputs are corners (tests/data/*points.tsv, x to nz; chart_uv), the names of curves and surfaces, the mesh and the field;
everything else is computed. Each value is compared as text, in the digits that the file has. A value that differs is an
error, unless the file was computed in doubles: then WHY says so, and how far off it may be. The last line counts the
values; the exit status is 1 if one is wrong or if none was compared."""
import math
import os
import random
import sys
import time

from mpmath import acos, atan2, cos, fdot, floor, log, mp, mpc, mpf, nstr, pi, sin, sqrt

DIGITS = 50
mp.dps = DIGITS
RANKS = 12
TESTS, PAPER = 'tests/data/', 'examples/paper/data/'

SAMPLE = 15  # seconds of the processor

# Where doubles made a file: how far it may be off, and why. (An error in the table is a difference of two numbers.)
WHY = {
    'corr4_ref': (2e-14, 'the scheme was computed in doubles'),
    'corr4 angle': (2e-14, 'the scheme was computed in doubles; an angle times p mu_p'),
    'torus': (3e-12, 'geodesics were computed in doubles'),
    'triangle90': (1.1e-15, 'computed in doubles'),
    'table': (1e-13, 'lengths, angles and mu were computed in doubles'),
    'table kappa': (2e-13, 'a sum of angles was computed in doubles'),
    'ellipsoid_geodesic': (2e-9, 'geodesics were computed in doubles'),
}


# --- vectors --------------------------------------------------------------------------------------------------------

def dot(a, b):
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]


def cross(a, b):
    return [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]]


def scaled(a, s):
    return [a[0] * s, a[1] * s, a[2] * s]


def minus(a, b):
    return [a[0] - b[0], a[1] - b[1], a[2] - b[2]]


def plus(a, b):
    return [a[0] + b[0], a[1] + b[1], a[2] + b[2]]


def size(a):
    return (a[0] * a[0] + a[1] * a[1] + a[2] * a[2]) ** (0.5 if isinstance(a[0], float) else mpf('0.5'))


def unit(a):
    return scaled(a, 1 / size(a))


def angle(normal, a, b):
    """Signed angle from a to b in the plane normal to `normal`."""
    return atan2(dot(normal, cross(a, b)), dot(a, b))


# --- the paper: from corners to mu ----------------------------------------------------------------------------------

def sphere_edges(x, radius):
    """Paper 4.1 and 5.1: log_x y is y - <x,y> x, stretched to the angle between x and y."""
    n, x = len(x), [unit(v) for v in x]
    away = lambda a, b: minus(b, scaled(a, dot(a, b)))
    length = [radius * atan2(size(away(x[i], x[(i + 1) % n])), dot(x[i], x[(i + 1) % n])) for i in range(n)]
    turning = [angle(x[i], scaled(away(x[i], x[i - 1]), -1), away(x[i], x[(i + 1) % n])) for i in range(n)]
    return length, turning


def chord_edges(x, normal):
    """Paper 4.2: edges are chords, angles those of their projections."""
    n, normal = len(x), [unit(v) for v in normal]
    onto = lambda v, i: minus(v, scaled(normal[i], dot(v, normal[i])))
    length = [size(minus(x[(i + 1) % n], x[i])) for i in range(n)]
    turning = [angle(normal[i], onto(minus(x[i], x[i - 1]), i), onto(minus(x[(i + 1) % n], x[i]), i))
               for i in range(n)]
    return length, turning


def components(length, turning, ranks, late=False, first=0):
    """g_p of paper (3.2), p = 0 .. ranks. late: with the index of paper 4.1, where the turn AT corner j counts j < i
    only. first: phase of edge 0."""
    total, phase, g = sum(turning), mpf(first), [mpc(0)] * (ranks + 1)
    for i in range(len(length)):
        if i > 0:
            phase += 2 * pi / total * turning[i - 1 if late else i]
        z, power = mp.expj(phase), mpc(length[i])
        for p in range(ranks + 1):
            g[p] += power
            power *= z
    return g


def phases(length, turning, late=False):
    total, phase = sum(turning), [mpf(0)]
    for i in range(1, len(turning)):
        phase.append(phase[-1] + 2 * pi / total * turning[i - 1 if late else i])
    return phase


def theta(g, p):
    """n = 0 eigenvector angle; none where mu_p is 0."""
    return mp.arg(g[p]) / p if abs(g[p]) > mpf('1e-8') * abs(g[0]) else mpf('nan')


# --- smooth curves: a chart of a surface, a curve in the chart ------------------------------------------------------

class Ellipsoid:
    """(theta, phi) -> (a sin theta cos phi, b sin theta sin phi, c cos theta)"""

    def __init__(self, axes):
        self.axes = axes

    def jet(self, u, v):
        """The point and its derivatives by u, v, uu, uv, vv."""
        (s, c), (t, d) = sine(u), sine(v)
        rows = [[s * d, s * t, c], [c * d, c * t, -s], [-s * t, s * d, 0 * s],
                [-s * d, -s * t, -c], [-c * t, c * d, 0 * s], [-s * d, -s * t, 0 * s]]
        return [[x * a for x, a in zip(row, self.axes)] for row in rows]

    def step(self, x, velocity, order):
        """Taylor series of the geodesic x'' = -(x'.H x') / |grad F|^2 grad F, F = sum (x_c / a_c)^2 / 2."""
        A = [1 / a ** 2 for a in self.axes]
        X = [[x[c], velocity[c]] for c in range(3)]
        V = [[velocity[c]] for c in range(3)]
        N, pull = [], []
        for k in range(order - 1):
            N.append(sum(A[c] ** 2 * product(X[c], X[c], k) for c in range(3)))
            bend = sum(A[c] * product(V[c], V[c], k) for c in range(3))
            pull.append((-bend - (product(N, pull + [0 * bend], k))) / N[0])
            for c in range(3):
                X[c].append(A[c] * product(pull, X[c], k) / ((k + 1) * (k + 2)))
                V[c].append((k + 2) * X[c][k + 2])
        return X

    def shoot(self, start, velocity):
        """Point and velocity after one unit of time."""
        x, v, left = list(start), list(velocity), 1
        while left > 0:
            series = self.step(x, v, order_of(x[0]))
            h = min(left, reach(series))
            x, v = [value(s, h) for s in series], [slope(s, h) for s in series]
            left -= h
        return x, v

    def log(self, a, b, guess=None):
        """The geodesic from a to b, chart points, next to a guess: its velocities at both ends."""
        (x, xu, xv), (y, yu, yv) = self.jet(*a)[:3], self.jet(*b)[:3]
        w = list(guess) if guess else [b[0] - a[0], b[1] - a[1]]

        def miss(w):
            end, velocity = self.shoot(x, plus(scaled(xu, w[0]), scaled(xv, w[1])))
            gap = minus(end, y)
            return [dot(gap, yu), dot(gap, yv)], velocity
        w, arrival = newton(miss, w)
        return w, plus(scaled(xu, w[0]), scaled(xv, w[1])), arrival


class Torus:
    """(phi, theta) -> ((R + r cos theta) cos phi, (R + r cos theta) sin phi, r sin theta)"""

    def __init__(self, axes):
        self.R, self.r = axes

    def jet(self, u, v):
        (s, c), (t, d) = sine(u), sine(v)
        rho, r, o = self.R + self.r * d, self.r, 0 * s
        return [[rho * c, rho * s, r * t], [-rho * s, rho * c, o], [-r * t * c, -r * t * s, r * d],
                [-rho * c, -rho * s, o], [r * t * s, -r * t * c, o], [-r * d * c, -r * d * s, -r * t]]

    def step(self, u, v, du, dv, order):
        """rho^2 phi' = h (Clairaut), theta'' = -(h^2 / r) sin theta / rho^3."""
        s, c = sine(v)
        S, C, U, V, D = [s], [c], [u], [v, dv], [dv]
        rho, inverse, square, cube = [self.R + self.r * c], [], [], []
        h = rho[0] ** 2 * du
        for k in range(order - 1):
            inverse.append((1 if k == 0 else -product(rho, inverse + [0 * h], k)) / rho[0])
            square.append(product(inverse, inverse, k))
            cube.append(product(inverse, square, k))
            U.append(h * square[k] / (k + 1))
            V.append(-h * h / self.r * product(S, cube, k) / ((k + 1) * (k + 2)))
            S.append(product(C, D, k) / (k + 1))
            C.append(-product(S, D, k) / (k + 1))
            rho.append(self.r * C[k + 1])
            D.append((k + 2) * V[k + 2])
        return [U, V]

    def shoot(self, start, velocity):
        u, v, du, dv, left = start[0], start[1], velocity[0], velocity[1], 1
        while left > 0:
            U, V = self.step(u, v, du, dv, order_of(u + v + du))
            h = min(left, reach([U, V]))
            u, v, du, dv = value(U, h), value(V, h), slope(U, h), slope(V, h)
            left -= h
        return [u, v], [du, dv]

    def log(self, a, b, guess=None):
        def miss(w):
            end, velocity = self.shoot(a, w)
            return [end[0] - b[0], end[1] - b[1]], velocity
        w, end = newton(miss, list(guess) if guess else [b[0] - a[0], b[1] - a[1]])
        (x, xu, xv), (y, yu, yv) = self.jet(*a)[:3], self.jet(*b)[:3]
        return w, plus(scaled(xu, w[0]), scaled(xv, w[1])), plus(scaled(yu, end[0]), scaled(yv, end[1]))


def sine(x):
    return (math.sin(x), math.cos(x)) if isinstance(x, float) else (sin(x), cos(x))


def order_of(x):
    return 18 if isinstance(x, float) else mp.dps + 5


def product(a, b, k):
    """Coefficient k of the product of two series."""
    if isinstance(a[0], float):
        return sum(x * y for x, y in zip(a[:k + 1], b[k::-1]))
    return fdot(a[:k + 1], b[k::-1])


def value(series, h):
    total = series[-1]
    for x in series[-2::-1]:
        total = total * h + x
    return total


def slope(series, h):
    return value([k * x for k, x in enumerate(series)][1:], h)


def reach(series):
    """How far a series goes until its last terms are no longer rounding."""
    eps = 1e-17 if isinstance(series[0][0], float) else mpf(10) ** (-mp.dps - 2)
    last = max(float(abs(s[-k])) for s in series for k in (1, 2)) if eps == 1e-17 else \
        max(abs(s[-k]) for s in series for k in (1, 2))
    return (eps / last) ** (1 / (eps * 0 + len(series[0]) - 1)) if last > 0 else 1


def newton(miss, w):
    """Two unknowns, derivatives by differences."""
    double = isinstance(w[0], float)
    tiny, goal = (1e-7, 1e-12) if double else (mpf(10) ** (-mp.dps // 2), mpf(10) ** (4 - mp.dps))
    for _ in range(40):
        gap, end = miss(w)
        big = abs(w[0]) + abs(w[1])
        h = tiny * big
        a, b = miss([w[0] + h, w[1]])[0], miss([w[0], w[1] + h])[0]
        m = [[(a[0] - gap[0]) / h, (b[0] - gap[0]) / h], [(a[1] - gap[1]) / h, (b[1] - gap[1]) / h]]
        determinant = m[0][0] * m[1][1] - m[0][1] * m[1][0]
        move = [(m[1][1] * gap[0] - m[0][1] * gap[1]) / determinant,
                (m[0][0] * gap[1] - m[1][0] * gap[0]) / determinant]
        w = [w[0] - move[0], w[1] - move[1]]
        if abs(move[0]) + abs(move[1]) <= goal * big:
            return w, miss(w)[1]
        if not double and abs(move[0]) + abs(move[1]) <= tiny * big / 1000:
            goal = mpf(1)  # the next step ends below rounding: its derivatives are good to half of the digits
    raise ArithmeticError('no geodesic')


def geodesic_edges(surface, chart, edges):
    """Lengths and turning angles from velocities at both ends of each edge."""
    n, turning = len(chart), []
    for i in range(n):
        jet = surface.jet(*chart[i])
        turning.append(angle(unit(cross(jet[1], jet[2])), edges[i - 1][2], edges[i][1]))
    return [size(e[1]) for e in edges], turning


def fourier(x, sign=-1):
    """sum_j x_j exp(sign 2 pi i j m / N), N a power of two."""
    n = len(x)
    if n == 1:
        return x
    even, odd, out = fourier(x[0::2], sign), fourier(x[1::2], sign), [None] * n
    for m in range(n // 2):
        turned = root(m, n, sign) * odd[m]
        out[m], out[m + n // 2] = even[m] + turned, even[m] - turned
    return out


ROOTS = {}


def root(m, n, sign):
    key = (n, mp.dps)
    if key not in ROOTS:
        ROOTS[key] = [mp.expjpi(mpf(2 * k) / n) for k in range(n // 2)]
    z = ROOTS[key][m]
    return z if sign > 0 else mp.conj(z)


class Flower:
    """u = u0 + r cos t, v = v0 + r sin t, r = r0 - a sin w t in the chart of a surface (paper 5.2)."""

    def __init__(self, surface, u0, v0, r0, a, w):
        self.surface, self.u0, self.v0, self.r0, self.a, self.w = surface, u0, v0, r0, a, w
        self.samples = 256
        while True:
            self.samples *= 2
            self.integrate()
            # Every second sample: an error that is squared when samples are doubled.
            if max(abs(a - b) for a, b in zip(self.half, self.g)) < mpf('1e-16') * self.length:
                break

    def point(self, t):
        """Chart point, point, unit normal, speed, curvature times speed."""
        (s, c), (ws, wc), w = sine(t), sine(self.w * t), self.w
        r, dr, ddr = self.r0 - self.a * ws, -self.a * w * wc, self.a * w * w * ws
        u, v = self.u0 + r * c, self.v0 + r * s
        du, dv = dr * c - r * s, dr * s + r * c
        ddu, ddv = (ddr - r) * c - 2 * dr * s, (ddr - r) * s + 2 * dr * c
        x, xu, xv, xuu, xuv, xvv = self.surface.jet(u, v)
        d = plus(scaled(xu, du), scaled(xv, dv))
        dd = plus(plus(scaled(xu, ddu), scaled(xv, ddv)),
                  plus(scaled(xuu, du * du), plus(scaled(xuv, 2 * du * dv), scaled(xvv, dv * dv))))
        normal = unit(cross(xu, xv))
        return (u, v), x, normal, size(d), dot(normal, cross(d, dd)) / dot(d, d)

    def integrate(self):
        """Fourier series of speed and turning, L, kappa and g_p read at t = 0."""
        n = self.samples
        both = [mpc(speed, turning) for _, _, _, speed, turning in (self.point(2 * pi * j / n) for j in range(n))]
        speed, turning = [z.real for z in both], [z.imag for z in both]
        c = [z / n for z in fourier(both)]
        mirror = [mp.conj(c[-m]) for m in range(n)]
        self.of_speed = [(a + b) / 2 for a, b in zip(c, mirror)]
        self.of_turning = [(a - b) / mpc(0, 2) for a, b in zip(c, mirror)]
        self.length, self.kappa = 2 * pi * c[0].real, 2 * pi * c[0].imag
        self.modes = max(m for m in range(1, n // 2) if abs(c[m]) > mpf(10) ** (-mp.dps) or m == 1)
        primitive = [mpc(0)] + [self.of_turning[m] / mpc(0, m if m < n // 2 else m - n) for m in range(1, n)]
        primitive[n // 2] = mpc(0)
        wave = fourier(primitive, 1)
        g, half = [mpc(0)] * (RANKS + 1), [mpc(0)] * (RANKS + 1)
        for j in range(n):
            f = 2 * pi / self.kappa * (c[0].imag * 2 * pi * j / n + (wave[j] - wave[0]).real)
            z, power = mp.expj(f), mpc(speed[j] * 2 * pi / n)
            for p in range(RANKS + 1):
                g[p] += power
                if j % 2 == 0:
                    half[p] += 2 * power
                power *= z
        self.g, self.half = g, half

    def integral(self, series, t):
        """From 0 to t."""
        z, total, start = mp.expj(t), mpc(0), mpc(0)
        for m in range(self.modes, 0, -1):
            b = series[m] / m
            total, start = (total + b) * z, start + b
        return series[0].real * t + 2 * ((total - start) / mpc(0, 1)).real

    def time(self, arc, guess):
        """The parameter of a point at a distance along the curve: Newton's method between bounds."""
        low, high, t = mpf(0), 2 * pi, guess
        for _ in range(200):
            off = self.integral(self.of_speed, t) - arc
            low, high = (low, t) if off > 0 else (t, high)
            move = off / self.point(t)[3]
            t = t - move if low <= t - move <= high else (low + high) / 2
            if abs(move) < mpf(10) ** (5 - mp.dps):
                return t
        raise ArithmeticError('no point')

    def times(self, q):
        t = [mpf(0)]
        for i in range(1, q):
            t.append(self.time(self.length * i / q, t[-1] + self.length / q / self.point(t[-1])[3]))
        return t

    def phase(self, t):
        return 2 * pi / self.kappa * self.integral(self.of_turning, t)


CURVES = {}


def flower(surface, *numbers):
    key = (type(surface).__name__, str(vars(surface)), numbers, mp.dps)
    if key not in CURVES:
        CURVES[key] = Flower(surface, *numbers)
    return CURVES[key]


# --- files ----------------------------------------------------------------------------------------------------------

class Table:
    """A file of the repository. Values that are computed again replace those that it has."""

    def __init__(self, path):
        self.path, self.lines = path, open(path, encoding='ascii').read().split('\n')
        named = [k for k, line in enumerate(self.lines) if line and not line.startswith('#')]
        self.columns = self.lines[named[0]].split('\t')
        self.rows = [Row(self, k) for k in named[1:]]
        self.name = os.path.basename(path).replace('.tsv', '')


class Row:
    def __init__(self, table, line):
        self.table, self.line, self.fields = table, line, table.lines[line].split('\t')

    def __getitem__(self, column):
        return self.fields[self.table.columns.index(column)]

    def double(self, column):
        return mpf(float(self[column]))

    def vector(self, columns):
        return [self.double(c) for c in columns.split()]


class Comparison:
    """Counts what was compared, file by file."""

    def __init__(self):
        self.same, self.near, self.worst, self.wrong = {}, {}, {}, []

    def value(self, row, column, number, form, why=None, weight=1, period=None):
        """form: a number -> text. why: a key of WHY, if doubles made the file. weight, period: of angles."""
        name, have = row.table.name, row[column]
        self.same.setdefault(name, 0)
        made = form(number)
        if made == have or (self.noise(number) and self.noise(mpf(have))):
            self.same[name] += 1
            return
        off = number - mpf(have)
        if period:
            off -= period * floor(off / period + mpf('0.5'))
        off = abs(off) * weight
        if why and off <= WHY[why][0] + self.digit(have) * weight:
            self.near[(name, why)] = self.near.get((name, why), 0) + 1
            self.worst[(name, why)] = max(self.worst.get((name, why), 0), off)
        else:
            self.wrong.append('%s:%d: %s is %s and should be %s (%s)' % (
                row.table.path, row.line + 1, column, have, made, nstr(number, 20)))
        row.fields[row.table.columns.index(column)] = made

    @staticmethod
    def noise(x):
        """0 in 50 digits."""
        return abs(x) < mpf('1e-30')

    @staticmethod
    def digit(text):
        """Half of the last printed digit, and a little."""
        body, _, power = text.partition('e')
        return mpf('0.51') * mpf(10) ** (int(power or 0) - len(body.partition('.')[2]))

    def report(self):
        for name in self.same:
            near = [(count, WHY[why][1], self.worst[(name, why)])
                    for (file, why), count in self.near.items() if file == name]
            print('%-30s %6d values to the last digit%s' % (name, self.same[name], ''.join(
                '; %d off by up to %s: %s' % (count, nstr(worst, 2), why) for count, why, worst in near)))
        for text in self.wrong[:20]:
            print(text)
        total = sum(self.same.values()) + sum(self.near.values()) + len(self.wrong)
        print('%d values compared, %d wrong' % (total, len(self.wrong)))
        return 0 if total > 0 and not self.wrong else 1


def significant(digits):
    """mpmath's own form."""
    return lambda x: nstr(x, digits)


def compact(x):
    """16 digits, with a power of ten below 0.01 and from 1000 on."""
    return nstr(x, 16, min_fixed=-3, max_fixed=3)


def general(digits):
    """%g, from 50 digits."""
    def form(x):
        if mp.isnan(x) or x == 0:
            return 'nan' if mp.isnan(x) else '0'
        body, _, power = nstr(x, digits, strip_zeros=False, min_fixed=0, max_fixed=0).partition('e')
        power = int(power or 0)
        if -5 < power < digits:
            figures = body.replace('.', '').replace('-', '')
            text = figures[:power + 1] + '.' + figures[power + 1:] if power >= 0 else '0.' + '0' * (-power - 1) + figures
            return ('-' if x < 0 else '') + text.rstrip('0').rstrip('.')
        return body.rstrip('0').rstrip('.') + 'e%+03d' % power
    return form


def fixed(places):
    def form(x):
        whole = int(floor(abs(x) * mpf(10) ** places + mpf('0.5')))
        text = str(whole).rjust(places + 1, '0')
        return ('-' if x < 0 else '') + text[:-places] + '.' + text[-places:]
    return form


def scientific(places):
    def form(x):
        if x == 0:
            return '0.' + '0' * places + 'e+00'
        body, _, power = nstr(x, places + 1, strip_zeros=False, min_fixed=0, max_fixed=0).partition('e')
        return body + 'e%+03d' % int(power or 0)
    return form


# --- the sets: each gives jobs (file, seconds, what to do), and a job compares some rows ----------------------------

SETS = {}


def a_set(*files):
    def keep(f):
        SETS[f.__name__] = (files, f)
        return f
    return keep


def spectrum(compare, row, length, turning, form):
    """L, S and all ranks of a polygon, as the reference sets have them."""
    g = components(length, turning, RANKS)
    compare.value(row, 'L', g[0].real, form)
    compare.value(row, 'sum_alpha', sum(turning), form)
    compare.value(row, 'deficit', 2 * pi - sum(turning), form)
    for p in range(1, RANKS + 1):
        compare.value(row, 'mu_%d' % p, abs(g[p]) / g[0].real, form)
        if row['theta_%d' % p] != 'nan' or abs(g[p]) > mpf('1e-8') * g[0].real:
            compare.value(row, 'theta_%d' % p, theta(g, p), form)


def polygons(name, edges, area):
    points, ref = Table(TESTS + name + '_points.tsv'), Table(TESTS + name + '_ref.tsv')

    def job(row):
        def run(compare):
            corners = [p for p in points.rows if p['case'] == row['case']]
            x, normal = [p.vector('x y z') for p in corners], [p.vector('nx ny nz') for p in corners]
            length, turning = edges(row, x, normal)
            for p, l, alpha in zip(corners, length, turning):
                compare.value(p, 'l', l, significant(17))
                compare.value(p, 'alpha', alpha, significant(17))
            spectrum(compare, row, length, turning, compact)
            if row['area'] != 'nan':
                compare.value(row, 'area', area(row, x, turning), compact)
        return run
    return [points, ref], [(0.1, job(r)) for r in ref.rows]


@a_set('sphere_geodesic')
def sphere_geodesic():
    return polygons('sphere_geodesic', lambda row, x, normal: sphere_edges(x, row.double('R')),
                    lambda row, x, turning: row.double('R') ** 2 * (2 * pi - sum(turning)))


@a_set('flat')
def flat():
    return polygons('flat', lambda row, x, normal: chord_edges(x, normal),
                    lambda row, x, turning: sum(cross(x[i - 1], x[i])[2] for i in range(len(x))) / 2)


@a_set('line_surface')
def line_surface():
    return polygons('line_surface', lambda row, x, normal: chord_edges(x, normal), None)


def named_surface(row, number):
    axes = [number(a) for a in row['params'].split(';')]
    return Torus(axes) if row['surface'] == 'tor' else Ellipsoid(axes)


@a_set('geodesic_surface')
def geodesic_surface():
    """Corners are the chart doubles; the area is the integral of 1 over the inside: by Green's theorem in the chart."""
    points, edges, ref = (Table(TESTS + 'geodesic_surface_%s.tsv' % n) for n in ('points', 'edges', 'ref'))

    def job(row):
        def run(compare):
            surface = named_surface(row, lambda text: mpf(float(text)))
            chart = [[mpf(float(c)) for c in pair.split(',')] for pair in row['chart_uv'].split('|')]
            n = len(chart)
            ways = [surface.log(chart[i], chart[(i + 1) % n]) for i in range(n)]
            length, turning = geodesic_edges(surface, chart, ways)
            for i, (p, e) in enumerate(zip([p for p in points.rows if p['case'] == row['case']],
                                           [e for e in edges.rows if e['case'] == row['case']])):
                x, xu, xv = surface.jet(*chart[i])[:3]
                for k, number in zip('x y z nx ny nz'.split(), x + unit(cross(xu, xv))):
                    compare.value(p, k, number, significant(18))
                compare.value(p, 'l', length[i], significant(17))
                compare.value(p, 'alpha', turning[i], significant(17))
                compare.value(e, 'l', length[i], significant(18))
                for k, number in zip('t0x t0y t0z t1x t1y t1z'.split(), unit(ways[i][1]) + unit(ways[i][2])):
                    compare.value(e, k, number, significant(18))
            spectrum(compare, row, length, turning, compact)
            compare.value(row, 'area', chart_area(surface, chart, ways), compact)
        return run
    return [points, edges, ref], [(2 * int(r['q']), job(r)) for r in ref.rows]


def chart_area(surface, chart, ways):
    """Integral of dA, to 20 digits: that of a one-form along the edges, whose derivative is dA."""
    return sum(edge_area(surface, chart[i], ways[i]) for i in range(len(chart)))


GAUSS = {}


def gauss(n):
    """Nodes and weights on [0, 1]."""
    if (n, mp.dps) not in GAUSS:
        rule = []
        for k in range(n):
            x = cos(pi * (k + mpf(3) / 4) / (n + mpf(1) / 2))
            for _ in range(8):
                a, b = mpf(1), x
                for j in range(2, n + 1):
                    a, b = b, ((2 * j - 1) * x * b - (j - 1) * a) / j
                d = n * (x * b - a) / (x * x - 1)
                x -= b / d
            rule.append(((1 + x) / 2, 1 / ((1 - x * x) * d * d)))
        GAUSS[(n, mp.dps)] = rule
    return GAUSS[(n, mp.dps)]


def edge_area(surface, a, way):
    """Torus: dA = r rho dphi dtheta = -d(r (R theta + r sin theta) dphi). Ellipsoid: dA = |x_u x x_v| du dv is the
    derivative of F dphi with F = integral of the density from theta = 0."""
    total = mpf(0)
    for s, weight in gauss(24):
        if isinstance(surface, Torus):
            end, velocity = surface.shoot(a, [s * c for c in way[0]])
            total -= weight * surface.r * (surface.R * end[1] + surface.r * sin(end[1])) * velocity[0] / s
            continue
        x, velocity = surface.shoot(surface.jet(*a)[0], scaled(way[1], s))
        A, B, C = surface.axes
        v = atan2(x[1] / B, x[0] / A)
        u = acos(x[2] / C)
        dv = (velocity[1] / B * cos(v) - velocity[0] / A * sin(v)) / sin(u) / s
        inner = sum(w * density(surface, u * t, v) for t, w in gauss(24)) * u
        total += weight * inner * dv
    return total


def density(surface, u, v):
    x, xu, xv = surface.jet(u, v)[:3]
    return size(cross(xu, xv))


def named_flower(row):
    parts = dict(part.split('=') for part in row['curve'].split(';'))
    return flower(named_surface(row, mpf), *[mpf(parts[k]) for k in 'u0 v0 r0 a'.split()], int(parts['w']))


def smooth(compare, row, curve, form, kappa='kappa'):
    compare.value(row, 'L', curve.length, form)
    compare.value(row, kappa, curve.kappa, form)
    for p in range(1, RANKS + 1):
        compare.value(row, 'mu_%d' % p, abs(curve.g[p]) / curve.length, form)


@a_set('xsmooth', 'smooth_flowers')
def xsmooth():
    ref, paper = Table(TESTS + 'xsmooth_ref.tsv'), Table(PAPER + 'smooth_flowers.tsv')

    def job(row):
        def run(compare):
            curve = named_flower(row)
            copy = [p for p in paper.rows if p['L'] == row['L']]
            for r in [row] + copy:
                smooth(compare, r, curve, compact)
                for p in range(1, RANKS + 1):
                    compare.value(r, 'theta_%d' % p, theta(curve.g, p), compact)
        return run
    return [ref, paper], [(3, job(r)) for r in ref.rows]


@a_set('ellipsoid_sweeps')
def sweeps():
    ref = Table(PAPER + 'ellipsoid_sweeps.tsv')

    def job(row):
        def run(compare):
            curve = flower(Ellipsoid([mpf('1.6'), mpf('1.3'), mpf(1)]), pi / 2, mpf(row['y0_over_pi']) * pi,
                           mpf(row['r0']), mpf(row['a']), int(row['omega']))
            compare.value(row, 'L', curve.length, significant(17))
            compare.value(row, 'kappa', curve.kappa, significant(17))
            for p in range(1, RANKS + 1):
                compare.value(row, 'mu_%d' % p, abs(curve.g[p]) / curve.length, significant(16))
        return run
    return [ref], [(6 if float(r['a']) > 0.11 else 2, job(r)) for r in ref.rows]


@a_set('corr4')
def corr4():
    """The fourth-order scheme of docs/internals/beyond.md from its formulas, and the smooth curves that it stands for."""
    points, ref = Table(TESTS + 'corr4_points.tsv'), Table(TESTS + 'corr4_ref.tsv')
    curves = {'c400': lambda: flower(Ellipsoid([mpf('1.6'), mpf('1.3'), mpf(1)]), pi / 2, pi / 4, mpf('0.7'),
                                     mpf('0.2'), 3),
              'c401': lambda: flower(Torus([mpf(2), mpf('0.8')]), mpf('0.4'), mpf('0.9'), mpf('0.5'), mpf('0.1'), 4),
              'c402': lambda: flower(Ellipsoid([mpf(1)] * 3), pi / 2, pi / 4, mpf('0.5'), mpf('0.1'), 4)}

    def job(row):
        def run(compare):
            corners = [p for p in points.rows if p['case'] == row['case']]
            g, total = fourth_order([p.vector('x y z') for p in corners], [p.vector('nx ny nz') for p in corners])
            form, length, curve = general(14), g[0].real, curves[row['case']]()
            compare.value(row, 'L4', length, form, 'corr4_ref')
            compare.value(row, 'S4', total, form, 'corr4_ref')
            compare.value(row, 'L_exact', curve.length, form, 'corr4_ref')
            compare.value(row, 'kappa_exact', curve.kappa, form, 'corr4_ref')
            for p in range(1, RANKS + 1):
                mu = abs(g[p]) / length
                compare.value(row, 'mu4_%d' % p, mu, form, 'corr4_ref')
                compare.value(row, 'mu_exact_%d' % p, abs(curve.g[p]) / curve.length, form, 'corr4_ref')
                compare.value(row, 'theta4mid_%d' % p, mp.arg(g[p]) / p, form, 'corr4 angle', p * mu, 2 * pi / p)
        return run
    return [points, ref], [(1.3, job(r)) for r in ref.rows]


def fourth_order(x, normal):
    n = len(x)
    on, back = lambda i: (i + 1) % n, lambda i: i - 1
    normal = [unit(v) for v in normal]
    l, alpha = chord_edges(x, normal)
    a, w = [], []
    for i in range(n):
        e = scaled(minus(x[on(i)], x[i]), 1 / l[i])
        mean = plus(normal[i], normal[on(i)])
        b = cross(unit(minus(mean, scaled(e, dot(mean, e)))), e)
        change = minus(normal[on(i)], normal[i])
        a.append(-dot(change, e))
        w.append(-dot(change, b))
    A = [a[i] * w[i] / 6 for i in range(n)]
    beta = [alpha[i] + A[i] - A[back(i)] for i in range(n)]
    kv = [2 * beta[i] / (l[back(i)] + l[i]) for i in range(n)]
    D, E = [], []
    for i in range(n):
        u = (l[back(i)] + l[i] / 2) / (l[back(i)] + l[i] + l[on(i)])
        D.append(((1 - u) * kv[i] + u * kv[on(i)]) * l[i])
    t = [w[i] / l[i] for i in range(n)]
    for i in range(n):
        c0, c1 = (l[back(i)] + l[i]) / 2, (l[i] + l[on(i)]) / 2
        dt = ((t[on(i)] - t[i]) * c0 / c1 + (t[i] - t[back(i)]) * c1 / c0) / (c0 + c1)
        E.append((a[i] * dt * l[i] ** 2 + D[i] * (a[i] ** 2 - w[i] ** 2)) / 12)
    turn = [beta[i] - (E[back(i)] + E[i]) / 2 for i in range(n)]
    total, f, g = sum(turn), mpf(0), [mpc(0)] * (RANKS + 1)
    for i in range(n):
        f += 2 * pi / total * turn[i] if i else 0
        h = l[i] * (1 + (D[i] ** 2 + a[i] ** 2) / 24)
        for p in range(RANKS + 1):
            g[p] += h * mp.sinc(p * pi * D[i] / total) * mp.expj(p * f)
    bend = 3 * (kv[1] - kv[0]) / (l[-1] + l[0] + l[1])
    return [g[p] * mp.expj(p * 2 * pi / total * bend * l[0] ** 2 / 24) for p in range(RANKS + 1)], total


@a_set('triangle90')
def triangle90():
    """Parallel transport to a point of edge 0: the phases are the plain sums of right angles."""
    ref = Table(PAPER + 'triangle90.tsv')

    def job(row):
        def run(compare):
            u = mpf(row['u'])
            for p in range(1, 7):
                quarter = mp.expjpi(mpf(p) / 2)
                g = (1 - u) + quarter + quarter ** 2 + u * quarter ** 3
                compare.value(row, 'mu_%d' % p, abs(g) / 3, fixed(15), 'triangle90')
        return run
    return [ref], [(0.01, job(r)) for r in ref.rows]


@a_set('torus_triangles')
def torus_triangles():
    """theta_2 is led from 0.9 pi to each row in doubles; then the geodesic is made as sharp as it has to be."""
    ref = Table(PAPER + 'torus_triangles.tsv')
    led = {}

    def guesses():
        torus, before = Torus([2.0, 1.375]), []
        for row in ref.rows:
            end = [1.55, float(row['theta2_over_pi']) * math.pi]
            way = before[-1] if before else [None, None]
            if len(before) > 1:
                way = [[2 * a - b for a, b in zip(before[-1][k], before[-2][k])] for k in range(2)]
            before.append([torus.log([0.0, math.pi], end, way[0])[0], torus.log(end, [3.1, math.pi], way[1])[0]])
            led[row.line] = before[-1]

    def job(row):
        def run(compare):
            if not led:
                guesses()
            with mp.workdps(25):
                torus = Torus([mpf(2), mpf('1.375')])
                chart = [[mpf(0), +pi], [mpf('1.55'), mpf(row['theta2_over_pi']) * pi], [mpf('3.1'), +pi]]
                ways = [torus.log(chart[i], chart[i + 1], [mpf(c) for c in led[row.line][i]]) for i in range(2)]
                ways.append(torus.log(chart[2], chart[0]))
                length, turning = geodesic_edges(torus, chart, ways)
                g, late = components(length, turning, 6), components(length, turning, 6, late=True)
                numbers = {'sum_alpha': sum(turning)}
                for i in range(3):
                    numbers['l%d' % (i + 1)], numbers['alpha%d' % (i + 1)] = length[i], turning[i]
                for p in range(2, 7):
                    numbers['mu%d' % p], numbers['lag_mu%d' % p] = abs(g[p]) / g[0].real, abs(late[p]) / g[0].real
                for column, number in numbers.items():
                    compare.value(row, column, number, fixed(12), 'torus')
        return run
    return [ref], [(3, job(r)) for r in ref.rows]


def table_errors(name, surface, edges, why, seconds):
    """Tables 1 and 2 of the paper, with both indices."""
    ref = Table(PAPER + name + '.tsv')
    known = {}

    def errors(q):
        if q in known:
            return known[q]
        curve = flower(surface, pi / 2, pi / 4, mpf('0.7'), mpf('0.2'), 3)
        t = curve.times(q)
        at = [curve.point(s) for s in t]
        length, turning = edges([p[0] for p in at], [p[1] for p in at], [p[2] for p in at])
        g, late = components(length, turning, 3), components(length, turning, 3, late=True)
        total, kappa = sum(length), sum(turning)
        split = 2 * pi / kappa * turning[0] * length[0] / (length[-1] + length[0])
        middle = curve.phase(curve.time(curve.length / (2 * q), (t[1] - t[0]) / 2))
        smooth3, exact = curve.g[3] / curve.length, [curve.phase(s) for s in t]
        worst = lambda f: max(abs(a - b) for a, b in zip(f, exact))
        mu, mu_late = abs(g[3]) / total, abs(late[3]) / total
        known[q] = {
            'L_err': abs(total - curve.length), 'kappa_err': abs(kappa - curve.kappa),
            'f_lag_err': worst(phases(length, turning, True)), 'f_std_err': worst(phases(length, turning)),
            'g_lag_err_over4': abs(late[3] / total - smooth3) / 4, 'g_std_err': abs(g[3] / total - smooth3),
            'g_std_split_err': abs(g[3] / total * mp.expj(3 * split) - smooth3),
            'g_std_midedge_err': abs(g[3] / total - smooth3 * mp.expj(-3 * middle)),
            'mu3_std_err': abs(mu - abs(smooth3)), 'mu3_lag_err': abs(mu_late - abs(smooth3)),
            'L_q': total, 'kappa_q': kappa, 'mu3_std': mu, 'mu3_lag': mu_late}
        return known[q]

    def job(row):
        def run(compare):
            with mp.workdps(34):
                now = errors(int(row['q']))
                for column, number in now.items():
                    form = general(15) if column in ('L_q', 'kappa_q', 'mu3_std', 'mu3_lag') else scientific(6)
                    compare.value(row, column, number, form, why + ' kappa' if why + ' kappa' in WHY and
                                  column.startswith('kappa') else why)
                if row['eoc_L_err'] != '---':
                    before = errors(int(row['q']) // 2)
                    for column in (c for c in row.table.columns if c.startswith('eoc_')):
                        compare.value(row, column, log(before[column[4:]] / now[column[4:]], 2), fixed(2))
        return run
    return [ref], [(3 + seconds * int(r['q']), job(r)) for r in ref.rows]


UNIT, EGG = Ellipsoid([mpf(1)] * 3), Ellipsoid([mpf('1.6'), mpf('1.3'), mpf(1)])


@a_set('table1_reference')
def table1():
    return table_errors('table1_reference', UNIT, lambda chart, x, n: sphere_edges(x, 1), 'table', 0.02)


@a_set('table2_reference')
def table2():
    return table_errors('table2_reference', EGG, lambda chart, x, n: chord_edges(x, n), 'table', 0.03)


@a_set('ellipsoid_geodesic_reference')
def table3():
    def edges(chart, x, n):
        ways = [EGG.log(chart[i], chart[(i + 1) % len(chart)]) for i in range(len(chart))]
        return geodesic_edges(EGG, chart, ways)
    return table_errors('ellipsoid_geodesic_reference', EGG, edges, 'ellipsoid_geodesic', 0.15)


# --- level sets on meshes -------------------------------------------------------------------------------------------

def mesh_normals(vertex, triangles):
    """Of each vertex, not unit: twice the areas of its triangles."""
    normal = {}
    for t in triangles:
        area = cross(minus(vertex[t[1]], vertex[t[0]]), minus(vertex[t[2]], vertex[t[0]]))
        for v in t:
            normal[v] = plus(normal[v], area) if v in normal else area
    return normal


def level_set(vertex, triangles, field, level, above):
    """Closed loops, the inside on the left: lists of corners and normals. A vertex at the level counts as above."""
    after, cut = {}, [t for t in triangles if len({field[v] >= level for v in t}) == 2]
    touched = {v for t in cut for v in t}
    normal = mesh_normals(vertex, [t for t in triangles if touched.intersection(t)])
    for t in cut:
        inside = [(field[v] >= level) == above for v in t]
        for k in range(3):
            if inside[k] and not inside[(k + 1) % 3]:
                leaves = frozenset((t[k], t[(k + 1) % 3]))
            if not inside[k] and inside[(k + 1) % 3]:
                enters = frozenset((t[k], t[(k + 1) % 3]))
        after[leaves] = enters  # the loop runs from where the border leaves the inside to where it comes back

    def point(edge):
        a, b = sorted(edge)
        s = (level - field[a]) / (field[b] - field[a])
        na, nb = unit(normal[a]), unit(normal[b])
        return plus(scaled(vertex[a], 1 - s), scaled(vertex[b], s)), unit(plus(scaled(na, 1 - s), scaled(nb, s)))
    loops = []
    while after:
        edge = next(iter(after))
        loop = []
        while edge in after:
            loop.append(point(edge))
            edge = after.pop(edge)
        loops.append(loop)
    return loops


@a_set('sphere_grf_seed1')
def contours():
    """Corners from the mesh and the field; what is measured from the corners, as decimals."""
    cells, ref = Table(TESTS + 'sphere_grf_seed1.contours.cells.tsv'), Table(TESTS + 'sphere_grf_seed1.contours.ref.tsv')
    form, made = general(17), {}

    def loops(level):
        if not made:
            lines = [line.split() for line in open(TESTS + 'sphere_geodesic16.mesh.off', encoding='ascii')
                     if not line.startswith('#')]
            count = int(lines[1][0])
            made['vertex'] = [[mpf(c) for c in line[:3]] for line in lines[2:2 + count]]
            made['triangle'] = [[int(v) for v in line[1:4]] for line in lines[2 + count:] if line]
            made['field'] = [mpf(line) for line in open(TESTS + 'sphere_grf_seed1.field.txt', encoding='ascii')]
        if level not in made:
            made[level] = level_set(made['vertex'], made['triangle'], made['field'], level, True)
        return made[level]

    def job(row):
        def run(compare):
            corners = [c for c in cells.rows if c['cell'] == row['cell']]
            x = [[mpf(c[k]) for k in 'x y z'.split()] for c in corners]
            length, turning = chord_edges(x, [[mpf(c[k]) for k in 'nx ny nz'.split()] for c in corners])
            g = components(length, turning, 6)
            compare.value(row, 'L', g[0].real, form)
            compare.value(row, 'sum_alpha', sum(turning), form)
            for p in range(2, 7):
                compare.value(row, 'mu_%d' % p, abs(g[p]) / g[0].real, form)
                compare.value(row, 'arg_%d' % p, mp.arg(g[p]), form)
            found = [(loop, k) for loop in loops(mpf(row['level'])) if len(loop) == len(x)
                     for k in range(len(loop)) if size(minus(loop[k][0], x[0])) < 1e-8]
            if len(found) != 1:
                compare.wrong.append('%s: no loop of cell %s' % (cells.path, row['cell']))
                return
            loop, first = found[0]
            for i, c in enumerate(corners):
                at = loop[(first + i) % len(loop)]
                for column, number in zip('x y z nx ny nz'.split(), at[0] + at[1]):
                    compare.value(c, column, number, fixed(10 if len(column) == 1 else 9))
        return run
    return [cells, ref], [(1 + 0.02 * int(r['n']), job(r)) for r in ref.rows]


ICOSAHEDRON = [(0, 11, 5), (0, 5, 1), (0, 1, 7), (0, 7, 10), (0, 10, 11), (1, 5, 9), (5, 11, 4), (11, 10, 2),
               (10, 7, 6), (7, 1, 8), (3, 9, 4), (3, 4, 2), (3, 2, 6), (3, 6, 8), (3, 8, 9), (4, 9, 5), (2, 4, 11),
               (6, 2, 10), (8, 6, 7), (9, 8, 1)]
OCTAHEDRON = [(0, 2, 4), (2, 1, 4), (1, 3, 4), (3, 0, 4), (2, 0, 5), (1, 2, 5), (3, 1, 5), (0, 3, 5)]


@a_set('levelset_sphere')
def levelset():
    """The flower of paper 5.2 as the zero level of a function on the vertices of refined solids."""
    ref = Table(PAPER + 'levelset_sphere.tsv')
    exact = {2: '.041307578749043', 4: '.169084042925900', 6: '.0742854634691783', 8: '.301915775390885'}
    solids = {}

    def rho(x):
        over = acos(x[2]) - pi / 2
        along = atan2(x[1], x[0]) - pi / 4
        return sqrt(over ** 2 + along ** 2) - (mpf('0.5') - mpf('0.1') * sin(4 * atan2(along, over)))

    def refined(name, level):
        """Only triangles near the curve are kept: within 6 edges of it, for the normals."""
        if (name, level) in solids:
            return solids[(name, level)]
        if level == 0:
            if name == 'octa':
                vertex = [[mpf((1 - 2 * (k % 2)) * (k // 2 == c)) for c in range(3)] for k in range(6)]
                triangles = OCTAHEDRON
            else:
                golden, vertex, triangles = (1 + sqrt(mpf(5))) / 2, [], ICOSAHEDRON
                for k in range(12):
                    x = [mpf(0)] * 3
                    x[k // 4], x[(k // 4 + 1) % 3] = mpf(1 if k % 2 else -1), golden if k % 4 < 2 else -golden
                    vertex.append(unit(x))
            field = [rho(x) for x in vertex]
        else:
            vertex, triangles, field, longest = refined(name, level - 1)
            vertex, field, middle, parts = list(vertex), list(field), {}, []

            def between(a, b):
                key = (min(a, b), max(a, b))
                if key not in middle:
                    middle[key] = len(vertex)
                    vertex.append(unit(plus(vertex[a], vertex[b])))
                    field.append(rho(vertex[-1]))
                return middle[key]
            for a, b, c in triangles:
                if min(abs(field[v]) for v in (a, b, c)) > 6 * longest:
                    continue
                ab, bc, ca = between(a, b), between(b, c), between(c, a)
                parts += [(a, ab, ca), (ab, b, bc), (ca, bc, c), (ab, bc, ca)]
            triangles = parts
        longest = max(size(minus(vertex[t[k]], vertex[t[k - 1]])) for t in triangles for k in range(3))
        solids[(name, level)] = vertex, triangles, field, longest
        return solids[(name, level)]

    def job(row):
        def run(compare):
            with mp.workdps(30):
                vertex, triangles, field, longest = refined(row['mesh'], int(row['level']))
                loops = level_set(vertex, triangles, field, 0, False)
                if len(loops) != 1:
                    compare.wrong.append('%s:%d: %d loops' % (ref.path, row.line + 1, len(loops)))
                    return
                length, turning = chord_edges([c[0] for c in loops[0]], [c[1] for c in loops[0]])
                g, late = components(length, turning, 8), components(length, turning, 8, late=True)
                compare.value(row, 'h', longest, fixed(6))
                compare.value(row, 'q', mpf(len(length)), lambda x: str(int(x)))
                compare.value(row, 'lmin_over_lmax', min(length) / max(length), scientific(2))
                for p in (2, 4, 6, 8):
                    mu, mu_late = abs(g[p]) / g[0].real, abs(late[p]) / g[0].real
                    compare.value(row, 'mu%d' % p, mu, fixed(10))
                    compare.value(row, 'err%d' % p, abs(mu - mpf(exact[p])), scientific(3))
                    compare.value(row, 'lag_err%d' % p, abs(mu_late - mpf(exact[p])), scientific(3))
        return run
    return [ref], [(0.4 * 2 ** int(r['level']), job(r)) for r in ref.rows]


# --- all of it ------------------------------------------------------------------------------------------------------

def main(arguments):
    sample = '--sample' in arguments
    write = arguments[arguments.index('--write') + 1] if '--write' in arguments else None
    words = [a for a in arguments if not a.startswith('--') and a != write and not a.isdigit()]
    seeds = [int(a) for a in arguments if a.isdigit()]
    chosen = [SETS[s][1]() for s in SETS if not words or any(w in f for w in words for f in SETS[s][0])]
    compare = Comparison()
    if sample:
        seed = seeds[0] if seeds else random.randrange(10 ** 6)
        chance = random.Random(seed)
        print('sample %d' % seed)
        first, rest = [], []
        for _, some in chosen:  # one job of every set, then whatever there is time for
            cheap = [job for job in some if job[0] <= 5] or [min(some, key=lambda job: job[0])]
            first.append(chance.choice(cheap))
            rest += [job for job in some if job is not first[-1]]
        chance.shuffle(first)
        chance.shuffle(rest)
        for seconds, run in first + rest:
            if time.process_time() + seconds < SAMPLE:
                run(compare)
    else:
        for _, some in chosen:
            for _, run in some:
                run(compare)
    for table in (t for tables, _ in chosen for t in tables) if write else []:
        lines = list(table.lines)
        for row in table.rows:
            lines[row.line] = '\t'.join(row.fields)
        with open(os.path.join(write, os.path.basename(table.path)), 'w', encoding='ascii') as file:
            file.write('\n'.join(lines))
    return compare.report()


if __name__ == '__main__':
    sys.exit(main(sys.argv[1:]))
