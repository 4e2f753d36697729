/* instances.h - the ways in which this machine can run a batch: by the public call, which chooses for itself, outline
   by outline, or by one of the instances of the kernels. To be included after the implementation. */
#ifndef INSTANCES_H
#define INSTANCES_H

static const struct {
    const char *name;
    surfmink__measure_window *window;
} instance_of[] = {
    {"public", NULL},
    {"scalar", NULL},
#if defined(SURFMINK__NATIVE) && SURFMINK__NATIVE == SURFMINK__SSE2
    {"sse2", surfmink__window_sse2},
#endif
#if defined(SURFMINK__DISPATCHES) || (defined(SURFMINK__NATIVE) && SURFMINK__NATIVE == SURFMINK__AVX2)
    {"avx2", surfmink__window_avx2},
#endif
#if defined(SURFMINK__DISPATCHES) || (defined(SURFMINK__NATIVE) && SURFMINK__NATIVE == SURFMINK__AVX512)
    {"avx512", surfmink__window_avx512},
#endif
#if defined(SURFMINK__NATIVE) && SURFMINK__NATIVE == SURFMINK__NEON
    {"neon", surfmink__window_neon},
#endif
};

enum { INSTANCES = sizeof instance_of / sizeof *instance_of, PUBLIC = 0, SCALAR, KERNELS };

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

static surfmink__job job_of(const surfmink_outline *all, const size_t *offset, int max_rank,
                            const surfmink_results *out, double *scratch)
{
    surfmink__job job;
    job.all = all;
    job.offset = offset;
    job.out = out;
    job.scratch = scratch;
    job.unit = all->kind == SURFMINK_SPHERE ? all->radius : 1;
    job.max_rank = max_rank;
    return job;
}

/* surfmink_batch, by an instance. Kernels take no job that is bad as a whole. */
static size_t batch_by(int instance, const surfmink_outline *all, const size_t *offset, size_t count, int max_rank,
                       const surfmink_results *out, double *scratch)
{
    surfmink__job job = job_of(all, offset, max_rank, out, scratch);
    surfmink__measure_window *window = instance_of[instance].window;
    size_t first, refused = 0;
    if (instance == PUBLIC) return surfmink_batch(all, offset, count, max_rank, out, scratch);
    if (max_rank < 0 || !surfmink__positive(job.unit)) window = NULL;
    for (first = 0; first < count; first += 64)
        refused += surfmink__measure_some(&job, first, count - first < 64 ? count - first : 64, window);
    return refused;
}

#endif
