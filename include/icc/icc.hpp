/**
 * @file icc/icc.hpp
 * @brief C++17: domains, charts and maps that free themselves, errors as exceptions; header only.
 *
 *     const auto before = icc::domain::polygon({0, 0, 4, 0, 4, 3, 0, 3});
 *     const auto after = icc::domain::polygon({0, 0, 4, 1, 4, 4, 0, 3});
 *     const std::vector<double> images = icc::map(before, after).apply({1, 1, 2, 1.5});
 *
 * A thin layer over icc/icc.h, whose headers have the contracts. For anything that has no C++ class,
 * use icc::call() and icc::handle. All of this is inline, so your program depends on the library
 * only through its C interface.
 *
 * SPDX-License-Identifier: MIT
 */
#ifndef ICC_ICC_HPP
#define ICC_ICC_HPP
#if __cplusplus < 201703L
#error "icc/icc.hpp needs C++17; icc/icc.h does not"
#endif

#include <icc/icc.h>

#include <array>
#include <cstddef>
#include <cstdint>
#include <exception>
#include <functional>
#include <memory>
#include <optional>
#include <type_traits>
#include <utility>
#include <vector>

/** libicc for C++. */
namespace icc {

template <class T> class view;

/** Whether C is an icc::view. */
template <class C> inline constexpr bool is_view = false;
/** True for icc::view itself. */
template <class T> inline constexpr bool is_view<view<T>> = true;

/** How many T an E consists of, in the order in which they lie in memory: a point, the vertices of a
 *  facet. 0: an E is something else. Known are `std::array`, structs of x and y, or of x, y and z, such as
 *  glm's, and Eigen's vectors of fixed size. For a type of your own, tell it once:
 *
 *      template <> inline constexpr std::size_t icc::row_length<my_point, double> = 2; */
template <class E, class T, class = void> inline constexpr std::size_t row_length = 0;
template <class T, std::size_t N> inline constexpr std::size_t row_length<std::array<T, N>, T> = N;

/** Whether E has a member z. */
template <class E, class = void> inline constexpr bool has_z = false;
template <class E> inline constexpr bool has_z<E, std::void_t<decltype(std::declval<E &>().z)>> = true;

/** A struct of T whose members are x and y, or x, y and z, and nothing else. */
template <class E, class T>
inline constexpr std::size_t row_length<
    E, T, std::enable_if_t<std::is_same_v<decltype(std::declval<E>().x), T> &&
                           std::is_same_v<decltype(std::declval<E>().y), T> &&
                           std::is_standard_layout_v<E>>> =
    sizeof(E) == (has_z<E> ? 3 : 2) * sizeof(T) ? sizeof(E) / sizeof(T) : 0;

/** A vector of Eigen whose size the compiler knows. */
template <class E, class T>
inline constexpr std::size_t row_length<
    E, T, std::enable_if_t<std::is_same_v<typename E::Scalar, T> && (E::SizeAtCompileTime > 0) &&
                           E::IsVectorAtCompileTime>> =
    sizeof(E) == E::SizeAtCompileTime * sizeof(T) ? E::SizeAtCompileTime : 0;

/** Whether C is a matrix that says how its numbers lie in memory, such as Eigen's. */
template <class C, class = void> inline constexpr bool is_matrix = false;
template <class C>
inline constexpr bool is_matrix<C, std::void_t<decltype(std::declval<C &>().innerStride()),
                                               decltype(std::declval<C &>().outerStride()),
                                               decltype(C::IsVectorAtCompileTime)>> = true;

/** Contiguous elements that someone else owns: a vector, an array, a `std::span` or a list in
 *  braces. Elements may be rows as icc::row_length knows them, such as `std::vector<std::array<double, 2>>`
 *  or `std::vector<Eigen::Vector2d>` for points. You may also pass an Eigen matrix. Each column is a point (`Matrix<double, 2, Dynamic>`), or each
 *  row if it is RowMajor. The call refuses other layouts. */
template <class T> class view {
    using value = std::remove_const_t<T>;
    template <class C> using element = std::remove_pointer_t<decltype(std::data(std::declval<C &>()))>;
    template <class E>
    static constexpr bool holds = row_length<std::remove_const_t<E>, value> != 0 &&
                                  (std::is_const_v<T> || !std::is_const_v<E>);

public:
    constexpr view() noexcept = default; /**< empty */
    /** `size` elements that begin at `data`. */
    constexpr view(T *data, std::size_t size) noexcept
        : data_(size != 0 ? data : nullptr), size_(size) {}
    /** Everything that `std::data` and `std::size` accept. */
    template <class C, class = std::enable_if_t<
                           !is_view<std::decay_t<C>> &&
                           std::is_convertible_v<decltype(std::data(std::declval<C &>())), T *>>>
    constexpr view(C &&all) noexcept : view(std::data(all), static_cast<std::size_t>(std::size(all)))
    {
        if constexpr (is_matrix<std::remove_reference_t<C>>)
            width_ = width_of(all);
    }
    /** A read-only view of a writable one. */
    template <class U, class = std::enable_if_t<std::is_convertible_v<U *, T *>>>
    constexpr view(const view<U> &other) noexcept
        : data_(other.data()), size_(other.size()), width_(other.width()) {}
    /** All rows, as plain numbers. */
    template <class C, std::enable_if_t<holds<element<C>>, int> = 0>
    view(C &&rows) noexcept
        : view(reinterpret_cast<T *>(std::data(rows)), std::size(rows) * (sizeof(element<C>) / sizeof(T)))
    {
        width_ = sizeof(element<C>) / sizeof(T);
    }
    /** A list in braces, which lasts as long as the call. */
    constexpr view(std::initializer_list<value> list) noexcept
        : view(std::data(list), list.size()) {}
    constexpr T *data() const noexcept { return data_; }            /**< NULL if there are none */
    constexpr std::size_t size() const noexcept { return size_; }   /**< number of elements */
    constexpr std::size_t width() const noexcept { return width_; } /**< elements per row; 0: no rows */

private:
    /** Number of elements before the first gap. A gap makes it an invalid width for points. */
    template <class Matrix> static constexpr std::size_t width_of(const Matrix &m)
    {
        if (Matrix::IsVectorAtCompileTime)
            return m.innerStride() == 1 ? 0 : SIZE_MAX;
        const bool dense = m.innerStride() == 1 && m.outerStride() == m.innerSize();
        return dense ? static_cast<std::size_t>(m.innerSize()) : SIZE_MAX;
    }

    T *data_ = nullptr;
    std::size_t size_ = 0, width_ = 0;
};

/** The coordinates of points whose type holds doubles and nothing else, such as
 *  `struct { double x, y; }` or `std::array<double, 3>`. */
template <class Points> auto numbers(Points &points) noexcept
{
    using point = std::remove_pointer_t<decltype(std::data(points))>;
    using number = std::conditional_t<std::is_const_v<point>, const double, double>;
    static_assert(std::is_standard_layout_v<point> && sizeof(point) % sizeof(double) == 0);
    return view<number>(reinterpret_cast<number *>(std::data(points)),
                        std::size(points) * (sizeof(point) / sizeof(double)));
}

/** A call that failed: `status`, `side` and `index` are those of ::icc_error. */
class error : public std::exception, public icc_error {
public:
    explicit error(const icc_error &e) noexcept : icc_error(e) {} /**< as the C interface reports it */
    /** One line of English. */
    const char *what() const noexcept override { return *message ? message : icc_status_name(status); }
};

/** How a call runs. */
struct env {
    std::int32_t threads = 1; /**< threads that the call may use; results do not depend on it */
    /** Called from time to time on the calling thread, with the name of the stage and the share of the whole
     *  call that is done, which never falls. Return true to cancel: the call throws icc::error with
     *  ::ICC_ERR_CANCELLED. An exception cancels as well and propagates from the call. */
    std::function<bool(const char *stage, double share)> progress = {};
    /** Memory limit for loading objects, see icc_env::load_limit; 0: the default. */
    std::uint64_t load_limit = 0;
};

/** A struct of the C interface with its `size` set. All else is 0, which means the default. */
template <class T> T sized() noexcept
{
    T result{};
    result.size = sizeof result;
    return result;
}

/** Calls f(const icc_env *, icc_error *) and throws icc::error unless that returns ::ICC_OK. */
template <class F> void call(const env &e, F &&f)
{
    // An exception must not pass through C: it waits here until the call is back.
    struct state {
        const env &e;
        std::exception_ptr thrown;
    } now{e, nullptr};
    auto c_env = sized<icc_env>();
    c_env.threads = e.threads;
    c_env.load_limit = e.load_limit;
    c_env.user = &now;
    if (e.progress)
        c_env.progress = [](void *user, const char *stage, double share) -> std::int32_t {
            auto &in = *static_cast<state *>(user);
            try {
                return in.thrown || in.e.progress(stage, share);
            } catch (...) {
                in.thrown = std::current_exception();
                return 1;
            }
        };
    icc_error err{sizeof err, ICC_OK, 0, -1, ICC_ITEM_NONE, ""};
    err.status = f(static_cast<const icc_env *>(&c_env), &err);
    if (now.thrown)
        std::rethrow_exception(now.thrown);
    if (err.status != ICC_OK)
        throw error(err);
}

/** Number of points, facets or simplices in a list, `each` numbers apiece. */
template <class T> std::size_t count(view<T> list, std::int64_t each)
{
    const auto n = static_cast<std::size_t>(each > 0 ? each : 1);
    if (list.size() % n != 0)
        throw error({sizeof(icc_error), ICC_ERR_ARGUMENT, 0, -1, ICC_ITEM_NONE, "a list ends amid a point or simplex"});
    if (list.width() != 0 && list.width() != n)
        throw error({sizeof(icc_error), ICC_ERR_ARGUMENT, 0, -1, ICC_ITEM_NONE, "points are of another dimension, or do not lie one after the other"});
    return list.size() / n;
}

/** A mesh that the library only reads. */
inline icc_mesh mesh_of(std::int32_t dim, view<const double> vertices, view<const std::uint32_t> simplices)
{
    auto mesh = sized<icc_mesh>();
    mesh.dim = dim;
    mesh.n_vertices = count(vertices, dim);
    mesh.vertices = const_cast<double *>(vertices.data());
    mesh.n_cells = count(simplices, std::int64_t{dim} + 1);
    mesh.cells = const_cast<std::uint32_t *>(simplices.data());
    return mesh;
}

/** Throws icc::error unless your list has room for exactly this many elements. */
template <class T> void expect(view<T> list, std::size_t n)
{
    if (list.size() != n || list.width() == SIZE_MAX)
        throw error({sizeof(icc_error), ICC_ERR_ARGUMENT, 0, -1, ICC_ITEM_NONE, "a list for results has another length"});
}

/** An object of the C interface that frees itself: `icc::handle<icc_grid, icc_grid_free>`. Calls refuse an
 *  empty one, which moving leaves behind. */
template <class T, void (*Free)(T *)> class handle {
public:
    /** Owns the object that f(T **out, const icc_env *, icc_error *) makes. Throws as icc::call() does. */
    template <class F> handle(const env &e, F &&f)
    {
        call(e, [&](const icc_env *c_env, icc_error *err) {
            T *out = nullptr;
            const icc_status status = f(&out, c_env, err);
            owned_.reset(out);
            return status;
        });
    }

    const T *get() const noexcept { return owned_.get(); } /**< pointer for the C interface; borrowed */

protected:
    /** Holds an object that belongs to another one, and keeps that alive. */
    handle(const T *borrowed, std::shared_ptr<const void> owner)
        : owned_(const_cast<T *>(borrowed), release{std::move(owner)}) {}

    /** Returns the struct that `read` fills in. */
    template <class Info> Info tell(icc_status (*read)(const T *, Info *)) const
    {
        auto info = sized<Info>();
        call({}, [&](auto...) { return read(get(), &info); });
        return info;
    }

    /** Returns the bytes that `write` writes. */
    auto bytes(icc_status (*write)(const T *, std::size_t, void *, std::size_t *)) const
    {
        std::size_t n = 0;
        call({}, [&](auto...) { return write(get(), 0, nullptr, &n); });
        std::vector<std::byte> data(n);
        call({}, [&](auto...) { return write(get(), n, data.data(), &n); });
        return data;
    }

private:
    /// @cond
    struct release {
        std::shared_ptr<const void> owner = nullptr; // of a borrowed object
        void operator()(T *object) const noexcept
        {
            if (!owner)
                Free(object);
        }
    };
    /// @endcond
    std::unique_ptr<T, release> owned_;
};

/** Where points lie, and the nearest points of the boundary. */
struct places {
    std::vector<std::int32_t> where;  /**< ::ICC_INSIDE, ::ICC_BOUNDARY or ::ICC_OUTSIDE */
    std::vector<std::uint32_t> facet; /**< the nearest facet of each point */
    std::vector<double> bary;         /**< `dim` barycentric coordinates on it for each */
};

/** A hole, line, point or region inside a domain: domain::with_features() and domain::solid(). `icc::feature::hole({..})`
 *  and its siblings borrow the coordinates. */
struct feature {
    std::int32_t kind;           /**< `ICC_FEATURE_*` */
    view<const double> vertices; /**< 2 coordinates each, or 3 in a solid */
    double radius = 0;           /**< point of the plane: its size, or 0 */
    view<const std::uint32_t> facets{}; /**< hole or region of a solid: 3 of its vertices each */

