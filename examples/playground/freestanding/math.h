/* math.h - the few functions of libm that examples/surfaces and playground.c ask for, where there is no libm:
   WebAssembly without a runtime. MIT or public domain, as surfmink.h, which itself asks for sqrt alone.

     clang --target=wasm32 -ffreestanding -fno-math-errno -isystem examples/playground/freestanding ...

   Why not JavaScript's Math: its standard leaves the accuracy of sin, cos and atan2 to the browser. WebAssembly's own
   arithmetic is the same everywhere, so with these functions a page computes the same bits in every browser, and what
   was tested in one of them holds in all.

   Accuracy (tests/check/playground.c, half a million arguments against long double): sin and cos within 0.8 units in
   the last place for |x| up to 1e5, atan2 within 1.7, hypot within 2. Beyond 1e5 sin and cos lose a digit for each in
   x: phases are sums of turns and never come there. sqrt is an instruction, and rounds correctly. */
#ifndef FREESTANDING_MATH_H
#define FREESTANDING_MATH_H

#define HUGE_VAL __builtin_inf()

static inline double fabs(double x)
{
    return __builtin_fabs(x);
}

static inline double sqrt(double x)
{
    return __builtin_sqrt(x); /* an instruction */
}

static inline double floor(double x)
{
    return __builtin_floor(x);
}

static inline double ceil(double x)
{
    return __builtin_ceil(x);
}

/* As in C: a NaN counts as missing. (That instruction would return it.) */
static inline double fmin(double a, double b)
{
    return a < b || b != b ? a : b;
}

static inline double fmax(double a, double b)
{
    return a > b || b != b ? a : b;
}

static inline double hypot(double a, double b)
{
    double large = fabs(a), small = fabs(b), t;
    if (large < small) {
        t = large;
        large = small;
        small = t;
    }
    if (!(large > 0) || large == HUGE_VAL) return large;
    t = small / large;
    return large * sqrt(1 + t * t);
}

static inline double ldexp(double x, int exponent)
{
    for (; exponent > 0; --exponent) x *= 2;
    for (; exponent < 0; ++exponent) x /= 2;
    return x;
}

/* What torus.h and implicit.h name in functions that a page does not call. */
double pow(double x, double y);
double remainder(double x, double y);

/* sin(x + low) and cos(x + low) for |x| <= pi / 4 and a tiny low: Taylor series to x^17 and x^16. The first terms left
   out are below 2e-18 there. */
static inline double math__sine(double x, double low)
{
    double z = x * x, p;
    p = 1 / 355687428096000.0;
    p = -1 / 1307674368000.0 + z * p;
    p = 1 / 6227020800.0 + z * p;
    p = -1 / 39916800.0 + z * p;
    p = 1 / 362880.0 + z * p;
    p = -1 / 5040.0 + z * p;
    p = 1 / 120.0 + z * p;
    p = -1 / 6.0 + z * p;
    return x + (low * (1 - z / 2) + x * z * p);
}

static inline double math__cosine(double x, double low)
{
    double z = x * x, p, half = z / 2, most = 1 - half;
    p = 1 / 20922789888000.0;
    p = -1 / 87178291200.0 + z * p;
    p = 1 / 479001600.0 + z * p;
    p = -1 / 3628800.0 + z * p;
    p = 1 / 40320.0 + z * p;
    p = -1 / 720.0 + z * p;
    p = 1 / 24.0 + z * p;
    return most + (((1 - most) - half) + (z * z * p - x * low)); /* what rounding took from 1 - z / 2, too */
}

/* x less a whole number of quarter turns. pi / 2 in three parts: the first two have 33 bits, so that their multiples
   are exact. Returns the number modulo 4. */
static inline int math__quarters(double x, double *rest, double *low)
{
    double k = floor(x * 0.63661977236758134308 + 0.5), t, w;
    t = x - k * 1.57079632673412561417;
    w = t - k * 6.07710050630396597660e-11;
    *low = (t - w) - k * 6.07710050630396597660e-11; /* what rounding took */
    *low -= k * 2.02226624879595063154e-21;
    *rest = w + *low;
    *low += w - *rest;
    return (int)(k - 4 * floor(k / 4));
}

static inline double sin(double x)
{
    double rest, low;
    if (!(fabs(x) < 1e9)) return x - x; /* NaN for what is not finite, and nothing worse than 0 for what is too large */
    switch (math__quarters(x, &rest, &low)) {
    case 0: return math__sine(rest, low);
    case 1: return math__cosine(rest, low);
    case 2: return -math__sine(rest, low);
    default: return -math__cosine(rest, low);
    }
}

static inline double cos(double x)
{
    double rest, low;
    if (!(fabs(x) < 1e9)) return x - x;
    switch (math__quarters(x, &rest, &low)) {
    case 0: return math__cosine(rest, low);
    case 1: return -math__sine(rest, low);
    case 2: return -math__cosine(rest, low);
    default: return math__sine(rest, low);
    }
}

/* atan t = atan c + atan((t - c) / (1 + t c)) with c = 0, 1/2 or 1, whatever is next to t = y / x: then the series is
   that of a number below 1/4, and y - c x is exact. */
static inline double math__arc(double y, double x) /* 0 <= y <= x */
{
    double u, z, p, high = 0, low = 0;
    int k;
    if (y < 0.25 * x) {
        u = y / x;
    } else if (y < 0.75 * x) {
        u = (y - 0.5 * x) / (x + 0.5 * y);
        high = 0.46364760900080609352; /* atan(1/2) */
        low = 2.26987774529616870924e-17;
    } else {
        u = (y - x) / (x + y);
        high = 0.78539816339744827900; /* atan(1) */
        low = 3.06161699786838301793e-17;
    }
    z = u * u;
    for (p = 1 / 27.0, k = 25; k >= 3; k -= 2) p = 1.0 / k - z * p;
    return high + (u - (u * z * p - low));
}

static inline double atan2(double y, double x)
{
    double up = fabs(y), right = fabs(x), angle;
    if (up != up || right != right) return up + right;
    if (up == HUGE_VAL || right == HUGE_VAL) {
        up = up == HUGE_VAL;
        right = right == HUGE_VAL;
    } else if (!(up > 0) && !(right > 0)) {
        right = 1; /* the axis itself: 0 or pi, by the sign of x */
    }
    while (up > 1e300 || right > 1e300) up *= 0.25, right *= 0.25;
    if (up <= right)
        angle = math__arc(up, right);
    else
        angle = 1.57079632679489655800 - (math__arc(right, up) - 6.12323399573676603587e-17);
    if (x < 0 || (!(x > 0) && __builtin_signbit(x)))
        angle = 3.14159265358979311600 - (angle - 1.22464679914735320717e-16);
    return __builtin_copysign(angle, y);
}

#endif /* FREESTANDING_MATH_H */
