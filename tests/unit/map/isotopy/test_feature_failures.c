/* Maps of domains with features without memory, and without patience: made, with ties and without,
 * improved, followed and loaded; nothing is left behind, and nothing is wrong. */
#include "../../../faulty.h"
#include "../../../feature_pairs.h"
#include "../../../saved.h"
#include "../../../suite.h"

#include "map/map.h"

typedef struct setting {
    icc_domain *source, *target, *further;
    icc_map *map;
    icc_tie ties[PLAN_FEATURES];
    double *bends[PLAN_FEATURES];
    size_t n_ties;
    bytes saved;
    int32_t iterations;
} setting;

static void begin(setting *s, int k, int32_t iterations)
{
    plan source, target;
    icc_map_info info = {.size = sizeof info};
    const icc_map_options options = {.size = sizeof options, .iterations = iterations};
    plans_number(k, &source, &target);
    *s = (setting){
        .source = plan_domain(&source), .target = plan_domain(&target), .iterations = iterations};
    target.xy[2 * target.n_outer] += 0.05 * (target.xy[2] - target.xy[0]);
    s->further = plan_domain(&target);
    ck_assert_int_eq(icc_map_create(&s->map, s->source, s->target, &options, NULL, NULL), ICC_OK);
    ck_assert_int_eq(icc_map_get_info(s->map, &info), ICC_OK);
    ck_assert(info.class_kept == 1 && info.n_ties <= PLAN_FEATURES);
    s->n_ties = info.n_ties;
    for (size_t i = 0; i < info.n_ties; ++i) {
        icc_tie_info tie = {.size = sizeof tie};
        ck_assert_int_eq(icc_map_get_tie(s->map, i, &tie, NULL, NULL), ICC_OK);
        s->bends[i] = saved_alloc(2 * tie.n_target * sizeof(double));
        ck_assert_int_eq(icc_map_get_tie(s->map, i, &tie, NULL, s->bends[i]), ICC_OK);
        s->ties[i] = (icc_tie){.size = sizeof(icc_tie),
                               .vertex = {tie.vertex[0], tie.vertex[1]},
                               .n_target = tie.n_target,
                               .target = s->bends[i]};
    }
    s->saved = map_bytes(s->map);
}

static void end(setting *s)
{
    for (size_t i = 0; i < s->n_ties; ++i)
        free(s->bends[i]);
    free(s->saved.data);
    icc_map_free(s->map);
    icc_domain_free(s->source);
    icc_domain_free(s->target);
    icc_domain_free(s->further);
}

/* A map that is made must be whole, although something that it could do without was refused. */
static icc_status check(icc_map *map, icc_status status)
{
    icc_map_info info = {.size = sizeof info};
    ck_assert((map != NULL) == (status == ICC_OK));
    if (map != NULL) {
        ck_assert_int_eq(icc_map_get_info(map, &info), ICC_OK);
        ck_assert(info.certified == 1 && info.class_kept == 1 && info.n_ties > 0);
    }
    icc_map_free(map);
    return status;
}

static icc_status create(const icc_env *env, icc_error *err, void *argument)
{
    const setting *s = argument;
    const icc_map_options options = {.size = sizeof options, .iterations = s->iterations};
    icc_map *map;
    const icc_status status = icc_map_create(&map, s->source, s->target, &options, env, err);
    return check(map, status);
}

static icc_status create_tied(const icc_env *env, icc_error *err, void *argument)
{
    const setting *s = argument;
    const icc_map_options options = {
        .size = sizeof options, .iterations = s->iterations, .n_ties = s->n_ties, .ties = s->ties};
    icc_map *map;
    const icc_status status = icc_map_create(&map, s->source, s->target, &options, env, err);
    return check(map, status);
}

static icc_status retarget(const icc_env *env, icc_error *err, void *argument)
{
    const setting *s = argument;
    icc_map *map;
    const icc_status status = icc_map_retarget(
        &map, s->map, s->further,
        &(icc_retarget_options){.size = sizeof(icc_retarget_options), .iterations = s->iterations},
        env, err);
    return check(map, status);
}

static icc_status load(const icc_env *env, icc_error *err, void *argument)
{
    const setting *s = argument;
    icc_map *map;
    const icc_status status = icc_map_load(&map, s->saved.n, s->saved.data, env, err);
    return check(map, status);
}

/* Cancelled, an improvement keeps what there is. */
static icc_status improve(const icc_env *env, icc_error *err, void *argument)
{
    const setting *s = argument;
    const icc_improve_options options = {.size = sizeof options, .iterations = 2, .levels = 1};
    icc_improve_report report = {.size = sizeof report};
    icc_map *map;
    const icc_status status = icc_map_improve(&map, s->map, &options, &report, env, err);
    (void)check(map, status);
    return status == ICC_OK && report.cancelled ? ICC_ERR_CANCELLED : status;
}

static void improve_without_memory(void *argument)
{
    icc_status status = ICC_ERR_MEMORY;
    for (size_t k = 1; status != ICC_OK; k = share_next(k)) {
        faulty f = {.fail_at = k};
        icc_error err = {.size = sizeof err};
        const icc_env env = faulty_env(&f);
        status = improve(&env, &err, argument);
        ck_assert(status == ICC_OK || status == ICC_ERR_MEMORY);
        ck_assert_uint_eq(f.n_live, 0);
    }
}

START_TEST(failures)
{
    static const int PLANS[] = {0, 1, 4};
    for (size_t k = 0; k < sizeof PLANS / sizeof *PLANS; ++k) {
        setting s;
        begin(&s, PLANS[k], k == 0 ? 2 : -1);
        faulty_sweep(create, &s);
        faulty_sweep(create_tied, &s);
        faulty_sweep(retarget, &s);
        faulty_sweep(load, &s);
        improve_without_memory(&s);
        end(&s);
    }
}
END_TEST

int main(void)
{
    Suite *suite = suite_create("feature failures");
    TCase *c = tcase_create("feature failures");
    tcase_add_test(c, failures);
    suite_add_tcase(suite, c);
    return suite_run(suite);
}
