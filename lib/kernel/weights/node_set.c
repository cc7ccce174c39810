/* Chooses the nodes. Handles come first, then the nodes on lines, then the samples that are not too
 * near to one of those. The distances between nodes determine the condition of the kernel's matrix.
 * So no node is placed within half the samples' spacing of another one, except ends of lines, which
 * stay where the caller put them. */
#include "kernel/weights/node_set.h"

#include "base/error.h"
#include "base/minmax.h"
#include "base/threads.h"
#include "math/elementary.h"

#include <math.h>
#include <string.h>

/* In spacings: samples nearer than this to a handle or to a node on a line are left out. */
static const double TOO_NEAR = 0.5;
/* In spacings: points nearer than this are equal. Callers' numbers may have six digits. */
static const double SAME = 1e-6;
/* Sine of the angle below which lines count as parallel. */
static const double PARALLEL = 1e-9;
/* In spacings: narrower kernels would be needles at the nodes. */
static const double LEAST_SIGMA = 1e-3;
static const size_t MOST_NODES = (size_t)1 << 24;

static double distance(size_t dim, const double *a, const double *b)
{
    double d = 0;
    for (size_t k = 0; k < dim; ++k)
        d = iccp_hypot(d, a[k] - b[k]);
    return d;
}

double iccp_node_set_scale(const iccp_node_set *set)
{
    const iccp_frame *frame = &set->sampling->shape->frame;
    return frame->in[0] * frame->in[1];
}

const iccp_line_nodes *iccp_node_set_parallel(const iccp_node_set *set, size_t k)
{
    return set->parallel[k] == 0 ? NULL : &set->lines[set->parallel[k] - 1];
}

iccp_nodes iccp_node_set_view(const iccp_node_set *set)
{
    return (iccp_nodes){set->dim,    set->n,     set->n_handles,
                        set->points, set->given, set->sampling->shape,
                        set->edge,   set->share};
}

/* ---- placing nodes ---- */

static void append(iccp_node_set *set, const double *place, uint32_t sample)
{
    memcpy(set->given + set->dim * set->n, place, set->dim * sizeof *place);
    iccp_frame_in(&set->sampling->shape->frame, (int32_t)set->dim, place,
                  set->points + set->dim * set->n);
    set->sample[set->n++] = sample;
}

/* Counts the nodes in the cells that are within `spacings` of a place. *node is one of them. */
static size_t count_near(const iccp_node_set *set, const iccp_cells *cells, const double *place,
                         double spacings, uint32_t *node)
{
    double local[ICC_MAX_DIM];
    iccp_frame_in(&set->sampling->shape->frame, (int32_t)set->dim, place, local);
    const double radius = spacings * set->sampling->info.spacing * iccp_node_set_scale(set);
    return iccp_cells_near(cells, local, radius, 1, node);
}

/* Adds nodes 0 to n - 1. Two handles at one place would make two equal rows of the matrix. */
static icc_status place_handles(iccp_node_set *set, size_t n, const double *handles, icc_error *err)
{
    const double same = SAME * set->sampling->info.spacing;
    for (size_t j = 0; j < n; ++j) {
        const double *place = handles + set->dim * j;
        if (!iccp_shape_holds(set->sampling->shape, place))
            return iccp_fail_at(err, ICC_ERR_OUTSIDE, ICC_ITEM_HANDLE, (int64_t)j,
                                "handle %zu is outside the shape", j);
        for (size_t i = 0; i < j; ++i)
            if (distance(set->dim, place, handles + set->dim * i) <= same)
                return iccp_fail_at(err, ICC_ERR_ARGUMENT, ICC_ITEM_HANDLE, (int64_t)j,
                                    "handles %zu and %zu are at one place", i, j);
        append(set, place, UINT32_MAX);
    }
    return ICC_OK;
}

/* Sorts the present nodes into cells, to find neighbours. */
static icc_status sort_nodes(const iccp_node_set *set, iccp_cells *cells, const iccp_env *env)
{
    return iccp_cells_create(cells, set->dim, set->n, set->points,
                             set->sampling->info.spacing * iccp_node_set_scale(set), env);
}

