/* Makes samplings and weights as the options and the handles' file ask. */
#include "kernel/kernel_job.h"

#include "base/allocate.h"
#include "base/system.h"
#include "kernel/linear_edges.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

void kernel_job_start(kernel_job *k, const args *a)
{
    *k = (kernel_job){.energy = {0, 0}};
    job_start(&k->job, a);
}

void kernel_job_end(kernel_job *k)
{
    icc_weights_free(k->weights);
    icc_sampling_free(k->sampling);
    for (size_t i = 0; k->regions != NULL && i < k->set.n_regions; i++)
        icc_domain_free(k->regions[i]);
    free(k->regions);
    handle_set_free(&k->set);
    job_end(&k->job);
}

/* Reports the library's message about an entry of the handles' file. `what` names the entry if the
 * message does not. */
static int failed_set(kernel_job *k, const char *what, const icc_error *err)
{
    progress_end(&k->job.bar);
    return failed(k->job.args->handles, 0, "%s%s%s", what, *what != '\0' ? ": " : "",
                  job_message(err));
}

static int read_set(kernel_job *k)
{
    const char *name = k->job.args->handles;
    size_t n;
    char *text = file_read(name, &n);
    if (text == NULL)
        return FAILED;
    problem wrong;
    bool good = handle_set_read(&k->set, text, n, &wrong);
    free(text);
    return good ? DONE : failed(name, wrong.line, "%s", wrong.text);
}

/* The source may be missing if the handles' file has a shape. */
static int read_shape(kernel_job *k)
{
    const handle_set *set = &k->set;
    job *j = &k->job;
    if (j->args->source == NULL && set->n_regions + set->n_segments == 0)
        return misused(j->args->command,
                       "--source FILE is missing, and the handles' file has no regions or curves");
    if (j->args->source != NULL) {
        int result = job_make_domains(j);
        if (result != DONE)
            return result;
        if (j->cages[0].n_features > 0)
            return failed(
                j->args->source, 0,
                "there are holes, lines or points inside; weights and poses need a shape without");
        if (job_dim(j) != set->dim)
            return failed(j->args->handles, 0, "the handles have %zu coordinates, but the cage %zu",
                          set->dim, job_dim(j));
    }
    k->regions = need(set->n_regions, sizeof(icc_domain *));
    for (size_t i = 0; i < set->n_regions; i++) {
        char what[48];
        icc_error err = {.size = sizeof err, .index = -1};
        const outline *region = &set->regions[i];
        snprintf(what, sizeof what, "regions[%zu]", i);
        if (icc_domain_create(&k->regions[i], 2, region->n, region->points, 0, NULL, &j->env,
                              &err) != ICC_OK)
            return failed_set(k, what, &err);
    }
    return DONE;
}

/* Spreads samples over the regions of --source and of the handles' file together. Errors name the
 * file of --source if it is the only one, otherwise the handles' file. */
static int make_samples(kernel_job *k)
{
    const handle_set *set = &k->set;
    const args *a = k->job.args;
    size_t n_source = k->job.domains[0] != NULL, n_regions = n_source + set->n_regions;
    const icc_domain **regions = need(n_regions, sizeof *regions);
    if (n_source > 0)
        regions[0] = k->job.domains[0];
    for (size_t i = 0; i < set->n_regions; i++)
        regions[n_source + i] = k->regions[i];
    icc_error err = {.size = sizeof err, .index = -1};
    icc_shape *shape;
    icc_status status =
        icc_shape_create(&shape, (int32_t)set->dim, n_regions, regions, set->n_vertices,
                         set->vertices, set->n_segments, set->segments, &k->job.env, &err);
    icc_sampling_options spread = {.size = sizeof spread,
                                   .kind = a->sampling,
                                   .spacing = k->job.args->spacing,
                                   .seed = (uint64_t)a->seed};
    double began = seconds_now();
    progress_expect(&k->job.bar, 0.3);
    if (status == ICC_OK)
        status = icc_sampling_create(&k->sampling, shape, &spread, &k->job.env, &err);
    k->seconds_samples = seconds_now() - began;
    icc_shape_free(shape);
    free(regions);
    if (status == ICC_OK)
        return DONE;
    return n_source == n_regions && set->n_segments == 0 ? job_failed(&k->job, &err)
                                                         : failed_set(k, "", &err);
}

