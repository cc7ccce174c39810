/* Reads and writes the rises of psi. Format: docs/reference/formats.md. */
#include "foliation/psi_file.h"

/* The most turns along one edge. So sums over a triangle stay far from the ends of int64_t. */
enum { MOST_TURNS = 2 };

/* Returns true for the one half-edge of each edge whose rise is written. Its twin has the opposite
 * rise. */
static bool is_written(const iccp_planar *mesh, uint32_t corner)
{
    return mesh->twins[corner] == ICCP_NO_NEIGHBOUR || corner < mesh->twins[corner];
}

/* Converts two's complement on any machine. */
static int64_t to_signed(uint64_t bits)
{
    return bits <= INT64_MAX ? (int64_t)bits : -(int64_t)(UINT64_MAX - bits) - 1;
}

static bool is_at_centre(const iccp_psi *psi, const iccp_planar *mesh, uint32_t corner)
{
    return mesh->triangles[iccp_after(corner)] == psi->centre ||
           mesh->triangles[iccp_before(corner)] == psi->centre;
}

/* Writes or reads the rises. A half-edge whose rise is not written comes after its twin, and gets
 * the opposite of its rise. */
static void visit_rises(iccp_blob *b, iccp_psi *psi, const iccp_planar *mesh)
{
    for (uint32_t c = 0; c < 3 * mesh->n_triangles; ++c) {
        uint64_t bits = b->reads ? 0 : (uint64_t)psi->rise[c];
        if (is_written(mesh, c))
            iccp_blob_u64(b, 1, &bits);
        const int64_t rise = to_signed(bits);
        iccp_blob_require(b, rise >= -MOST_TURNS * ICCP_TURN && rise <= MOST_TURNS * ICCP_TURN);
        if (b->status != ICC_OK)
            return;
        if (b->reads)
            psi->rise[c] = is_written(mesh, c) ? rise : -psi->rise[mesh->twins[c]];
    }
}

static void visit(iccp_blob *b, iccp_psi *psi, const iccp_planar *mesh)
{
    iccp_blob_u32(b, 1, &psi->centre);
    iccp_blob_require(b, psi->centre >= mesh->n_boundary && psi->centre < mesh->n_vertices);
    if (b->reads)
        psi->rise = iccp_blob_alloc(b, mesh->n_triangles, 3 * sizeof *psi->rise);
    if (b->status == ICC_OK)
        visit_rises(b, psi, mesh);
}

/* Checks the rises. Those at the centre must be 0. Those along the boundary must be positive and
 * sum to at most one turn, so their sum cannot overflow either. */
static bool is_sound(const iccp_psi *psi, const iccp_planar *mesh)
{
    int64_t rest = ICCP_TURN;
    for (uint32_t c = 0; c < 3 * mesh->n_triangles; ++c) {
        const bool on_boundary = mesh->twins[c] == ICCP_NO_NEIGHBOUR;
        const int64_t rise = psi->rise[c];
        if ((on_boundary && (rise <= 0 || rise > rest)) ||
            (rise != 0 && is_at_centre(psi, mesh, c)))
            return false;
        rest -= on_boundary ? rise : 0;
    }
    return true;
}

void iccp_psi_write(const iccp_psi *psi, const iccp_planar *mesh, iccp_blob *b)
{
    iccp_psi copy = *psi;
    visit(b, &copy, mesh);
}

icc_status iccp_psi_read(iccp_psi *psi, const iccp_planar *mesh, iccp_blob *b, const iccp_env *env)
{
    *psi = (iccp_psi){.memory = env->memory};
    visit(b, psi, mesh);
    if (b->status == ICC_OK && is_sound(psi, mesh))
        return ICC_OK;
    iccp_psi_free(psi);
    return b->status != ICC_OK ? b->status : ICC_ERR_FORMAT;
}
