/* exp, log and functions derived from them. The numbers below are rounded values of series and
 * functions. Sums `high + low` are correct to about 100 bits.
 *
 * exp: x = k ln 2 / 32 + r, so e^x = 2^(k / 32) e^r. The first factor is in a table. The second is
 * a Taylor polynomial of degree 6, whose relative truncation error is below 2^-58.
 *
 * log: x = 2^e m with m in [1, 2). The interval of m, one of 64, gives a quotient q with 7 bits
 * near 1 / m. Then r = q m - 1 is below 2^-6 and an exact double. So log x = e ln 2 - log q + log(1
 * + r), where the last term is a Taylor polynomial of degree 9. From m = 1.42 on, e is one larger
 * and q twice as large. So both e ln 2 and log q are 0 near x = 1. */
#include "math/elementary.h"

#include "math/expansion.h"

#include <stdbool.h>
#include <stdint.h>
#include <string.h>

enum { N_EXP = 32, N_LOG = 64, FIRST_DOUBLED = 27 };

/* ln 2 / 32. The upper part times n is exact for |n| < 2^16. */
static const double STEP_HIGH = 0x1.62e42fefap-6, STEP_LOW = 0x1.cf79abc9e3b3ap-45;
static const double PER_STEP = 0x1.71547652b82fep5;
/* ln 2. The upper part and those in LOG are multiples of 2^-42, so their sums are exact. */
static const double LN2_HIGH = 0x1.62e42fefa38p-1, LN2_LOW = 0x1.ef35793c7673p-45;
/* Adding and subtracting it rounds a number to an integer. */
static const double ROUNDER = 0x1.8p52;

/* 2^(j / 32) */
static const struct {
    double high, low;
} EXP[N_EXP] = {
    {0x1p0, 0x0p0},
    {0x1.059b0d3158574p0, 0x1.d73e2a475b465p-55},
    {0x1.0b5586cf9890fp0, 0x1.8a62e4adc610bp-54},
    {0x1.11301d0125b51p0, -0x1.6c51039449b3ap-54},
    {0x1.172b83c7d517bp0, -0x1.19041b9d78a76p-55},
    {0x1.1d4873168b9aap0, 0x1.e016e00a2643cp-54},
    {0x1.2387a6e756238p0, 0x1.9b07eb6c70573p-54},
    {0x1.29e9df51fdee1p0, 0x1.612e8afad1255p-55},
    {0x1.306fe0a31b715p0, 0x1.6f46ad23182e4p-55},
    {0x1.371a7373aa9cbp0, -0x1.63aeabf42eae2p-54},
    {0x1.3dea64c123422p0, 0x1.ada0911f09ebcp-55},
    {0x1.44e086061892dp0, 0x1.89b7a04ef80dp-59},
    {0x1.4bfdad5362a27p0, 0x1.d4397afec42e2p-56},
    {0x1.5342b569d4f82p0, -0x1.07abe1db13cadp-55},
    {0x1.5ab07dd485429p0, 0x1.6324c054647adp-54},
    {0x1.6247eb03a5585p0, -0x1.383c17e40b497p-54},
    {0x1.6a09e667f3bcdp0, -0x1.bdd3413b26456p-54},
    {0x1.71f75e8ec5f74p0, -0x1.16e4786887a99p-55},
    {0x1.7a11473eb0187p0, -0x1.41577ee04992fp-55},
    {0x1.82589994cce13p0, -0x1.d4c1dd41532d8p-54},
    {0x1.8ace5422aa0dbp0, 0x1.6e9f156864b27p-54},
    {0x1.93737b0cdc5e5p0, -0x1.75fc781b57ebcp-57},
    {0x1.9c49182a3f09p0, 0x1.c7c46b071f2bep-56},
    {0x1.a5503b23e255dp0, -0x1.d2f6edb8d41e1p-54},
    {0x1.ae89f995ad3adp0, 0x1.7a1cd345dcc81p-54},
    {0x1.b7f76f2fb5e47p0, -0x1.5584f7e54ac3bp-56},
    {0x1.c199bdd85529cp0, 0x1.11065895048ddp-55},
    {0x1.cb720dcef9069p0, 0x1.503cbd1e949dbp-56},
    {0x1.d5818dcfba487p0, 0x1.2ed02d75b3707p-55},
    {0x1.dfc97337b9b5fp0, -0x1.1a5cd4f184b5cp-54},
    {0x1.ea4afa2a490dap0, -0x1.e9c23179c2893p-54},
    {0x1.f50765b6e454p0, 0x1.9d3e12dd8a18bp-54},
};

