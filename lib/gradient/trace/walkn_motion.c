/* Steps along the gradient of a face. On any face the gradient needs no equations. A block of k
 * axes between two corners moves at the difference of their values over k. The barycentric
 * coordinate of a corner moves at the difference of the speeds on its two sides. */
#include "gradient/trace/walkn_motion.h"

#include <float.h>
#include <math.h>

/* Facets whose times differ by less than this share are met together. It bounds the rounding of two
 * quotients. */
static const double SAME_TIME = 8 * DBL_EPSILON;

void iccp_motion_find(iccp_motion *m, const iccp_place *place, const iccp_slope *slope,
                      unsigned corners)
{
    const int dim = slope->function->tree->grid->dim;
    uint32_t vertices[ICC_MAX_DIM + 1];
    double f[ICC_MAX_DIM + 1];
    m->n = 0;
    for (int i = 0; i <= dim; ++i)
        if (corners >> i & 1) {
            vertices[m->n] = place->simplex.corner[i];
            m->y[m->n] = place->y[i];
            m->corner[m->n++] = i;
        }
    iccp_slope_values(slope, (size_t)m->n, vertices, f);
    for (int a = 1; a < m->n; ++a)
        m->speed[a] = (f[a] - f[a - 1]) / (m->corner[a] - m->corner[a - 1]);
    m->speed[0] = m->speed[m->n] = 0;
    m->y[0] = 1;
    m->y[m->n] = 0;
}

/* Returns when the barycentric coordinate of a corner becomes 0, or HUGE_VAL if it does not
 * fall. */
static double time_of(const iccp_motion *m, int a)
{
    const double speed = m->speed[a + 1] - m->speed[a];
    return speed > 0 ? (m->y[a] - m->y[a + 1]) / speed : HUGE_VAL;
}

unsigned iccp_motion_run(iccp_motion *m, unsigned face)
{
    double time[ICC_MAX_DIM + 1], first = HUGE_VAL;
    for (int a = 0; a < m->n; ++a) {
        time[a] = face >> m->corner[a] & 1 ? time_of(m, a) : HUGE_VAL;
        if (time[a] < first) {
            first = time[a];
            m->exit = a;
        }
    }
    if (!(first < HUGE_VAL))
        return 0;
    for (int a = 1; a < m->n; ++a)
        m->y[a] += first * m->speed[a];
    unsigned left = 0;
    for (int a = 0; a < m->n; ++a) {
        if (time[a] > first * (1 + SAME_TIME) && m->y[a] > m->y[a + 1])
            left |= 1u << m->corner[a];
        else if (a + 1 < m->n)
            m->y[a + 1] = m->y[a];
    }
    /* Corners that have reached the lower end. */
    for (int a = m->n - 1; a > 0 && !(left >> m->corner[a] & 1); --a)
        m->y[a] = 0;
    return left;
}

/* Projects a derivative to the face that carries a step, in the coordinates between its corners. If
 * the walk has reached the face by steps, these are the same along all axes of a block. At a start,
 * it takes their mean. */
static void project_jet(const iccp_motion *m, const iccp_place *place, const iccp_jetn *jet,
                        int parameter, double *y)
{
    y[0] = y[m->n] = 0;
    for (int a = 1; a < m->n; ++a) {
        y[a] = 0;
        for (int k = m->corner[a - 1]; k < m->corner[a]; ++k)
            y[a] += jet->x[place->simplex.axis[k]][parameter];
        y[a] /= m->corner[a] - m->corner[a - 1];
    }
}

static void write_jet(const iccp_motion *m, const iccp_place *place, int parameter, const double *y,
                      iccp_jetn *jet)
{
    for (int k = 0; k < ICC_MAX_DIM; ++k)
        jet->x[k][parameter] = 0;
    for (int a = 1; a < m->n; ++a)
        for (int k = m->corner[a - 1]; k < m->corner[a]; ++k)
            jet->x[place->simplex.axis[k]][parameter] = y[a];
}

/* The facet is met where y[exit] - y[exit + 1] = 0. If other facets are met there, too, the
 * coordinates that they fix stop moving. */
void iccp_motion_carry(const iccp_motion *m, const iccp_place *place, unsigned left, iccp_jetn *jet)
{
    const int e = m->exit, last = m->n - 1;
    double slope2 = 0;
    for (int a = 1; a <= last; ++a)
        slope2 += m->speed[a] * m->speed[a] * (m->corner[a] - m->corner[a - 1]);
    for (int c = 0; c < ICC_MAX_DIM; ++c) {
        double y[ICC_MAX_DIM + 2];
        project_jet(m, place, jet, c, y);
        const double dt = (y[e] - y[e + 1]) / (m->speed[e + 1] - m->speed[e]);
        for (int a = 1; a <= last; ++a)
            y[a] += dt * m->speed[a];
        for (int a = 0; a < last; ++a)
            if (!(left >> m->corner[a] & 1))
                y[a + 1] = y[a];
        for (int a = last; a > 0 && !(left >> m->corner[a] & 1); --a)
            y[a] = 0;
        jet->s[c] += dt * sqrt(slope2);
        write_jet(m, place, c, y, jet);
    }
}
