/* Foreign formats, recognised by their first bytes; XML by the root element. */
#include "base/foreign.h"

#include "base/bytes.h"

#include <stdint.h>
#include <string.h>

/* What a program that reads the format can make of the file. */
typedef enum remedy {
    MAKE_GEOJSON,
    MAKE_SURFACE,
    MAKE_PNG,
    MAKE_UTF8,
    MAKE_MASK,
    UNPACK,
    NO_REMEDY
} remedy;

static const char *const remedies[] = {
    "'ogr2ogr -f GeoJSON OUT.geojson FILE' makes GeoJSON of it",
    "save it as OBJ, OFF, PLY or STL ('meshio convert FILE OUT.obj', Blender and MeshLab do)",
    "'convert FILE OUT.png' makes a PNG picture of it",
    "'iconv -f UTF-16 -t UTF-8' makes UTF-8 of it",
    "save one array of it as .npy",
    "unpack it first",
    NULL};

typedef struct magic {
    size_t at, n;
    const char *bytes;
    const char *what;
    remedy remedy;
} magic;

/* Longer ones come before those that they begin with. */
static const magic magics[] = {
    {0, 4, "\0\0\x27\x0a", "a shapefile", MAKE_GEOJSON},
    {0, 3, "fgb", "a FlatGeobuf file", MAKE_GEOJSON},
    {0, 4, "PAR1", "a Parquet file", MAKE_GEOJSON},
    {0, 6, "ARROW1", "an Arrow file", MAKE_GEOJSON},
    {0, 18, "AutoCAD Binary DXF", "a binary DXF drawing", MAKE_GEOJSON},
    {0, 4, "AC10", "a DWG drawing; save it as DXF", NO_REMEDY},
    {0, 18, "Kaydara FBX Binary", "an FBX file", MAKE_SURFACE},
    {0, 7, "BLENDER", "a Blender file", MAKE_SURFACE},
    {0, 8, "PXR-USDC", "a USD file", MAKE_SURFACE},
    {0, 5, "#usda", "a USD file", MAKE_SURFACE},
    {0, 12, "ISO-10303-21", "a STEP file", MAKE_SURFACE},
    {0, 11, "$MeshFormat", "a Gmsh file", MAKE_SURFACE},
    {0, 4, "\x89HDF", "an HDF5 file", MAKE_MASK},
    {0, 4, "CDF\1", "a NetCDF file", MAKE_MASK},
    {0, 10, "MATLAB 5.0", "a MATLAB file", MAKE_MASK},
    {0, 3, "\xff\xd8\xff", "a JPEG picture, which only warp and pose take", NO_REMEDY},
    {0, 4, "II*\0", "a TIFF picture", MAKE_PNG},
    {0, 4, "MM\0*", "a TIFF picture", MAKE_PNG},
    {0, 4, "II+\0", "a TIFF picture", MAKE_PNG},
    {0, 4, "MM\0+", "a TIFF picture", MAKE_PNG},
    {0, 4, "GIF8", "a GIF picture", MAKE_PNG},
    {8, 4, "WEBP", "a WebP picture", MAKE_PNG},
    {0, 4, "8BPS", "a Photoshop picture", MAKE_PNG},
    {0, 8, "gimp xcf", "a GIMP picture", MAKE_PNG},
    {0, 4, "\x76\x2f\x31\x01", "an OpenEXR picture", MAKE_PNG},
    {0, 10, "#?RADIANCE", "a Radiance picture", MAKE_PNG},
    {0, 4, "qoif", "a QOI picture", MAKE_PNG},
    {4, 4, "jP  ", "a JPEG 2000 picture", MAKE_PNG},
    {4, 8, "ftypheic", "a HEIC picture", MAKE_PNG},
    {4, 8, "ftypavif", "an AVIF picture", MAKE_PNG},
    {0, 2, "\xff\x0a", "a JPEG XL picture", MAKE_PNG},
    {4, 4, "JXL ", "a JPEG XL picture", MAKE_PNG},
    {0, 5, "%PDF-", "a PDF document", MAKE_PNG},
    {0, 4, "%!PS", "a PostScript document", MAKE_PNG},
    {0, 4, "\x89PNG", "a PNG picture, which only warp and pose take", NO_REMEDY},
    {0, 2, "\x1f\x8b", "a gzip archive ('gunzip')", UNPACK},
    {0, 6,
     "\xfd"
     "7zXZ\0",
     "an xz archive ('unxz')", UNPACK},
    {0, 3, "BZh", "a bzip2 archive ('bunzip2')", UNPACK},
    {0, 4, "\x28\xb5\x2f\xfd", "a Zstandard archive ('unzstd')", UNPACK},
    {0, 4, "\x04\x22\x4d\x18", "an LZ4 archive ('unlz4')", UNPACK},
    {0, 6, "7z\xbc\xaf\x27\x1c", "a 7z archive ('7z x')", UNPACK},
    {0, 6, "Rar!\x1a\x07", "a RAR archive ('unrar')", UNPACK},
    {257, 5, "ustar", "a tar archive ('tar xf')", UNPACK},
    {0, 2, "\xff\xfe", "a text in UTF-16", MAKE_UTF8},
    {0, 2, "\xfe\xff", "a text in UTF-16", MAKE_UTF8},
    {0, 5, "\1\3\0\0\0", "well-known binary; ST_AsText or shapely's .wkt give text", NO_REMEDY},
    {0, 5, "\1\6\0\0\0", "well-known binary; ST_AsText or shapely's .wkt give text", NO_REMEDY},
};

