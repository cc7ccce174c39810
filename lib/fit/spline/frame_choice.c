/* Tries margins, and smoothings for each of them, on coarse meshes. The sum of squared residuals
 * left out decides: see iccp_spline_system_leave_out(). Global distortions, as those of an old map,
 * want the frame near; local ones want it far away. */
#include "fit/spline/frame_choice.h"

#include "base/random.h"
#include "fit/spline/frame_mesh.h"

#include <math.h>
#include <string.h>

/* The margins to choose from. The far frame is nearly a thin plate. A margin of 0.3 between them
 * was never better than both on ten families of distortions. */
static const double FAR = 1, NEAR = 0.05;

/* The near frame needs a score of at most this share of the far one's, because few points tell its
 * root mean square to some 15 % only. Measured on ten families of distortions with 6 to 300 points,
 * five samples of each, the error is then at most 1.2 times a thin plate's, in the mean 0.91. */
static const double ADVANTAGE = 0.72;

/* Cells across the box. */
enum { ACROSS = 16 };

/* Smoothings to choose from: 1 over powers of ten, from the first. It is as good as exact. */
static const double LEAST_SMOOTHING = 1e-8;
enum { N_SMOOTHINGS = 9 };

/* Most points that decide. */
enum { MOST_SAMPLED = 100 };

/* A sample of the points, and the best frame so far. */
typedef struct choice {
    const iccp_frame_question *question;
    const iccp_memory *memory;
    iccp_frame_region region;
    double *points, *values, *share, *weight, *left_out; /* of the sample */
    uint32_t *vertex;                                    /* vertices of the sample */
    double *u;                                           /* of all vertices */
    bool has_weights;
    double score, margin, smoothing; /* the best; margin 0: none yet */
} choice;

static void free_choice(choice *c)
{
    iccp_free(c->memory, c->region.spacing);
    iccp_free(c->memory, c->points);
    iccp_free(c->memory, c->values);
    iccp_free(c->memory, c->share);
    iccp_free(c->memory, c->weight);
    iccp_free(c->memory, c->left_out);
    iccp_free(c->memory, c->vertex);
}

static icc_status make_room(choice *c, size_t n)
{
    c->points = iccp_alloc(c->memory, n, 2 * sizeof *c->points);
    c->values = iccp_alloc(c->memory, n, 2 * sizeof *c->values);
    c->share = iccp_alloc(c->memory, n, sizeof *c->share);
    c->weight = iccp_alloc_zero(c->memory, n, sizeof *c->weight);
    c->left_out = iccp_alloc(c->memory, n, 2 * sizeof *c->left_out);
    c->vertex = iccp_alloc(c->memory, n, sizeof *c->vertex);
    return c->points != NULL && c->values != NULL && c->share != NULL && c->weight != NULL &&
                   c->left_out != NULL && c->vertex != NULL
               ? ICC_OK
               : ICC_ERR_MEMORY;
}

static bool have_weights(const iccp_frame_question *q)
{
    for (size_t i = 0; i < q->n; ++i)
        if (q->share[i] > 0)
            return true;
    return false;
}

static void take_point(choice *c, size_t k, size_t i)
{
    const iccp_frame_question *q = c->question;
    memcpy(c->points + 2 * k, q->points + 2 * i, 2 * sizeof *c->points);
    memcpy(c->values + 2 * k, q->values + 2 * i, 2 * sizeof *c->values);
    c->share[k] = q->share[i];
    c->vertex[k] = (uint32_t)k;
}

/* Each point has the same chance. Source: D. E. Knuth, The Art of Computer Programming 2, section
 * 3.4.2, algorithm S. */
static icc_status take_sample(choice *c, const iccp_env *env)
{
    const iccp_frame_question *q = c->question;
    const size_t most = q->n < MOST_SAMPLED ? q->n : MOST_SAMPLED;
    const icc_status status = make_room(c, most);
    if (status != ICC_OK)
        return status;
    uint64_t state = 0;
    size_t k = 0;
    for (size_t i = 0; i < q->n; ++i)
        if (iccp_random_unit(&state) * (double)(q->n - i) < (double)(most - k))
            take_point(c, k++, i);
    return iccp_frame_region_create(&c->region, k, c->points, NULL, q->lower, q->upper, env);
}

