/* Makes a coverage: cleans both layers, pairs nodes and borders, then the vertices along the
 * borders, and puts the rings together. */
#include "match/coverage/coverage_object.h"

#include "base/error.h"
#include "base/sort.h"
#include "domain/features.h"
#include "match/coverage/border_vertices.h"
#include "match/coverage/coverage_features.h"
#include "match/coverage/leave_out.h"
#include "math/elementary.h"

#include <inttypes.h>
#include <math.h>
#include <stdio.h>

void iccp_coverage_release(icc_coverage *coverage)
{
    if (coverage == NULL)
        return;
    const iccp_memory memory = coverage->memory;
    for (int e = 0; e < 2; ++e) {
        iccp_domain_release(coverage->domain[e]);
        iccp_free(&memory, coverage->feature[e]);
        iccp_free(&memory, coverage->point[e]);
    }
    iccp_free(&memory, coverage->id);
    iccp_free(&memory, coverage->difference);
    iccp_free(&memory, coverage);
}

typedef struct making {
    icc_coverage *coverage;
    const icc_layer *given[2];
    const icc_coverage_options *options;
    iccp_regions regions;
    iccp_layer layer[2];
    iccp_layer_graph graph[2];
    iccp_layer_rings rings[2];
    iccp_layer_pairing pairing;
    iccp_kept kept;
    iccp_border_vertices vertices;
} making;

static void clear(making *m, const iccp_memory *memory)
{
    iccp_border_vertices_free(&m->vertices, memory);
    iccp_kept_free(&m->kept, memory);
    iccp_layer_pairing_free(&m->pairing, memory);
    for (int e = 0; e < 2; ++e) {
        iccp_layer_rings_free(&m->rings[e], memory);
        iccp_layer_graph_free(&m->graph[e], memory);
        iccp_layer_free(&m->layer[e], memory);
    }
    iccp_free(memory, m->regions.id);
}

static int by_number(const void *a, const void *b)
{
    const int64_t x = *(const int64_t *)a, y = *(const int64_t *)b;
    return x < y ? -1 : x > y;
}

/* A region of one layer. */
typedef struct region {
    int64_t id;
    size_t ring; /* the first one */
} region;

static int by_id(const void *a, const void *b)
{
    const region *const p = a, *const q = b;
    return p->id != q->id ? by_number(&p->id, &q->id) : p->ring < q->ring ? -1 : p->ring > q->ring;
}

/* Lists the regions of a layer in the order of their numbers. Returns how many there are. */
static size_t list_regions(region *out, const icc_layer *layer, const iccp_regions *left_out)
{
    size_t n = 0, kept = 0;
    for (size_t r = 0; r < layer->n_rings; ++r)
        if (iccp_regions_find(left_out, layer->ids[r]) == ICCP_NO_REGION)
            out[n++] = (region){layer->ids[r], r};
    iccp_sort(out, n, sizeof *out, by_id);
    for (size_t k = 0; k < n; ++k)
        if (k == 0 || out[k].id != out[k - 1].id)
            out[kept++] = out[k];
    return kept;
}

/* Adds a region that only layer e has to the differences. */
static void add_region(making *m, const region *only, size_t e)
{
    icc_coverage_difference *const d = &m->coverage->difference[m->coverage->info.n_differences++];
    const icc_layer *const given = m->given[e];
    *d = (icc_coverage_difference){.size = sizeof *d,
                                   .kind = ICC_DIFFERENCE_REGION,
                                   .side = (int32_t)e + 1,
                                   .n_ids = 1,
                                   .ids = {only->id, 0}};
    memcpy(d->place, given->vertices + 2 * given->first[only->ring], sizeof d->place);
}

/* Goes through the regions of both layers side by side. */
static void compare_regions(making *m, const region *const *list, const size_t *n)
{
    size_t at[2] = {0, 0};
    while (at[0] < n[0] || at[1] < n[1]) {
        const region *const a = list[0] + at[0], *const b = list[1] + at[1];
        const bool is_source = at[0] < n[0] && (at[1] == n[1] || a->id <= b->id);
        const bool is_target = at[1] < n[1] && (at[0] == n[0] || b->id <= a->id);
        if (is_source && is_target)
            m->regions.id[m->regions.n++] = a->id;
        else
            add_region(m, is_source ? a : b, is_source ? 0 : 1);
        at[0] += is_source;
        at[1] += is_target;
    }
}