/* The names of root elements, without their prefix. SVG is read. */
static const struct {
    const char *root, *what;
    remedy remedy;
} roots[] = {
    {"kml", "a KML file", MAKE_GEOJSON},
    {"gpx", "a GPX file", MAKE_GEOJSON},
    {"osm", "an OpenStreetMap file", MAKE_GEOJSON},
    {"FeatureCollection", "a GML file", MAKE_GEOJSON},
    {"COLLADA", "a COLLADA file", MAKE_SURFACE},
    {"X3D", "an X3D file", MAKE_SURFACE},
    {"VTKFile", "a VTK file in XML", MAKE_SURFACE},
    {"amf", "an AMF file", MAKE_SURFACE},
    {"model", "a 3MF model", MAKE_SURFACE},
    {"html", "a web page", NO_REMEDY},
};

static bool told(problem *wrong, const char *what, remedy how)
{
    spoilt(wrong, 0, "this is %s%s%s", what, remedies[how] != NULL ? "; " : "",
           remedies[how] != NULL ? remedies[how] : "");
    return true;
}

int foreign_vector(problem *wrong, size_t line, const char *what)
{
    return spoilt(wrong, line, "this is %s; %s", what, remedies[MAKE_GEOJSON]);
}

int foreign_surface(problem *wrong, size_t line, const char *what)
{
    return spoilt(wrong, line, "this is %s; %s", what, remedies[MAKE_SURFACE]);
}

static bool has(const char *text, size_t n, size_t at, const char *bytes, size_t n_bytes)
{
    return n >= at + n_bytes && memcmp(text + at, bytes, n_bytes) == 0;
}

static bool is_database(const char *text, size_t n, problem *wrong)
{
    if (!has(text, n, 0, "SQLite format 3", 16))
        return false;
    bool package = has(text, n, 68, "GP", 2);
    return told(wrong, package ? "a GeoPackage" : "an SQLite database", MAKE_GEOJSON);
}

/* The name of its first file says what an archive is for. */
static bool is_zip(const char *text, size_t n, problem *wrong)
{
    static const struct {
        const char *end, *what;
        remedy remedy;
    } kinds[] = {{".kml", "a KMZ file", MAKE_GEOJSON},
                 {".shp", "a zipped shapefile", MAKE_GEOJSON},
                 {".dbf", "a zipped shapefile", MAKE_GEOJSON},
                 {".npy", "an .npz archive", MAKE_MASK},
                 {".model", "a 3MF file", MAKE_SURFACE}};
    if (n < 30 || memcmp(text, "PK\3\4", 4) != 0)
        return false;
    size_t n_name = little_endian(text + 26, 2);
    for (size_t i = 0; i < sizeof kinds / sizeof *kinds; i++) {
        size_t n_end = strlen(kinds[i].end);
        if (n_name >= n_end && has(text, n, 30 + n_name - n_end, kinds[i].end, n_end))
            return told(wrong, kinds[i].what, kinds[i].remedy);
    }
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

/* Well-known binary as PostGIS prints it: hexadecimal digits, 01 or 00 and a polygon's or several's
 * type. */
static bool is_hexadecimal(const char *p)
{
    bool little = strncmp(p, "0103000", 7) == 0 || strncmp(p, "0106000", 7) == 0;
    bool big = strncmp(p, "00000000", 8) == 0 || strncmp(p, "0020000", 7) == 0;
    return (little || big) && strspn(p, "0123456789ABCDEFabcdef") >= 26;
}

/* The name behind the '<' of the first element, without its prefix; NULL if there is none. */
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
    const char *root = root_element(text);
    size_t n = root != NULL ? strcspn(root, " \t\r\n/>") : 0;
    for (size_t i = 0; n > 0 && i < sizeof roots / sizeof *roots; i++)
        if (strlen(roots[i].root) == n && strncmp(root, roots[i].root, n) == 0)
            return told(wrong, roots[i].what, roots[i].remedy);
    return false;
}

static bool is_by_text(const char *text, problem *wrong)
{
    if (is_dxf(text))
        return told(wrong, "a DXF drawing", MAKE_GEOJSON);
    if (is_hexadecimal(text))
        return told(wrong, "well-known binary; ST_AsText or shapely's .wkt give text", NO_REMEDY);
    return is_markup(text, wrong);
}

bool foreign_told(const char *text, size_t n, problem *wrong)
{
    if (is_database(text, n, wrong) || is_zip(text, n, wrong))
        return true;
    for (size_t i = 0; i < sizeof magics / sizeof *magics; i++)
        if (has(text, n, magics[i].at, magics[i].bytes, magics[i].n))
            return told(wrong, magics[i].what, magics[i].remedy);
    if (is_portable_map(text))
        return told(wrong, "a PNM picture, which only warp and pose take", NO_REMEDY);
    if (is_bitmap(text, n))
        return told(wrong, "a BMP picture", MAKE_PNG);
    if (has(text, n, 0, "\xef\xbb\xbf", 3))
        text += 3;
    return is_by_text(text + strspn(text, " \t\r\n"), wrong);
}
