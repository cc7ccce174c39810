/* Checks the arguments of the functions that free a domain or ask it something. */
#include "api/check.h"
#include "base/env.h"
#include "base/options.h"
#include "base/threads.h"
#include "domain/domain.h"
#include "domain/network.h"
#include "geometry/simplices.h"

#include <string.h>

void icc_domain_free(icc_domain *domain)
{
    iccp_domain_release(domain);
}

icc_status icc_domain_get_info(const icc_domain *domain, icc_domain_info *info)
{
    ICCP_ENTER;
    if (domain == NULL || info == NULL)
        return ICC_ERR_ARGUMENT;
    const iccp_frame *frame = &domain->frame;
    icc_domain_info full = {0};
    full.dim = domain->dim;
    full.orientation = domain->orientation;
    full.n_vertices = domain->n_vertices;
    full.n_facets = iccp_domain_n_listed(domain);
    full.n_features = domain->features != NULL ? domain->features->n : 0;
    full.n_mesh_vertices = domain->mesh != NULL ? domain->mesh->n_points : 0;
    if (domain->features != NULL && domain->features->in_space) {
        full.n_pieces = 1 + domain->n_voids - domain->features->n_holes + domain->features->n;
        full.n_faces = 1 + domain->features->n_regions;
    } else if (domain->features != NULL) {
        full.n_junctions = domain->features->network->n_junctions;
        full.n_pieces = domain->features->network->n_pieces;
        full.n_faces = domain->features->network->n_faces;
    }
    if (domain->features != NULL) {
        full.n_holes = domain->features->n_holes;
        full.n_lines = domain->features->n_lines;
        full.n_points = domain->features->n_points;
        full.n_regions = domain->features->n_regions;
    }
    full.n_voids = domain->n_voids;
    full.genus = domain->genus;
    full.n_mesh_simplices = domain->mesh != NULL ? domain->mesh->n_simplices : 0;
    iccp_frame_out(frame, domain->dim, domain->lower, full.lower);
    iccp_frame_out(frame, domain->dim, domain->upper, full.upper);
    full.measure = domain->measure;
    for (int32_t k = 0; k < domain->dim; ++k)
        full.measure = full.measure * frame->out[0] * frame->out[1];
    return iccp_write_struct(info, &full, sizeof full, "icc_domain_info", NULL);
}

icc_status icc_domain_get_feature(const icc_domain *domain, size_t feature, icc_feature_info *info)
{
    ICCP_ENTER;
    if (domain == NULL || info == NULL || domain->features == NULL ||
        feature >= domain->features->n)
        return ICC_ERR_ARGUMENT;
    const iccp_feature *item = &domain->features->item[feature];
    icc_feature_info full = {0};
    full.kind = item->kind;
    full.orientation = item->orientation;
    full.first_vertex = item->first;
    full.n_vertices = item->n;
    full.first_facet = iccp_feature_is_ring(item->kind) ? item->first_facet : 0;
    full.n_facets = iccp_feature_is_ring(item->kind) ? item->n_facets : 0;
    full.genus = item->genus;
    full.around = item->around;
    return iccp_write_struct(info, &full, sizeof full, "icc_feature_info", NULL);
}

icc_status icc_domain_get_boundary(const icc_domain *domain, double *vertices, uint32_t *facets)
{
    ICCP_ENTER;
    if (domain == NULL)
        return ICC_ERR_ARGUMENT;
    const size_t dim = (size_t)domain->dim;
    if (vertices != NULL)
        for (size_t v = 0; v < domain->n_vertices; ++v)
            iccp_domain_given(domain, v, vertices + dim * v);
    if (facets != NULL)
        memcpy(facets, domain->facets, iccp_domain_n_listed(domain) * dim * sizeof *facets);
    return ICC_OK;
}

icc_status icc_domain_get_mesh(const icc_domain *domain, icc_mesh *mesh)
{
    ICCP_ENTER;
    if (domain == NULL || mesh == NULL)
        return ICC_ERR_ARGUMENT;
    if (domain->mesh == NULL)
        return ICC_ERR_UNSUPPORTED;
    const iccp_simplices *const own = domain->mesh;
    const size_t dim = own->dim;
    double *vertices;
    uint32_t *cells;
    const icc_status status =
        iccp_size_mesh(&vertices, &cells, mesh, domain->dim, own->n_points, own->n_simplices);
    if (status != ICC_OK)
        return status;
    for (size_t v = 0; v < own->n_points && vertices != NULL; ++v)
        if (v < own->n_boundary)
            iccp_domain_given(domain, v, vertices + dim * v);
        else
            iccp_frame_restore(&domain->frame, domain->dim, own->points + dim * v,
                               vertices + dim * v);
    if (cells != NULL)
        memcpy(cells, own->corners, own->n_simplices * (dim + 1) * sizeof *cells);
    return ICC_OK;
}

icc_status icc_domain_get_regions(const icc_domain *domain, uint32_t *regions)
{
    ICCP_ENTER;
    if (domain == NULL)
        return ICC_ERR_ARGUMENT;
    if (domain->mesh == NULL)
        return ICC_ERR_UNSUPPORTED;
    if (regions == NULL)
        return ICC_ERR_ARGUMENT;
    for (size_t s = 0; s < domain->mesh->n_simplices; ++s)
        regions[s] = domain->mesh->region != NULL ? domain->mesh->region[s] : 0;
    return ICC_OK;
}

typedef struct locate_call {
    const icc_domain *domain;
    const double *points;
    int32_t *where;
    uint32_t *facet;
    double *bary;
} locate_call;

static void locate_point(const locate_call *call, size_t i)
{
    const size_t dim = (size_t)call->domain->dim;
    double local[ICC_MAX_DIM], bary[ICC_MAX_DIM];
    uint32_t facet = 0;
    iccp_frame_in(&call->domain->frame, call->domain->dim, call->points + dim * i, local);
    const bool nearest = call->facet != NULL || call->bary != NULL;
    call->where[i] =
        iccp_domain_locate(call->domain, local, !nearest, nearest ? &facet : NULL, bary);
    if (call->facet != NULL)
        call->facet[i] = facet;
    if (call->bary != NULL)
        memcpy(call->bary + dim * i, bary, dim * sizeof *bary);
}

static icc_status locate_chunk(void *argument, size_t begin, size_t end)
{
    for (size_t i = begin; i < end; ++i)
        locate_point(argument, i);
    return ICC_OK;
}

icc_status icc_domain_locate(const icc_domain *domain, size_t n, const double *points,
                             int32_t *where, uint32_t *facet, double *bary, const icc_env *env)
{
    ICCP_ENTER;
    if (domain == NULL || (n > 0 && (points == NULL || where == NULL)))
        return ICC_ERR_ARGUMENT;
    iccp_env full;
    const icc_status status = iccp_env_read(&full, env, NULL);
    if (status != ICC_OK)
        return status;
    locate_call call = {domain, points, where, facet, bary};
    return iccp_finish(&full, iccp_for_chunks(&full, "trace", n, 1024, locate_chunk, &call));
}
