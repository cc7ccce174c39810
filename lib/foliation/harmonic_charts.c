/* Creates the charts of methods foliation and disc, for one domain or two. Both methods start with
 * harmonic maps to the disc. So this file also decides what a pair must share: how the boundaries
 * are cut, and where the maxima go. Source: docs/theory/charts-plane.md, "method foliation",
 * pairs. */
#include "foliation/harmonic_charts.h"

#include "base/error.h"
#include "base/threads.h"
#include "foliation/chart_disc.h"
#include "foliation/chart_foliation.h"

/* How many times a chart that cannot be certified is tried again, each time on a mesh with cells
 * half as large. */
enum { REFINEMENTS = 2 };

/* One or two domains on their way to harmonic charts. */
typedef struct harmonic_job {
    size_t n;
    const icc_domain *const *domain;
    const icc_chart_options *options;
    int32_t cells;
    uint32_t *pieces; /* of each facet; only while the meshes are made */
    double *turns;    /* of each boundary vertex; only while the images are made */
    iccp_harmonic base[2];
    double *image[2]; /* in the disc; only where needed */
    uint32_t centre[2];
    icc_chart **out;
} harmonic_job;

/* Adds to the message which of two domains caused the error. */
static icc_status blame(const harmonic_job *job, size_t k, icc_status status, icc_error *err)
{
    return job->n > 1 ? iccp_fail_side(err, status, (int32_t)k + 1) : status;
}

static icc_status make_base(void *argument, size_t k, const iccp_env *env, icc_error *err)
{
    harmonic_job *job = argument;
    const icc_status status =
        iccp_harmonic_create(&job->base[k], job->domain[k], job->pieces, job->cells, env, err);
    return status == ICC_OK ? ICC_OK : blame(job, k, status, err);
}

/* Creates the meshes of the domains. A pair cuts corresponding facets into the same number of
 * pieces, so that the boundary vertices correspond. */
static icc_status make_bases(harmonic_job *job, const iccp_env *env, icc_error *err)
{
    const icc_domain *other = job->n > 1 ? job->domain[1] : NULL;
    job->pieces = iccp_alloc(&env->memory, job->domain[0]->n_facets, sizeof *job->pieces);
    if (job->pieces == NULL)
        return ICC_ERR_MEMORY;
    iccp_planar_pieces(job->pieces, job->domain[0], other, job->cells);
    const icc_status status = iccp_side_by_side(env, job->n, make_base, job, err);
    iccp_free(&env->memory, job->pieces);
    return status;
}

static icc_status factorise(void *argument, size_t k, const iccp_env *env, icc_error *err)
{
    harmonic_job *job = argument;
    const icc_status status = iccp_harmonic_factorise(&job->base[k], env, err);
    return status == ICC_OK ? ICC_OK : blame(job, k, status, err);
}

static icc_status make_image(void *argument, size_t k, const iccp_env *env, icc_error *err)
{
    harmonic_job *job = argument;
    (void)err;
    job->image[k] = iccp_alloc(&env->memory, job->base[k].mesh.n_vertices, 2 * sizeof(double));
    return job->image[k] != NULL ? iccp_harmonic_disc(&job->base[k], job->turns, job->image[k], env)
                                 : ICC_ERR_MEMORY;
}

/* Has a factor only while it makes the image. */
static icc_status make_image_alone(void *argument, size_t k, const iccp_env *env, icc_error *err)
{
    harmonic_job *job = argument;
    iccp_env part[2];
    iccp_split(part, 2, (const double[]){4, 1}, env);
    icc_status status = factorise(job, k, &part[0], err);
    if (status == ICC_OK)
        status = make_image(job, k, &part[1], err);
    iccp_harmonic_drop_factor(&job->base[k]);
    return status;
}

/* Maps both meshes to one circle, by make_image() or make_image_alone(). Each boundary vertex goes
 * to the mean of its two arc-length parameters. */
static icc_status make_images(harmonic_job *job, iccp_side make, const iccp_env *env,
                              icc_error *err)
{
    job->turns = iccp_alloc_zero(&env->memory, job->base[0].mesh.n_boundary, sizeof *job->turns);
    if (job->turns == NULL)
        return ICC_ERR_MEMORY;
    for (size_t k = 0; k < job->n; ++k)
        iccp_add_arc_length(&job->base[k].mesh, 1.0 / (double)job->n, job->turns);
    const icc_status status = iccp_side_by_side(env, job->n, make, job, err);
    iccp_free(&env->memory, job->turns);
    return status;
}