/* Returns the node at an end of a line: an existing one, or a new one. */
static size_t place_end(iccp_node_set *set, const iccp_cells *before, const double *place)
{
    uint32_t node;
    if (count_near(set, before, place, SAME, &node) > 0)
        return node;
    append(set, place, UINT32_MAX);
    return set->n - 1;
}

/* Checks line k of the caller's n_lines. Parallel lines must be parallel before the weights are
 * made, because 5.11 transfers the change per length of one line to the other by direction. */
static icc_status check_line(const iccp_node_set *set, size_t k, const icc_line *lines,
                             icc_error *err)
{
    const icc_line *line = &lines[k];
    const double length = distance(set->dim, line->from, line->to);
    if (!iccp_shape_holds(set->sampling->shape, line->from) ||
        !iccp_shape_holds(set->sampling->shape, line->to))
        return iccp_fail_at(err, ICC_ERR_OUTSIDE, ICC_ITEM_LINE, (int64_t)k,
                            "an end of line %zu is outside the shape", k);
    if (!(length > TOO_NEAR * set->sampling->info.spacing))
        return iccp_fail_at(err, ICC_ERR_ARGUMENT, ICC_ITEM_LINE, (int64_t)k,
                            "line %zu is shorter than half the samples' spacing", k);
    if (line->parallel == 0)
        return ICC_OK;
    const icc_line *other = &lines[line->parallel - 1];
    const double whole = distance(set->dim, other->from, other->to);
    double cosine = 0, off = 0;
    for (size_t d = 0; d < set->dim; ++d)
        cosine +=
            (line->to[d] - line->from[d]) / length * ((other->to[d] - other->from[d]) / whole);
    for (size_t d = 0; d < set->dim; ++d)
        off = iccp_hypot(off, (line->to[d] - line->from[d]) / length -
                                  cosine * ((other->to[d] - other->from[d]) / whole));
    if (off <= PARALLEL)
        return ICC_OK;
    return iccp_fail_at(err, ICC_ERR_ARGUMENT, ICC_ITEM_LINE, (int64_t)k,
                        "lines %zu and %ld are not parallel: they differ by an angle of sine %.2g",
                        k, (long)line->parallel - 1, off);
}

/* Adds nodes between the ends of a line, except those too near to a node in `before`. */
static void place_between(iccp_node_set *set, const iccp_cells *before, const icc_line *line,
                          size_t pieces)
{
    for (size_t p = 1; p < pieces; ++p) {
        const double share = (double)p / (double)pieces;
        double place[3];
        uint32_t node;
        for (size_t d = 0; d < set->dim; ++d)
            place[d] = line->from[d] + share * (line->to[d] - line->from[d]);
        if (count_near(set, before, place, TOO_NEAR, &node) == 0)
            append(set, place, UINT32_MAX);
    }
}

/* Returns the number of pieces of line k. They are no longer than the spacing. */
static double pieces_of(const iccp_node_set *set, const icc_line *line)
{
    return ceil(distance(set->dim, line->from, line->to) / set->sampling->info.spacing - SAME);
}

/* Adds the nodes of line k. Its ends are shared with a handle or an earlier line where they
 * coincide. Between them there is one node per spacing. `before` has the nodes of handles and
 * earlier lines, which take precedence. */
static icc_status place_line(iccp_node_set *set, size_t k, const icc_line *lines,
                             const iccp_env *env, icc_error *err)
{
    iccp_line_nodes *nodes = &set->lines[k];
    iccp_cells before;
    icc_status status = check_line(set, k, lines, err);
    if (status == ICC_OK)
        status = sort_nodes(set, &before, env);
    if (status != ICC_OK)
        return status;
    const size_t n_before = set->n;
    nodes->from = place_end(set, &before, lines[k].from);
    nodes->to = place_end(set, &before, lines[k].to);
    nodes->first = set->n;
    place_between(set, &before, &lines[k], (size_t)pieces_of(set, &lines[k]));
    nodes->count = set->n - nodes->first;
    iccp_cells_free(&before);
    set->parallel[k] = lines[k].parallel;
    if (set->parallel[k] != 0 && nodes->to < n_before)
        return iccp_fail_at(
            err, ICC_ERR_ARGUMENT, ICC_ITEM_LINE, (int64_t)k,
            "line %zu ends at a handle or at another line, which decides its direction: "
            "it cannot be made parallel",
            k);
    return ICC_OK;
}

