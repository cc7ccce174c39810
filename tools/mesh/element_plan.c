/* Based on: A. Johnen, J.-F. Remacle, C. Geuzaine, Geometrical validity of curvilinear finite
 * elements, Journal of Computational Physics 233, 2013.
 *
 * Reference elements are products of simplices. A coefficient is named by exponents, one for each
 * vertex of each factor. The exponents of a factor sum up to its degree. So one product formula, and
 * one bisection of an edge of a factor, are enough for all shapes. */
#include "mesh/element_plan.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

typedef unsigned char exponents[N_EXPONENTS];

/* All coefficients of given degrees. */
typedef struct lattice {
    size_t n;
    exponents *at;
} lattice;

/* ------------------------------------------------------------------------ lattices */

static size_t factor_of(const element_plan *p, size_t exponent)
{
    size_t f = 0;
    while (exponent >= p->first[f + 1])
        f++;
    return f;
}

/* True if the exponents of each factor sum up to its degree. */
static bool fits(const element_plan *p, const unsigned *degrees, const exponents e)
{
    unsigned sums[3] = {0, 0, 0};
    for (size_t k = 0; k < p->first[p->product->n_factors]; k++)
        sums[factor_of(p, k)] += e[k];
    return memcmp(sums, degrees, p->product->n_factors * sizeof *sums) == 0;
}

/* Counts through all exponents up to the largest degree. */
static bool lattice_make(lattice *out, const element_plan *p, const unsigned *degrees)
{
    size_t n = p->first[p->product->n_factors], room = 0;
    exponents e = {0};
    *out = (lattice){0};
    for (;;) {
        if (fits(p, degrees, e)) {
            if (out->n == room) {
                room = 2 * room + 16;
                exponents *more = realloc(out->at, room * sizeof *more);
                if (more == NULL)
                    return false;
                out->at = more;
            }
            memcpy(out->at[out->n++], e, sizeof e);
        }
        size_t k = 0;
        while (k < n && e[k] == MOST_DEGREE)
            e[k++] = 0;
        if (k == n)
            return true;
        e[k]++;
    }
}

static size_t lattice_find(const lattice *l, const exponents e)
{
    size_t i = 0;
    while (i < l->n && memcmp(l->at[i], e, sizeof(exponents)) != 0)
        i++;
    return i;
}

/* The product over the factors of the multinomial coefficients of exponents. */
static double multinomial(const element_plan *p, const exponents e)
{
    double value = 1;
    unsigned sums[3] = {0, 0, 0};
    for (size_t k = 0; k < p->first[p->product->n_factors]; k++)
        for (unsigned i = 1; i <= e[k]; i++)
            value *= (double)++sums[factor_of(p, k)] / (double)i;
    return value;
}

/* ------------------------------------------------------- control points of an element */

static void add_corner(const element_plan *p, unsigned corner, exponents e)
{
    for (size_t f = 0; f < p->product->n_factors; f++)
        e[p->first[f] + p->product->corners[corner][f]]++;
}

/* The place of a node: at a corner, or between two. */
static void place_of(const element_plan *p, size_t node, exponents e)
{
    size_t n_corners = p->product->n_corners;
    memset(e, 0, sizeof(exponents));
    unsigned a = (unsigned)node, b = a;
    if (node >= n_corners) {
        a = p->product->middles[node - n_corners][0];
        b = p->product->middles[node - n_corners][1];
    }
    add_corner(p, a, e);
    if (p->kind->degree == 2)
        add_corner(p, b, e);
}

/* The place that differs from e in the factors of `changed` (a set of bits). In each of these it is
 * the end of the edge that `ends` tells. */
static void move_to_ends(const element_plan *p, const exponents e, unsigned changed, unsigned ends,
                         exponents out)
{
    memcpy(out, e, sizeof(exponents));
    for (size_t f = 0; f < p->product->n_factors; f++) {
        unsigned seen = 0;
        for (size_t k = p->first[f]; k < p->first[f + 1]; k++)
            if (changed >> f & 1 && e[k] == 1)
                out[k] = (ends >> f & 1) == seen++ ? 2 : 0;
    }
}

/* The set of factors in which e is the middle of an edge. */
static unsigned middles_of(const element_plan *p, const exponents e)
{
    unsigned set = 0;
    for (size_t k = 0; k < p->first[p->product->n_factors]; k++)
        set |= e[k] == 1 ? 1u << factor_of(p, k) : 0;
    return set;
}

