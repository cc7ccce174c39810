/* Goes from the last digit to the first (H. H. Seward, 1954). */
#include "base/radix_sort.h"

#include "base/allocate.h"

#include <stdlib.h>
#include <string.h>

enum { BITS = 11, N_VALUES = 1 << BITS, N_DIGITS = (64 + BITS - 1) / BITS };

static size_t digit_of(uint64_t key, int digit)
{
    return (size_t)(key >> (BITS * digit)) & (N_VALUES - 1);
}

/* Moves a list to another one in the order of a digit. `counts` has the number of each value. */
static void move_by_digit(size_t n, const keyed *from, keyed *to, int digit, size_t *counts)
{
    size_t at = 0;
    for (size_t value = 0; value < N_VALUES; value++) {
        size_t count = counts[value];
        counts[value] = at;
        at += count;
    }
    for (size_t i = 0; i < n; i++)
        to[counts[digit_of(from[i].key, digit)]++] = from[i];
}

void radix_sort(size_t n, keyed *list)
{
    if (n < 2)
        return;
    keyed *from = list, *to = need(n, sizeof *to), *other = to;
    size_t(*counts)[N_VALUES] = need(N_DIGITS, sizeof *counts);
    for (size_t i = 0; i < n; i++)
        for (int digit = 0; digit < N_DIGITS; digit++)
            counts[digit][digit_of(list[i].key, digit)]++;
    for (int digit = 0; digit < N_DIGITS; digit++) {
        if (counts[digit][digit_of(list[0].key, digit)] == n)
            continue;
        move_by_digit(n, from, to, digit, counts[digit]);
        keyed *next = from;
        from = to;
        to = next;
    }
    if (from != list)
        memcpy(list, from, n * sizeof *list);
    free(other);
    free(counts);
}

uint64_t radix_key(double value)
{
    uint64_t bits, sign = (uint64_t)1 << 63;
    value += 0; /* makes -0 a 0 */
    memcpy(&bits, &value, sizeof bits);
    return bits & sign ? ~bits : bits | sign;
}
