/* First cohomology of a mesh by propagation.
 *
 * Source of the propagation: P. Dlotko, R. Specogna, Efficient cohomology computation for
 * electromagnetic modeling, 2010. Edges of a spanning tree get the value 0. A triangle with one
 * edge of unknown value gives that edge its value. If no triangle does, the next unknown edge is
 * free. So each value is a combination of the free edges' values, and one order of edges, the plan,
 * serves all of them.
 *
 * The remaining triangles are conditions. Most follow from others: the values around the faces of a
 * tetrahedron, or of a component of the surface, cancel. So a spanning tree of the graph whose
 * nodes are tetrahedra and components, and whose links are remaining triangles, leaves as many
 * conditions as there are free edges too many. They are independent. (The graph is connected
 * because the triangles of the plan enclose nothing: they can be collapsed one by one.) */
#include "map/topology/region_classes.h"

#include "base/sets.h"

#include <string.h>

typedef struct propagation {
    const iccp_region_cells *cells;
    iccp_region_classes *classes; /* gets the plan, without the tree */
    uint8_t *reached;             /* by vertex: in the spanning tree */
    uint8_t *known;               /* by edge: it has a value */
    uint8_t *used;                /* by face: in the plan */
    uint32_t *queue; /* edges with a value; the triangles of the last ones still wait */
    size_t n_queue, n_done;
    uint32_t *sets; /* of tetrahedra, then of vertices on the surface; before that, vertices */
    uint32_t *conditions; /* faces */
    size_t n_conditions;
} propagation;

static void end(propagation *p, const iccp_memory *memory)
{
    iccp_free(memory, p->reached);
    iccp_free(memory, p->known);
    iccp_free(memory, p->used);
    iccp_free(memory, p->queue);
    iccp_free(memory, p->sets);
    iccp_free(memory, p->conditions);
}

static icc_status begin(propagation *p, iccp_region_classes *classes, const iccp_memory *memory)
{
    const iccp_region_cells *c = classes->cells;
    *p = (propagation){.cells = c, .classes = classes};
    p->reached = iccp_alloc_zero(memory, c->n_vertices, sizeof *p->reached);
    p->known = iccp_alloc_zero(memory, c->n_edges, sizeof *p->known);
    p->used = iccp_alloc_zero(memory, c->n_faces, sizeof *p->used);
    p->queue = iccp_alloc(memory, c->n_edges, sizeof *p->queue);
    p->sets = iccp_alloc(memory, c->n_simplices + c->n_vertices, sizeof *p->sets);
    p->conditions = iccp_alloc(memory, c->n_faces, sizeof *p->conditions);
    classes->plan = iccp_alloc(memory, c->n_edges, sizeof *classes->plan);
    classes->value = iccp_alloc_zero(memory, c->n_edges, sizeof *classes->value);
    const bool has_memory = p->reached != NULL && p->known != NULL && p->used != NULL &&
                            p->queue != NULL && p->sets != NULL && p->conditions != NULL &&
                            classes->plan != NULL && classes->value != NULL;
    return has_memory ? ICC_OK : ICC_ERR_MEMORY;
}

/* ---- the plan ---- */

static void learn(propagation *p, uint32_t edge)
{
    p->known[edge] = 1;
    p->queue[p->n_queue++] = edge;
}

/* Reaches all vertices along edges, breadth first. */
static void plant_tree(propagation *p)
{
    const iccp_region_cells *c = p->cells;
    uint32_t *list = p->sets;
    size_t n = 0;
    list[n++] = c->ends[0];
    p->reached[c->ends[0]] = 1;
    for (size_t done = 0; done < n; ++done) {
        const uint32_t v = list[done];
        for (size_t i = c->edge_first[v]; i < c->edge_first[v + 1]; ++i) {
            const uint32_t *ends = c->ends + 2 * (size_t)c->at_vertex[i];
            const uint32_t w = ends[0] == v ? ends[1] : ends[0];
            if (p->reached[w])
                continue;
            p->reached[w] = 1;
            list[n++] = w;
            learn(p, c->at_vertex[i]);
        }
    }
}

/* Looks for a triangle's only edge without a value. */
static void visit_face(propagation *p, uint32_t face)
{
    const uint32_t *edges = p->cells->face_edges + 3 * (size_t)face;
    uint32_t unknown = UINT32_MAX;
    for (size_t k = 0; k < 3; ++k) {
        if (p->known[edges[k]])
            continue;
        if (unknown != UINT32_MAX)
            return;
        unknown = edges[k];
    }
    if (unknown == UINT32_MAX)
        return;
    p->used[face] = 1;
    p->classes->plan[p->classes->n_plan++] = (iccp_plan_step){unknown, face};
    learn(p, unknown);
}

static void spread(propagation *p)
{
    const iccp_region_cells *c = p->cells;
    for (; p->n_done < p->n_queue; ++p->n_done) {
        const uint32_t e = p->queue[p->n_done];
        for (size_t i = c->face_first[e]; i < c->face_first[e + 1]; ++i)
            visit_face(p, c->at_edge[i]);
    }
}

static void make_plan(propagation *p)
{
    plant_tree(p);
    spread(p);
    for (uint32_t e = 0; e < p->cells->n_edges; ++e) {
        if (p->known[e])
            continue;
        p->classes->plan[p->classes->n_plan++] = (iccp_plan_step){e, ICCP_NO_FACE};
        ++p->classes->n_free;
        learn(p, e);
        spread(p);
    }
}

/* ---- conditions ---- */

