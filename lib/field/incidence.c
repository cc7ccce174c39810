/* Finds the simplices that meet a domain, and the facets near each vertex. Source: the separating
 * plane theorem.
 *
 * A simplex and a facet have a common point unless some plane separates them. Only the planes of
 * the simplex's own facets and of the boundary facet are tried. So a few simplices count as
 * touched although they are not, but none is missed. */
#include "field/incidence.h"

#include "base/minmax.h"
#include "field/incidence_mask.h"

#include <math.h>
#include <string.h>

enum { FACETS_PER_REPORT = 1 << 12 };

/* A facet and a simplex that overlap by less than this, in lattice units, only graze. So a
 * boundary that follows the facets of the grid, such as a mask's, runs through no simplex. Rounding
 * is about 1e-14. */
static const double CONTACT = 1e-9;

typedef enum { APART, GRAZES, TOUCHES } contact;

int32_t iccp_order_rank(int32_t dim, const int8_t *axis)
{
    int32_t rank = 0;
    for (int32_t i = 0; i < dim; ++i) {
        int32_t smaller = 0;
        for (int32_t j = i + 1; j < dim; ++j)
            smaller += axis[j] < axis[i];
        rank = rank * (dim - i) + smaller;
    }
    return rank;
}

/* Goes to the next order in lexicographic sequence. Returns false after the last. */
static bool next_order(int32_t dim, int8_t *axis)
{
    int32_t i = dim - 2, j = dim - 1;
    while (i >= 0 && axis[i] > axis[i + 1])
        --i;
    if (i < 0)
        return false;
    while (axis[j] < axis[i])
        --j;
    const int8_t swap = axis[i];
    axis[i] = axis[j];
    axis[j] = swap;
    for (int32_t low = i + 1, high = dim - 1; low < high; ++low, --high) {
        const int8_t other = axis[low];
        axis[low] = axis[high];
        axis[high] = other;
    }
    return true;
}

void iccp_orders_init(iccp_orders *orders, const icc_grid *grid)
{
    int8_t axis[ICC_MAX_DIM];
    orders->dim = grid->dim;
    orders->n = 0;
    for (int32_t k = 0; k < grid->dim; ++k)
        axis[k] = (int8_t)k;
    do
        memcpy(orders->axis[orders->n++], axis, sizeof axis);
    while (next_order(grid->dim, axis));
    for (int set = 0; set < 1 << grid->dim; ++set) {
        orders->offset[set] = 0;
        for (int32_t k = 0; k < grid->dim; ++k)
            if (set >> k & 1)
                orders->offset[set] += (ptrdiff_t)grid->stride[k];
    }
}

/* One facet's pass through the grid. */
typedef struct scan {
    iccp_incidence *incidence;
    const icc_domain *domain;
    const iccp_orders *orders;
    uint32_t facet;
    double corner[ICC_MAX_DIM][ICC_MAX_DIM]; /* lattice coordinates */
    double normal[ICC_MAX_DIM];              /* inward */
    double level;                            /* of the facet's plane */
    uint32_t faces;                          /* faces of the current simplex that the facet meets */
    uint32_t reached;                        /* corners of the current simplex that count where the
                                                facet is */
    int32_t n_decisive;                      /* how many axes of its order prove that the simplex is
                                                apart */
    bool second;                             /* second pass: all bits are known */
    uint32_t *seen;                          /* by vertex: 1 + the last facet noted there */
    uint32_t *count;                         /* by vertex: number of facets, in the second pass */
    uint32_t *noted;                         /* the vertices of one facet after the other */
    size_t n_noted, room;
    size_t *end;       /* by facet: where its vertices end in `noted` */
    uint32_t *outside; /* by cell: bits of simplices found outside, up to 4-D */
} scan;

/* Finds the normal of unit length by elimination, as the null vector of the facet's edges, and
 * turns it inward. */
