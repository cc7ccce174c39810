/* Domains made of meshes: what is accepted, what is refused and how it is named, and what the
 * library keeps of the mesh. */
#include "../../flat_mesh.h"
#include <check.h>
#include <stdio.h>
#include <stdlib.h>

#include "../../faulty.h"
#include "../../meshes.h"
#include "../../shapes.h"
#include "../../suite.h"
#include "../../surfaces.h"
#include "domain/domain.h"
#include "geometry/simplices.h"
#include "math/orient.h"

static icc_domain *make(const test_mesh *m)
{
    icc_error err = {.size = sizeof err};
    icc_domain *domain;
    const icc_status status = mesh_domain(&domain, m, NULL, &err);
    ck_assert_msg(status == ICC_OK, "%s", err.message);
    ck_assert_ptr_nonnull(domain);
    return domain;
}

static int compare(const void *a, const void *b)
{
    const uint32_t x = *(const uint32_t *)a, y = *(const uint32_t *)b;
    return (x > y) - (x < y);
}

static void sorted_side(const iccp_simplices *s, size_t side, uint32_t *v)
{
    const size_t n = s->dim + 1, i = side % n;
    for (size_t k = 0, j = 0; j < n; ++j)
        if (j != i)
            v[k++] = s->corners[side - i + j];
    qsort(v, s->dim, sizeof *v, compare);
}

/* What lib/geometry/simplices.h says, and that it is the caller's mesh. */
static void check_mesh(const icc_domain *d, const test_mesh *m)
{
    const iccp_simplices *s = d->mesh;
    const size_t dim = (size_t)m->dim;
    size_t n_rim_sides = 0;
    ck_assert_ptr_nonnull(s);
    ck_assert_uint_eq(s->dim, dim);
    ck_assert_uint_eq(s->n_boundary, d->n_vertices);
    ck_assert_uint_eq(s->n_facets, d->n_facets);
    ck_assert_uint_eq(s->n_simplices, m->n_simplices);
    ck_assert_mem_eq(s->points, d->vertices, s->n_boundary * dim * sizeof(double));
    for (size_t side = 0; side < (dim + 1) * s->n_simplices; ++side) {
        const uint32_t across = s->across[side];
        uint32_t mine[6], other[6];
        sorted_side(s, side, mine);
        if (across & ICCP_ON_BOUNDARY) {
            const uint32_t f = across & ~ICCP_ON_BOUNDARY;
            ck_assert_uint_lt(f, d->n_facets);
            memcpy(other, d->facets + dim * f, dim * sizeof *other);
            qsort(other, dim, sizeof *other, compare);
            ++n_rim_sides;
        } else {
            ck_assert_uint_lt(across, (dim + 1) * s->n_simplices);
            ck_assert_uint_eq(s->across[across], side);
            ck_assert_uint_ne(iccp_simplex_of(s, across), iccp_simplex_of(s, (uint32_t)side));
            sorted_side(s, across, other);
        }
        ck_assert_mem_eq(mine, other, dim * sizeof *mine);
    }
    ck_assert_uint_eq(n_rim_sides, d->n_facets);
    for (size_t k = 0; k < s->n_simplices; ++k) {
        const double *corner[7];
        for (size_t i = 0; i <= dim; ++i) {
            double given[6];
            corner[i] = iccp_corner_point(s, (dim + 1) * k + i);
            iccp_frame_out(&d->frame, m->dim, corner[i], given);
            size_t found = 0;
            for (size_t j = 0; j <= dim; ++j)
                found += memcmp(given, m->vertices + dim * m->simplices[(dim + 1) * k + j],
                                dim * sizeof *given) == 0;
            ck_assert_uint_eq(found, 1);
        }
        ck_assert_int_eq(iccp_orient(dim, corner), 1);
    }
}

START_TEST(cubes_of_every_dimension)
{
    random_source r = {1};
    for (int32_t dim = 2; dim <= 6; ++dim)
        for (size_t n = 1; n <= (dim < 4 ? 4u : dim < 6 ? 2u : 1u); ++n) {
            test_mesh m = mesh_cube(dim, n, 0.1, &r);
            icc_domain *d = make(&m);
            icc_domain_info info = {.size = sizeof info};
            check_mesh(d, &m);
            ck_assert_int_eq(icc_domain_get_info(d, &info), ICC_OK);
            ck_assert_int_eq(info.orientation, 1);
            ck_assert(fabs(info.measure - pow((double)n, dim)) < 1e-9);
            icc_domain_free(d);
            mesh_free(&m);
        }
}
END_TEST

