/* A session of the studio's mode handles as text, an operation a line, read from the standard input:
 *
 * make NUMBER METHOD SPACING GRID outline handles bones lines regions
 *                                              new weights, kept under a number
 * paint NUMBER HANDLE RADIUS AMOUNT RIGID strokes      new ones, of the last ones
 * method NUMBER METHOD regions                         the same
 * recall NUMBER                                        those of a number again
 * bind points                                          what is posed
 * pose transforms changes                              prints transforms, and images
 *
 * A plural is a list: how many numbers, and the numbers. A line has five of them, and a region is a
 * list by itself; a change is a handle, an offset and an angle. Methods are those of C. */
#ifndef SESSION_H
#define SESSION_H

#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>

typedef struct list {
    size_t n;
    double *x;
} list;

/* One that is missing ends the program. */
static inline double number(void)
{
    double x;
    if (scanf("%lf", &x) != 1) {
        (void)fprintf(stderr, "a number is missing\n");
        exit(EXIT_FAILURE);
    }
    return x;
}

static inline void *room(size_t n, size_t size)
{
    void *memory = calloc(n + 1, size);
    if (memory == NULL)
        exit(EXIT_FAILURE);
    return memory;
}

static inline list numbers(void)
{
    list l = {.n = (size_t)number()};
    l.x = room(l.n, sizeof *l.x);
    for (size_t i = 0; i < l.n; ++i)
        l.x[i] = number();
    return l;
}

static inline uint32_t *indices(const list *l)
{
    uint32_t *all = room(l->n, sizeof *all);
    for (size_t i = 0; i < l->n; ++i)
        all[i] = (uint32_t)l->x[i];
    return all;
}

static inline void print(const char *name, size_t n, const double *x)
{
    (void)printf("%s", name);
    for (size_t i = 0; i < n; ++i)
        (void)printf(" %.17g", x[i]);
    (void)printf("\n");
}

#endif