static void find_normal(scan *s)
{
    const int32_t dim = s->domain->dim;
    double a[ICC_MAX_DIM][ICC_MAX_DIM];
    int32_t free_column = dim - 1, column[ICC_MAX_DIM];
    bool used[ICC_MAX_DIM] = {false};
    for (int32_t i = 0; i + 1 < dim; ++i)
        for (int32_t k = 0; k < dim; ++k)
            a[i][k] = s->corner[i + 1][k] - s->corner[0][k];
    for (int32_t i = 0; i + 1 < dim; ++i) {
        int32_t row = i, best = -1;
        for (int32_t r = i; r + 1 < dim; ++r)
            for (int32_t k = 0; k < dim; ++k)
                if (!used[k] && (best < 0 || fabs(a[r][k]) > fabs(a[row][best]))) {
                    row = r;
                    best = k;
                }
        used[best] = true;
        column[i] = best;
        for (int32_t k = 0; k < dim; ++k) {
            const double swap = a[i][k];
            a[i][k] = a[row][k];
            a[row][k] = swap;
        }
        for (int32_t r = 0; r + 1 < dim; ++r) {
            const double factor = r != i && fabs(a[i][best]) > 0 ? a[r][best] / a[i][best] : 0;
            for (int32_t k = 0; k < dim; ++k)
                a[r][k] -= factor * a[i][k];
        }
    }
    for (int32_t k = 0; k < dim; ++k)
        free_column = used[k] ? free_column : k;
    double length = 1;
    s->normal[free_column] = 1;
    for (int32_t i = 0; i + 1 < dim; ++i) {
        const int32_t k = column[i];
        s->normal[k] = fabs(a[i][k]) > 0 ? -a[i][free_column] / a[i][k] : 0;
        length += s->normal[k] * s->normal[k];
    }
    length = sqrt(length);
    for (int32_t k = 0; k < dim; ++k)
        s->normal[k] /= length;
}

/* The determinant of the facet's edges and a vector. Its sign tells on which side of the facet
 * the vector points. */
static double side_of(const scan *s, const double *v)
{
    const int32_t dim = s->domain->dim;
    double a[ICC_MAX_DIM][ICC_MAX_DIM], sign = 1;
    for (int32_t i = 0; i < dim; ++i)
        for (int32_t k = 0; k < dim; ++k)
            a[i][k] = i + 1 < dim ? s->corner[i + 1][k] - s->corner[0][k] : v[k];
    for (int32_t c = 0; c < dim; ++c) {
        int32_t pivot = c;
        for (int32_t r = c + 1; r < dim; ++r)
            pivot = fabs(a[r][c]) > fabs(a[pivot][c]) ? r : pivot;
        if (!(fabs(a[pivot][c]) > 0))
            return 0;
        sign = pivot != c ? -sign : sign;
        for (int32_t k = 0; k < dim; ++k) {
            const double swap = a[c][k];
            a[c][k] = a[pivot][k];
            a[pivot][k] = swap;
        }
        sign = a[c][c] < 0 ? -sign : sign;
        for (int32_t r = c + 1; r < dim; ++r) {
            const double factor = a[r][c] / a[c][c];
            for (int32_t k = c; k < dim; ++k)
                a[r][k] -= factor * a[c][k];
        }
    }
    return sign;
}

static void load_corners(scan *s, uint32_t facet)
{
    const int32_t dim = s->domain->dim;
    const icc_grid *grid = s->incidence->grid;
    s->facet = facet;
    for (int32_t i = 0; i < dim; ++i) {
        const double *p =
            s->domain->vertices + (size_t)dim * s->domain->facets[(size_t)dim * facet + (size_t)i];
        for (int32_t k = 0; k < dim; ++k)
            s->corner[i][k] = (p[k] - grid->origin[k]) / grid->spacing;
    }
}

static void find_level(scan *s)
{
    s->level = 0;
    for (int32_t k = 0; k < s->domain->dim; ++k)
        s->level += s->normal[k] * s->corner[0][k];
}

static void load_facet(scan *s, uint32_t facet)
{
    const int32_t dim = s->domain->dim;
    load_corners(s, facet);
    find_normal(s);
    /* The orientation's sign belongs to an outward vector followed by the edges. Here the vector
     * comes last. */
    const double parity = dim % 2 == 0 ? -1 : 1;
    const double outward = side_of(s, s->normal) * s->domain->orientation * parity;
    for (int32_t k = 0; k < dim; ++k) {
        s->normal[k] = outward > 0 ? -s->normal[k] : s->normal[k];
        s->incidence->normal[(size_t)dim * facet + (size_t)k] = s->normal[k];
    }
    find_level(s);
}

