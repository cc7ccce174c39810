/* Estimates where a point inside a domain goes when the boundary moves. Source: S. Schaefer, T.
 * McPhail, J. Warren, Image Deformation Using Moving Least Squares, ACM Transactions on Graphics
 * 25, 2006. The point moves by the affine map that fits the boundary best, with more weight on near
 * facets. */
#include "field/pairing.h"

#include "math/elementary.h"

#include <math.h>
#include <string.h>

/* The share of its distance from the boundary that the point's image must keep. */
static const double LEAST_DEPTH = 0.5;

typedef struct fit {
    double weight, from[ICC_MAX_DIM], to[ICC_MAX_DIM]; /* sum of the weights; weighted means */
    double square[ICC_MAX_DIM][ICC_MAX_DIM], cross[ICC_MAX_DIM][ICC_MAX_DIM];
} fit;

static void middle_of(const icc_domain *domain, size_t facet, double *middle)
{
    const size_t dim = (size_t)domain->dim;
    memset(middle, 0, dim * sizeof *middle);
    for (size_t i = 0; i < dim; ++i)
        for (size_t k = 0; k < dim; ++k)
            middle[k] += domain->vertices[dim * domain->facets[dim * facet + i] + k] / (double)dim;
}

/* Weight of a facet: its extent times its distance to the power of -2 dim. */
static double weight_of(const icc_domain *domain, size_t facet, const double *middle,
                        const double *point)
{
    const size_t dim = (size_t)domain->dim;
    double away2 = 0, extent2 = 0;
    for (size_t k = 0; k < dim; ++k) {
        const double corner = domain->vertices[dim * domain->facets[dim * facet] + k];
        away2 += (middle[k] - point[k]) * (middle[k] - point[k]);
        extent2 += (corner - middle[k]) * (corner - middle[k]);
    }
    return iccp_power(sqrt(extent2), dim - 1) / iccp_power(away2 + extent2, dim);
}

static void add_means(fit *f, size_t dim, double weight, const double *p, const double *q)
{
    f->weight += weight;
    for (size_t k = 0; k < dim; ++k) {
        f->from[k] += weight * p[k];
        f->to[k] += weight * q[k];
    }
}

static void add_products(fit *f, size_t dim, double weight, const double *p, const double *q)
{
    for (size_t i = 0; i < dim; ++i)
        for (size_t j = 0; j < dim; ++j) {
            f->square[i][j] += weight * (p[i] - f->from[i]) * (p[j] - f->from[j]);
            f->cross[i][j] += weight * (p[i] - f->from[i]) * (q[j] - f->to[j]);
        }
}

/* Solves square X = cross by elimination. The matrix is positive definite unless the boundary is
 * flat. */
static void solve(fit *f, size_t dim)
{
    for (size_t c = 0; c < dim; ++c)
        for (size_t r = 0; r < dim && f->square[c][c] > 0; ++r) {
            const double factor = f->square[r][c] / f->square[c][c];
            for (size_t k = 0; k < dim && r != c; ++k) {
                f->square[r][k] -= factor * f->square[c][k];
                f->cross[r][k] -= factor * f->cross[c][k];
            }
        }
    for (size_t r = 0; r < dim; ++r)
        for (size_t k = 0; k < dim; ++k)
            f->cross[r][k] = f->square[r][r] > 0 ? f->cross[r][k] / f->square[r][r] : (r == k);
}

static double depth_of(const icc_domain *domain, const double *point)
{
    double bary[ICC_MAX_DIM], distance2;
    (void)iccp_facet_tree_nearest(iccp_domain_tree(domain), point, bary, &distance2);
    return sqrt(distance2) / iccp_pow(fabs(domain->measure), 1.0 / domain->dim);
}

bool iccp_pair_point(const icc_domain *from, const icc_domain *to, const double *point,
                     double *image)
{
    const size_t dim = (size_t)from->dim;
    fit f = {0};
    double p[ICC_MAX_DIM], q[ICC_MAX_DIM];
    for (int pass = 0; pass < 2; ++pass) {
        for (size_t k = 0; pass == 1 && k < dim; ++k) {
            f.from[k] /= f.weight;
            f.to[k] /= f.weight;
        }
        for (size_t i = 0; i < from->n_facets; ++i) {
            middle_of(from, i, p);
            middle_of(to, i, q);
            const double weight = weight_of(from, i, p, point);
            if (pass == 0)
                add_means(&f, dim, weight, p, q);
            else
                add_products(&f, dim, weight, p, q);
        }
    }
    solve(&f, dim);
    for (size_t k = 0; k < dim; ++k) {
        image[k] = f.to[k];
        for (size_t i = 0; i < dim; ++i)
            image[k] += (point[i] - f.from[i]) * f.cross[i][k];
    }
    for (size_t k = 0; k < dim; ++k)
        if (!isfinite(image[k]))
            return false;
    return iccp_domain_locate(to, image, true, NULL, NULL) == ICC_INSIDE &&
           depth_of(to, image) >= LEAST_DEPTH * depth_of(from, point);
}
