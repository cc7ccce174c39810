/**
 * @file icc/icc.hpp
 * @brief C++17: domains, charts and maps that free themselves, errors as exceptions; header only.
 *
 *     const auto before = icc::domain::polygon({0, 0, 4, 0, 4, 3, 0, 3});
 *     const auto after = icc::domain::polygon({0, 0, 4, 1, 4, 4, 0, 3});
 *     const std::vector<double> images = icc::map(before, after).apply({1, 1, 2, 1.5});
 *
 * A thin layer over icc/icc.h, where the contracts are. Whatever else the C interface has is one icc::call()
 * or icc::handle away. All of it is inline, so a program depends on the library no more than one in C does.
 *
 * SPDX-License-Identifier: MIT
 */
#ifndef ICC_ICC_HPP
#define ICC_ICC_HPP
#if __cplusplus < 201703L
#error "icc/icc.hpp needs C++17; icc/icc.h does not"
#endif

#include <icc/icc.h>

#include <cstddef>
#include <cstdint>
#include <exception>
#include <functional>
#include <memory>
#include <type_traits>
#include <utility>
#include <vector>

/** libicc for C++. */
namespace icc {

/** Elements in a row that belong to someone else: a vector, an array, a `std::span`, or a list in braces. */
template <class T> class view {
public:
    constexpr view() noexcept = default; /**< none */
    /** `size` elements from `data` on. */
    constexpr view(T *data, std::size_t size) noexcept
        : data_(size != 0 ? data : nullptr), size_(size) {}
    /** All of what `std::data` and `std::size` understand. */
    template <class C, class = std::enable_if_t<std::is_convertible_v<
                           decltype(std::data(std::declval<C &>())), T *>>>
    constexpr view(C &&all) noexcept : view(std::data(all), std::size(all)) {}
    /** A list in braces, which lasts as long as the call. */
    constexpr view(std::initializer_list<std::remove_const_t<T>> list) noexcept
        : view(std::data(list), list.size()) {}
    constexpr T *data() const noexcept { return data_; }          /**< NULL if there are none */
    constexpr std::size_t size() const noexcept { return size_; } /**< how many */

private:
    T *data_ = nullptr;
    std::size_t size_ = 0;
};

/** The coordinates of points of a type of yours that holds doubles and nothing else, such as
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
    explicit error(const icc_error &e) noexcept : icc_error(e) {} /**< as the C interface tells it */
    /** One line of English. */
    const char *what() const noexcept override { return *message ? message : icc_status_name(status); }
};

/** How a call runs. */
struct env {
    std::int32_t threads = 1; /**< that it may use; results are the same */
    /** Called now and then on the calling thread with the name of the stage and the share of the whole
     *  call that is done, which never falls. True cancels: icc::error with ::ICC_ERR_CANCELLED. What it
     *  throws cancels, too, and comes out of the call. */
    std::function<bool(const char *stage, double share)> progress = {};
    /** Bytes for objects that are read back, as icc_env::load_limit; 0: the default. */
    std::uint64_t load_limit = 0;
};

/** A struct of the C interface with its `size` set; all else is 0, which means the default. */
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
    icc_error err{sizeof err, ICC_OK, 0, -1, ""};
    err.status = f(static_cast<const icc_env *>(&c_env), &err);
    if (now.thrown)
        std::rethrow_exception(now.thrown);
    if (err.status != ICC_OK)
        throw error(err);
}

/** How many points, facets or simplices of `each` numbers a list has. */
template <class T> std::size_t count(view<T> list, std::int64_t each)
{
    const auto n = static_cast<std::size_t>(each > 0 ? each : 1);
    if (list.size() % n != 0)
        throw error({sizeof(icc_error), ICC_ERR_ARGUMENT, 0, -1, "a list ends amid a point or simplex"});
    return list.size() / n;
}

/** An object of the C interface that frees itself: `icc::handle<icc_grid, icc_grid_free>`. Calls refuse an
 *  empty one, which moving leaves behind. */
template <class T, void (*Free)(T *)> class handle {
public:
    /** What f(T **out, const icc_env *, icc_error *) makes. Throws as icc::call() does. */
    template <class F> handle(const env &e, F &&f)
    {
        call(e, [&](const icc_env *c_env, icc_error *err) {
            T *out = nullptr;
            const icc_status status = f(&out, c_env, err);
            owned_.reset(out);
            return status;
        });
    }

    const T *get() const noexcept { return owned_.get(); } /**< for calls of the C interface; borrowed */

protected:
    /** What `read` tells. */
    template <class Info> Info tell(icc_status (*read)(const T *, Info *)) const
    {
        auto info = sized<Info>();
        call({}, [&](auto...) { return read(get(), &info); });
        return info;
    }

    /** The bytes that `write` makes. */
    auto bytes(icc_status (*write)(const T *, std::size_t, void *, std::size_t *)) const
    {
        std::size_t n = 0;
        call({}, [&](auto...) { return write(get(), 0, nullptr, &n); });
        std::vector<std::byte> data(n);
        call({}, [&](auto...) { return write(get(), n, data.data(), &n); });
        return data;
    }

private:
    std::unique_ptr<T, std::integral_constant<void (*)(T *), Free>> owned_;
};