/* Adds up the squared residuals left out, by the shares of weighted points. */
static double find_score(const choice *c)
{
    double sum = 0;
    for (size_t i = 0; i < c->region.n; ++i) {
        const double *r = c->left_out + 2 * i, square = r[0] * r[0] + r[1] * r[1];
        if (isfinite(square))
            sum += (c->share[i] > 0 ? c->share[i] : 1) * square;
    }
    return sum;
}

static void weigh(choice *c, double smoothing)
{
    for (size_t i = 0; i < c->region.n && c->has_weights; ++i)
        c->weight[i] = c->share[i] / smoothing;
}

static icc_status rate(choice *c, const iccp_spline_system *system, double margin, double smoothing,
                       const iccp_env *env)
{
    icc_status status = iccp_spline_system_solve(system, c->values, c->u, env);
    if (status == ICC_OK)
        status = iccp_spline_system_leave_out(system, c->values, c->u, c->left_out, env);
    if (status != ICC_OK)
        return status;
    const double score = find_score(c) / (margin < FAR ? ADVANTAGE : 1);
    if (!(c->margin > 0) || score < c->score) {
        c->score = score;
        c->margin = margin;
        c->smoothing = smoothing;
    }
    return ICC_OK;
}

/* Tries one smoothing, or all of them if `given` is 0 and some points have weights. */
static icc_status try_smoothings(choice *c, iccp_spline_system *system, double margin, double given,
                                 const iccp_env *env)
{
    const bool chooses = c->has_weights && !(given > 0);
    double rigour = 1 / LEAST_SMOOTHING; /* a power of ten without rounding */
    icc_status status = ICC_OK;
    for (int k = 0; status == ICC_OK && k < (chooses ? N_SMOOTHINGS : 1); ++k, rigour /= 10) {
        const double smoothing = chooses ? 1 / rigour : c->has_weights ? given : 0;
        weigh(c, smoothing);
        if (k > 0)
            status = iccp_spline_system_weigh(system, c->weight, env);
        if (status == ICC_OK)
            status = rate(c, system, margin, smoothing, env);
    }
    return status;
}

static icc_status try_mesh(choice *c, const iccp_box_mesh *mesh, double margin, double smoothing,
                           const iccp_env *env)
{
    iccp_bending_mesh bending = iccp_bending_mesh_of(mesh);
    memcpy(bending.metric, c->question->metric, sizeof bending.metric);
    iccp_spline_system system;
    weigh(c, smoothing > 0 ? smoothing : LEAST_SMOOTHING);
    icc_status status = iccp_spline_system_create(&system, &bending, c->region.n, c->vertex,
                                                  c->weight, c->question->is_line, env);
    if (status != ICC_OK)
        return status;
    c->u = iccp_alloc(c->memory, mesh->n_vertices, 2 * sizeof *c->u);
    status = c->u != NULL ? try_smoothings(c, &system, margin, smoothing, env) : ICC_ERR_MEMORY;
    iccp_free(c->memory, c->u);
    iccp_spline_system_free(&system);
    return status;
}

static icc_status try_margin(choice *c, double margin, double smoothing, const iccp_env *env)
{
    const iccp_env quiet = iccp_quiet(env);
    iccp_box_mesh mesh;
    icc_status status = iccp_frame_mesh(&mesh, &c->region, margin, ACROSS, 1, &quiet);
    if (status == ICC_OK) {
        status = try_mesh(c, &mesh, margin, smoothing, &quiet);
        iccp_box_mesh_free(&mesh);
    }
    return status == ICC_OK ? iccp_progress(env, "solve", 1) : status;
}

icc_status iccp_choose_frame(double *margin, double *smoothing, const iccp_frame_question *question,
                             const iccp_env *env)
{
    choice c = {.question = question, .memory = &env->memory};
    c.has_weights = have_weights(question);
    icc_status status = take_sample(&c, env);
    if (status == ICC_OK && *margin > 0) {
        if (c.has_weights && !(*smoothing > 0))
            status = try_margin(&c, *margin, *smoothing, env);
    } else if (status == ICC_OK) {
        const iccp_env far = iccp_part(env, NULL, 0, 0.5), near = iccp_part(env, NULL, 0.5, 1);
        status = try_margin(&c, FAR, *smoothing, &far);
        if (status == ICC_OK)
            status = try_margin(&c, NEAR, *smoothing, &near);
    }
    if (status == ICC_OK && c.margin > 0) {
        *margin = c.margin;
        *smoothing = c.smoothing;
    }
    free_choice(&c);
    return status;
}
