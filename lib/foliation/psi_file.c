#include "foliation/psi_file.h"

/* Turns along one edge at most: sums over a triangle stay far from the ends of int64_t. */
enum { MOST_TURNS = 2 };

/* One of every two half-edges has its rise written, the other one has the opposite. */
static bool is_written(const iccp_planar *mesh, uint32_t corner)
{
    return mesh->twins[corner] == ICCP_NO_NEIGHBOUR || corner < mesh->twins[corner];
}

void iccp_psi_write(const iccp_psi *psi, const iccp_planar *mesh, iccp_blob_writer *w)
{
    iccp_blob_u32(w, 1, &psi->centre);
    for (uint32_t c = 0; c < 3 * mesh->n_triangles; ++c)
        if (is_written(mesh, c))
            iccp_blob_u64(w, (uint64_t)psi->rise[c]);
}

/* Two's complement, whatever the machine has. */
static int64_t to_signed(uint64_t bits)
{
    return bits <= INT64_MAX ? (int64_t)bits : -(int64_t)(UINT64_MAX - bits) - 1;
}

static bool is_at_centre(const iccp_psi *psi, const iccp_planar *mesh, uint32_t corner)
{
    return mesh->triangles[iccp_after(corner)] == psi->centre ||
           mesh->triangles[iccp_before(corner)] == psi->centre;
}

/* The turns along the boundary add up to one, of positive parts, so that their sum cannot overflow
 * either. */
static bool read_rises(iccp_psi *psi, const iccp_planar *mesh, iccp_blob_reader *r)
{
    int64_t rest = ICCP_TURN;
    for (uint32_t c = 0; c < 3 * mesh->n_triangles; ++c) {
        const bool on_boundary = mesh->twins[c] == ICCP_NO_NEIGHBOUR;
        if (!is_written(mesh, c)) {
            psi->rise[c] = -psi->rise[mesh->twins[c]];
            continue;
        }
        const int64_t rise = psi->rise[c] = to_signed(iccp_blob_read_u64(r));
        if (rise < -MOST_TURNS * ICCP_TURN || rise > MOST_TURNS * ICCP_TURN ||
            (on_boundary && (rise <= 0 || rise > rest)) ||
            (rise != 0 && is_at_centre(psi, mesh, c)))
            return false;
        rest -= on_boundary ? rise : 0;
    }
    return !r->failed;
}

icc_status iccp_psi_read(iccp_psi *psi, const iccp_planar *mesh, iccp_blob_reader *r,
                         const iccp_env *env)
{
    *psi = (iccp_psi){.memory = env->memory};
    iccp_blob_read_u32(r, 1, &psi->centre);
    if (r->failed || psi->centre < mesh->n_boundary || psi->centre >= mesh->n_vertices)
        return ICC_ERR_FORMAT;
    psi->rise = iccp_alloc(&env->memory, mesh->n_triangles, 3 * sizeof *psi->rise);
    if (psi->rise == NULL)
        return ICC_ERR_MEMORY;
    if (read_rises(psi, mesh, r))
        return ICC_OK;
    iccp_psi_free(psi);
    return ICC_ERR_FORMAT;
}
