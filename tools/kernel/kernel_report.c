/* The report of `weights` and `pose`. */
#include "job/option_table.h"
#include "kernel/kernel_job.h"

static void report_sampling(json *out, const kernel_job *k)
{
    icc_sampling_info info = {.size = sizeof info};
    icc_sampling_get_info(k->sampling, &info);
    json_open(out, "sampling", '{');
    json_text(out, "kind", choice_name(samplings, info.kind));
    json_count(out, "samples", info.n_samples);
    json_count(out, "on_edges", info.n_edge);
    json_number(out, "spacing", info.spacing);
    json_number(out, "nearest", info.nearest);
    json_close(out, '}');
}

static void report_kernel(json *out, const icc_weights_info *info)
{
    json_open(out, "kernel", '{');
    json_text(out, "kind", choice_name(kernels, info->kernel));
    json_number(out, "sigma", info->sigma);
    json_count(out, "handles", info->n_handles);
    json_count(out, "nodes", info->n_nodes);
    json_count(out, "infeasible", info->n_infeasible);
    json_number(out, "definiteness", info->definiteness);
    json_text(out, "weights", choice_name(weightings, info->method));
    json_text(out, "initial", choice_name(initials, info->initial));
    json_close(out, '}');
}

static int report_quality(json *out, kernel_job *k, size_t n, const double *points)
{
    icc_weights_report q = {.size = sizeof q};
    icc_error err = {.size = sizeof err, .index = -1};
    if (icc_weights_get_report(k->weights, n, points, &q, &k->job.env, &err) != ICC_OK)
        return job_failed(&k->job, &err);
    json_open(out, "quality", '{');
    json_count(out, "points", n);
    json_number(out, "unity", q.unity);
    json_number(out, "reproduction", q.reproduction);
    json_number(out, "reproduction_mean", q.reproduction_mean);
    json_number(out, "lagrange", q.lagrange);
    json_number(out, "linearity", q.linearity);
    json_number(out, "least_weight", q.least_weight);
    json_count(out, "negative", q.n_negative);
    json_close(out, '}');
    return DONE;
}

static void report_seconds(json *out, const kernel_job *k)
{
    icc_weights_timings made = {.size = sizeof made};
    icc_weights_get_timings(k->weights, &made);
    json_open(out, "seconds", '{');
    json_number(out, "read", k->job.seconds_read);
    json_number(out, "samples", k->seconds_samples);
    json_number(out, "make", k->seconds_weights);
    json_number(out, "initial", made.initial);
    json_number(out, "weights", made.optimise);
    json_number(out, "factor", made.factor);
    if (k->set.n_rigid > 0)
        json_number(out, "rigid", k->seconds_rigid);
    json_close(out, '}');
}

int kernel_report_open(report *r, kernel_job *k, size_t n, const double *points)
{
    icc_weights_info info = {.size = sizeof info};
    icc_weights_get_info(k->weights, &info);
    if (!report_open(r, &k->job))
        return FAILED;
    report_sampling(&r->json, k);
    report_kernel(&r->json, &info);
    if (k->set.n_rigid > 0) {
        json_open(&r->json, "rigid_energy", '[');
        json_number(&r->json, NULL, k->energy[0]);
        json_number(&r->json, NULL, k->energy[1]);
        json_close(&r->json, ']');
    }
    report_seconds(&r->json, k);
    int result = report_quality(&r->json, k, n, points);
    if (result != DONE)
        outfile_abandon(&r->file);
    return result;
}
