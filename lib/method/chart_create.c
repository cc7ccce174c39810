#include "method/chart_create.h"

#include "base/error.h"
#include "base/threads.h"
#include "domain/features.h"
#include "field/chart_field.h"
#include "field/pairing.h"
#include "foliation/chart_disc.h"
#include "foliation/chart_foliation.h"
#include "gradient/coordinates/chart_gradient.h"
#include "shelling/chart_shelling.h"

static const char CHART_DOMAIN[] = "the domain of a chart";

/* Replaces the defaults, 0, by what they stand for in this dimension, and refuses combinations
 * that no method offers. `has_mesh`: the domain has a mesh of its inside, and so has the other
 * domain of a pair. */
static icc_status complete_options(icc_chart_options *options, int32_t dim, bool has_mesh,
                                   icc_error *err)
{
    if (options->method == 0)
        options->method = dim == 2 || has_mesh ? ICC_METHOD_FOLIATION : ICC_METHOD_FIELD;
    const bool planar = (options->method == ICC_METHOD_FOLIATION && !has_mesh) ||
                        options->method == ICC_METHOD_DISC;
    if (options->function == 0)
        options->function = ICC_FUNCTION_DECAY;
    if (options->tree == 0)
        options->tree = ICC_TREE_THESIS;
    if (options->cells == 0 && planar)
        options->cells = 50;
    if (options->method < ICC_METHOD_GRADIENT || options->method > ICC_METHOD_DISC)
        return iccp_fail(err, ICC_ERR_UNSUPPORTED, "icc_chart_options.method %ld is not available",
                         (long)options->method);
    if (options->method == ICC_METHOD_FOLIATION && planar && dim > 2)
        return iccp_fail(err, ICC_ERR_UNSUPPORTED,
                         "method foliation needs a mesh of the inside in dimension %ld: make the "
                         "domain by %sicc_domain_create_mesh()",
                         (long)dim, dim == 3 ? "icc_domain_fill() or " : "");
    if (planar ? dim != 2 : dim < 2)
        return iccp_fail(err, ICC_ERR_UNSUPPORTED,
                         "method %ld is not available for domains of dimension %ld",
                         (long)options->method, (long)dim);
    return ICC_OK;
}

/* How often a chart that cannot be certified is tried again on a mesh with cells half as large. */
enum { REFINEMENTS = 2 };

/* One or two domains on their way to harmonic charts. */
typedef struct harmonic_job {
    size_t n;
    const icc_domain *const *domain;
    const icc_chart_options *options;
    int32_t cells;
    uint32_t *pieces; /* of each facet, while the meshes are made */
    double *turns;    /* of each boundary vertex, while the images are made */
    iccp_harmonic base[2];
    double *image[2]; /* in the disc; only where needed */
    uint32_t centre[2];
    icc_chart **out;
} harmonic_job;

/* Says which of two domains is at fault. */
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

/* The meshes of the domains and their equations. Domains of a pair cut corresponding facets into
 * the same number of pieces, so that their boundary vertices correspond. */
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

static icc_status make_image(void *argument, size_t k, const iccp_env *env, icc_error *err)
{
    harmonic_job *job = argument;
    (void)err;
    job->image[k] = iccp_alloc(&env->memory, job->base[k].mesh.n_vertices, 2 * sizeof(double));
    return job->image[k] != NULL ? iccp_harmonic_disc(&job->base[k], job->turns, job->image[k], env)
                                 : ICC_ERR_MEMORY;
}