    /** A simple polygon that is cut out. */
    static feature hole(view<const double> vertices) noexcept { return {ICC_FEATURE_HOLE, vertices, 0}; }
    /** A simple polygon that belongs to the domain. */
    static feature region(view<const double> vertices) noexcept
    {
        return {ICC_FEATURE_REGION, vertices, 0};
    }
    /** A polyline. */
    static feature line(view<const double> vertices) noexcept { return {ICC_FEATURE_LINE, vertices, 0}; }
    /** A point. With a radius, the circle around it moves along. */
    static feature point(view<const double> vertex, double radius = 0) noexcept
    {
        return {ICC_FEATURE_POINT, vertex, radius};
    }
    /** A closed surface in a solid whose inside is empty. */
    static feature hollow(view<const double> vertices, view<const std::uint32_t> facets) noexcept
    {
        return {ICC_FEATURE_HOLE, vertices, 0, facets};
    }
    /** A closed surface in a solid with the solid on both sides. */
    static feature surface(view<const double> vertices, view<const std::uint32_t> facets) noexcept
    {
        return {ICC_FEATURE_REGION, vertices, 0, facets};
    }
};

/// @cond
inline std::vector<icc_feature> listed(const std::vector<feature> &features, std::int32_t dim)
{
    std::vector<icc_feature> all;
    all.reserve(features.size());
    for (const feature &f : features) {
        all.push_back(sized<icc_feature>());
        all.back().kind = f.kind;
        all.back().n_vertices = count(f.vertices, dim);
        all.back().vertices = f.vertices.data();
        all.back().radius = f.radius;
        all.back().n_facets = count(f.facets, 3);
        all.back().facets = f.facets.data();
    }
    return all;
}
/// @endcond

/** A shape: its boundary, and what lies inside. */
class domain : public handle<icc_domain, icc_domain_free> {
public:
    using handle::handle;