static icc_status place_samples(iccp_node_set *set, const iccp_env *env)
{
    const icc_sampling *s = set->sampling;
    iccp_cells before;
    const icc_status status = sort_nodes(set, &before, env);
    if (status != ICC_OK)
        return status;
    for (size_t i = 0; i < s->info.n_samples; ++i) {
        const double *place = s->points + set->dim * i;
        uint32_t node;
        if (count_near(set, &before, place, TOO_NEAR, &node) == 0)
            append(set, place, (uint32_t)i);
    }
    iccp_cells_free(&before);
    return ICC_OK;
}

/* ---- edges ---- */

/* Returns true if a point lies on the edge between two others, not at its ends, and returns its
 * position as a share. */
static bool is_on_edge(size_t dim, const double *a, const double *b, const double *x, double *share)
{
    double along = 0, length2 = 0, off = 0;
    for (size_t d = 0; d < dim; ++d) {
        along += (x[d] - a[d]) * (b[d] - a[d]);
        length2 += (b[d] - a[d]) * (b[d] - a[d]);
    }
    *share = along / length2;
    if (!(*share > 0 && *share < 1))
        return false;
    for (size_t d = 0; d < dim; ++d) {
        const double away = x[d] - a[d] - *share * (b[d] - a[d]);
        off += away * away;
    }
    return off <= ICCP_ON_LINE * ICCP_ON_LINE;
}

static icc_status find_edges(void *argument, size_t begin, size_t end)
{
    iccp_node_set *set = argument;
    for (size_t i = begin; i < end; ++i) {
        set->edge[i] = ICCP_NO_EDGE;
        set->share[i] = 0;
        for (size_t e = 0; i >= set->n_handles && e < set->n_edges; ++e) {
            const double *a = set->points + set->dim * set->edges[2 * e];
            const double *b = set->points + set->dim * set->edges[2 * e + 1];
            double share;
            if (!is_on_edge(set->dim, a, b, set->points + set->dim * i, &share))
                continue;
            set->edge[i] = (uint32_t)e;
            set->share[i] = share;
            break;
        }
    }
    return ICC_OK;
}

/* ---- the object ---- */

/* Makes room for the largest possible number of nodes. */
static icc_status make_room(iccp_node_set *set, size_t n_handles,
                            const icc_weights_options *options, icc_error *err)
{
    double most = (double)n_handles + (double)set->sampling->info.n_samples;
    for (size_t k = 0; k < options->n_lines; ++k)
        most += 2 + iccp_max(0, pieces_of(set, &options->lines[k]));
    if (!(most <= (double)MOST_NODES))
        return iccp_fail(err, ICC_ERR_RESOLUTION, "there would be more than %zu nodes", MOST_NODES);
    const size_t n = (size_t)most, row = set->dim * sizeof(double);
    set->given = iccp_alloc(&set->memory, n, row);
    set->points = iccp_alloc(&set->memory, n, row);
    set->sample = iccp_alloc(&set->memory, n, sizeof *set->sample);
    set->edge = iccp_alloc(&set->memory, n, sizeof *set->edge);
    set->share = iccp_alloc(&set->memory, n, sizeof *set->share);
    set->held = iccp_alloc_zero(&set->memory, n, sizeof *set->held);
    set->edges = iccp_alloc(&set->memory, options->n_edges, 2 * sizeof *set->edges);
    set->lines = iccp_alloc(&set->memory, options->n_lines, sizeof *set->lines);
    set->parallel = iccp_alloc(&set->memory, options->n_lines, sizeof *set->parallel);
    return set->given != NULL && set->points != NULL && set->sample != NULL && set->edge != NULL &&
                   set->share != NULL && set->held != NULL && set->edges != NULL &&
                   set->lines != NULL && set->parallel != NULL
               ? ICC_OK
               : ICC_ERR_MEMORY;
}

