/* What holds for the gradient coordinates of solids and masks of any dimension. */
#include "chart/chart.h"
#include "chart/gradient_line.h"

#include "../faulty.h"
#include "../npy.h"
#include "../obj.h"
#include "../random.h"
#include "../surfaces.h"

#include <check.h>
#include <math.h>
#include <stdlib.h>

typedef struct subject {
    icc_domain *domain;
    icc_chart *chart;
    icc_domain_info shape;
    icc_chart_info info;
} subject;

static void subject_clear(subject *s)
{
    icc_domain_free(s->domain);
    icc_chart_free(s->chart);
}

static icc_chart_options options_of(int32_t function, int32_t cells)
{
    return (icc_chart_options){.size = sizeof(icc_chart_options),
                               .method = ICC_METHOD_GRADIENT,
                               .function = function,
                               .constraints = ICC_CONSTRAINTS_NONE,
                               .cells = cells};
}

/* ---- shapes ---- */

static int has_box_cell(int x, int y, int z)
{
    return x >= 0 && y >= 0 && z >= 0 && x < 3 && y < 2 && z < 2;
}

static icc_domain *domain_of_surface(const surface *s)
{
    icc_domain *domain;
    ck_assert_int_eq(icc_domain_create(&domain, 3, s->n_vertices, s->vertices, s->n_faces, s->faces,
                                       NULL, NULL),
                     ICC_OK);
    return domain;
}

static icc_domain *box(void)
{
    static surface s;
    surface_cells(&s, 3, has_box_cell);
    for (size_t i = 0; i < s.n_vertices; ++i) {
        double *v = s.vertices + 3 * i;
        v[0] = 0.9 * v[0] + 0.1 * v[1];
        v[2] = v[2] + 0.05 * v[0] + 1000;
    }
    return domain_of_surface(&s);
}

static icc_domain *rock(void)
{
    static surface s;
    random_source r = {5};
    surface_star(&s, 3, 0.15, &r);
    return domain_of_surface(&s);
}

static icc_domain *fox(void)
{
    obj o;
    icc_domain *domain = NULL;
    if (obj_read(&o, TEST_SHARED_DATA "/3d/t08_fox.src.obj"))
        ck_assert_int_eq(icc_domain_create(&domain, 3, o.n_vertices, o.vertices, o.n_faces, o.faces,
                                           NULL, NULL),
                         ICC_OK);
    obj_free(&o);
    return domain;
}

static icc_domain *fox_through_time(void)
{
    npy a;
    icc_domain *domain = NULL;
    if (npy_read(&a, TEST_SHARED_DATA "/masks/n5_fox_4d.npy")) {
        ck_assert_int_eq(icc_mask_repair(a.dim, a.shape, a.cells, NULL, NULL, NULL), ICC_OK);
        ck_assert_int_eq(icc_domain_create_mask(&domain, a.dim, a.shape, a.cells, NULL, NULL),
                         ICC_OK);
    }
    free(a.cells);
    return domain;
}

/* An L, extended along the other axes. */
static icc_domain *corner(int32_t dim)
{
    const size_t shape[ICC_MAX_DIM] = {3, 3, 2, 2, 1, 1};
    uint8_t cells[9 * 4];
    size_t n = 1;
    for (int32_t k = 0; k < dim; ++k)
        n *= shape[k];
    for (size_t i = 0; i < n; ++i)
        cells[i] = !(i % 3 > 0 && i / 3 % 3 > 1);
    icc_domain *domain;
    ck_assert_int_eq(icc_domain_create_mask(&domain, dim, shape, cells, NULL, NULL), ICC_OK);
    return domain;
}

enum { N_SHAPES = 8 };

static icc_domain *shape_number(int k)
{
    switch (k) {
    case 0:
        return box();
    case 1:
        return rock();
    case 2:
        return fox();
    case 3:
        return fox_through_time();
    default:
        return corner(k - 2);
    }
}

static const int32_t CELLS[N_SHAPES] = {13, 16, 40, 0, 20, 12, 8, 6};