/* Finds the regions that both layers have. */
static icc_status find_regions(making *m, const iccp_memory *memory)
{
    const size_t n_rings[2] = {m->given[0]->n_rings, m->given[1]->n_rings};
    const size_t most = n_rings[0] + n_rings[1];
    iccp_regions left_out = {.n = m->options->n_left_out};
    region *const list[2] = {iccp_alloc(memory, n_rings[0], sizeof *list[0]),
                             iccp_alloc(memory, n_rings[1], sizeof *list[1])};
    left_out.id = iccp_alloc(memory, left_out.n, sizeof *left_out.id);
    m->regions.id = iccp_alloc(memory, most, sizeof *m->regions.id);
    m->coverage->difference = iccp_alloc(memory, most, sizeof *m->coverage->difference);
    const bool has_all = list[0] != NULL && list[1] != NULL && left_out.id != NULL &&
                         m->regions.id != NULL && m->coverage->difference != NULL;
    if (has_all) {
        for (size_t k = 0; k < left_out.n; ++k)
            left_out.id[k] = m->options->left_out[k];
        iccp_sort(left_out.id, left_out.n, sizeof *left_out.id, by_number);
        const size_t n[2] = {list_regions(list[0], m->given[0], &left_out),
                             list_regions(list[1], m->given[1], &left_out)};
        compare_regions(m, (const region *const[]){list[0], list[1]}, n);
    }
    iccp_free(memory, list[0]);
    iccp_free(memory, list[1]);
    iccp_free(memory, left_out.id);
    return has_all ? ICC_OK : ICC_ERR_MEMORY;
}

/* Lists borders without partners behind the regions that one layer lacks. */
static icc_status find_borders(making *m, const iccp_memory *memory)
{
    icc_coverage *const coverage = m->coverage;
    const size_t before = coverage->info.n_differences;
    size_t n = before;
    for (int e = 0; e < 2; ++e)
        n += iccp_borders_alone(NULL, 0, &m->pairing, e);
    if (!iccp_enlarge(memory, &coverage->difference, before, n, sizeof *coverage->difference))
        return ICC_ERR_MEMORY;
    for (int e = 0; e < 2; ++e)
        coverage->info.n_differences += iccp_borders_alone(
            coverage->difference + coverage->info.n_differences, n, &m->pairing, e);
    return ICC_OK;
}

/* Returns the distance between the ends of a border, in the caller's coordinates. */
static double distance_of_ends(const iccp_layer_graph *graph, const iccp_border *border)
{
    double end[2][2];
    iccp_layer_given(graph->layer, graph->at[border->first], end[0]);
    iccp_layer_given(graph->layer, graph->at[border->first + border->n], end[1]);
    return iccp_hypot(end[1][0] - end[0][0], end[1][1] - end[0][1]);
}

/* Chooses the difference that says most: a region if there is one, else the border whose ends are
 * nearest. Such a border is often the cause of the others: the other layer has one node instead, so
 * all borders that end there differ. Regions come first in the list, then borders in this order. */
static size_t choose_difference(const making *m, double *distance)
{
    size_t best = 0, k = 0;
    *distance = HUGE_VAL;
    if (m->coverage->difference[0].kind == ICC_DIFFERENCE_REGION)
        return 0;
    for (int e = 0; e < 2; ++e) {
        const iccp_layer_graph *const graph = m->pairing.graph[e];
        const uint32_t *const partner = e == 0 ? m->pairing.border : m->pairing.back;
        for (size_t b = 0; b < graph->n_borders; ++b) {
            if (partner[b] != UINT32_MAX)
                continue;
            const iccp_border *const border = &graph->border[b];
            const double d = border->is_island ? HUGE_VAL : distance_of_ends(graph, border);
            best = d < *distance ? k : best;
            *distance = d < *distance ? d : *distance;
            ++k;
        }
    }
    return best;
}

/* Fails with the difference that says most, unless differences are left out. The message names
 * remedies: a border whose ends are welded to each other vanishes. */
