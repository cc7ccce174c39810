/* Any two texts must be refused with a reason, or become two layers of regions. Layers with common
 * regions become a coverage with a map, or are refused with a reason. The map takes the source's
 * layer along exactly: all of it, unless something was welded or left out. */
#include "fuzz.h"
#include "geo/geo_carry.h"
#include "job/layer_file.h"

#include <stdio.h>

/* Reads a layer. Returns NULL if it is none, else its text, which the layers own. */
static const char *read_side(layers *l, int side, const uint8_t *data, size_t size)
{
    problem wrong = {.text = ""};
    char *text = text_of(data, size);
    if (text == NULL)
        return NULL;
    bool good = layers_read(l, side, text, size, "id", &wrong);
    require(good || (wrong.text[0] != '\0' && strpbrk(wrong.text, "\r\n") == NULL));
    return good ? text : NULL;
}

/* Carries the source's layer, whose objects are the same afterwards, less those that became null. */
static void carry(const icc_map *map, const icc_coverage *coverage, const char *text, size_t n,
                  bool whole)
{
    carrier c;
    geo_result r;
    problem wrong = {.text = ""};
    const geo_options options = {.policy = GEO_CLIP, .exact = true};
    carrier_start(&c, false, NULL);
    require(carrier_add(&c, map, icc_coverage_source(coverage), icc_coverage_target(coverage)) ==
            ICC_OK);
    carrier_set_snap(&c, -1);
    if (geo_carry(&r, &c, &options, text, n, &wrong)) {
        require(!whole || (r.n_without == 0 && r.n_faults == 0));
        require(r.exact && r.n_without <= r.n_positions);
    } else
        require(wrong.text[0] != '\0' && strpbrk(wrong.text, "\r\n") == NULL);
    geo_result_free(&r);
    carrier_free(&c);
}

/* Makes the coverage and the map. */
static void join(const layers *l, const icc_coverage_options *options, const char *text, size_t n)
{
    const icc_layer given[2] = {layers_side(l, 0), layers_side(l, 1)};
    icc_coverage *coverage = NULL;
    icc_error err = {.size = sizeof err};
    icc_coverage_info info = {.size = sizeof info};
    icc_map *map = NULL;
    if (icc_coverage_create(&coverage, &given[0], &given[1], options, NULL, &err) != ICC_OK) {
        require(coverage == NULL && err.message[0] != '\0');
        return;
    }
    require(icc_coverage_get_info(coverage, &info) == ICC_OK);
    require(info.n_regions > 0 && info.n_regions <= l->n_names);
    icc_status made = icc_map_create(&map, icc_coverage_source(coverage),
                                     icc_coverage_target(coverage), NULL, NULL, &err);
    require(made == ICC_OK || err.message[0] != '\0');
    if (made == ICC_OK)
        carry(map, coverage, text, n, !(options->weld[0] > 0) && info.n_differences == 0);
    icc_map_free(map);
    icc_coverage_free(coverage);
}

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size)
{
    const uint8_t *cut = memchr(data, '\f', size);
    size_t n = cut != NULL ? (size_t)(cut - data) : size;
    layers l = {0};
    const char *text = read_side(&l, 0, data, n);
    if (text != NULL &&
        read_side(&l, 1, cut != NULL ? cut + 1 : data, cut != NULL ? size - n - 1 : size) != NULL) {
        layers_number(&l);
        for (int way = 0; way < 4; way++) {
            double weld = way % 2 == 0 ? 0 : 0.1;
            const icc_coverage_options options = {.size = sizeof options,
                                                  .weld = {weld, weld},
                                                  .unmatched = way < 2 ? ICC_UNMATCHED_REFUSE
                                                                       : ICC_UNMATCHED_LEAVE_OUT};
            join(&l, &options, text, n);
        }
    }
    layers_free(&l);
    return 0;
}