    /** Makes a domain from a closed boundary, `dim` vertices a facet: icc_domain_create(). */
    domain(std::int32_t dim, view<const double> vertices, view<const std::uint32_t> facets,
           const env &e = {})
        : handle(e, [&](auto out, auto... rest) {
              return icc_domain_create(out, dim, count(vertices, dim), vertices.data(),
                                       count(facets, dim), facets.data(), rest...);
          }) {}

    /** Makes a domain from a simple polygon. */
    static domain polygon(view<const double> vertices, const env &e = {})
    {
        return domain(2, vertices, {}, e);
    }

    /** Makes a domain from a simple polygon with holes, lines and points: icc_domain_create_features(). */
    static domain with_features(view<const double> outer, const std::vector<feature> &features,
                                const env &e = {})
    {
        const std::vector<icc_feature> all = listed(features, 2);
        return domain(e, [&](auto out, auto... rest) {
            return icc_domain_create_features(out, count(outer, 2), outer.data(), all.size(), all.data(),
                                              rest...);
        });
    }

    /** Makes a solid in 3-D with voids, surfaces, lines and points inside: icc_domain_create_solid(). */
    static domain solid(view<const double> vertices, view<const std::uint32_t> facets,
                        const std::vector<feature> &features, const env &e = {})
    {
        const std::vector<icc_feature> all = listed(features, 3);
        return domain(e, [&](auto out, auto... rest) {
            return icc_domain_create_solid(out, count(vertices, 3), vertices.data(), count(facets, 3),
                                           facets.data(), all.size(), all.data(), rest...);
        });
    }

    /** Makes a domain from a mesh of its inside, `dim` + 1 vertices a simplex: icc_domain_create_mesh(). */
    static domain from_mesh(std::int32_t dim, view<const double> vertices,
                            view<const std::uint32_t> simplices,
                            view<const std::uint32_t> facets = {}, const env &e = {})
    {
        return domain(e, [&](auto out, auto... rest) {
            const icc_mesh mesh = mesh_of(dim, vertices, simplices);
            return icc_domain_create_mesh(out, &mesh, count(facets, dim), facets.data(), rest...);
        });
    }

    /** Fills this surface in 3-D with tetrahedra: icc_domain_fill(). */
    domain filled(const icc_fill_options &options = sized<icc_fill_options>(),
                  const env &e = {}) const
    {
        return domain(e, [&](auto out, auto... rest) {
            return icc_domain_fill(out, get(), &options, rest...);
        });
    }

    /** Makes a domain from a mask of cells, the first axis fastest: icc_domain_create_mask(). `shape` is the
     *  number of cells along each axis. */
    static domain from_mask(view<const std::size_t> shape, view<const std::uint8_t> cells,
                            const env &e = {})
    {
        expect(cells, product(shape));
        return domain(e, [&](auto out, auto... rest) {
            return icc_domain_create_mask(out, static_cast<std::int32_t>(shape.size()), shape.data(),
                                          cells.data(), rest...);
        });
    }

    /** Number of cells in a mask. */
    static std::size_t product(view<const std::size_t> shape) noexcept
    {
        std::size_t n = 1;
        for (std::size_t k = 0; k < shape.size(); ++k)
            n *= shape.data()[k];
        return n;
    }

    icc_domain_info info() const { return tell(icc_domain_get_info); } /**< dimension, counts, .. */

    /** A copy of the boundary's vertices, and of those of all features. */
    std::vector<double> vertices() const
    {
        const auto about = info();
        std::vector<double> result(about.n_vertices * static_cast<std::size_t>(about.dim));
        call({}, [&](auto...) { return icc_domain_get_boundary(get(), result.data(), nullptr); });
        return result;
    }

    /** A copy of its facets, `dim` vertices each. */
    std::vector<std::uint32_t> facets() const
    {
        const auto about = info();
        std::vector<std::uint32_t> result(about.n_facets * static_cast<std::size_t>(about.dim));
        call({}, [&](auto...) { return icc_domain_get_boundary(get(), nullptr, result.data()); });
        return result;
    }

    /** Its holes, lines and points. vertices() has the coordinates. */
    std::vector<icc_feature_info> features() const
    {
        std::vector<icc_feature_info> result(info().n_features, sized<icc_feature_info>());
        for (std::size_t f = 0; f < result.size(); ++f)
            call({}, [&](auto...) { return icc_domain_get_feature(get(), f, &result[f]); });
        return result;
    }

    /** The vertices of the mesh of its inside, those of the boundary first, and its simplices. */
    std::pair<std::vector<double>, std::vector<std::uint32_t>> mesh() const
    {
        auto own = sized<icc_mesh>();
        call({}, [&](auto...) { return icc_domain_get_mesh(get(), &own); });
        const auto dim = static_cast<std::size_t>(own.dim);
        std::pair<std::vector<double>, std::vector<std::uint32_t>> result(
            std::vector<double>(own.n_vertices * dim), std::vector<std::uint32_t>(own.n_cells * (dim + 1)));
        own.vertices = result.first.data();
        own.cells = result.second.data();
        call({}, [&](auto...) { return icc_domain_get_mesh(get(), &own); });
        return result;
    }

    /** The region of each simplex of mesh(): icc_domain_get_regions(). */
    std::vector<std::uint32_t> mesh_regions() const
    {
        std::vector<std::uint32_t> result(info().n_mesh_simplices);
        call({}, [&](auto...) { return icc_domain_get_regions(get(), result.data()); });
        return result;
    }

    /** Where points lie: ::ICC_INSIDE, ::ICC_BOUNDARY or ::ICC_OUTSIDE. */
    std::vector<std::int32_t> locate(view<const double> points, const env &e = {}) const
    {
        std::vector<std::int32_t> where(count(points, info().dim));
        call(e, [&](auto c_env, auto) {
            return icc_domain_locate(get(), where.size(), points.data(), where.data(), nullptr, nullptr,
                                     c_env);
        });
        return where;
    }

