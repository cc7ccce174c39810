// A C++17 program that uses the installed icc/icc.hpp: results, errors, ownership, progress, bytes.
#include <icc/icc.hpp>
#include <icc/stages.h>

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

const icc::error none({sizeof(icc_error), ICC_OK, 0, -1, "nothing was thrown"});
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
    check(map.info().certified == 1 && source.info().n_vertices == 4, "info");
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
    check(chart.info().method == ICC_METHOD_DISC, "a chart");

    const icc::handle<icc_grid, icc_grid_free> grid({}, [](auto out, auto... rest) {
        return icc_grid_create(out, source.get(), 10, rest...);
    });
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
    check(n_calls > 0, "progress is told");
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
    maps_points();
    makes_other_objects();
    reports_errors();
    moves();
    carries_exceptions();
    warps();
    saves();
    return n_failed != 0;
}
