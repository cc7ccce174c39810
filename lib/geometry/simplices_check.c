/* Checks of a mesh's topology: connected, and Euler characteristic 1. In space, the boundary alone
 * tells what the Euler characteristic would. */
#include "geometry/simplices.h"

#include "base/error.h"
#include "geometry/tuples.h"

#include <string.h>

/* Returns how many simplices are connected to simplex 0 across facets, including itself. reached[]
 * marks them. */
static size_t flood(const iccp_simplices *mesh, bool *reached, uint32_t *queue)
{
    const size_t n_sides = mesh->dim + 1;
    size_t n = 0, done = 0;
    queue[n++] = 0;
    reached[0] = true;
    while (done < n) {
        const uint32_t *across = mesh->across + n_sides * queue[done++];
        for (size_t i = 0; i < n_sides; ++i) {
            if (across[i] & ICCP_ON_BOUNDARY)
                continue;
            const uint32_t other = (uint32_t)iccp_simplex_of(mesh, across[i]);
            if (!reached[other]) {
                reached[other] = true;
                queue[n++] = other;
            }
        }
    }
    return n;
}

/* One flood decides: any simplex that it does not reach is a witness. The message names the one
 * with the smallest number. */
static icc_status check_pieces(const iccp_simplices *mesh, icc_error *err)
{
    const iccp_memory *memory = &mesh->memory;
    bool *reached = iccp_alloc_zero(memory, mesh->n_simplices, sizeof *reached);
    uint32_t *queue = iccp_alloc(memory, mesh->n_simplices, sizeof *queue);
    icc_status status = ICC_OK;
    if (reached == NULL || queue == NULL)
        status = iccp_fail_memory(err);
    else {
        const size_t n = flood(mesh, reached, queue);
        size_t other = 0;
        while (other < mesh->n_simplices && reached[other])
            ++other;
        if (other < mesh->n_simplices)
            status = iccp_fail_at(err, ICC_ERR_TOPOLOGY, ICC_ITEM_SIMPLEX, (int64_t)other,
                                  "the mesh is in several pieces: simplex %zu is not connected to "
                                  "simplex 0 across facets (%zu are)",
                                  other, n);
    }
    iccp_free(memory, queue);
    iccp_free(memory, reached);
    return status;
}

/* The next subset of the same size: R. W. Gosper's hack, HAKMEM item 175. */
static unsigned next_subset(unsigned set)
{
    const unsigned low = set & (0u - set), sum = set + low;
    return sum | (set ^ sum) / low >> 2;
}

/* Writes the faces of a simplex that have `width` corners. Returns the end of the output. */
static uint32_t *list_faces(size_t n_corners, const uint32_t *corners, size_t width, uint32_t *to)
{
    for (unsigned set = (1u << width) - 1; set < 1u << n_corners; set = next_subset(set)) {
        size_t n = 0;
        for (size_t i = 0; i < n_corners; ++i)
            if (set >> i & 1u)
                to[n++] = corners[i];
        (void)iccp_sort_vertices(width, to);
        to += width;
    }
    return to;
}

static size_t binomial(size_t n, size_t k)
{
    size_t b = 1;
    for (size_t i = 1; i <= k; ++i)
        b = b * (n - k + i) / i;
    return b;
}

/* Counts the different faces with `width` corners. */
static icc_status count_faces(const iccp_simplices *mesh, size_t width, size_t *n_faces)
{
    const size_t n_corners = mesh->dim + 1;
    const size_t n = binomial(n_corners, width) * mesh->n_simplices;
    iccp_tuples tuples;
    *n_faces = 0;
    if (iccp_tuples_create(&tuples, n, width, mesh->n_points, &mesh->memory) != ICC_OK)
        return ICC_ERR_MEMORY;
    uint32_t *to = tuples.vertices;
    for (size_t s = 0; s < mesh->n_simplices; ++s)
        to = list_faces(n_corners, mesh->corners + n_corners * s, width, to);
    iccp_tuples_sort(&tuples);
    for (size_t k = 0; k < n; k = iccp_tuples_end(&tuples, k))
        ++*n_faces;
    iccp_tuples_free(&tuples);
    return ICC_OK;
}

/* H. Poincare: the alternating sum of the numbers of faces of each dimension is 1 for a ball. */
static icc_status check_euler(const iccp_simplices *mesh, icc_error *err)
{
    const size_t n_corners = mesh->dim + 1;
    const size_t n_facets = (n_corners * mesh->n_simplices + mesh->n_facets) / 2;
    int64_t sum = (int64_t)mesh->n_points;
    for (size_t width = 2; width <= n_corners; ++width) {
        size_t n = width == mesh->dim ? n_facets : mesh->n_simplices;
        if (width < mesh->dim && count_faces(mesh, width, &n) != ICC_OK)
            return iccp_fail_memory(err);
        sum += width % 2 != 0 ? (int64_t)n : -(int64_t)n;
    }
    if (sum == 1)
        return ICC_OK;
    return iccp_fail(
        err, ICC_ERR_TOPOLOGY,
        "the mesh has holes, voids or handles: its Euler characteristic is %ld, and that "
        "of a ball is 1",
        (long)sum);
}

icc_status iccp_simplices_check_shape(const iccp_simplices *mesh, icc_error *err)
{
    const icc_status status = check_pieces(mesh, err);
    return status == ICC_OK && mesh->dim != 3 ? check_euler(mesh, err) : status;
}
