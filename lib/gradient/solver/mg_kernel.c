/* The inner loops. Each loop is written once and compiled for each relevant number of neighbours
 * and for each kind of machine. Compilers vectorise all of them. Nothing is reordered, so the bits
 * are the same. */
#include "gradient/solver/mg_kernel.h"

#include "base/simd.h"

enum { LANES = ICCP_MG_LANES };

static ICCP_INLINE void relax(float *restrict x, const float *b, const float *inverse,
                              const float *const *near, size_t n, int32_t n_near)
{
    for (size_t i = 0; i < n; ++i) {
        float sum = near[0][i] + near[1][i];
        for (int32_t j = 2; j < n_near; ++j)
            sum += near[j][i];
        x[i] = inverse[i] * (b[i] + sum);
    }
}

static ICCP_INLINE void add(float *restrict x, const float *const *near, size_t n, int32_t n_near)
{
    for (size_t i = 0; i < n; ++i) {
        float sum = near[0][i] + near[1][i];
        for (int32_t j = 2; j < n_near; ++j)
            sum += near[j][i];
        x[i] = sum;
    }
}

static ICCP_INLINE void redirect(float *restrict p, const float *z, float beta, size_t n)
{
    for (size_t i = 0; i < n; ++i)
        p[i] = z[i] + beta * p[i];
}

/* Returns row i of the Laplacian. */
static ICCP_INLINE double apply(const float *x, const float *const *near, size_t i, int32_t n_near)
{
    double sum = (double)near[0][i] + (double)near[1][i];
    for (int32_t j = 2; j < n_near; ++j)
        sum += (double)near[j][i];
    return n_near * (double)x[i] - sum;
}

static ICCP_INLINE void measure_at(const float *z, const double *r, const float *const *near,
                                   size_t i, int32_t n_near, iccp_mg_upward *up, size_t lane)
{
    up->rz[lane] += r[i] * (double)z[i];
    up->zaz[lane] += (double)z[i] * apply(z, near, i, n_near);
}

static ICCP_INLINE void measure(const float *z, const double *r, const float *const *near, size_t n,
                                int32_t n_near, iccp_mg_upward *up)
{
    size_t i = 0;
    if (n >= LANES) {
        iccp_mg_upward in_registers = *up;
        for (; i + LANES <= n; i += LANES)
            for (size_t j = 0; j < LANES; ++j)
                measure_at(z, r, near, i + j, n_near, &in_registers, j);
        *up = in_registers;
    }
    for (size_t j = 0; i + j < n; ++j)
        measure_at(z, r, near, i + j, n_near, up, j);
}

static ICCP_INLINE void advance_at(const iccp_mg_step *s, const float *const *near, size_t i,
                                   int32_t n_near, iccp_mg_downward *down, size_t lane)
{
    const double x = s->x[i] + s->alpha * (double)s->p[i];
    const double r = s->r[i] - s->alpha * apply(s->p, near, i, n_near);
    const double excess = (r < 0 ? -r : r) - s->bound * (x > s->least ? x : s->least);
    s->x[i] = x;
    s->r[i] = r;
    s->b[i] = (float)r;
    down->rr[lane] += r * r;
    down->peak[lane] = x > down->peak[lane] ? x : down->peak[lane];
    down->excess[lane] = excess > down->excess[lane] ? excess : down->excess[lane];
}

static ICCP_INLINE void advance(const iccp_mg_step *step, const float *const *near, size_t n,
                                int32_t n_near, iccp_mg_downward *down)
{
    const iccp_mg_step s = *step;
    size_t i = 0;
    if (n >= LANES) {
        iccp_mg_downward in_registers = *down;
        for (; i + LANES <= n; i += LANES)
            for (size_t j = 0; j < LANES; ++j)
                advance_at(&s, near, i + j, n_near, &in_registers, j);
        *down = in_registers;
    }
    for (size_t j = 0; i + j < n; ++j)
        advance_at(&s, near, i + j, n_near, down, j);
}

/* A set of kernels. */
#define KERNELS(name, target, count)                                                               \
    target static void relax_##name(float *restrict x, const float *b, const float *inverse,       \
                                    const float *const *near, size_t n, int32_t n_near)            \
    {                                                                                              \
        (void)n_near;                                                                              \
        relax(x, b, inverse, near, n, count);                                                      \
    }                                                                                              \
    target static void add_##name(float *restrict x, const float *const *near, size_t n,           \
                                  int32_t n_near)                                                  \
    {                                                                                              \
        (void)n_near;                                                                              \
        add(x, near, n, count);                                                                    \
    }                                                                                              \
    target static void turn_##name(float *restrict p, const float *z, float beta, size_t n)        \
    {                                                                                              \
        redirect(p, z, beta, n);                                                                   \
    }                                                                                              \
    target static void measure_##name(const float *z, const double *r, const float *const *near,   \
                                      size_t n, int32_t n_near, iccp_mg_upward *up)                \
    {                                                                                              \
        (void)n_near;                                                                              \
        measure(z, r, near, n, count, up);                                                         \
    }                                                                                              \
    target static void advance_##name(const iccp_mg_step *step, const float *const *near,          \
                                      size_t n, int32_t n_near, iccp_mg_downward *down)            \
    {                                                                                              \
        (void)n_near;                                                                              \
        advance(step, near, n, count, down);                                                       \
    }                                                                                              \
    static const iccp_mg_kernels name = {relax_##name, add_##name, turn_##name, measure_##name,    \
                                         advance_##name};

#define PORTABLE
KERNELS(plane, PORTABLE, 4)
KERNELS(space, PORTABLE, 6)
KERNELS(any, PORTABLE, n_near)

#ifdef ICCP_HAS_SIMD

KERNELS(plane_avx2, ICCP_AVX2, 4)
KERNELS(space_avx2, ICCP_AVX2, 6)

static const iccp_mg_kernels *choose_avx2(int32_t n_near)
{
    const bool known = n_near == 4 || n_near == 6;
    return !known || iccp_simd() < ICCP_SIMD_AVX2 ? NULL : n_near == 4 ? &plane_avx2 : &space_avx2;
}

#else

static const iccp_mg_kernels *choose_avx2(int32_t n_near)
{
    (void)n_near;
    return NULL;
}

#endif

const iccp_mg_kernels *iccp_mg_kernels_choose(int32_t n_near, bool portable)
{
    const iccp_mg_kernels *fast = portable ? NULL : choose_avx2(n_near);
    return fast != NULL ? fast : n_near == 4 ? &plane : n_near == 6 ? &space : &any;
}
