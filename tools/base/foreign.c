/* Foreign formats are recognised by one table: by bytes, a first word, a root element of XML or a
 * member of JSON. A few formats need tests of their own. */
#include "base/foreign.h"

#include "base/bytes.h"
#include "base/foreign_table.h"
#include "base/json_scan.h"
#include "base/xml_tags.h"

#include <stdint.h>
#include <string.h>

static bool told(problem *wrong, const char *what, foreign_remedy how)
{
    spoilt(wrong, 0, "this is %s%s%s", what, foreign_remedies[how] != NULL ? "; " : "",
           foreign_remedies[how] != NULL ? foreign_remedies[how] : "");
    return true;
}

/* Searches the first row with this mark whose bytes begin `word`. With `whole` the bytes must be
 * the whole word. */
static bool told_by(foreign_mark by, const char *word, size_t n, bool whole, problem *wrong)
{
    for (const foreign_format *f = foreign_formats; f < foreign_formats + n_foreign_formats; f++)
        if (f->mark == by && n >= f->at + f->n && (!whole || n == f->n) &&
            memcmp(word + f->at, f->bytes, f->n) == 0)
            return told(wrong, f->what, f->remedy);
    return false;
}

int foreign_vector(problem *wrong, size_t line, const char *what)
{
    return spoilt(wrong, line, "this is %s; %s", what, foreign_remedies[MAKE_GEOJSON]);
}

static bool has(const char *text, size_t n, size_t at, const char *bytes, size_t n_bytes)
{
    return n >= at + n_bytes && memcmp(text + at, bytes, n_bytes) == 0;
}

static bool holds(const char *text, size_t n, const char *word)
{
    size_t n_word = strlen(word);
    for (size_t i = 0; i + n_word <= n; i++)
        if (text[i] == *word && memcmp(text + i, word, n_word) == 0)
            return true;
    return false;
}

static bool is_database(const char *text, size_t n, problem *wrong)
{
    if (!has(text, n, 0, "SQLite format 3", 16))
        return false;
    bool package = has(text, n, 68, "GP", 2);
    return told(wrong, package ? "a GeoPackage" : "an SQLite database", MAKE_GEOJSON);
}

/* An archive is recognised by the name of its first file. */
static bool is_zip(const char *text, size_t n, problem *wrong)
{
    static const struct {
        const char *end, *what;
        foreign_remedy remedy;
    } kinds[] = {{".kml", "a KMZ file", MAKE_GEOJSON},
                 {".shp", "a zipped shapefile ('unzip')", UNPACK},
                 {".dbf", "a zipped shapefile ('unzip')", UNPACK},
                 {".npy", "an .npz archive", MAKE_ARRAY},
                 {".usdc", "a USD file", USE_BLENDER},
                 {".usda", "a USD file", USE_BLENDER},
                 {".model", "a 3MF file", MAKE_STL_OF_PRINTS}};
    if (n < 30 || memcmp(text, "PK\3\4", 4) != 0)
        return false;
    size_t n_name = little_endian(text + 26, 2);
    for (size_t i = 0; i < sizeof kinds / sizeof *kinds; i++) {
        size_t n_end = strlen(kinds[i].end);
        if (n_name >= n_end && has(text, n, 30 + n_name - n_end, kinds[i].end, n_end))
            return told(wrong, kinds[i].what, kinds[i].remedy);
    }
    if (holds(text, n, "3dmodel.model"))
        return told(wrong, "a 3MF file", MAKE_STL_OF_PRINTS);
    if (holds(text, n, "xl/workbook.xml") || holds(text, n, "opendocument.spreadsheet"))
        return told(wrong, "a spreadsheet; save it as CSV", NO_REMEDY);
    return told(wrong, "a zip archive ('unzip')", UNPACK);
}

static bool is_blank(char c)
{
    return c == ' ' || c == '\t' || c == '\r' || c == '\n';
}

