/* Any bytes as a polygon: its mesh is a triangulated disc, exactly, and every point of it is
 * found. */
#include "foliation/certificate.h"
#include "geometry/locate.h"
#include "mesh/finder.h"

#include "outlines.h"

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size);

static void check_rim(const iccp_planar *mesh, const icc_domain *domain)
{
    for (uint32_t k = 0; k < mesh->n_boundary; ++k) {
        const double along = iccp_planar_along(mesh, domain, k, 0.5);
        double lambda;
        require(iccp_planar_edge(mesh, domain, mesh->facet[k], along, &lambda) == k);
        require(fabs(lambda - 0.5) < 1e-9);
    }
}

static void check_points(const iccp_planar *mesh, const icc_domain *domain, const iccp_env *env)
{
    iccp_finder finder;
    iccp_finder_init(&finder, mesh, mesh->points, 0, ICCP_FEW_POINTS, &env->memory);
    for (size_t t = 0; t < mesh->n_triangles; ++t) {
        const uint32_t *v = mesh->triangles + 3 * t;
        double p[2];
        iccp_found found;
        for (size_t k = 0; k < 2; ++k)
            p[k] = 0.5 * mesh->points[2 * (size_t)v[0] + k] +
                   0.25 * mesh->points[2 * (size_t)v[1] + k] +
                   0.25 * mesh->points[2 * (size_t)v[2] + k];
        const icc_status status = iccp_finder_find(&finder, p, &found);
        require(status == ICC_OK || status == ICC_ERR_TRACE);
        if (status == ICC_OK)
            require(fabs(found.bary[0] + found.bary[1] + found.bary[2] - 1) < 1e-15);
        else
            require(iccp_domain_locate(domain, p, true, NULL, NULL) != ICC_INSIDE);
    }
    iccp_finder_free(&finder);
}

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size)
{
    double xy[2 * MAX_VERTICES];
    if (size < 6)
        return 0;
    const size_t n = read_outline(data + 2, size - 2, data[0] & 1, data[0] & 2, xy);
    place_outline(n, xy, data[0] >> 4);
    const int32_t cells = 2 + data[1] % 64;
    icc_domain *domain;
    iccp_env env;
    iccp_planar mesh;
    uint32_t pieces[MAX_VERTICES];
    iccp_certificate certificate = {0};
    if (icc_domain_create(&domain, 2, n, xy, 0, NULL, NULL, NULL) != ICC_OK)
        return 0;
    require(iccp_env_read(&env, NULL, NULL) == ICC_OK);
    iccp_planar_pieces(pieces, domain, NULL, cells);
    const icc_status status = iccp_planar_create(&mesh, domain, pieces, cells, &env, NULL);
    /* Large outlines are rounded, and a spike may end up with sides that only just do not touch. */
    require(status == ICC_OK || status == ICC_ERR_CERTIFICATE);
    if (status == ICC_OK) {
        iccp_certify_mesh(&mesh, mesh.points, &certificate);
        require(iccp_certificate_holds(&certificate));
        check_rim(&mesh, domain);
        check_points(&mesh, domain, &env);
    }
    iccp_planar_free(&mesh);
    icc_domain_free(domain);
    return 0;
}
