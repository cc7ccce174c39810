/* Any bytes at all must give a mesh whose numbers stand in the text one behind the other, or a
 * reason; what is written must read back as the same mesh, and writing that gives the same bytes.
 * What is attached to vertices is carried by a map, or there is a reason; then it reads back as well.
 * Nothing is leaked, and nothing beyond the text is read. */
#define _POSIX_C_SOURCE 200809L

#include "base/foreign.h"
#include "base/gltf_pack.h"
#include "fuzz.h"
#include "mesh/mesh_carry.h"
#include "mesh/mesh_vectors.h"
#include "mesh/tally.h"

#include <math.h>

/* The types, then the spans: each begins where the one before has ended, or later. */
static void require_ascending(const mesh_file *m)
{
    size_t done = 0;
    for (size_t i = 0; i < m->n_types; i++) {
        require(done <= m->types[i][0] && m->types[i][0] <= m->types[i][1]);
        done = m->types[i][1];
    }
    for (size_t i = 0; i < m->n_vertices * m->n_spans; i++) {
        require(done <= m->spans[2 * i] && m->spans[2 * i] < m->spans[2 * i + 1]);
        done = m->spans[2 * i + 1];
    }
    require(done <= m->n_text);
}

/* Nothing becomes of elements that stay; what was positive is positive. */
static void require_tally(const mesh_file *m)
{
    tally t;
    size_t n = 0;
    tally_make(&t, m, m->points);
    for (const tally_kind *k = t.kinds; k < t.kinds + n_element_kinds; k++) {
        n += k->all;
        require(k->inverted + k->collapsed + k->without_image == 0);
        require(k->undecided == 0 || k->kind->shape == SHAPE_OTHER);
        require(k->kind->dim != m->dim || k->kept + k->flat_before + k->undecided == k->all);
    }
    require(n == m->n_elements);
    tally_free(&t);
}

static void require_sound(const mesh_file *m)
{
    require(m->n_vertices > 0);
    require(m->n_spans == 1 || m->n_spans == m->dim || mesh_is_glb(m->text, m->n_text) ||
            m->vtu != NULL);
    require_ascending(m);
    for (size_t i = 0; i < m->n_vertices * m->dim; i++)
        require(isfinite(m->points[i]) != 0);
    for (size_t i = 0; i < 3 * m->n_triangles; i++)
        require(m->triangles[i] < m->n_vertices && m->triangle_lines[i / 3] <= m->n_text + 1);
    for (size_t i = 0; i < 4 * m->n_tetrahedra; i++)
        require(m->tetrahedra[i] < m->n_vertices);
    require(m->n_faces <= m->n_triangles);
    for (size_t i = 0; i < m->n_elements; i++)
        require(m->node_starts[i] <= m->node_starts[i + 1]);
    for (size_t k = 0; m->n_elements > 0 && k < m->node_starts[m->n_elements]; k++)
        require(m->nodes[k] < m->n_vertices);
    require_tally(m);
}

/* Normals of vertices: likewise, those of the file's vertices. */
static void require_normals(const mesh_file *m)
{
    const mesh_normals *of = &m->vertex_normals;
    size_t done = 0;
    for (size_t i = 0; i < of->n * of->n_spans; i++) {
        require(done <= of->spans[2 * i] && of->spans[2 * i] <= of->spans[2 * i + 1]);
        done = of->spans[2 * i + 1];
    }
    require(done <= m->n_text);
    for (size_t k = 0; k < of->n_uses; k++)
        require(of->uses[2 * k + 1] < m->n_vertices);
}

/* What mesh_write() writes, of exactly n bytes and a '\0'. */
static char *write_mesh(const mesh_file *m, const double *points, const char *name, size_t *n)
{
    char *text = NULL;
    FILE *stream = open_memstream(&text, n);
    if (stream == NULL)
        exit(0);
    mesh_write(m, points, name, stream);
    require(fclose(stream) == 0);
    char *exact = malloc(*n + 1);
    if (exact == NULL)
        exit(0);
    memcpy(exact, text, *n + 1);
    free(text);
    return exact;
}

/* What is written reads back, unless what marks another format has moved to where it is looked for. */
static bool read_back(mesh_file *out, const mesh_file *m, const char *text, size_t n)
{
    problem wrong;
    bool good = mesh_read(out, m->dim, text, n, &wrong);
    require(good || foreign_told(text, n, &wrong));
    return good;
}

static void require_written(const mesh_file *m)
{
    size_t n, n_again;
    char *text = write_mesh(m, m->points, "out", &n);
    mesh_file back;
    if (!read_back(&back, m, text, n)) {
        mesh_free(&back);
        free(text);
        return;
    }
    require_sound(&back);
    require(back.n_vertices == m->n_vertices && back.n_triangles == m->n_triangles &&
            back.n_tetrahedra == m->n_tetrahedra && back.n_elements == m->n_elements &&
            strcmp(back.format, m->format) == 0);
    for (size_t i = 0; i < m->n_vertices * m->dim; i++)
        require(back.points[i] <= m->points[i] && back.points[i] >= m->points[i]);
    char *again = write_mesh(&back, back.points, "out", &n_again);
    require(n_again == n && memcmp(again, text, n) == 0);
    mesh_free(&back);
    free(again);
    free(text);
}