/* Any order of vertices, of simplices and of their corners. */
static void shuffle(test_mesh *m, random_source *r)
{
    const size_t dim = (size_t)m->dim, n = m->n_vertices, width = (dim + 1) * sizeof *m->simplices;
    uint32_t *number = mesh_alloc(n, sizeof *number);
    double *vertices = mesh_alloc(n * dim, sizeof *vertices);
    for (uint32_t v = 0; v < n; ++v) {
        const uint32_t w = (uint32_t)random_below(r, (int)v + 1);
        number[v] = number[w];
        number[w] = v;
    }
    for (size_t v = 0; v < n; ++v)
        memcpy(vertices + dim * number[v], m->vertices + dim * v, dim * sizeof *vertices);
    free(m->vertices);
    m->vertices = vertices;
    for (size_t i = 0; i < (dim + 1) * m->n_simplices; ++i)
        m->simplices[i] = number[m->simplices[i]];
    for (size_t i = 0; m->facets != NULL && i < dim * m->n_facets; ++i)
        m->facets[i] = number[m->facets[i]];
    for (size_t k = 0; k < m->n_simplices; ++k) {
        uint32_t *a = m->simplices + (dim + 1) * k, other[7];
        uint32_t *b = m->simplices + (dim + 1) * (size_t)random_below(r, (int)k + 1);
        memcpy(other, a, width);
        memmove(a, b, width);
        memcpy(b, other, width);
        for (size_t i = 1; i <= dim; ++i) {
            const size_t j = (size_t)random_below(r, (int)i + 1);
            const uint32_t swap = a[i];
            a[i] = a[j];
            a[j] = swap;
        }
    }
    free(number);
}

/* The vertices are known bit for bit. */
static void check_given(const icc_domain *d, const double *expected)
{
    const size_t dim = (size_t)d->dim;
    double x[ICC_MAX_DIM];
    for (size_t v = 0; v < d->n_vertices; ++v) {
        iccp_domain_given(d, v, x);
        ck_assert_mem_eq(x, expected + dim * v, dim * sizeof *x);
    }
}

/* The caller's numbers of the vertices of the boundary, which are the domain's in this order. */
static size_t list_rim(const icc_domain *d, const test_mesh *m, uint32_t *rim)
{
    const size_t size = (size_t)m->dim * sizeof(double);
    double x[ICC_MAX_DIM];
    size_t n = 0;
    for (uint32_t v = 0; v < m->n_vertices && n < d->n_vertices; ++v) {
        iccp_domain_given(d, n, x);
        if (memcmp(m->vertices + (size_t)m->dim * v, x, size) == 0)
            rim[n++] = v;
    }
    return n;
}

START_TEST(any_listing_will_do)
{
    random_source r = {2};
    for (int32_t dim = 2; dim <= 4; ++dim)
        for (int round = 0; round < 5; ++round) {
            test_mesh m = mesh_cube(dim, 3, 0.1, &r);
            shuffle(&m, &r);
            icc_domain *d = make(&m);
            uint32_t *rim = mesh_alloc(m.n_vertices, sizeof *rim), before[6] = {0};
            check_mesh(d, &m);
            ck_assert_int_eq(d->orientation, 1);
            ck_assert_uint_eq(list_rim(d, &m, rim), d->n_vertices);
            for (size_t f = 0; f < d->n_facets; ++f) {
                uint32_t v[6] = {0};
                for (int32_t k = 0; k < dim; ++k)
                    v[k] = rim[d->facets[(size_t)dim * f + (size_t)k]];
                qsort(v, (size_t)dim, sizeof *v, compare);
                int32_t k = 0;
                while (f > 0 && k < dim && v[k] == before[k])
                    ++k;
                ck_assert(f == 0 || (k < dim && v[k] > before[k]));
                memcpy(before, v, sizeof v);
            }
            free(rim);
            icc_domain_free(d);
            mesh_free(&m);
        }
}
END_TEST

