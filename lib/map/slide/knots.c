/* Makes, copies, counts, reads and writes the knots of chains. */
#include "map/slide/knots.h"

#include <string.h>

icc_status iccp_slide_begin(iccp_slide **out, const icc_domain *source, const icc_domain *target,
                            size_t n_knots, const iccp_memory *memory)
{
    iccp_slide *s = *out = iccp_alloc_zero(memory, 1, sizeof *s);
    if (s == NULL)
        return ICC_ERR_MEMORY;
    s->memory = *memory;
    s->given[0] = iccp_domain_retain(source);
    s->given[1] = iccp_domain_retain(target);
    const icc_status status = iccp_chains_create(&s->chains, source, memory);
    if (status == ICC_OK) {
        s->first = iccp_alloc_zero(memory, s->chains.n + 1, sizeof *s->first);
        s->knot = iccp_alloc(memory, n_knots, sizeof *s->knot);
    }
    if (s->first != NULL && s->knot != NULL)
        return ICC_OK;
    iccp_slide_free(s);
    *out = NULL;
    return ICC_ERR_MEMORY;
}

icc_status iccp_slide_create(iccp_slide **out, const icc_domain *source, const icc_domain *target,
                             const iccp_memory *memory)
{
    const size_t n_sides = iccp_network_of(source)->n_sides;
    const icc_status status = iccp_slide_begin(out, source, target, 2 * n_sides, memory);
    iccp_slide *s = *out;
    size_t n = 0;
    for (size_t c = 0; status == ICC_OK && c < s->chains.n; ++c) {
        const uint32_t n_own = (uint32_t)(s->chains.first[c + 1] - s->chains.first[c]);
        for (uint32_t k = 0; k <= n_own; ++k)
            s->knot[n++] = (iccp_knot){.at = {k, k}};
        s->first[c + 1] = n;
    }
    return status;
}

icc_status iccp_slide_copy(iccp_slide **out, const iccp_slide *slide, const icc_domain *target,
                           const iccp_memory *memory)
{
    const size_t n = slide->first[slide->chains.n];
    const icc_status status = iccp_slide_begin(out, slide->given[0], target, n, memory);
    if (status == ICC_OK) {
        memcpy((*out)->first, slide->first, (slide->chains.n + 1) * sizeof *slide->first);
        memcpy((*out)->knot, slide->knot, n * sizeof *slide->knot);
    }
    return status;
}

void iccp_slide_free(iccp_slide *slide)
{
    if (slide == NULL)
        return;
    const iccp_memory memory = slide->memory;
    iccp_domain_release(slide->given[0]);
    iccp_domain_release(slide->given[1]);
    iccp_chains_free(&slide->chains);
    iccp_free(&memory, slide->first);
    iccp_free(&memory, slide->knot);
    iccp_free(&memory, slide);
}

size_t iccp_slide_count(const iccp_slide *slide)
{
    size_t n = 0;
    for (size_t k = 0; k < slide->first[slide->chains.n]; ++k)
        n += iccp_knot_is_corner(&slide->knot[k], 0) && !iccp_knot_stays(&slide->knot[k]);
    return n;
}

/* ---- bytes ---- */

static void visit_knot(iccp_blob *b, iccp_knot *knot)
{
    iccp_blob_u32(b, 2, knot->at);
    iccp_blob_f64(b, 2, knot->along);
}

/* Whether places grow from one knot to the next, and no corner is left out. */
static bool follows(const iccp_knot *a, const iccp_knot *b)
{
    bool is = iccp_knot_is_corner(b, 0) || iccp_knot_is_corner(b, 1);
    for (int side = 0; side < 2; ++side)
        is &= b->along[side] >= 0 && b->along[side] < 1 &&
              (iccp_knot_is_corner(b, side)
                   ? b->at[side] == a->at[side] + 1
                   : b->at[side] == a->at[side] && b->along[side] > a->along[side]);
    return is;
}

/* Reads or writes the knots of a chain of n sides between its stops. */
static void visit_chain(iccp_blob *b, iccp_slide *s, size_t c)
{
    const uint32_t n_sides = (uint32_t)(s->chains.first[c + 1] - s->chains.first[c]);
    size_t n = b->reads ? 0 : s->first[c + 1] - s->first[c] - 2, first = s->first[c];
    iccp_blob_size(b, &n);
    iccp_blob_require(b, n <= 2 * (size_t)(n_sides - 1));
    if (b->status != ICC_OK)
        return;
    if (b->reads) {
        s->knot[first] = (iccp_knot){.at = {0, 0}};
        s->knot[first + n + 1] = (iccp_knot){.at = {n_sides, n_sides}};
        s->first[c + 1] = first + n + 2;
    }
    for (size_t k = 1; k <= n && b->status == ICC_OK; ++k)
        visit_knot(b, &s->knot[first + k]);
    for (size_t k = 1; k <= n + 1 && b->status == ICC_OK; ++k)
        iccp_blob_require(b, follows(&s->knot[first + k - 1], &s->knot[first + k]));
}

icc_status iccp_slide_visit(iccp_blob *b, iccp_slide **slide, const icc_domain *source,
                            const icc_domain *target, const iccp_memory *memory)
{
    const size_t n_sides = iccp_network_of(source)->n_sides;
    const icc_status status =
        b->reads ? iccp_slide_begin(slide, source, target, 2 * n_sides, memory) : ICC_OK;
    if (status != ICC_OK)
        return status;
    for (size_t c = 0; c < (*slide)->chains.n && b->status == ICC_OK; ++c)
        visit_chain(b, *slide, c);
    if (b->status != ICC_OK && b->reads) {
        iccp_slide_free(*slide);
        *slide = NULL;
    }
    return b->status;
}