/* Compares a simplex with the plane of the facet: on one side, touched, or cut. */
static contact plane_contact(const scan *s, const int32_t *cell, const int8_t *axis)
{
    double height = -s->level, low, high;
    for (int32_t k = 0; k < s->domain->dim; ++k)
        height += s->normal[k] * cell[k];
    low = high = height;
    for (int32_t k = 0; k < s->domain->dim; ++k) {
        height += s->normal[axis[k]];
        low = height < low ? height : low;
        high = height > high ? height : high;
    }
    if (low > CONTACT || high < -CONTACT)
        return APART;
    return low < -CONTACT && high > CONTACT ? TOUCHES : GRAZES;
}

/* Compares a simplex with the facet, by the plane of the facet and those of the simplex's own
 * facets. Sets s->faces, s->reached and s->n_decisive. */
static contact contact_with(scan *s, const int32_t *cell, const int8_t *axis)
{
    const int32_t dim = s->domain->dim;
    contact least = plane_contact(s, cell, axis); /* the cheaper test, which most simplices fail */
    s->faces = s->reached = 0;
    s->n_decisive = dim;
    if (least == APART)
        return APART;
    for (int32_t i = 0; i <= dim; ++i) {
        double highest = -HUGE_VAL, lowest = HUGE_VAL;
        for (int32_t j = 0; j < dim; ++j) {
            const double above = i == 0 ? 1 : s->corner[j][axis[i - 1]] - cell[axis[i - 1]];
            const double below = i == dim ? 0 : s->corner[j][axis[i]] - cell[axis[i]];
            highest = above - below > highest ? above - below : highest;
            lowest = above - below < lowest ? above - below : lowest;
        }
        if (highest < -CONTACT) {
            s->n_decisive = i < dim ? i + 1 : dim;
            return APART;
        }
        s->faces |= lowest <= CONTACT ? (uint32_t)1 << i : 0;
        least = highest > CONTACT ? least : GRAZES;
        s->reached |= highest > CONTACT ? (uint32_t)1 << i : 0;
    }
    return least;
}

/* Lists the corners of a simplex in a cell. Returns true if one of them is inside. */
static bool corners_of(const scan *s, uint32_t lowest, const int8_t *axis, uint32_t *corner)
{
    const icc_grid *grid = s->incidence->grid;
    bool any = grid->inside[lowest];
    corner[0] = lowest;
    for (int32_t k = 0; k < grid->dim; ++k) {
        corner[k + 1] = corner[k] + (uint32_t)grid->stride[axis[k]];
        any = any || grid->inside[corner[k + 1]];
    }
    return any;
}

/* Returns true if the middle of a simplex that the boundary only grazes is inside. Up to 4-D,
 * where each simplex has its own bit, an outside result is stored and not computed again. */
static bool middle_is_inside(const scan *s, const int32_t *cell, uint32_t lowest, int32_t r)
{
    const icc_grid *grid = s->incidence->grid;
    const int8_t *axis = s->orders->axis[r];
    const uint32_t bit = s->orders->n <= 32 ? (uint32_t)1 << r : 0;
    double middle[ICC_MAX_DIM];
    if (s->outside[lowest] & bit)
        return false;
    for (int32_t k = 0; k < grid->dim; ++k)
        middle[axis[k]] =
            grid->origin[axis[k]] +
            grid->spacing * (cell[axis[k]] + (double)(grid->dim - k) / (grid->dim + 1));
    if (iccp_domain_locate(s->domain, middle, true, NULL, NULL) == ICC_INSIDE)
        return true;
    s->outside[lowest] |= bit;
    return false;
}

static bool reserve(scan *s)
{
    const size_t room = 2 * s->room + 1024, most = (size_t)s->domain->dim + 1;
    if (s->n_noted + most <= s->room)
        return true;
    uint32_t *noted = iccp_grow(&s->incidence->memory, s->noted, s->n_noted, room, sizeof *noted);
    if (noted == NULL)
        return false;
    s->noted = noted;
    s->room = room;
    return true;
}

/* Notes the facet at the simplex's corners. If it only touches a face of the simplex, it is noted
 * at the corners of that face. The vectors of other corners count for nothing there. */
static bool note(scan *s, const uint32_t *corner)
{
    if (!reserve(s))
        return false;
    for (int32_t k = 0; k <= s->domain->dim; ++k) {
        const uint32_t v = corner[k];
        if (!(s->reached >> k & 1) || s->seen[v] == s->facet + 1)
            continue;
        s->seen[v] = s->facet + 1;
        s->noted[s->n_noted++] = v;
        ++s->count[v];
    }
    return true;
}

