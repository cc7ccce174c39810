/* Lines are followed from fork to fork. Corners on the way are samples if they are not too near
 * each other, and the rest is divided evenly by arc length (thesis, section 6.2.1: "the sampling
 * period is approximately equal for distinct edges"). */
#include "kernel/rims.h"

#include <math.h>

/* A turn beyond this is a corner: 30 degrees, so that circles of 13 vertices and more are round. */
static const double CORNER_COSINE = 0.86602540378443865;
/* Of the spacing: corners nearer to each other along the line share a sample. */
static const double CORNER_GAP = 0.75;

typedef struct rims {
    iccp_web web;
    double spacing;
    bool *followed; /* of each segment */
    bool *sampled;  /* of each vertex */
    uint32_t *line; /* the vertices of the line at hand */
    double *arc;    /* and how far along it they are */
    size_t n_line;
} rims;

static bool is_corner(const iccp_web *web, uint32_t a, uint32_t v, uint32_t b)
{
    const double *p = iccp_web_vertex(web, a), *q = iccp_web_vertex(web, v);
    const double *r = iccp_web_vertex(web, b);
    double dot = 0;
    for (size_t k = 0; k < web->dim; ++k)
        dot += (q[k] - p[k]) * (r[k] - q[k]);
    return dot < CORNER_COSINE * iccp_web_length(web, a, v) * iccp_web_length(web, v, b);
}

/* Whether a line passes through: two segments, without a corner. */
static bool is_smooth(const iccp_web *web, uint32_t v)
{
    if (iccp_web_degree(web, v) != 2)
        return false;
    const uint32_t *at = web->incident + web->first[v];
    return !is_corner(web, iccp_web_other_end(web, at[0], v), v, iccp_web_other_end(web, at[1], v));
}

/* The line from a vertex along a segment, up to a vertex that is not passed through or back to the
 * start. */
static void follow(rims *r, uint32_t v, uint32_t segment)
{
    const uint32_t start = v;
    r->n_line = 0;
    r->line[r->n_line] = v;
    r->arc[r->n_line++] = 0;
    for (;;) {
        const uint32_t next = iccp_web_other_end(&r->web, segment, v);
        r->followed[segment] = true;
        r->arc[r->n_line] = r->arc[r->n_line - 1] + iccp_web_length(&r->web, v, next);
        r->line[r->n_line++] = next;
        v = next;
        if (v == start || iccp_web_degree(&r->web, v) != 2)
            return;
        const uint32_t *at = r->web.incident + r->web.first[v];
        segment = at[0] == segment ? at[1] : at[0];
        if (r->followed[segment])
            return;
    }
}

static void add_vertex(rims *r, uint32_t v, iccp_places *places)
{
    if (!r->sampled[v])
        iccp_places_add(places, iccp_web_vertex(&r->web, v));
    r->sampled[v] = true;
}

/* Evenly between the stations at positions i and j of the line. */
static void divide(const rims *r, size_t i, size_t j, iccp_places *places)
{
    const double whole = r->arc[j] - r->arc[i];
    const double n = fmax(1, floor(whole / r->spacing + 0.5));
    size_t at = i;
    for (double k = 1; k < n && !places->failed; ++k) {
        const double arc = r->arc[i] + whole * (k / n);
        double point[3];
        while (at + 1 < j && r->arc[at + 1] < arc)
            ++at;
        const double *a = iccp_web_vertex(&r->web, r->line[at]);
        const double *b = iccp_web_vertex(&r->web, r->line[at + 1]);
        const double t = (arc - r->arc[at]) / (r->arc[at + 1] - r->arc[at]);
        for (size_t c = 0; c < r->web.dim; ++c)
            point[c] = a[c] + t * (b[c] - a[c]);
        iccp_places_add(places, point);
    }
}

/* Stations of the line at hand: its ends, and corners that are not too near them or each other.
 * With `between`, the samples between stations, else the stations. */
static void sample_line(rims *r, bool between, iccp_places *places)
{
    const size_t last = r->n_line - 1;
    const double gap = CORNER_GAP * r->spacing;
    size_t from = 0;
    if (!between)
        add_vertex(r, r->line[0], places);
    for (size_t i = 1; i <= last; ++i) {
        const bool end = i == last;
        if (!end && (r->arc[i] - r->arc[from] < gap || r->arc[last] - r->arc[i] < gap ||
                     !is_corner(&r->web, r->line[i - 1], r->line[i], r->line[i + 1])))
            continue;
        if (between)
            divide(r, from, i, places);
        else
            add_vertex(r, r->line[i], places);
        from = i;
    }
}

/* Lines from forks and ends first; what is left then are closed ones, from a corner if there is
 * one. */
static void sample_lines(rims *r, bool between, iccp_places *places)
{
    for (size_t s = 0; s < r->web.n_segments; ++s)
        r->followed[s] = false;
    for (int pass = 0; pass < 3; ++pass)
        for (uint32_t v = 0; v < r->web.n_vertices; ++v) {
            if ((pass == 0 && iccp_web_degree(&r->web, v) == 2) ||
                (pass == 1 && is_smooth(&r->web, v)))
                continue;
            for (uint32_t i = r->web.first[v]; i < r->web.first[v + 1]; ++i)
                if (!r->followed[r->web.incident[i]]) {
                    follow(r, v, r->web.incident[i]);
                    sample_line(r, between, places);
                }
        }
}

icc_status iccp_rims_sample(iccp_places *places, const double *vertices, size_t n_vertices,
                            size_t n_segments, const uint32_t *segments, double spacing,
                            const iccp_env *env)
{
    const iccp_memory *memory = &env->memory;
    rims r = {.spacing = spacing};
    icc_status status =
        iccp_web_create(&r.web, places->dim, n_vertices, vertices, n_segments, segments, memory);
    r.followed = iccp_alloc(memory, n_segments, sizeof *r.followed);
    r.sampled = iccp_alloc_zero(memory, n_vertices, sizeof *r.sampled);
    r.line = iccp_alloc(memory, n_segments + 1, sizeof *r.line);
    r.arc = iccp_alloc(memory, n_segments + 1, sizeof *r.arc);
    if (r.followed == NULL || r.sampled == NULL || r.line == NULL || r.arc == NULL)
        status = ICC_ERR_MEMORY;
    if (status == ICC_OK) {
        sample_lines(&r, false, places);
        sample_lines(&r, true, places);
    }
    iccp_web_free(&r.web);
    iccp_free(memory, r.followed);
    iccp_free(memory, r.sampled);
    iccp_free(memory, r.line);
    iccp_free(memory, r.arc);
    return status == ICC_OK && places->failed ? ICC_ERR_MEMORY : status;
}
