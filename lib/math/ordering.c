/* Approximate minimum degree, by AMD: P. Amestoy, T. Davis, I. Duff, An approximate minimum degree
 * ordering algorithm, SIAM J. Matrix Anal. Appl. 17, 1996. Its kernel amd_2 is called directly,
 * since it takes all its memory from the caller. */
#include "math/ordering.h"

#include <limits.h>

#ifdef ICC_WITH_AMD
#include <amd.h>

bool iccp_ordering_available(void)
{
    return true;
}

/* amd_2 wants the pattern followed by room to work in: a fifth of it and one more entry per row is
 * what AMD's own driver gives it. */
static icc_status run_amd(const iccp_symmetric *m, int *pattern, size_t room, int *work,
                          uint32_t *order)
{
    const size_t n = m->n;
    int *start = work, *length = work + n, *nv = work + 2 * n, *next = work + 3 * n;
    int *last = work + 4 * n, *head = work + 5 * n, *elements = work + 6 * n;
    int *degree = work + 7 * n, *w = work + 8 * n;
    for (size_t i = 0; i < n; ++i) {
        start[i] = (int)m->first[i];
        length[i] = (int)(m->first[i + 1] - m->first[i]);
    }
    for (size_t p = 0; p < m->first[n]; ++p)
        pattern[p] = (int)m->column[p];
    amd_2((int)n, start, pattern, length, (int)room, (int)m->first[n], nv, next, last, head,
          elements, degree, w, NULL, NULL);
    for (size_t k = 0; k < n; ++k)
        order[k] = (uint32_t)last[k];
    return ICC_OK;
}

icc_status iccp_ordering(const iccp_symmetric *matrix, uint32_t *order, const iccp_env *env)
{
    const size_t n_entries = matrix->first[matrix->n];
    const size_t room = n_entries + n_entries / 5 + matrix->n + 1;
    if (room > INT_MAX)
        return ICC_ERR_RESOLUTION;
    if (matrix->n == 0)
        return ICC_OK;
    int *pattern = iccp_alloc(&env->memory, room, sizeof *pattern);
    int *work = iccp_alloc(&env->memory, 9 * matrix->n, sizeof *work);
    icc_status status = ICC_ERR_MEMORY;
    if (pattern != NULL && work != NULL)
        status = run_amd(matrix, pattern, room, work, order);
    iccp_free(&env->memory, pattern);
    iccp_free(&env->memory, work);
    return status;
}

#else

bool iccp_ordering_available(void)
{
    return false;
}

icc_status iccp_ordering(const iccp_symmetric *matrix, uint32_t *order, const iccp_env *env)
{
    (void)matrix;
    (void)order;
    (void)env;
    return ICC_ERR_UNSUPPORTED;
}

#endif