/* ------------------------------------------------------------ what is attached */

static bool shear(void *data, size_t n, const double *points, double *images, size_t *n_failed)
{
    const size_t dim = *(const size_t *)data;
    for (size_t i = 0; i < n; i++)
        for (size_t k = 0; k < dim; k++)
            images[dim * i + k] =
                points[dim * i + k] + (k == 0 ? 0.25 * points[dim * i + 1] : 0) + 1;
    *n_failed = n % 2;
    return n != 7;
}

/* Every fifth point has no derivative. */
static bool derive(void *data, size_t n, const double *points, const double *directions,
                   double *derivatives)
{
    const size_t dim = *(const size_t *)data;
    for (size_t i = 0; i < n; i++) {
        require(isfinite(points[dim * i]) != 0 && !isnan(directions[3 * i]));
        for (size_t k = 0; k < dim * dim; k++)
            derivatives[dim * dim * i + k] = i % 5 == 4           ? (double)NAN
                                             : k / dim == k % dim ? 1
                                             : k == 1             ? 0.25
                                                                  : 0;
    }
    return n != 11;
}

/* A scene that is written as JSON reads back as the same mesh. */
static void require_packed(const mesh_file *m, problem *wrong)
{
    size_t n_packed, n_text;
    if (!mesh_is_glb(m->text, m->n_text))
        return;
    char *text = write_mesh(m, m->points, "out.gltf", &n_text);
    char *packed = gltf_told(text, n_text) ? gltf_pack("-", text, n_text, &n_packed, wrong) : NULL;
    mesh_file back = {.n_text = 0};
    if (packed != NULL && mesh_read(&back, m->dim, packed, n_packed, wrong))
        require(back.n_vertices == m->n_vertices && back.n_triangles == m->n_triangles);
    mesh_free(&back);
    free(packed);
    free(text);
}

static void require_carried(mesh_file *m, problem *wrong)
{
    double *images = calloc(m->n_vertices, m->dim * sizeof *images);
    size_t none, beyond, n;
    mesh_mover mover = {&m->dim, shear, derive};
    mesh_carried what;
    bool finite = true;
    if (images == NULL)
        exit(0);
    shear(&m->dim, m->n_vertices, m->points, images, &none);
    for (size_t i = 0; i < m->n_vertices * m->dim; i++)
        finite = finite && isfinite(images[i]) != 0;
    if (finite && mesh_round(m, images, &beyond)) {
        bool known = mesh_carry(m, images, NULL, &what, wrong);
        require(known || wrong->text[0] != '\0');
        bool good = mesh_carry(m, images, &mover, &what, wrong);
        require(known || !good);
        /* Vectors may be spoilt in a file whose mesh is sound. */
        if (good && !mesh_rotate_vectors(m, &mover, &what.rotated, wrong))
            require(wrong->text[0] == '\0' || strpbrk(wrong->text, "\r\n") == NULL);
        require(what.rotated.n_stay <= what.rotated.n_vectors);
        if (good) {
            mesh_file back;
            require(what.n_stay <= what.n_vectors && what.shared >= 0 && what.shared <= 180);
            char *text = write_mesh(m, images, "out", &n);
            if (read_back(&back, m, text, n)) {
                require_sound(&back);
                require_normals(&back);
                require(back.n_vertices == m->n_vertices && back.n_triangles == m->n_triangles &&
                        back.vertex_normals.n_uses == m->vertex_normals.n_uses);
            }
            mesh_free(&back);
            free(text);
        } else {
            require(strpbrk(wrong->text, "\r\n") == NULL);
        }
    }
    free(images);
}

/* A scene in JSON comes to the readers as one binary file. */
static char *pack(char *text, size_t *n)
{
    problem wrong;
    if (!gltf_told(text, *n))
        return text;
    char *packed = gltf_pack("-", text, *n, n, &wrong);
    require(packed != NULL || (wrong.text[0] != '\0' && strpbrk(wrong.text, "\r\n") == NULL));
    free(text);
    return packed;
}

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size)
{
    char *text = text_of(data, size);
    if (text != NULL)
        text = pack(text, &size);
    if (text == NULL)
        return 0;
    for (size_t dim = 2; dim <= 3; dim++) {
        mesh_file m;
        problem wrong = {.text = ""};
        if (mesh_read(&m, dim, text, size, &wrong)) {
            require_sound(&m);
            require_normals(&m);
            require_written(&m);
            require_packed(&m, &wrong);
            require_carried(&m, &wrong);
        } else {
            require(wrong.text[0] != '\0' && strpbrk(wrong.text, "\r\n") == NULL);
            require(strlen(wrong.text) < sizeof wrong.text);
        }
        mesh_free(&m);
    }
    free(text);
    return 0;
}
