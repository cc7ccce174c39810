/* Extends a function from the inside vertices of a grid to all vertices that simplices of the
 * domain need. Source: docs/theory/charts-space.md, "fields on grids", step 1.
 *
 * Values next to the inside are 0. Farther out they fall by the same amount with each step. */
#include "field/extension.h"

#include "base/minmax.h"
#include "base/threads.h"

#include <string.h>

static const size_t GRAIN = 1 << 14; /* vertices per chunk */

/* Marks the corners of a simplex as needed. */
static void mark_simplex(iccp_extension *s, const iccp_orders *orders, uint32_t lowest, int32_t r)
{
    uint32_t corner = lowest;
    s->needed[corner] = 1;
    for (int32_t k = 0; k < orders->dim; ++k) {
        corner += (uint32_t)s->grid->stride[orders->axis[r][k]];
        s->needed[corner] = 1;
    }
}

/* Marks the corners of simplices with an inside vertex, which are the vertices joined to one.
 * Marks also the corners of simplices that a facet runs through. */
static void mark_needed(iccp_extension *s, const iccp_orders *orders,
                        const iccp_incidence *incidence)
{
    const icc_grid *grid = s->grid;
    for (size_t v = 0; v < grid->n_vertices; ++v) {
        if (grid->inside[v])
            for (int set = 0; set < 1 << grid->dim; ++set) {
                s->needed[(ptrdiff_t)v + orders->offset[set]] = 1;
                s->needed[(ptrdiff_t)v - orders->offset[set]] = 1;
            }
        for (int32_t r = 0; incidence->bits[v] != 0 && r < orders->n; ++r)
            if (iccp_incidence_has(incidence, (uint32_t)v, r))
                mark_simplex(s, orders, (uint32_t)v, r);
    }
}

/* A breadth-first walk outwards through the simplices that facets run through. */
typedef struct outskirts {
    iccp_extension *extension;
    const iccp_orders *orders;
    const iccp_incidence *incidence;
    uint32_t *queue;   /* vertices, n so far */
    int32_t *distance; /* steps from the vertices next to the inside; -1 if not reached */
    double *scale;     /* how much the function falls with each step */
    size_t n;
} outskirts;

/* Gives a vertex its value on the first visit: minus its scale times its distance. `from` is a
 * neighbour that already has a value. */
static void reach(outskirts *o, uint32_t v, uint32_t from)
{
    iccp_extension *s = o->extension;
    if (o->distance[v] >= 0)
        return;
    o->distance[v] = o->distance[from] + 1;
    o->scale[v] = o->scale[from];
    iccp_extension_set(s, v, -o->scale[v] * o->distance[v], iccp_extension_exponent(s, from));
    if (s->exponent != NULL)
        o->scale[v] = -s->value[v] / o->distance[v];
    o->queue[o->n++] = v;
}

/* Reaches the other corners of the simplices at a vertex that meet the domain. The vertex is
 * corner k of each. */
static void reach_star(outskirts *o, uint32_t v)
{
    const iccp_orders *orders = o->orders;
    for (int32_t r = 0; r < orders->n; ++r) {
        uint32_t lowest = v;
        for (int32_t k = 0; k <= orders->dim; ++k) {
            if (iccp_incidence_has(o->incidence, lowest, r)) {
                uint32_t corner = lowest;
                for (int32_t j = 0; j <= orders->dim; ++j) {
                    reach(o, corner, v);
                    if (j < orders->dim)
                        corner += (uint32_t)o->extension->grid->stride[orders->axis[r][j]];
                }
            }
            if (k < orders->dim)
                lowest -= (uint32_t)o->extension->grid->stride[orders->axis[r][k]];
        }
    }
}

/* The largest value of the inside vertices joined to v, or 0 if there are none. The walk starts
 * at vertices for which this is positive. */
static double value_behind(const outskirts *o, uint32_t v)
{
    const icc_grid *grid = o->extension->grid;
    double most = 0;
    for (int set = 1; set < 1 << grid->dim; ++set)
        for (int sign = -1; sign <= 1; sign += 2) {
            const uint32_t u = (uint32_t)((ptrdiff_t)v + sign * o->orders->offset[set]);
            if (grid->inside[u])
                most = iccp_max(most, iccp_extension_get(o->extension, u,
                                                         iccp_extension_exponent(o->extension, v)));
        }
    return most;
}