/* 128 q, and -log q or, from FIRST_DOUBLED on, -log 2 q. */
static const struct {
    double quotient, high, low;
} LOG[N_LOG] = {
    {128, 0x0p0, 0x0p0},
    {125, 0x1.8492528c9p-6, -0x1.aa0ba325a0c34p-45},
    {123, 0x1.466aed42ep-5, -0x1.c167375bdfd28p-45},
    {121, 0x1.ccb73cddd8p-5, 0x1.965c36e09f5fep-44},
    {120, 0x1.08598b59e4p-4, -0x1.7e5dd7009902cp-46},
    {118, 0x1.4d3115d208p-4, -0x1.53a2582f4e1efp-48},
    {116, 0x1.9335e5d594p-4, 0x1.3115c3abd47dap-45},
    {115, 0x1.b6ac88dad4p-4, 0x1.b1bdff50225c7p-44},
    {113, 0x1.fe89139dbcp-4, 0x1.56594d82f7a82p-44},
    {111, 0x1.23d712a49cp-3, 0x1.00d238fd3df5cp-46},
    {110, 0x1.365fcb015ap-3, -0x1.fd3a0afb9691bp-44},
    {108, 0x1.5bf406b544p-3, -0x1.27023eb68981cp-46},
    {107, 0x1.6f0128b756p-3, 0x1.577390d31ef0fp-44},
    {106, 0x1.823c16551ap-3, 0x1.e0ddb9a631e83p-46},
    {104, 0x1.a93ed3c8aep-3, -0x1.8724350562169p-45},
    {103, 0x1.bd087383bep-3, -0x1.d4bc4595412b6p-45},
    {102, 0x1.d1037f2656p-3, -0x1.84a7e75b6f6e4p-47},
    {101, 0x1.e530effe72p-3, -0x1.fdbdbb13f7c18p-44},
    {99, 0x1.07138604d6p-2, -0x1.e76324e912b17p-44},
    {98, 0x1.1178e8227ep-2, 0x1.1ef78ce2d07f2p-44},
    {97, 0x1.1bf99635a7p-2, -0x1.1ac89575c2125p-44},
    {96, 0x1.269621134ep-2, -0x1.1b61f10522625p-44},
    {95, 0x1.314f1e1d36p-2, -0x1.8e27ad3213cb8p-45},
    {94, 0x1.3c25277333p-2, 0x1.83b54b606bd5cp-46},
    {93, 0x1.4718dc271cp-2, 0x1.06c18fb4c14c5p-44},
    {92, 0x1.522ae0738ap-2, 0x1.ebe708164c759p-45},
    {91, 0x1.5d5bddf596p-2, -0x1.a0b2a08a465dcp-47},
    {90, -0x1.5d1bdbf581p-2, 0x1.8d6bdc9c7c238p-44},
    {89, -0x1.51aad872ep-2, 0x1.f4bd8db0a7cc1p-44},
    {88, -0x1.4618bc21c6p-2, 0x1.3d82f484c84ccp-46},
    {87, -0x1.3a64c55694p-2, -0x1.7a71cbcd735dp-44},
    {86, -0x1.2e8e2bae12p-2, 0x1.67b1e99b72bd8p-45},
    {85, -0x1.22941fbcf8p-2, 0x1.a6976f5eb0963p-44},
    {84, -0x1.1675cababap-2, -0x1.8380e731f55c4p-44},
    {83, -0x1.0a324e2739p-2, -0x1.c6bee7ef4030ep-47},
    {82, -0x1.fb9186d5e4p-3, 0x1.d572aab993c87p-47},
    {82, -0x1.fb9186d5e4p-3, 0x1.d572aab993c87p-47},
    {81, -0x1.e27076e2bp-3, 0x1.a342c2af0003cp-44},
    {80, -0x1.c8ff7c79aap-3, 0x1.7794f689f8434p-45},
    {79, -0x1.af3c94e80cp-3, 0x1.a4e633fcd9066p-52},
    {78, -0x1.9525a9cf46p-3, 0x1.297137d9f158fp-44},
    {78, -0x1.9525a9cf46p-3, 0x1.297137d9f158fp-44},
    {77, -0x1.7ab890210ep-3, 0x1.bdb9072534a58p-45},
    {76, -0x1.5ff3070a7ap-3, 0x1.8586f183bebf2p-44},
    {75, -0x1.44d2b6ccb8p-3, 0x1.70cc16135783cp-46},
    {75, -0x1.44d2b6ccb8p-3, 0x1.70cc16135783cp-46},
    {74, -0x1.29552f82p-3, 0x1.5b967f4471dfcp-44},
    {73, -0x1.0d77e7cd08p-3, -0x1.cb2cd2ee2f482p-44},
    {73, -0x1.0d77e7cd08p-3, -0x1.cb2cd2ee2f482p-44},
    {72, -0x1.e27076e2bp-4, 0x1.a342c2af0003cp-45},
    {72, -0x1.e27076e2bp-4, 0x1.a342c2af0003cp-45},
    {71, -0x1.a926d3a4acp-4, -0x1.563650bd22a9cp-44},
    {70, -0x1.6f0d28ae58p-4, 0x1.4b4641b664613p-44},
    {70, -0x1.6f0d28ae58p-4, 0x1.4b4641b664613p-44},
    {69, -0x1.341d7961bcp-4, -0x1.1d0929983761p-44},
    {69, -0x1.341d7961bcp-4, -0x1.1d0929983761p-44},
    {68, -0x1.f0a30c0118p-5, 0x1.d599e83368e91p-45},
    {67, -0x1.77458f633p-5, 0x1.181dce586af09p-44},
    {67, -0x1.77458f633p-5, 0x1.181dce586af09p-44},
    {66, -0x1.f829b0e78p-6, -0x1.980267c7e09e4p-45},
    {66, -0x1.f829b0e78p-6, -0x1.980267c7e09e4p-45},
    {65, -0x1.fc0a8b0fcp-7, -0x1.f1e7cf6d3a69cp-50},
    {65, -0x1.fc0a8b0fcp-7, -0x1.f1e7cf6d3a69cp-50},
    {64, 0x0p0, 0x0p0},
};