/** A shape: its boundary, and what lies inside. */
class domain : public handle<icc_domain, icc_domain_free> {
public:
    using handle::handle;

    /** Of a closed boundary, `dim` vertices a facet: icc_domain_create(). */
    domain(std::int32_t dim, view<const double> vertices, view<const std::uint32_t> facets,
           const env &e = {})
        : handle(e, [&](auto out, auto... rest) {
              return icc_domain_create(out, dim, count(vertices, dim), vertices.data(),
                                       count(facets, dim), facets.data(), rest...);
          }) {}

    /** Of a simple polygon. */
    static domain polygon(view<const double> vertices, const env &e = {})
    {
        return domain(2, vertices, {}, e);
    }

    /** Of a mesh of its inside, `dim` + 1 vertices a simplex: icc_domain_create_mesh(). */
    static domain from_mesh(std::int32_t dim, view<const double> vertices,
                            view<const std::uint32_t> simplices,
                            view<const std::uint32_t> facets = {}, const env &e = {})
    {
        return domain(e, [&](auto out, auto... rest) {
            return icc_domain_create_mesh(out, dim, count(vertices, dim), vertices.data(),
                                          count(simplices, std::int64_t{dim} + 1), simplices.data(),
                                          count(facets, dim), facets.data(), rest...);
        });
    }

    icc_domain_info info() const { return tell(icc_domain_get_info); } /**< dimension, counts, .. */
};

/** Coordinates of the inside of a domain. */
class chart : public handle<icc_chart, icc_chart_free> {
public:
    using handle::handle;

    /** Of a domain: icc_chart_create(). */
    explicit chart(const domain &of, const icc_chart_options &options = sized<icc_chart_options>(),
                   const env &e = {})
        : handle(e, [&](auto out, auto... rest) {
              return icc_chart_create(out, of.get(), &options, rest...);
          }) {}

    /** Of what save() has made. */
    explicit chart(view<const std::byte> saved, const env &e = {})
        : handle(e, [&](auto out, auto... rest) {
              return icc_chart_load(out, saved.size(), saved.data(), rest...);
          }) {}

    std::vector<std::byte> save() const { return bytes(icc_chart_save); } /**< with the domain */
    icc_chart_info info() const { return tell(icc_chart_get_info); }      /**< certificate, counts, .. */
};

/** A map from one domain to another that agrees with the boundaries. */
class map : public handle<icc_map, icc_map_free> {
public:
    using handle::handle;

    /** From domain to domain: icc_map_create(). */
    map(const domain &source, const domain &target,
        const icc_map_options &options = sized<icc_map_options>(), const env &e = {})
        : handle(e, [&](auto out, auto... rest) {
              return icc_map_create(out, source.get(), target.get(), &options, rest...);
          }) {}

    /** Of what save() has made. */
    explicit map(view<const std::byte> saved, const env &e = {})
        : handle(e, [&](auto out, auto... rest) {
              return icc_map_load(out, saved.size(), saved.data(), rest...);
          }) {}

    std::vector<std::byte> save() const { return bytes(icc_map_save); } /**< with domains and charts */
    icc_map_info info() const { return tell(icc_map_get_info); }        /**< certificate, energy, .. */

    /** Source to target, into memory of the caller's, which may be that of the points. Points that have no
     *  image get NaN; returns how many. */
    std::size_t apply(view<const double> points, view<double> images, const env &e = {}) const
    {
        return carry(icc_map_apply, points, images, e);
    }

    /** The same into a vector. */
    std::vector<double> apply(view<const double> points, const env &e = {}) const
    {
        std::vector<double> images(points.size());
        apply(points, images, e);
        return images;
    }

    /** Target to source, as apply(). */
    std::size_t apply_inverse(view<const double> points, view<double> images, const env &e = {}) const
    {
        return carry(icc_map_apply_inverse, points, images, e);
    }

    /** The same into a vector. */
    std::vector<double> apply_inverse(view<const double> points, const env &e = {}) const
    {
        std::vector<double> images(points.size());
        apply_inverse(points, images, e);
        return images;
    }

    /** Carries a picture along: icc_map_warp(). Returns how many pixels have no image. */
    std::size_t warp(const icc_picture &source, const icc_picture &target, const env &e = {}) const
    {
        std::size_t n_failed = 0;
        call(e, [&](auto... rest) { return icc_map_warp(get(), &source, &target, &n_failed, rest...); });
        return n_failed;
    }

private:
    template <class F>
    std::size_t carry(F f, view<const double> points, view<double> images, const env &e) const
    {
        const std::size_t n = count(points, info().dim);
        if (images.size() != points.size())
            throw error({sizeof(icc_error), ICC_ERR_ARGUMENT, 0, -1, "images are not as many as points"});
        std::size_t n_failed = 0;
        call(e, [&](auto c_env, auto) {
            return f(get(), n, points.data(), images.data(), nullptr, &n_failed, c_env);
        });
        return n_failed;
    }
};

} // namespace icc
#endif