static bool visit_simplex(scan *s, const int32_t *cell, uint32_t lowest, int32_t r)
{
    const icc_grid *grid = s->incidence->grid;
    const int8_t *axis = s->orders->axis[r];
    uint32_t corner[ICC_MAX_DIM + 1];
    const contact c = contact_with(s, cell, axis);
    if (c == APART)
        return true;
    const bool any_inside = corners_of(s, lowest, axis, corner);
    const bool has = iccp_incidence_has(s->incidence, lowest, r);
    /* A simplex that is only grazed from outside is not part of the domain, unless another facet
     * runs through it. */
    if (c == GRAZES && !any_inside && !has && !middle_is_inside(s, cell, lowest, r))
        return true;
    s->incidence->bits[lowest] |= (uint32_t)1 << (r % 32);
    for (int32_t i = 0; i <= grid->dim; ++i)
        if (s->faces >> i & 1)
            s->incidence->faces[lowest] |= iccp_incidence_face_bit(grid->dim, r, i);
    return s->second ? note(s, corner) : true;
}

/* Consecutive orders begin alike. If the common beginning proves that a simplex is apart, the
 * other orders that begin so are skipped. */
static bool visit_cell(scan *s, const int32_t *cell)
{
    const icc_grid *grid = s->incidence->grid;
    uint32_t lowest = 0;
    for (int32_t k = 0; k < grid->dim; ++k)
        lowest += (uint32_t)cell[k] * (uint32_t)grid->stride[k];
    for (int32_t r = 0; r < s->orders->n;) {
        if (!visit_simplex(s, cell, lowest, r))
            return false;
        int32_t n_alike = 1;
        for (int32_t free = grid->dim - s->n_decisive; free > 1; --free)
            n_alike *= free;
        r += n_alike - r % n_alike;
    }
    return true;
}

/* Visits the cells that the facet's plane meets, within the facet's bounding box. */
static bool visit_facet(scan *s, uint32_t facet)
{
    const int32_t dim = s->domain->dim;
    const icc_grid *grid = s->incidence->grid;
    int32_t first[ICC_MAX_DIM], last[ICC_MAX_DIM], cell[ICC_MAX_DIM];
    load_facet(s, facet);
    for (int32_t k = 0; k < dim; ++k) {
        double low = s->corner[0][k], high = low;
        for (int32_t i = 1; i < dim; ++i) {
            low = iccp_min(low, s->corner[i][k]);
            high = iccp_max(high, s->corner[i][k]);
        }
        first[k] = cell[k] = (int32_t)iccp_max(floor(low - CONTACT), 0);
        last[k] = (int32_t)iccp_min(floor(high + CONTACT), (double)grid->shape[k] - 2);
    }
    for (int32_t k = 0; k < dim;) {
        double centre = -s->level, reach = CONTACT;
        for (int32_t i = 0; i < dim; ++i) {
            centre += s->normal[i] * (cell[i] + 0.5);
            reach += 0.5 * fabs(s->normal[i]);
        }
        if (fabs(centre) <= reach && !visit_cell(s, cell))
            return false;
        for (k = 0; k < dim && ++cell[k] > last[k]; ++k)
            cell[k] = first[k];
    }
    return true;
}

static icc_status visit_all(scan *s, const iccp_env *env)
{
    const size_t n = s->domain->n_facets;
    icc_status status = ICC_OK;
    for (size_t f = 0; status == ICC_OK && f < n; ++f) {
        if (f % FACETS_PER_REPORT == 0)
            status = iccp_progress(env, "grid", 0.5 * (double)f / (double)n + 0.5 * s->second);
        if (status == ICC_OK && !visit_facet(s, (uint32_t)f))
            status = ICC_ERR_MEMORY;
        s->end[f] = s->n_noted;
    }
    return status;
}

icc_status iccp_incidence_make_room(iccp_incidence *incidence, uint32_t *count)
{
    const size_t n = incidence->grid->n_vertices;
    size_t sum = 0;
    for (size_t v = 0; v < n; ++v) {
        const size_t own = count[v];
        count[v] = incidence->first[v] = (uint32_t)sum;
        sum += own;
        if (sum > UINT32_MAX)
            return ICC_ERR_RESOLUTION;
    }
    incidence->first[n] = (uint32_t)sum;
    incidence->facet = iccp_alloc(&incidence->memory, sum, sizeof *incidence->facet);
    return incidence->facet != NULL ? ICC_OK : ICC_ERR_MEMORY;
}

