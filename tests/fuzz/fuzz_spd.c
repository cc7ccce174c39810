/* Any bytes as a sparse symmetric matrix: a factorisation and an iteration solve it or refuse it,
 * and where the diagonal dominates neither refuses and both agree. */
#include "math/pcg.h"
#include "math/spd.h"

#include "outlines.h"

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size);

enum { MAX_ROWS = 48 };

typedef struct sparse {
    size_t first[MAX_ROWS + 1];
    uint32_t column[MAX_ROWS * MAX_ROWS];
    double value[MAX_ROWS * MAX_ROWS], diagonal[MAX_ROWS], dense[MAX_ROWS][MAX_ROWS];
} sparse;

/* Three bytes an entry: row, column, value; then the rows are written in order. */
static iccp_symmetric read_matrix(sparse *s, size_t n, const uint8_t *data, size_t size,
                                  double extra)
{
    memset(s, 0, sizeof *s);
    for (size_t k = 0; k + 3 <= size; k += 3) {
        const size_t a = data[k] % n, b = data[k + 1] % n;
        if (a != b)
            s->dense[a][b] = s->dense[b][a] = -ldexp(1 + data[k + 2] % 16, data[k + 2] / 16 - 8);
    }
    size_t n_entries = 0;
    for (size_t i = 0; i < n; ++i) {
        s->first[i] = n_entries;
        s->diagonal[i] = extra;
        for (size_t j = 0; j < n; ++j)
            if (s->dense[i][j] < 0) {
                s->column[n_entries] = (uint32_t)j;
                s->value[n_entries++] = s->dense[i][j];
                s->diagonal[i] -= s->dense[i][j];
            }
    }
    s->first[n] = n_entries;
    return (iccp_symmetric){n, s->first, s->column, s->value, s->diagonal};
}

static icc_status solve(const iccp_symmetric *m, int iterative, double *x)
{
    double work[ICCP_PCG_WORK * MAX_ROWS];
    iccp_env env;
    iccp_ldlt factor;
    require(iccp_env_read(&env, NULL, NULL) == ICC_OK);
    for (size_t i = 0; i < m->n; ++i)
        x[i] = (double)(i % 7) - 3;
    if (iterative)
        return iccp_pcg_solve(m, NULL, NULL, x, work, &env);
    icc_status status = iccp_spd_create(&factor, m, &env);
    if (status != ICC_OK)
        return status;
    status = iccp_spd_solve(&factor, 1, x, &env);
    iccp_ldlt_free(&factor);
    return status;
}

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size)
{
    static sparse s;
    if (size < 2)
        return 0;
    const size_t n = 1 + data[0] % MAX_ROWS;
    /* Singular, indefinite, or dominant. */
    const double extra = data[1] % 4 == 0 ? 0 : data[1] % 4 == 1 ? -1 : 1;
    const iccp_symmetric m = read_matrix(&s, n, data + 2, size - 2, extra);
    double x[2][MAX_ROWS], largest = 0;
    icc_status status[2];
    for (int k = 0; k < 2; ++k) {
        status[k] = solve(&m, k, x[k]);
        require(status[k] == ICC_OK || status[k] == ICC_ERR_SOLVER);
        for (size_t i = 0; status[k] == ICC_OK && i < n; ++i)
            require(isfinite(x[k][i]));
    }
    if (extra < 1)
        return 0;
    require(status[0] == ICC_OK && status[1] == ICC_OK);
    for (size_t i = 0; i < n; ++i)
        largest = fmax(largest, fabs(x[0][i]));
    for (size_t i = 0; i < n; ++i)
        require(fabs(x[0][i] - x[1][i]) <= 1e-5 * largest);
    return 0;
}