static icc_status refuse(const making *m, icc_error *err)
{
    const size_t n = m->coverage->info.n_differences;
    char more[64] = "", remedy[96] = "leave it out";
    double distance;
    if (n == 0 || m->options->unmatched == ICC_UNMATCHED_LEAVE_OUT)
        return ICC_OK;
    const icc_coverage_difference *const d =
        &m->coverage->difference[choose_difference(m, &distance)];
    const char *const layer = d->side == 1 ? "source" : "target";
    if (n > 1)
        snprintf(more, sizeof more, " (and %zu more difference%s)", n - 1, n == 2 ? "" : "s");
    if (d->kind == ICC_DIFFERENCE_BORDER)
        snprintf(remedy, sizeof remedy, "leave it out, or weld its ends, which are %.6g apart",
                 distance);
    if (d->kind == ICC_DIFFERENCE_REGION)
        return iccp_fail(err, ICC_ERR_TOPOLOGY,
                         "region %" PRId64 ", near (%.6g, %.6g), is in the %s only%s: %s",
                         d->ids[0], d->place[0], d->place[1], layer, more, remedy);
    if (d->n_ids == 1)
        return iccp_fail(err, ICC_ERR_TOPOLOGY,
                         "%s of region %" PRId64 " near (%.6g, %.6g) is in the %s only%s: %s",
                         d->kind == ICC_DIFFERENCE_ISLAND ? "the closed border"
                                                          : "the outer border",
                         d->ids[0], d->place[0], d->place[1], layer, more, remedy);
    return iccp_fail(err, ICC_ERR_TOPOLOGY,
                     "the border of regions %" PRId64 " and %" PRId64
                     " near (%.6g, %.6g) is in the %s only%s: %s",
                     d->ids[0], d->ids[1], d->place[0], d->place[1], layer, more, remedy);
}

/* Cleans one layer, and finds its nodes, borders and rings. */
static icc_status clean(making *m, size_t e, const iccp_env *env, icc_error *err)
{
    iccp_layer *const layer = &m->layer[e];
    iccp_env parts[4];
    iccp_split(parts, 4, (const double[]){2, 2, 1, 1}, env);
    icc_status status =
        iccp_layer_read(layer, m->given[e], &m->regions, m->options->weld[e], env, err);
    if (status == ICC_OK)
        status = iccp_explain(err, iccp_layer_weld(layer, &parts[0]));
    if (status == ICC_OK)
        status = iccp_explain(err, iccp_layer_insert(layer, &parts[1]));
    if (status == ICC_OK)
        status = iccp_layer_join(layer, env, err);
    if (status == ICC_OK && layer->n_sides == 0)
        status = iccp_fail(err, ICC_ERR_TOPOLOGY, "no region has an area: is the weld too long?");
    if (status == ICC_OK)
        status = iccp_explain(err, iccp_layer_measure(layer, &parts[2]));
    if (status == ICC_OK)
        status = iccp_layer_graph_create(&m->graph[e], layer, &parts[3], err);
    if (status == ICC_OK)
        status = iccp_explain(err, iccp_layer_rings_create(&m->rings[e], &m->graph[e], env));
    return status == ICC_OK ? status : iccp_fail_side(err, status, (int32_t)e + 1);
}

/* Writes what was done to a layer into the info, in the caller's coordinates. */
static void describe(icc_coverage_info *info, const iccp_layer *layer, size_t e)
{
    const double scale = layer->frame.out[0] * layer->frame.out[1];
    info->n_given[e] = layer->n_given;
    info->n_welded[e] = layer->n_welded;
    info->n_inserted[e] = layer->n_inserted;
    info->n_chains[e] = layer->n_chains;
    info->most_moved[e] = scale * layer->most_moved;
    info->least_apart[e] = scale * layer->least_apart;
    if (layer->n_chains > 0)
        iccp_frame_restore(&layer->frame, 2, layer->chain, info->chain + 2 * e);
    if (layer->least_apart < HUGE_VAL)
        iccp_frame_restore(&layer->frame, 2, layer->least_apart_at, info->least_apart_at + 2 * e);
}

/* Counts the regions that one layer has and the coverage does not have as a whole. */
static void count_left_out(making *m)
{
    icc_coverage_info *const info = &m->coverage->info;
    const iccp_layer_rings *const rings = &m->rings[0];
    for (size_t k = 0; k < info->n_differences; ++k)
        info->n_left_out += m->coverage->difference[k].kind == ICC_DIFFERENCE_REGION;
    for (size_t r = 0, end; r < rings->n; r = end) {
        bool is_whole = true;
        for (end = r; end < rings->n && rings->ring[end].region == rings->ring[r].region; ++end)
            is_whole = is_whole && m->kept.ring[end];
        info->n_left_out += !is_whole;
    }
}

/* Returns what follows the word in a text that begins with it, or NULL. */
static const char *skip(const char *text, const char *word)
{
    for (; *word != '\0'; ++word, ++text)
        if (*text != *word)
            return NULL;
    return text;
}

/* Reads the number after the word "feature ". Returns what follows it, or NULL. */
static const char *read_feature(const char *text, size_t *feature)
{
    text = skip(text, "feature ");
    if (text == NULL || *text < '0' || *text > '9')
        return NULL;
    for (*feature = 0; *text >= '0' && *text <= '9'; ++text)
        *feature = 10 * *feature + (size_t)(*text - '0');
    return text;
}

