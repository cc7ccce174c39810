/* Compares two solids and says why they have no map. */
#include "map/topology/no_map.h"

#include "base/error.h"
#include "domain/features_check.h"
#include "fill/filled_pair.h"
#include "map/topology/witness_loop.h"

#include <stdio.h>
#include <string.h>

/* ---- comparison ---- */

/* Copies what the witness knows. */
static icc_status describe(iccp_bad_loop *loop, const iccp_witness *witness, iccp_region_pair *pair)
{
    loop->inside = witness->inside;
    loop->surface = pair->surface.root[witness->component];
    loop->partners = iccp_alloc(&loop->memory, witness->n_partners, sizeof *loop->partners);
    if (loop->partners == NULL)
        return ICC_ERR_MEMORY;
    loop->n_partners = witness->n_partners;
    for (size_t i = 0; i < witness->n_partners; ++i)
        loop->partners[i] = pair->surface.root[witness->partners[i]];
    return iccp_witness_draw(&loop->vertices, &loop->n, witness, pair);
}

static icc_status compare_region(iccp_bad_loop *loop, bool *exists, const iccp_region regions[2],
                                 const iccp_env *env, icc_error *err)
{
    iccp_region_pair pair;
    iccp_witness witness;
    icc_status status = iccp_region_pair_create(&pair, regions, env, err);
    if (status != ICC_OK)
        return status;
    status = iccp_witness_find(&witness, &pair);
    if (status == ICC_OK && witness.exists) {
        *exists = true;
        status = describe(loop, &witness, &pair);
    }
    iccp_witness_free(&witness);
    iccp_region_pair_free(&pair);
    return iccp_explain(err, status);
}

static uint32_t count_regions(const iccp_simplices *mesh)
{
    uint32_t most = 0;
    for (size_t s = 0; mesh->region != NULL && s < mesh->n_simplices; ++s)
        most = mesh->region[s] > most ? mesh->region[s] : most;
    return most + 1;
}

icc_status iccp_bad_loop_find(iccp_bad_loop *loop, bool *exists, const iccp_simplices *source,
                              const iccp_simplices *target, const iccp_env *env, icc_error *err)
{
    const uint32_t n = count_regions(source);
    icc_status status = ICC_OK;
    *loop = (iccp_bad_loop){.memory = env->memory};
    *exists = false;
    for (uint32_t r = 0; r < n && status == ICC_OK && !*exists; ++r) {
        const iccp_region regions[2] = {{source, r}, {target, r}};
        const iccp_env part = iccp_part(env, "check", r / (double)n, (r + 1) / (double)n);
        loop->region = r;
        status = compare_region(loop, exists, regions, &part, err);
    }
    if (status != ICC_OK)
        iccp_bad_loop_free(loop);
    return status;
}

void iccp_bad_loop_free(iccp_bad_loop *loop)
{
    const iccp_memory memory = loop->memory;
    iccp_free(&memory, loop->vertices);
    iccp_free(&memory, loop->partners);
    *loop = (iccp_bad_loop){.memory = memory};
}

/* ---- message ---- */

/* Room for the numbers of the vertices in the message. */
enum { LIST_TEXT = 64 };

/* Returns the name of the surface that a vertex belongs to. */
static const char *name_surface(const icc_domain *domain, uint32_t vertex, char *text)
{
    const iccp_features *features = domain->features;
    return features != NULL
               ? iccp_feature_text(features, iccp_feature_of_vertex(features, vertex), text)
               : "the outer surface";
}

/* Lists vertices by the caller's numbers, as many as there is room for. */
static void list_vertices(char *text, size_t size, const iccp_simplices *mesh, size_t n,
                          const uint32_t *vertices)
{
    size_t used = 0;
    text[0] = '\0';
    for (size_t i = 0; i < n; ++i) {
        const uint32_t v = mesh->given != NULL ? mesh->given[vertices[i]] : vertices[i];
        char word[24];
        const size_t length =
            (size_t)snprintf(word, sizeof word, i == 0 ? "%lu" : ", %lu", (unsigned long)v);
        if (used + length + sizeof ", .." > size) {
            (void)snprintf(text + used, size - used, ", ..");
            return;
        }
        memcpy(text + used, word, length + 1);
        used += length;
    }
}

