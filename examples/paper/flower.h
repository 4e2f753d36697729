/* flower.h - the flower curve of paper 5.2 on an ellipsoid, and its exact measures.

     flower curve = {{1.6, 1.3, 1.0}, 0.7, 0.2, 3, PI / 2, PI / 4};         // axes, r0, a, omega, x0, y0
     flower_exact exact;
     flower_integrate(&curve, &exact);                                      // exact.length, exact.kappa
     flower_components(&exact, 0, 10, g);                                   // g_p of the smooth curve, read at t = 0
     flower_polygon(&exact, q, corner, normal);                             // q corners, equally far apart along it

   The integrands are smooth and periodic in t, so the trapezoidal rule and Fourier series converge faster than any
   power of the number of samples: 2048 give 14 digits for every curve of the paper. */
#ifndef FLOWER_H
#define FLOWER_H

#include <math.h>
#include <stddef.h>

#ifndef PI
#define PI 3.14159265358979323846
#endif

#define FLOWER_SAMPLES 2048
#define FLOWER_MODES   1000

typedef struct flower {
    double axis[3], r0, a;
    int omega;
    double x0, y0; /* theta = x0 + r cos t, phi = y0 + r sin t, r = r0 - a sin(omega t) */
} flower;

/* mean + sum of cosine[k] cos kt + sine[k] sin kt */
typedef struct flower_series {
    double mean, cosine[FLOWER_MODES + 1], sine[FLOWER_MODES + 1];
    int modes;
} flower_series;

typedef struct flower_exact {
    flower curve;
    flower_series speed, turning; /* |gamma'| and k_g |gamma'|, as functions of t */
    double length, kappa;         /* L and the integral of k_g */
} flower_exact;