/* Copies a message of the domain, with regions instead of features: "feature 3 (a region)" becomes
 * "region 17". */
static void name_regions(char *out, size_t room, const icc_coverage *coverage, const char *message)
{
    size_t n = 0;
    while (*message != '\0' && n + 1 < room) {
        size_t f = 0;
        const char *const end = read_feature(message, &f);
        if (end != NULL && f < coverage->n_features) {
            const int used = snprintf(out + n, room - n, "region %" PRId64, coverage->id[f]);
            n = n + (size_t)used < room ? n + (size_t)used : room - 1;
            const char *const kind = skip(end, " (a region)");
            message = kind != NULL ? kind : end;
        } else
            out[n++] = *message++;
    }
    out[n] = '\0';
}

/* Makes the two domains. */
static icc_status make_domains(icc_coverage *coverage, const iccp_env *env, icc_error *err)
{
    for (int e = 0; e < 2; ++e) {
        icc_error own = {.size = sizeof own, .index = -1};
        char text[sizeof own.message];
        const icc_status status = iccp_domain_create_features(
            &coverage->domain[e], 0, NULL, coverage->n_features, coverage->feature[e], env, &own);
        if (status == ICC_OK)
            continue;
        name_regions(text, sizeof text, coverage, own.message);
        iccp_fail(err, status, "%s", text);
        return iccp_fail_side(err, status, e + 1);
    }
    return ICC_OK;
}

static icc_status pair_layers(making *m, const iccp_env *env, icc_error *err)
{
    icc_status status =
        iccp_explain(err, iccp_layer_pairing_create(&m->pairing, &m->graph[0], &m->graph[1], env));
    if (status == ICC_OK)
        status = iccp_explain(err, find_borders(m, &env->memory));
    if (status == ICC_OK)
        status = refuse(m, err);
    if (status == ICC_OK)
        status = iccp_explain(err, iccp_kept_find(&m->kept, &m->pairing, m->rings, env));
    if (status == ICC_OK && m->kept.n_rings == 0)
        status = iccp_fail(err, ICC_ERR_TOPOLOGY,
                           "nothing is left: no region has the same borders in both layers; "
                           "a longer weld may help");
    return status;
}

static icc_status run(making *m, const iccp_env *env, icc_error *err)
{
    icc_coverage *const coverage = m->coverage;
    iccp_env parts[5];
    iccp_split(parts, 5, (const double[]){1, 1, 1, 10, 2}, env);
    for (int k = 0; k < 4; ++k)
        parts[k].stage = k < 2 ? "check" : "match";
    icc_status status = iccp_explain(err, find_regions(m, &env->memory));
    if (status == ICC_OK)
        status = refuse(m, err);
    if (status == ICC_OK && m->regions.n == 0)
        status =
            iccp_fail(err, ICC_ERR_TOPOLOGY, "no region is in both layers: do their ids agree?");
    for (size_t e = 0; e < 2 && status == ICC_OK; ++e) {
        status = clean(m, e, &parts[e], err);
        describe(&coverage->info, &m->layer[e], e);
    }
    if (status == ICC_OK)
        status = pair_layers(m, &parts[2], err);
    if (status == ICC_OK)
        status = iccp_explain(
            err, iccp_border_vertices_create(&m->vertices, &m->pairing, m->kept.border,
                                             m->options->between == ICC_BETWEEN_ARC, &parts[3]));
    if (status == ICC_OK)
        status = iccp_explain(err, iccp_coverage_features(coverage, &m->rings[0], &m->kept,
                                                          &m->vertices, &env->memory));
    if (status == ICC_OK)
        status = make_domains(coverage, &parts[4], err);
    if (status == ICC_OK) {
        coverage->info.n_settled = m->pairing.n_settled;
        count_left_out(m);
    }
    return status;
}

icc_status iccp_coverage_create(icc_coverage **out, const icc_layer *source,
                                const icc_layer *target, const icc_coverage_options *options,
                                const iccp_env *env, icc_error *err)
{
    making m = {.given = {source, target}, .options = options};
    m.coverage = iccp_alloc_zero(&env->memory, 1, sizeof *m.coverage);
    if (m.coverage == NULL)
        return iccp_fail_memory(err);
    m.coverage->memory = env->memory;
    const icc_status status = run(&m, env, err);
    clear(&m, &env->memory);
    if (status == ICC_OK)
        *out = m.coverage;
    else
        iccp_coverage_release(m.coverage);
    return status;
}