    /** Where points lie, and the nearest points of the boundary. */
    places locate_nearest(view<const double> points, const env &e = {}) const
    {
        const std::size_t n = count(points, info().dim);
        places found{std::vector<std::int32_t>(n), std::vector<std::uint32_t>(n),
                     std::vector<double>(points.size())};
        call(e, [&](auto c_env, auto) {
            return icc_domain_locate(get(), n, points.data(), found.where.data(), found.facet.data(),
                                     found.bary.data(), c_env);
        });
        return found;
    }
};

/** A defect that keeps a polygon from being a boundary: icc_boundary_defects(). */
struct defect {
    std::int32_t kind; /**< `ICC_DEFECT_*` */
    std::uint32_t a;   /**< a vertex or an edge, as `kind` says */
    std::uint32_t b;   /**< another, as `kind` says */
};

/** Lists all defects of a closed polygon. */
inline std::vector<defect> defects(view<const double> polygon, const env &e = {})
{
    std::vector<std::int32_t> kinds;
    std::vector<std::uint32_t> items;
    std::size_t n = 0;
    do {
        kinds.resize(n);
        items.resize(2 * n);
        call(e, [&](auto... rest) {
            return icc_boundary_defects(count(polygon, 2), polygon.data(), kinds.size(), kinds.data(),
                                        items.data(), &n, rest...);
        });
    } while (n > kinds.size());
    std::vector<defect> result(n);
    for (std::size_t i = 0; i < n; ++i)
        result[i] = {kinds[i], items[2 * i], items[2 * i + 1]};
    return result;
}

/** Fills cells of a mask until no others touch only along an edge or a corner: icc_mask_repair(). Returns how
 *  many. */
inline std::size_t repair_mask(view<const std::size_t> shape, view<std::uint8_t> cells, const env &e = {})
{
    std::size_t n = 0;
    expect(cells, domain::product(shape));
    call(e, [&](auto... rest) {
        return icc_mask_repair(static_cast<std::int32_t>(shape.size()), shape.data(), cells.data(), &n,
                               rest...);
    });
    return n;
}

/** Coordinates of points in a chart: icc_chart_encode(). */
struct coordinates {
    std::vector<std::uint32_t> facet; /**< facet where the curve of each point starts */
    std::vector<double> bary;         /**< `dim` barycentric coordinates on that facet */
    std::vector<double> t;            /**< share of the curve's length */
    std::vector<icc_status> status;   /**< ::ICC_OK for points that have coordinates; not read by decode() */
};

/** Coordinates of the inside of a domain. */
class chart : public handle<icc_chart, icc_chart_free> {
public:
    using handle::handle;

    /** Makes a chart of a domain: icc_chart_create(). */
    explicit chart(const domain &of, const icc_chart_options &options = sized<icc_chart_options>(),
                   const env &e = {})
        : handle(e, [&](auto out, auto... rest) {
              return icc_chart_create(out, of.get(), &options, rest...);
          }) {}

    /** Makes a chart from a function of icc/stages.h: icc_chart_create_function(). You may free the function. */
    static chart from_function(const icc_function *function, const env &e = {})
    {
        return chart(e, [&](auto out, auto... rest) { return icc_chart_create_function(out, function, rest...); });
    }

    /** Reads back the bytes of save(). */
    explicit chart(view<const std::byte> saved, const env &e = {})
        : handle(e, [&](auto out, auto... rest) {
              return icc_chart_load(out, saved.size(), saved.data(), rest...);
          }) {}

    /** Reads back the bytes of save(). */
    static chart load(view<const std::byte> saved, const env &e = {}) { return chart(saved, e); }

    std::vector<std::byte> save() const { return bytes(icc_chart_save); } /**< with the domain */
    icc_chart_info info() const { return tell(icc_chart_get_info); }      /**< certificate, maximum, .. */
    icc_chart_timings timings() const { return tell(icc_chart_get_timings); } /**< seconds for each step */
    bool certified() const { return info().certified == 1; }              /**< if not, info() says why */
    /** What only charts of method gradient have; empty for other charts. */
    std::optional<icc_gradient_info> gradient_info() const { return own(icc_chart_get_gradient_info); }
    /** Likewise for method field. */
    std::optional<icc_field_info> field_info() const { return own(icc_chart_get_field_info); }
    /** Likewise for method foliation in the plane, on a mesh that libicc makes. */
    std::optional<icc_foliation_info> foliation_info() const { return own(icc_chart_get_foliation_info); }
    /** Likewise for method foliation on a domain's own mesh. */
    std::optional<icc_shelling_info> shelling_info() const { return own(icc_chart_get_shelling_info); }
    /** Likewise for method disc. */
    std::optional<icc_disc_info> disc_info() const { return own(icc_chart_get_disc_info); }
    /** The domain, for the C interface; borrowed. */
    const icc_domain *get_domain() const noexcept { return icc_chart_domain(get()); }

    /** Estimates what the coordinates miss from `n_points` points; 0: 4096. */
    icc_chart_report report(std::size_t n_points = 0, const env &e = {}) const
    {
        auto result = sized<icc_chart_report>();
        call(e, [&](auto... rest) { return icc_chart_get_report(get(), n_points, &result, rest...); });
        return result;
    }

    /** Computes the coordinates of points. */
    coordinates encode(view<const double> points, const env &e = {}) const
    {
        const std::size_t n = count(points, info().dim);
        coordinates c{std::vector<std::uint32_t>(n), std::vector<double>(points.size()),
                      std::vector<double>(n), std::vector<icc_status>(n)};
        call(e, [&](auto c_env, auto) {
            return icc_chart_encode(get(), n, points.data(), c.facet.data(), c.bary.data(), c.t.data(),
                                    c.status.data(), nullptr, c_env);
        });
        return c;
    }

    /** The inverse, into your memory. Statuses may be left out. Returns how many coordinates have no point. */
    std::size_t decode(const coordinates &c, view<double> points, view<icc_status> statuses = {},
                       const env &e = {}) const
    {
        const std::size_t n = c.facet.size(), width = static_cast<std::size_t>(info().dim);
        std::size_t n_failed = 0;
        expect(view<const double>(c.t), n);
        expect(view<const double>(c.bary), n * width);
        expect(points, n * width);
        if (statuses.size() != 0)
            expect(statuses, n);
        call(e, [&](auto c_env, auto) {
            return icc_chart_decode(get(), n, c.facet.data(), c.bary.data(), c.t.data(), points.data(),
                                    statuses.data(), &n_failed, c_env);
        });
        return n_failed;
    }

    /** The inverse as a vector; NaN where there is no point. */
    std::vector<double> decode(const coordinates &c, const env &e = {}) const
    {
        std::vector<double> points(c.bary.size());
        decode(c, points, {}, e);
        return points;
    }

