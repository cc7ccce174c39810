/* The two triangular solves on numbers beyond the range of double.
 *
 * During a solve, a number is x * 2^(512 e). Neighbours nearly always share e, so most
 * multiply-adds are those of plain doubles. A number is normalised, 2^-256 <= |x| < 2^256, only
 * once per solve. That leaves room for entries of the factor from 2^-500 to 2^500. If one of two
 * summands has an e lower by 2 or more, it is below 2^-512 of the other one and is dropped. */
#include "math/ldlt.h"
#include "math/panel.h"

enum { UNIT = 512, MAX_STEPS = 4 };

/* Entries of the factor between two calls of the progress callback: some 10 ms. */
enum { ENTRIES_PER_REPORT = 1 << 22 };

#define UNIT_UP 0x1p512
#define UNIT_DOWN 0x1p-512
#define HIGH 0x1p256
#define LOW 0x1p-256
#define STRIP ((size_t)ICCP_STRIP)

static size_t least(size_t a, size_t b)
{
    return a < b ? a : b;
}

/* Numbers so large that MAX_STEPS do not suffice are not finite. */
static ICCP_INLINE void normalise(double *x, int32_t *e)
{
    if (ICCP_LIKELY(fabs(*x) >= LOW && fabs(*x) < HIGH))
        return;
    if (!(*x < 0 || *x > 0)) {
        *e = ICCP_ZERO_EXPONENT;
        return;
    }
    for (int k = 0; k < MAX_STEPS && fabs(*x) >= HIGH; ++k, ++*e)
        *x *= UNIT_DOWN;
    for (int k = 0; k < MAX_STEPS && fabs(*x) < LOW; ++k, --*e)
        *x *= UNIT_UP;
}

/* (x, e) += (term, unit). A 0 may have any unit, because panels store some zeros. */
static ICCP_INLINE void add(double *x, int32_t *e, double term, int32_t unit)
{
    if (ICCP_LIKELY(unit == *e)) {
        *x += term;
    } else if (unit < *e) {
        if (unit == *e - 1)
            *x += term * UNIT_DOWN;
    } else if (term < 0 || term > 0) {
        *x = (unit == *e + 1 ? *x * UNIT_DOWN : 0.0) + term;
        *e = unit;
    }
}

/* Copies the right-hand side into elimination order, in units of 2^512. */
static void gather(const iccp_ldlt *l, const iccp_scaled *b, const iccp_scaled *work)
{
    for (size_t k = 0; k < l->n; ++k) {
        const size_t row = l->order[k];
        const int32_t exponent = b->exponent[row];
        if (exponent == ICCP_ZERO_EXPONENT) {
            work->fraction[k] = 0;
            work->exponent[k] = ICCP_ZERO_EXPONENT;
            continue;
        }
        const int32_t rest = (exponent + UNIT / 2) & (UNIT - 1);
        work->fraction[k] = iccp_ldexp(b->fraction[row], rest - UNIT / 2);
        work->exponent[k] = (exponent + UNIT / 2 - rest) / UNIT;
    }
}

static void scatter(const iccp_ldlt *l, const iccp_scaled *b, const iccp_scaled *work)
{
    for (size_t k = 0; k < l->n; ++k)
        iccp_scaled_set(b, l->order[k], work->fraction[k],
                        work->fraction[k] < 0 || work->fraction[k] > 0 ? work->exponent[k] * UNIT
                                                                       : 0);
}

/* Returns true if two numbers share a unit, and sets it. A 0 shares every unit. */
static bool share_unit(int32_t *unit, int32_t e)
{
    if (*unit == ICCP_ZERO_EXPONENT)
        *unit = e;
    return e == *unit || e == ICCP_ZERO_EXPONENT;
}

/* Computes what each row of a strip adds to its right-hand side: sum[r] in units of unit[r]. */
static void multiply_strip(double *sum, int32_t *unit, const double *strip, size_t depth,
                           const double *x, const int32_t *e, size_t n_alike, int32_t common)
{
    for (size_t r = 0; r < STRIP; ++r) {
        sum[r] = 0;
        unit[r] = common;
    }
    if (depth <= n_alike) {
        for (size_t k = 0; k < depth; ++k)
            for (size_t r = 0; r < STRIP; ++r)
                sum[r] -= strip[STRIP * k + r] * x[k];
        return;
    }
    for (size_t k = 0; k < depth; ++k)
        for (size_t r = 0; r < STRIP; ++r)
            add(&sum[r], &unit[r], -strip[STRIP * k + r] * x[k], e[k]);
}

/* x = L^-1 x for one panel. An entry is used only after all earlier ones have been applied and it
 * has been normalised. While the first columns share one unit, their products are plain doubles. */