/* Starts the walk at a vertex if it is next to the inside. Its value 0 takes the largest
 * exponent of the inside vertices joined to it, so that the scale is not lost by rounding. */
static void start_layer(outskirts *o, uint32_t v)
{
    iccp_extension *s = o->extension;
    const icc_grid *grid = s->grid;
    if (s->exponent != NULL) {
        s->exponent[v] = ICCP_ZERO_EXPONENT;
        for (int set = 1; set < 1 << grid->dim; ++set)
            for (int sign = -1; sign <= 1; sign += 2) {
                const uint32_t u = (uint32_t)((ptrdiff_t)v + sign * o->orders->offset[set]);
                if (grid->inside[u] && s->exponent[u] > s->exponent[v])
                    s->exponent[v] = s->exponent[u];
            }
        if (s->exponent[v] == ICCP_ZERO_EXPONENT)
            return;
    }
    o->scale[v] = value_behind(o, v);
    if (o->scale[v] > 0) {
        o->distance[v] = 0;
        o->queue[o->n++] = v;
    }
}

/* Walks breadth-first from the outside vertices next to the inside, so that each gets its least
 * distance. */
static void extend_outwards(outskirts *o)
{
    const icc_grid *grid = o->extension->grid;
    for (size_t v = 0; v < grid->n_vertices; ++v) {
        o->distance[v] = grid->inside[v] ? 0 : -1;
        if (!grid->inside[v] && o->extension->needed[v])
            start_layer(o, (uint32_t)v);
    }
    for (size_t i = 0; i < o->n; ++i)
        reach_star(o, o->queue[i]);
}

typedef struct sweep {
    const iccp_extension *from;
    const iccp_orders *orders;
    double *value;
    int32_t *exponent;
} sweep;

/* New value of an inside vertex. Its outside neighbours count at most as much as the vertex
 * itself. They may belong to a part of the domain across a gap, where the function is larger by
 * any factor. */
static double mean_inside(const iccp_extension *s, size_t v, int32_t exponent)
{
    const icc_grid *grid = s->grid;
    const double own = s->value[v];
    double sum = 0;
    for (int32_t k = 0; k < 2 * grid->dim; ++k) {
        const size_t u = k % 2 == 0 ? v - grid->stride[k / 2] : v + grid->stride[k / 2];
        const double other = iccp_extension_get(s, (uint32_t)u, exponent);
        sum += grid->inside[u] ? other : iccp_max(iccp_min(other, own), -own);
    }
    return 0.5 * (own + sum / (2.0 * grid->dim));
}

/* New value of an outside vertex: at most half the value of any inside vertex joined to it. The
 * function across a gap may be larger by any factor. */
static double mean_outside(const sweep *w, size_t v, int32_t exponent)
{
    const iccp_extension *s = w->from;
    const icc_grid *grid = s->grid;
    double sum = 0, most = HUGE_VAL;
    for (int32_t k = 0; k < grid->dim; ++k)
        sum += iccp_extension_get(s, (uint32_t)(v - grid->stride[k]), exponent) +
               iccp_extension_get(s, (uint32_t)(v + grid->stride[k]), exponent);
    for (int set = 1; set < 1 << grid->dim; ++set)
        for (int sign = -1; sign <= 1; sign += 2) {
            const uint32_t u = (uint32_t)((ptrdiff_t)v + sign * w->orders->offset[set]);
            if (grid->inside[u])
                most = iccp_min(most, 0.5 * iccp_extension_get(s, u, exponent));
        }
    return iccp_min(0.5 * (s->value[v] + sum / (2.0 * grid->dim)), most);
}

/* Reads the old values and writes new ones, so the result is the same for every number of
 * threads. */
static icc_status sweep_chunk(void *argument, size_t begin, size_t end)
{
    sweep *w = argument;
    const iccp_extension *s = w->from;
    const iccp_scaled to = {w->value, w->exponent};
    for (size_t v = begin; v < end; ++v) {
        const int32_t exponent = iccp_extension_exponent(s, (uint32_t)v);
        w->value[v] = s->value[v];
        if (w->exponent != NULL)
            w->exponent[v] = exponent;
        if (!s->needed[v] || v == s->root)
            continue;
        const double mean =
            s->grid->inside[v] ? mean_inside(s, v, exponent) : mean_outside(w, v, exponent);
        if (w->exponent != NULL)
            iccp_scaled_set(&to, v, mean, exponent);
        else
            w->value[v] = mean;
    }
    return ICC_OK;
}