/* Everything else works as on a domain made of the boundary alone. */
START_TEST(the_boundary_is_an_ordinary_one)
{
    random_source r = {3};
    for (int32_t dim = 2; dim <= 4; ++dim) {
        test_mesh m = mesh_ball(dim, 4, 0.1, &r);
        icc_domain *d = make(&m), *alone;
        double *given = mesh_alloc(d->n_vertices * (size_t)dim, sizeof *given);
        ck_assert_int_eq(icc_domain_get_boundary(d, given, NULL), ICC_OK);
        ck_assert_int_eq(icc_domain_create(&alone, dim, d->n_vertices, given, d->n_facets,
                                           d->facets, NULL, NULL),
                         ICC_OK);
        free(given);
        check_mesh(d, &m);
        ck_assert_mem_eq(d->vertices, alone->vertices,
                         d->n_vertices * (size_t)dim * sizeof(double));
        for (int i = 0; i < 300; ++i) {
            double p[6], bary[2][6];
            int32_t where[2];
            uint32_t facet[2];
            for (int32_t k = 0; k < dim; ++k)
                p[k] = random_between(&r, -1.1, 1.1);
            ck_assert_int_eq(icc_domain_locate(d, 1, p, &where[0], &facet[0], bary[0], NULL),
                             ICC_OK);
            ck_assert_int_eq(icc_domain_locate(alone, 1, p, &where[1], &facet[1], bary[1], NULL),
                             ICC_OK);
            ck_assert(where[0] == where[1] && facet[0] == facet[1]);
        }
        icc_domain_free(d);
        icc_domain_free(alone);
        mesh_free(&m);
    }
}
END_TEST

START_TEST(polygons)
{
    const shape shapes[] = {
        shape_square(),        shape_l(), shape_dart(), shape_e(), shape_star(7, 0.3, 0.1),
        shape_worm(20, 0.3, 1)};
    for (size_t k = 0; k < sizeof shapes / sizeof *shapes; ++k)
        for (double width = 0.1; width < 1; width *= 2) {
            test_mesh m = mesh_polygon(shapes[k].n, shapes[k].xy, width);
            icc_domain *d = make(&m);
            check_mesh(d, &m);
            ck_assert_uint_eq(d->n_vertices, shapes[k].n);
            check_given(d, shapes[k].xy);
            icc_domain_free(d);
            mesh_free(&m);
        }
}
END_TEST

/* ---- facets in the caller's order ---- */

static test_mesh cube_with_facets(int32_t dim, size_t n)
{
    random_source r = {4};
    test_mesh m = mesh_cube(dim, n, 0.1, &r);
    icc_domain *d = make(&m);
    uint32_t *rim = mesh_alloc(m.n_vertices, sizeof *rim);
    ck_assert_uint_eq(list_rim(d, &m, rim), d->n_vertices);
    m.n_facets = d->n_facets;
    m.facets = mesh_alloc(m.n_facets * (size_t)dim, sizeof *m.facets);
    for (size_t i = 0; i < m.n_facets * (size_t)dim; ++i)
        m.facets[i] = rim[d->facets[i]];
    for (size_t f = m.n_facets; f-- > 1;) {
        const size_t g = (size_t)random_below(&r, (int)f + 1);
        for (size_t k = 0; k < (size_t)dim; ++k) {
            uint32_t *a = m.facets + (size_t)dim * f + k, *b = m.facets + (size_t)dim * g + k;
            const uint32_t swap = *a;
            *a = *b;
            *b = swap;
        }
    }
    free(rim);
    icc_domain_free(d);
    return m;
}

static void turn(const test_mesh *m, size_t facet)
{
    uint32_t *v = m->facets + (size_t)m->dim * facet, swap = v[0];
    v[0] = v[1];
    v[1] = swap;
}

START_TEST(facets_may_be_given)
{
    for (int32_t dim = 2; dim <= 4; ++dim)
        for (int inverted = 0; inverted < 2; ++inverted) {
            test_mesh m = cube_with_facets(dim, 2);
            uint32_t *rim = mesh_alloc(m.n_vertices, sizeof *rim);
            for (size_t f = 0; inverted && f < m.n_facets; ++f)
                turn(&m, f);
            icc_domain *d = make(&m);
            check_mesh(d, &m);
            ck_assert_int_eq(d->orientation, inverted ? -1 : 1);
            ck_assert_uint_eq(list_rim(d, &m, rim), d->n_vertices);
            for (size_t i = 0; i < m.n_facets * (size_t)dim; ++i)
                ck_assert_uint_eq(rim[d->facets[i]], m.facets[i]);
            free(rim);
            icc_domain_free(d);
            mesh_free(&m);
        }
}
END_TEST

/* ---- what is refused ---- */