/* False when the shape is not at hand. */
static bool subject_init(subject *s, int shape, int32_t function)
{
    *s = (subject){.shape = {.size = sizeof s->shape}, .info = {.size = sizeof s->info}};
    s->domain = shape_number(shape);
    if (s->domain == NULL)
        return false;
    const icc_chart_options options = options_of(function, CELLS[shape]);
    icc_error err = {.size = sizeof err};
    const icc_status status = icc_chart_create(&s->chart, s->domain, &options, NULL, &err);
    ck_assert_msg(status == ICC_OK, "shape %d: %s", shape, err.message);
    (void)icc_domain_get_info(s->domain, &s->shape);
    (void)icc_chart_get_info(s->chart, &s->info);
    return true;
}

/* ---- points ---- */

typedef struct code {
    uint32_t facet;
    double bary[ICC_MAX_DIM], t;
    icc_status status;
} code;

static code encode(const subject *s, const double *p)
{
    code c = {0};
    ck_assert_int_eq(icc_chart_encode(s->chart, 1, p, &c.facet, c.bary, &c.t, &c.status, NULL, NULL),
                     ICC_OK);
    return c;
}

static icc_status decode(const subject *s, const code *c, double *p)
{
    icc_status status;
    ck_assert_int_eq(
        icc_chart_decode(s->chart, 1, &c->facet, c->bary, &c->t, p, &status, NULL, NULL), ICC_OK);
    return status;
}

static void pick_inside(const subject *s, random_source *r, double *p)
{
    int32_t where;
    do {
        for (int32_t k = 0; k < s->shape.dim; ++k)
            p[k] = random_between(r, s->shape.lower[k], s->shape.upper[k]);
        (void)icc_domain_locate(s->domain, 1, p, &where, NULL, NULL, NULL);
    } while (where != ICC_INSIDE);
}

static double width(const subject *s)
{
    double longest = 0;
    for (int32_t k = 0; k < s->shape.dim; ++k)
        longest = fmax(longest, s->shape.upper[k] - s->shape.lower[k]);
    return longest;
}

static double distance(const subject *s, const double *p, const double *q)
{
    double square = 0;
    for (int32_t k = 0; k < s->shape.dim; ++k)
        square += (p[k] - q[k]) * (p[k] - q[k]);
    return sqrt(square);
}

/* Whether the line from a point down to the boundary meets others: then another line leads up. */
static bool merges_below(const subject *s, const double *p)
{
    const iccp_gradient_state *state = s->chart->state;
    double local[ICC_MAX_DIM], q[ICC_MAX_DIM];
    iccp_gradient_line line;
    iccp_frame_in(&s->domain->frame, s->shape.dim, p, local);
    iccp_gradient_to_lattice(state, local, q);
    return iccp_gradient_down(state, q, NULL, NULL, &line) != ICC_OK || line.merged;
}

START_TEST(points_come_back_where_lines_do_not_merge)
{
    random_source r = {1};
    for (int k = 0; k < 3 * N_SHAPES; ++k) {
        subject s;
        size_t n_failed = 0, n_alone = 0, n_lost = 0;
        double worst = 0;
        if (!subject_init(&s, k / 3, ICC_FUNCTION_DECAY + k % 3))
            continue;
        for (int i = 0; i < 300; ++i) {
            double p[ICC_MAX_DIM], back[ICC_MAX_DIM];
            pick_inside(&s, &r, p);
            const code c = encode(&s, p);
            n_failed += c.status != ICC_OK;
            if (c.status != ICC_OK || merges_below(&s, p))
                continue;
            ++n_alone;
            if (decode(&s, &c, back) != ICC_OK) { ++n_lost; continue; }
            worst = fmax(worst, distance(&s, p, back) / width(&s));
        }
        fprintf(stderr, "shape %d function %d dim %d: inside %zu critical %zu+%zu+%zu failed %zu alone %zu lost %zu worst %g\n", k / 3, k % 3,(int)s.shape.dim, s.info.n_inside, s.info.n_maxima,s.info.n_minima,s.info.n_saddles, n_failed, n_alone, n_lost, worst);
        subject_clear(&s);
    }
}
END_TEST

int main(void)
{
    Suite *suite = suite_create("charts in any dimension");
    TCase *tests = tcase_create("all");
    tcase_set_timeout(tests, 300);
    tcase_add_test(tests, points_come_back_where_lines_do_not_merge);
    suite_add_tcase(suite, tests);
    SRunner *runner = srunner_create(suite);
    srunner_run_all(runner, CK_NORMAL);
    const int n_failed = srunner_ntests_failed(runner);
    srunner_free(runner);
    return n_failed == 0 ? EXIT_SUCCESS : EXIT_FAILURE;
}
