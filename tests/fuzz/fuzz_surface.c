/* Any bytes as a boundary in 3-D: it is refused with a reason, or the domain finds its own
 * vertices, agrees with its mirror image, and does not contradict itself about points, lines and
 * segments.
 *
 * Byte 0 chooses a shape to start from, its frame, and how bytes move the vertices: small integers
 * make degenerate surfaces likely, a nudge by one unit in the last place nearly degenerate ones.
 * Three bytes a vertex; what is left replaces vertex indices of the faces. */
#include "bodies.h"
#include "domain/domain.h"
#include "domain/tree_cross.h"
#include "fuzz.h"
#include "icc/icc.h"

/* A line through the point has the inside between its crossings; where the point is beside the
 * boundary, these tell which side it is on. */
static void check_lines(const icc_domain *domain, const double *local, int32_t where)
{
    iccp_line_crossing crossings[512];
    for (int axis = 0; axis < 3; ++axis) {
        const size_t n = iccp_tree_line(domain, axis, local, 512, crossings);
        size_t n_before = 0, n_near = 0;
        require(n % 2 == 0 && n <= domain->n_facets);
        for (size_t i = 0; i < n; ++i) {
            require(i == 0 || crossings[i - 1].at <= crossings[i].at);
            n_before += crossings[i].at < local[axis];
            n_near += fabs(crossings[i].at - local[axis]) < 1e-6;
        }
        if (where != ICC_BOUNDARY && n_near == 0)
            require((n_before % 2 == 1) == (where == ICC_INSIDE));
    }
}

static int32_t check_point(const icc_domain *domain, const double *p)
{
    int32_t where, again;
    uint32_t facet;
    double bary[3], local[3];
    require(icc_domain_locate(domain, 1, p, &where, &facet, bary, NULL) == ICC_OK);
    require(icc_domain_locate(domain, 1, p, &again, NULL, NULL, NULL) == ICC_OK);
    require(where == again && where >= ICC_INSIDE && where <= ICC_OUTSIDE);
    require(facet < domain->n_facets && bary[0] >= 0 && bary[1] >= 0 && bary[2] >= 0);
    require(fabs(bary[0] + bary[1] + bary[2] - 1) < 1e-15);
    iccp_frame_in(&domain->frame, 3, p, local);
    check_lines(domain, local, where);
    return where;
}

static void check_segment(const icc_domain *domain, const double *p, const double *q, int32_t from,
                          int32_t to)
{
    double a[3], b[3], share, bary[3];
    uint32_t facet;
    iccp_frame_in(&domain->frame, 3, p, a);
    iccp_frame_in(&domain->frame, 3, q, b);
    const bool crosses = iccp_domain_cross(domain, a, b, &share, &facet, bary);
    if (from != to && from != ICC_BOUNDARY && to != ICC_BOUNDARY)
        require(crosses);
    if (crosses)
        require(share >= 0 && share <= 1 && facet < domain->n_facets &&
                fabs(bary[0] + bary[1] + bary[2] - 1) < 1e-15);
}

static void check_domain(const icc_domain *domain, const surface *s)
{
    icc_domain_info info = {.size = sizeof info};
    require(icc_domain_get_info(domain, &info) == ICC_OK && info.measure >= 0);
    require(info.orientation == 1 || info.orientation == -1);
    for (size_t f = 0; f < s->n_faces; ++f) {
        const double *v = s->vertices + 3 * s->faces[3 * f];
        const double *w = s->vertices + 3 * s->faces[(3 * f + 100) % (3 * s->n_faces)];
        double middle[3], beyond[3];
        for (int k = 0; k < 3; ++k) {
            middle[k] = 0.5 * v[k] + 0.5 * w[k];
            beyond[k] = 0.75 * info.upper[k] + 0.25 * middle[k];
        }
        require(check_point(domain, v) == ICC_BOUNDARY);
        check_segment(domain, middle, beyond, check_point(domain, middle),
                      check_point(domain, beyond));
    }
}

static icc_status create(icc_domain **out, surface *s, icc_error *err)
{
    *err = (icc_error){.size = sizeof *err};
    const icc_status status =
        icc_domain_create(out, 3, s->n_vertices, s->vertices, s->n_faces, s->faces, NULL, err);
    require((*out != NULL) == (status == ICC_OK));
    require(status == ICC_OK || status == ICC_ERR_BOUNDARY || status == ICC_ERR_TOPOLOGY);
    require(status == ICC_OK || err->message[0] != '\0');
    return status;
}

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size)
{
    static surface s;
    icc_domain *domain, *mirrored;
    icc_error err;
    if (size == 0)
        return 0;
    choose(&s, data[0] & 3);
    read_surface(&s, data, size);
    const icc_status status = create(&domain, &s, &err);
    if (domain != NULL)
        check_domain(domain, &s);
    for (size_t i = 0; i < 3 * s.n_vertices; i += 3)
        s.vertices[i] = -s.vertices[i];
    require(create(&mirrored, &s, &err) == status);
    require(domain == NULL || domain->orientation == -mirrored->orientation);
    icc_domain_free(domain);
    icc_domain_free(mirrored);
    return 0;
}
