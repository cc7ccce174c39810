"""The C interface of libicc: its structs and functions as tables, and the library itself.

tests/test_abi.py compares both tables with the headers.
"""

from __future__ import annotations

import ctypes
import os
import pathlib
import sys
from typing import Any, Callable, Dict

MAX_DIM = 6

# Every struct begins with `size`. Each line: name, then member:type.
STRUCTS = """
error status:i32 side:i32 index:i64 item:i32 message:char[252]
env user:ptr alloc:ptr dealloc:ptr log:ptr progress:ptr parallel_for:ptr threads:i32 load_limit:u64
domain_info dim:i32 orientation:i32 n_vertices:size n_facets:size lower:f64[6] upper:f64[6] measure:f64 n_features:size n_mesh_vertices:size n_mesh_simplices:size n_junctions:size n_pieces:size n_faces:size n_voids:size genus:size n_holes:size n_lines:size n_points:size n_regions:size
feature kind:i32 n_vertices:size vertices:ptr radius:f64 n_facets:size facets:ptr
mesh dim:i32 n_vertices:size vertices:ptr n_cells:size cells:ptr offsets:ptr types:ptr regions:ptr
fill_options ratio:f64 max_points:u64
feature_info kind:i32 orientation:i32 first_vertex:size n_vertices:size first_facet:size n_facets:size genus:size around:size
chart_options method:i32 function:i32 tree:i32 cells:i32 maximum:ptr constraints:i32 solver:i32 min_fall:f64 leaf_min:f64 axis_order:ptr
chart_info dim:i32 method:i32 certified:i32 reason:i32 cells:i32 maximum:f64[6] spacing:f64
gradient_info function:i32 tree:i32 n_grid:size n_inside:size n_tree:size n_unreachable:size n_cousin_violations:size n_maxima:size n_minima:size n_saddles:size n_edges:size n_compression:size n_expansion:size moved:f64
field_info n_grid:size n_inside:size n_stray:size n_tree:size n_unreachable:size n_cousin_violations:size n_maxima:size n_minima:size n_saddles:size n_infeasible:size n_contacts:size n_not_inward:size
foliation_info n_mesh_vertices:size n_mesh_boundary:size n_mesh_simplices:size n_ties:size harmonic_share:f64
shelling_info n_mesh_vertices:size n_mesh_boundary:size n_mesh_simplices:size harmonic_share:f64 order_peeled:i32 n_orders:i32 order_beta:f64 n_reversed:size flux_energy:f64 flux_divergence:f64
disc_info n_mesh_vertices:size n_mesh_boundary:size n_mesh_simplices:size
chart_timings grid:f64 tree:f64 function:f64 mesh:f64 centre:f64 solve:f64 order:f64 certify:f64
chart_report n_points:size n_boundary:size unreachable:f64 uncovered:f64 collapsed:f64 not_inward:f64
match_options turning:i32 between:i32 least_sure:f64 drop:f64 tolerance:f64 keep_source:i32
match_info dim:i32 mirrored:i32 n_vertices:size n_landmarks:size n_joined:size cost:f64 second:f64 sure:f64 turn:f64 least_slope:f64 most_slope:f64 energy:f64 off:f64 least_angle:f64 n_overlay:size
layer n_rings:size first:ptr vertices:ptr ids:ptr holes:ptr
coverage_options weld:f64[2] between:i32 unmatched:i32 n_left_out:size left_out:ptr
coverage_info n_regions:size n_features:size n_vertices:size n_nodes:size n_sides:size n_islands:size n_settled:size n_joined:size n_differences:size n_left_out:size n_given:size[2] n_welded:size[2] n_inserted:size[2] n_chains:size[2] chain:f64[4] most_moved:f64[2] least_apart:f64[2] least_apart_at:f64[4]
coverage_difference kind:i32 side:i32 n_ids:i32 ids:i64[2] place:f64[2]
tie vertex:u32[2] n_source:size source:ptr n_target:size target:ptr
map_options kind:i32 iterations:i32 chart:ptr target_maximum:ptr n_ties:size ties:ptr slide:i32
map_info dim:i32 kind:i32 certified:i32 reason:i32 reason_side:i32 class_kept:i32 n_vertices:size n_simplices:size energy:f64 n_holes:size n_lines:size n_points:size n_ties:size detour:f64 n_slid:size
map_report seconds:f64 seconds_repair:f64 seconds_improve:f64 seconds_certify:f64 energy_start:f64 n_inverted:size n_unrepaired:size n_iterations:size n_levels:i32 n_trees:i32 n_samples:size n_lost:size n_flat:size n_spoilt:size
tie_info vertex:u32[2] n_source:size n_target:size length:f64[2]
improve_options iterations:i32 levels:i32 tolerance:f64
retarget_options iterations:i32
improve_report energy_start:f64 energy:f64 n_iterations:size n_simplices:size n_levels:i32 cancelled:i32
certificate certified:i32 boundary_simple:i32 n_inverted:size n_flat:size n_no_image:size first:i64 message:char[256]
picture width:i32 height:i32 channels:i32 bytes:i32 alpha:i32 stride:size pixels:ptr interpolation:i32 has_nodata:i32 nodata:f64
field dim:i32 bytes:i32 displacement:i32 outside:i32 shape:size[3] origin:f64[3] step:f64[9] values:ptr
field_report certified:i32 one_to_one:i32 n_cells:size n_folded:size n_undecided:size n_missing:size least:f64 message:char[192]
grid_info dim:i32 shape:size[6] origin:f64[6] spacing:f64 n_vertices:size n_inside:size n_stray:size cells:i32
tree_options form:i32 axis_order:ptr
tree_report n_inside:size n_outside:size n_unreachable:size n_pairs:size n_cousin_violations:size violation:u32[2]
function_options function:i32 constraints:i32 solver:i32 min_fall:f64 leaf_min:f64
function_info function:i32 constrained:i32 solver:i32 beside:i32 n_unknowns:size n_violated:size n_active:size residual:f64 least_log:f64 excess:f64 highest:u32
curves_info dim:i32 way:i32 n_curves:size n_vertices:size n_merged:size
solver_report n_iterations:size n_inner:size work:f64 residual_before:f64 seconds_setup:f64 seconds_order:f64 seconds_factor:f64 seconds_solve:f64 seconds_verify:f64
function_report n_maxima:size n_minima:size n_saddles:size critical:u32
facet_report n_tested:size n_compression:size n_expansion:size
grow_report method:i32 vertex:u32 n_vertices:size n_deferred:size n_unplaced:size n_remaining:size n_reversed:size n_tests:size
sampling_options kind:i32 steps:i32 spacing:f64 margin:f64 seed:u64 n_fixed:size fixed:ptr
sampling_info dim:i32 kind:i32 n_samples:size n_edge:size spacing:f64 nearest:f64 sigma:f64
weights_options kernel:i32 initial:i32 method:i32 steps:i32 affine_tail:i32 within_shape:i32 sigma:f64 cutoff:f64 n_edges:size edges:ptr n_lines:size lines:ptr initial_weights:ptr
weights_info dim:i32 kernel:i32 initial:i32 method:i32 n_handles:size n_nodes:size n_infeasible:size n_entries:size sigma:f64 definiteness:f64 residual:f64
weights_timings factor:f64 initial:f64 optimise:f64
weights_report n_infeasible:size n_negative:size unity:f64 reproduction:f64 reproduction_mean:f64 lagrange:f64 linearity:f64 least_weight:f64 definiteness:f64
nearest_options n_held:size held:ptr
nearest_report repair:i32 n_folded:size n_patches:size changed:f64 moved:f64 most_moved:f64 n_iterations:size
constraint kind:i32 n:size source:ptr vertices:ptr target:ptr direction:ptr tolerance:ptr
fit_options model:i32 box:ptr margin:f64 smoothing:f64 reach:f64 stiffness:f64 cell_stiffness:ptr cell:f64 no_contact:i32
fit_info model:i32 n_items:size margin:f64 smoothing:f64 residual:f64 left_out:f64 affine_residual:f64 n_off:size most_off:f64 repair:i32 n_folded:size n_patches:size changed:f64 n_iterations:size
"""

