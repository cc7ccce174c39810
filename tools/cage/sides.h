/* The sides of a surface's triangles, and which triangles meet at them. */
#ifndef SIDES_H
#define SIDES_H

#include "cage/cage.h"

/* Side k of a triangle runs from its corner k to the next one. */
typedef struct side {
    uint32_t low, high; /* its ends, the lower number first */
    uint32_t face, k;
} side;

typedef struct sides {
    size_t n;  /* 3 for each triangle */
    side *all; /* sorted by their ends: sides at the same two vertices lie together */
} sides;

sides sides_make(const cage *c);
void sides_free(sides *s);

/* Counts the sides with the same ends as side i, which has to be the first of them. */
size_t sides_alike(const sides *s, size_t i);

/* True if a side has these two ends. */
bool sides_have(const sides *s, uint32_t a, uint32_t b);

/* True if the side runs from its lower end to its higher one. */
bool side_rises(const cage *c, const side *at);

#endif
