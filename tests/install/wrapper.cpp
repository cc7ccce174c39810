// A C++17 program that uses the installed icc/icc.hpp: results, errors, ownership, progress, bytes.
#include <icc/icc.hpp>
#include <icc/stages.h>

#if __has_include(<eigen3/Eigen/Core>)
#define HAS_EIGEN
#pragma GCC diagnostic push
#pragma GCC diagnostic ignored "-Wconversion"
#include <eigen3/Eigen/Core>
#pragma GCC diagnostic pop
#endif

#include <array>
#include <cmath>
#include <cstdio>
#include <stdexcept>
#include <string>
#include <type_traits>
#if __cplusplus >= 202002L
#include <span>
#endif

namespace {

int n_failed = 0;

void check(bool holds, const char *what)
{
    if (!holds) {
        std::printf("failed: %s\n", what);
        ++n_failed;
    }
}

// The Exception that f throws, or `otherwise`.
template <class Exception, class F> Exception thrown(F f, Exception otherwise)
{
    try {
        f();
    } catch (const Exception &e) {
        return e;
    }
    return otherwise;
}

const icc::error none({sizeof(icc_error), ICC_OK, 0, -1, ICC_ITEM_NONE, "nothing was thrown"});
const icc::domain source = icc::domain::polygon({0, 0, 4, 0, 4, 3, 0, 3});
const icc::domain target = icc::domain::polygon({0, 0, 8, 0, 8, 6, 0, 6});

// Whether a is b times a factor. The map between these two shapes doubles.
bool is_times(const std::vector<double> &a, double factor, const std::vector<double> &b)
{
    bool all = a.size() == b.size();
    for (std::size_t i = 0; all && i < a.size(); ++i)
        all = std::fabs(a[i] - factor * b[i]) < 1e-9;
    return all;
}

void solids_have_features()
{
    const std::vector<double> outer{0, 0, 0, 8, 0, 0, 0, 8, 0, 0, 0, 8};
    const std::vector<double> inner{1, 1, 1, 2, 1, 1, 1, 2, 1, 1, 1, 2};
    const std::vector<double> point{3, 1, 1}, line{1, 1, 3, 2, 1, 3};
    const std::vector<std::uint32_t> faces{0, 2, 1, 0, 1, 3, 1, 2, 3, 2, 0, 3};
    const auto solid = icc::domain::solid(outer, faces,
                                          {icc::feature::hollow(inner, faces), icc::feature::line(line),
                                           icc::feature::point(point)});
    const auto info = solid.info();
    check(info.n_voids == 1 && info.n_lines == 1 && info.n_points == 1, "features of a solid");
    check(solid.features()[0].n_facets == 4 && solid.facets().size() == 24, "facets of a void");
    const auto err = thrown<icc::error>([&] { (void)solid.mesh_regions(); }, none);
    check(err.status == ICC_ERR_UNSUPPORTED, "no regions without a mesh");
    const icc::map map(source, target);
    check(map.mesh_regions() == std::vector<std::uint32_t>(map.info().n_simplices), "no regions");
}

void maps_points()
{
    struct point {
        double x, y;
    };
    const icc::map map(source, target);
    const std::vector<double> points{1, 1, 2, 1.5, 3.5, 0.5};
    const std::vector<double> images = map.apply(points);
    check(is_times(images, 2, points), "images");
    check(is_times(map.apply_inverse(images), 1, points), "and back");
    check(is_times(map.apply({1, 1}), 2, {1, 1}), "a list in braces");

    std::vector<double> same = points;
    check(map.apply(same, same) == 0 && is_times(same, 2, points), "in place");
    check(map.apply_inverse(same, same) == 0 && is_times(same, 1, points), "back in place");
    std::array<point, 2> structs{point{1, 1}, point{2, 1.5}};
    const auto *before = &structs;
    check(map.apply(icc::numbers(*before), icc::numbers(structs)) == 0 && structs[1].x > 3.999,
          "points of another type");
    std::vector<double> outside{1, 1, 9, 9};
    check(map.apply(outside, outside) == 1 && std::isnan(outside[2]), "a point outside");
    check(map.apply(std::vector<double>()).empty(), "no points");

    icc::env two;
    two.threads = 2;
    check(map.apply(points, two) == images, "two threads");
    check(map.certified() && source.info().n_vertices == 4, "info");
#if __cplusplus >= 202002L
    check(map.apply(std::span(points)) == images, "std::span");
    check(map.apply(std::span(points), std::span(same)) == 0 && same == images, "spans in and out");
#endif
}

void makes_other_objects()
{
    const std::vector<double> corners{0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1};
    const icc::domain solid = icc::domain::from_mesh(3, corners, {0, 1, 2, 3});
    check(solid.info().n_facets == 4, "a tetrahedron");
    const icc::domain ring(2, {0, 0, 1, 0, 0, 1}, {0, 1, 1, 2, 2, 0});
    check(ring.info().dim == 2, "facets");

    auto options = icc::sized<icc_chart_options>();
    options.method = ICC_METHOD_DISC;
    const icc::chart chart(source, options);
    check(chart.info().method == ICC_METHOD_DISC && chart.certified(), "a chart");
    check(chart.disc_info() && chart.disc_info()->n_mesh_simplices > 0, "what its method has");
    check(!chart.gradient_info() && !chart.field_info() && !chart.foliation_info() && !chart.shelling_info(),
          "and no other");

    const icc::handle<icc_grid, icc_grid_free> grid({}, [](auto out, auto... rest) {
        return icc_grid_create(out, source.get(), 10, rest...);
    });
    const icc::handle<icc_tree, icc_tree_free> tree({}, [&](auto out, auto... rest) {
        uint32_t root = 0;
        const icc_status status = icc_grid_find_maximum(grid.get(), &root, nullptr, rest...);
        return status == ICC_OK ? icc_tree_create(out, grid.get(), root, nullptr, rest...) : status;
    });
    const icc::handle<icc_function, icc_function_free> function({}, [&](auto out, auto... rest) {
        return icc_function_create(out, tree.get(), nullptr, rest...);
    });
    options.method = ICC_METHOD_GRADIENT;
    options.cells = 10;
    check(icc::chart::from_function(function.get()).encode({1, 1}).t == icc::chart(source, options).encode({1, 1}).t,
          "a chart from a function");
    auto info = icc::sized<icc_grid_info>();
    icc::call({}, [&](auto...) { return icc_grid_get_info(grid.get(), &info); });
    check(info.n_inside > 0, "an object without a class of its own");
}

void reports_errors()
{
    const icc::error crossing =
        thrown([] { icc::domain::polygon({0, 0, 1, 1, 1, 0, 0, 1}); }, none);
    check(crossing.status == ICC_ERR_BOUNDARY && crossing.index == 0, "status and index");
    check(std::string(crossing.what()).find("cross") != std::string::npos, "message");

    const icc::domain triangle = icc::domain::polygon({0, 0, 1, 0, 0, 1});
    check(thrown([&] { icc::map(source, triangle); }, none).status == ICC_ERR_BOUNDARY, "mismatch");
    auto options = icc::sized<icc_map_options>();
    const std::array<double, 2> outside{-1, 0};
    options.kind = ICC_MAP_CURVES;
    options.target_maximum = outside.data();
    check(thrown([&] { icc::map(source, target, options); }, none).side == 2, "side");
    check(thrown([] { icc::domain::polygon({0, 0, 1}); }, none).status == ICC_ERR_ARGUMENT,
          "half a point");

    const icc::map map(source, target);
    std::vector<double> images(2);
    check(thrown([&] { map.apply({1, 1, 2, 2}, images); }, none).status == ICC_ERR_ARGUMENT,
          "too few images");
    const icc::error nameless = thrown([] { icc::call({}, [](auto...) { return ICC_ERR_TRACE; }); }, none);
    check(std::string(nameless.what()) == "ICC_ERR_TRACE" && nameless.index == -1,
          "an error without a message");
}

void moves()
{
    static_assert(!std::is_copy_constructible_v<icc::map> && !std::is_copy_assignable_v<icc::map>);
    static_assert(std::is_nothrow_move_constructible_v<icc::map>);
    std::vector<icc::map> maps;
    maps.emplace_back(source, target);
    maps.push_back(std::move(maps.front()));
    check(is_times(maps.back().apply({1, 1}), 2, {1, 1}), "a map that has moved");
    check(thrown([&] { maps.front().apply({1, 1}); }, none).status == ICC_ERR_ARGUMENT,
          "what it has moved from");
    maps.front() = icc::map(target, source);
    check(is_times(maps.front().apply({1, 1}), 0.5, {1, 1}), "a map that has been replaced");
}

void carries_exceptions()
{
    int n_calls = 0;
    const auto make = [&](auto answer) {
        const icc::env e{1, [&](const char *stage, double share) {
                             check(stage != nullptr && share >= 0 && share <= 1, "progress");
                             ++n_calls;
                             return answer();
                         }};
        icc::map(source, target, icc::sized<icc_map_options>(), e);
    };
    make([] { return false; });
    check(n_calls > 0, "progress is reported");
    check(thrown([&] { make([] { return true; }); }, none).status == ICC_ERR_CANCELLED, "cancelled");
    n_calls = 0;
    const auto mine = thrown([&] { make([]() -> bool { throw std::out_of_range("mine"); }); },
                             std::out_of_range("none"));
    check(mine.what() == std::string("mine") && n_calls == 1, "an exception passes through, once");
}

void warps()
{
    std::array<unsigned char, 12> from{};
    std::array<unsigned char, 48> to{};
    from.fill(7);
    auto picture = icc::sized<icc_picture>();
    picture.width = 4;
    picture.height = 3;
    picture.channels = picture.bytes = 1;
    picture.stride = 4;
    picture.pixels = from.data();
    auto canvas = picture;
    canvas.width = 8;
    canvas.height = 6;
    canvas.stride = 8;
    canvas.pixels = to.data();
    check(icc::map(source, target).warp(picture, canvas) == 0, "a picture");
    check(to.front() == 7 && to.back() == 7, "all of it");
}

using points2 = std::vector<std::array<double, 2>>;

bool are_equal(const std::vector<double> &a, const std::vector<double> &b)
{
    return is_times(a, 1, b);
}

void takes_rows()
{
    const points2 square{{0, 0}, {4, 0}, {4, 3}, {0, 3}};
    const std::vector<std::array<std::uint32_t, 2>> sides{{0, 1}, {1, 2}, {2, 3}, {3, 0}};
    const icc::domain ring(2, square, sides);
    check(ring.vertices() == source.vertices() && ring.facets().size() == 8, "a boundary of rows");
    const icc::map map(icc::domain::polygon(square), target);
    const points2 images = map.apply(points2{{1, 1}, {2, 1.5}});
    check(images.size() == 2 && std::fabs(images[1][0] - 4) < 1e-9, "images by rows");
    const points2 back = map.apply_inverse(images);
    check(std::fabs(back[0][1] - 1) < 1e-9, "and back");
    std::array<std::array<double, 2>, 1> one{{{1, 1}}};
    check(map.apply(one, one) == 0 && std::fabs(one[0][0] - 2) < 1e-9, "rows in place");
    const std::vector<std::array<double, 3>> high{{1, 1, 1}, {2, 2, 2}};
    check(thrown([&] { map.apply(high); }, none).status == ICC_ERR_ARGUMENT, "rows of another length");
    check(thrown([&] { icc::domain::polygon(high); }, none).status == ICC_ERR_ARGUMENT,
          "a polygon of rows of another length");
}

struct xyz {
    double x, y, z;
};
struct labelled {
    double x, y;
    int label;
};
class own_point {
public:
    own_point() = default;
    own_point(double x, double y) : at_{x, y} {}
    double first() const { return at_[0]; }

private:
    double at_[2] = {0, 0};
};

} // namespace