static icc_status place_all(iccp_node_set *set, size_t n_handles, const double *handles,
                            const icc_weights_options *options, const iccp_env *env, icc_error *err)
{
    icc_status status = place_handles(set, n_handles, handles, err);
    for (size_t k = 0; status == ICC_OK && k < options->n_lines; ++k)
        status = place_line(set, k, options->lines, env, err);
    set->n_handles = n_handles;
    set->n_lines = options->n_lines;
    set->n_line_nodes = set->n - n_handles;
    return status == ICC_OK ? place_samples(set, env) : status;
}

static icc_status connect(iccp_node_set *set, const icc_weights_options *options,
                          const iccp_env *env)
{
    set->n_edges = options->n_edges;
    if (set->n_edges > 0)
        memcpy(set->edges, options->edges, 2 * set->n_edges * sizeof *set->edges);
    const icc_status status =
        iccp_for_chunks(env, "weights", set->n, ICCP_NODES_A_TASK, find_edges, set);
    for (size_t i = 0; status == ICC_OK && i < set->n; ++i)
        set->held[i] = i < set->n_handles + set->n_line_nodes ||
                       (options->initial == ICC_INITIAL_EDGES && set->edge[i] != ICCP_NO_EDGE);
    return status;
}

/* Fills in a set that is all zeros except for its sampling. The factorisation comes last, because
 * it takes most of the time and all errors can be found before. */
static icc_status create(iccp_node_set *set, size_t n_handles, const double *handles,
                         const icc_weights_options *options, const iccp_env *env, icc_error *err)
{
    if (!(options->sigma > LEAST_SIGMA * set->sampling->info.spacing))
        return iccp_fail(err, ICC_ERR_ARGUMENT,
                         "sigma is %g, which is too small for samples %g apart", options->sigma,
                         set->sampling->info.spacing);
    icc_status status = make_room(set, n_handles, options, err);
    iccp_env part[3];
    iccp_split(part, 3, (const double[]){1, 1, 8}, env);
    if (status == ICC_OK)
        status = place_all(set, n_handles, handles, options, &part[0], err);
    if (status == ICC_OK)
        status =
            iccp_handles_create(&set->handles, set->dim, n_handles, set->points, &part[0], err);
    if (status == ICC_OK)
        status = connect(set, options, &part[1]);
    const iccp_radial radial = iccp_radial_make(
        options->kernel, options->sigma * iccp_node_set_scale(set), options->cutoff);
    if (status == ICC_OK)
        status = iccp_collocation_create(&set->collocation, set->dim, set->n, set->points, &radial,
                                         options->affine_tail >= 0, &part[2], err);
    return status;
}

icc_status iccp_node_set_create(iccp_node_set **out, const icc_sampling *sampling, size_t n_handles,
                                const double *handles, const icc_weights_options *options,
                                const iccp_env *env, icc_error *err)
{
    iccp_node_set *set = iccp_alloc_zero(&env->memory, 1, sizeof *set);
    *out = NULL;
    if (set == NULL)
        return ICC_ERR_MEMORY;
    set->memory = env->memory;
    atomic_init(&set->references, 1);
    set->sampling = iccp_sampling_retain(sampling);
    set->dim = sampling->shape->dim;
    const icc_status status = create(set, n_handles, handles, options, env, err);
    if (status == ICC_OK)
        *out = set;
    else
        iccp_node_set_release(set);
    return status;
}

iccp_node_set *iccp_node_set_retain(const iccp_node_set *set)
{
    iccp_node_set *shared = (iccp_node_set *)set;
    atomic_fetch_add(&shared->references, 1);
    return shared;
}

void iccp_node_set_release(iccp_node_set *set)
{
    if (set == NULL || atomic_fetch_sub(&set->references, 1) > 1)
        return;
    void *const arrays[] = {set->points, set->given, set->sample, set->edge,     set->share,
                            set->held,   set->edges, set->lines,  set->parallel, set->initial};
    for (size_t i = 0; i < sizeof arrays / sizeof *arrays; ++i)
        iccp_free(&set->memory, arrays[i]);
    if (set->handles != NULL)
        iccp_handles_free(set->handles);
    iccp_collocation_free(set->collocation);
    iccp_sampling_release(set->sampling);
    const iccp_memory memory = set->memory;
    iccp_free(&memory, set);
}
