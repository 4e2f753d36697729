/* instances.h - the ways in which this machine can run a batch: by the public calls, which choose for themselves, or by
   one of the instances of the kernels. To be included after the implementation. */
#ifndef INSTANCES_H
#define INSTANCES_H

static const struct {
    const char *name;
    surfmink__measure_window *window;
} instance_of[] = {
    {"public", NULL},
#if SURFMINK__NATIVE == SURFMINK__SSE2
    {"sse2", surfmink__window_sse2},
#endif
#if SURFMINK__NATIVE == SURFMINK__AVX2 || defined(SURFMINK__DISPATCHES)
    {"avx2", surfmink__window_avx2},
#endif
#if SURFMINK__NATIVE == SURFMINK__AVX512 || defined(SURFMINK__DISPATCHES)
    {"avx512", surfmink__window_avx512},
#endif
#if SURFMINK__NATIVE == SURFMINK__NEON
    {"neon", surfmink__window_neon},
#endif
};

enum { INSTANCES = sizeof instance_of / sizeof *instance_of };

static int can_run(int instance)
{
#ifdef SURFMINK__DISPATCHES
    if (instance_of[instance].window == surfmink__window_avx2)
        return __builtin_cpu_supports("avx2") && __builtin_cpu_supports("fma");
    if (instance_of[instance].window == surfmink__window_avx512)
        return __builtin_cpu_supports("avx512f") && __builtin_cpu_supports("avx512dq");
#endif
    (void)instance;
    return 1;
}

#endif