# Each line: [result] name arguments; the result is a status unless it is given.
FUNCTIONS = """
char*:version
i32:version_number
char*:status_name i32
domain_create domain** i32 size f64* size u32* env* error*
domain_create_features domain** size f64* size feature* env* error*
domain_create_solid domain** size f64* size u32* size feature* env* error*
domain_create_mask domain** i32 size* u8* env* error*
domain_create_mesh domain** mesh* size u32* env* error*
mask_repair i32 size* u8* size* env* error*
void:domain_free domain*
domain_get_info domain* domain_info*
domain_fill domain** domain* fill_options* env* error*
domain_get_feature domain* size feature_info*
domain_get_regions domain* u32*
domain_get_boundary domain* f64* u32*
domain_get_mesh domain* mesh*
domain_locate domain* size f64* i32* u32* f64* env*
boundary_defects size f64* size i32* u32* size* env* error*
chart_create chart** domain* chart_options* env* error*
chart_create_function chart** function* env* error*
void:chart_free chart*
chart_get_info chart* chart_info*
chart_get_gradient_info chart* gradient_info*
chart_get_field_info chart* field_info*
chart_get_foliation_info chart* foliation_info*
chart_get_shelling_info chart* shelling_info*
chart_get_disc_info chart* disc_info*
chart_get_timings chart* chart_timings*
domain*:chart_domain chart*
chart_get_report chart* size chart_report* env* error*
chart_encode chart* size f64* u32* f64* f64* i32* size* env*
chart_decode chart* size u32* f64* f64* f64* i32* size* env*
chart_encode_flags chart* size f64* u32* f64* f64* i32* i32* size* env*
chart_decode_flags chart* size u32* f64* f64* f64* i32* i32* size* env*
chart_trace chart* f64* size f64* size* env* error*
chart_save chart* size void* size*
chart_load chart** size void* env* error*
match_create match** domain* domain* size f64* match_options* env* error*
void:match_free match*
domain*:match_source match*
domain*:match_target match*
match_get_info match* match_info*
match_get_origins match* u32* u32*
match_apply match* size f64* f64* f64* env*
match_apply_inverse match* size f64* f64* f64* env*
match_save match* size void* size*
match_load match** size void* env* error*
coverage_create coverage** layer* layer* coverage_options* env* error*
void:coverage_free coverage*
domain*:coverage_source coverage*
domain*:coverage_target coverage*
coverage_get_info coverage* coverage_info*
coverage_get_features coverage* feature** feature**
coverage_get_ids coverage* i64*
coverage_get_difference coverage* size coverage_difference*
map_create map** domain* domain* map_options* env* error*
map_create_polygons map** size f64* f64* env* error*
map_create_from_charts map** chart* chart* map_options* env* error*
map_improve map** map* improve_options* improve_report* env* error*
map_retarget map** map* domain* retarget_options* env* error*
map_get_mesh map* mesh* f64*
map_get_regions map* u32* error*
map_certify map* mesh* f64* certificate* env* error*
map_repair map* mesh* f64* certificate* env* error*
void:map_free map*
map_get_info map* map_info*
map_get_report map* map_report*
map_get_tie map* size tie_info* f64* f64*
chart*:map_source_chart map*
chart*:map_target_chart map*
map_apply map* size f64* f64* i32* size* env*
map_apply_inverse map* size f64* f64* i32* size* env*
map_jacobian map* size f64* f64* i32* size* env*
map_save map* size void* size*
map_load map** size void* env* error*
map_warp map* picture* picture* size* env* error*
map_sample map* i32 field* size* env* error*
field_certify field* size u32* i32* field_report* env* error*
grid_create grid** domain* i32 env* error*
grid_create_mask grid** i32 size* u8* env* error*
grid_refine grid** grid* env* error*
grid_restrict grid** grid* u8* env* error*
void:grid_free grid*
grid_get_info grid* grid_info*
u8*:grid_inside grid*
grid_find_maximum grid* u32* u32* env* error*
grid_find_nearest grid* f64* u32*
grid_get_points grid* size u32* f64*
tree_create tree** grid* u32 tree_options* env* error*
tree_create_parents tree** grid* u32 u32* tree_options* env* error*
void:tree_free tree*
u32*:tree_parents tree*
i32*:tree_generations tree*
tree_get_report tree* tree_report* env* error*
function_create function** tree* function_options* env* error*
function_create_values function** tree* f64* env* error*
function_create_logs function** tree* f64* env* error*
function_create_solve function** tree* function_options* f64* f64* env* error*
function*:chart_function chart*
tree*:function_tree function*
grid*:tree_grid tree*
u32:tree_root tree*
void:function_free function*
function_get_info function* function_info*
function_get_solver_report function* solver_report*
f64*:function_values function*
f64*:function_logs function*
function_get_report function* function_report* env* error*
function_get_edges function* size u32* i32* size* size*
function_get_facets function* size u32* i32* facet_report* env* error*
curves_create curves** function* size f64* i32 env* error*
void:curves_free curves*
curves_get_info curves* curves_info*
curves_get_vertices curves* size* f64*
curves_get_ends curves* i32* f64* f64* u32* f64*
tree_grow tree* f64* u32* grow_report* env* error*
tree_get_rank_report tree* u32* function_report* env* error*
triangulate size size f64* u32* env* error*
shape_create shape** i32 size domain** size f64* size u32* env* error*
void:shape_free shape*
sampling_create sampling** shape* sampling_options* env* error*
sampling_create_from_points sampling** shape* size f64* env* error*
void:sampling_free sampling*
sampling_get_info sampling* sampling_info*
sampling_get_points sampling* f64*
sampling_save sampling* size void* size*
sampling_load sampling** size void* env* error*
weights_create weights** sampling* size f64* weights_options* env* error*
void:weights_free weights*
weights_get_info weights* weights_info*
weights_get_timings weights* weights_timings*
weights_get_nodes weights* f64* f64* f64* i32*
weights_paint weights** weights* size f64* f64 f64 env* error*
weights_repaint weights** weights* size u32* f64* env* error*
weights_with_method weights** weights* i32 env* error*
weights_stiffen weights** weights* size u32* f64* f64* env* error*
weights_evaluate weights* size f64* f64* f64* i32* size* env*
weights_get_dual weights* size size f64* f64* env* error*
weights_get_report weights* size f64* weights_report* env* error*
binding_create binding** weights* size f64* i32 env* error*
void:binding_free binding*
binding_get_counts binding* size* size* i32*
binding_get_weights binding* f64* f64*
binding_pose binding* f64* f64* f64* env*
binding_save binding* size void* size*
binding_load binding** size void* env* error*
pose_reset i32 size f64*
pose_move i32 f64* f64*
pose_turn i32 f64* f64* f64* f64
map_create_nearest map** mesh* f64* nearest_options* nearest_report* env* error*
fit_create fit** domain* mesh* size constraint* fit_options* env* error*
fit_move fit** fit* f64* env* error*
void:fit_free fit*
map*:fit_map fit*
fit_get_info fit* fit_info*
fit_get_residuals fit* f64* f64*
"""

