#include "job/fill.h"

#include "base/allocate.h"
#include "cage/filling.h"

#include <stdlib.h>
#include <string.h>

static const char *mesh_name(const job *j, size_t side)
{
    return side == 0 ? j->args->mesh : j->args->target_mesh;
}

static bool given(const job *j)
{
    return j->args->mesh != NULL || j->args->target_mesh != NULL;
}

static bool wanted(const job *j)
{
    bool suits = j->args->method == 0 || j->args->method == ICC_METHOD_FOLIATION;
    return given(j) || (job_dim(j) == 3 && j->cages[0].cells == NULL && suits);
}

static int check(const job *j)
{
    if (!given(j))
        return DONE;
    if (job_dim(j) != 2 && job_dim(j) != 3)
        return failed(j->args->source, 0, "%zu dimensions; meshes have 2 or 3", job_dim(j));
    if (j->cages[0].cells != NULL)
        return failed(j->args->source, 0, "a mask; --mesh is for cages");
    if (j->cages[0].n_features > 0)
        return failed(j->args->source, 0,
                      "holes, lines or points inside; --mesh is for cages without");
    if (j->args->target_mesh != NULL && j->args->target == NULL)
        return misused(j->args->command, "--target-mesh needs --target");
    return DONE;
}

/* The cage without vertices that no facet has: a mesh need not have them either. To be freed. */
static cage used_part(const cage *c)
{
    cage used = {.dim = c->dim, .n_facets = c->n_facets};
    uint32_t *place = need(c->n, sizeof *place);
    used.points = need(c->n, c->dim * sizeof *used.points);
    used.facets = need(c->n_facets, c->dim * sizeof *used.facets);
    for (size_t i = 0; i < c->n_facets * c->dim; i++)
        place[c->facets[i]] = 1;
    for (size_t v = 0; v < c->n; v++)
        if (place[v] > 0 || c->n_facets == 0) {
            memcpy(used.points + c->dim * used.n, c->points + c->dim * v,
                   c->dim * sizeof *used.points);
            place[v] = (uint32_t)used.n++;
        }
    for (size_t i = 0; i < c->n_facets * c->dim; i++)
        used.facets[i] = place[c->facets[i]];
    free(place);
    return used;
}

static int read_filling(filling *out, const job *j, const cage *c, size_t side)
{
    const char *name = mesh_name(j, side);
    size_t n;
    char *text = file_read(name, &n);
    if (text == NULL)
        return FAILED;
    problem wrong;
    bool good = filling_read(out, c, text, n, &wrong);
    free(text);
    return good ? DONE : failed(name, wrong.line, "%s", wrong.text);
}

/* PARTIAL: there is no mesh, and none can be made; another method will do. */
static int find_filling(filling *out, job *j, const cage *c, size_t side)
{
    if (mesh_name(j, side) != NULL)
        return read_filling(out, j, c, side);
    const char *name = job_file(j, (int)side + 1);
    problem wrong = {0, "tetgen is not installed"};
    if (job_dim(j) == 3 && filling_can_make() && filling_make(out, c, &wrong)) {
        if (j->bar.wanted)
            note("%s: filled with %zu tetrahedra by tetgen", name, out->n);
        return DONE;
    }
    if (given(j) || j->args->method == ICC_METHOD_FOLIATION)
        return failed(name, 0, "no mesh of its inside: %s; give one with --%smesh",
                      job_dim(j) == 3 ? wrong.text : "there is one of the other cage",
                      side == 0 ? "" : "target-");
    if (j->bar.wanted)
        note("%s: %s; method field on a grid instead of foliation", name, wrong.text);
    return PARTIAL;
}

static int make_filled(icc_domain **out, job *j, size_t side, const filling *f)
{
    icc_error err = {.size = sizeof err, .index = -1};
    if (icc_domain_create_mesh(out, (int32_t)f->dim, f->n_points, f->points, f->n, f->corners,
                               f->n_facets, f->facets, &j->env, &err) == ICC_OK)
        return DONE;
    progress_end(&j->bar);
    const char *name = mesh_name(j, side);
    return failed(name != NULL ? name : job_file(j, (int)side + 1), 0, "%s%s",
                  name != NULL ? "" : "the mesh that tetgen has made: ", err.message);
}

int fill_domains(job *j)
{
    filling fillings[2] = {{0}, {0}};
    icc_domain *filled[2] = {NULL, NULL};
    size_t n = j->args->target != NULL ? 2 : 1;
    if (!wanted(j))
        return DONE;
    int result = check(j);
    for (size_t side = 0; result == DONE && side < n; side++) {
        cage used = used_part(&j->cages[side]);
        result = find_filling(&fillings[side], j, &used, side);
        cage_free(&used);
    }
    for (size_t side = 0; result == DONE && side < n; side++)
        result = make_filled(&filled[side], j, side, &fillings[side]);
    for (size_t side = 0; side < 2; side++) {
        filling_free(&fillings[side]);
        icc_domain_free(result == DONE ? j->domains[side] : filled[side]);
        if (result == DONE)
            j->domains[side] = filled[side];
    }
    return result == PARTIAL ? DONE : result;
}
