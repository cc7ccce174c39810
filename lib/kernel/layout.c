/* Handles come first, then the nodes on lines, then the samples that are not too near to one of
 * those. Distances between nodes decide how well the kernel's matrix is conditioned, so nothing is
 * placed within half the samples' spacing of anything else but ends of lines, which are where the
 * caller wants them. */
#include "kernel/layout.h"

#include "base/error.h"
#include "base/threads.h"

#include <math.h>
#include <string.h>

/* In spacings: samples nearer than this to a handle or to a node on a line give way to it. */
static const double TOO_NEAR = 0.5;
/* In spacings: nearer points are the same; callers' numbers may have six digits. */
static const double SAME = 1e-6;
/* Local, where the shape's size is about 1: nodes as near as this to an edge are on it. */
static const double ON_EDGE = 1e-9;
/* Sine of the angle between lines that are called parallel. */
static const double PARALLEL = 1e-9;
/* In spacings: kernels narrower than this would be needles at the nodes. */
static const double LEAST_SIGMA = 1e-3;
static const size_t MOST_NODES = (size_t)1 << 24;
/* Nodes in a task. */
enum { GRAIN = 4096 };

static double distance(size_t dim, const double *a, const double *b)
{
    double d = 0;
    for (size_t k = 0; k < dim; ++k)
        d = hypot(d, a[k] - b[k]);
    return d;
}

double iccp_layout_scale(const iccp_layout *layout)
{
    const iccp_frame *frame = &layout->sampling->shape->frame;
    return frame->in[0] * frame->in[1];
}

const iccp_line_nodes *iccp_layout_parallel(const iccp_layout *layout, size_t k)
{
    return layout->parallel[k] == 0 ? NULL : &layout->lines[layout->parallel[k] - 1];
}

iccp_nodes iccp_layout_nodes(const iccp_layout *layout)
{
    return (iccp_nodes){layout->dim,    layout->n,     layout->n_handles,
                        layout->points, layout->given, layout->sampling->shape,
                        layout->edge,   layout->share};
}

/* ---- places ---- */

static void append(iccp_layout *l, const double *place, uint32_t sample)
{
    memcpy(l->given + l->dim * l->n, place, l->dim * sizeof *place);
    iccp_frame_in(&l->sampling->shape->frame, (int32_t)l->dim, place, l->points + l->dim * l->n);
    l->sample[l->n++] = sample;
}

/* How many of the nodes in the cells are as near to a place as this, in spacings; *node is one of
 * them. */
static size_t count_near(const iccp_layout *l, const iccp_cells *cells, const double *place,
                         double spacings, uint32_t *node)
{
    double local[ICC_MAX_DIM];
    iccp_frame_in(&l->sampling->shape->frame, (int32_t)l->dim, place, local);
    const double radius = spacings * l->sampling->info.spacing * iccp_layout_scale(l);
    return iccp_cells_near(cells, local, radius, 1, node);
}

static icc_status place_handles(iccp_layout *l, size_t n, const double *handles, icc_error *err)
{
    const double same = SAME * l->sampling->info.spacing;
    for (size_t j = 0; j < n; ++j) {
        const double *place = handles + l->dim * j;
        if (!iccp_shape_holds(l->sampling->shape, place))
            return iccp_fail_at(err, ICC_ERR_OUTSIDE, ICC_ITEM_HANDLE, (int64_t)j,
                                "handle %zu is outside the shape", j);
        for (size_t i = 0; i < j; ++i)
            if (distance(l->dim, place, handles + l->dim * i) <= same)
                return iccp_fail_at(err, ICC_ERR_ARGUMENT, ICC_ITEM_HANDLE, (int64_t)j,
                                    "handles %zu and %zu are at one place", i, j);
        append(l, place, UINT32_MAX);
    }
    return ICC_OK;
}

/* The nodes so far, to look up who is near. */
static icc_status sort_nodes(const iccp_layout *l, iccp_cells *cells, const iccp_env *env)
{
    return iccp_cells_create(cells, l->dim, l->n, l->points,
                             l->sampling->info.spacing * iccp_layout_scale(l), env);
}

/* The node at an end of a line: one that is there, or a new one. */
static size_t place_end(iccp_layout *l, const iccp_cells *before, const double *place)
{
    uint32_t node;
    if (count_near(l, before, place, SAME, &node) > 0)
        return node;
    append(l, place, UINT32_MAX);
    return l->n - 1;
}

