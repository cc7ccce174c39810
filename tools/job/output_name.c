/* Compares extensions of file names with formats. */
#include "job/output_name.h"

#include "base/say.h"
#include "base/system.h"
#include "job/call_files.h"

#include <stdio.h>
#include <string.h>

/* Formats, and the extensions of their files with blanks between. Most of these formats are never
 * written. */
static const struct {
    const char *name, *extensions;
} formats[] = {
    {"text", "txt"},
    {"JSON", "json"},
    {"GeoJSON", "geojson"},
    {"GeoJSONSeq", "geojsonl geojsons geojsonseq jsonl ndjson"},
    {"TopoJSON", "topojson"},
    {"KML", "kml kmz"},
    {"GML", "gml"},
    {"GPX", "gpx"},
    {"GeoPackage", "gpkg"},
    {"SQLite", "sqlite sqlite3 db"},
    {"shapefile", "shp shx dbf shz"},
    {"FlatGeobuf", "fgb"},
    {"Parquet", "parquet geoparquet"},
    {"WKT", "wkt"},
    {"WKB", "wkb"},
    {"CSV", "csv"},
    {"TSV", "tsv"},
    {"spreadsheet", "xls xlsx ods"},
    {"PNG", "png"},
    {"animated PNG", "apng"},
    {"JPEG", "jpg jpeg jpe jfif"},
    {"TIFF", "tif tiff"},
    {"GIF", "gif"},
    {"BMP", "bmp dib"},
    {"WebP", "webp"},
    {"PNM", "pnm"},
    {"PGM", "pgm"},
    {"PPM", "ppm"},
    {"PAM", "pam"},
    {"PBM", "pbm"},
    {"PFM", "pfm"},
    {"OpenEXR", "exr"},
    {"Radiance", "hdr"},
    {"JPEG 2000", "jp2 j2k"},
    {"JPEG XL", "jxl"},
    {"HEIC", "heic heif"},
    {"AVIF", "avif"},
    {"Photoshop", "psd"},
    {"GIMP", "xcf"},
    {"icon", "ico"},
    {"TGA", "tga"},
    {"QOI", "qoi"},
    {"video", "mp4 mov avi webm mkv"},
    {"SVG", "svg"},
    {"compressed SVG", "svgz"},
    {"PDF", "pdf"},
    {"PostScript", "ps eps"},
    {"DXF", "dxf"},
    {"DWG", "dwg"},
    {"HTML", "html htm"},
    {"XML", "xml"},
    {"OBJ", "obj"},
    {"OFF", "off"},
    {"PLY", "ply"},
    {"Medit", "mesh"},
    {"binary Medit", "meshb"},
    {"VTK", "vtk"},
    {"VTU", "vtu"},
    {"VTK in XML", "vtp vti vtr vts vtm pvtu"},
    {"STL", "stl"},
    {"glTF", "glb gltf"},
    {"FBX", "fbx"},
    {"COLLADA", "dae"},
    {"3DS", "3ds"},
    {"3MF", "3mf"},
    {"X3D", "x3d wrl"},
    {"USD", "usd usda usdc usdz"},
    {"Blender", "blend"},
    {"Gmsh", "msh"},
    {"STEP", "step stp"},
    {"IGES", "iges igs"},
    {"tetgen", "node ele face poly smesh"},
    {"NumPy", "npy"},
    {".npz", "npz"},
    {"MATLAB", "mat"},
    {"HDF5", "h5 hdf5 hdf"},
    {"NetCDF", "nc"},
    {"archive", "zip gz tgz bz2 xz zst lz4 7z rar tar"},
};

static bool is_same_letter(char a, char b)
{
    return (a >= 'A' && a <= 'Z' ? a | 0x20 : a) == b;
}

/* True if `word` is one of the words of `list`, ignoring case. */
static bool is_listed(const char *word, const char *list)
{
    while (*list != '\0') {
        size_t n = strcspn(list, " "), k = 0;
        while (k < n && is_same_letter(word[k], list[k]))
            k++;
        if (k == n && word[k] == '\0')
            return true;
        list += n + (list[n] == ' ');
    }
    return false;
}

const char *output_format(const char *name)
{
    const char *base = system_last_part(name), *dot = strrchr(base, '.');
    if (dot == NULL || dot == base || dot[1] == '\0')
        return NULL;
    for (size_t i = 0; i < sizeof formats / sizeof *formats; i++)
        if (is_listed(dot + 1, formats[i].extensions))
            return formats[i].name;
    return NULL;
}

bool output_is_json(const char *name)
{
    const char *found = output_format(name);
    return found != NULL && (strcmp(found, "GeoJSON") == 0 || strcmp(found, "JSON") == 0);
}

int output_fits(const char *of, const char *name, const char *list)
{
    const char *found = name != NULL ? output_format(name) : NULL;
    if (found == NULL)
        return DONE;
    for (const char *p = list; *p != '\0'; p += strspn(p, ", ")) {
        size_t n = strcspn(p, ",");
        if (strlen(found) == n && strncmp(p, found, n) == 0)
            return DONE;
        p += n;
    }
    return misused(of, "'%.200s' is a name for %s, but what is written is %s", name, found, list);
}

int output_names_check(const args *a, const command *c)
{
    call_file out;
    int result = DONE;
    for (size_t i = 0; result == DONE && call_output(&out, a, c, i); i++)
        result = output_fits(c->name, out.name, out.formats);
    return result;
}