_SCALARS: Dict[str, Any] = {
    "i32": ctypes.c_int32,
    "u32": ctypes.c_uint32,
    "i64": ctypes.c_int64,
    "u64": ctypes.c_uint64,
    "size": ctypes.c_size_t,
    "f64": ctypes.c_double,
    "ptr": ctypes.c_void_p,
    "char": ctypes.c_char,
    "void": None,
    "char*": ctypes.c_char_p,
}


def _type(word: str) -> Any:
    if word.endswith("]"):
        word, length = word[:-1].split("[")
        return _SCALARS[word] * int(length)
    if word.endswith("*"):
        return _SCALARS.get(word, ctypes.c_void_p)
    return _SCALARS[word]


def _make_struct(line: str) -> Any:
    name, *members = line.split()
    pairs = (member.split(":") for member in members)
    fields = [("size", ctypes.c_size_t)] + [(key, _type(word)) for key, word in pairs]
    return type("icc_" + name, (ctypes.Structure,), {"_fields_": fields})


class _Lazy:
    """A namespace whose members are made from a table on first use."""

    def __init__(self, table: str, make: Callable[[str], Any]):
        self._lines = {}
        for line in table.split("\n"):
            if line:
                name = line.split(None, 1)[0].rpartition(":")[2]
                self._lines[name] = line
        self._make = make

    def __getattr__(self, name: str) -> Any:
        if name.startswith("_"):
            raise AttributeError(name)
        value = self._make(self._lines[name])
        setattr(self, name, value)
        return value


