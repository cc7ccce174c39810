/* Finds vertices at which the triangles of a ring cannot intersect.
 *
 * Project the ring along an axis. Suppose that all shadows have the same orientation and go around
 * the vertex once. Then the shadow of the ring nowhere covers itself, so the triangles share only
 * the sides between them. Two sides of a shadow are less than half a turn apart. So the shadows go
 * around once if exactly one of them leads from below the vertex to above.
 *
 * This is the test of P. Volino, N. Magnenat Thalmann, Efficient self-collision detection on
 * smoothly discretized surface animations using geometrical shape regularity, 1994, for the
 * smallest patches. For these it is exact. */
#include "geometry/fans.h"

#include "math/predicates.h"

/* Facts about a vertex. Bit k of each member is for axis k. */
typedef struct fan {
    uint8_t left, right; /* all its triangles have this orientation */
    uint8_t once, twice; /* one triangle leads upwards; more than one does */
} fan;

/* Finds the axes along which the triangle's shadow is oriented to the left, and to the right. */
static void orient(const double *const *p, uint8_t *left, uint8_t *right)
{
    *left = *right = 0;
    for (int k = 0; k < 3; ++k) {
        const int x = (k + 1) % 3, y = (k + 2) % 3;
        const int sign =
            iccp_cross_sign(p[0][x], p[2][x], p[1][y], p[2][y], p[0][y], p[2][y], p[1][x], p[2][x]);
        *left |= (uint8_t)((sign > 0) << k);
        *right |= (uint8_t)((sign < 0) << k);
    }
}

static void add_triangle(fan *fans, const double *vertices, const uint32_t *corners)
{
    const double *const p[3] = {vertices + 3 * (size_t)corners[0],
                                vertices + 3 * (size_t)corners[1],
                                vertices + 3 * (size_t)corners[2]};
    uint8_t left, right;
    orient(p, &left, &right);
    for (int i = 0; i < 3; ++i) {
        fan *f = &fans[corners[i]];
        const double *v = p[i], *a = p[(i + 1) % 3], *b = p[(i + 2) % 3];
        unsigned upwards = 0;
        for (int k = 0; k < 3; ++k) {
            const int y = (k + 2) % 3;
            upwards |= (unsigned)((a[y] < v[y]) & (b[y] >= v[y])) << k;
        }
        f->left &= left;
        f->right &= right;
        f->twice |= (uint8_t)(f->once & upwards);
        f->once |= (uint8_t)upwards;
    }
}

uint8_t *iccp_fans_find(const iccp_facet_tree *tree, size_t n_vertices, const iccp_memory *memory)
{
    fan *fans = iccp_alloc(memory, n_vertices, sizeof *fans);
    uint8_t *good = iccp_alloc(memory, n_vertices, sizeof *good);
    if (fans == NULL || good == NULL) {
        iccp_free(memory, fans);
        iccp_free(memory, good);
        return NULL;
    }
    for (size_t v = 0; v < n_vertices; ++v)
        fans[v] = (fan){.left = 7, .right = 7};
    for (size_t f = 0; f < tree->n; ++f)
        add_triangle(fans, tree->vertices, tree->facets + 3 * f);
    for (size_t v = 0; v < n_vertices; ++v)
        good[v] = ((fans[v].left | fans[v].right) & fans[v].once & ~fans[v].twice) != 0;
    iccp_free(memory, fans);
    return good;
}
