/* Any bytes at all must be refused with a reason, or become GeoJSON of which all is as it was but
 * coordinates and bounding boxes; under each policy; and leak nothing. */
#define _POSIX_C_SOURCE 200809L

#include "fuzz.h"
#include "geo/geo_carry.h"

#include <math.h>

/* An L with a slanted image, without holes or with two; made once and kept to the end of the
 * program. */
typedef struct cages {
    icc_domain *domains[2];
    icc_map *map;
    carrier carrier;
} cages;

static const cages *make_cages(bool holes)
{
    static const double corners[2][12] = {{0, 0, 10, 0, 10, 5, 5, 5, 5, 10, 0, 10},
                                          {0, 0, 12, 1, 12, 6, 6.5, 7, 5, 12, -1, 10}};
    static const double rings[2][2][8] = {{{1, 1, 3, 1, 3, 3, 1, 3}, {6, 2, 6, 3, 8, 3, 8, 1}},
                                          {{1, 1, 3, 1, 3, 3, 1, 3}, {7, 3, 7, 4, 9, 4, 9, 2}}};
    static cages all[2];
    cages *c = &all[holes];
    if (c->map != NULL)
        return c;
    for (size_t side = 0; side < 2; side++) {
        const icc_feature features[2] = {
            {sizeof *features, ICC_FEATURE_HOLE, 4, rings[side][0], 0, 0, NULL},
            {sizeof *features, ICC_FEATURE_HOLE, 4, rings[side][1], 0, 0, NULL}};
        require(icc_domain_create_features(&c->domains[side], 6, corners[side], holes ? 2 : 0,
                                           features, NULL, NULL) == ICC_OK);
    }
    require(icc_map_create(&c->map, c->domains[0], c->domains[1], NULL, NULL, NULL) == ICC_OK);
    carrier_start(&c->carrier, false, NULL);
    require(carrier_add(&c->carrier, c->map, c->domains[0], c->domains[1]) == ICC_OK);
    carrier_set_snap(&c->carrier, -1);
    return c;
}

static char *write_result(geo_result *r, const char *text, size_t n, size_t *n_out)
{
    char *bytes = NULL;
    FILE *stream = open_memstream(&bytes, n_out);
    require(stream != NULL);
    edits_write(&r->edits, text, n, stream);
    require(fclose(stream) == 0);
    return bytes;
}

/* The objects are the same as before, less those that became null; whatever is carried again is
 * GeoJSON. */
static void check_result(geo_result *r, const char *text, size_t n)
{
    size_t n_out;
    char *out = write_result(r, text, n, &n_out);
    geo_index before, after;
    problem wrong = {.text = ""};
    require(geo_index_read(&before, text, n, &wrong));
    require(geo_index_read(&after, out, n_out, &wrong));
    require(after.n <= before.n && (r->n_faults > 0 || after.n == before.n));
    require(r->n_without <= r->n_positions);
    for (size_t i = 0; i < r->n_faults; i++)
        require(r->faults[i].n_without <= r->n_positions && r->faults[i].line > 0);
    geo_index_free(&before);
    geo_index_free(&after);
    free(out);
}

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size)
{
    const cages *c = make_cages(size % 2 == 1);
    char *text = text_of(data, size);
    if (text == NULL)
        return 0;
    for (int way = 0; way < 2 * (GEO_FAIL + 1); way++) {
        geo_result r;
        problem wrong = {.text = ""};
        geo_options options = {.policy = (geo_policy)(way / 2),
                               .tolerance = 0.5,
                               .exact = way % 2 == 1,
                               .drop = way / 2 == GEO_NULL ? 0.5 : 0};
        if (geo_carry(&r, &c->carrier, &options, text, size, &wrong))
            check_result(&r, text, size);
        else
            require(wrong.text[0] != '\0' && strpbrk(wrong.text, "\r\n") == NULL);
        geo_result_free(&r);
    }
    free(text);
    return 0;
}
