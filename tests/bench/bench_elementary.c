/* The elementary functions beside those of the C library: nanoseconds a call, each alone and with
 * its argument waiting for the last result. Processor time, least of several runs that take turns;
 * the C library's may be the variant that it has for this processor. */
#include "bench.h"

#include "math/elementary.h"

enum { N = 1 << 12, CALLS = 1 << 20, REPEATS = 9 };

typedef double (*function)(double x, double y);

static double our_exp(double x, double y)
{
    (void)y;
    return iccp_exp(x);
}

static double their_exp(double x, double y)
{
    (void)y;
    return exp(x);
}

static double our_ln(double x, double y)
{
    (void)y;
    return iccp_ln(x);
}

static double their_ln(double x, double y)
{
    (void)y;
    return log(x);
}

static double our_ln1p(double x, double y)
{
    (void)y;
    return iccp_ln1p(x);
}

static double their_ln1p(double x, double y)
{
    (void)y;
    return log1p(x);
}

static double our_cbrt(double x, double y)
{
    (void)y;
    return iccp_cbrt(x);
}

static double their_cbrt(double x, double y)
{
    (void)y;
    return cbrt(x);
}

static double our_cis(double x, double y)
{
    double z[2];
    (void)y;
    iccp_cis(x, z);
    return z[0] + z[1];
}

static double their_cis(double x, double y)
{
    (void)y;
    return cos(x) + sin(x);
}

static double our_cis_turns(double x, double y)
{
    double z[2];
    (void)y;
    iccp_cis_turns(x, z);
    return z[0] + z[1];
}

static double their_cis_turns(double x, double y)
{
    (void)y;
    const double angle = 6.28318530717958648 * x;
    return cos(angle) + sin(angle);
}

static double their_atan2_turns(double y, double x)
{
    return atan2(y, x) / 6.28318530717958648;
}

static const struct {
    const char *name;
    function ours, theirs;
    double low[2], high[2]; /* of the arguments */
} CASES[] = {
    {"exp", our_exp, their_exp, {-18, 0}, {0, 0}},
    {"ln", our_ln, their_ln, {0.5, 0}, {1, 0}},
    {"ln, wide", our_ln, their_ln, {0, 0}, {1e9, 0}},
    {"ln1p", our_ln1p, their_ln1p, {-0.9, 0}, {1, 0}},
    {"pow", iccp_pow, pow, {1, 0.3}, {1e4, 2.7}},
    {"cbrt", our_cbrt, their_cbrt, {0, 0}, {3, 0}},
    {"hypot", iccp_hypot, hypot, {-1, -1}, {1, 1}},
    {"cis", our_cis, their_cis, {-7, 0}, {7, 0}},
    {"cis_turns", our_cis_turns, their_cis_turns, {-1, 0}, {1, 0}},
    {"atan2_turns", iccp_atan2_turns, their_atan2_turns, {-1, -1}, {1, 1}},
};
enum { N_CASES = sizeof CASES / sizeof *CASES };

static double unit(void)
{
    return (double)rand() / RAND_MAX;
}

/* Seconds. The sum keeps the compiler from leaving calls out. */
static double run_alone(function f, const double *x, const double *y, double *sum)
{
    const double start = bench_processor_seconds();
    for (int k = 0; k < CALLS; ++k)
        *sum += f(x[k % N], y[k % N]);
    return bench_processor_seconds() - start;
}

/* Each argument waits for the last result. */
static double run_chained(function f, const double *x, const double *y, double *sum)
{
    const double start = bench_processor_seconds();
    double last = 0;
    for (int k = 0; k < CALLS; ++k)
        last = f(x[k % N] + 1e-300 * last, y[k % N]);
    *sum += last;
    return bench_processor_seconds() - start;
}

int main(void)
{
    static double x[N], y[N];
    double sum = 0;
    printf("                 ns a call             ns a call, one after the other\n");
    printf("               ours    libm   ratio       ours    libm   ratio\n");
    for (int c = 0; c < N_CASES; ++c) {
        double best[2][2] = {{HUGE_VAL, HUGE_VAL}, {HUGE_VAL, HUGE_VAL}};
        for (int k = 0; k < N; ++k) {
            x[k] = CASES[c].low[0] + (CASES[c].high[0] - CASES[c].low[0]) * unit();
            y[k] = CASES[c].low[1] + (CASES[c].high[1] - CASES[c].low[1]) * unit();
        }
        for (int k = 0; k < 2 * REPEATS; ++k) {
            const function f = k % 2 ? CASES[c].theirs : CASES[c].ours;
            best[0][k % 2] = fmin(best[0][k % 2], run_alone(f, x, y, &sum));
            best[1][k % 2] = fmin(best[1][k % 2], run_chained(f, x, y, &sum));
        }
        printf("%-12s", CASES[c].name);
        for (int chained = 0; chained < 2; ++chained)
            printf("%7.2f %7.2f %7.2f    ", best[chained][0] * 1e9 / CALLS,
                   best[chained][1] * 1e9 / CALLS, best[chained][0] / best[chained][1]);
        printf("\n");
    }
    return isfinite(sum) ? EXIT_SUCCESS : EXIT_FAILURE;
}
