#include "map/higher/star_energy.h"

#include "base/minmax.h"
#include "map/energy/untangling.h"
#include "math/elementary.h"
#include "math/inverse.h"
#include "math/vec.h"

#include <string.h>

enum { MAX = ICC_MAX_DIM };

/* A simplex as seen from one of its corners. Row k of `before` and `after` leads from there to
 * another corner. */
typedef struct view {
    size_t dim;
    double before[MAX * MAX], after[MAX * MAX], inverse[MAX * MAX]; /* the inverse of `before` */
    double determinant;                                             /* of `before` */
    double jacobian[MAX * MAX], g[MAX];
} view;

static void set_edges(const double *points, size_t dim, const uint32_t *corners, size_t base,
                      double *edge)
{
    const double *from = points + dim * corners[base];
    for (size_t i = 0, row = 0; i <= dim; ++i) {
        if (i == base)
            continue;
        for (size_t k = 0; k < dim; ++k)
            edge[dim * row + k] = points[dim * corners[i] + k] - from[k];
        ++row;
    }
}

/* The edges of a regular simplex from one corner: a triangular matrix with rows of length 1 and
 * products 1 / 2. It is mirrored for an odd corner, which is an odd permutation away from the
 * first. */
static void set_regular(size_t n, double length, size_t base, double *edge)
{
    memset(edge, 0, n * n * sizeof *edge);
    for (size_t i = 0; i < n; ++i) {
        double *row = edge + n * i, rest = 1;
        for (size_t j = 0; j < i; ++j) {
            row[j] = (0.5 - iccp_vec_dot(j, row, edge + n * j)) / edge[(n + 1) * j];
            rest -= row[j] * row[j];
        }
        row[i] = sqrt(rest);
    }
    for (size_t i = 0; i < n; ++i)
        for (size_t k = 0; k < n; ++k)
            edge[n * i + k] *= k == 0 && base % 2 != 0 ? -length : length;
}

/* Returns false if the simplex has no volume before the map, up to rounding. */
static bool look(const iccp_simplicial_map *map, size_t simplex, size_t base, double edge, view *v)
{
    const size_t n = v->dim = map->dim;
    const uint32_t *corners = map->corners + (n + 1) * simplex;
    set_edges(map->points, n, corners, base, v->before);
    set_edges(map->images, n, corners, base, v->after);
    for (size_t i = 0; i < n * n; ++i)
        v->before[i] *= map->stretch;
    if (edge > 0)
        set_regular(n, edge, base, v->before);
    if (!iccp_invert(n, v->before, v->inverse, &v->determinant))
        return false;
    for (size_t c = 0; c < n; ++c) {
        v->g[c] = 0;
        for (size_t k = 0; k < n; ++k)
            v->g[c] -= v->inverse[n * c + k];
        for (size_t r = 0; r < n; ++r) {
            double sum = 0;
            for (size_t k = 0; k < n; ++k)
                sum += v->inverse[n * c + k] * v->after[n * k + r];
            v->jacobian[n * r + c] = sum;
        }
    }
    return true;
}

static size_t corner_of(const iccp_simplicial_map *map, size_t simplex, uint32_t vertex)
{
    size_t i = 0;
    while (map->corners[(map->dim + 1) * simplex + i] != vertex)
        ++i;
    return i;
}

/* The gradient by u of |J|^2 / 2. */
static void multiply(const view *v, double *product)
{
    for (size_t r = 0; r < v->dim; ++r)
        product[r] = iccp_vec_dot(v->dim, v->jacobian + v->dim * r, v->g);
}

/* Adds a multiple of x y^T + y x^T, or of x x^T if x is y. */
static void add_product(size_t n, double factor, const double *x, const double *y, double *hessian)
{
    for (size_t r = 0; r < n; ++r)
        for (size_t c = 0; c < n; ++c)
            hessian[n * r + c] += factor * (x == y ? x[r] * x[c] : x[r] * y[c] + y[r] * x[c]);
}

static void add_identity(size_t n, double factor, double *hessian)
{
    for (size_t k = 0; k < n; ++k)
        hessian[(n + 1) * k] += factor;
}

/* ---- the symmetric Dirichlet energy ---- */

/* With A = J^-1 and h = A^T g, moving by u makes A - (A u) h^T / (1 + h . u) of A. The Hessian of
 * its square, 2 |h|^2 A^T A + 2 (m h^T + h m^T) with m = A^T A h, need not be positive. It is with
 * 2 |A h|^2 / |h|^2 h h^T added. */
