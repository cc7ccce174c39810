/* Samples on lines. Lines are followed from fork to fork. Corners on the way become samples if they
 * are not too near each other. The rest is divided evenly by arc length (thesis, section 6.2.1:
 * "the sampling period is approximately equal for distinct edges"). */
#include "kernel/sampling/boundary_samples.h"

#include "base/minmax.h"

#include <math.h>

/* In spacings: corners nearer to each other along the line share a sample. */
static const double CORNER_GAP = 0.75;

typedef struct sampler {
    iccp_segment_graph graph;
    double spacing;
    bool *followed; /* by segment */
    bool *sampled;  /* by vertex */
    uint32_t *line; /* vertices of the current line */
    double *arc;    /* their arc length from its start */
    size_t n_line;
} sampler;

static bool is_corner(const iccp_segment_graph *graph, uint32_t a, uint32_t v, uint32_t b)
{
    const double *p = iccp_segment_graph_vertex(graph, a), *q = iccp_segment_graph_vertex(graph, v);
    const double *r = iccp_segment_graph_vertex(graph, b);
    double dot = 0;
    for (size_t k = 0; k < graph->dim; ++k)
        dot += (q[k] - p[k]) * (r[k] - q[k]);
    return dot < ICCP_SHARP_COSINE * iccp_segment_graph_length(graph, a, v) *
                     iccp_segment_graph_length(graph, v, b);
}

/* Returns true if a line passes through the vertex: it has two segments and no corner. */
static bool is_smooth(const iccp_segment_graph *graph, uint32_t v)
{
    if (iccp_segment_graph_degree(graph, v) != 2)
        return false;
    const uint32_t *at = graph->incident + graph->first[v];
    return !is_corner(graph, iccp_segment_graph_other_end(graph, at[0], v), v,
                      iccp_segment_graph_other_end(graph, at[1], v));
}

/* Follows the line from a vertex along a segment, to a vertex where lines end or back to the
 * start. */
static void follow_line(sampler *r, uint32_t v, uint32_t segment)
{
    const uint32_t start = v;
    r->n_line = 0;
    r->line[r->n_line] = v;
    r->arc[r->n_line++] = 0;
    for (;;) {
        const uint32_t next = iccp_segment_graph_other_end(&r->graph, segment, v);
        r->followed[segment] = true;
        r->arc[r->n_line] = r->arc[r->n_line - 1] + iccp_segment_graph_length(&r->graph, v, next);
        r->line[r->n_line++] = next;
        v = next;
        if (v == start || iccp_segment_graph_degree(&r->graph, v) != 2)
            return;
        const uint32_t *at = r->graph.incident + r->graph.first[v];
        segment = at[0] == segment ? at[1] : at[0];
    }
}

static void add_vertex(sampler *r, uint32_t v, iccp_point_list *list)
{
    if (!r->sampled[v])
        iccp_point_list_add(list, iccp_segment_graph_vertex(&r->graph, v));
    r->sampled[v] = true;
}

/* Adds even samples between the stations at positions i and j of the line. */
static void divide(const sampler *r, size_t i, size_t j, iccp_point_list *list)
{
    const double whole = r->arc[j] - r->arc[i];
    const double n = iccp_max(1, floor(whole / r->spacing + 0.5));
    size_t at = i;
    for (double k = 1; k < n && !list->failed; ++k) {
        const double arc = r->arc[i] + whole * (k / n);
        double point[3];
        while (at + 1 < j && r->arc[at + 1] < arc)
            ++at;
        const double *a = iccp_segment_graph_vertex(&r->graph, r->line[at]);
        const double *b = iccp_segment_graph_vertex(&r->graph, r->line[at + 1]);
        const double t = (arc - r->arc[at]) / (r->arc[at + 1] - r->arc[at]);
        for (size_t c = 0; c < r->graph.dim; ++c)
            point[c] = a[c] + t * (b[c] - a[c]);
        iccp_point_list_add(list, point);
    }
}

/* Finds the stations of the current line: its ends, and corners that are not too near to them or to
 * each other. With `between` it adds the samples between stations, else the stations. */
static void sample_line(sampler *r, bool between, iccp_point_list *list)
{
    const size_t last = r->n_line - 1;
    const double gap = CORNER_GAP * r->spacing;
    size_t from = 0;
    if (!between)
        add_vertex(r, r->line[0], list);
    for (size_t i = 1; i <= last; ++i) {
        const bool end = i == last;
        if (!end && (r->arc[i] - r->arc[from] < gap || r->arc[last] - r->arc[i] < gap ||
                     !is_corner(&r->graph, r->line[i - 1], r->line[i], r->line[i + 1])))
            continue;
        if (between)
            divide(r, from, i, list);
        else
            add_vertex(r, r->line[i], list);
        from = i;
    }
}

/* Samples the lines from forks and ends first. The remaining lines are closed; they start at a
 * corner if there is one. */
static void sample_lines(sampler *r, bool between, iccp_point_list *list)
{
    for (size_t s = 0; s < r->graph.n_segments; ++s)
        r->followed[s] = false;
    for (int pass = 0; pass < 3; ++pass)
        for (uint32_t v = 0; v < r->graph.n_vertices; ++v) {
            if ((pass == 0 && iccp_segment_graph_degree(&r->graph, v) == 2) ||
                (pass == 1 && is_smooth(&r->graph, v)))
                continue;
            for (uint32_t i = r->graph.first[v]; i < r->graph.first[v + 1]; ++i)
                if (!r->followed[r->graph.incident[i]]) {
                    follow_line(r, v, r->graph.incident[i]);
                    sample_line(r, between, list);
                }
        }
}

icc_status iccp_segments_sample(iccp_point_list *list, const double *vertices, size_t n_vertices,
                                size_t n_segments, const uint32_t *segments, double spacing,
                                const iccp_env *env)
{
    const iccp_memory *memory = &env->memory;
    sampler r = {.spacing = spacing};
    icc_status status = iccp_segment_graph_create(&r.graph, list->dim, n_vertices, vertices,
                                                  n_segments, segments, memory);
    r.followed = iccp_alloc(memory, n_segments, sizeof *r.followed);
    r.sampled = iccp_alloc_zero(memory, n_vertices, sizeof *r.sampled);
    r.line = iccp_alloc(memory, n_segments + 1, sizeof *r.line);
    r.arc = iccp_alloc(memory, n_segments + 1, sizeof *r.arc);
    if (r.followed == NULL || r.sampled == NULL || r.line == NULL || r.arc == NULL)
        status = ICC_ERR_MEMORY;
    if (status == ICC_OK) {
        sample_lines(&r, false, list);
        sample_lines(&r, true, list);
    }
    iccp_segment_graph_free(&r.graph);
    iccp_free(memory, r.followed);
    iccp_free(memory, r.sampled);
    iccp_free(memory, r.line);
    iccp_free(memory, r.arc);
    return status == ICC_OK && list->failed ? ICC_ERR_MEMORY : status;
}
