/* What a program compiled against these headers relies on. A number that changes here breaks every
 * program that is not recompiled: see docs/reference/abi.md. */
#include "../suite.h"

#include <check.h>
#include <icc/fit.h>
#include <icc/kernel.h>
#include <icc/stages.h>
#include <stddef.h>
#include <stdlib.h>

#define IS(constant, value) _Static_assert((constant) == (value), #constant " has changed")
#define SIZE(type, bytes)                                                                          \
    _Static_assert(sizeof(type) == (bytes), "the size of " #type " has changed")
#define AT(type, member, offset)                                                                   \
    _Static_assert(offsetof(type, member) == (offset), #type "." #member " has moved")

IS(ICC_OK, 0);
IS(ICC_ERR_ARGUMENT, 1);
IS(ICC_ERR_MEMORY, 2);
IS(ICC_ERR_VERSION, 3);
IS(ICC_ERR_BOUNDARY, 4);
IS(ICC_ERR_RESOLUTION, 5);
IS(ICC_ERR_TOPOLOGY, 6);
IS(ICC_ERR_OUTSIDE, 7);
IS(ICC_ERR_SOLVER, 8);
IS(ICC_ERR_TRACE, 9);
IS(ICC_ERR_CERTIFICATE, 10);
IS(ICC_ERR_CANCELLED, 11);
IS(ICC_ERR_UNSUPPORTED, 12);
IS(ICC_ERR_FORMAT, 13);
IS(ICC_ERR_AMBIGUOUS, 14);

IS(ICC_TURNING_UPRIGHT, 1);
IS(ICC_TURNING_FREE, 2);
IS(ICC_BETWEEN_ELASTIC, 1);
IS(ICC_BETWEEN_ARC, 2);

IS(ICC_MAX_DIM, 6);

IS(ICC_ITEM_NONE, 0);
IS(ICC_ITEM_VERTEX, 1);
IS(ICC_ITEM_FACET, 2);
IS(ICC_ITEM_SIMPLEX, 3);
IS(ICC_ITEM_CELL, 4);
IS(ICC_ITEM_GRID_VERTEX, 5);
IS(ICC_ITEM_AXIS, 6);
IS(ICC_ITEM_POINT, 7);
IS(ICC_ITEM_REGION, 8);
IS(ICC_ITEM_SEGMENT, 9);
IS(ICC_ITEM_SAMPLE, 10);
IS(ICC_ITEM_HANDLE, 11);
IS(ICC_ITEM_EDGE, 12);
IS(ICC_ITEM_LINE, 13);
IS(ICC_ITEM_NODE, 14);
IS(ICC_ITEM_FEATURE, 15);
IS(ICC_ITEM_TIE, 16);

IS(ICC_INSIDE, 1);
IS(ICC_BOUNDARY, 2);
IS(ICC_OUTSIDE, 3);

IS(ICC_DEFECT_NOT_FINITE, 1);
IS(ICC_DEFECT_REPEATED, 2);
IS(ICC_DEFECT_SPIKE, 3);
IS(ICC_DEFECT_CROSSING, 4);
IS(ICC_DEFECT_TOUCH, 5);
IS(ICC_DEFECT_FLAT, 6);
IS(ICC_FEATURE_HOLE, 1);
IS(ICC_FEATURE_LINE, 2);
IS(ICC_FEATURE_POINT, 3);
IS(ICC_FEATURE_REGION, 4);

IS(ICC_METHOD_GRADIENT, 1);
IS(ICC_METHOD_FOLIATION, 2);
IS(ICC_METHOD_FIELD, 3);
IS(ICC_METHOD_DISC, 4);

IS(ICC_REASON_NONE, 0);
IS(ICC_REASON_GRADIENT, 1);
IS(ICC_REASON_INFEASIBLE, 2);
IS(ICC_REASON_NOT_INWARD, 3);
IS(ICC_REASON_STRAY, 4);
IS(ICC_REASON_LOST, 5);
IS(ICC_REASON_FLAT, 6);

IS(ICC_FUNCTION_DECAY, 1);
IS(ICC_FUNCTION_DISTANCE, 2);
IS(ICC_FUNCTION_LAPLACE, 3);
IS(ICC_FUNCTION_BILAPLACE, 4);
IS(ICC_FUNCTION_CLAMPED, 5);
IS(ICC_FUNCTION_HARMONIC, 6);
IS(ICC_FUNCTION_VALUES, 7);

IS(ICC_CONSTRAINTS_NEEDED, 1);
IS(ICC_CONSTRAINTS_NONE, 2);
IS(ICC_CONSTRAINTS_ALL, 3);

IS(ICC_SOLVER_DIRECT, 1);
IS(ICC_SOLVER_ITERATIVE, 2);

IS(ICC_TREE_THESIS, 1);
IS(ICC_TREE_PAPER, 2);

IS(ICC_LOSS_AWAY, 1);
IS(ICC_LOSS_UNCOVERED, 2);
IS(ICC_LOSS_COLLAPSED, 4);
IS(ICC_LOSS_GAP, 8);

IS(ICC_MAP_CURVES, 1);
IS(ICC_MAP_MESH, 2);

IS(ICC_SLIDE_NONE, 0);
IS(ICC_SLIDE_INSIDE, 1);
IS(ICC_SLIDE_ALL, 2);

IS(ICC_WAY_UP, 1);
IS(ICC_WAY_DOWN, 2);

IS(ICC_END_NONE, 0);
IS(ICC_END_MAXIMUM, 1);
IS(ICC_END_BOUNDARY, 2);
IS(ICC_END_CRITICAL, 3);
IS(ICC_END_VALUES, 4);

IS(ICC_EDGE_COMPRESSION, 1);
IS(ICC_EDGE_EXPANSION, 2);

IS(ICC_GROW_AS_GIVEN, 1);
IS(ICC_GROW_GROWN, 2);
IS(ICC_GROW_THINNED, 3);

IS(ICC_INTERPOLATION_NEAREST, 1);
IS(ICC_INTERPOLATION_LINEAR, 2);
IS(ICC_INTERPOLATION_CUBIC, 3);

IS(ICC_OUTSIDE_NAN, 1);
IS(ICC_OUTSIDE_IDENTITY, 2);
IS(ICC_OUTSIDE_NEAREST, 3);

IS(ICC_CELL_FOLDED, 1);
IS(ICC_CELL_UNDECIDED, 2);
IS(ICC_CELL_MISSING, 3);

IS(ICC_SAMPLING_GRID, 1);
IS(ICC_SAMPLING_BLUE, 2);
IS(ICC_SAMPLING_POINTS, 3);

IS(ICC_KERNEL_WENDLAND, 1);
IS(ICC_KERNEL_GAUSS, 2);

IS(ICC_INITIAL_HEAT, 1);
IS(ICC_INITIAL_EDGES, 2);
IS(ICC_INITIAL_INVERSE, 3);
IS(ICC_INITIAL_GIVEN, 4);

IS(ICC_WEIGHTS_QP, 1);
IS(ICC_WEIGHTS_EQUALITY, 2);
IS(ICC_WEIGHTS_L1, 3);
IS(ICC_WEIGHTS_BIHARMONIC, 4);

IS(ICC_REPAIR_NONE, 0);
IS(ICC_REPAIR_PATCHES, 1);
IS(ICC_REPAIR_WHOLE, 2);

IS(ICC_CONSTRAINT_POINTS, 1);
IS(ICC_CONSTRAINT_LINE, 2);
IS(ICC_CONSTRAINT_VERTICES, 3);
IS(ICC_CONSTRAINT_SLIDING, 4);

IS(ICC_FIT_SPLINE, 1);
IS(ICC_FIT_ELASTIC, 2);

IS(ICC_UNMATCHED_REFUSE, 1);
IS(ICC_UNMATCHED_LEAVE_OUT, 2);

IS(ICC_DIFFERENCE_REGION, 1);
IS(ICC_DIFFERENCE_BORDER, 2);
IS(ICC_DIFFERENCE_ISLAND, 3);

#if defined(__LP64__)

SIZE(icc_error, 280);
AT(icc_error, size, 0);
AT(icc_error, status, 8);
AT(icc_error, side, 12);
AT(icc_error, index, 16);
AT(icc_error, item, 24);
AT(icc_error, message, 28);

SIZE(icc_env, 72);
AT(icc_env, size, 0);
AT(icc_env, user, 8);
AT(icc_env, alloc, 16);
AT(icc_env, dealloc, 24);
AT(icc_env, log, 32);
AT(icc_env, progress, 40);
AT(icc_env, parallel_for, 48);
AT(icc_env, threads, 56);
AT(icc_env, load_limit, 64);

SIZE(icc_domain_info, 232);
AT(icc_domain_info, size, 0);
AT(icc_domain_info, dim, 8);
AT(icc_domain_info, orientation, 12);
AT(icc_domain_info, n_vertices, 16);
AT(icc_domain_info, n_facets, 24);
AT(icc_domain_info, lower, 32);
AT(icc_domain_info, upper, 80);
AT(icc_domain_info, measure, 128);
AT(icc_domain_info, n_features, 136);
AT(icc_domain_info, n_mesh_vertices, 144);
AT(icc_domain_info, n_mesh_simplices, 152);
AT(icc_domain_info, n_junctions, 160);
AT(icc_domain_info, n_pieces, 168);
AT(icc_domain_info, n_faces, 176);
AT(icc_domain_info, n_voids, 184);
AT(icc_domain_info, genus, 192);
AT(icc_domain_info, n_holes, 200);
AT(icc_domain_info, n_lines, 208);
AT(icc_domain_info, n_points, 216);
AT(icc_domain_info, n_regions, 224);

SIZE(icc_match_options, 48);
AT(icc_match_options, size, 0);
AT(icc_match_options, turning, 8);
AT(icc_match_options, between, 12);
AT(icc_match_options, least_sure, 16);
AT(icc_match_options, drop, 24);
AT(icc_match_options, tolerance, 32);
AT(icc_match_options, keep_source, 40);

SIZE(icc_match_info, 120);
AT(icc_match_info, size, 0);
AT(icc_match_info, dim, 8);
AT(icc_match_info, mirrored, 12);
AT(icc_match_info, n_vertices, 16);
AT(icc_match_info, n_landmarks, 24);
AT(icc_match_info, n_joined, 32);
AT(icc_match_info, cost, 40);
AT(icc_match_info, second, 48);
AT(icc_match_info, sure, 56);
AT(icc_match_info, turn, 64);
AT(icc_match_info, least_slope, 72);
AT(icc_match_info, most_slope, 80);
AT(icc_match_info, energy, 88);
AT(icc_match_info, off, 96);
AT(icc_match_info, least_angle, 104);
AT(icc_match_info, n_overlay, 112);

SIZE(icc_fill_options, 24);
AT(icc_fill_options, size, 0);
AT(icc_fill_options, ratio, 8);
AT(icc_fill_options, max_points, 16);

SIZE(icc_feature, 56);
AT(icc_feature, size, 0);
AT(icc_feature, kind, 8);
AT(icc_feature, n_vertices, 16);
AT(icc_feature, vertices, 24);
AT(icc_feature, radius, 32);
AT(icc_feature, n_facets, 40);
AT(icc_feature, facets, 48);

SIZE(icc_mesh, 72);
AT(icc_mesh, size, 0);
AT(icc_mesh, dim, 8);
AT(icc_mesh, n_vertices, 16);
AT(icc_mesh, vertices, 24);
AT(icc_mesh, n_cells, 32);
AT(icc_mesh, cells, 40);
AT(icc_mesh, offsets, 48);
AT(icc_mesh, types, 56);
AT(icc_mesh, regions, 64);

SIZE(icc_feature_info, 64);
AT(icc_feature_info, size, 0);
AT(icc_feature_info, kind, 8);
AT(icc_feature_info, orientation, 12);
AT(icc_feature_info, first_vertex, 16);
AT(icc_feature_info, n_vertices, 24);
AT(icc_feature_info, first_facet, 32);
AT(icc_feature_info, n_facets, 40);
AT(icc_feature_info, genus, 48);
AT(icc_feature_info, around, 56);

SIZE(icc_chart_options, 64);
AT(icc_chart_options, size, 0);
AT(icc_chart_options, method, 8);
AT(icc_chart_options, function, 12);
AT(icc_chart_options, tree, 16);
AT(icc_chart_options, cells, 20);
AT(icc_chart_options, maximum, 24);
AT(icc_chart_options, constraints, 32);
AT(icc_chart_options, solver, 36);
AT(icc_chart_options, min_fall, 40);
AT(icc_chart_options, leaf_min, 48);
AT(icc_chart_options, axis_order, 56);

SIZE(icc_chart_info, 88);
AT(icc_chart_info, size, 0);
AT(icc_chart_info, dim, 8);
AT(icc_chart_info, method, 12);
AT(icc_chart_info, certified, 16);
AT(icc_chart_info, reason, 20);
AT(icc_chart_info, cells, 24);
AT(icc_chart_info, maximum, 32);
AT(icc_chart_info, spacing, 80);

SIZE(icc_gradient_info, 112);
AT(icc_gradient_info, size, 0);
AT(icc_gradient_info, function, 8);
AT(icc_gradient_info, tree, 12);
AT(icc_gradient_info, n_grid, 16);
AT(icc_gradient_info, n_inside, 24);
AT(icc_gradient_info, n_tree, 32);
AT(icc_gradient_info, n_unreachable, 40);
AT(icc_gradient_info, n_cousin_violations, 48);
AT(icc_gradient_info, n_maxima, 56);
AT(icc_gradient_info, n_minima, 64);
AT(icc_gradient_info, n_saddles, 72);
AT(icc_gradient_info, n_edges, 80);
AT(icc_gradient_info, n_compression, 88);
AT(icc_gradient_info, n_expansion, 96);
AT(icc_gradient_info, moved, 104);

SIZE(icc_field_info, 104);
AT(icc_field_info, size, 0);
AT(icc_field_info, n_grid, 8);
AT(icc_field_info, n_inside, 16);
AT(icc_field_info, n_stray, 24);
AT(icc_field_info, n_tree, 32);
AT(icc_field_info, n_unreachable, 40);
AT(icc_field_info, n_cousin_violations, 48);
AT(icc_field_info, n_maxima, 56);
AT(icc_field_info, n_minima, 64);
AT(icc_field_info, n_saddles, 72);
AT(icc_field_info, n_infeasible, 80);
AT(icc_field_info, n_contacts, 88);
AT(icc_field_info, n_not_inward, 96);

SIZE(icc_foliation_info, 48);
AT(icc_foliation_info, size, 0);
AT(icc_foliation_info, n_mesh_vertices, 8);
AT(icc_foliation_info, n_mesh_boundary, 16);
AT(icc_foliation_info, n_mesh_simplices, 24);
AT(icc_foliation_info, n_ties, 32);
AT(icc_foliation_info, harmonic_share, 40);

SIZE(icc_shelling_info, 80);
AT(icc_shelling_info, size, 0);
AT(icc_shelling_info, n_mesh_vertices, 8);
AT(icc_shelling_info, n_mesh_boundary, 16);
AT(icc_shelling_info, n_mesh_simplices, 24);
AT(icc_shelling_info, harmonic_share, 32);
AT(icc_shelling_info, order_peeled, 40);
AT(icc_shelling_info, n_orders, 44);
AT(icc_shelling_info, order_beta, 48);
AT(icc_shelling_info, n_reversed, 56);
AT(icc_shelling_info, flux_energy, 64);
AT(icc_shelling_info, flux_divergence, 72);

SIZE(icc_disc_info, 32);
AT(icc_disc_info, size, 0);
AT(icc_disc_info, n_mesh_vertices, 8);
AT(icc_disc_info, n_mesh_boundary, 16);
AT(icc_disc_info, n_mesh_simplices, 24);

SIZE(icc_chart_timings, 72);
AT(icc_chart_timings, size, 0);
AT(icc_chart_timings, grid, 8);
AT(icc_chart_timings, tree, 16);
AT(icc_chart_timings, function, 24);
AT(icc_chart_timings, mesh, 32);
AT(icc_chart_timings, centre, 40);
AT(icc_chart_timings, solve, 48);
AT(icc_chart_timings, order, 56);
AT(icc_chart_timings, certify, 64);

SIZE(icc_chart_report, 56);
AT(icc_chart_report, size, 0);
AT(icc_chart_report, n_points, 8);
AT(icc_chart_report, n_boundary, 16);
AT(icc_chart_report, unreachable, 24);
AT(icc_chart_report, uncovered, 32);
AT(icc_chart_report, collapsed, 40);
AT(icc_chart_report, not_inward, 48);

SIZE(icc_tie, 48);
AT(icc_tie, size, 0);
AT(icc_tie, vertex, 8);
AT(icc_tie, n_source, 16);
AT(icc_tie, source, 24);
AT(icc_tie, n_target, 32);
AT(icc_tie, target, 40);

SIZE(icc_map_options, 56);
AT(icc_map_options, size, 0);
AT(icc_map_options, kind, 8);
AT(icc_map_options, iterations, 12);
AT(icc_map_options, chart, 16);
AT(icc_map_options, target_maximum, 24);
AT(icc_map_options, n_ties, 32);
AT(icc_map_options, ties, 40);
AT(icc_map_options, slide, 48);

SIZE(icc_map_info, 104);
AT(icc_map_info, size, 0);
AT(icc_map_info, dim, 8);
AT(icc_map_info, kind, 12);
AT(icc_map_info, certified, 16);
AT(icc_map_info, reason, 20);
AT(icc_map_info, reason_side, 24);
AT(icc_map_info, class_kept, 28);
AT(icc_map_info, n_vertices, 32);
AT(icc_map_info, n_simplices, 40);
AT(icc_map_info, energy, 48);
AT(icc_map_info, n_holes, 56);
AT(icc_map_info, n_lines, 64);
AT(icc_map_info, n_points, 72);
AT(icc_map_info, n_ties, 80);
AT(icc_map_info, detour, 88);
AT(icc_map_info, n_slid, 96);

SIZE(icc_map_report, 112);
AT(icc_map_report, size, 0);
AT(icc_map_report, seconds, 8);
AT(icc_map_report, seconds_repair, 16);
AT(icc_map_report, seconds_improve, 24);
AT(icc_map_report, seconds_certify, 32);
AT(icc_map_report, energy_start, 40);
AT(icc_map_report, n_inverted, 48);
AT(icc_map_report, n_unrepaired, 56);
AT(icc_map_report, n_iterations, 64);
AT(icc_map_report, n_levels, 72);
AT(icc_map_report, n_trees, 76);
AT(icc_map_report, n_samples, 80);
AT(icc_map_report, n_lost, 88);
AT(icc_map_report, n_flat, 96);
AT(icc_map_report, n_spoilt, 104);

SIZE(icc_tie_info, 48);
AT(icc_tie_info, size, 0);
AT(icc_tie_info, vertex, 8);
AT(icc_tie_info, n_source, 16);
AT(icc_tie_info, n_target, 24);
AT(icc_tie_info, length, 32);

SIZE(icc_improve_options, 24);
AT(icc_improve_options, size, 0);
AT(icc_improve_options, iterations, 8);
AT(icc_improve_options, levels, 12);
AT(icc_improve_options, tolerance, 16);

SIZE(icc_improve_report, 48);
AT(icc_improve_report, size, 0);
AT(icc_improve_report, energy_start, 8);
AT(icc_improve_report, energy, 16);
AT(icc_improve_report, n_iterations, 24);
AT(icc_improve_report, n_simplices, 32);
AT(icc_improve_report, n_levels, 40);
AT(icc_improve_report, cancelled, 44);

SIZE(icc_retarget_options, 16);
AT(icc_retarget_options, size, 0);
AT(icc_retarget_options, iterations, 8);

SIZE(icc_certificate, 304);
AT(icc_certificate, size, 0);
AT(icc_certificate, certified, 8);
AT(icc_certificate, boundary_simple, 12);
AT(icc_certificate, n_inverted, 16);
AT(icc_certificate, n_flat, 24);
AT(icc_certificate, n_no_image, 32);
AT(icc_certificate, first, 40);
AT(icc_certificate, message, 48);

SIZE(icc_picture, 64);
AT(icc_picture, size, 0);
AT(icc_picture, width, 8);
AT(icc_picture, height, 12);
AT(icc_picture, channels, 16);
AT(icc_picture, bytes, 20);
AT(icc_picture, alpha, 24);
AT(icc_picture, stride, 32);
AT(icc_picture, pixels, 40);
AT(icc_picture, interpolation, 48);
AT(icc_picture, has_nodata, 52);
AT(icc_picture, nodata, 56);

SIZE(icc_field, 152);
AT(icc_field, size, 0);
AT(icc_field, dim, 8);
AT(icc_field, bytes, 12);
AT(icc_field, displacement, 16);
AT(icc_field, outside, 20);
AT(icc_field, shape, 24);
AT(icc_field, origin, 48);
AT(icc_field, step, 72);
AT(icc_field, values, 144);

SIZE(icc_field_report, 248);
AT(icc_field_report, size, 0);
AT(icc_field_report, certified, 8);
AT(icc_field_report, one_to_one, 12);
AT(icc_field_report, n_cells, 16);
AT(icc_field_report, n_folded, 24);
AT(icc_field_report, n_undecided, 32);
AT(icc_field_report, n_missing, 40);
AT(icc_field_report, least, 48);
AT(icc_field_report, message, 56);

SIZE(icc_grid_info, 152);
AT(icc_grid_info, size, 0);
AT(icc_grid_info, dim, 8);
AT(icc_grid_info, shape, 16);
AT(icc_grid_info, origin, 64);
AT(icc_grid_info, spacing, 112);
AT(icc_grid_info, n_vertices, 120);
AT(icc_grid_info, n_inside, 128);
AT(icc_grid_info, n_stray, 136);
AT(icc_grid_info, cells, 144);

SIZE(icc_tree_options, 24);
AT(icc_tree_options, size, 0);
AT(icc_tree_options, form, 8);
AT(icc_tree_options, axis_order, 16);

SIZE(icc_tree_report, 56);
AT(icc_tree_report, size, 0);
AT(icc_tree_report, n_inside, 8);
AT(icc_tree_report, n_outside, 16);
AT(icc_tree_report, n_unreachable, 24);
AT(icc_tree_report, n_pairs, 32);
AT(icc_tree_report, n_cousin_violations, 40);
AT(icc_tree_report, violation, 48);

SIZE(icc_function_options, 40);
AT(icc_function_options, size, 0);
AT(icc_function_options, function, 8);
AT(icc_function_options, constraints, 12);
AT(icc_function_options, solver, 16);
AT(icc_function_options, min_fall, 24);
AT(icc_function_options, leaf_min, 32);

SIZE(icc_function_info, 80);
AT(icc_function_info, size, 0);
AT(icc_function_info, function, 8);
AT(icc_function_info, constrained, 12);
AT(icc_function_info, solver, 16);
AT(icc_function_info, beside, 20);
AT(icc_function_info, n_unknowns, 24);
AT(icc_function_info, n_violated, 32);
AT(icc_function_info, n_active, 40);
AT(icc_function_info, residual, 48);
AT(icc_function_info, least_log, 56);
AT(icc_function_info, excess, 64);
AT(icc_function_info, highest, 72);

SIZE(icc_solver_report, 80);
AT(icc_solver_report, size, 0);
AT(icc_solver_report, n_iterations, 8);
AT(icc_solver_report, n_inner, 16);
AT(icc_solver_report, work, 24);
AT(icc_solver_report, residual_before, 32);
AT(icc_solver_report, seconds_setup, 40);
AT(icc_solver_report, seconds_order, 48);
AT(icc_solver_report, seconds_factor, 56);
AT(icc_solver_report, seconds_solve, 64);
AT(icc_solver_report, seconds_verify, 72);

SIZE(icc_function_report, 40);
AT(icc_function_report, size, 0);
AT(icc_function_report, n_maxima, 8);
AT(icc_function_report, n_minima, 16);
AT(icc_function_report, n_saddles, 24);
AT(icc_function_report, critical, 32);

SIZE(icc_facet_report, 32);
AT(icc_facet_report, size, 0);
AT(icc_facet_report, n_tested, 8);
AT(icc_facet_report, n_compression, 16);
AT(icc_facet_report, n_expansion, 24);

SIZE(icc_curves_info, 40);
AT(icc_curves_info, size, 0);
AT(icc_curves_info, dim, 8);
AT(icc_curves_info, way, 12);
AT(icc_curves_info, n_curves, 16);
AT(icc_curves_info, n_vertices, 24);
AT(icc_curves_info, n_merged, 32);

SIZE(icc_grow_report, 64);
AT(icc_grow_report, size, 0);
AT(icc_grow_report, method, 8);
AT(icc_grow_report, vertex, 12);
AT(icc_grow_report, n_vertices, 16);
AT(icc_grow_report, n_deferred, 24);
AT(icc_grow_report, n_unplaced, 32);
AT(icc_grow_report, n_remaining, 40);
AT(icc_grow_report, n_reversed, 48);
AT(icc_grow_report, n_tests, 56);

SIZE(icc_sampling_options, 56);
AT(icc_sampling_options, size, 0);
AT(icc_sampling_options, kind, 8);
AT(icc_sampling_options, steps, 12);
AT(icc_sampling_options, spacing, 16);
AT(icc_sampling_options, margin, 24);
AT(icc_sampling_options, seed, 32);
AT(icc_sampling_options, n_fixed, 40);
AT(icc_sampling_options, fixed, 48);

SIZE(icc_sampling_info, 56);
AT(icc_sampling_info, size, 0);
AT(icc_sampling_info, dim, 8);
AT(icc_sampling_info, kind, 12);
AT(icc_sampling_info, n_samples, 16);
AT(icc_sampling_info, n_edge, 24);
AT(icc_sampling_info, spacing, 32);
AT(icc_sampling_info, nearest, 40);
AT(icc_sampling_info, sigma, 48);

SIZE(icc_line, 56);
AT(icc_line, from, 0);
AT(icc_line, to, 24);
AT(icc_line, parallel, 48);

SIZE(icc_weights_options, 88);
AT(icc_weights_options, size, 0);
AT(icc_weights_options, kernel, 8);
AT(icc_weights_options, initial, 12);
AT(icc_weights_options, method, 16);
AT(icc_weights_options, steps, 20);
AT(icc_weights_options, affine_tail, 24);
AT(icc_weights_options, within_shape, 28);
AT(icc_weights_options, sigma, 32);
AT(icc_weights_options, cutoff, 40);
AT(icc_weights_options, n_edges, 48);
AT(icc_weights_options, edges, 56);
AT(icc_weights_options, n_lines, 64);
AT(icc_weights_options, lines, 72);
AT(icc_weights_options, initial_weights, 80);

SIZE(icc_weights_info, 80);
AT(icc_weights_info, size, 0);
AT(icc_weights_info, dim, 8);
AT(icc_weights_info, kernel, 12);
AT(icc_weights_info, initial, 16);
AT(icc_weights_info, method, 20);
AT(icc_weights_info, n_handles, 24);
AT(icc_weights_info, n_nodes, 32);
AT(icc_weights_info, n_infeasible, 40);
AT(icc_weights_info, n_entries, 48);
AT(icc_weights_info, sigma, 56);
AT(icc_weights_info, definiteness, 64);
AT(icc_weights_info, residual, 72);

SIZE(icc_weights_timings, 32);
AT(icc_weights_timings, size, 0);
AT(icc_weights_timings, factor, 8);
AT(icc_weights_timings, initial, 16);
AT(icc_weights_timings, optimise, 24);

SIZE(icc_weights_report, 80);
AT(icc_weights_report, size, 0);
AT(icc_weights_report, n_infeasible, 8);
AT(icc_weights_report, n_negative, 16);
AT(icc_weights_report, unity, 24);
AT(icc_weights_report, reproduction, 32);
AT(icc_weights_report, reproduction_mean, 40);
AT(icc_weights_report, lagrange, 48);
AT(icc_weights_report, linearity, 56);
AT(icc_weights_report, least_weight, 64);
AT(icc_weights_report, definiteness, 72);

SIZE(icc_nearest_options, 24);
AT(icc_nearest_options, size, 0);
AT(icc_nearest_options, n_held, 8);
AT(icc_nearest_options, held, 16);

SIZE(icc_nearest_report, 64);
AT(icc_nearest_report, size, 0);
AT(icc_nearest_report, repair, 8);
AT(icc_nearest_report, n_folded, 16);
AT(icc_nearest_report, n_patches, 24);
AT(icc_nearest_report, changed, 32);
AT(icc_nearest_report, moved, 40);
AT(icc_nearest_report, most_moved, 48);
AT(icc_nearest_report, n_iterations, 56);

SIZE(icc_constraint, 64);
AT(icc_constraint, size, 0);
AT(icc_constraint, kind, 8);
AT(icc_constraint, n, 16);
AT(icc_constraint, source, 24);
AT(icc_constraint, vertices, 32);
AT(icc_constraint, target, 40);
AT(icc_constraint, direction, 48);
AT(icc_constraint, tolerance, 56);

SIZE(icc_fit_options, 80);
AT(icc_fit_options, size, 0);
AT(icc_fit_options, model, 8);
AT(icc_fit_options, box, 16);
AT(icc_fit_options, margin, 24);
AT(icc_fit_options, smoothing, 32);
AT(icc_fit_options, reach, 40);
AT(icc_fit_options, stiffness, 48);
AT(icc_fit_options, cell_stiffness, 56);
AT(icc_fit_options, cell, 64);
AT(icc_fit_options, no_contact, 72);

SIZE(icc_fit_info, 120);
AT(icc_fit_info, size, 0);
AT(icc_fit_info, model, 8);
AT(icc_fit_info, n_items, 16);
AT(icc_fit_info, margin, 24);
AT(icc_fit_info, smoothing, 32);
AT(icc_fit_info, residual, 40);
AT(icc_fit_info, left_out, 48);
AT(icc_fit_info, affine_residual, 56);
AT(icc_fit_info, n_off, 64);
AT(icc_fit_info, most_off, 72);
AT(icc_fit_info, repair, 80);
AT(icc_fit_info, n_folded, 88);
AT(icc_fit_info, n_patches, 96);
AT(icc_fit_info, changed, 104);
AT(icc_fit_info, n_iterations, 112);

SIZE(icc_layer, 48);
AT(icc_layer, size, 0);
AT(icc_layer, n_rings, 8);
AT(icc_layer, first, 16);
AT(icc_layer, vertices, 24);
AT(icc_layer, ids, 32);
AT(icc_layer, holes, 40);

SIZE(icc_coverage_options, 48);
AT(icc_coverage_options, size, 0);
AT(icc_coverage_options, weld, 8);
AT(icc_coverage_options, between, 24);
AT(icc_coverage_options, unmatched, 28);
AT(icc_coverage_options, n_left_out, 32);
AT(icc_coverage_options, left_out, 40);

SIZE(icc_coverage_info, 248);
AT(icc_coverage_info, size, 0);
AT(icc_coverage_info, n_regions, 8);
AT(icc_coverage_info, n_features, 16);
AT(icc_coverage_info, n_vertices, 24);
AT(icc_coverage_info, n_nodes, 32);
AT(icc_coverage_info, n_sides, 40);
AT(icc_coverage_info, n_islands, 48);
AT(icc_coverage_info, n_settled, 56);
AT(icc_coverage_info, n_joined, 64);
AT(icc_coverage_info, n_differences, 72);
AT(icc_coverage_info, n_left_out, 80);
AT(icc_coverage_info, n_given, 88);
AT(icc_coverage_info, n_welded, 104);
AT(icc_coverage_info, n_inserted, 120);
AT(icc_coverage_info, n_chains, 136);
AT(icc_coverage_info, chain, 152);
AT(icc_coverage_info, most_moved, 184);
AT(icc_coverage_info, least_apart, 200);
AT(icc_coverage_info, least_apart_at, 216);

SIZE(icc_coverage_difference, 56);
AT(icc_coverage_difference, size, 0);
AT(icc_coverage_difference, kind, 8);
AT(icc_coverage_difference, side, 12);
AT(icc_coverage_difference, n_ids, 16);
AT(icc_coverage_difference, ids, 24);
AT(icc_coverage_difference, place, 40);

#endif

/* The library that is linked and the headers belong together. */
START_TEST(the_version_is_that_of_the_headers)
{
    ck_assert_int_ge(icc_version_number(), 100);
    ck_assert_int_lt(icc_version_number(), 10000);
}
END_TEST

int main(void)
{
    Suite *suite = suite_create("abi");
    TCase *tests = tcase_create("all");
    tcase_add_test(tests, the_version_is_that_of_the_headers);
    suite_add_tcase(suite, tests);
    return suite_run(suite);
}