    /** Computes coordinates like encode(), and sums of `ICC_LOSS_*` into `flags`, one per point. */
    coordinates encode_flags(view<const double> points, view<std::int32_t> flags, const env &e = {}) const
    {
        const std::size_t n = count(points, info().dim);
        expect(flags, n);
        coordinates c{std::vector<std::uint32_t>(n), std::vector<double>(points.size()),
                      std::vector<double>(n), std::vector<icc_status>(n)};
        call(e, [&](auto c_env, auto) {
            return icc_chart_encode_flags(get(), n, points.data(), c.facet.data(), c.bary.data(),
                                          c.t.data(), c.status.data(), flags.data(), nullptr, c_env);
        });
        return c;
    }

    /** Computes points like decode(), and sums of `ICC_LOSS_*` into `flags`, one per point. */
    std::vector<double> decode_flags(const coordinates &c, view<std::int32_t> flags, const env &e = {}) const
    {
        const std::size_t n = c.facet.size();
        std::vector<double> points(n * static_cast<std::size_t>(info().dim));
        expect(view<const double>(c.t), n);
        expect(view<const double>(c.bary), points.size());
        expect(flags, n);
        call(e, [&](auto c_env, auto) {
            return icc_chart_decode_flags(get(), n, c.facet.data(), c.bary.data(), c.t.data(),
                                          points.data(), nullptr, flags.data(), nullptr, c_env);
        });
        return points;
    }

    /** The whole curve through a point: `dim` numbers for each of its points. */
    std::vector<double> trace(view<const double> point, const env &e = {}) const
    {
        const auto width = static_cast<std::size_t>(info().dim);
        std::vector<double> curve;
        std::size_t n = 0;
        expect(point, width);
        do {
            curve.resize(n * width);
            call(e, [&](auto... rest) {
                return icc_chart_trace(get(), point.data(), curve.size() / width, curve.data(), &n, rest...);
            });
        } while (n * width > curve.size());
        return curve;
    }

private:
    /** Returns what `read` fills in; empty if the method does not have it. */
    template <class Info> std::optional<Info> own(icc_status (*read)(const icc_chart *, Info *)) const
    {
        auto info = sized<Info>();
        const icc_status status = read(get(), &info);
        if (status == ICC_ERR_UNSUPPORTED)
            return std::nullopt;
        call({}, [&](auto...) { return status; });
        return info;
    }
};

/** A tie of a map between domains with features: map::ties(). */
struct tie {
    std::array<std::uint32_t, 2> vertices{}; /**< its first and last vertex */
    std::vector<double> source;              /**< its bends in the source, 2 coordinates each */
    std::vector<double> target;              /**< its bends in the target, 2 coordinates each */

    /** The same tie for icc_map_options::ties. It points into this object. */
    icc_tie raw() const noexcept
    {
        icc_tie t = sized<icc_tie>();
        t.vertex[0] = vertices[0];
        t.vertex[1] = vertices[1];
        t.n_source = source.size() / 2;
        t.source = source.data();
        t.n_target = target.size() / 2;
        t.target = target.data();
        return t;
    }
};

/** The mesh of a mesh map: icc_map_get_mesh(). */
struct map_mesh {
    std::vector<double> vertices;         /**< `dim` coordinates each */
    std::vector<double> images;           /**< of the vertices, `dim` coordinates each */
    std::vector<std::uint32_t> simplices; /**< `dim` + 1 vertices each */
};

/** The image of a caller-supplied mesh. */
struct carried_mesh {
    std::vector<double> images;  /**< of its vertices */
    icc_certificate certificate; /**< whether it is still a mesh */
};

/** A picture in memory without gaps between its rows. `Sample` is `std::uint8_t`, `std::uint16_t`, `float` or
 *  `double`. With `alpha` the last channel is opacity. Set the interpolation and missing samples of a source
 *  in the result. */
template <class Sample>
icc_picture picture(view<Sample> samples, std::int32_t width, std::int32_t height, std::int32_t channels,
                    bool alpha = false)
{
    using value = std::remove_const_t<Sample>;
    static_assert(std::is_same_v<value, std::uint8_t> || std::is_same_v<value, std::uint16_t> ||
                  std::is_same_v<value, float> || std::is_same_v<value, double>);
    auto result = sized<icc_picture>();
    result.width = width;
    result.height = height;
    result.channels = channels;
    result.bytes = sizeof(Sample);
    result.alpha = alpha;
    result.stride = static_cast<std::size_t>(width) * static_cast<std::size_t>(channels) * sizeof(Sample);
    result.pixels = const_cast<value *>(samples.data()); // only read in a source
    expect(samples, result.stride / sizeof(Sample) * static_cast<std::size_t>(height));
    return result;
}

/** A sampled field with room for `values`, which are `float` or `double`. `step` has one vector of as many numbers as
 *  `shape` for each axis. Set `outside` in the result. */
template <class Value>
icc_field field(view<Value> values, view<const std::size_t> shape, view<const double> origin,
                view<const double> step, bool displacement)
{
    using value = std::remove_const_t<Value>;
    static_assert(std::is_same_v<value, float> || std::is_same_v<value, double>);
    const std::size_t dim = shape.size(), most = sizeof icc_field::shape / sizeof *icc_field::shape;
    auto result = sized<icc_field>();
    expect(origin, dim);
    expect(step, dim * dim);
    expect(values, dim * domain::product(shape));
    result.dim = static_cast<std::int32_t>(dim); // icc_field_certify() refuses all but 2 and 3
    result.bytes = sizeof(Value);
    result.displacement = displacement;
    for (std::size_t k = 0; k < dim && dim <= most; ++k) {
        result.shape[k] = shape.data()[k];
        result.origin[k] = origin.data()[k];
    }
    for (std::size_t k = 0; k < dim * dim && dim <= most; ++k)
        result.step[k] = step.data()[k];
    result.values = const_cast<value *>(values.data()); // only read by certify()
    return result;
}

/** Proves that a sampled field does not fold: icc_field_certify(). Lists up to `most` cells that are not proven. */
inline icc_field_report certify(const icc_field &field, std::vector<std::uint32_t> *cells = nullptr,
                                std::vector<std::int32_t> *kinds = nullptr, std::size_t most = 0,
                                const env &e = {})
{
    std::vector<std::uint32_t> listed(most);
    std::vector<std::int32_t> what(most);
    auto report = sized<icc_field_report>();
    call(e, [&](auto... rest) {
        return icc_field_certify(&field, most, listed.data(), what.data(), &report, rest...);
    });
    const std::size_t all = report.n_folded + report.n_undecided + report.n_missing;
    listed.resize(all < most ? all : most);
    what.resize(listed.size());
    if (cells != nullptr)
        *cells = std::move(listed);
    if (kinds != nullptr)
        *kinds = std::move(what);
    return report;
}

/** Two layers of the same regions, with common vertices. */
class coverage : public handle<icc_coverage, icc_coverage_free> {
public:
    using handle::handle;

    /** Pairs two layers: icc_coverage_create(). */
    coverage(const icc_layer &source, const icc_layer &target,
             const icc_coverage_options &options = sized<icc_coverage_options>(), const env &e = {})
        : handle(e, [&](auto out, auto... rest) {
              return icc_coverage_create(out, &source, &target, &options, rest...);
          }) {}