static unsigned count_bits(unsigned set)
{
    return set == 0 ? 0 : (set & 1) + count_bits(set >> 1);
}

static size_t node_at(const element_plan *p, const exponents e)
{
    exponents place;
    size_t node = 0;
    for (; node < p->n_nodes; node++) {
        place_of(p, node, place);
        if (memcmp(place, e, sizeof place) == 0)
            break;
    }
    return node;
}

/* Adds `share` of the element's point at a place. Without a node there, in the middle of faces and of
 * the body, the point follows from edges and corners (serendipity). */
static void add_place(const element_plan *p, const exponents e, double share, double *row)
{
    size_t node = node_at(p, e);
    if (node < p->n_nodes) {
        row[node] += share;
        return;
    }
    unsigned set = middles_of(p, e), n = count_bits(set);
    exponents other;
    for (unsigned changed = 1; changed < 8; changed++)
        for (unsigned ends = 0; ends < 8; ends++) {
            if ((changed & ~set) != 0 || (ends & ~changed) != 0)
                continue;
            move_to_ends(p, e, changed, ends, other);
            if (changed == set)
                add_place(p, other, -share * (n - 1) / (double)(1u << n), row);
            else if (count_bits(changed) == n - 1)
                add_place(p, other, 2 * share / (double)(1u << n), row);
        }
}

/* Adds `share` of the Bezier point at a place: along an edge 2 m - (a + b) / 2, for each factor. */
static void add_control(const element_plan *p, const exponents e, double share, double *row)
{
    unsigned set = p->kind->degree == 2 ? middles_of(p, e) : 0;
    exponents other;
    for (unsigned changed = 0; changed < 8; changed++)
        for (unsigned ends = 0; ends < 8; ends++)
            if ((changed & ~set) == 0 && (ends & ~changed) == 0) {
                double s = share;
                for (size_t f = 0; f < p->product->n_factors; f++)
                    s *= (set >> f & 1) == 0 ? 1 : (changed >> f & 1) != 0 ? -0.5 : 2;
                move_to_ends(p, e, changed, ends, other);
                add_place(p, other, s, row);
            }
}

/* ------------------------------------------------------------------ making a plan */

/* The direction from the first vertex of a factor to another: exponents `from` and `to`. */
static void direction_of(const element_plan *p, size_t k, size_t *from, size_t *to)
{
    size_t f = 0, seen = 0;
    while (k >= seen + p->product->dims[f])
        seen += p->product->dims[f++];
    *from = p->first[f];
    *to = p->first[f] + 1 + (k - seen);
}

/* The derivative along direction k, up to a positive factor, as differences of control points. */
static bool make_rows(element_plan *p, size_t k, lattice *l)
{
    size_t from, to;
    direction_of(p, k, &from, &to);
    unsigned degrees[3] = {p->kind->degree, p->kind->degree, p->kind->degree};
    degrees[factor_of(p, from)]--;
    if (!lattice_make(l, p, degrees))
        return false;
    p->n_rows[k] = l->n;
    p->rows[k] = calloc(l->n * p->n_nodes, sizeof *p->rows[k]);
    for (size_t i = 0; i < l->n && p->rows[k] != NULL; i++) {
        exponents e;
        memcpy(e, l->at[i], sizeof e);
        e[to]++;
        add_control(p, e, 1, p->rows[k] + i * p->n_nodes);
        e[to]--;
        e[from]++;
        add_control(p, e, -1, p->rows[k] + i * p->n_nodes);
    }
    return p->rows[k] != NULL;
}

/* The product of three polynomials, or of two in the plane. l[0..dim) are the places of their
 * coefficients. */
static bool make_terms(element_plan *p, const lattice *l, const lattice *all)
{
    size_t n_c = p->dim == 3 ? l[2].n : 1;
    p->n_terms = l[0].n * l[1].n * n_c;
    p->terms = calloc(p->n_terms, sizeof *p->terms);
    p->rounding = calloc(all->n, sizeof *p->rounding);
    if (p->terms == NULL || p->rounding == NULL)
        return false;
    for (size_t i = 0; i < p->n_terms; i++) {
        size_t rows[3] = {i % l[0].n, i / l[0].n % l[1].n, i / l[0].n / l[1].n};
        exponents sum = {0};
        double weight = 1;
        for (size_t k = 0; k < p->dim; k++) {
            weight *= multinomial(p, l[k].at[rows[k]]);
            for (size_t j = 0; j < N_EXPONENTS; j++)
                sum[j] = (unsigned char)(sum[j] + l[k].at[rows[k]][j]);
        }
        size_t to = lattice_find(all, sum);
        p->terms[i] =
            (term){(unsigned short)rows[0], (unsigned short)rows[1], (unsigned short)rows[2],
                   (unsigned short)to, weight / multinomial(p, sum)};
        p->rounding[to]++;
    }
    return true;
}

