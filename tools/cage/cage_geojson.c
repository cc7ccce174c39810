/* Cages as GeoJSON (RFC 7946): a Polygon, a Feature or a FeatureCollection.
 *
 * A ring that is not closed is taken as it is, like one in text. */
#include "cage/cage_readers.h"

#include "base/foreign.h"
#include "base/json_in.h"

#include <math.h>
#include <string.h>

static const char *type_of(const cJSON *object)
{
    const char *type = cJSON_GetStringValue(json_get(object, "type"));
    return type != NULL ? type : "";
}

/* JSON that is something else than GeoJSON. */
static bool is_foreign(const cJSON *object, problem *wrong)
{
    if (strcmp(type_of(object), "Topology") == 0)
        return foreign_vector(wrong, 0, "a TopoJSON file"), true;
    if (strcmp(type_of(object), "CityJSON") == 0)
        return foreign_surface(wrong, 0, "a CityJSON file"), true;
    if (json_get(object, "asset") != NULL)
        return foreign_surface(wrong, 0, "a glTF file"), true;
    if (json_get(object, "rings") != NULL || json_get(object, "geometryType") != NULL)
        return foreign_vector(wrong, 0, "an Esri JSON file"), true;
    return false;
}

static bool read_position(cage *out, const cJSON *position, problem *wrong)
{
    const cJSON *x = cJSON_GetArrayItem(position, 0), *y = cJSON_GetArrayItem(position, 1);
    if (!cJSON_IsArray(position) || !cJSON_IsNumber(x) || !cJSON_IsNumber(y))
        return spoilt(wrong, 0, "vertex %zu is not a pair of numbers [x, y]", out->n);
    out->n_heights += cJSON_GetArraySize(position) > 2;
    if (!isfinite(x->valuedouble) || !isfinite(y->valuedouble))
        return spoilt(wrong, 0, "vertex %zu is not finite", out->n);
    cage_add(out, x->valuedouble, y->valuedouble, 0);
    return true;
}

static bool read_rings(cage *out, const cJSON *rings, problem *wrong)
{
    if (!cJSON_IsArray(rings) || cJSON_GetArraySize(rings) == 0)
        return spoilt(wrong, 0, "the polygon has no coordinates");
    if (cJSON_GetArraySize(rings) > 1)
        return spoilt(wrong, 0,
                      "the polygon has %d hole%s; cut it open into parts without holes and "
                      "make one map per part",
                      cJSON_GetArraySize(rings) - 1, cJSON_GetArraySize(rings) > 2 ? "s" : "");
    const cJSON *position;
    cJSON_ArrayForEach(position, cJSON_GetArrayItem(rings, 0))
    {
        if (!read_position(out, position, wrong))
            return false;
    }
    cage_open_ring(out);
    return true;
}

static bool read_geometry(cage *out, const cJSON *geometry, problem *wrong)
{
    const char *type = type_of(geometry);
    const cJSON *coordinates = json_get(geometry, "coordinates");
    if (strcmp(type, "Polygon") == 0)
        return read_rings(out, coordinates, wrong);
    if (strcmp(type, "MultiPolygon") == 0) {
        int parts = cJSON_GetArraySize(coordinates);
        if (parts == 1)
            return read_rings(out, cJSON_GetArrayItem(coordinates, 0), wrong);
        return spoilt(wrong, 0, "the MultiPolygon has %d parts; make one map per part", parts);
    }
    char shown[32];
    return spoilt(wrong, 0, "the geometry is a '%s'; a cage is a Polygon", quoted(shown, type));
}

static bool has_role(const cJSON *feature, cage_role role)
{
    const cJSON *properties = json_get(feature, "properties");
    const char *value = cJSON_GetStringValue(json_get(properties, "role"));
    return value != NULL && strcmp(value, cage_role_name(role)) == 0;
}

/* The feature with the role, else the only one. */
static const cJSON *choose_feature(const cJSON *collection, cage_role role, problem *wrong)
{
    const cJSON *features = json_get(collection, "features");
    const cJSON *feature, *chosen = NULL;
    int n_chosen = 0;
    cJSON_ArrayForEach(feature, features)
    {
        if (has_role(feature, role)) {
            chosen = feature;
            n_chosen++;
        }
    }
    if (n_chosen == 0 && cJSON_GetArraySize(features) == 1)
        return cJSON_GetArrayItem(features, 0);
    if (n_chosen != 1) {
        spoilt(wrong, 0,
               "%s of the %d features has the property \"role\": \"%s\"; exactly one must",
               n_chosen == 0 ? "none" : "more than one", cJSON_GetArraySize(features),
               cage_role_name(role));
        return NULL;
    }
    return chosen;
}

static bool read_object(cage *out, cage_role role, const cJSON *object, problem *wrong)
{
    if (is_foreign(object, wrong))
        return false;
    if (strcmp(type_of(object), "FeatureCollection") == 0) {
        object = choose_feature(object, role, wrong);
        if (object == NULL)
            return false;
    }
    if (strcmp(type_of(object), "Feature") == 0)
        object = json_get(object, "geometry");
    return read_geometry(out, object, wrong);
}

bool cage_read_geojson(cage *out, cage_role role, const char *text, size_t n, problem *wrong)
{
    cJSON *object = json_parse(text, n, wrong);
    if (object == NULL)
        return false;
    bool good = read_object(out, role, object, wrong);
    cJSON_Delete(object);
    return good;
}