static void check_refused(const test_mesh *m, icc_status expected, int64_t index, const char *text)
{
    icc_error err = {.size = sizeof err};
    icc_domain *domain = NULL;
    const icc_status status = mesh_domain(&domain, m, NULL, &err);
    if (status != expected || err.index != index || strstr(err.message, text) == NULL)
        ck_abort_msg("status %d, index %ld: %s; not %d, %ld: %s", (int)status, (long)err.index,
                     err.message, (int)expected, (long)index, text);
    ck_assert_ptr_null(domain);
}

START_TEST(other_facets_are_refused)
{
    for (int32_t dim = 2; dim <= 4; ++dim) {
        const char *name = iccp_simplices_facet((size_t)dim);
        char text[64];
        test_mesh m = cube_with_facets(dim, 2);
        const size_t size = (size_t)dim * sizeof *m.facets;
        uint32_t *third = m.facets + 3 * (size_t)dim, kept[6];
        memcpy(kept, third, size);
        memcpy(third, m.facets + (size_t)dim, size);
        (void)snprintf(text, sizeof text, "%ss 1 and 3 are the same", name);
        icc_error err = {.size = sizeof err};
        icc_domain *domain;
        /* Which of the two faults of this list is found first is of no importance. */
        ck_assert_int_eq(mesh_domain(&domain, &m, NULL, &err), ICC_ERR_BOUNDARY);
        ck_assert(strstr(err.message, text) != NULL || strstr(err.message, "not among") != NULL);
        memcpy(third, kept, size);
        third[0] = (uint32_t)m.n_vertices;
        check_refused(&m, ICC_ERR_BOUNDARY, 3, "but there are only");
        memcpy(third, kept, size);
        turn(&m, 3);
        ck_assert_int_eq(mesh_domain(&domain, &m, NULL, &err), ICC_ERR_BOUNDARY);
        turn(&m, 3);
        --m.n_facets;
        ck_assert_int_eq(mesh_domain(&domain, &m, NULL, &err), ICC_ERR_BOUNDARY);
        ck_assert_ptr_nonnull(strstr(err.message, "is on the boundary, but not among the facets"));
        m.n_facets = 0;
        ck_assert_int_eq(mesh_domain(&domain, &m, NULL, &err), ICC_ERR_BOUNDARY);
        mesh_free(&m);
    }
}
END_TEST

START_TEST(facets_too_many)
{
    for (int32_t dim = 2; dim <= 4; ++dim) {
        test_mesh m = cube_with_facets(dim, 2);
        const size_t n = m.n_facets, d = (size_t)dim;
        uint32_t *more = mesh_alloc((n + 1) * d, sizeof *more);
        memcpy(more, m.facets, n * d * sizeof *more);
        free(m.facets);
        m.facets = more;
        m.n_facets = n + 1;
        memcpy(more + n * d, more, d * sizeof *more);
        check_refused(&m, ICC_ERR_BOUNDARY, 0, "are the same");
        /* An inner facet of the first cell: without the corner of the cube. */
        memcpy(more + n * d, m.simplices + 1, d * sizeof *more);
        icc_error err = {.size = sizeof err};
        icc_domain *domain;
        ck_assert_int_eq(mesh_domain(&domain, &m, NULL, &err), ICC_ERR_BOUNDARY);
        for (size_t k = 0; k < d; ++k)
            more[n * d + k] = 0;
        check_refused(&m, ICC_ERR_BOUNDARY, (int64_t)n, "is not one of the mesh");
        mesh_free(&m);
    }
}
END_TEST

static long double det3(const test_mesh *m, size_t simplex)
{
    const uint32_t *v = m->simplices + 4 * simplex;
    long double e[3][3];
    for (size_t i = 0; i < 3; ++i)
        for (size_t k = 0; k < 3; ++k)
            e[i][k] = (long double)m->vertices[3 * v[i + 1] + k] - m->vertices[3 * v[0] + k];
    return e[0][0] * (e[1][1] * e[2][2] - e[1][2] * e[2][1]) -
           e[0][1] * (e[1][0] * e[2][2] - e[1][2] * e[2][0]) +
           e[0][2] * (e[1][0] * e[2][1] - e[1][1] * e[2][0]);
}