/* The lines of coefficients along the edge between two vertices of a factor. */
static bool make_lines(element_plan *p, const lattice *all, size_t from, size_t to)
{
    size_t pair = p->n_pairs++;
    p->lines[pair] = calloc(all->n, sizeof *p->lines[pair]);
    for (size_t i = 0; i < all->n && p->lines[pair] != NULL; i++) {
        exponents e;
        memcpy(e, all->at[i], sizeof e);
        if (e[to] > 0) /* a line is found where it begins */
            continue;
        bernstein_line *line = &p->lines[pair][p->n_lines[pair]++];
        line->n = e[from];
        for (unsigned j = 0; j <= line->n; j++, e[from]--, e[to]++)
            line->at[j] = (unsigned short)lattice_find(all, e);
    }
    return p->lines[pair] != NULL;
}

static bool make_all_lines(element_plan *p, const lattice *all)
{
    for (size_t f = 0; f < p->product->n_factors; f++)
        for (size_t from = p->first[f]; from < p->first[f + 1]; from++)
            for (size_t to = from + 1; to < p->first[f + 1]; to++)
                if (!make_lines(p, all, from, to))
                    return false;
    return true;
}

static void find_corners(element_plan *p, const lattice *all, const unsigned *degrees)
{
    p->n_corners = p->product->n_corners;
    for (size_t c = 0; c < p->n_corners; c++) {
        exponents e = {0};
        for (size_t f = 0; f < p->product->n_factors; f++)
            e[p->first[f] + p->product->corners[c][f]] = (unsigned char)degrees[f];
        p->corners[c] = (unsigned short)lattice_find(all, e);
    }
}

/* Computes everything that does not depend on the nodes' places. */
static bool make_bernstein(element_plan *p, lattice l[4])
{
    unsigned degrees[3] = {0, 0, 0};
    for (size_t f = 0; f < p->product->n_factors; f++) {
        p->first[f + 1] = p->first[f] + p->product->dims[f] + 1;
        degrees[f] = (unsigned)p->dim * p->kind->degree - p->product->dims[f];
    }
    for (size_t k = 0; k < p->dim; k++)
        if (!make_rows(p, k, &l[k]))
            return false;
    if (!lattice_make(&l[3], p, degrees))
        return false;
    p->n_coefficients = l[3].n;
    p->work = calloc((DEEPEST + 2) * 2 * l[3].n, sizeof *p->work);
    find_corners(p, &l[3], degrees);
    return p->work != NULL && make_terms(p, l, &l[3]) && make_all_lines(p, &l[3]);
}

/* The signs at the corners decide for linear simplices. They decide for quadrilaterals, because the
 * determinant is linear along each side. They decide for pyramids, because points go straight from the
 * base to the apex, so the determinant is that of the base times a positive number. */
bool element_corners_decide(const element_kind *k)
{
    return k->degree == 1 && k->shape != SHAPE_CUBE && k->shape != SHAPE_PRISM;
}

element_plan *element_plan_make(const element_kind *kind)
{
    element_plan *p = calloc(1, sizeof *p);
    if (p == NULL)
        return NULL;
    p->kind = kind;
    p->product = element_product_of(kind->shape);
    p->dim = kind->dim;
    p->n_nodes = kind->n_nodes;
    lattice l[4] = {{0}};
    bool good = p->product == NULL || element_corners_decide(kind) || make_bernstein(p, l);
    for (size_t k = 0; k < 4; k++)
        free(l[k].at);
    if (!good) {
        element_plan_free(p);
        return NULL;
    }
    return p;
}

void element_plan_free(element_plan *p)
{
    for (size_t k = 0; p != NULL && k < 3; k++)
        free(p->rows[k]);
    for (size_t k = 0; p != NULL && k < p->n_pairs; k++)
        free(p->lines[k]);
    if (p != NULL) {
        free(p->terms);
        free(p->rounding);
        free(p->work);
    }
    free(p);
}
