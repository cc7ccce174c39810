/* Finds how the nodes of a glTF scene place its meshes.
 *
 * Khronos Group, glTF 2.0 Specification, 2021: section 3.7.3 (skins: joints move a skinned mesh,
 * and its node does not). */
#include "base/allocate.h"
#include "mesh/affine_map.h"
#include "mesh/glb_nodes.h"

#include <stdlib.h>
#include <string.h>

bool glb_place_node(const glb_nodes *nodes, const glb_skin *skins, size_t index, double out[12],
                    problem *wrong)
{
    const glb_node *x = &nodes->list[index];
    const glb_skin *skin = glb_skin_of(skins, x);
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

double (*glb_find_places(const glb *g, problem *wrong))[12]
{
    double(*out)[12] = need(g->n_sets, sizeof *out);
    glb_nodes nodes = {0};
    glb_skin *skins = NULL;
    size_t n_skins = 0;
    for (size_t i = 0; i < g->n_sets; i++)
        affine_identity(out[i]);
    bool good =
        glb_nodes_read(&nodes, g, wrong) && glb_skins_read(&skins, &n_skins, g, &nodes, wrong);
    for (size_t i = 0; good && i < nodes.n; i++) {
        const json_item *mesh = json_get(nodes.list[i].json, "mesh");
        double matrix[12];
        good = mesh == NULL || glb_place_node(&nodes, skins, i, matrix, wrong);
        size_t which = good && mesh != NULL ? (size_t)mesh->number : g->n_meshes;
        for (size_t k = g->starts[which]; which < g->n_meshes && k < g->starts[which + 1]; k++)
            memcpy(out[glb_set_of(g, g->primitives[k])], matrix, sizeof matrix);
    }
    glb_nodes_free(&nodes);
    glb_skins_free(skins, n_skins);
    if (!good)
        free(out);
    return good ? out : NULL;
}