static void log_loop(const iccp_bad_loop *loop, const iccp_simplices *mesh, const iccp_env *env)
{
    const size_t size = 12 * loop->n + sizeof ", ..";
    char *text = iccp_alloc(&env->memory, size, 1);
    if (text != NULL) {
        list_vertices(text, size, mesh, loop->n, loop->vertices);
        iccp_log(env, "no map: the loop of vertices %s bounds inside the %s only", text,
                 loop->inside ? "target" : "source");
    }
    iccp_free(&env->memory, text);
}

static icc_status refuse(const iccp_bad_loop *loop, const icc_domain *source, icc_error *err)
{
    static const char *const sides[2] = {"source", "target"};
    char list[LIST_TEXT], names[2][ICCP_FEATURE_TEXT];
    const uint32_t first = loop->n > 0 ? loop->vertices[0] : loop->surface;
    const uint32_t given = source->mesh->given != NULL ? source->mesh->given[first] : first;
    const char *surface = name_surface(source, loop->surface, names[0]);
    list_vertices(list, sizeof list, source->mesh, loop->n > 0 ? loop->n : 1,
                  loop->n > 0 ? loop->vertices : &first);
    if (loop->n_partners == 0)
        return iccp_fail_at(err, ICC_ERR_TOPOLOGY, ICC_ITEM_VERTEX, given,
                            "there is no map: at a handle of %s, the loop of vertices %s bounds "
                            "inside the %s, but not inside the %s; pair the vertices so that the "
                            "same loops bound",
                            surface, list, sides[loop->inside], sides[!loop->inside]);
    return iccp_fail_at(err, ICC_ERR_TOPOLOGY, ICC_ITEM_VERTEX, given,
                        "there is no map: handles of %s and %s are not linked in the source as in "
                        "the target, see the loop of vertices %s; pair handles that are linked "
                        "alike",
                        surface, name_surface(source, loop->partners[0], names[1]), list);
}

/* ---- domains ---- */

static bool has_handles(const icc_domain *source, icc_status *status, const iccp_env *env)
{
    const uint32_t n = count_regions(source->mesh);
    bool has = false;
    for (uint32_t r = 0; r < n && *status == ICC_OK && !has; ++r) {
        const iccp_region region = {source->mesh, r};
        iccp_region_surface surface;
        *status = iccp_region_surface_create(&surface, &region, &env->memory);
        if (*status != ICC_OK)
            break;
        has = iccp_surface_n_loops(&surface) > 0;
        iccp_region_surface_free(&surface);
    }
    return has;
}

icc_status iccp_solid_has_map(icc_domain **filled, const icc_domain *source,
                              const icc_domain *target, const iccp_env *env, icc_error *err)
{
    iccp_env part[2];
    iccp_bad_loop loop;
    bool exists;
    icc_status status = ICC_OK;
    *filled = NULL;
    iccp_split(part, 2, (const double[]){2, 1}, env);
    if (!has_handles(source, &status, env))
        return iccp_explain(err, status);
    status = iccp_fill_side(filled, target, 1, &part[0], err);
    if (status != ICC_OK)
        return status;
    status = iccp_bad_loop_find(&loop, &exists, source->mesh, (*filled)->mesh, &part[1], err);
    if (status == ICC_OK && exists) {
        log_loop(&loop, source->mesh, env);
        status = refuse(&loop, source, err);
        iccp_bad_loop_free(&loop);
    }
    if (status == ICC_OK)
        return ICC_OK;
    iccp_domain_release(*filled);
    *filled = NULL;
    return status;
}