/* The centre of a cube of 8 cells goes to a face of its star, and beyond. */
START_TEST(flat_and_inverted_tetrahedra_are_named)
{
    for (int which = 0; which < 2; ++which) {
        test_mesh m = mesh_cells(3, 2, NULL), before = mesh_copy(&m);
        double *centre = m.vertices + 3 * 13;
        ck_assert(centre[0] + centre[1] + centre[2] == 3);
        centre[0] = which ? 2.5 : 2;
        int64_t flat = -1, inverted = -1;
        for (size_t k = m.n_simplices; k-- > 0;) {
            flat = det3(&m, k) == 0 ? (int64_t)k : flat;
            inverted = det3(&m, k) * det3(&before, k) < 0 ? (int64_t)k : inverted;
        }
        ck_assert((flat >= 0) == !which && (inverted >= 0) == which);
        if (!which)
            check_refused(&m, ICC_ERR_BOUNDARY, flat, "is flat");
        else {
            icc_error err = {.size = sizeof err};
            icc_domain *domain;
            ck_assert_int_eq(mesh_domain(&domain, &m, NULL, &err), ICC_ERR_BOUNDARY);
            ck_assert_ptr_nonnull(strstr(err.message, "lie on the same side of face"));
            ck_assert(err.index >= 0 && (size_t)err.index < m.n_simplices);
        }
        mesh_free(&m);
        mesh_free(&before);
    }
}
END_TEST

/* Flat to the last bit, or not. */
START_TEST(signs_are_exact)
{
    const uint32_t tetrahedron[4] = {0, 1, 2, 3}, triangle[3] = {0, 1, 2};
    for (int k = -1; k <= 1; ++k) {
        double x[12] = {0.1, 0.1, 0.1, 12.1, 12.1, 12.1, 0.3, 0.7, 0.2, 24, 24, 24};
        x[10] = k == 0 ? 24 : nextafter(24, 24 + k);
        const double y[6] = {0.5, 0.5, 12, 12, 24, k == 0 ? 24 : nextafter(24, 24 + k)};
        icc_domain *d;
        icc_error err = {.size = sizeof err};
        /* On the line x = y = z to rounding: exactly so only where the first point is too. */
        x[0] = x[1] = x[2] = 0.5;
        x[3] = x[4] = x[5] = 12;
        ck_assert_int_eq(flat_create_mesh(&d, 3, 4, x, 1, tetrahedron, 0, NULL, NULL, &err),
                         k == 0 ? ICC_ERR_BOUNDARY : ICC_OK);
        ck_assert(k != 0 || err.index == 0);
        icc_domain_free(d);
        ck_assert_int_eq(flat_create_mesh(&d, 2, 3, y, 1, triangle, 0, NULL, NULL, &err),
                         k == 0 ? ICC_ERR_BOUNDARY : ICC_OK);
        icc_domain_free(d);
    }
}
END_TEST

static test_mesh with_simplex(const test_mesh *m, const uint32_t *simplex, const double *vertex)
{
    const size_t dim = (size_t)m->dim;
    test_mesh more = mesh_of(m->dim, m->n_vertices + 1, m->n_simplices + 1);
    memcpy(more.vertices, m->vertices, m->n_vertices * dim * sizeof(double));
    memcpy(more.vertices + m->n_vertices * dim, vertex, dim * sizeof(double));
    memcpy(more.simplices, m->simplices, m->n_simplices * (dim + 1) * sizeof(uint32_t));
    memcpy(more.simplices + m->n_simplices * (dim + 1), simplex, (dim + 1) * sizeof(uint32_t));
    return more;
}

START_TEST(overlapping_simplices_are_named)
{
    for (int32_t dim = 2; dim <= 4; ++dim) {
        random_source r = {5};
        test_mesh m = mesh_cube(dim, 2, 0.1, &r);
        const size_t d = (size_t)dim;
        uint32_t simplex[7];
        double vertex[6];
        /* The first simplex once more. */
        memcpy(simplex, m.simplices, (d + 1) * sizeof *simplex);
        memcpy(vertex, m.vertices, d * sizeof *vertex);
        test_mesh more = with_simplex(&m, simplex, vertex);
        check_refused(&more, ICC_ERR_BOUNDARY, (int64_t)m.n_simplices, "simplices");
        mesh_free(&more);
        /* On its facet opposite the first corner, which lies inside, with a vertex of its own. */
        simplex[0] = (uint32_t)m.n_vertices;
        for (size_t k = 0; k < d; ++k)
            vertex[k] = 0.01 * (double)(k + 1);
        more = with_simplex(&m, simplex, vertex);
        icc_error err = {.size = sizeof err};
        icc_domain *domain;
        ck_assert_int_eq(mesh_domain(&domain, &more, NULL, &err), ICC_ERR_BOUNDARY);
        ck_assert_ptr_nonnull(strstr(err.message, "belongs to 3 simplices"));
        ck_assert_int_eq(err.index, (int64_t)m.n_simplices);
        mesh_free(&more);
        mesh_free(&m);
    }
}
END_TEST

