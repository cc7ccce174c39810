/* Any bytes as a polygon and points: its chart answers all of them with coordinates in range that
 * decode again, or with a status. */
#include "outlines.h"

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size);

typedef struct codes {
    uint32_t facet[MAX_POINTS];
    double bary[2 * MAX_POINTS], t[MAX_POINTS];
    icc_status status[MAX_POINTS];
} codes;

static void check_codes(const codes *c, size_t n, size_t n_facets)
{
    for (size_t i = 0; i < n; ++i) {
        const double *b = c->bary + 2 * i;
        if (c->status[i] != ICC_OK)
            require(c->facet[i] == UINT32_MAX && isnan(b[0]) && isnan(b[1]) && isnan(c->t[i]));
        else
            require(c->facet[i] < n_facets && b[0] >= 0 && b[1] >= 0 &&
                    fabs(b[0] + b[1] - 1) < 1e-15 && c->t[i] >= 0 && c->t[i] <= 1);
    }
}

static void check_curve(const icc_chart *chart, const double *point, icc_status encoded)
{
    enum { CAPACITY = 8 };
    double curve[2 * CAPACITY];
    size_t n = 99;
    const icc_status status = icc_chart_trace(chart, point, CAPACITY, curve, &n, NULL, NULL);
    require(is_point_status(status));
    require(status == ICC_OK ? n >= 1 : n == 0);
    /* A boundary point has coordinates even where no curve starts. */
    require(status == encoded || (encoded == ICC_OK && status == ICC_ERR_TRACE));
    for (size_t i = 0; i < 2 * n && i < 2 * CAPACITY; ++i)
        require(isfinite(curve[i]));
}

/* A certified chart has coordinates for every point of the domain, a curve through it, and goes
 * back to it. */
static void check_certified(const icc_chart *chart, size_t n, const double *points, const codes *c,
                            const double *back)
{
    icc_chart_info info = {.size = sizeof info};
    icc_domain_info shape = {.size = sizeof shape};
    require(icc_chart_get_info(chart, &info) == ICC_OK);
    require(icc_domain_get_info(icc_chart_domain(chart), &shape) == ICC_OK);
    require(info.certified == (info.method != ICC_METHOD_GRADIENT));
    if (!info.certified)
        return;
    const double width = fmax(shape.upper[0] - shape.lower[0], shape.upper[1] - shape.lower[1]);
    const double far = fmax(fabs(shape.upper[0]), fabs(shape.upper[1]));
    for (size_t i = 0; i < n; ++i) {
        require(c->status[i] != ICC_ERR_TRACE);
        if (c->status[i] == ICC_OK && info.method == ICC_METHOD_FOLIATION)
            require(hypot(back[2 * i] - points[2 * i], back[2 * i + 1] - points[2 * i + 1]) <=
                    1e-9 * width + 1e-15 * far);
    }
}

static void check_measures(const icc_chart *chart)
{
    icc_chart_report m = {.size = sizeof m};
    require(icc_chart_get_report(chart, 64, &m, NULL, NULL) == ICC_OK);
    require(m.unreachable >= 0 && m.uncovered >= 0 && m.unreachable + m.uncovered <= 1 + 1e-12);
    require(m.collapsed >= 0 && m.collapsed <= 1 && m.not_inward >= 0 && m.not_inward <= 1);
}

static void check_chart(const icc_chart *chart, size_t n_facets, size_t n, const double *points)
{
    static codes c;
    double back[2 * MAX_POINTS];
    icc_status status[MAX_POINTS];
    size_t n_failed, n_lost;
    require(icc_chart_encode(chart, n, points, c.facet, c.bary, c.t, c.status, &n_failed, NULL) ==
            ICC_OK);
    check_codes(&c, n, n_facets);
    require(icc_chart_decode(chart, n, c.facet, c.bary, c.t, back, status, &n_lost, NULL) ==
            ICC_OK);
    require(n_lost >= n_failed);
    check_results(n, status, back, 2, n_lost);
    for (size_t i = 0; i < n; ++i) {
        if (c.status[i] != ICC_OK)
            require(status[i] == ICC_ERR_ARGUMENT);
        if (c.status[i] == ICC_OK && (c.t[i] <= 0 || c.t[i] >= 1))
            require(status[i] == ICC_OK);
        if (i % 8 == 0)
            check_curve(chart, points + 2 * i, c.status[i]);
    }
    check_certified(chart, n, points, &c, back);
    check_measures(chart);
}

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size)
{
    double xy[2 * MAX_VERTICES], points[2 * MAX_POINTS];
    if (size < 6)
        return 0;
    const int kind = data[0];
    const size_t n = read_outline(data + 2, size - 2, kind & 1, kind & 2, xy);
    place_outline(n, xy, kind >> 4);
    const size_t n_points = pick_points(n, xy, data + 2, size - 2, points);
    icc_domain *domain;
    if (icc_domain_create(&domain, 2, n, xy, 0, NULL, NULL, NULL) != ICC_OK)
        return 0;
    const icc_chart_options options = {
        .size = sizeof options,
        .method = pick_method(data[1] >> 6),
        .function = kind & 128 ? ICC_FUNCTION_HARMONIC : ICC_FUNCTION_DECAY + (kind >> 2 & 1),
        .tree = 1 + (kind >> 3 & 1),
        .cells = 2 + data[1] % 64,
        .maximum = (kind & 64) && data[1] >> 6 != 2 ? points + 4 : NULL};
    icc_chart *chart;
    const icc_status status = icc_chart_create(&chart, domain, &options, NULL, NULL);
    require(status == ICC_OK || status == ICC_ERR_RESOLUTION || status == ICC_ERR_CERTIFICATE ||
            (status == ICC_ERR_OUTSIDE && options.maximum != NULL));
    if (status == ICC_OK)
        check_chart(chart, n, n_points, points);
    icc_chart_free(chart);
    icc_domain_free(domain);
    return 0;
}