static double add_dirichlet(const view *v, double weight, iccp_star_local *local)
{
    const size_t n = v->dim;
    double back[MAX * MAX], a[MAX * MAX], square[MAX * MAX], h[MAX] = {0}, m[MAX], det;
    double along[MAX];
    if (!iccp_invert(n, v->after, back, &det) || !(det / v->determinant > 0))
        return HUGE_VAL;
    for (size_t j = 0; j < n; ++j)
        for (size_t i = 0; i < n; ++i) {
            double sum = 0;
            for (size_t k = 0; k < n; ++k)
                sum += back[n * j + k] * v->before[n * k + i];
            a[n * i + j] = sum;
        }
    const double energy = iccp_vec_dot(n * n, v->jacobian, v->jacobian) + iccp_vec_dot(n * n, a, a);
    if (local == NULL)
        return weight * energy;
    for (size_t j = 0; j < n; ++j)
        for (size_t k = 0; k < n; ++k)
            h[j] -= back[n * j + k];
    memset(square, 0, sizeof square);
    for (size_t i = 0; i < n; ++i)
        add_product(n, 1, a + n * i, a + n * i, square);
    for (size_t r = 0; r < n; ++r)
        m[r] = iccp_vec_dot(n, square + n * r, h);
    multiply(v, along);
    for (size_t r = 0; r < n; ++r)
        local->gradient[r] += 2 * weight * (along[r] - m[r]);
    const double length2 = iccp_vec_dot(n, h, h);
    for (size_t i = 0; i < n * n; ++i)
        local->hessian[i] += 2 * weight * length2 * square[i];
    add_product(n, 2 * weight, m, h, local->hessian);
    add_product(n, 2 * weight * iccp_vec_dot(n, m, h) / length2, h, h, local->hessian);
    add_identity(n, 2 * weight * iccp_vec_dot(n, v->g, v->g), local->hessian);
    return weight * energy;
}

/* ---- the untangling energy ---- */

/* The determinant as the vertex moves by u: value + slope . u. */
static double determinant_of(const view *v, double *slope)
{
    const size_t n = v->dim;
    double rows[MAX * MAX] = {0}, normal[MAX];
    for (size_t i = 0; i + 1 < n; ++i)
        for (size_t k = 0; k < n; ++k)
            rows[n * i + k] = v->after[n * (i + 1) + k] - v->after[k];
    iccp_normal_of(n, rows, normal);
    for (size_t k = 0; k < n; ++k)
        slope[k] = -normal[k] / v->determinant;
    return iccp_vec_dot(n, normal, v->after) / v->determinant;
}

/* (1 - s) |J|^2 / (n chi^(2 / n)) + s (1 + D^2) / (2 chi). The Hessian's mixed part is bounded by
 * the other two, so it is positive if the part along the slope is at least what is used here. */
static double add_untangling(const view *v, double epsilon, double weight, iccp_star_local *local)
{
    const size_t n = v->dim;
    const double e = 2.0 / (double)n, norm2 = iccp_vec_dot(n * n, v->jacobian, v->jacobian);
    double slope[MAX], along[MAX];
    const double det = determinant_of(v, slope), chi = iccp_untangling_chi(epsilon, det);
    const double shape = (1 - iccp_untangling_share) / (double)n * iccp_pow(chi, -e);
    const double size = iccp_untangling_share / (2 * chi), square = 1 + det * det;
    const double energy = shape * norm2 + size * square;
    if (local == NULL)
        return weight * energy;
    const double root = sqrt(epsilon * epsilon + det * det);
    const double first = 1 / root;                                          /* of ln chi */
    const double bend = epsilon * epsilon / (2 * root * root * root * chi); /* chi'' / chi */
    const double by_det = -e * shape * first, by_size = size * (2 * det - square * first);
    const double curved = norm2 * shape * (e * (e + 1) * first * first - e * bend);
    const double curved_size = size * (2 - 4 * det * first + square * (2 * first * first - bend));
    const double least = 2 * norm2 * by_det * by_det / shape;
    multiply(v, along);
    for (size_t r = 0; r < n; ++r)
        local->gradient[r] +=
            weight * (2 * shape * along[r] + (norm2 * by_det + by_size) * slope[r]);
    add_identity(n, 2 * weight * shape * iccp_vec_dot(n, v->g, v->g), local->hessian);
    add_product(n, 2 * weight * by_det, along, slope, local->hessian);
    add_product(n, weight * (iccp_max(curved, least) + iccp_max(curved_size, 0)), slope, slope,
                local->hessian);
    return weight * energy;
}

double iccp_star_energy(const iccp_star *star, iccp_star_local *local)
{
    double sum = 0;
    if (local != NULL)
        memset(local, 0, sizeof *local);
    for (size_t i = 0; i < star->n && sum < HUGE_VAL; ++i) {
        view v;
        if (!look(star->map, star->simplex[i], corner_of(star->map, star->simplex[i], star->vertex),
                  star->edge, &v))
            return HUGE_VAL;
        const double weight = fabs(v.determinant);
        sum += star->epsilon > 0 ? add_untangling(&v, star->epsilon, weight, local)
                                 : add_dirichlet(&v, weight, local);
    }
    return sum;
}

double iccp_least_determinant(const iccp_simplicial_map *map, double edge)
{
    double least = HUGE_VAL, slope[MAX];
    for (size_t s = 0; s < map->n_simplices; ++s) {
        view v;
        if (look(map, s, 0, edge, &v))
            least = iccp_min(least, determinant_of(&v, slope));
    }
    return least;
}