/* Makes weights with the options of the command line. --thesis follows the thesis where that
 * differs from the library's defaults. */
static int make_weights(kernel_job *k)
{
    const handle_set *set = &k->set;
    const args *a = k->job.args;
    icc_weights_options how = {.size = sizeof how,
                               .kernel = a->kernel,
                               .initial = a->initial,
                               .method = a->weights,
                               .steps = a->steps,
                               .sigma = a->sigma,
                               .n_edges = set->n_edges,
                               .edges = set->edges,
                               .n_lines = set->n_lines,
                               .lines = set->lines};
    if (a->thesis) {
        how.kernel = a->kernel != 0 ? a->kernel : ICC_KERNEL_GAUSS;
        how.affine_tail = -1;
        how.within_shape = -1;
    }
    icc_error err = {.size = sizeof err, .index = -1};
    double began = seconds_now();
    progress_expect(&k->job.bar, 0.8);
    icc_status status = icc_weights_create(&k->weights, k->sampling, set->n_handles, set->handles,
                                           &how, &k->job.env, &err);
    k->seconds_weights = seconds_now() - began;
    return status == ICC_OK ? DONE : failed_set(k, "", &err);
}

static int make_edges_linear(kernel_job *k)
{
    icc_weights *linear;
    icc_error err = {.size = sizeof err, .index = -1};
    if (linear_edges_make(&linear, k->weights, &k->set, &k->job.env, &err) != ICC_OK)
        return failed_set(k, "linear_edges", &err);
    if (linear == NULL)
        return failed(k->job.args->handles, 0, "linear_edges: no sample lies on an edge");
    icc_weights_free(k->weights);
    k->weights = linear;
    return DONE;
}

/* True if a node lies in a ball. */
static bool in_ball(const kernel_job *k, const double *node, const double *centre, double radius)
{
    double squared = 0;
    for (size_t c = 0; c < k->set.dim; c++)
        squared += pow(node[c] - centre[c], 2);
    return squared <= radius * radius;
}

/* All nodes within a stroke get its weights as a start, and are optimised again. */
static icc_status repaint(icc_weights **out, kernel_job *k, const stroke *by, size_t n,
                          const uint32_t *nodes, icc_error *err)
{
    const size_t m = k->set.n_handles;
    double *values = need(n, m * sizeof *values);
    for (size_t i = 0; i < n; i++)
        memcpy(values + m * i, by->weights, m * sizeof *values);
    icc_status status = icc_weights_repaint(out, k->weights, n, nodes, values, &k->job.env, err);
    free(values);
    return status;
}

/* Replaces the weights by painted ones, one stroke after the other. */
static int paint(kernel_job *k)
{
    icc_weights_info info = {.size = sizeof info};
    icc_weights_get_info(k->weights, &info);
    double *nodes = need(info.n_nodes, k->set.dim * sizeof *nodes);
    uint32_t *inside = need(info.n_nodes, sizeof *inside);
    icc_weights_get_nodes(k->weights, nodes, NULL, NULL, NULL);
    int result = DONE;
    for (size_t s = 0; s < k->set.n_strokes && result == DONE; s++) {
        const stroke *by = &k->set.strokes[s];
        icc_weights *painted = NULL;
        icc_error err = {.size = sizeof err, .index = -1};
        size_t n = 0;
        char what[48];
        snprintf(what, sizeof what, "paint[%zu]", s);
        for (size_t i = 0; i < info.n_nodes; i++)
            if (in_ball(k, nodes + k->set.dim * i, by->centre, by->radius))
                inside[n++] = (uint32_t)i;
        if (n == 0)
            result = failed(k->job.args->handles, 0, "%s holds no sample", what);
        else if ((by->weights != NULL
                      ? repaint(&painted, k, by, n, inside, &err)
                      : icc_weights_paint(&painted, k->weights, by->handle, by->centre, by->radius,
                                          by->amount, &k->job.env, &err)) != ICC_OK)
            result = failed_set(k, what, &err);
        if (result != DONE)
            break;
        icc_weights_free(k->weights);
        k->weights = painted;
    }
    free(nodes);
    free(inside);
    return result;
}