START_TEST(wrong_corners_are_named)
{
    for (int32_t dim = 2; dim <= 6; ++dim) {
        random_source r = {6};
        test_mesh m = mesh_cube(dim, 1, 0, &r);
        const size_t d = (size_t)dim;
        uint32_t *last = m.simplices + (d + 1) * (m.n_simplices - 1), kept = last[d];
        last[d] = (uint32_t)m.n_vertices;
        check_refused(&m, ICC_ERR_BOUNDARY, (int64_t)m.n_simplices - 1, "but there are only");
        last[d] = last[0];
        check_refused(&m, ICC_ERR_BOUNDARY, (int64_t)m.n_simplices - 1, "twice");
        last[d] = kept;
        m.vertices[d * kept] = NAN;
        check_refused(&m, ICC_ERR_BOUNDARY, kept, "is not finite");
        m.vertices[d * kept] = 1e-90;
        check_refused(&m, ICC_ERR_BOUNDARY, kept, "2^-200");
        mesh_free(&m);
    }
}
END_TEST

/* ---- shapes that are no balls ---- */

static int is_centre(int32_t dim, const size_t *cell)
{
    for (int32_t k = 0; k < dim; ++k)
        if (cell[k] != 1)
            return 0;
    return 1;
}

static int in_shell(int32_t dim, const size_t *cell)
{
    return !is_centre(dim, cell);
}

/* A ring round the last axis, thickened along the others. */
static int in_ring(int32_t dim, const size_t *cell)
{
    for (int32_t k = 2; k < dim; ++k)
        if (cell[k] != 0)
            return 0;
    return !(cell[0] == 1 && cell[1] == 1);
}

/* A sphere of two dimensions, thickened along the fourth. */
static int in_thick_shell(int32_t dim, const size_t *cell)
{
    return dim == 4 && cell[3] == 0 && in_shell(3, cell);
}

static int in_halves(int32_t dim, const size_t *cell)
{
    (void)dim;
    return cell[0] != 1;
}

/* Two cells that share a face of dimension dim - n. */
static int in_two(int32_t dim, const size_t *cell, int32_t n)
{
    size_t sum = 0;
    for (int32_t k = 0; k < dim; ++k)
        if (k < n ? cell[k] != cell[0] : cell[k] != 0)
            return 0;
    sum += cell[0];
    return sum < 2;
}

static int in_corner_pair(int32_t dim, const size_t *cell)
{
    return in_two(dim, cell, dim);
}

static int in_edge_pair(int32_t dim, const size_t *cell)
{
    return in_two(dim, cell, dim - 1);
}

static int in_l(int32_t dim, const size_t *cell)
{
    size_t n = 0;
    for (int32_t k = 0; k < dim; ++k)
        n += cell[k] != 0;
    return n <= 1;
}

START_TEST(holes_and_pieces_are_refused)
{
    for (int32_t dim = 2; dim <= 4; ++dim) {
        static int (*const BAD[])(int32_t, const size_t *) = {
            in_shell, in_ring, in_halves, in_corner_pair, in_edge_pair, in_thick_shell};
        for (size_t k = 0; k < sizeof BAD / sizeof *BAD; ++k) {
            test_mesh m = mesh_cells(dim, 3, BAD[k]);
            icc_error err = {.size = sizeof err};
            icc_domain *domain;
            /* Cells that share an edge in the plane hang together. Solids may have handles and
             * voids. */
            const int good = (dim == 2 && BAD[k] == in_edge_pair) ||
                             (dim == 3 && (BAD[k] == in_shell || BAD[k] == in_ring));
            const icc_status status =
                m.n_simplices > 0 ? mesh_domain(&domain, &m, NULL, &err) : ICC_ERR_TOPOLOGY;
            if (status != (good ? ICC_OK : ICC_ERR_TOPOLOGY))
                ck_abort_msg("dimension %d, case %zu: %d %s", (int)dim, k, (int)status,
                             err.message);
            if (good) {
                icc_domain_info info = {.size = sizeof info};
                ck_assert_int_eq(icc_domain_get_info(domain, &info), ICC_OK);
                ck_assert_uint_eq(info.genus, dim == 3 && BAD[k] == in_ring);
                ck_assert_uint_eq(info.n_voids, dim == 3 && BAD[k] == in_shell);
                icc_domain_free(domain);
            }
            if (BAD[k] == in_halves || BAD[k] == in_corner_pair)
                ck_assert(err.index > 0 && strstr(err.message, "in several pieces") != NULL);
            mesh_free(&m);
        }
        test_mesh m = mesh_cells(dim, 3, in_l);
        icc_domain *d = make(&m);
        check_mesh(d, &m);
        icc_domain_free(d);
        mesh_free(&m);
    }
}
END_TEST