static icc_status choose_given(harmonic_job *job, size_t k, icc_error *err)
{
    const double *maximum = job->options[k].maximum;
    const iccp_planar *mesh = &job->base[k].mesh;
    double local[2];
    iccp_frame_in(&job->domain[k]->frame, 2, maximum, local);
    if (iccp_domain_locate(job->domain[k], local, true, NULL, NULL) != ICC_INSIDE) {
        (void)iccp_fail(err, ICC_ERR_OUTSIDE, "the maximum (%g, %g) is not inside the domain",
                        maximum[0], maximum[1]);
        return blame(job, k, ICC_ERR_OUTSIDE, err);
    }
    job->centre[k] = iccp_nearest_vertex(mesh, mesh->points, local);
    return ICC_OK;
}

/* Chooses the maxima. The source's is the deepest vertex. The target's is the vertex nearest to
 * the image of the source's under the composed maps to the disc. If each domain chose for
 * itself, the maxima might lie in different limbs. */
static icc_status choose_centres(harmonic_job *job, const iccp_env *env, icc_error *err)
{
    icc_status status = ICC_OK;
    if (job->options[0].maximum != NULL)
        status = choose_given(job, 0, err);
    else
        job->centre[0] = iccp_deepest_vertex(&job->base[0].mesh, job->domain[0]);
    if (status != ICC_OK || job->n < 2)
        return status;
    if (job->options[1].maximum != NULL)
        return choose_given(job, 1, err);
    status = make_images(job, make_image, env, err);
    if (status == ICC_OK)
        job->centre[1] = iccp_nearest_vertex(&job->base[1].mesh, job->image[1],
                                             job->image[0] + 2 * (size_t)job->centre[0]);
    return status;
}

static icc_status finish(void *argument, size_t k, const iccp_env *env, icc_error *err)
{
    harmonic_job *job = argument;
    const icc_status status =
        job->options[0].method == ICC_METHOD_DISC
            ? iccp_chart_disc_create(&job->out[k], job->domain[k], &job->base[k], &job->image[k],
                                     env, err)
            : iccp_chart_foliation_create(&job->out[k], job->domain[k], &job->base[k],
                                          job->centre[k], env, err);
    iccp_harmonic_free(&job->base[k]);
    return status == ICC_OK ? ICC_OK : blame(job, k, status, err);
}

/* Method foliation needs the factors again, for the charts. */
static icc_status factorise_and_choose(harmonic_job *job, const iccp_env *env, icc_error *err)
{
    iccp_env part[2];
    iccp_split(part, 2, (const double[]){4, 1}, env);
    const icc_status status = iccp_side_by_side(&part[0], job->n, factorise, job, err);
    return status == ICC_OK ? choose_centres(job, &part[1], err) : status;
}

/* Tries one resolution: makes the meshes, then images in the disc (method disc) or centres (method
 * foliation), then the charts. If one chart fails, none is left. */
static icc_status try_harmonic(harmonic_job *job, const iccp_env *env, icc_error *err)
{
    iccp_env part[3];
    iccp_split(part, 3, (const double[]){3, 4, 2}, env);
    icc_status status = make_bases(job, &part[0], err);
    if (status == ICC_OK)
        status = job->options[0].method == ICC_METHOD_DISC
                     ? make_images(job, make_image_alone, &part[1], err)
                     : factorise_and_choose(job, &part[1], err);
    if (status == ICC_OK)
        status = iccp_side_by_side(&part[2], job->n, finish, job, err);
    for (size_t k = 0; k < job->n; ++k) {
        iccp_harmonic_free(&job->base[k]);
        iccp_free(&env->memory, job->image[k]);
        job->image[k] = NULL;
        if (status != ICC_OK) {
            iccp_chart_release(job->out[k]);
            job->out[k] = NULL;
        }
    }
    return status;
}

/* A certificate fails if the mesh is too coarse for the corners of the domain, so finer meshes
 * are tried. */
static icc_status create(harmonic_job *job, const iccp_env *env, icc_error *err)
{
    static const double COST[REFINEMENTS + 1] = {8, 1, 1};
    iccp_env part[REFINEMENTS + 1];
    iccp_split(part, REFINEMENTS + 1, COST, env);
    job->cells = job->options[0].cells;
    icc_status status = try_harmonic(job, &part[0], err);
    for (int k = 0;
         k < REFINEMENTS && status == ICC_ERR_CERTIFICATE && job->cells <= ICCP_MAX_CELLS / 2;
         ++k) {
        job->cells *= 2;
        iccp_log(env, "the chart cannot be certified: trying %ld cells", (long)job->cells);
        status = try_harmonic(job, &part[k + 1], err);
    }
    return iccp_explain(err, status);
}

icc_status iccp_harmonic_charts_create(size_t n, icc_chart **out, const icc_domain *const *domain,
                                       const icc_chart_options *options, const iccp_env *env,
                                       icc_error *err)
{
    harmonic_job job = {.n = n, .domain = domain, .options = options, .out = out};
    return create(&job, env, err);
}
