/* Failing allocations, cancelled calls and several threads: no leak, no other bit. */
#include "../../../faulty.h"
#include "../../../handle_fixtures.h"
#include "../../../share.h"
#include "../../../suite.h"

#include <string.h>

/* Everything that may fail, on few nodes. */
typedef struct everything {
    icc_sampling *sampling;
    icc_weights *weights;
    double *points;
    unsigned char *data;
    size_t n_bytes;
} everything;

enum { N_PLACES = 700 };
static const icc_line LINES[2] = {{.from = {0.2, 0.2}, .to = {0.6, 0.2}},
                                  {.from = {0.6, 0.2}, .to = {0.6, 0.6}}};

static everything make_everything(double spacing)
{
    everything e = {.sampling = sample_square(spacing), .points = random_places(2, N_PLACES)};
    const icc_weights_options options = {
        .size = sizeof options, .n_edges = 4, .edges = RING, .n_lines = 2, .lines = LINES};
    e.weights = make(e.sampling, 5, HANDLES, &options);
    icc_binding *binding;
    ck_assert_int_eq(icc_binding_create(&binding, e.weights, 5, e.points, 1, NULL, NULL), ICC_OK);
    e.data = save(binding, &e.n_bytes);
    icc_binding_free(binding);
    return e;
}

static void clear_everything(everything *e)
{
    icc_weights_free(e->weights);
    icc_sampling_free(e->sampling);
    free(e->points);
    free(e->data);
}

/* Weights at all places; frees the kernel. */
static icc_status look(icc_status status, icc_weights *weights, const everything *e, double *out)
{
    ck_assert_int_eq(status == ICC_OK, weights != NULL);
    if (status == ICC_OK && out != NULL)
        ck_assert_int_eq(
            icc_weights_evaluate(weights, N_PLACES, e->points, out, NULL, NULL, NULL, NULL),
            ICC_OK);
    icc_weights_free(weights);
    return status;
}

/* Call `which` of what there is; `out` has room for 15 numbers a place, or is NULL. */
static icc_status run(int which, const everything *e, double *out, const icc_env *env,
                      icc_error *err)
{
    static const uint32_t NODES[3] = {25, 26, 27};
    static const double WISHES[15] = {1, 0, 0, 0, 0, 0, 0, 0, 1, 0, 0, 1}, CENTRE[2] = {0.4, 0.4};
    icc_weights_options options = {.size = sizeof options,
                                   .initial = which == 1 ? ICC_INITIAL_INVERSE : 0,
                                   .method = which == 1   ? ICC_WEIGHTS_L1
                                             : which == 2 ? ICC_WEIGHTS_BIHARMONIC
                                                          : 0,
                                   .n_edges = which == 2 ? 4 : 0,
                                   .edges = RING,
                                   .n_lines = 2,
                                   .lines = LINES};
    icc_weights *weights = (icc_weights *)&weights;
    icc_status status = -1;
    if (which < 3)
        status = icc_weights_create(&weights, e->sampling, 5, HANDLES, &options, env, err);
    if (which == 3)
        status = icc_weights_paint(&weights, e->weights, 1, CENTRE, 0.3, 0.5, env, err);
    if (which == 4)
        status = icc_weights_repaint(&weights, e->weights, 3, NODES, WISHES, env, err);
    if (which == 5)
        status = icc_weights_with_method(&weights, e->weights, ICC_WEIGHTS_L1, env, err);
    if (which == 6)
        status = icc_weights_stiffen(&weights, e->weights, 3, NODES, NULL, NULL, env, err);
    if (which < 7)
        return look(status, weights, e, out);
    if (which == 7) {
        icc_weights_report report = {.size = sizeof report};
        status = icc_weights_get_report(e->weights, N_PLACES, e->points, &report, env, err);
        if (out != NULL)
            memcpy(out, &report, sizeof report);
        return status;
    }
    icc_binding *binding = (icc_binding *)&binding;
    status = which == 8 ? icc_binding_create(&binding, e->weights, N_PLACES, e->points, 1, env, err)
                        : icc_binding_load(&binding, e->n_bytes, e->data, env, err);
    ck_assert_int_eq(status == ICC_OK, binding != NULL);
    if (status == ICC_OK && out != NULL) {
        double transforms[30];
        random_source r = {2};
        random_transforms(2, 5, transforms, &r);
        status = icc_binding_pose(binding, transforms, out, out + 2 * N_PLACES, env);
    }
    icc_binding_free(binding);
    return status;
}

enum { N_CALLS = 10 };

typedef struct fault {
    const everything *e;
    int which;
} fault;

static icc_status fail_once(const icc_env *env, icc_error *err, void *argument)
{
    const fault *f = argument;
    return run(f->which, f->e, NULL, env, err);
}

/* Loading does not report progress: only its allocations can fail. */
START_TEST(failures_are_reported_and_nothing_is_left)
{
    everything e = make_everything(0.2);
    for (int which = 0; which < N_CALLS - 1; ++which)
        faulty_sweep(fail_once, &(fault){&e, which});
    icc_status status = ICC_ERR_MEMORY;
    for (size_t k = 1; status != ICC_OK; k = share_next(k)) {
        faulty f = {.fail_at = k};
        const icc_env env = faulty_env(&f);
        status = run(N_CALLS - 1, &e, NULL, &env, NULL);
        ck_assert(f.n_live == 0 && (status == ICC_OK || status == ICC_ERR_MEMORY));
        ck_assert(status != ICC_OK || k > 3);
    }
    clear_everything(&e);
}
END_TEST

START_TEST(threads_change_no_bit)
{
    everything e = make_everything(0.02);
    double *one = allocate(15 * N_PLACES, sizeof *one),
           *many = allocate(15 * N_PLACES, sizeof *many);
    for (int which = 0; which < N_CALLS; ++which) {
        memset(one, 0, 15 * N_PLACES * sizeof *one);
        ck_assert_int_eq(run(which, &e, one, NULL, NULL), ICC_OK);
        for (int32_t n = 2; n < 6; n += 3) {
            const icc_env env = {.size = sizeof env, .threads = n};
            memset(many, 0, 15 * N_PLACES * sizeof *many);
            ck_assert_int_eq(run(which, &e, many, &env, NULL), ICC_OK);
            ck_assert_msg(memcmp(one, many, 15 * N_PLACES * sizeof *one) == 0,
                          "call %d, %d threads", which, (int)n);
        }
    }
    free(one);
    free(many);
    clear_everything(&e);
}
END_TEST

int main(void)
{
    Suite *suite = suite_create("weights_failures");
    TCase *tests = tcase_create("weights_failures");
    tcase_add_test(tests, failures_are_reported_and_nothing_is_left);
    tcase_add_test(tests, threads_change_no_bit);
    suite_add_tcase(suite, tests);
    return suite_run(suite);
}