static void forward(const iccp_scaled *work, const iccp_panel *p, uint32_t first,
                    const uint32_t *below)
{
    double *x = work->fraction + first, sum[ICCP_STRIP];
    int32_t *e = work->exponent + first, unit[ICCP_STRIP], common = ICCP_ZERO_EXPONENT;
    size_t n_alike = 0; /* number of first columns with the unit `common` */
    const double *strip = p->value;
    for (size_t i = 0; i < p->rows; i += STRIP, strip += STRIP * p->columns) {
        const size_t depth = least(i, p->columns);
        while (n_alike < depth && share_unit(&common, e[n_alike]))
            ++n_alike;
        multiply_strip(sum, unit, strip, depth, x, e, n_alike, common);
        for (size_t r = 0; r < least(STRIP, p->rows - i); ++r) {
            for (size_t k = depth; k < least(i + r, p->columns); ++k)
                add(&sum[r], &unit[r], -strip[STRIP * k + r] * x[k], e[k]);
            const size_t row = i + r < p->columns ? first + i + r : below[i + r - p->columns];
            add(&work->fraction[row], &work->exponent[row], sum[r], unit[r]);
            if (i + r < p->columns)
                normalise(&x[i + r], &e[i + r]);
        }
    }
}

/* Multiplies the rows of a strip by their entries y of the solution, and subtracts the products
 * from the columns. */
static void multiply_transposed(double *x, int32_t *e, const double *strip, size_t depth,
                                const double y[ICCP_STRIP], const int32_t unit[ICCP_STRIP])
{
    int32_t common = ICCP_ZERO_EXPONENT;
    bool is_alike = true;
    for (size_t r = 0; r < STRIP; ++r)
        is_alike = is_alike && share_unit(&common, unit[r]);
    for (size_t k = 0; k < depth; ++k, strip += STRIP)
        if (ICCP_LIKELY(is_alike))
            add(&x[k], &e[k],
                -((strip[0] * y[0] + strip[1] * y[1]) + (strip[2] * y[2] + strip[3] * y[3])),
                common);
        else
            for (size_t r = 0; r < STRIP; ++r)
                add(&x[k], &e[k], -strip[r] * y[r], unit[r]);
}

/* x = L^-T D^-1 x for one panel, from its last row upwards. The rows below are final. Each entry of
 * the square is final and normalised before the entries above use it. */
static void backward(const iccp_scaled *work, const iccp_panel *p, uint32_t first,
                     const uint32_t *below)
{
    double *x = work->fraction + first;
    int32_t *e = work->exponent + first;
    for (size_t k = 0; k < p->columns; ++k)
        x[k] /= p->pivot[k];
    for (size_t i = (p->rows + STRIP - 1) / STRIP * STRIP; i > 0;) {
        i -= STRIP;
        const double *strip = p->value + i * p->columns;
        const size_t depth = least(i, p->columns);
        double y[ICCP_STRIP] = {0};
        int32_t unit[ICCP_STRIP];
        for (size_t r = 0; r < STRIP; ++r)
            unit[r] = ICCP_ZERO_EXPONENT;
        for (size_t r = least(STRIP, p->rows - i); r-- > 0;) {
            if (i + r < p->columns)
                normalise(&x[i + r], &e[i + r]);
            const size_t row = i + r < p->columns ? first + i + r : below[i + r - p->columns];
            y[r] = work->fraction[row];
            unit[r] = work->exponent[row];
            for (size_t k = depth; k < least(i + r, p->columns); ++k)
                add(&x[k], &e[k], -strip[STRIP * k + r] * y[r], unit[r]);
        }
        multiply_transposed(x, e, strip, depth, y, unit);
    }
}

/* Reports progress before supernode s. */
static icc_status report(const iccp_supernodes *nodes, size_t s, bool is_back, const iccp_env *env)
{
    const size_t begin = nodes->first_value[s], end = nodes->first_value[s + 1];
    if (begin / ENTRIES_PER_REPORT == end / ENTRIES_PER_REPORT && s > 0)
        return ICC_OK;
    const double share = (double)begin / (double)nodes->first_value[nodes->n];
    return iccp_progress(env, "solve", 0.5 * (is_back ? 2 - share : share));
}

icc_status iccp_ldlt_solve_scaled(const iccp_ldlt *factor, const iccp_scaled *b,
                                  const iccp_scaled *work, const iccp_env *env)
{
    const iccp_supernodes *nodes = &factor->nodes;
    icc_status status = ICC_OK;
    gather(factor, b, work);
    for (size_t s = 0; s < nodes->n && status == ICC_OK; ++s) {
        const iccp_panel panel = iccp_panel_of(nodes, s, factor->value, factor->pivot);
        status = report(nodes, s, false, env);
        forward(work, &panel, nodes->column[s], nodes->row + nodes->first_row[s]);
    }
    for (size_t s = nodes->n; s-- > 0 && status == ICC_OK;) {
        const iccp_panel panel = iccp_panel_of(nodes, s, factor->value, factor->pivot);
        status = report(nodes, s, true, env);
        backward(work, &panel, nodes->column[s], nodes->row + nodes->first_row[s]);
    }
    if (status == ICC_OK)
        scatter(factor, b, work);
    return status;
}