/* Vertices that no simplex has are ignored, whatever they are. */
START_TEST(unused_vertices_are_ignored)
{
    test_mesh m = mesh_cells(3, 3, in_l);
    size_t n_used = 0;
    for (uint32_t v = 0; v < m.n_vertices; ++v) {
        int used = 0;
        for (size_t i = 0; i < 4 * m.n_simplices; ++i)
            used |= m.simplices[i] == v;
        n_used += (size_t)used;
        if (!used)
            m.vertices[3 * v + v % 3] = v % 2 ? NAN : 1e308;
    }
    ck_assert_uint_lt(n_used, m.n_vertices);
    icc_domain *d = make(&m);
    check_mesh(d, &m);
    ck_assert_uint_eq(d->mesh->n_points, n_used);
    icc_domain_free(d);
    mesh_free(&m);
}
END_TEST

/* Triangles round a vertex, twice round it: nothing is wrong with any two of them. */
START_TEST(coverings_are_refused)
{
    enum { N = 10 };
    double xy[2 * (N + 1)] = {0};
    uint32_t triangles[3 * N];
    for (uint32_t k = 0; k < N; ++k) {
        const double angle = 2 * 6.283185307179586 * k / N, radius = 1 + 0.03 * k;
        xy[2 * (k + 1)] = radius * cos(angle);
        xy[2 * (k + 1) + 1] = radius * sin(angle);
        triangles[3 * k] = 0;
        triangles[3 * k + 1] = k + 1;
        triangles[3 * k + 2] = (k + 1) % N + 1;
    }
    icc_error err = {.size = sizeof err};
    icc_domain *domain;
    ck_assert_int_eq(flat_create_mesh(&domain, 2, N + 1, xy, N, triangles, 0, NULL, NULL, &err),
                     ICC_ERR_BOUNDARY);
    ck_assert_ptr_nonnull(strstr(err.message, "cross"));
}
END_TEST

/* ---- position, size, arguments, failures ---- */

START_TEST(any_position_and_size)
{
    static const double SCALES[] = {1, 1e-300, 1e-308, 1e300, 0x1p1020, 1},
                        FAR[] = {0, 0, 0, 0, 0, 1e9};
    for (int32_t dim = 2; dim <= 4; ++dim)
        for (size_t k = 0; k < sizeof SCALES / sizeof *SCALES; ++k) {
            random_source r = {7};
            test_mesh m = mesh_cube(dim, 3, 0.1, &r);
            for (size_t i = 0; i < m.n_vertices * (size_t)dim; ++i)
                m.vertices[i] = (m.vertices[i] + FAR[k]) * SCALES[k];
            icc_domain *d = make(&m);
            check_mesh(d, &m);
            icc_domain_free(d);
            mesh_free(&m);
        }
}
END_TEST

