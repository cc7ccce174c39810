/* Computes the symmetric Dirichlet energy's derivatives for two triangles side by side, twice,
 * because WebAssembly's vectors have 128 bits. */
#include "base/simd.h"

#ifdef ICCP_HAS_WASM_SIMD

#define TARGET

enum { LANES = 2 };

#include "map/energy/dirichlet_lanes.h"

#include <wasm_simd128.h>

TARGET static ICCP_INLINE void gather(const double *const *array, size_t i, reals *x)
{
    *x = (reals)wasm_f64x2_make(array[0][i], array[1][i]);
}

TARGET static ICCP_INLINE void square_root(const reals *x, reals *root)
{
    *root = (reals)wasm_f64x2_sqrt((v128_t)*x);
}

TARGET static ICCP_INLINE void store(const reals x[4], double *const *to)
{
    for (size_t i = 0; i < 4; i += 2) {
        const v128_t a = (v128_t)x[i], b = (v128_t)x[i + 1];
        wasm_v128_store(to[0] + i, wasm_i64x2_shuffle(a, b, 0, 2));
        wasm_v128_store(to[1] + i, wasm_i64x2_shuffle(a, b, 1, 3));
    }
}

void iccp_dirichlet_locals_wasm(const iccp_dirichlet_batch *batch, bool majorise, iccp_local *local)
{
    for (size_t first = 0; first < ICCP_DIRICHLET_LANES; first += LANES)
        set_locals(batch, first, majorise, local);
}

#endif