static void find_conditions(propagation *p)
{
    const iccp_region_cells *c = p->cells;
    const uint32_t n = (uint32_t)c->n_simplices;
    iccp_sets_begin(p->sets, c->n_simplices + c->n_vertices);
    for (size_t f = 0; f < c->n_faces; ++f)
        for (size_t k = 0; c->face_sides[2 * f + 1] == ICCP_OUTSIDE && k < 2; ++k) {
            const uint32_t *ends = c->ends + 2 * (size_t)c->face_edges[3 * f + k];
            (void)iccp_sets_join(p->sets, n + ends[0], n + ends[1]);
        }
    for (uint32_t f = 0; f < c->n_faces; ++f) {
        const uint32_t other = c->face_sides[2 * (size_t)f + 1];
        const uint32_t surface = n + c->ends[2 * (size_t)c->face_edges[3 * (size_t)f]];
        if (!p->used[f] && !iccp_sets_join(p->sets, c->face_sides[2 * (size_t)f],
                                           other == ICCP_OUTSIDE ? surface : other))
            p->conditions[p->n_conditions++] = f;
    }
}

/* ---- values ---- */

/* Computes all values from those of the free edges, in the order of the plan. */
static void evaluate(const iccp_region_classes *classes, const uint64_t *free_value)
{
    uint64_t *value = classes->value;
    for (size_t i = 0; i < classes->n_plan; ++i) {
        const iccp_plan_step step = classes->plan[i];
        if (step.face == ICCP_NO_FACE) {
            value[step.edge] = *free_value++;
            continue;
        }
        const uint32_t *e = classes->cells->face_edges + 3 * (size_t)step.face;
        if (step.edge == e[2])
            value[e[2]] = iccp_residue_add(value[e[0]], value[e[1]]);
        else
            value[step.edge] =
                iccp_residue_subtract(value[e[2]], value[step.edge == e[0] ? e[1] : e[0]]);
    }
}

/* Fills in the conditions' matrix, a column for each free edge. */
static icc_status fill_matrix(uint64_t *matrix, const propagation *p, const iccp_env *env)
{
    const iccp_region_classes *classes = p->classes;
    const uint64_t *value = classes->value;
    const size_t n = classes->n_free;
    icc_status status = ICC_OK;
    for (size_t c = 0; c < n && p->n_conditions > 0 && status == ICC_OK; ++c) {
        memset(classes->free_value, 0, n * sizeof *classes->free_value);
        classes->free_value[c] = 1;
        evaluate(classes, classes->free_value);
        for (size_t i = 0; i < p->n_conditions; ++i) {
            const uint32_t *e = p->cells->face_edges + 3 * (size_t)p->conditions[i];
            const uint64_t there = iccp_residue_add(value[e[0]], value[e[1]]);
            matrix[n * i + c] = iccp_residue_subtract(there, value[e[2]]);
        }
        status = iccp_progress(env, "check", (double)c / (double)n);
    }
    return status;
}

/* Finds the values of the free edges that meet all conditions. */
static icc_status solve(const propagation *p, const iccp_env *env)
{
    iccp_region_classes *classes = p->classes;
    const iccp_memory *memory = &classes->memory;
    const size_t n = classes->n_free;
    uint64_t *matrix = iccp_alloc(memory, p->n_conditions * n, sizeof *matrix);
    uint32_t *pivots = iccp_alloc(memory, p->n_conditions, sizeof *pivots);
    icc_status status = ICC_ERR_MEMORY;
    classes->basis = iccp_alloc(memory, n * n, sizeof *classes->basis);
    classes->free_value = iccp_alloc(memory, n, sizeof *classes->free_value);
    if (matrix != NULL && pivots != NULL && classes->basis != NULL && classes->free_value != NULL)
        status = fill_matrix(matrix, p, env);
    if (status == ICC_OK) {
        const size_t rank = iccp_residue_reduce(matrix, p->n_conditions, n, pivots);
        classes->n = n - rank;
        iccp_residue_null_space(classes->basis, matrix, rank, n, pivots);
    }
    iccp_free(memory, matrix);
    iccp_free(memory, pivots);
    return status;
}

icc_status iccp_region_classes_create(iccp_region_classes *classes, const iccp_region_cells *cells,
                                      const iccp_env *env)
{
    propagation p;
    *classes = (iccp_region_classes){.memory = env->memory, .cells = cells};
    icc_status status = begin(&p, classes, &env->memory);
    if (status == ICC_OK) {
        make_plan(&p);
        find_conditions(&p);
        status = solve(&p, env);
    }
    end(&p, &env->memory);
    if (status != ICC_OK)
        iccp_region_classes_free(classes);
    return status;
}

void iccp_region_classes_free(iccp_region_classes *classes)
{
    const iccp_memory memory = classes->memory;
    iccp_free(&memory, classes->basis);
    iccp_free(&memory, classes->plan);
    iccp_free(&memory, classes->value);
    iccp_free(&memory, classes->free_value);
    *classes = (iccp_region_classes){.memory = memory};
}

const uint64_t *iccp_region_class(iccp_region_classes *classes, const uint64_t *coefficients)
{
    memset(classes->free_value, 0, classes->n_free * sizeof *classes->free_value);
    for (size_t c = 0; c < classes->n; ++c)
        for (size_t i = 0; coefficients[c] != 0 && i < classes->n_free; ++i) {
            const uint64_t x = classes->basis[classes->n_free * c + i];
            classes->free_value[i] =
                iccp_residue_add(classes->free_value[i], iccp_residue_multiply(coefficients[c], x));
        }
    evaluate(classes, classes->free_value);
    return classes->value;
}
