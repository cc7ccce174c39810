/* Finds the defects of the cages given to `libicc check`. */
#include "report/check_job.h"

bool check_is_alone(const check *c)
{
    const cage *source = &c->job.cages[0];
    return c->job.args->target == NULL &&
           (source->cells != NULL || source->of_picture || job_dim(&c->job) == 3);
}

bool check_domain_only(const check *c)
{
    const args *a = c->job.args;
    bool asks_for_chart = a->method != 0 || a->mesh != NULL || a->n_maximum > 0;
    return check_is_alone(c) && (c->job.cages[0].cells != NULL || !asks_for_chart);
}

int check_find_defects(check *c)
{
    c->n_defects = 0;
    for (size_t side = 0; side < 2; side++) {
        icc_error err = {.size = sizeof err, .index = -1, .side = (int32_t)side + 1};
        defects_free(&c->defects[side]);
        const cage *at = &c->job.cages[side];
        if (at->dim != 2 || at->cells != NULL || at->n == 0)
            continue;
        if (defects_find(&c->defects[side], &c->job.cages[side], 0, NULL, &c->job.env, &err) !=
            ICC_OK)
            return job_failed(&c->job, &err);
        c->n_defects += c->defects[side].n;
    }
    progress_end(&c->job.bar);
    return DONE;
}
