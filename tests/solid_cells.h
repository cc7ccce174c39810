/* Solids made of unit cells, with a mesh of Kuhn tetrahedra: cells are labelled with parts. */
#ifndef TESTS_SOLID_CELLS_H
#define TESTS_SOLID_CELLS_H

#include <icc/icc.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>

enum { CELLS = 8, CELL_CORNERS = CELLS + 1, MOST_CELL_PARTS = 8, NO_CELL = -1 };

typedef struct cell_surface {
    size_t n_vertices, n_facets;
    double *vertices;
    uint32_t *facets;
} cell_surface;

/* Part 0 is the outer one. Part k > 0 lies in part around[k] and is empty if it is a void. */
typedef struct cell_solid {
    size_t n_parts;
    int around[MOST_CELL_PARTS];
    int is_void[MOST_CELL_PARTS];
    cell_surface surface[MOST_CELL_PARTS];
    int label[CELLS][CELLS][CELLS]; /* NO_CELL: outside */
    /* filled in by cell_solid_mesh() */
    size_t n_points, n_tets;
    double *points;
    uint32_t *tets;
    int *part; /* by tetrahedron */
} cell_solid;

static inline int cell_label(const cell_solid *c, int x, int y, int z)
{
    const int inside = x >= 0 && y >= 0 && z >= 0 && x < CELLS && y < CELLS && z < CELLS;
    return inside ? c->label[x][y][z] : NO_CELL;
}

/* Whether a cell lies in a part or in a part in it. */
static inline int cell_in(const cell_solid *c, int part, int label)
{
    while (label > 0 && label != part)
        label = c->around[label];
    return label == part;
}

static inline uint32_t cell_corner(const int at[3])
{
    return (uint32_t)((at[0] * CELL_CORNERS + at[1]) * CELL_CORNERS + at[2]);
}

/* Adds the two triangles of the lower (0) or upper (1) face of a cell along an axis, seen from
 * beyond it. */
static inline void cell_face(cell_surface *s, const int cell[3], int axis, int upper)
{
    int corner[4][3];
    for (int i = 0; i < 4; ++i) {
        memcpy(corner[i], cell, sizeof corner[i]);
        corner[i][axis] += upper;
        corner[i][(axis + 1) % 3] += i == 1 || i == 2;
        corner[i][(axis + 2) % 3] += i >= 2;
    }
    static const int order[2][6] = {{0, 2, 1, 0, 3, 2}, {0, 1, 2, 0, 2, 3}};
    s->facets = realloc(s->facets, 3 * (s->n_facets + 2) * sizeof *s->facets);
    for (int i = 0; i < 6; ++i)
        s->facets[3 * s->n_facets + (size_t)i] = cell_corner(corner[order[upper][i]]);
    s->n_facets += 2;
}

/* Numbers the corners that a surface uses, from 0. */
static inline void cell_compact(cell_surface *s)
{
    uint32_t number[CELL_CORNERS * CELL_CORNERS * CELL_CORNERS];
    memset(number, 0xff, sizeof number);
    s->vertices = malloc(3 * 3 * s->n_facets * sizeof *s->vertices);
    for (size_t i = 0; i < 3 * s->n_facets; ++i) {
        const uint32_t v = s->facets[i];
        if (number[v] == UINT32_MAX) {
            double *x = s->vertices + 3 * s->n_vertices;
            number[v] = (uint32_t)s->n_vertices++;
            x[0] = v / (CELL_CORNERS * CELL_CORNERS);
            x[1] = v / CELL_CORNERS % CELL_CORNERS;
            x[2] = v % CELL_CORNERS;
        }
        s->facets[i] = number[v];
    }
}

/* Makes the surfaces of all parts from their labels. Voids are seen from outside themselves, too. */
static inline void cell_solid_surfaces(cell_solid *c)
{
    for (int part = 0; part < (int)c->n_parts; ++part) {
        cell_surface *s = &c->surface[part];
        for (int x = 0; x < CELLS; ++x)
            for (int y = 0; y < CELLS; ++y)
                for (int z = 0; z < CELLS; ++z)
                    for (int side = 0; side < 6 && cell_in(c, part, c->label[x][y][z]); ++side) {
                        const int cell[3] = {x, y, z}, step = side % 2 != 0 ? 1 : -1;
                        int next[3] = {x, y, z};
                        next[side / 2] += step;
                        if (!cell_in(c, part, cell_label(c, next[0], next[1], next[2])))
                            cell_face(s, cell, side / 2, side % 2);
                    }
        cell_compact(s);
    }
}

/* Makes the mesh. Its first points are the vertices of `first`, n_first in local or other
 * coordinates that are those of the corners; the others follow. */
static inline void cell_solid_mesh(cell_solid *c, size_t n_first, const double *first)
{
    static const int ways[6][3] = {{0, 1, 2}, {1, 2, 0}, {2, 0, 1},
                                   {0, 2, 1}, {2, 1, 0}, {1, 0, 2}};
    const size_t n_corners = (size_t)CELL_CORNERS * CELL_CORNERS * CELL_CORNERS;
    uint32_t number[CELL_CORNERS * CELL_CORNERS * CELL_CORNERS];
    memset(number, 0xff, sizeof number);
    c->points = malloc(3 * (n_first + n_corners) * sizeof *c->points);
    c->tets = malloc(24 * (size_t)CELLS * CELLS * CELLS * sizeof *c->tets);
    c->part = malloc(6 * (size_t)CELLS * CELLS * CELLS * sizeof *c->part);
    for (c->n_points = 0; c->n_points < n_first; ++c->n_points) {
        const double *x = first + 3 * c->n_points;
        const int at[3] = {(int)x[0], (int)x[1], (int)x[2]};
        memcpy(c->points + 3 * c->n_points, x, 3 * sizeof *x);
        number[cell_corner(at)] = (uint32_t)c->n_points;
    }
    for (int cell = 0; cell < CELLS * CELLS * CELLS; ++cell) {
        const int at[3] = {cell / (CELLS * CELLS), cell / CELLS % CELLS, cell % CELLS};
        const int label = c->label[at[0]][at[1]][at[2]];
        if (label == NO_CELL || c->is_void[label])
            continue;
        for (int way = 0; way < 6; ++way) {
            int corner[3] = {at[0], at[1], at[2]};
            uint32_t *tet = c->tets + 4 * c->n_tets;
            for (int i = 0; i < 4; ++i) {
                const uint32_t v = cell_corner(corner);
                if (number[v] == UINT32_MAX) {
                    number[v] = (uint32_t)c->n_points;
                    for (int k = 0; k < 3; ++k)
                        c->points[3 * c->n_points + (size_t)k] = corner[k];
                    ++c->n_points;
                }
                tet[i] = number[v];
                if (i < 3)
                    ++corner[ways[way][i]];
            }
            if (way >= 3) {
                const uint32_t swap = tet[2];
                tet[2] = tet[3];
                tet[3] = swap;
            }
            c->part[c->n_tets++] = label;
        }
    }
}

static inline void cell_solid_free(cell_solid *c)
{
    for (size_t k = 0; k < c->n_parts; ++k) {
        free(c->surface[k].vertices);
        free(c->surface[k].facets);
    }
    free(c->points);
    free(c->tets);
    free(c->part);
}

#endif