/* Comments (999), then 0 and SECTION, each on a line of its own. */
static bool is_dxf(const char *p)
{
    while (strncmp(p, "999", 3) == 0 && (p[3] == '\r' || p[3] == '\n')) {
        p += 3 + strspn(p + 3, "\r\n");
        p += strcspn(p, "\n");
        p += strspn(p, " \t\r\n");
    }
    if (p[0] != '0' || (p[1] != '\r' && p[1] != '\n'))
        return false;
    p += 1 + strspn(p + 1, " \t\r\n");
    return strncmp(p, "SECTION", 7) == 0;
}

static bool is_portable_map(const char *p)
{
    return p[0] == 'P' && p[1] >= '1' && p[1] <= '7' && is_blank(p[2]);
}

/* BM, the size of the file, four bytes that are zero. */
static bool is_bitmap(const char *text, size_t n)
{
    return n > 26 && has(text, n, 0, "BM", 2) && has(text, n, 6, "\0\0\0\0", 4);
}

/* A 3DS file begins with 4D4D and its own length. */
static bool is_3ds(const char *text, size_t n)
{
    return n > 16 && has(text, n, 0, "MM", 2) && little_endian(text + 2, 4) == n;
}

/* Well-known binary, also PostGIS's with a reference system, begins with the order of bytes and a
 * type. */
static bool is_well_known_binary(const char *text, size_t n)
{
    unsigned char order = n >= 9 ? (unsigned char)text[0] : 2;
    uint32_t type = 0;
    for (size_t i = 0; i < 4 && order < 2; i++)
        type |= (uint32_t)(unsigned char)text[order == 1 ? 1 + i : 4 - i] << 8 * i;
    type &= 0x1fffffff;
    return order < 2 && type / 1000 < 4 && type % 1000 >= 1 && type % 1000 <= 7;
}

/* Recognises well-known binary as PostGIS prints it, in hexadecimal digits. */
static bool is_hexadecimal(const char *p)
{
    bool little = strncmp(p, "010", 3) == 0 && p[3] != '\0' && strncmp(p + 4, "000", 3) == 0;
    bool big = strncmp(p, "0000", 4) == 0 || strncmp(p, "0020000", 7) == 0;
    return (little || big) && strspn(p, "0123456789ABCDEFabcdef") >= 26;
}

/* Interchange files of MapInfo begin with a version, then name a character set or a separator. */
static bool is_mapinfo(const char *p)
{
    if (strncmp(p, "Version", 7) != 0 && strncmp(p, "VERSION", 7) != 0)
        return false;
    p += strcspn(p, "\n");
    p += strspn(p, " \t\r\n");
    return strncmp(p, "Charset", 7) == 0 || strncmp(p, "CHARSET", 7) == 0 ||
           strncmp(p, "Delimiter", 9) == 0 || strncmp(p, "DELIMITER", 9) == 0;
}

/* True for a table (CSV) whose first line has a separator and whose second one has a polygon. */
static bool is_text_table(const char *p)
{
    size_t n_head = strcspn(p, "\r\n");
    const char *second = p + n_head + strspn(p + n_head, "\r\n");
    const char *shape = strstr(second, "POLYGON");
    return strcspn(p, ",;\t") < n_head && strcspn(p, "(<{[") >= n_head && shape != NULL &&
           (size_t)(shape - second) < strcspn(second, "\r\n");
}

/* The name after the '<' of the first element, without its prefix, or NULL. */
static const char *root_element(const char *p)
{
    while (*p == '<' && (p[1] == '?' || p[1] == '!')) {
        const char *end = strncmp(p, "<!--", 4) == 0 ? strstr(p + 4, "-->") : strchr(p, '>');
        if (end == NULL)
            return NULL;
        p = end + (*end == '-' ? 3 : 1);
        p += strspn(p, " \t\r\n");
    }
    if (*p != '<')
        return NULL;
    const char *name = p + 1, *colon = name + strcspn(name, ": \t\r\n/>");
    return *colon == ':' ? colon + 1 : name;
}

