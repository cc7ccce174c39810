/* Sorts items by keys of 64 bits, digit by digit. Items with equal keys keep their order. Takes time
 * proportional to their number, and leaves out digits that all keys share. */
#ifndef RADIX_SORT_H
#define RADIX_SORT_H

#include <stddef.h>
#include <stdint.h>

typedef struct keyed {
    uint64_t key;
    uint32_t item;
} keyed;

void radix_sort(size_t n, keyed *list);

/* A key that orders finite numbers as their values. Both zeros have the same key. */
uint64_t radix_key(double value);

#endif