/* Runs one Jacobi sweep into new arrays, which then replace the old ones. */
static icc_status run_sweep(iccp_extension *s, const iccp_orders *orders, const iccp_env *env)
{
    const size_t n = s->grid->n_vertices;
    sweep w = {.from = s, .orders = orders};
    w.value = iccp_alloc(&s->memory, n, sizeof *w.value);
    if (s->exponent != NULL)
        w.exponent = iccp_alloc(&s->memory, n, sizeof *w.exponent);
    icc_status status =
        w.value != NULL && (s->exponent == NULL || w.exponent != NULL) ? ICC_OK : ICC_ERR_MEMORY;
    if (status == ICC_OK)
        status = iccp_for_chunks(env, "solve", n, GRAIN, sweep_chunk, &w);
    if (status == ICC_OK) {
        double *value = s->value;
        int32_t *exponent = s->exponent;
        s->value = w.value;
        s->exponent = w.exponent;
        w.value = value;
        w.exponent = exponent;
    }
    iccp_free(&s->memory, w.value);
    iccp_free(&s->memory, w.exponent);
    return status;
}

/* Copies the function's inside values and sets the others to 0. */
static icc_status allocate(iccp_extension *s, const icc_function *field)
{
    const size_t n = s->grid->n_vertices;
    s->needed = iccp_alloc_zero(&s->memory, n, sizeof *s->needed);
    s->value = iccp_alloc(&s->memory, n, sizeof *s->value);
    if (field->exponent != NULL)
        s->exponent = iccp_alloc(&s->memory, n, sizeof *s->exponent);
    if (s->needed == NULL || s->value == NULL || (field->exponent != NULL && s->exponent == NULL))
        return ICC_ERR_MEMORY;
    for (size_t v = 0; v < n; ++v) {
        const bool has = s->grid->inside[v] && !isnan(field->values[v]);
        s->value[v] = has ? field->values[v] : 0;
        if (s->exponent != NULL)
            s->exponent[v] = has ? field->exponent[v] : ICCP_ZERO_EXPONENT;
    }
    return ICC_OK;
}

static icc_status extend_all(iccp_extension *s, const iccp_orders *orders,
                             const iccp_incidence *incidence)
{
    const size_t n = s->grid->n_vertices;
    outskirts o = {.extension = s, .orders = orders, .incidence = incidence};
    o.queue = iccp_alloc(&s->memory, n, sizeof *o.queue);
    o.distance = iccp_alloc(&s->memory, n, sizeof *o.distance);
    o.scale = iccp_alloc(&s->memory, n, sizeof *o.scale);
    const bool has_memory = o.queue != NULL && o.distance != NULL && o.scale != NULL;
    if (has_memory) {
        mark_needed(s, orders, incidence);
        extend_outwards(&o);
    }
    iccp_free(&s->memory, o.queue);
    iccp_free(&s->memory, o.distance);
    iccp_free(&s->memory, o.scale);
    return has_memory ? ICC_OK : ICC_ERR_MEMORY;
}

icc_status iccp_extension_create(iccp_extension *extension, const icc_function *field,
                                 const iccp_incidence *incidence, int sweeps, const iccp_env *env)
{
    *extension = (iccp_extension){
        .memory = env->memory, .grid = field->tree->grid, .root = field->tree->root};
    iccp_orders *orders = iccp_alloc(&env->memory, 1, sizeof *orders);
    icc_status status = orders != NULL ? allocate(extension, field) : ICC_ERR_MEMORY;
    if (status == ICC_OK) {
        iccp_orders_init(orders, extension->grid);
        status = extend_all(extension, orders, incidence);
    }
    for (int k = 0; status == ICC_OK && k < sweeps; ++k) {
        const iccp_env part = iccp_part(env, NULL, (double)k / sweeps, (k + 1.0) / sweeps);
        status = run_sweep(extension, orders, &part);
    }
    iccp_free(&env->memory, orders);
    return status;
}

void iccp_extension_free(iccp_extension *extension)
{
    iccp_free(&extension->memory, extension->value);
    iccp_free(&extension->memory, extension->exponent);
    iccp_free(&extension->memory, extension->needed);
    *extension = (iccp_extension){.memory = extension->memory};
}
