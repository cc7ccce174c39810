/* Numbers the faces of a mesh by sorting their vertices. */
#include "shelling/faces.h"

#include "geometry/tuples.h"

/* Lists the sets of `size` of a simplex's corners. */
static size_t list_sets(size_t dim, size_t size, unsigned *sets)
{
    size_t n = 0;
    for (unsigned set = 1; set < 2u << dim; ++set)
        if (iccp_set_size(set) == size)
            sets[n++] = set;
    return n;
}

static void copy_vertices(const uint32_t *corners, size_t size, unsigned set, uint32_t *vertices)
{
    size_t n = 0;
    for (size_t i = 0; set >> i != 0; ++i)
        if (set >> i & 1)
            vertices[n++] = corners[i];
    (void)iccp_sort_vertices(size, vertices);
}

/* Gives equal numbers to faces with the same vertices. */
static void number_sorted(iccp_faces *faces, const iccp_tuples *t, size_t n_sets,
                          const unsigned *sets)
{
    for (size_t begin = 0; begin < t->n; ++faces->n_faces) {
        const size_t end = iccp_tuples_end(t, begin);
        for (; begin < end; ++begin) {
            const size_t simplex = t->order[begin] / n_sets, set = sets[t->order[begin] % n_sets];
            faces->number[faces->per_simplex * simplex + faces->place[set]] =
                (uint32_t)faces->n_faces;
        }
    }
}

/* Numbers the faces with `size` corners. Each simplex lists its faces by their sorted vertices.
 * After sorting the lists, equal faces are neighbours. */
static icc_status number_size(iccp_faces *faces, const iccp_simplices *mesh, size_t size,
                              const iccp_env *env)
{
    unsigned sets[2 << ICC_MAX_DIM];
    const size_t n_sets = list_sets(mesh->dim, size, sets);
    iccp_tuples t;
    if (mesh->n_simplices > (UINT32_MAX - faces->n_faces) / n_sets)
        return ICC_ERR_MEMORY;
    icc_status status = iccp_progress(env, "order", (double)(size - 1) / (double)mesh->dim);
    if (status == ICC_OK)
        status =
            iccp_tuples_create(&t, n_sets * mesh->n_simplices, size, mesh->n_points, &env->memory);
    if (status != ICC_OK)
        return status;
    for (size_t i = 0; i < t.n; ++i)
        copy_vertices(mesh->corners + (mesh->dim + 1) * (i / n_sets), size, sets[i % n_sets],
                      t.vertices + size * i);
    iccp_tuples_sort(&t);
    number_sorted(faces, &t, n_sets, sets);
    iccp_tuples_free(&t);
    return ICC_OK;
}

icc_status iccp_faces_create(iccp_faces *faces, const iccp_simplices *mesh, const iccp_env *env)
{
    *faces = (iccp_faces){.memory = env->memory};
    for (unsigned set = 1; set < 2u << mesh->dim; ++set)
        if (iccp_set_size(set) < mesh->dim)
            faces->place[set] = (uint8_t)faces->per_simplex++;
    faces->number =
        iccp_alloc(&env->memory, mesh->n_simplices, faces->per_simplex * sizeof(uint32_t));
    icc_status status = faces->number != NULL ? ICC_OK : ICC_ERR_MEMORY;
    for (size_t size = 1; status == ICC_OK && size < mesh->dim; ++size)
        status = number_size(faces, mesh, size, env);
    if (status != ICC_OK)
        iccp_faces_free(faces);
    return status;
}

void iccp_faces_free(iccp_faces *faces)
{
    iccp_free(&faces->memory, faces->number);
    faces->number = NULL;
}
