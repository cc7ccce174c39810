/* Foreign formats by group, and the remedies that messages name. */
#include "base/foreign_table.h"

/* The Python package reads these formats with well-kept libraries: docs/howto/formats.md. */
#define FRONT "; 'python3 -m libicc' takes it as it is"

const char *const foreign_remedies[] = {
    [MAKE_GEOJSON] =
        "'ogr2ogr -f GeoJSON OUT.geojson FILE' makes GeoJSON of it (of several layers, "
        "name one after FILE)" FRONT,
    [MAKE_GEOJSON_OF_TRACKS] = "'ogr2ogr -f GeoJSON OUT.geojson FILE tracks' makes GeoJSON of it "
                               "(or routes, waypoints)" FRONT,
    [MAKE_GEOJSON_OF_AREAS] =
        "'ogr2ogr -f GeoJSON OUT.geojson FILE multipolygons' makes GeoJSON of it "
        "(or lines, points)" FRONT,
    [MAKE_GEOJSON_OF_TEXT] =
        "'ogr2ogr -f GeoJSON OUT.geojson FILE -oo GEOM_POSSIBLE_NAMES=WKT,geom* "
        "-oo X_POSSIBLE_NAMES=x,lon* -oo Y_POSSIBLE_NAMES=y,lat*' makes GeoJSON of it" FRONT,
    [MAKE_VTK] =
        "'meshio convert --ascii FILE OUT.vtk' makes VTK of it (Debian: meshio-tools)" FRONT,
    [MAKE_OBJ] = "'assimp export FILE OUT.obj' makes OBJ of it, as Blender does",
    [MAKE_STL] = "'gmsh FILE -2 -o OUT.stl' makes STL of its surface, as FreeCAD does",
    [MAKE_STL_OF_PRINTS] = "'prusa-slicer --export-stl -o OUT.stl FILE' makes STL of it",
    [MAKE_PNG] = "'convert FILE OUT.png' makes a PNG picture of it (ImageMagick)" FRONT,
    [MAKE_PNG_OR_KEEP] =
        "gdalwarp (libicc fit or map --triangulation) and Python (libicc.raster) keep its "
        "values and its place; 'convert FILE OUT.png' makes a plain PNG picture of it" FRONT,
    [MAKE_SVG] = "'pdftocairo -svg FILE OUT.svg' makes an SVG drawing of it",
    [MAKE_MASK] = "'python3 -c \"import sys, numpy, SimpleITK as s; numpy.save(sys.argv[2], "
                  "s.GetArrayFromImage(s.ReadImage(sys.argv[1])) > 0)\" FILE OUT.npy' makes a mask "
                  "of it" FRONT,
    [MAKE_ARRAY] = "save one array of it as .npy (numpy.save in Python)",
    [MAKE_ARRAY_OR_VTK] =
        "if it is a mesh (Exodus, CGNS, MED), 'meshio convert --ascii FILE OUT.vtk' "
        "makes VTK of it (Debian: meshio-tools); else save one array as .npy" FRONT,
    [MAKE_WKT] =
        "'python3 -c \"import sys, shapely.wkb as w; "
        "print(w.loads(sys.stdin.buffer.read()).wkt)\" < FILE > OUT.wkt' makes text of it" FRONT,
    [MAKE_WKT_OF_DIGITS] =
        "ST_AsText gives text, and 'python3 -c \"import sys, shapely.wkb as w; "
        "print(w.loads(sys.stdin.read().strip(), hex=True).wkt)\" < FILE > OUT.wkt' makes it" FRONT,
    [MAKE_UTF8] = "'iconv -f UTF-16 -t UTF-8 FILE > OUT.txt' makes UTF-8 of it",
    [MAKE_POINTS] = "'grep -v \"^#\" FILE | cut -d, -f2-4 > OUT.csv' makes points of it",
    [MAKE_POINTS_OF_JSON] = "'jq -r \".markups[].controlPoints[].position | @csv\" FILE > OUT.csv' "
                            "makes points of it",
    [USE_BLENDER] = "Blender imports it and exports OBJ, STL or glTF (.glb)",
    [USE_PARAVIEW] = "ParaView saves its surface as PLY or STL, and tetrahedra as legacy VTK",
    [WRITE_VERTICES] = "write the vertices of one outline as lines of `x y`",
    [UNPACK] = "unpack it first",
    [NO_REMEDY] = NULL};