/* Both meshes to one circle, each boundary vertex to the mean of its two arc-length parameters. */
static icc_status make_images(harmonic_job *job, const iccp_env *env)
{
    job->turns = iccp_alloc_zero(&env->memory, job->base[0].mesh.n_boundary, sizeof *job->turns);
    if (job->turns == NULL)
        return ICC_ERR_MEMORY;
    for (size_t k = 0; k < job->n; ++k)
        iccp_add_arc_length(&job->base[k].mesh, 1.0 / (double)job->n, job->turns);
    const icc_status status = iccp_side_by_side(env, job->n, make_image, job, NULL);
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

/* The source's maximum is the vertex deepest inside; the target's is the vertex nearest to where
 * the maps to the disc, composed, take it: left alone, the two may end in different limbs. */
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
    status = make_images(job, env);
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

/* One try at a resolution: meshes, then the images in the disc or the centres, then the charts.
 * All or nothing: if one fails, none is left. */
static icc_status try_harmonic(harmonic_job *job, const iccp_env *env, icc_error *err)
{
    iccp_env part[3];
    iccp_split(part, 3, (const double[]){6, 1, 2}, env);
    icc_status status = make_bases(job, &part[0], err);
    if (status == ICC_OK)
        status = job->options[0].method == ICC_METHOD_DISC ? make_images(job, &part[1])
                                                           : choose_centres(job, &part[1], err);
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

/* Certificates fail where a mesh is too coarse for its corners, so that finer ones are tried. */
static icc_status create_harmonic(harmonic_job *job, const iccp_env *env, icc_error *err)
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

/* The maximum is the caller's, if there is one, else `preferred`, which may be NULL. */
static icc_status create_field(icc_chart **out, const icc_domain *domain,
                               const icc_chart_options *options, const double *preferred,
                               const iccp_env *env, icc_error *err)
{
    double local[ICC_MAX_DIM];
    *out = NULL;
    if (options->maximum != NULL) {
        iccp_frame_in(&domain->frame, domain->dim, options->maximum, local);
        if (iccp_domain_locate(domain, local, true, NULL, NULL) != ICC_INSIDE)
            return iccp_fail(err, ICC_ERR_OUTSIDE, "the maximum is not inside the domain");
        preferred = local;
    }
    return iccp_explain(err, iccp_chart_field_create(out, domain, options, preferred, env, err));
}

/* Shifts the grids of unlucky charts if then all of them are certified; else they stay as they
 * are. */
static icc_status shift_grids(icc_chart **chart, int n, const iccp_env *env)
{
    icc_chart *shifted[2] = {NULL, NULL};
    icc_status status = ICC_OK;
    bool all = true;
    for (int k = 0; k < n; ++k)
        all = all && (chart[k]->info.certified || iccp_chart_field_is_unlucky(chart[k]));
    for (int k = 0; k < n && all && status == ICC_OK; ++k)
        if (!chart[k]->info.certified) {
            status = iccp_chart_field_shift(&shifted[k], chart[k], env);
            all = shifted[k] != NULL;
        }
    for (int k = 0; k < n; ++k)
        if (all && shifted[k] != NULL) {
            iccp_chart_release(chart[k]);
            chart[k] = shifted[k];
        } else {
            iccp_chart_release(shifted[k]);
        }
    return status;
}

/* The image of one chart's maximum in the other's domain; NULL if that is no good place for one. */
static const double *guess_maximum(const icc_chart *chart, const icc_domain *other, double *image)
{
    double local[ICC_MAX_DIM];
    iccp_frame_in(&chart->domain->frame, chart->domain->dim, chart->info.maximum, local);
    return iccp_pair_point(chart->domain, other, local, image) ? image : NULL;
}

/* The target's maximum is where the source's goes, about; where that is too near the boundary, the
 * other way round. Left alone, the two may end in different limbs. */
static icc_status create_field_pair(icc_chart *out[2], const icc_domain *const domain[2],
                                    const icc_chart_options options[2], const iccp_env *env,
                                    icc_error *err)
{
    double image[ICC_MAX_DIM];
    int32_t side = 1;
    iccp_env part[3];
    iccp_split(part, 3, (const double[]){4, 4, 1}, env);
    icc_status status = create_field(&out[0], domain[0], &options[0], NULL, &part[0], err);
    if (status == ICC_OK) {
        const double *preferred = guess_maximum(out[0], domain[1], image);
        side = 2;
        status = create_field(&out[1], domain[1], &options[1], preferred, &part[1], err);
        if (status == ICC_OK && preferred == NULL && options[0].maximum == NULL)
            preferred = guess_maximum(out[1], domain[0], image);
        else
            preferred = NULL;
        if (preferred != NULL) {
            iccp_chart_release(out[0]);
            side = 1;
            status = create_field(&out[0], domain[0], &options[0], preferred, &part[2], err);
        }
    }
    if (status == ICC_OK)
        status = iccp_explain(err, shift_grids(out, 2, env));
    if (status == ICC_OK)
        return ICC_OK;
    iccp_chart_release(out[0]);
    iccp_chart_release(out[1]);
    out[0] = out[1] = NULL;
    return iccp_fail_side(err, status, side);
}

static icc_status create(icc_chart **out, const icc_domain *domain,
                         const icc_chart_options *options, const iccp_env *env, icc_error *err)
{
    icc_chart_options full = *options;
    *out = NULL;
    const bool has_mesh = domain->mesh != NULL;
    icc_status status = iccp_features_refuse(domain, CHART_DOMAIN, err);
    if (status == ICC_OK)
        status = complete_options(&full, domain->dim, has_mesh, err);
    if (status != ICC_OK)
        return status;
    if (full.method == ICC_METHOD_GRADIENT)
        return iccp_explain(err, iccp_chart_gradient_create(out, domain, &full, env, err));
    if (full.method == ICC_METHOD_FIELD) {
        status = create_field(out, domain, &full, NULL, env, err);
        if (status == ICC_OK)
            status = iccp_explain(err, shift_grids(out, 1, env));
        if (status != ICC_OK) {
            iccp_chart_release(*out);
            *out = NULL;
        }
        return status;
    }
    if (full.method == ICC_METHOD_FOLIATION && has_mesh)
        return iccp_chart_shelling_create(1, out, &domain, &full, env, err);
    harmonic_job job = {.n = 1, .domain = &domain, .options = &full, .out = out};
    return create_harmonic(&job, env, err);
}

icc_status iccp_chart_create(icc_chart **out, const icc_domain *domain,
                             const icc_chart_options *options, const iccp_env *env, icc_error *err)
{
    iccp_team team;
    iccp_env with;
    iccp_with_team(&with, &team, env);
    const icc_status status = create(out, domain, options, &with, err);
    iccp_without_team(&with, env);
    return status;
}

typedef struct gradient_job {
    icc_chart **out;
    const icc_domain *const *domain;
    const icc_chart_options *options;
} gradient_job;

static icc_status create_gradient(void *argument, size_t k, const iccp_env *env, icc_error *err)
{
    const gradient_job *job = argument;
    const icc_status status = iccp_explain(
        err, iccp_chart_gradient_create(&job->out[k], job->domain[k], &job->options[k], env, err));
    if (status != ICC_OK)
        job->out[k] = NULL;
    return status == ICC_OK ? ICC_OK : iccp_fail_side(err, status, (int32_t)k + 1);
}

static icc_status create_gradient_pair(icc_chart *out[2], const icc_domain *const domain[2],
                                       const icc_chart_options options[2], const iccp_env *env,
                                       icc_error *err)
{
    gradient_job job = {out, domain, options};
    const icc_status status = iccp_side_by_side(env, 2, create_gradient, &job, err);
    for (size_t k = 0; status != ICC_OK && k < 2; ++k) {
        iccp_chart_release(out[k]);
        out[k] = NULL;
    }
    return status;
}

icc_status iccp_chart_create_pair(icc_chart *out[2], const icc_domain *const domain[2],
                                  const icc_chart_options options[2], const iccp_env *env,
                                  icc_error *err)
{
    icc_chart_options full[2] = {options[0], options[1]};
    out[0] = out[1] = NULL;
    const bool has_mesh = domain[0]->mesh != NULL && domain[1]->mesh != NULL;
    icc_status status;
    for (int32_t k = 0; k < 2; ++k) {
        status = iccp_features_refuse(domain[k], CHART_DOMAIN, err);
        if (status != ICC_OK)
            return iccp_fail_side(err, status, k + 1);
    }
    status = complete_options(&full[0], domain[0]->dim, has_mesh, err);
    if (status == ICC_OK)
        status = complete_options(&full[1], domain[1]->dim, has_mesh, err);
    if (status != ICC_OK)
        return status;
    if (full[0].method == ICC_METHOD_GRADIENT)
        return create_gradient_pair(out, domain, full, env, err);
    if (full[0].method == ICC_METHOD_FIELD)
        return create_field_pair(out, domain, full, env, err);
    if (full[0].method == ICC_METHOD_FOLIATION && has_mesh)
        return iccp_chart_shelling_create(2, out, domain, full, env, err);
    harmonic_job job = {.n = 2, .domain = domain, .options = full, .out = out};
    return create_harmonic(&job, env, err);
}