static inline double flower__dot(const double *a, const double *b)
{
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

/* The point at t, its unit normal, and the first two derivatives by t. */
static inline void flower_point(const flower *f, double t, double x[3], double normal[3], double d[3], double dd[3])
{
    double w = f->omega, r = f->r0 - f->a * sin(w * t), dr = -f->a * w * cos(w * t), ddr = f->a * w * w * sin(w * t);
    double theta = f->x0 + r * cos(t), phi = f->y0 + r * sin(t);
    double u = dr * cos(t) - r * sin(t), v = dr * sin(t) + r * cos(t); /* theta', phi' */
    double uu = (ddr - r) * cos(t) - 2 * dr * sin(t), vv = (ddr - r) * sin(t) + 2 * dr * cos(t);
    double S = sin(theta), C = cos(theta), s = sin(phi), c = cos(phi), norm;
    int k;
    x[0] = S * c;
    x[1] = S * s;
    x[2] = C;
    d[0] = C * c * u - S * s * v;
    d[1] = C * s * u + S * c * v;
    d[2] = -S * u;
    dd[0] = -S * c * (u * u + v * v) - 2 * C * s * u * v + C * c * uu - S * s * vv;
    dd[1] = -S * s * (u * u + v * v) + 2 * C * c * u * v + C * s * uu + S * c * vv;
    dd[2] = -C * u * u - S * uu;
    for (k = 0; k < 3; ++k) {
        normal[k] = x[k] / f->axis[k];
        x[k] *= f->axis[k];
        d[k] *= f->axis[k];
        dd[k] *= f->axis[k];
    }
    norm = sqrt(flower__dot(normal, normal));
    for (k = 0; k < 3; ++k) normal[k] /= norm;
}

/* Fourier coefficients of samples at t = 2 pi i / FLOWER_SAMPLES, up to the last one above rounding. */
static inline void flower__analyse(const double *sample, flower_series *series)
{
    static double cosine[FLOWER_SAMPLES], sine[FLOWER_SAMPLES];
    int i, k;
    for (i = 0; i < FLOWER_SAMPLES; ++i) {
        cosine[i] = cos(2 * PI * i / FLOWER_SAMPLES);
        sine[i] = sin(2 * PI * i / FLOWER_SAMPLES);
    }
    series->mean = 0;
    series->modes = 0;
    for (i = 0; i < FLOWER_SAMPLES; ++i) series->mean += sample[i] / FLOWER_SAMPLES;
    for (k = 1; k <= FLOWER_MODES; ++k) {
        series->cosine[k] = series->sine[k] = 0;
        for (i = 0; i < FLOWER_SAMPLES; ++i) {
            series->cosine[k] += sample[i] * cosine[i * k % FLOWER_SAMPLES] * 2 / FLOWER_SAMPLES;
            series->sine[k] += sample[i] * sine[i * k % FLOWER_SAMPLES] * 2 / FLOWER_SAMPLES;
        }
        if (fabs(series->cosine[k]) + fabs(series->sine[k]) > 1e-15 * fabs(series->mean)) series->modes = k;
    }
}

/* The integral of a series from 0 to t. */
static inline double flower__integral(const flower_series *series, double t)
{
    double sum = 0, c = cos(t), s = sin(t), ck = 1, sk = 0, next;
    int k;
    for (k = 1; k <= series->modes; ++k) {
        next = ck * c - sk * s;
        sk = ck * s + sk * c;
        ck = next;
        sum += (series->cosine[k] * sk + series->sine[k] * (1 - ck)) / k;
    }
    return series->mean * t + sum;
}

static inline void flower_integrate(const flower *curve, flower_exact *exact)
{
    static double speed[FLOWER_SAMPLES], turning[FLOWER_SAMPLES];
    double x[3], n[3], d[3], dd[3];
    int i;
    for (i = 0; i < FLOWER_SAMPLES; ++i) {
        flower_point(curve, 2 * PI * i / FLOWER_SAMPLES, x, n, d, dd);
        speed[i] = sqrt(flower__dot(d, d));
        turning[i] = (n[0] * (d[1] * dd[2] - d[2] * dd[1]) + n[1] * (d[2] * dd[0] - d[0] * dd[2]) +
                      n[2] * (d[0] * dd[1] - d[1] * dd[0])) /
                     (speed[i] * speed[i]);
    }
    exact->curve = *curve;
    flower__analyse(speed, &exact->speed);
    flower__analyse(turning, &exact->turning);
    exact->length = 2 * PI * exact->speed.mean;
    exact->kappa = 2 * PI * exact->turning.mean;
}

/* f(s, 0) of paper 2.3 for the point at t: the phase of the smooth curve, 2 pi after one turn. */
static inline double flower_phase(const flower_exact *exact, double t)
{
    return 2 * PI / exact->kappa * flower__integral(&exact->turning, t);
}

/* The parameter of the point at a given arc length from t = 0, at most one turn. Newton's method, as the derivative of
   the arc length is the speed; where petals end the speed varies so much that it needs a bracket to fall back on. */
static inline double flower_time(const flower_exact *exact, double arc)
{
    double low = 0, high = 2 * PI, t = arc / exact->speed.mean, off, x[3], n[3], d[3], dd[3];
    int round;
    for (round = 0; round < 60; ++round) {
        off = flower__integral(&exact->speed, t) - arc;
        if (fabs(off) < 2e-15 * exact->length) break;
        if (off > 0)
            high = t;
        else
            low = t;
        flower_point(&exact->curve, t, x, n, d, dd);
        t -= off / sqrt(flower__dot(d, d));
        if (!(t > low && t < high)) t = (low + high) / 2;
    }
    return t;
}

/* g_p of the smooth curve, p = 0 .. max_rank, with the directions read at the point at t (paper 2.4). */
static inline void flower_components(const flower_exact *exact, double t, int max_rank, double *g)
{
    double start = flower_phase(exact, t), x[3], n[3], d[3], dd[3], ds, f;
    int i, p;
    for (p = 0; p < 2 * max_rank + 2; ++p) g[p] = 0;
    for (i = 0; i < FLOWER_SAMPLES; ++i) {
        flower_point(&exact->curve, 2 * PI * i / FLOWER_SAMPLES, x, n, d, dd);
        ds = sqrt(flower__dot(d, d)) * 2 * PI / FLOWER_SAMPLES;
        f = flower_phase(exact, 2 * PI * i / FLOWER_SAMPLES) - start;
        for (p = 0; p <= max_rank; ++p) {
            g[2 * p] += ds * cos(p * f);
            g[2 * p + 1] += ds * sin(p * f);
        }
    }
}

/* q points at equal distances along the curve, the first at t = 0, with unit normals. */
static inline void flower_polygon(const flower_exact *exact, size_t q, double *corner, double *normal)
{
    double d[3], dd[3];
    size_t i;
    for (i = 0; i < q; ++i)
        flower_point(&exact->curve, flower_time(exact, exact->length * (double)i / (double)q), corner + 3 * i,
                     normal + 3 * i, d, dd);
}

#endif /* FLOWER_H */