static icc_status check_line(const iccp_layout *l, size_t k, const icc_line *lines, icc_error *err)
{
    const icc_line *line = &lines[k];
    const double length = distance(l->dim, line->from, line->to);
    if (!iccp_shape_holds(l->sampling->shape, line->from) ||
        !iccp_shape_holds(l->sampling->shape, line->to))
        return iccp_fail_at(err, ICC_ERR_OUTSIDE, ICC_ITEM_LINE, (int64_t)k,
                            "an end of line %zu is outside the shape", k);
    if (!(length > TOO_NEAR * l->sampling->info.spacing))
        return iccp_fail_at(err, ICC_ERR_ARGUMENT, ICC_ITEM_LINE, (int64_t)k,
                            "line %zu is shorter than half the samples' spacing", k);
    if (line->parallel == 0)
        return ICC_OK;
    const icc_line *other = &lines[line->parallel - 1];
    const double whole = distance(l->dim, other->from, other->to);
    double cosine = 0, off = 0;
    for (size_t d = 0; d < l->dim; ++d)
        cosine +=
            (line->to[d] - line->from[d]) / length * ((other->to[d] - other->from[d]) / whole);
    for (size_t d = 0; d < l->dim; ++d)
        off = hypot(off, (line->to[d] - line->from[d]) / length -
                             cosine * ((other->to[d] - other->from[d]) / whole));
    if (off <= PARALLEL)
        return ICC_OK;
    return iccp_fail_at(err, ICC_ERR_ARGUMENT, ICC_ITEM_LINE, (int64_t)k,
                        "lines %zu and %ld are not parallel: they differ by an angle of sine %.2g",
                        k, (long)line->parallel - 1, off);
}

static void place_between(iccp_layout *l, const iccp_cells *before, const icc_line *line,
                          size_t pieces)
{
    for (size_t p = 1; p < pieces; ++p) {
        const double share = (double)p / (double)pieces;
        double place[3];
        uint32_t node;
        for (size_t d = 0; d < l->dim; ++d)
            place[d] = line->from[d] + share * (line->to[d] - line->from[d]);
        if (count_near(l, before, place, TOO_NEAR, &node) == 0)
            append(l, place, UINT32_MAX);
    }
}

/* How many pieces line k has: no longer than the spacing. */
static double pieces_of(const iccp_layout *l, const icc_line *line)
{
    return ceil(distance(l->dim, line->from, line->to) / l->sampling->info.spacing - SAME);
}

static icc_status place_line(iccp_layout *l, size_t k, const icc_line *lines, const iccp_env *env,
                             icc_error *err)
{
    iccp_line_nodes *nodes = &l->lines[k];
    iccp_cells before;
    icc_status status = check_line(l, k, lines, err);
    if (status == ICC_OK)
        status = sort_nodes(l, &before, env);
    if (status != ICC_OK)
        return status;
    const size_t n_before = l->n;
    nodes->from = place_end(l, &before, lines[k].from);
    nodes->to = place_end(l, &before, lines[k].to);
    nodes->first = l->n;
    place_between(l, &before, &lines[k], (size_t)pieces_of(l, &lines[k]));
    nodes->count = l->n - nodes->first;
    iccp_cells_free(&before);
    l->parallel[k] = lines[k].parallel;
    if (l->parallel[k] != 0 && nodes->to < n_before)
        return iccp_fail_at(
            err, ICC_ERR_ARGUMENT, ICC_ITEM_LINE, (int64_t)k,
            "line %zu ends at a handle or at another line, which decides its direction: "
            "it cannot be made parallel",
            k);
    return ICC_OK;
}

static icc_status place_samples(iccp_layout *l, const iccp_env *env)
{
    const icc_sampling *s = l->sampling;
    iccp_cells before;
    const icc_status status = sort_nodes(l, &before, env);
    if (status != ICC_OK)
        return status;
    for (size_t i = 0; i < s->info.n_samples; ++i) {
        const double *place = s->points + l->dim * i;
        uint32_t node;
        if (count_near(l, &before, place, TOO_NEAR, &node) == 0)
            append(l, place, (uint32_t)i);
    }
    iccp_cells_free(&before);
    return ICC_OK;
}

/* ---- edges ---- */

/* Whether a point is on the edge between two others, not at its ends, and where. */
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
    return off <= ON_EDGE * ON_EDGE;
}

static icc_status find_edges(void *argument, size_t begin, size_t end)
{
    iccp_layout *l = argument;
    for (size_t i = begin; i < end; ++i) {
        l->edge[i] = ICCP_NO_EDGE;
        l->share[i] = 0;
        for (size_t e = 0; i >= l->n_handles && e < l->n_edges; ++e) {
            const double *a = l->points + l->dim * l->edges[2 * e];
            const double *b = l->points + l->dim * l->edges[2 * e + 1];
            double share;
            if (!is_on_edge(l->dim, a, b, l->points + l->dim * i, &share))
                continue;
            l->edge[i] = (uint32_t)e;
            l->share[i] = share;
            break;
        }
    }
    return ICC_OK;
}

/* ---- the object ---- */