    icc_coverage_info info() const { return tell(icc_coverage_get_info); } /**< nodes, borders, what was done */
    /** The source with common vertices, for the C interface; borrowed. */
    const icc_domain *get_source() const noexcept { return icc_coverage_source(get()); }
    /** The target, likewise. */
    const icc_domain *get_target() const noexcept { return icc_coverage_target(get()); }
    /** The number of each feature's region. */
    std::vector<std::int64_t> ids() const
    {
        std::vector<std::int64_t> result(info().n_features);
        call({}, [&](auto...) { return icc_coverage_get_ids(get(), result.data()); });
        return result;
    }
    /** The rings of the source and of the target; they belong to the coverage. */
    std::pair<view<const icc_feature>, view<const icc_feature>> features() const
    {
        const icc_feature *source = nullptr, *target = nullptr;
        call({}, [&](auto...) { return icc_coverage_get_features(get(), &source, &target); });
        return {{source, info().n_features}, {target, info().n_features}};
    }
    /** What only one layer has. */
    std::vector<icc_coverage_difference> differences() const
    {
        std::vector<icc_coverage_difference> result(info().n_differences, sized<icc_coverage_difference>());
        for (std::size_t k = 0; k < result.size(); ++k)
            call({}, [&](auto...) { return icc_coverage_get_difference(get(), k, &result[k]); });
        return result;
    }
};

/** Two domains that do not correspond, and the pairs of points that belong together. */
class match : public handle<icc_match, icc_match_free> {
public:
    using handle::handle;

    /** Matches two domains: icc_match_create(). A landmark is a point of the source, then one of the target. */
    match(const domain &source, const domain &target, view<const double> landmarks = {},
          const icc_match_options &options = sized<icc_match_options>(), const env &e = {})
        : handle(e, [&](auto out, auto... rest) {
              return icc_match_create(out, source.get(), target.get(),
                                      count(landmarks, 2 * source.info().dim), landmarks.data(), &options,
                                      rest...);
          }) {}

    /** Reads back the bytes of save(). */
    explicit match(view<const std::byte> saved, const env &e = {})
        : handle(e, [&](auto out, auto... rest) {
              return icc_match_load(out, saved.size(), saved.data(), rest...);
          }) {}

    /** Reads back the bytes of save(). */
    static match load(view<const std::byte> saved, const env &e = {}) { return match(saved, e); }

    std::vector<std::byte> save() const { return bytes(icc_match_save); } /**< with both domains */

    icc_match_info info() const { return tell(icc_match_get_info); } /**< cost, turn, common vertices, .. */
    /** The source with common vertices, for the C interface; borrowed. */
    const icc_domain *get_source() const noexcept { return icc_match_source(get()); }
    /** The target, likewise. */
    const icc_domain *get_target() const noexcept { return icc_match_target(get()); }
    /** For each common vertex its number in the given domains; UINT32_MAX: it was added. */
    std::pair<std::vector<std::uint32_t>, std::vector<std::uint32_t>> origins() const
    {
        const std::size_t n = info().n_vertices;
        std::pair<std::vector<std::uint32_t>, std::vector<std::uint32_t>> result{
            std::vector<std::uint32_t>(n), std::vector<std::uint32_t>(n)};
        call({}, [&](auto...) {
            return icc_match_get_origins(get(), result.first.data(), result.second.data());
        });
        return result;
    }

    /** Takes points of the source's boundary to the target's: icc_match_apply(). `off`, if it is not empty, gets
     *  their distances from the common boundary. */
    std::vector<double> apply(view<const double> points, view<double> off = {}, const env &e = {}) const
    {
        return follow(icc_match_apply, points, off, e);
    }

    /** Target to source; otherwise like apply(). */
    std::vector<double> apply_inverse(view<const double> points, view<double> off = {}, const env &e = {}) const
    {
        return follow(icc_match_apply_inverse, points, off, e);
    }

private:
    template <class Function>
    std::vector<double> follow(Function function, view<const double> points, view<double> off, const env &e) const
    {
        const std::size_t n = count(points, info().dim);
        std::vector<double> images(points.size());
        if (off.size() > 0)
            expect(off, n);
        call(e, [&](const icc_env *c_env, auto...) {
            return function(get(), n, points.data(), images.data(), off.data(), c_env);
        });
        return images;
    }
};

/** A map from one domain to another that agrees with the boundaries. */
class map : public handle<icc_map, icc_map_free> {
public:
    using handle::handle;

    /** Makes a map between two domains: icc_map_create(). */
    map(const domain &source, const domain &target,
        const icc_map_options &options = sized<icc_map_options>(), const env &e = {})
        : handle(e, [&](auto out, auto... rest) {
              return icc_map_create(out, source.get(), target.get(), &options, rest...);
          }) {}

    /** Makes a map from two charts: icc_map_create_from_charts(). */
    map(const chart &source, const chart &target,
        const icc_map_options &options = sized<icc_map_options>(), const env &e = {})
        : handle(e, [&](auto out, auto... rest) {
              return icc_map_create_from_charts(out, source.get(), target.get(), &options, rest...);
          }) {}

    /** Reads back the bytes of save(). */
    explicit map(view<const std::byte> saved, const env &e = {})
        : handle(e, [&](auto out, auto... rest) {
              return icc_map_load(out, saved.size(), saved.data(), rest...);
          }) {}

    /** Reads back the bytes of save(). */
    static map load(view<const std::byte> saved, const env &e = {}) { return map(saved, e); }

    /** Makes the one-to-one map that is nearest to a warp of a mesh in the plane: icc_map_create_nearest().
     *  `images` has 2 coordinates for each vertex, and the images of the vertices `held` do not change. The
     *  report may be NULL, else its `size` is set. */
    static map nearest(view<const double> vertices, view<const std::uint32_t> triangles,
                       view<const double> images, view<const std::uint32_t> held = {},
                       icc_nearest_report *report = nullptr, const env &e = {})
    {
        expect(images, 2 * count(vertices, 2));
        return map(e, [&](auto out, auto... rest) {
            const icc_mesh mesh = mesh_of(2, vertices, triangles);
            auto options = sized<icc_nearest_options>();
            options.n_held = held.size();
            options.held = held.data();
            return icc_map_create_nearest(out, &mesh, images.data(), &options, report, rest...);
        });
    }

    std::vector<std::byte> save() const { return bytes(icc_map_save); } /**< with domains and charts */
    icc_map_info info() const { return tell(icc_map_get_info); }        /**< certificate, energy, .. */
    icc_map_report report() const { return tell(icc_map_get_report); }  /**< how it was made */
    bool certified() const { return info().certified == 1; }            /**< if not, info() says why */

