/* Any bytes as a polygon: icc_domain_create() and icc_boundary_defects() must agree on it, and a
 * domain must find its own vertices and not contradict itself about other points.
 *
 * Byte 0 chooses how the rest is read: by coordinates.h, or as raw doubles, which may be anything. */
#include "coordinates.h"
#include "fuzz.h"
#include "icc/icc.h"

enum { MAX_VERTICES = 512, MAX_DEFECTS = 16 };

/* Two bytes or two doubles a vertex. */
static size_t read_vertices(const uint8_t *data, size_t size, double *vertices)
{
    const int mode = data[0];
    const size_t width = mode & 1 ? sizeof(double) : 1;
    size_t n = (size - 1) / (2 * width);
    n = n < MAX_VERTICES ? n : MAX_VERTICES;
    if (mode & 1) {
        memcpy(vertices, data + 1, 2 * n * sizeof *vertices);
        return n;
    }
    for (size_t i = 0; i < 2 * n; ++i)
        vertices[i] = coordinate(mode, data[1 + i]);
    return n;
}

static void check_point(const icc_domain *domain, const double *p, int is_vertex)
{
    int32_t where, again;
    uint32_t facet;
    double bary[2];
    require(icc_domain_locate(domain, 1, p, &where, &facet, bary, NULL) == ICC_OK);
    require(icc_domain_locate(domain, 1, p, &again, NULL, NULL, NULL) == ICC_OK);
    require(where == again && where >= ICC_INSIDE && where <= ICC_OUTSIDE);
    require(bary[0] >= 0 && bary[1] >= 0 && fabs(bary[0] + bary[1] - 1) < 1e-15);
    if (is_vertex)
        require(where == ICC_BOUNDARY && (bary[0] == 1 || bary[1] == 1));
}

static void check_domain(const icc_domain *domain, size_t n, const double *vertices)
{
    icc_domain_info info = {.size = sizeof info};
    require(icc_domain_get_info(domain, &info) == ICC_OK);
    require(info.n_vertices == n && info.measure >= 0);
    require(info.orientation == 1 || info.orientation == -1);
    for (size_t i = 0; i < n; ++i) {
        const double *p = vertices + 2 * i, *q = vertices + 2 * (i + 7 < n ? i + 7 : 0);
        const double middle[2] = {p[0] / 2 + q[0] / 2, p[1] / 2 + q[1] / 2};
        check_point(domain, p, 1);
        check_point(domain, middle, 0);
    }
}

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size)
{
    static double vertices[2 * MAX_VERTICES];
    int32_t kinds[MAX_DEFECTS];
    uint32_t items[2 * MAX_DEFECTS];
    size_t n_defects;
    icc_error err = {.size = sizeof err};
    icc_domain *domain;
    if (size == 0)
        return 0;
    const size_t n = read_vertices(data, size, vertices);
    const icc_status created = icc_domain_create(&domain, 2, n, vertices, 0, NULL, NULL, &err);
    const icc_status listed =
        icc_boundary_defects(n, vertices, MAX_DEFECTS, kinds, items, &n_defects, NULL, NULL);
    require(created == ICC_OK || created == ICC_ERR_BOUNDARY);
    require(listed == ICC_OK || listed == ICC_ERR_BOUNDARY);
    require((created == ICC_OK) == (listed == ICC_OK && n_defects == 0));
    require((created == ICC_OK) == (domain != NULL));
    require(created == ICC_OK || err.message[0] != '\0');
    for (size_t i = 0; listed == ICC_OK && i < n_defects && i < MAX_DEFECTS; ++i)
        require(kinds[i] >= ICC_DEFECT_NOT_FINITE && kinds[i] <= ICC_DEFECT_FLAT &&
                items[2 * i] <= items[2 * i + 1] && items[2 * i + 1] < (n > 0 ? n : 1));
    if (domain != NULL)
        check_domain(domain, n, vertices);
    icc_domain_free(domain);
    return 0;
}