/* Turns the list of vertices by facet into the list of facets by vertex. */
static icc_status turn_round(scan *s)
{
    const icc_status status = iccp_incidence_make_room(s->incidence, s->count);
    size_t i = 0;
    for (size_t f = 0; status == ICC_OK && f < s->domain->n_facets; ++f)
        for (; i < s->end[f]; ++i)
            s->incidence->facet[s->count[s->noted[i]]++] = (uint32_t)f;
    return status;
}

/* Two passes are needed, because a later facet may show that the boundary meets a simplex. */
static icc_status visit_twice(scan *s, const iccp_env *env)
{
    icc_status status = visit_all(s, env);
    s->second = true;
    if (status == ICC_OK)
        status = visit_all(s, env);
    return status == ICC_OK ? turn_round(s) : status;
}

static icc_status fill_incidence(iccp_incidence *incidence, const iccp_orders *orders,
                                 const iccp_env *env)
{
    const size_t n = incidence->grid->n_vertices;
    scan s = {.incidence = incidence, .domain = incidence->domain, .orders = orders};
    s.seen = iccp_alloc_zero(&env->memory, n, sizeof *s.seen);
    s.count = iccp_alloc_zero(&env->memory, n, sizeof *s.count);
    s.outside = iccp_alloc_zero(&env->memory, n, sizeof *s.outside);
    s.end = iccp_alloc(&env->memory, incidence->domain->n_facets, sizeof *s.end);
    icc_status status = ICC_ERR_MEMORY;
    if (s.seen != NULL && s.count != NULL && s.outside != NULL && s.end != NULL)
        status = visit_twice(&s, env);
    iccp_free(&env->memory, s.seen);
    iccp_free(&env->memory, s.count);
    iccp_free(&env->memory, s.outside);
    iccp_free(&env->memory, s.end);
    iccp_free(&env->memory, s.noted);
    return status;
}

icc_status iccp_incidence_create(iccp_incidence *incidence, const icc_domain *domain,
                                 const icc_grid *grid, const iccp_env *env)
{
    const size_t n = grid->n_vertices;
    *incidence = (iccp_incidence){.memory = env->memory, .grid = grid, .domain = domain};
    incidence->bits = iccp_alloc_zero(&env->memory, n, sizeof *incidence->bits);
    incidence->faces = iccp_alloc_zero(&env->memory, n, sizeof *incidence->faces);
    incidence->first = iccp_alloc(&env->memory, n + 1, sizeof *incidence->first);
    incidence->normal =
        iccp_alloc(&env->memory, domain->n_facets * (size_t)domain->dim, sizeof *incidence->normal);
    iccp_orders *orders = iccp_alloc(&env->memory, 1, sizeof *orders);
    icc_status status = ICC_ERR_MEMORY;
    if (incidence->bits != NULL && incidence->faces != NULL && incidence->first != NULL &&
        incidence->normal != NULL && orders != NULL) {
        iccp_orders_init(orders, grid);
        status = iccp_incidence_fits_mask(incidence) ? iccp_incidence_mask(incidence, orders, env)
                                                     : fill_incidence(incidence, orders, env);
    }
    iccp_free(&env->memory, orders);
    return status;
}

bool iccp_incidence_touches(const iccp_incidence *incidence, uint32_t facet, uint32_t lowest,
                            const int8_t *axis)
{
    const int32_t dim = incidence->grid->dim;
    scan s = {.incidence = (iccp_incidence *)incidence, .domain = incidence->domain};
    int32_t cell[ICC_MAX_DIM];
    load_corners(&s, facet);
    for (int32_t k = 0; k < dim; ++k) {
        cell[k] = (int32_t)iccp_grid_coordinate(incidence->grid, lowest, k);
        s.normal[k] = incidence->normal[(size_t)dim * facet + (size_t)k];
    }
    find_level(&s);
    return contact_with(&s, cell, axis) != APART;
}

void iccp_incidence_trim(iccp_incidence *incidence)
{
    iccp_free(&incidence->memory, incidence->faces);
    iccp_free(&incidence->memory, incidence->first);
    iccp_free(&incidence->memory, incidence->facet);
    incidence->faces = incidence->first = incidence->facet = NULL;
}

void iccp_incidence_free(iccp_incidence *incidence)
{
    iccp_incidence_trim(incidence);
    iccp_free(&incidence->memory, incidence->bits);
    iccp_free(&incidence->memory, incidence->normal);
    *incidence = (iccp_incidence){.memory = incidence->memory};
}