    /** The ties, which tell on which side features pass one another: icc_map_get_tie(). None without features. */
    std::vector<tie> ties() const
    {
        std::vector<tie> result(info().n_ties);
        for (std::size_t k = 0; k < result.size(); ++k) {
            auto about = sized<icc_tie_info>();
            tie &t = result[k];
            call({}, [&](auto...) { return icc_map_get_tie(get(), k, &about, nullptr, nullptr); });
            t.source.resize(2 * about.n_source);
            t.target.resize(2 * about.n_target);
            call({}, [&](auto...) {
                return icc_map_get_tie(get(), k, &about, t.source.data(), t.target.data());
            });
            t.vertices = {about.vertex[0], about.vertex[1]};
        }
        return result;
    }

    /** The source's chart, for the C interface; borrowed. NULL after retarget(). */
    const icc_chart *get_source_chart() const noexcept { return icc_map_source_chart(get()); }
    const icc_chart *get_target_chart() const noexcept { return icc_map_target_chart(get()); } /**< the target's chart, likewise */

    /** Makes a map of lower distortion from a mesh map: icc_map_improve(). The report may be NULL, else its
     *  `size` is set. */
    map improve(const icc_improve_options &options = sized<icc_improve_options>(),
                icc_improve_report *report = nullptr, const env &e = {}) const
    {
        return map(e, [&](auto out, auto... rest) {
            return icc_map_improve(out, get(), &options, report, rest...);
        });
    }

    /** Makes the map to a target that has moved: icc_map_retarget(). */
    map retarget(const domain &target, const icc_retarget_options &options = sized<icc_retarget_options>(),
                 const env &e = {}) const
    {
        return map(e, [&](auto out, auto... rest) {
            return icc_map_retarget(out, get(), target.get(), &options, rest...);
        });
    }

    /** Copies the mesh of a mesh map. */
    map_mesh mesh() const
    {
        auto own = sized<icc_mesh>();
        call({}, [&](auto...) { return icc_map_get_mesh(get(), &own, nullptr); });
        const auto width = static_cast<std::size_t>(own.dim);
        map_mesh m{std::vector<double>(own.n_vertices * width), std::vector<double>(own.n_vertices * width),
                   std::vector<std::uint32_t>(own.n_cells * (width + 1))};
        own.vertices = m.vertices.data();
        own.cells = m.simplices.data();
        call({}, [&](auto...) { return icc_map_get_mesh(get(), &own, m.images.data()); });
        return m;
    }

    /** The region of each simplex of mesh(): icc_map_get_regions(). */
    std::vector<std::uint32_t> mesh_regions() const
    {
        std::vector<std::uint32_t> result(info().n_simplices);
        call({}, [&](auto, icc_error *err) { return icc_map_get_regions(get(), result.data(), err); });
        return result;
    }

    /** Maps a mesh and checks its image: icc_map_certify(). */
    carried_mesh certify(view<const double> vertices, view<const std::uint32_t> simplices,
                         const env &e = {}) const
    {
        return carry_mesh(icc_map_certify, vertices, simplices, e);
    }

    /** Maps a mesh so that no simplex inverts: icc_map_repair(). */
    carried_mesh repair(view<const double> vertices, view<const std::uint32_t> simplices,
                        const env &e = {}) const
    {
        return carry_mesh(icc_map_repair, vertices, simplices, e);
    }

    /** Source to target, into your memory, which may be that of the points. Points without an image get NaN
     *  and do not throw. Returns their number. */
    std::size_t apply(view<const double> points, view<double> images, const env &e = {}) const
    {
        return carry(icc_map_apply, points, images, {}, e);
    }

    /** Likewise, with a status for each point. */
    std::size_t apply(view<const double> points, view<double> images, view<icc_status> statuses,
                      const env &e = {}) const
    {
        return carry(icc_map_apply, points, images, statuses, e);
    }

    /** Likewise, as a vector. */
    std::vector<double> apply(view<const double> points, const env &e = {}) const
    {
        std::vector<double> images(points.size());
        apply(points, images, e);
        return images;
    }

    /** Likewise, for points of your own type. */
    template <class Point, class Memory, class = std::enable_if_t<row_length<Point, double> != 0>>
    std::vector<Point, Memory> apply(const std::vector<Point, Memory> &points, const env &e = {}) const
    {
        std::vector<Point, Memory> images(points.size());
        apply(points, images, e);
        return images;
    }

    /** Target to source; otherwise like apply(). */
    std::size_t apply_inverse(view<const double> points, view<double> images, const env &e = {}) const
    {
        return carry(icc_map_apply_inverse, points, images, {}, e);
    }

    /** Likewise, with a status for each point. */
    std::size_t apply_inverse(view<const double> points, view<double> images,
                              view<icc_status> statuses, const env &e = {}) const
    {
        return carry(icc_map_apply_inverse, points, images, statuses, e);
    }

    /** Likewise, as a vector. */
    std::vector<double> apply_inverse(view<const double> points, const env &e = {}) const
    {
        std::vector<double> images(points.size());
        apply_inverse(points, images, e);
        return images;
    }

    /** Likewise, for points of your own type. */
    template <class Point, class Memory, class = std::enable_if_t<row_length<Point, double> != 0>>
    std::vector<Point, Memory> apply_inverse(const std::vector<Point, Memory> &points,
                                             const env &e = {}) const
    {
        std::vector<Point, Memory> images(points.size());
        apply_inverse(points, images, e);
        return images;
    }

    /** The derivative at points of the source, `dim` x `dim` numbers each, row by row: icc_map_jacobian().
     *  Statuses may be left out. Returns the number of points without a derivative. */
    std::size_t jacobian(view<const double> points, view<double> jacobians,
                         view<icc_status> statuses = {}, const env &e = {}) const
    {
        const auto width = static_cast<std::size_t>(info().dim);
        return run(icc_map_jacobian, points, jacobians, points.size() * width, statuses, e);
    }

    /** Likewise, as a vector. */
    std::vector<double> jacobian(view<const double> points, const env &e = {}) const
    {
        std::vector<double> jacobians(points.size() * static_cast<std::size_t>(info().dim));
        jacobian(points, jacobians, {}, e);
        return jacobians;
    }

    /** Warps a picture: icc_map_warp(). Returns the number of pixels without an image. */
    std::size_t warp(const icc_picture &source, const icc_picture &target, const env &e = {}) const
    {
        std::size_t n_failed = 0;
        call(e, [&](auto... rest) { return icc_map_warp(get(), &source, &target, &n_failed, rest...); });
        return n_failed;
    }

    /** Samples the map, or its inverse, on the grid of a field: icc_map_sample(). Returns the number of samples without
     *  an image. */
    std::size_t sample(const icc_field &field, bool inverse = false, const env &e = {}) const
    {
        std::size_t n_outside = 0;
        call(e, [&](auto... rest) { return icc_map_sample(get(), inverse, &field, &n_outside, rest...); });
        return n_outside;
    }

protected:
    /** Holds the map of another object, and keeps that alive. */
    map(const icc_map *borrowed, std::shared_ptr<const void> owner) : handle(borrowed, std::move(owner)) {}

private:
    template <class F>
    std::size_t run(F f, view<const double> points, view<double> results, std::size_t n_results,
                    view<icc_status> statuses, const env &e) const
    {
        const std::size_t n = count(points, info().dim);
        std::size_t n_failed = 0;
        expect(results, n_results);
        if (statuses.size() != 0)
            expect(statuses, n);
        call(e, [&](auto c_env, auto) {
            return f(get(), n, points.data(), results.data(), statuses.data(), &n_failed, c_env);
        });
        return n_failed;
    }