def _open() -> ctypes.CDLL:
    """Opens the library named by LIBICC_LIBRARY, or the one beside this file, or the system's."""
    file = {"win32": "libicc.dll", "darwin": "libicc.0.dylib"}.get(sys.platform, "libicc.so.0")
    beside = pathlib.Path(__file__).with_name(file)
    named = os.environ.get("LIBICC_LIBRARY") or (str(beside) if beside.exists() else file)
    try:
        return ctypes.CDLL(named)
    except OSError as error:
        raise ImportError(f"the C library of libicc cannot be loaded: {error}; install {file}, or let "
                          "the environment variable LIBICC_LIBRARY name it") from None


_library = _open()


def _make_function(line: str) -> Any:
    name, *words = line.split()
    result, _, name = name.rpartition(":")
    function = getattr(_library, "icc_" + name)
    function.argtypes = [_type(word) for word in words]
    function.restype = _type(result or "i32")
    return function


def plain(name: str) -> Any:
    """A function of the library that takes ctypes objects as they are. Nothing is converted, so a call is faster."""
    return _library["icc_" + name]


structs = _Lazy(STRUCTS, _make_struct)
"""ctypes structures: structs.error is icc_error."""

lib = _Lazy(FUNCTIONS, _make_function)
"""Functions of the library: lib.version is icc_version()."""


def new(name: str, **members: Any) -> Any:
    """A zeroed struct with its `size` set."""
    kind = getattr(structs, name)
    return kind(size=ctypes.sizeof(kind), **members)
