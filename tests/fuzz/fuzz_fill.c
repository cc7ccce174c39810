/* Any bytes as a boundary in 3-D, as for fuzz_surface: what is accepted is filled, with its own vertices
 * and facets, or refused with a facet or vertex that is at fault. */
#include "bodies.h"
#include "fuzz.h"
#include "icc/icc.h"

static icc_domain_info info_of(const icc_domain *domain)
{
    icc_domain_info info = {.size = sizeof info};
    require(icc_domain_get_info(domain, &info) == ICC_OK);
    return info;
}

/* All vertices of the surfaces here belong to faces, unless bytes have changed these. */
static void check_filled(const icc_domain *given, const icc_domain *filled)
{
    static double before[3 * SURFACE_VERTICES], after[3 * SURFACE_VERTICES];
    static uint32_t faces[3 * SURFACE_FACES], kept[3 * SURFACE_FACES];
    const icc_domain_info a = info_of(given), b = info_of(filled);
    require(b.n_mesh_simplices > 0 && a.n_facets == b.n_facets && a.n_vertices >= b.n_vertices);
    require(a.orientation == b.orientation);
    require(icc_domain_get_boundary(given, before, faces) == ICC_OK);
    require(icc_domain_get_boundary(filled, after, kept) == ICC_OK);
    for (size_t i = 0; i < 3 * a.n_facets; ++i)
        require(memcmp(before + 3 * faces[i], after + 3 * kept[i], 3 * sizeof *before) == 0);
}

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size)
{
    static surface s;
    icc_domain *domain, *filled;
    icc_error err = {.size = sizeof err};
    if (size == 0)
        return 0;
    choose(&s, data[0] & 3);
    read_surface(&s, data, size);
    if (icc_domain_create(&domain, 3, s.n_vertices, s.vertices, s.n_faces, s.faces, NULL, NULL) !=
        ICC_OK)
        return 0;
    const icc_status status = icc_domain_fill(&filled, domain, NULL, NULL, &err);
    require((filled != NULL) == (status == ICC_OK));
    if (status == ICC_OK)
        check_filled(domain, filled);
    else
        require(status == ICC_ERR_RESOLUTION && err.message[0] != '\0' && err.index >= 0);
    icc_domain_free(filled);
    icc_domain_free(domain);
    return 0;
}