    template <class F>
    std::size_t carry(F f, view<const double> points, view<double> images, view<icc_status> statuses,
                      const env &e) const
    {
        (void)count(images, info().dim);
        return run(f, points, images, points.size(), statuses, e);
    }

    template <class F>
    carried_mesh carry_mesh(F f, view<const double> vertices, view<const std::uint32_t> simplices,
                            const env &e) const
    {
        const icc_mesh mesh = mesh_of(info().dim, vertices, simplices);
        carried_mesh result{std::vector<double>(vertices.size()), sized<icc_certificate>()};
        call(e, [&](auto... rest) {
            return f(get(), &mesh, result.images.data(), &result.certificate, rest...);
        });
        return result;
    }
};

/** A part of what you know about a map of the plane: where some points, a line or some vertices go.
 *  `icc::constraint::points({..}, {..})` and its siblings borrow the numbers. */
class constraint {
public:
    /** Points and their targets, 2 coordinates each. With the spline they may have tolerances, one each. */
    static constraint points(view<const double> source, view<const double> target,
                             view<const double> tolerance = {})
    {
        constraint c(ICC_CONSTRAINT_POINTS, count(source, 2), target);
        if (tolerance.size() != 0)
            expect(tolerance, c.of_c_.n);
        c.of_c_.source = source.data();
        c.of_c_.tolerance = tolerance.data();
        return c;
    }
    /** A polyline and its target, vertex by vertex. */
    static constraint line(view<const double> source, view<const double> target)
    {
        constraint c(ICC_CONSTRAINT_LINE, count(source, 2), target);
        c.of_c_.source = source.data();
        return c;
    }
    /** Vertices of the domain or the mesh, and their targets. */
    static constraint vertices(view<const std::uint32_t> numbers, view<const double> target)
    {
        constraint c(ICC_CONSTRAINT_VERTICES, numbers.size(), target);
        c.of_c_.vertices = numbers.data();
        return c;
    }
    /** Vertices that slide along straight lines. On the boundary the directions may be left out. */
    static constraint sliding(view<const std::uint32_t> numbers, view<const double> direction = {})
    {
        constraint c(ICC_CONSTRAINT_SLIDING, numbers.size(), {});
        if (direction.size() != 0)
            expect(direction, 2 * numbers.size());
        c.of_c_.vertices = numbers.data();
        c.of_c_.direction = direction.data();
        return c;
    }

    const icc_constraint &get() const noexcept { return of_c_; } /**< for the C interface */

private:
    constraint(std::int32_t kind, std::size_t n, view<const double> target)
    {
        if (kind != ICC_CONSTRAINT_SLIDING)
            expect(target, 2 * n);
        of_c_.kind = kind;
        of_c_.n = n;
        of_c_.target = target.data();
    }

    icc_constraint of_c_ = sized<icc_constraint>();
};

/** A map of the plane that is made from what is known of it, such as a few control points: icc_fit_create().
 *
 *      const icc::fit fit({0, 0, 4, 0, 4, 3, 0, 3}, {1, 1, 5, 2, 6, 5, 1, 4});
 *      const std::vector<double> images = fit.apply({1, 1});
 */
class fit : public map {
public:
    /** Control points and their targets, 2 coordinates each. The map covers a box around the points. */
    fit(view<const double> points, view<const double> targets,
        const icc_fit_options &options = sized<icc_fit_options>(), const env &e = {})
        : fit(std::vector<constraint>{constraint::points(points, targets)}, options, e) {}

    /** Everything that is known. The map covers a box around the points. */
    explicit fit(const std::vector<constraint> &constraints,
                 const icc_fit_options &options = sized<icc_fit_options>(), const env &e = {})
        : fit(create(nullptr, nullptr, constraints, options, e)) {}

    /** The map covers a domain, whose outline is free where constraints do not tell it. */
    fit(const domain &domain, const std::vector<constraint> &constraints,
        const icc_fit_options &options = sized<icc_fit_options>(), const env &e = {})
        : fit(create(domain.get(), nullptr, constraints, options, e)) {}

    /** The map of a mesh of triangles, which is kept as it is. */
    static fit on_mesh(view<const double> vertices, view<const std::uint32_t> triangles,
                       const std::vector<constraint> &constraints,
                       const icc_fit_options &options = sized<icc_fit_options>(), const env &e = {})
    {
        const icc_mesh mesh = mesh_of(2, vertices, triangles);
        return fit(create(nullptr, &mesh, constraints, options, e));
    }

    /** Makes the fit to targets that have moved: icc_fit_move(). `targets` has 2 coordinates for each item,
     *  constraint after constraint. */
    fit move(view<const double> targets, const env &e = {}) const
    {
        expect(targets, 2 * fit_info().n_items);
        return fit(std::make_shared<const made>(e, [&](auto out, auto... rest) {
            return icc_fit_move(out, fit_->get(), targets.data(), rest...);
        }));
    }

    /** How well it fits: icc_fit_get_info(). */
    icc_fit_info fit_info() const
    {
        auto info = sized<icc_fit_info>();
        call({}, [&](auto...) { return icc_fit_get_info(fit_->get(), &info); });
        return info;
    }

    /** The image of each item minus its target, 2 numbers each: icc_fit_get_residuals(). */
    std::vector<double> residuals() const
    {
        std::vector<double> result(2 * fit_info().n_items);
        call({}, [&](auto...) { return icc_fit_get_residuals(fit_->get(), result.data(), nullptr); });
        return result;
    }

    /** Where the other points alone would take each point, minus its target; NaN where that is not known. */
    std::vector<double> left_out() const
    {
        std::vector<double> result(2 * fit_info().n_items);
        call({}, [&](auto...) { return icc_fit_get_residuals(fit_->get(), nullptr, result.data()); });
        return result;
    }

    const icc_fit *get_fit() const noexcept { return fit_->get(); } /**< pointer for the C interface; borrowed */

private:
    using made = handle<icc_fit, icc_fit_free>;

    explicit fit(std::shared_ptr<const made> whole)
        : map(icc_fit_map(whole->get()), whole), fit_(std::move(whole)) {}

    static std::shared_ptr<const made> create(const icc_domain *domain, const icc_mesh *mesh,
                                              const std::vector<constraint> &constraints,
                                              const icc_fit_options &options, const env &e)
    {
        std::vector<icc_constraint> all;
        all.reserve(constraints.size());
        for (const constraint &c : constraints)
            all.push_back(c.get());
        return std::make_shared<const made>(e, [&](auto out, auto... rest) {
            return icc_fit_create(out, domain, mesh, all.size(), all.data(), &options, rest...);
        });
    }

    std::shared_ptr<const made> fit_;
};

} // namespace icc
#endif
