/* Computes the symmetric Dirichlet energy of one simplex and its derivatives: B. Smith, F. de Goes,
 * T. Kim, Analytic eigensystems for isotropic distortion energies, 2019; M. Rabinovich, R. Poranne,
 * D. Panozzo, O. Sorkine-Hornung, Scalable locally injective mappings (SLIM), 2017. */
#include "map/energy/dirichlet.h"

#include "base/minmax.h"
#include "map/energy/modes.h"

#include <math.h>
#include <string.h>

double iccp_dirichlet_energy(size_t dim, const double *element, const double *const *image)
{
    double j[9], cofactor[9];
    if (dim == 2)
        return iccp_dirichlet_energy2(element, image);
    const double det = iccp_element_jacobian(3, element, image, j);
    if (!(det > 0))
        return HUGE_VAL;
    iccp_cofactors(3, j, cofactor);
    return element[0] * (iccp_squared_norm(3, j) + iccp_squared_norm(3, cofactor) / (det * det));
}

/* a u_k v_l^T + b u_l v_k^T, row by row */
static ICCP_INLINE void mix_modes(size_t dim, const iccp_singular *s, size_t k, size_t l, double a,
                                  double b, double *mode)
{
    for (size_t r = 0; r < dim; ++r)
        for (size_t c = 0; c < dim; ++c)
            mode[dim * r + c] = a * s->u[k][r] * s->v[l][c] + b * s->u[l][r] * s->v[k][c];
}

/* Adds the modes of the sum of h(sigma_k), where h = sigma^2 + sigma^-2. They are the singular
 * values themselves, and a flip and a twist for each pair of them. Only twists may have negative
 * curvature. */
static ICCP_INLINE void add_newton_modes(size_t dim, const double *element, const iccp_singular *s,
                                         double *hessian)
{
    const double half = sqrt(0.5);
    double mode[9];
    for (size_t k = 0; k < dim; ++k) {
        const double sigma2 = s->sigma[k] * s->sigma[k];
        for (size_t i = 0; i < dim * dim; ++i)
            mode[i] = s->u[k][i / dim] * s->v[k][i % dim];
        iccp_add_mode(dim, element, mode, element[0] * (2 + 6 / (sigma2 * sigma2)), hessian);
    }
    for (size_t k = 0; k < dim; ++k)
        for (size_t l = k + 1; l < dim; ++l) {
            const double a = s->sigma[k], b = s->sigma[l], product = a * b;
            const double cube = product * product * product;
            const double twist = 2 - 2 * (a * a - a * b + b * b) / cube;
            const double flip = 2 + 2 * (a * a + a * b + b * b) / cube;
            mix_modes(dim, s, k, l, half, half, mode);
            iccp_add_mode(dim, element, mode, element[0] * flip, hessian);
            if (twist > 0) {
                mix_modes(dim, s, k, l, half, -half, mode);
                iccp_add_mode(dim, element, mode, element[0] * twist, hessian);
            }
        }
}

/* Sets the Hessian in space, which is put together from blocks. */
static void set_newton3(const double *element, const iccp_singular *s, double *hessian)
{
    iccp_modes h;
    memset(&h, 0, sizeof h);
    for (int k = 0; k < 3; ++k) {
        const double sigma2 = s->sigma[k] * s->sigma[k];
        h.singular[k][k] = 2 + 6 / (sigma2 * sigma2);
        for (int l = 0; l < k; ++l) {
            const double a = s->sigma[k], b = s->sigma[l], product = a * b;
            const double cube = product * product * product;
            const double flip = 2 + 2 * (a * a + a * b + b * b) / cube;
            const double twist = iccp_max(2 - 2 * (a * a - a * b + b * b) / cube, 0);
            iccp_modes_set(&h, k, l, flip, twist);
            iccp_modes_set(&h, l, k, flip, twist);
        }
    }
    iccp_modes_hessian(element, &h, s, hessian);
}

/* Adds SLIM's quadratic model: |W (J - R)|^2 has the energy's gradient, and W^2 = u diag(m) u^T. */
static ICCP_INLINE void add_majorant(size_t dim, const double *element, const iccp_singular *s,
                                     double *hessian)
{
    const size_t n = dim * (dim + 1);
    double m[9] = {0};
    for (size_t k = 0; k < dim; ++k) {
        const double i = 1 / s->sigma[k], weight = 1 + i + i * i + i * i * i;
        for (size_t r = 0; r < dim; ++r)
            for (size_t c = 0; c < dim; ++c)
                m[dim * r + c] += weight * s->u[k][r] * s->u[k][c];
    }
    for (size_t a = 0; a <= dim; ++a)
        for (size_t b = 0; b <= dim; ++b) {
            double dot = 0;
            for (size_t k = 0; k < dim; ++k)
                dot += element[1 + dim * a + k] * element[1 + dim * b + k];
            dot *= 2 * element[0];
            for (size_t r = 0; r < dim; ++r)
                for (size_t c = 0; c < dim; ++c)
                    hessian[n * (dim * a + r) + dim * b + c] += dot * m[dim * r + c];
        }
}

/* The gradient with respect to J is the sum of h'(sigma_k) u_k v_k^T. */
static ICCP_INLINE void set_local(size_t dim, const double *element, const double *const *image,
                                  bool majorise, iccp_local *local)
{
    const size_t n = dim * (dim + 1);
    double j[9], by_j[9];
    iccp_singular s;
    (void)iccp_element_jacobian(dim, element, image, j);
    iccp_singular_find(dim, j, &s);
    for (size_t r = 0; r < dim; ++r)
        for (size_t c = 0; c < dim; ++c) {
            by_j[dim * r + c] = 0;
            for (size_t k = 0; k < dim; ++k) {
                const double sigma = s.sigma[k];
                by_j[dim * r + c] +=
                    2 * (sigma - 1 / (sigma * sigma * sigma)) * s.u[k][r] * s.v[k][c];
            }
        }
    iccp_pull_back(dim, element, by_j, element[0], local->gradient);
    if (dim == 3 && !majorise) {
        set_newton3(element, &s, local->hessian);
        return;
    }
    memset(local->hessian, 0, n * n * sizeof *local->hessian);
    if (majorise)
        add_majorant(dim, element, &s, local->hessian);
    else
        add_newton_modes(dim, element, &s, local->hessian);
}

void iccp_dirichlet_local(size_t dim, const double *element, const double *const *image,
                          bool majorise, iccp_local *local)
{
    if (dim == 2)
        set_local(2, element, image, majorise, local);
    else
        set_local(3, element, image, majorise, local);
}

void iccp_dirichlet_locals(iccp_simd_level level, const iccp_dirichlet_batch *batch, bool majorise,
                           iccp_local *local)
{
#ifdef ICCP_HAS_SIMD
    if (level >= ICCP_SIMD_AVX2) {
        iccp_dirichlet_locals_avx2(batch, majorise, local);
        return;
    }
#else
    (void)level;
#endif
#ifdef ICCP_HAS_WASM_SIMD
    iccp_dirichlet_locals_wasm(batch, majorise, local);
#else
    for (size_t l = 0; l < ICCP_DIRICHLET_LANES; ++l) {
        const double *const image[3] = {batch->image[0][l], batch->image[1][l], batch->image[2][l]};
        set_local(2, batch->element[l], image, majorise, &local[l]);
    }
#endif
}
