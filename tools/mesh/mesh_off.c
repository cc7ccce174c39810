/* OFF: the number of vertices and faces, then a line for each. */
#include "mesh/mesh_lines.h"

static bool read_face(lines *r)
{
    uint32_t vertex = 0, n_corners = 0;
    if (!lines_next_count(r, 1e6, &n_corners))
        return false;
    lines_begin_face(r);
    for (uint32_t i = 0; i < n_corners; i++) {
        if (!lines_count(r, (double)r->mesh->n_vertices, &vertex))
            return false;
        lines_corner(r, vertex);
    }
    bool good = lines_end_face(r);
    r->at = r->end; /* colours */
    return good;
}

bool mesh_read_off(lines *r)
{
    uint32_t n_vertices, n_faces;
    if (!lines_take(r, "OFF") || !lines_next_count(r, 4e9, &n_vertices) ||
        !lines_count(r, 4e9, &n_faces))
        return false;
    r->at = r->end; /* the number of edges, which is not needed */
    for (uint32_t i = 0; i < n_vertices; i++) {
        if (!lines_word(r) || !lines_vertex(r))
            return false;
        r->at = r->end; /* further coordinates and colours */
    }
    for (uint32_t i = 0; i < n_faces; i++)
        if (!read_face(r))
            return false;
    while (lines_skip_blanks(r), r->at == r->end && lines_next(r))
        ;
    return r->at == r->end ||
           spoilt(r->wrong, r->line, "there is more after the last of %u faces", (unsigned)n_faces);
}
