/* Nearest points on simplices. The nearest point of the simplex's plane is found by
 * orthogonalisation (modified Gram-Schmidt, G. H. Golub, C. F. Van Loan, Matrix Computations,
 * section 5.2.8), which stays accurate for thin simplices. If that point lies outside, the nearest
 * point of the simplex lies on a face opposite a corner with a negative barycentric coordinate. The
 * search continues there, at most n - 1 levels down. */
#include "geometry/simplex.h"

#include "icc/base.h"
#include "math/vec.h"

#include <float.h>
#include <math.h>
#include <string.h>

/* If the part of a side across the others is less than this share of it, it is rounding. */
static const double FLAT = 1e-15;

enum { MAX = ICC_MAX_DIM };

typedef struct search {
    size_t dim, n;
    const double *const *corners; /* n */
    const double *p;
    const iccp_away *away; /* if not NULL: p is far away, and order values replace distances */
    double distance2[MAX]; /* squared distance of each corner from p */
    double best2;          /* squared distance of the nearest point so far */
    double bary[MAX];      /* by corner, for that point */
} search;

static void subtract_multiple(size_t dim, double *a, double factor, const double *b)
{
    for (size_t k = 0; k < dim; ++k)
        a[k] -= factor * b[k];
}

/* Projects p to the plane of the listed corners, with the first as origin. Writes the coordinates
 * of the others and the rest of p - origin. Returns 0 if the corners are flat. */
static int project(const search *s, size_t n, const size_t *list, double *share, double *rest)
{
    double q[MAX - 1][MAX], r[MAX - 1][MAX - 1], along[MAX - 1];
    const double *origin = s->corners[list[0]];
    for (size_t k = 0; k < s->dim; ++k)
        rest[k] = s->p[k] - origin[k];
    for (size_t j = 0; j + 1 < n; ++j) {
        for (size_t k = 0; k < s->dim; ++k)
            q[j][k] = s->corners[list[j + 1]][k] - origin[k];
        const double length2 = iccp_vec_dot(s->dim, q[j], q[j]);
        for (size_t i = 0; i < j; ++i) {
            r[i][j] = iccp_vec_dot(s->dim, q[i], q[j]);
            subtract_multiple(s->dim, q[j], r[i][j], q[i]);
        }
        const double across = iccp_vec_norm(s->dim, q[j]);
        if (!(across > FLAT * sqrt(length2)))
            return 0;
        for (size_t k = 0; k < s->dim; ++k)
            q[j][k] /= across;
        r[j][j] = across;
        along[j] = iccp_vec_dot(s->dim, q[j], rest);
        subtract_multiple(s->dim, rest, along[j], q[j]);
    }
    for (size_t j = n - 1; j-- > 0;) {
        share[j] = along[j];
        for (size_t i = j + 1; i + 1 < n; ++i)
            share[j] -= r[j][i] * share[i];
        share[j] /= r[j][j];
    }
    return 1;
}

/* Lists the corners of a subset, the one nearest to p first. */
static size_t list_corners(const search *s, unsigned subset, size_t *list)
{
    size_t n = 0;
    for (size_t i = 0; i < s->n; ++i)
        if (subset >> i & 1u) {
            list[n++] = i;
            if (s->distance2[i] < s->distance2[list[0]]) {
                list[n - 1] = list[0];
                list[0] = i;
            }
        }
    return n;
}

static void keep_nearest(search *s, double distance2, size_t n, const size_t *list,
                         const double *bary)
{
    if (!(distance2 < s->best2))
        return;
    s->best2 = distance2;
    memset(s->bary, 0, sizeof s->bary);
    for (size_t i = 0; i < n; ++i)
        s->bary[list[i]] = bary[i];
}

/* Returns the squared distance, or order value, of a point on the face with these corners. `rest`
 * leads from the point to p. */
static double distance2_of(const search *s, size_t n, const size_t *list, const double *bary,
                           const double *rest)
{
    double q[MAX] = {0};
    if (s->away == NULL)
        return iccp_vec_dot(s->dim, rest, rest) + DBL_MIN;
    for (size_t i = 0; i < n; ++i)
        subtract_multiple(s->dim, q, -bary[i], s->corners[list[i]]);
    return iccp_away_value(s->away, s->dim, q);
}

/* Finds the nearest point of a face, which is given as a subset of the corners. That is the
 * projection of p if it lies within, else a point on a smaller face. Only smaller faces opposite a
 * corner with a negative coordinate can contain it. A flat face has no projection, so all its faces
 * are searched. */
static void search_face(search *s, unsigned subset)
{
    size_t list[MAX] = {0};
    double bary[MAX] = {1}, rest[MAX];
    const size_t n = list_corners(s, subset, list);
    if (n == 1) {
        keep_nearest(s, s->distance2[list[0]], n, list, bary);
        return;
    }
    const int solid = project(s, n, list, bary + 1, rest);
    for (size_t i = 1; solid && i < n; ++i)
        bary[0] -= bary[i];
    int within = solid;
    for (size_t i = 0; i < n; ++i)
        if (!solid || !(bary[i] > 0)) {
            within = 0;
            search_face(s, subset & ~(1u << list[i]));
        }
    /* Rounding may put a corner of one simplex into another one nearby. Only its own simplices have
     * it at distance 0. */
    if (within)
        keep_nearest(s, distance2_of(s, n, list, bary, rest), n, list, bary);
}

double iccp_simplex_nearest(size_t dim, size_t n, const double *const *corners, const double *p,
                            double *bary)
{
    search s = {.dim = dim, .n = n, .corners = corners, .p = p, .best2 = HUGE_VAL};
    for (size_t i = 0; i < n; ++i) {
        double away[MAX];
        for (size_t k = 0; k < dim; ++k)
            away[k] = p[k] - corners[i][k];
        s.distance2[i] = iccp_vec_dot(dim, away, away);
        if (!(s.distance2[i] > 0)) {
            memset(bary, 0, n * sizeof *bary);
            bary[i] = 1;
            return 0;
        }
    }
    search_face(&s, (1u << n) - 1);
    memcpy(bary, s.bary, n * sizeof *bary);
    return s.best2;
}

double iccp_simplex_nearest_from(size_t dim, size_t n, const double *const *corners,
                                 const iccp_away *away, double *bary)
{
    search s = {
        .dim = dim, .n = n, .corners = corners, .p = away->p, .away = away, .best2 = HUGE_VAL};
    for (size_t i = 0; i < n; ++i)
        s.distance2[i] = iccp_away_value(away, dim, corners[i]);
    search_face(&s, (1u << n) - 1);
    memcpy(bary, s.bary, n * sizeof *bary);
    return s.best2;
}