/* Marks which of n nodes a rigid part contains. */
static icc_status find_part(const kernel_job *k, const rigid_part *part, size_t n,
                            const double *nodes, bool *inside, icc_error *err)
{
    for (size_t i = 0; part->region.n == 0 && i < n; i++)
        inside[i] = in_ball(k, nodes + k->set.dim * i, part->centre, part->radius);
    if (part->region.n == 0)
        return ICC_OK;
    icc_domain *domain;
    int32_t *where = need(n, sizeof *where);
    icc_status status = icc_domain_create(&domain, 2, part->region.n, part->region.points, 0, NULL,
                                          &k->job.env, err);
    if (status == ICC_OK)
        status = icc_domain_locate(domain, n, nodes, where, NULL, NULL, &k->job.env);
    for (size_t i = 0; status == ICC_OK && i < n; i++)
        inside[i] = where[i] != ICC_OUTSIDE;
    icc_domain_free(domain);
    free(where);
    return status;
}

/* Finds the rigidity of each node. It is 0 in no part, and the greatest one in several parts. */
static int find_rigidity(kernel_job *k, size_t n, const double *nodes, double *rigidity)
{
    bool *inside = need(n, sizeof *inside);
    int result = DONE;
    for (size_t p = 0; p < k->set.n_rigid && result == DONE; p++) {
        const rigid_part *part = &k->set.rigid[p];
        icc_error err = {.size = sizeof err, .index = -1};
        size_t n_inside = 0;
        char what[48];
        snprintf(what, sizeof what, "rigid[%zu]", p);
        err.status = find_part(k, part, n, nodes, inside, &err);
        for (size_t i = 0; err.status == ICC_OK && i < n; i++) {
            n_inside += inside[i];
            if (inside[i])
                rigidity[i] = fmax(rigidity[i], part->rigidity);
        }
        if (err.status != ICC_OK)
            result = failed_set(k, what, &err);
        else if (n_inside == 0)
            result = failed(k->job.args->handles, 0, "%s holds no sample", what);
    }
    free(inside);
    return result;
}

/* Replaces the weights by stiffened ones. `rigidity` has the values of n nodes, then those of the
 * n_stiff nodes in `stiff`. */
static int stiffen(kernel_job *k)
{
    icc_weights_info info = {.size = sizeof info};
    icc_weights_get_info(k->weights, &info);
    size_t n = info.n_nodes, n_stiff = 0;
    double *nodes = need(n, k->set.dim * sizeof *nodes), *rigidity = need(n, sizeof *rigidity);
    uint32_t *stiff = need(n, sizeof *stiff);
    icc_weights_get_nodes(k->weights, nodes, NULL, NULL, NULL);
    double began = seconds_now();
    int result = find_rigidity(k, n, nodes, rigidity);
    for (size_t i = 0; i < n; i++)
        if (rigidity[i] > 0) {
            rigidity[n_stiff] = rigidity[i];
            stiff[n_stiff++] = (uint32_t)i;
        }
    icc_weights *stiffened = NULL;
    icc_error err = {.size = sizeof err, .index = -1};
    if (result == DONE && icc_weights_stiffen(&stiffened, k->weights, n_stiff, stiff, rigidity,
                                              k->energy, &k->job.env, &err) != ICC_OK)
        result = failed_set(k, "rigid", &err);
    if (result == DONE) {
        icc_weights_free(k->weights);
        k->weights = stiffened;
    }
    k->seconds_rigid = seconds_now() - began;
    free(nodes);
    free(rigidity);
    free(stiff);
    return result;
}

int kernel_job_read(kernel_job *k)
{
    int result = read_set(k);
    if (result == DONE)
        result = read_shape(k);
    k->job.seconds_read = seconds_now() - k->job.started;
    return result;
}

int kernel_job_make(kernel_job *k)
{
    int result = make_samples(k);
    if (result == DONE)
        result = make_weights(k);
    if (result == DONE && k->set.linear_edges)
        result = make_edges_linear(k);
    if (result == DONE)
        result = paint(k);
    if (result == DONE && k->set.n_rigid > 0)
        result = stiffen(k);
    progress_end(&k->job.bar);
    return result;
}