template <> inline constexpr std::size_t icc::row_length<own_point, double> = 2;

namespace {

void takes_points_of_other_types()
{
    struct xy {
        double x, y;
    };
    static_assert(icc::row_length<xyz, double> == 3 && icc::row_length<xyz, float> == 0, "x, y and z");
    static_assert(icc::row_length<labelled, double> == 0 && icc::row_length<double, double> == 0, "more, and less");
    const std::vector<xy> square{{0, 0}, {4, 0}, {4, 3}, {0, 3}};
    const icc::map map(icc::domain::polygon(square), target);
    const std::vector<xy> images = map.apply(std::vector<xy>{{1, 1}, {2, 1.5}});
    check(std::fabs(images[1].x - 4) < 1e-9 && std::fabs(map.apply_inverse(images)[0].y - 1) < 1e-9, "structs");
    const std::vector<own_point> own{{1, 1}};
    check(std::fabs(map.apply(own)[0].first() - 2) < 1e-9, "a class of one's own");
    const std::vector<xyz> high{{1, 1, 1}};
    check(thrown([&] { map.apply(high); }, none).status == ICC_ERR_ARGUMENT, "structs of another length");
}

void tells_statuses()
{
    const icc::map map(source, target);
    const std::vector<double> points{1, 1, 9, 9, NAN, 0};
    std::vector<double> images(6), jacobians(12);
    std::vector<icc_status> status(3);
    check(map.apply(points, images, status) == 2 && status[0] == ICC_OK &&
              status[1] == ICC_ERR_OUTSIDE && status[2] == ICC_ERR_ARGUMENT,
          "statuses of points");
    check(map.apply_inverse(points, images, status, icc::env{}) == 2 && status[1] == ICC_ERR_OUTSIDE,
          "statuses of points back");
    check(map.jacobian(points, jacobians, status) == 2 && status[1] == ICC_ERR_OUTSIDE,
          "statuses of derivatives");
    check(are_equal(map.jacobian({1, 1.2}), {2, 0, 0, 2}), "a derivative");
    std::vector<icc_status> few(2);
    check(thrown([&] { map.apply(points, images, few); }, none).status == ICC_ERR_ARGUMENT,
          "too few statuses");
    check(thrown([&] { map.jacobian(points, images); }, none).status == ICC_ERR_ARGUMENT,
          "too little room for derivatives");
}

void makes_maps_of_maps()
{
    const icc::map first(source, target);
    const icc::domain moved = icc::domain::polygon({0, 0, 9, 0, 8, 6, 0, 6});
    const icc::map next = first.retarget(moved);
    check(next.certified() && next.get_source_chart() == nullptr, "a map that follows");
    check(first.get_source_chart() != nullptr && first.get_target_chart() != nullptr, "charts of a map");
    check(is_times(next.apply({0, 0, 4, 0}), 1, {0, 0, 9, 0}), "and where it goes");
    auto none_at_all = icc::sized<icc_retarget_options>();
    none_at_all.iterations = -1;
    check(first.retarget(moved, none_at_all).report().n_iterations == 0, "without steps");
    const std::vector<std::uint32_t> faces{0, 2, 1, 0, 1, 3, 1, 2, 3, 0, 3, 2};
    const icc::domain solid(3, {0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1}, faces);
    const icc::domain dragged(3, {0, 0, 0, 1, 0, 0, 0, 1, 0, 0.5, 0, 1}, faces);
    check(icc::map(solid, solid).retarget(dragged).certified(), "in space");

    auto report = icc::sized<icc_improve_report>();
    auto options = icc::sized<icc_improve_options>();
    options.iterations = 3;
    const icc::map better = next.improve(options, &report);
    check(report.energy <= report.energy_start && better.certified(), "a fairer map");
    check(next.improve().info().energy <= next.info().energy, "by the defaults");

    const icc::map_mesh mesh = next.mesh();
    check(mesh.vertices.size() == 2 * next.info().n_vertices && mesh.images.size() == mesh.vertices.size() &&
              mesh.simplices.size() == 3 * next.info().n_simplices,
          "its mesh");
    check(is_times(next.apply(mesh.vertices), 1, mesh.images), "which is the map");
    const icc::carried_mesh own = next.certify(mesh.vertices, mesh.simplices);
    check(own.images.size() == mesh.images.size() && own.certificate.n_inverted + own.certificate.n_no_image == 0,
          "a mesh that is carried along");
    const std::vector<std::array<std::uint32_t, 3>> one{{0, 1, 2}};
    check(next.repair({1, 1, 2, 1, 1, 2}, one).certificate.certified == 1, "and repaired");
    const icc::match pair(source, icc::domain::polygon({8, 0, 8, 6, 0, 6, 0, 0, 4, 0}));
    std::vector<double> off(2);
    check(is_times(pair.apply({0, 0, 4, 3}, off), 2, {0, 0, 4, 3}) && off[1] == 0, "along a match");
    check(is_times(icc::match::load(pair.save()).apply_inverse({0, 0, 8, 6}), 0.5, {0, 0, 8, 6}),
          "and back, when it is loaded");
    check(icc::map::load(next.save()).apply({1, 1}) == next.apply({1, 1}), "saved and loaded");

    std::vector<std::uint8_t> from(8 * 6, 9);
    std::vector<std::uint16_t> to(8 * 6, 0);
    const icc::view<const std::uint8_t> read(from);
    check(next.warp(icc::picture(read, 8, 6, 1), icc::picture(icc::view<std::uint8_t>(from), 8, 6, 1)) == 0,
          "a picture after following");
    check(thrown([&] { icc::picture(icc::view<std::uint16_t>(to), 8, 7, 1); }, none).status ==
              ICC_ERR_ARGUMENT,
          "a picture with too few samples");
    check(icc::picture(icc::view<std::uint16_t>(to), 3, 4, 4, true).stride == 24, "a picture's rows");
    auto curves = icc::sized<icc_map_options>();
    curves.kind = ICC_MAP_CURVES;
    const icc::map by_curves(source, target, curves);
    check(thrown([&] { by_curves.mesh(); }, none).status == ICC_ERR_UNSUPPORTED, "curves have no mesh");
    check(thrown([&] { by_curves.retarget(moved); }, none).status == ICC_ERR_UNSUPPORTED,
          "nor can they be followed");
}

void asks_charts_and_domains()
{
    const icc::chart chart(source), other(target);
    const std::vector<double> points{1, 1, 2, 1.4, 3.5, 0.5};
    const icc::coordinates c = chart.encode(points);
    check(c.facet.size() == 3 && c.status[2] == ICC_OK && are_equal(chart.decode(c), points),
          "coordinates there and back");
    points2 rows(3);
    std::vector<icc_status> status(3, -1);
    check(chart.decode(c, rows, status) == 0 && status[1] == ICC_OK && std::fabs(rows[1][1] - 1.4) < 1e-9,
          "into rows");
    icc::coordinates half = c;
    half.t.pop_back();
    check(thrown([&] { chart.decode(half); }, none).status == ICC_ERR_ARGUMENT, "coordinates amiss");
    check(chart.encode({9, 9}).status[0] == ICC_ERR_OUTSIDE, "a point outside");
    const std::vector<double> curve = chart.trace({1, 1});
    check(curve.size() >= 4 && curve.size() % 2 == 0, "a curve");
    check(thrown([&] { chart.trace({9, 9}); }, none).status == ICC_ERR_OUTSIDE, "no curve");
    check(thrown([&] { chart.trace({1, 1, 1}); }, none).status == ICC_ERR_ARGUMENT, "no point");
    check(chart.report(100).unreachable <= 0 && chart.get_domain() == source.get(), "a report");
    check(icc::map(chart, other).certified(), "a map of charts");
    check(icc::chart::load(chart.save()).save() == chart.save(), "saved and loaded");

    check(source.locate({1, 1, 0, 1, 9, 9}) == std::vector<std::int32_t>{ICC_INSIDE, ICC_BOUNDARY, ICC_OUTSIDE},
          "places");
    const icc::places near = source.locate_nearest({1, 0.25});
    check(near.where[0] == ICC_INSIDE && near.facet[0] == 0 && are_equal(near.bary, {0.75, 0.25}),
          "and the nearest");
    const std::vector<icc::defect> found = icc::defects({0, 0, 1, 1, 1, 0, 0, 1});
    check(found.size() == 1 && found[0].kind == ICC_DEFECT_CROSSING && found[0].a == 0 && found[0].b == 2,
          "defects");
    check(icc::defects({0, 0, 1, 0, 0, 1}).empty(), "none");
    std::vector<std::uint8_t> cells{1, 0, 0, 1};
    check(icc::repair_mask({2, 2}, cells) == 1, "a mask that is repaired");
    check(icc::domain::from_mask({2, 2}, cells).info().measure > 2.9, "a mask");
    check(thrown([&] { icc::domain::from_mask({2, 3}, cells); }, none).status == ICC_ERR_ARGUMENT,
          "too few cells");
}

void has_features()
{
    using icc::feature;
    const std::vector<double> square{0, 0, 9, 0, 9, 9, 0, 9};
    const icc::domain domain = icc::domain::with_features(
        square, {feature::hole({1, 1, 1, 3, 3, 3}), feature::line({5, 5, 7, 5}), feature::point({2, 8})});
    const icc_domain_info info = domain.info();
    check(info.n_features == 3 && info.n_vertices == 10 && info.n_facets == 7 && info.measure > 78.9 &&
              info.measure < 79.1,
          "a domain with features");
    const icc::domain sized = icc::domain::with_features(square, {feature::point({2, 7}, 1)});
    check(sized.features().size() == 2 && sized.features()[1].n_vertices == 16, "a point with a radius");
    const std::vector<icc_feature_info> features = domain.features();
    check(features.size() == 3 && features[0].kind == ICC_FEATURE_HOLE && features[0].orientation == -1 &&
              features[0].first_facet == 4 && features[1].kind == ICC_FEATURE_LINE &&
              features[1].first_vertex == 7 && features[1].n_vertices == 2 &&
              features[2].kind == ICC_FEATURE_POINT,
          "its features");
    check(domain.vertices()[19] > 7.9 && domain.facets().size() == 14, "its vertices");
    check(domain.locate({1.5, 2.5, 6, 5}) == std::vector<std::int32_t>{ICC_OUTSIDE, ICC_INSIDE}, "its hole");
    check(source.features().empty() && icc::domain::with_features(square, {}).info().n_features == 0,
          "no features");
    const icc::error refused =
        thrown([&] { icc::domain::with_features(square, {feature::point({1, 1}), feature::point({9, 1})}); }, none);
    check(refused.status == ICC_ERR_OUTSIDE && refused.index == 1 && refused.item == ICC_ITEM_FEATURE,
          "a point on the boundary");
    check(thrown([&] { icc::domain::with_features(square, {feature::line({1, 1, 2})}); }, none).status ==
              ICC_ERR_ARGUMENT,
          "half a vertex");
    check(thrown([&] { icc::chart chart(domain); }, none).status == ICC_ERR_UNSUPPORTED, "no chart");
    const icc::map map(domain, domain);
    std::vector<icc_tie> ties;
    const std::vector<icc::tie> own = map.ties();
    for (const icc::tie &tie : own)
        ties.push_back(tie.raw());
    auto options = icc::sized<icc_map_options>();
    options.n_ties = ties.size();
    options.ties = ties.data();
    check(ties.size() == 3 && icc::map(domain, domain, options).info().class_kept == 1, "its ties");
    check(icc::map(source, target).ties().empty(), "no ties");
}

#ifdef HAS_EIGEN
// Matrices are not copied, and those whose points do not lie one after the other are refused.
void takes_matrices()
{
    using columns = Eigen::Matrix<double, 2, Eigen::Dynamic>;
    using rows = Eigen::Matrix<double, Eigen::Dynamic, 2, Eigen::RowMajor>;
    const icc::map map(source, target);
    columns points(2, 3);
    points << 1, 2, 3.5, 1, 1.5, 0.5;
    const icc::view<const double> seen(points);
    check(seen.data() == points.data() && seen.size() == 6 && seen.width() == 2, "the view of a matrix");
    columns images(2, 3);
    check(map.apply(points, images) == 0 && (images - 2 * points).cwiseAbs().maxCoeff() < 1e-9, "columns");
    rows row_points = points.transpose(), row_images(3, 2);
    check(map.apply(row_points, row_images) == 0 && row_images == images.transpose(), "rows");
    check(is_times(map.apply(points), 2, {1, 1, 2, 1.5, 3.5, 0.5}), "images of a matrix as a vector");
    const Eigen::Vector2d one(1, 1);
    check(is_times(map.apply(one), 2, {1, 1}), "a vector");
    check(map.apply(points.leftCols(2)).size() == 4, "a block of whole columns");
    const std::vector<Eigen::Vector2d> list{{1, 1}, {2, 1.5}};
    check((map.apply(list)[1] - 2 * list[1]).norm() < 1e-9, "a vector of vectors");

    const Eigen::MatrixXd wrong = points.transpose(); // x of all points, then y of all
    check(thrown([&] { map.apply(wrong); }, none).status == ICC_ERR_ARGUMENT, "points in rows, column by column");
    const Eigen::Matrix<double, 3, Eigen::Dynamic> high = Eigen::MatrixXd::Ones(3, 2);
    check(thrown([&] { map.apply(high.topRows<2>()); }, none).status == ICC_ERR_ARGUMENT, "a block with gaps");
    check(thrown([&] { map.apply(high.row(0)); }, none).status == ICC_ERR_ARGUMENT, "a row with gaps");
    Eigen::MatrixXd wide = Eigen::MatrixXd::Zero(3, 3);
    check(thrown([&] { map.apply(points, wide.topRows<2>()); }, none).status == ICC_ERR_ARGUMENT, "results with gaps");
    Eigen::Matrix<std::uint32_t, 2, 4> sides;
    sides << 0, 1, 2, 3, 1, 2, 3, 0;
    Eigen::Matrix<double, 2, 4> square;
    square << 0, 4, 4, 0, 0, 0, 3, 3;
    check(icc::domain(2, square, sides).info().measure == 12, "facets");
}
#endif

// Vertices and triangles of a square of 2 x 2 smaller ones, whose middle is vertex 4.
const std::vector<double> mesh_vertices{0, 0, 1, 0, 2, 0, 0, 1, 1, 1, 2, 1, 0, 2, 1, 2, 2, 2};
const std::vector<std::uint32_t> mesh_triangles{0, 1, 4, 0, 4, 3, 1, 2, 5, 1, 5, 4,
                                                3, 4, 7, 3, 7, 6, 4, 5, 8, 4, 8, 7};

void fits()
{
    const std::vector<double> points{0, 0, 4, 0, 4, 3, 0, 3, 2, 1}, targets{1, 1, 5, 2, 6, 5, 1, 4, 3, 2};
    const icc::fit fit(points, targets);
    check(fit.certified() && is_times(fit.apply(points), 1, targets), "a fit");
    check(is_times(fit.residuals(), 0, points) && !std::isnan(fit.left_out()[0]), "residuals");
    check(fit.fit_info().model == ICC_FIT_SPLINE && fit.fit_info().n_items == 5, "about a fit");
    std::vector<double> others = targets;
    others[8] = 3.5;
    icc::fit moved = fit.move(others);
    check(is_times(moved.apply({2, 1}), 1, {3.5, 2}) && is_times(fit.apply({2, 1}), 1, {3, 2}),
          "a fit that moves");
    const icc::map kept = std::move(moved); // keeps the whole fit alive
    check(is_times(kept.apply({2, 1}), 1, {3.5, 2}), "the map of a fit");
    check(thrown([&] { fit.move({1, 2}); }, none).status == ICC_ERR_ARGUMENT, "too few targets");
    check(thrown([&] { icc::fit(points, {1, 2}); }, none).status == ICC_ERR_ARGUMENT, "fewer targets than points");

    const icc::fit posed(source, {icc::constraint::points({1, 1, 3, 2}, {1, 1, 3, 2.5})});
    check(is_times(posed.apply({3, 2}), 1, {3, 2.5}) && posed.fit_info().model == ICC_FIT_ELASTIC, "pins");
    const std::vector<std::uint32_t> told{0, 1, 2, 6, 7, 8}, sides{3, 5};
    const std::vector<double> places{0, 0, 1, 0, 2, 0, 0, 3, 1, 3, 2, 3};
    const icc::fit wall =
        icc::fit::on_mesh(mesh_vertices, mesh_triangles,
                          {icc::constraint::vertices(told, places), icc::constraint::sliding(sides)});
    check(wall.mesh().simplices.size() == mesh_triangles.size() && wall.apply({0, 1})[0] == 0, "a wall");
    std::vector<double> tolerance(5, 0.1);
    const icc::fit loose({icc::constraint::points(points, targets, tolerance)});
    check(loose.certified() && loose.get_fit() != nullptr, "points with a tolerance");

    auto report = icc::sized<icc_nearest_report>();
    std::vector<double> images = mesh_vertices;
    check(icc::map::nearest(mesh_vertices, mesh_triangles, images).mesh().images == images,
          "a warp that does not fold");
    images[8] = 2.5;
    const icc::map nearest = icc::map::nearest(mesh_vertices, mesh_triangles, images, {}, &report);
    check(nearest.certified() && report.n_folded > 0, "a warp that folds");
    check(thrown([&] { icc::map::nearest(mesh_vertices, mesh_triangles, {1, 2}); }, none).status == ICC_ERR_ARGUMENT,
          "too few images");
}

void saves()
{
    const icc::map map(source, target);
    std::vector<std::byte> bytes = map.save();
    const std::vector<double> points{1, 1, 2, 1.5, 3.5, 0.5};
    check(icc::map(bytes).apply(points) == map.apply(points), "a map from bytes");
    const icc::chart chart(source);
    check(icc::chart(chart.save()).save() == chart.save(), "a chart from bytes");
    bytes[bytes.size() / 2] ^= std::byte{1};
    check(thrown([&] { icc::map again(bytes); }, none).status == ICC_ERR_FORMAT, "bytes that are wrong");
}

} // namespace

int main()
{
    solids_have_features();
    maps_points();
    makes_other_objects();
    reports_errors();
    moves();
    carries_exceptions();
    warps();
    saves();
    takes_rows();
    takes_points_of_other_types();
    tells_statuses();
    makes_maps_of_maps();
    asks_charts_and_domains();
    has_features();
    fits();
#ifdef HAS_EIGEN
    takes_matrices();
#endif
    return n_failed != 0;
}