/* Room for all nodes that there can be. */
static icc_status make_room(iccp_layout *l, size_t n_handles, const icc_weights_options *options,
                            icc_error *err)
{
    double most = (double)n_handles + (double)l->sampling->info.n_samples;
    for (size_t k = 0; k < options->n_lines; ++k)
        most += 2 + fmax(0, pieces_of(l, &options->lines[k]));
    if (!(most <= (double)MOST_NODES))
        return iccp_fail(err, ICC_ERR_RESOLUTION, "there would be more than %zu nodes", MOST_NODES);
    const size_t n = (size_t)most, row = l->dim * sizeof(double);
    l->given = iccp_alloc(&l->memory, n, row);
    l->points = iccp_alloc(&l->memory, n, row);
    l->sample = iccp_alloc(&l->memory, n, sizeof *l->sample);
    l->edge = iccp_alloc(&l->memory, n, sizeof *l->edge);
    l->share = iccp_alloc(&l->memory, n, sizeof *l->share);
    l->held = iccp_alloc_zero(&l->memory, n, sizeof *l->held);
    l->edges = iccp_alloc(&l->memory, options->n_edges, 2 * sizeof *l->edges);
    l->lines = iccp_alloc(&l->memory, options->n_lines, sizeof *l->lines);
    l->parallel = iccp_alloc(&l->memory, options->n_lines, sizeof *l->parallel);
    return l->given != NULL && l->points != NULL && l->sample != NULL && l->edge != NULL &&
                   l->share != NULL && l->held != NULL && l->edges != NULL && l->lines != NULL &&
                   l->parallel != NULL
               ? ICC_OK
               : ICC_ERR_MEMORY;
}

static icc_status place_all(iccp_layout *l, size_t n_handles, const double *handles,
                            const icc_weights_options *options, const iccp_env *env, icc_error *err)
{
    icc_status status = place_handles(l, n_handles, handles, err);
    for (size_t k = 0; status == ICC_OK && k < options->n_lines; ++k)
        status = place_line(l, k, options->lines, env, err);
    l->n_handles = n_handles;
    l->n_lines = options->n_lines;
    l->n_line_nodes = l->n - n_handles;
    return status == ICC_OK ? place_samples(l, env) : status;
}

static icc_status connect(iccp_layout *l, const icc_weights_options *options, const iccp_env *env)
{
    l->n_edges = options->n_edges;
    if (l->n_edges > 0)
        memcpy(l->edges, options->edges, 2 * l->n_edges * sizeof *l->edges);
    const icc_status status = iccp_for_chunks(env, "weights", l->n, GRAIN, find_edges, l);
    for (size_t i = 0; status == ICC_OK && i < l->n; ++i)
        l->held[i] = i < l->n_handles + l->n_line_nodes ||
                     (options->initial == ICC_INITIAL_EDGES && l->edge[i] != ICCP_NO_EDGE);
    return status;
}

static icc_status create(iccp_layout *l, size_t n_handles, const double *handles,
                         const icc_weights_options *options, const iccp_env *env, icc_error *err)
{
    if (!(options->sigma > LEAST_SIGMA * l->sampling->info.spacing))
        return iccp_fail(err, ICC_ERR_ARGUMENT, "sigma is %g where samples are %g apart",
                         options->sigma, l->sampling->info.spacing);
    icc_status status = make_room(l, n_handles, options, err);
    iccp_env part[3];
    iccp_split(part, 3, (const double[]){1, 1, 8}, env);
    if (status == ICC_OK)
        status = place_all(l, n_handles, handles, options, &part[0], err);
    if (status == ICC_OK)
        status = iccp_handles_create(&l->handles, l->dim, n_handles, l->points, &part[0], err);
    if (status == ICC_OK)
        status = connect(l, options, &part[1]);
    const iccp_radial radial =
        iccp_radial_make(options->kernel, options->sigma * iccp_layout_scale(l), options->cutoff);
    if (status == ICC_OK)
        status = iccp_collocation_create(&l->collocation, l->dim, l->n, l->points, &radial,
                                         options->affine_tail >= 0, &part[2], err);
    return status;
}

icc_status iccp_layout_create(iccp_layout **out, const icc_sampling *sampling, size_t n_handles,
                              const double *handles, const icc_weights_options *options,
                              const iccp_env *env, icc_error *err)
{
    iccp_layout *l = iccp_alloc_zero(&env->memory, 1, sizeof *l);
    *out = NULL;
    if (l == NULL)
        return ICC_ERR_MEMORY;
    l->memory = env->memory;
    atomic_init(&l->references, 1);
    l->sampling = iccp_sampling_retain(sampling);
    l->dim = sampling->shape->dim;
    const icc_status status = create(l, n_handles, handles, options, env, err);
    if (status == ICC_OK)
        *out = l;
    else
        iccp_layout_release(l);
    return status;
}

iccp_layout *iccp_layout_retain(const iccp_layout *layout)
{
    iccp_layout *l = (iccp_layout *)layout;
    atomic_fetch_add(&l->references, 1);
    return l;
}

void iccp_layout_release(iccp_layout *layout)
{
    iccp_layout *l = layout;
    if (l == NULL || atomic_fetch_sub(&l->references, 1) > 1)
        return;
    void *const arrays[] = {l->points, l->given, l->sample, l->edge,     l->share,
                            l->held,   l->edges, l->lines,  l->parallel, l->initial};
    for (size_t i = 0; i < sizeof arrays / sizeof *arrays; ++i)
        iccp_free(&l->memory, arrays[i]);
    if (l->handles != NULL)
        iccp_handles_free(l->handles);
    iccp_collocation_release(l->collocation);
    iccp_sampling_release(l->sampling);
    const iccp_memory memory = l->memory;
    iccp_free(&memory, l);
}