START_TEST(arguments_are_checked)
{
    random_source r = {8};
    test_mesh m = mesh_cube(3, 1, 0, &r);
    icc_domain *d;
    icc_error err = {.size = sizeof err};
    static const struct {
        int32_t dim;
        size_t n_vertices, n_simplices, n_facets;
        int no_out, no_vertices, no_simplices, facets;
    } BAD[] = {{1, 8, 6, 0, 0, 0, 0, 0},        {7, 8, 6, 0, 0, 0, 0, 0},
               {-3, 8, 6, 0, 0, 0, 0, 0},       {3, 8, 6, 0, 1, 0, 0, 0},
               {3, 8, 6, 0, 0, 1, 0, 0},        {3, 8, 6, 0, 0, 0, 1, 0},
               {3, SIZE_MAX, 6, 0, 0, 0, 0, 0}, {3, 8, SIZE_MAX, 0, 0, 0, 0, 0},
               {3, 8, 0, 0, 0, 0, 0, 0},        {3, 8, 6, SIZE_MAX, 0, 0, 0, 1}};
    for (size_t k = 0; k < sizeof BAD / sizeof *BAD; ++k) {
        d = (icc_domain *)&d;
        ck_assert_int_eq(flat_create_mesh(BAD[k].no_out ? NULL : &d, BAD[k].dim, BAD[k].n_vertices,
                                          BAD[k].no_vertices ? NULL : m.vertices,
                                          BAD[k].n_simplices,
                                          BAD[k].no_simplices ? NULL : m.simplices, BAD[k].n_facets,
                                          BAD[k].facets ? m.simplices : NULL, NULL, &err),
                         ICC_ERR_ARGUMENT);
        ck_assert(BAD[k].no_out || d == NULL);
    }
    /* Their number does not matter without facets. */
    ck_assert_int_eq(
        flat_create_mesh(&d, 3, 8, m.vertices, 6, m.simplices, SIZE_MAX, NULL, NULL, &err), ICC_OK);
    icc_domain_free(d);
    ck_assert_int_eq(flat_create_mesh(&d, 3, 0, NULL, 6, m.simplices, 0, NULL, NULL, &err),
                     ICC_ERR_BOUNDARY);
    mesh_free(&m);
}
END_TEST

static icc_status make_and_free(const icc_env *env, icc_error *err, void *argument)
{
    icc_domain *domain;
    const icc_status status = mesh_domain(&domain, argument, env, err);
    ck_assert((domain != NULL) == (status == ICC_OK));
    icc_domain_free(domain);
    return status;
}

START_TEST(failures_leave_nothing_behind)
{
    for (int32_t dim = 2; dim <= 4; ++dim) {
        test_mesh m = cube_with_facets(dim, 2);
        faulty_sweep(make_and_free, &m);
        free(m.facets);
        m.facets = NULL;
        faulty_sweep(make_and_free, &m);
        mesh_free(&m);
    }
}
END_TEST

/* ---- real meshes ---- */

START_TEST(meshes_by_tetgen)
{
    static const char *const NAMES[] = {"t01_cube_bend", "t06_spikes_sphere", "t08_fox"};
    static surface s;
    random_source r = {9};
    test_mesh m;
    surface_star(&s, 3, 0.4, &r);
    if (mesh_tetgen(&m, s.n_vertices, s.vertices, s.n_faces, s.faces, "test_simplices_star")) {
        icc_domain *d = make(&m);
        check_mesh(d, &m);
        check_given(d, s.vertices);
        ck_assert_mem_eq(d->facets, s.faces, 3 * s.n_faces * sizeof(uint32_t));
        icc_domain_free(d);
        mesh_free(&m);
    }
    for (size_t k = 0; k < sizeof NAMES / sizeof *NAMES; ++k)
        for (int side = 0; side < 2; ++side)
            if (mesh_of_data(&m, NAMES[k], side ? "tgt" : "src", "test_simplices")) {
                icc_domain *d = make(&m);
                check_mesh(d, &m);
                ck_assert_uint_eq(d->n_facets, m.n_facets);
                ck_assert_mem_eq(d->facets, m.facets, 3 * m.n_facets * sizeof(uint32_t));
                icc_domain_free(d);
                mesh_free(&m);
            }
}
END_TEST

int main(void)
{
    Suite *suite = suite_create("simplices");
    TCase *tests = tcase_create("all");
    tcase_set_timeout(tests, 60);
    tcase_add_test(tests, cubes_of_every_dimension);
    tcase_add_test(tests, any_listing_will_do);
    tcase_add_test(tests, the_boundary_is_an_ordinary_one);
    tcase_add_test(tests, polygons);
    tcase_add_test(tests, facets_may_be_given);
    tcase_add_test(tests, other_facets_are_refused);
    tcase_add_test(tests, facets_too_many);
    tcase_add_test(tests, flat_and_inverted_tetrahedra_are_named);
    tcase_add_test(tests, signs_are_exact);
    tcase_add_test(tests, overlapping_simplices_are_named);
    tcase_add_test(tests, wrong_corners_are_named);
    tcase_add_test(tests, holes_and_pieces_are_refused);
    tcase_add_test(tests, unused_vertices_are_ignored);
    tcase_add_test(tests, coverings_are_refused);
    tcase_add_test(tests, any_position_and_size);
    tcase_add_test(tests, arguments_are_checked);
    tcase_add_test(tests, failures_leave_nothing_behind);
    tcase_add_test(tests, meshes_by_tetgen);
    suite_add_tcase(suite, tests);
    return suite_run(suite);
}
