/* Where a piece of a curve leaves its simplex: the first root of barycentric coordinates that are
 * parabolas, most of which come close to 0 and turn back, or are negative for a short while. */
#include "field/flow_exit.h"

#include "../../random.h"
#include "../../suite.h"

#include <check.h>
#include <math.h>

/* Each is steep ((s - least)^2 + gap), s being 0 at the start of the piece and 1 at its end. */
typedef struct parabola {
    double steep, least, gap;
} parabola;

static parabola random_parabola(random_source *r, int32_t dim)
{
    parabola p = {0.5 * random_between(r, 0.1, 1) / dim, random_between(r, 0.1, 1.2),
                  pow(10, random_between(r, -10, -1))};
    if (random_below(r, 3) == 0)
        p.gap = -fmin(p.gap, 0.5 * p.least * p.least);
    return p;
}

/* HUGE_VAL when there is none up to 1. */
static double first_root(const parabola *p)
{
    const double root = p->gap < 0 ? p->least - sqrt(-p->gap) : HUGE_VAL;
    return root <= 1 ? root : HUGE_VAL;
}

/* The coordinate of corner 0 is what the others leave of 1, and stays positive. */
static void set_walk(iccp_flow_walk *w, int32_t dim, const parabola *p, random_source *r)
{
    double at = 0, linear = 0, square = 0;
    const int32_t turn = (int32_t)random_below(r, dim);
    for (int32_t k = 0; k < dim; ++k)
        w->place.simplex.axis[k] = (int8_t)((k + turn) % dim);
    w->n_terms = 2;
    w->scale = random_between(r, 0.1, 2);
    for (int32_t i = dim; i > 0; --i) {
        const int8_t axis = w->place.simplex.axis[i - 1];
        const parabola *q = &p[i];
        w->place.at[axis] = at += q->steep * (q->least * q->least + q->gap);
        w->term[0][axis] = (linear -= 2 * q->steep * q->least) / w->scale;
        w->term[1][axis] = 2 * (square += q->steep) / w->scale;
    }
}

START_TEST(the_first_root_is_the_exit)
{
    enum { N = 20000 };
    random_source r = {21};
    size_t n_within = 0, n_dips = 0;
    for (int n = 0; n < N; ++n) {
        const int32_t dim = 2 + (int32_t)random_below(&r, 3);
        const icc_grid grid = {.dim = dim};
        const iccp_flow flow = {.grid = &grid};
        iccp_flow_walk w = {.flow = &flow};
        parabola p[ICC_MAX_DIM + 1];
        int32_t exit = ICCP_FLOW_WITHIN;
        double end = 1;
        for (int32_t i = 1; i <= dim; ++i) {
            p[i] = random_parabola(&r, dim);
            if (first_root(&p[i]) < end) {
                end = first_root(&p[i]);
                exit = i;
            }
        }
        set_walk(&w, dim, p, &r);
        iccp_flow_find_exit(&w);
        ck_assert_int_eq(w.exit, exit);
        const double steepness = exit > 0 ? 2 * p[exit].steep * sqrt(-p[exit].gap) : 1;
        ck_assert_double_le(fabs(w.end / w.scale - end), 1e-14 / steepness);
        n_within += exit == ICCP_FLOW_WITHIN;
        n_dips += exit > 0 && p[exit].least + sqrt(-p[exit].gap) < 1;
    }
    ck_assert_uint_ge(n_within, N / 10);
    ck_assert_uint_ge(n_dips, N / 10);
}
END_TEST

int main(void)
{
    Suite *suite = suite_create("flow_exit");
    TCase *tests = tcase_create("flow_exit");
    tcase_add_test(tests, the_first_root_is_the_exit);
    suite_add_tcase(suite, tests);
    return suite_run(suite);
}
