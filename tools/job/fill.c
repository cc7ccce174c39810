/* Makes domains with a mesh, from a file or by the library. */
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

/* The library fills the surfaces of a map by itself, but those of a chart only on request. */
static bool wanted(const job *j)
{
    bool suits = j->args->method == 0 || j->args->method == ICC_METHOD_FOLIATION;
    bool solid = job_dim(j) == 3 && j->cages[0].cells == NULL && suits;
    return given(j) || (solid && j->args->target == NULL);
}

static int check(const job *j)
{
    if (!given(j))
        return DONE;
    if (job_dim(j) != 2 && job_dim(j) != 3)
        return failed(j->args->source, 0, "%zu dimensions; meshes have 2 or 3", job_dim(j));
    if (j->cages[0].cells != NULL)
        return failed(j->args->source, 0, "this is a mask; --mesh is for polygons and surfaces");
    if (j->cages[0].n_features > 0)
        return failed(j->args->source, 0,
                      "there are holes, lines or points inside; --mesh needs a cage without "
                      "(--source takes the boundary of a mesh alone)");
    if (j->args->target_mesh != NULL && j->args->target == NULL)
        return misused(j->args->command, "--target-mesh needs --target");
    return DONE;
}

/* A copy of the cage without vertices that belong to no facet, because a mesh need not have them
 * either. Free it. */
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
    char *text = file_read_shape(name, &n);
    if (text == NULL)
        return FAILED;
    problem wrong;
    bool good = filling_read(out, c, text, n, &wrong);
    free(text);
    return good ? DONE : failed(name, wrong.line, "%s", wrong.text);
}

/* Makes a domain from a mesh. *regions becomes false if its regions touch and are left out. */
static icc_status make_domain(icc_domain **out, job *j, const char *name, const filling *f,
                              bool *regions, icc_error *err)
{
    icc_mesh mesh = {.size = sizeof mesh,
                     .dim = (int32_t)f->dim,
                     .n_vertices = f->n_points,
                     .vertices = f->points,
                     .n_cells = f->n,
                     .cells = f->corners,
                     .regions = *regions ? f->regions : NULL};
    icc_status status = icc_domain_create_mesh(out, &mesh, f->n_facets, f->facets, &j->env, err);
    if (mesh.regions == NULL || status != ICC_ERR_BOUNDARY)
        return status;
    icc_error plain = {.size = sizeof plain, .index = -1};
    mesh.regions = NULL;
    *regions = false;
    status = icc_domain_create_mesh(out, &mesh, f->n_facets, f->facets, &j->env, &plain);
    if (status == ICC_OK) {
        progress_end(&j->bar);
        note("%s: the map does not keep the regions: %s", name, err->message);
    } else {
        *err = plain;
    }
    return status;
}

/* Makes a domain from the mesh that is read. */
static int make_from(icc_domain **out, job *j, size_t side, bool *regions)
{
    filling f = {0};
    icc_error err = {.size = sizeof err, .index = -1};
    const char *name = mesh_name(j, side);
    cage used = used_part(&j->cages[side]);
    int result = read_filling(&f, j, &used, side);
    cage_free(&used);
    if (result == DONE && make_domain(out, j, name, &f, regions, &err) != ICC_OK) {
        progress_end(&j->bar);
        result = failed(name, 0, "%s", err.message);
    }
    filling_free(&f);
    return result;
}

static int make_filled(icc_domain **out, job *j, size_t side, bool *regions)
{
    icc_error err = {.size = sizeof err, .index = -1};
    if (mesh_name(j, side) != NULL)
        return make_from(out, j, side, regions);
    if (job_dim(j) != 3)
        return failed(
            job_file(j, (int)side + 1), 0,
            "the other cage has a mesh of its inside, but this one has none; give it with "
            "--%smesh",
            side == 0 ? "" : "target-");
    if (icc_domain_fill(out, j->domains[side], NULL, &j->env, &err) == ICC_OK)
        return DONE;
    err.side = (int32_t)side + 1;
    return job_failed(j, &err);
}

static size_t count_features(const icc_domain *domain)
{
    icc_domain_info info = {.size = sizeof info};
    return icc_domain_get_info(domain, &info) == ICC_OK ? info.n_features : 0;
}

static int make_all(icc_domain *filled[2], job *j, size_t n, bool regions)
{
    int result = DONE;
    for (size_t side = 0; result == DONE && side < n; side++)
        result = make_filled(&filled[side], j, side, &regions);
    if (result != DONE || n < 2 || count_features(filled[0]) == count_features(filled[1]))
        return result;
    if (regions)
        note("%s: the map does not keep the regions, because the meshes do not have the same "
             "number of them",
             mesh_name(j, 0));
    for (size_t side = 0; side < 2; side++) {
        icc_domain_free(filled[side]);
        filled[side] = NULL;
    }
    return make_all(filled, j, n, false);
}

/* A map keeps the regions of two meshes. Charts have none. */
int fill_domains(job *j)
{
    icc_domain *filled[2] = {NULL, NULL};
    const bool regions =
        j->args->mesh != NULL && j->args->target_mesh != NULL && j->args->method == 0;
    size_t n = j->args->target != NULL ? 2 : 1;
    int result = job_make_domains(j);
    if (result != DONE || j->filled || !wanted(j))
        return result;
    result = check(j);
    if (result == DONE)
        result = make_all(filled, j, n, regions);
    for (size_t side = 0; side < 2; side++) {
        icc_domain_free(result == DONE ? j->made[side] : filled[side]);
        if (result == DONE)
            j->domains[side] = j->made[side] = filled[side];
    }
    j->filled = result == DONE;
    return result;
}