#define AT(place, bytes) BYTES, place, sizeof bytes - 1, bytes
#define BEGINS(word) WORD, 0, sizeof word - 1, word
#define XML(root) ROOT, 0, sizeof root - 1, root
#define JSON(name) MEMBER, 0, sizeof name - 1, name
#define JSON_TYPE(name) TYPE, 0, sizeof name - 1, name

const foreign_format foreign_formats[] = {
    /* maps */
    {AT(0, "\0\0\x27\x0a"), "a shapefile", MAKE_GEOJSON},
    {AT(0, "fgb"), "a FlatGeobuf file", MAKE_GEOJSON},
    {AT(0, "PAR1"), "a Parquet file; geopandas.read_parquet and to_file make GeoJSON of it",
     NO_REMEDY},
    {AT(0, "ARROW1"), "an Arrow file; geopandas.read_feather and to_file make GeoJSON of it",
     NO_REMEDY},
    {AT(6, "OSMHeader"), "an OpenStreetMap file", MAKE_GEOJSON_OF_AREAS},
    {AT(0, "\x08\x09\xfe\x02"), "a DGN drawing", MAKE_GEOJSON},
    {AT(0, "AutoCAD Binary DXF"), "a binary DXF drawing", MAKE_GEOJSON},
    {AT(0, "AC10"), "a DWG drawing; save it as DXF", NO_REMEDY},
    {BEGINS("!table"), "a MapInfo file", MAKE_GEOJSON},
    {XML("kml"), "a KML file", MAKE_GEOJSON},
    {XML("gpx"), "a GPX file", MAKE_GEOJSON_OF_TRACKS},
    {XML("osm"), "an OpenStreetMap file", MAKE_GEOJSON_OF_AREAS},
    {XML("FeatureCollection"), "a GML file", MAKE_GEOJSON},
    {XML("CityModel"), "a CityGML file", MAKE_GEOJSON},
    {JSON_TYPE("Topology"), "a TopoJSON file", MAKE_GEOJSON},
    {JSON("geometryType"), "an Esri JSON file", MAKE_GEOJSON},
    {JSON("rings"), "an Esri JSON geometry; its `rings` are the coordinates of a GeoJSON Polygon",
     NO_REMEDY},
    {BEGINS("mapX,mapY,"),
     "a list of control points (QGIS), not an outline; 'libicc fit FILE' makes a map from it "
     "alone, "
     "and --landmarks takes it beside the outlines of both sheets (-s, -t)",
     NO_REMEDY},
    {JSON_TYPE("Annotation"),
     "a georeference annotation, not an outline; 'libicc fit FILE' makes a map from its control "
     "points",
     NO_REMEDY},
    {JSON_TYPE("AnnotationPage"),
     "a page of georeference annotations, not an outline; 'libicc fit FILE' makes a map from the "
     "control points of one",
     NO_REMEDY},
    {XML("VRTDataset"),
     "a VRT of GDAL, not an outline; 'libicc fit FILE' makes a map from its ground control points",
     NO_REMEDY},
    /* surfaces and scenes */
    {AT(0, "Kaydara FBX Binary"), "an FBX file", USE_BLENDER},
    {BEGINS("; FBX"), "an FBX file", USE_BLENDER},
    {AT(0, "BLENDER"), "a Blender file", USE_BLENDER},
    {AT(0, "PXR-USDC"), "a USD file", USE_BLENDER},
    {AT(0, "#usda"), "a USD file", USE_BLENDER},
    {AT(0, "Ogawa"), "an Alembic file", USE_BLENDER},
    {AT(0, "#VRML"), "a VRML file", USE_BLENDER},
    {AT(0, "3D Geometry File Format"), "a Rhino file; Rhino exports OBJ and STL", NO_REMEDY},
    {AT(0, "xof 0"), "a DirectX file", MAKE_OBJ},
    {AT(0, "ISO-10303-21"), "a STEP file", MAKE_STL},
    {AT(72, "S      1"), "an IGES file", MAKE_STL},
    {XML("COLLADA"), "a COLLADA file", MAKE_OBJ},
    {XML("X3D"), "an X3D file", MAKE_OBJ},
    {XML("amf"), "an AMF file", MAKE_STL_OF_PRINTS},
    {XML("model"), "a 3MF model", MAKE_STL_OF_PRINTS},
    {JSON_TYPE("CityJSON"), "a CityJSON file; cjio exports OBJ", NO_REMEDY},
    {JSON("asset"), "a glTF scene, which is read only as a cage or a mesh", NO_REMEDY},
    /* meshes */
    {BEGINS("mesh3d"), "a Netgen mesh", MAKE_VTK},
    {BEGINS("mesh2d"), "a Netgen mesh", MAKE_VTK},
    {BEGINS("*HEADING"), "an Abaqus file", MAKE_VTK},
    {BEGINS("*Heading"), "an Abaqus file", MAKE_VTK},
    {BEGINS("*NODE"), "an Abaqus file", MAKE_VTK},
    {BEGINS("*Node"), "an Abaqus file", MAKE_VTK},
    {BEGINS("*KEYWORD"), "an LS-DYNA file; LS-PrePost saves STL", NO_REMEDY},
    {BEGINS("SOL "), "a Nastran file", MAKE_VTK},
    {BEGINS("BEGIN BULK"), "a Nastran file", MAKE_VTK},
    {BEGINS("TITLE"), "a Tecplot file", MAKE_VTK},
    {BEGINS("VARIABLES"), "a Tecplot file", MAKE_VTK},
    {BEGINS("# Created by COMSOL"), "a COMSOL mesh; COMSOL exports VTK", NO_REMEDY},
    {BEGINS("**"), "an Abaqus file", MAKE_VTK},
    {BEGINS("* FLAC3D"), "a FLAC3D grid", MAKE_VTK},
    {BEGINS("(0 \""), "an ANSYS mesh", MAKE_VTK},
    {BEGINS("(1 \""), "an ANSYS mesh", MAKE_VTK},
    {BEGINS("NDIME"), "an SU2 mesh", MAKE_VTK},
    {BEGINS("FoamFile"), "an OpenFOAM file; 'foamToVTK -ascii' in its case makes VTK of the mesh",
     NO_REMEDY},
    {XML("VTKFile"), "a VTK file in XML that is no unstructured grid", USE_PARAVIEW},
    {XML("Xdmf"), "an XDMF file", MAKE_VTK},
    {XML("dolfin"), "a FEniCS mesh", MAKE_VTK},
    {XML("febio_spec"), "a FEBio file; FEBio Studio exports VTK", NO_REMEDY},
    {AT(0, "\1\0\0\0\2\0\0\0"), "a binary Medit mesh", MAKE_VTK},
    {AT(0, "\1\0\0\0\3\0\0\0"), "a binary Medit mesh", MAKE_VTK},
    {AT(0, "\x89HDF"), "an HDF5 file", MAKE_ARRAY_OR_VTK},
    {AT(0, "CDF\1"), "a NetCDF file", MAKE_ARRAY_OR_VTK},
    {AT(0, "CDF\5"), "a NetCDF file", MAKE_ARRAY_OR_VTK},
    {AT(0, "CDF\2"), "a NetCDF file", MAKE_ARRAY_OR_VTK},
    /* arrays, scans and their landmarks */
    {AT(0, "MATLAB 5.0"), "a MATLAB file", MAKE_ARRAY},
    {AT(344, "n+1\0"), "a NIfTI file", MAKE_MASK},
    {AT(344, "ni1\0"), "a NIfTI header", MAKE_MASK},
    {AT(4, "n+2\0"), "a NIfTI file", MAKE_MASK},
    {AT(128, "DICM"), "a DICOM file", MAKE_MASK},
    {AT(0, "NRRD000"), "an NRRD file", MAKE_MASK},
    {BEGINS("ObjectType"), "a MetaImage file", MAKE_MASK},
    {BEGINS("NDims"), "a MetaImage file", MAKE_MASK},
    {BEGINS("# Markups fiducial"), "a list of landmarks of 3D Slicer (.fcsv)", MAKE_POINTS},
    {JSON("markups"), "a list of landmarks of 3D Slicer (.mrk.json)", MAKE_POINTS_OF_JSON},
    /* figures */
    {JSON("skeleton"), "a Spine skeleton", WRITE_VERTICES},
    {JSON("fr"), "a Lottie animation", WRITE_VERTICES},
    {BEGINS("[gd_scene"), "a Godot scene", WRITE_VERTICES},
    {BEGINS("[gd_resource"), "a Godot resource", WRITE_VERTICES},
    /* pictures and documents */
    {AT(0, "\xff\xd8\xff"), "a JPEG picture, which only warp, fit, animate and pose read",
     NO_REMEDY},
    {AT(0, "\x89PNG"), "a PNG picture, which only warp, fit, animate and pose read", NO_REMEDY},
    {AT(0, "II*\0"), "a TIFF picture", MAKE_PNG_OR_KEEP},
    {AT(0, "MM\0*"), "a TIFF picture", MAKE_PNG_OR_KEEP},
    {AT(0, "II+\0"), "a TIFF picture", MAKE_PNG_OR_KEEP},
    {AT(0, "MM\0+"), "a TIFF picture", MAKE_PNG_OR_KEEP},
    {AT(0, "\x76\x2f\x31\x01"), "an OpenEXR picture, of floats", MAKE_ARRAY},
    {AT(0, "#?RADIANCE"), "a Radiance picture, of floats", MAKE_ARRAY},
    {AT(0, "GIF8"), "a GIF picture", MAKE_PNG},
    {AT(8, "WEBP"), "a WebP picture", MAKE_PNG},
    {AT(0, "8BPS"), "a Photoshop picture", MAKE_PNG},
    {AT(0, "gimp xcf"), "a GIMP picture", MAKE_PNG},
    {AT(0, "qoif"), "a QOI picture", MAKE_PNG},
    {AT(4, "jP  "), "a JPEG 2000 picture", MAKE_PNG},
    {AT(4, "ftypheic"), "a HEIC picture", MAKE_PNG},
    {AT(4, "ftypavif"), "an AVIF picture", MAKE_PNG},
    {AT(4, "ftyp"), "a film; 'ffmpeg -i FILE OUT-%d.png' makes pictures of it", NO_REMEDY},
    {AT(0, "\xff\x0a"), "a JPEG XL picture", MAKE_PNG},
    {AT(4, "JXL "), "a JPEG XL picture", MAKE_PNG},
    {AT(0, "%PDF-"), "a PDF document", MAKE_SVG},
    {AT(0, "%!PS"),
     "a PostScript document; 'ps2pdf FILE OUT.pdf' makes PDF of it, and pdftocairo SVG", NO_REMEDY},
    {AT(0, "OTTO"), "a font; FontForge exports a glyph as SVG", NO_REMEDY},
    {AT(0, "wOF"), "a font; FontForge exports a glyph as SVG", NO_REMEDY},
    {AT(0, "\0\1\0\0\0"), "a font; FontForge exports a glyph as SVG", NO_REMEDY},
    {XML("html"), "a web page", NO_REMEDY},
    /* archives and text */
    {AT(0, "\x1f\x8b"), "a gzip archive ('gunzip')", UNPACK},
    {AT(0, "\xfd\x37zXZ\0"), "an xz archive ('unxz')", UNPACK},
    {AT(0, "BZh"), "a bzip2 archive ('bunzip2')", UNPACK},
    {AT(0, "\x28\xb5\x2f\xfd"), "a Zstandard archive ('unzstd')", UNPACK},
    {AT(0, "\x04\x22\x4d\x18"), "an LZ4 archive ('unlz4')", UNPACK},
    {AT(0, "7z\xbc\xaf\x27\x1c"), "a 7z archive ('7z x')", UNPACK},
    {AT(0, "Rar!\x1a\x07"), "a RAR archive ('unrar')", UNPACK},
    {AT(257, "ustar"), "a tar archive ('tar xf')", UNPACK},
    {AT(0, "\xff\xfe"), "a text in UTF-16", MAKE_UTF8},
    {AT(0, "\xfe\xff"), "a text in UTF-16", MAKE_UTF8},
};

const size_t n_foreign_formats = sizeof foreign_formats / sizeof *foreign_formats;