static bool is_markup(const char *text, problem *wrong)
{
    tag first;
    const char *root = root_element(text);
    size_t n = root != NULL ? strcspn(root, " \t\r\n/>") : 0;
    if (n == 7 && strncmp(root, "VTKFile", n) == 0 && tag_next(&first, text) &&
        tag_has(&first, "type", 4, "UnstructuredGrid"))
        return false;
    return n > 0 && told_by(ROOT, root, n, true, wrong);
}

/* Looks at the members of an object, up to its "type". */
static bool is_json(const char *text, size_t n, problem *wrong)
{
    json_scan s;
    bool is_told = false, is_type = false, goes_on = *text == '{';
    json_scan_start(&s, text, n);
    goes_on = goes_on && json_scan_next(&s) == JSON_OBJECT;
    while (goes_on && !is_told && json_scan_next(&s) == JSON_NAME) {
        const char *name = s.text + s.begin + 1;
        size_t n_name = s.end - s.begin - 2;
        is_type = n_name == 4 && memcmp(name, "type", 4) == 0;
        is_told = told_by(MEMBER, name, n_name, true, wrong);
        json_kind kind = json_scan_next(&s);
        if (is_type && kind == JSON_STRING)
            is_told = told_by(TYPE, s.text + s.begin + 1, s.end - s.begin - 2, true, wrong);
        goes_on = !(is_type && kind == JSON_STRING) && json_scan_skip(&s, kind) != JSON_BAD;
    }
    json_scan_end(&s);
    return is_told;
}

/* Skips OpenFOAM's banner and lines that are comments. */
static const char *skip_comments(const char *p)
{
    while (*p == '#' || *p == '%' || (strncmp(p, "/*", 2) == 0 && strstr(p, "*/") != NULL)) {
        p = *p == '/' ? strstr(p, "*/") + 2 : p + strcspn(p, "\n");
        p += strspn(p, " \t\r\n");
    }
    return p;
}

static bool is_by_text(const char *text, size_t n, problem *wrong)
{
    if (is_dxf(text))
        return told(wrong, "a DXF drawing", MAKE_GEOJSON);
    if (is_hexadecimal(text))
        return told(wrong, "well-known binary", MAKE_WKT_OF_DIGITS);
    if (is_mapinfo(text))
        return told(wrong, "a MapInfo file", MAKE_GEOJSON);
    if (is_text_table(text))
        return told(wrong, "a comma-separated table (CSV) of shapes", MAKE_GEOJSON_OF_TEXT);
    const char *first = skip_comments(text);
    return told_by(WORD, text, n, false, wrong) ||
           told_by(WORD, first, n - (size_t)(first - text), false, wrong) ||
           is_markup(text, wrong) || is_json(text, n, wrong);
}

bool foreign_told(const char *text, size_t n, problem *wrong)
{
    if (is_database(text, n, wrong) || is_zip(text, n, wrong) ||
        told_by(BYTES, text, n, false, wrong))
        return true;
    if (is_well_known_binary(text, n))
        return told(wrong, "well-known binary", MAKE_WKT);
    if (is_3ds(text, n))
        return told(wrong, "a 3DS file", MAKE_OBJ);
    if (is_portable_map(text))
        return told(wrong, "a PNM picture, which only warp, fit, animate and pose read", NO_REMEDY);
    if (is_bitmap(text, n))
        return told(wrong, "a BMP picture", MAKE_PNG);
    size_t at = has(text, n, 0, "\xef\xbb\xbf", 3) ? 3 : 0;
    at += strspn(text + at, " \t\r\n");
    return is_by_text(text + at, n - at, wrong);
}

bool foreign_table_told(const char *text, problem *wrong)
{
    text += strncmp(text, "\xef\xbb\xbf", 3) == 0 ? 3 : 0;
    size_t n_head = strcspn(text, "\r\n");
    if (strcspn(text, "{[<") < n_head)
        return false;
    if (strcspn(text, ",;\t") < n_head)
        return told(wrong, "a table (CSV), not GeoJSON", MAKE_GEOJSON_OF_TEXT);
    return false;
}