static double power_of_2(int32_t exponent)
{
    const uint64_t bits = (uint64_t)(exponent + 1023) << 52;
    double power;
    memcpy(&power, &bits, sizeof power);
    return power;
}

/* e^(x + rest), if rest is below an ulp of x. */
static double exp_of_sum(double x, double rest)
{
    if (!(x < 710))
        return x * HUGE_VAL;
    if (x < -746)
        return 0;
    const double n = (x * PER_STEP + ROUNDER) - ROUNDER;
    const int32_t k = (int32_t)n, j = k & (N_EXP - 1), exponent = (k - j) / N_EXP;
    const int32_t first = exponent > -1000 && exponent < 1000 ? exponent : exponent / 2;
    const double scale = power_of_2(first), high = EXP[j].high * scale, low = EXP[j].low * scale;
    const double r = (x - n * STEP_HIGH) - (n * STEP_LOW - rest), r2 = r * r;
    const double p = (r + r2 * (0.5 + r * (1.0 / 6))) +
                     r2 * r2 * ((1.0 / 24 + r * (1.0 / 120)) + r2 * (1.0 / 720));
    const double value = high + (low + high * p);
    return first == exponent ? value : value * power_of_2(exponent - first);
}

double iccp_exp(double x)
{
    return exp_of_sum(x, 0);
}

/* (log(1 + r) - r) / r^2 */
static double log_series(double r)
{
    const double r2 = r * r;
    const double high = (-1.0 / 6 + r * (1.0 / 7)) + r2 * (-1.0 / 8 + r * (1.0 / 9));
    return (-0.5 + r * (1.0 / 3)) + r2 * ((-1.0 / 4 + r * (1.0 / 5)) + r2 * high);
}

/* log x = result + *low for 0 < x < infinity. */
static inline double log_in_parts(double x, double *low)
{
    /* The fraction of m, and the bits of it that the upper half of m lacks. */
    const uint64_t fraction = ((uint64_t)1 << 52) - 1, lower_half = ((uint64_t)1 << 27) - 1;
    const bool tiny = x < DBL_MIN;
    uint64_t bits, upper;
    double m, m_high, error;
    if (tiny)
        x *= 0x1p54;
    memcpy(&bits, &x, sizeof bits);
    const size_t j = (bits & fraction) >> 46;
    const int32_t bias = (tiny ? 1023 + 54 : 1023) - (j >= FIRST_DOUBLED);
    const double exponent = (double)((int32_t)(bits >> 52) - bias);
    bits = (bits & fraction) | (uint64_t)1023 << 52;
    upper = bits & ~lower_half;
    memcpy(&m, &bits, sizeof m);
    memcpy(&m_high, &upper, sizeof m_high);
    const double q = LOG[j].quotient * 0x1p-7, r = (m_high * q - 1) + (m - m_high) * q;
    const double whole = exponent * LN2_HIGH + LOG[j].high;
    const double high = iccp_fast_two_sum(whole, r, &error);
    *low = (error + (exponent * LN2_LOW + LOG[j].low)) + r * r * log_series(r);
    return high;
}

/* log x if x is not positive and finite. */
static double log_beyond(double x)
{
    return x < 0 ? NAN : x <= 0 ? -HUGE_VAL : x;
}

double iccp_ln(double x)
{
    double low;
    if (!(x > 0 && x < HUGE_VAL))
        return log_beyond(x);
    const double high = log_in_parts(x, &low);
    return high + low;
}

/* Rounding 1 + x to u loses d. The formula log(u + d) = log u + d / u corrects this. */
double iccp_ln1p(double x)
{
    double low, lost;
    if (x > -0x1p-7 && x < 0x1p-6)
        return fabs(x) < 0x1p-60 ? x : x + x * x * log_series(x);
    if (!(x > -1 && x < HUGE_VAL))
        return log_beyond(1 + x);
    const double u = iccp_two_sum(1, x, &lost);
    const double high = log_in_parts(u, &low);
    return high + (low + lost / u);
}

double iccp_pow(double x, double y)
{
    double low, rest;
    if (y >= 0 && y <= 0)
        return 1;
    if (!(x > 0 && x < HUGE_VAL))
        return iccp_exp(y * log_beyond(x));
    const double most = log_in_parts(x, &low), high = iccp_fast_two_sum(most, low, &low);
    const double product = iccp_two_product(y, high, &rest);
    return exp_of_sum(product, rest + y * low);
}
