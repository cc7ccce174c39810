/* Any bytes as a mesh in 2 to 4 dimensions: it is refused with a reason, or the library's copy of
 * it fills the domain, side by side; and in which order the mesh is listed does not matter.
 *
 * Byte 0 chooses a cube to start from, its frame, and whether its facets are given. One byte moves
 * a coordinate: small steps of half a cell make flat simplices likely. What is left replaces
 * corners, two bytes each, or facets. */
#include "../meshes.h"
#include "domain/domain.h"
#include "fuzz.h"
#include "geometry/simplices.h"
#include "math/orient.h"

static void give_facets(test_mesh *m)
{
    icc_domain *domain;
    require(mesh_domain(&domain, m, NULL, NULL) == ICC_OK);
    m->n_facets = domain->n_facets;
    m->facets = mesh_alloc(m->n_facets * (size_t)m->dim, sizeof *m->facets);
    for (size_t i = 0; i < m->n_facets * (size_t)m->dim; ++i) {
        double x[ICC_MAX_DIM];
        uint32_t v = 0;
        iccp_domain_given(domain, domain->facets[i], x);
        while (memcmp(m->vertices + (size_t)m->dim * v, x, (size_t)m->dim * sizeof *x) != 0)
            ++v;
        m->facets[i] = v;
    }
    icc_domain_free(domain);
}

static test_mesh read_mesh(const uint8_t *data, size_t size)
{
    static const double SCALES[4] = {1, 1e300, 1e-310, 0x1p-40},
                        OFFSETS[4] = {0, 1e9, -0x1p50, 12.7};
    const int32_t dim = 2 + (data[0] & 3) % 3;
    random_source r = {1};
    test_mesh m = mesh_cube(dim, dim == 4 ? 1 : 2, 0, &r);
    if (data[0] & 4)
        give_facets(&m);
    const size_t n = m.n_vertices * (size_t)dim, n_moved = n < size - 1 ? n : size - 1;
    for (size_t i = 0; i < n_moved; ++i)
        if (data[1 + i] & 1)
            m.vertices[i] += 0.5 * ((double)(data[1 + i] >> 1 & 7) - 4);
    for (size_t i = 0; i < n; ++i)
        m.vertices[i] = m.vertices[i] * SCALES[data[0] >> 4 & 3] + OFFSETS[data[0] >> 6];
    for (size_t i = 1 + n_moved; i + 1 < size; i += 2)
        if (m.facets != NULL && (data[i + 1] & 128) != 0)
            m.facets[data[i] % (m.n_facets * (size_t)dim)] =
                (uint32_t)(data[i + 1] % (m.n_vertices + 1));
        else
            m.simplices[data[i] % (m.n_simplices * (size_t)(dim + 1))] =
                (uint32_t)(data[i + 1] % (m.n_vertices + 1));
    return m;
}

static void check_copy(const icc_domain *d)
{
    const iccp_simplices *s = d->mesh;
    const size_t dim = s->dim;
    double volume = 0, factor = 1;
    size_t n_rim = 0;
    for (size_t k = 0; k < s->n_simplices; ++k) {
        const double *corner[ICC_MAX_DIM + 1];
        for (size_t i = 0; i <= dim; ++i) {
            const size_t side = (dim + 1) * k + i;
            const uint32_t across = s->across[side];
            corner[i] = iccp_corner_point(s, side);
            require(s->corners[side] < s->n_points);
            if (across & ICCP_ON_BOUNDARY)
                ++n_rim;
            else
                require(s->across[across] == side);
        }
        require(iccp_orient(dim, corner) == 1);
        volume += iccp_orient_value(dim, corner);
    }
    for (size_t k = 2; k <= dim; ++k)
        factor *= (double)k;
    require(n_rim == d->n_facets && n_rim == s->n_facets);
    require(fabs(volume / factor - d->measure) <= 1e-12 * d->measure);
}

static icc_status create(icc_domain **out, const test_mesh *m)
{
    icc_error err = {.size = sizeof err};
    const icc_status status = mesh_domain(out, m, NULL, &err);
    require((*out != NULL) == (status == ICC_OK));
    require(status == ICC_OK || status == ICC_ERR_BOUNDARY || status == ICC_ERR_TOPOLOGY);
    require(status == ICC_OK || err.message[0] != '\0');
    return status;
}

/* The last simplex first, and each from its last corner. */
static void turn_round(test_mesh *m)
{
    const size_t n = m->n_simplices * (size_t)(m->dim + 1);
    for (size_t i = 0; 2 * i < n; ++i) {
        const uint32_t swap = m->simplices[i];
        m->simplices[i] = m->simplices[n - 1 - i];
        m->simplices[n - 1 - i] = swap;
    }
}

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size)
{
    icc_domain *domain, *again;
    if (size == 0)
        return 0;
    test_mesh m = read_mesh(data, size);
    const icc_status status = create(&domain, &m);
    if (domain != NULL)
        check_copy(domain);
    turn_round(&m);
    require((create(&again, &m) == ICC_OK) == (status == ICC_OK));
    if (again != NULL) {
        check_copy(again);
        require(again->n_facets == domain->n_facets &&
                memcmp(again->facets, domain->facets,
                       domain->n_facets * (size_t)m.dim * sizeof *domain->facets) == 0);
    }
    icc_domain_free(domain);
    icc_domain_free(again);
    mesh_free(&m);
    return 0;
}
