/* Reads and writes domains with features. */
#include "domain/features_file.h"

#include "domain/features.h"

/* Data that a domain with features is made from. */
typedef struct parts {
    size_t n_outer, n; /* vertices of the outer ring; number of features */
    uint32_t *head;    /* kind and number of vertices of each feature */
    size_t n_vertices; /* number of all vertices */
    double *vertices;
    icc_feature *features;
} parts;

static void write_features(iccp_blob *b, const icc_domain *domain)
{
    size_t n_outer = domain->features->n_outer, n = domain->features->n;
    iccp_blob_size(b, &n_outer);
    iccp_blob_size(b, &n);
    for (size_t f = 0; f < n; ++f) {
        uint32_t head[2] = {(uint32_t)domain->features->item[f].kind, domain->features->item[f].n};
        iccp_blob_u32(b, 2, head);
    }
    iccp_blob_f64(b, 2 * domain->n_vertices, domain->given);
}

/* Reads the counts, each of which must be possible for a domain. */
static void read_head(iccp_blob *b, parts *p)
{
    iccp_blob_count(b, 2 * ICCP_F64, &p->n_outer);
    iccp_blob_count(b, 2 * ICCP_U32, &p->n);
    iccp_blob_require(b, p->n_outer <= ICCP_MAX_COUNT && p->n > 0 && p->n <= ICCP_MAX_COUNT);
    iccp_blob_array_u32(b, 2 * p->n, &p->head);
    p->n_vertices = p->n_outer;
    for (size_t f = 0; f < p->n && b->status == ICC_OK; ++f) {
        const uint32_t kind = p->head[2 * f], n = p->head[2 * f + 1];
        iccp_blob_require(b, kind <= INT32_MAX && iccp_feature_allows(2, (int32_t)kind, n) &&
                                 n <= ICCP_MAX_COUNT - p->n_vertices);
        p->n_vertices += n;
    }
}

static void read_vertices(iccp_blob *b, parts *p)
{
    iccp_blob_array_f64(b, 2 * p->n_vertices, &p->vertices);
    p->features = iccp_blob_alloc(b, p->n, sizeof *p->features);
    if (b->status != ICC_OK)
        return;
    const double *next = p->vertices + 2 * p->n_outer;
    for (size_t f = 0; f < p->n; ++f) {
        const size_t n = p->head[2 * f + 1];
        p->features[f] = (icc_feature){.size = sizeof(icc_feature),
                                       .kind = (int32_t)p->head[2 * f],
                                       .n_vertices = n,
                                       .vertices = next};
        next += 2 * n;
    }
}

icc_status iccp_features_visit(iccp_blob *b, icc_domain **domain, const iccp_env *env)
{
    parts p = {0};
    if (!b->reads) {
        write_features(b, *domain);
        return ICC_OK;
    }
    *domain = NULL;
    read_head(b, &p);
    if (b->status == ICC_OK)
        read_vertices(b, &p);
    const icc_status status =
        b->status == ICC_OK
            ? iccp_domain_create_features(domain, p.n_outer, p.vertices, p.n, p.features, env, NULL)
            : b->status;
    iccp_free(&env->memory, p.head);
    iccp_free(&env->memory, p.vertices);
    iccp_free(&env->memory, p.features);
    return status;
}
