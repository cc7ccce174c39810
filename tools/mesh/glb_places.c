/* Finds how the nodes of a glTF scene place its meshes.
 *
 * Khronos Group, glTF 2.0 Specification, 2021: section 3.7.3 (skins: joints move a skinned mesh,
 * and its node does not). */
#include "base/allocate.h"
#include "base/json_in.h"
#include "mesh/affine_map.h"
#include "mesh/glb_nodes.h"

#include <stdlib.h>
#include <string.h>

typedef struct scene {
    glb_nodes nodes;
    size_t n_skins, n_meshes;
    glb_skin *skins;
    size_t *users;          /* of each mesh: the first node that draws it, or SIZE_MAX */
    double (*matrices)[12]; /* of each mesh that is drawn */
} scene;

/* Finds how a node, or its skin, places its mesh. */
static bool place_mesh(const scene *s, size_t index, double out[12], problem *wrong)
{
    const glb_node *x = &s->nodes.list[index];
    const glb_skin *skin = glb_skin_of(s->skins, x);
    double back[12];
    char shown[32];
    if (json_get(json_get(x->json, "extensions"), "EXT_mesh_gpu_instancing") != NULL)
        return spoilt(wrong, 0,
                      "nodes[%zu] ('%s') stands for many copies of its mesh; make them nodes with "
                      "meshes of their own",
                      index, glb_node_name(shown, x));
    memcpy(out, skin != NULL ? skin->bind : x->matrix, sizeof x->matrix);
    return affine_invert(back, out) ||
           spoilt(wrong, 0,
                  "nodes[%zu] ('%s') flattens its mesh, so there is no way back from the scene to "
                  "the file; give it, and what is above it, a scale without zeros",
                  index, glb_node_name(shown, x));
}

static bool is_same(const double a[12], const double b[12])
{
    for (size_t k = 0; k < 12; k++)
        if (a[k] != b[k])
            return false;
    return true;
}

/* Places all meshes. Several nodes that draw one mesh must place it alike. */
static bool place_meshes(scene *s, problem *wrong)
{
    const glb_node *nodes = s->nodes.list;
    for (size_t i = 0; i < s->nodes.n; i++) {
        const json_item *mesh = json_get(nodes[i].json, "mesh");
        uint32_t which;
        double matrix[12];
        char a[32], b[32];
        if (mesh == NULL)
            continue;
        if (!json_index(mesh, "mesh", "glTF mesh", s->n_meshes, &which, wrong) ||
            !place_mesh(s, i, matrix, wrong))
            return false;
        size_t first = s->users[which];
        if (first != SIZE_MAX && !is_same(s->matrices[which], matrix))
            return spoilt(wrong, 0,
                          "nodes[%zu] ('%s') and nodes[%zu] ('%s') place meshes[%u] differently; "
                          "give each a mesh of its own (Blender: Object > Relations > Make Single "
                          "User)",
                          first, glb_node_name(a, &nodes[first]), i, glb_node_name(b, &nodes[i]),
                          (unsigned)which);
        s->users[which] = first == SIZE_MAX ? i : first;
        memcpy(s->matrices[which], matrix, sizeof matrix);
    }
    return true;
}

/* Places the positions of each mesh that is drawn. Two meshes may share positions. */
static bool place_sets(const glb *g, const scene *s, double (*out)[12], problem *wrong)
{
    size_t *seen = need(g->n_sets, sizeof *seen); /* a mesh's number, from 1 */
    bool good = true;
    for (size_t i = 0; i < g->n_primitives && good; i++) {
        size_t mesh = g->primitives[i].mesh;
        size_t set = glb_set_of(g, &g->primitives[i]);
        if (s->users[mesh] == SIZE_MAX)
            continue;
        if (seen[set] > 0 && !is_same(out[set], s->matrices[mesh]))
            good =
                spoilt(wrong, 0,
                       "meshes[%zu] and meshes[%zu] have the same positions, but nodes place them "
                       "differently; give each its own",
                       seen[set] - 1, mesh);
        memcpy(out[set], s->matrices[mesh], sizeof *out);
        seen[set] = mesh + 1;
    }
    free(seen);
    return good;
}

double (*glb_find_places(const glb *g, problem *wrong))[12]
{
    double(*out)[12] = need(g->n_sets, sizeof *out);
    scene s = {.n_meshes = g->n_meshes,
               .users = need(g->n_meshes, sizeof *s.users),
               .matrices = need(g->n_meshes, sizeof *s.matrices)};
    for (size_t i = 0; i < g->n_meshes; i++)
        s.users[i] = SIZE_MAX;
    for (size_t i = 0; i < g->n_sets; i++)
        affine_identity(out[i]);
    bool good = glb_nodes_read(&s.nodes, g, wrong) &&
                glb_skins_read(&s.skins, &s.n_skins, g, &s.nodes, wrong) &&
                place_meshes(&s, wrong) && place_sets(g, &s, out, wrong);
    glb_nodes_free(&s.nodes);
    glb_skins_free(s.skins, s.n_skins);
    free(s.users);
    free(s.matrices);
    if (!good)
        free(out);
    return good ? out : NULL;
}
