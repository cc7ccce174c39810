/* Maps in the plane made fairer, beside libigl's SLIM: bench_slim SOURCE.txt TARGET.txt ..., cages
 * of one vertex "x y" on a line. Both begin with the map that icc_map_create() makes without
 * improvement, on its mesh: here icc_map_improve() without refinement, with its copy and its
 * certificate; there slim_precompute() and steps, the boundary a soft constraint. Processor time,
 * the median of runs in turn, of both: to within a hundredth of the energy that ours end with, and
 * to that at which SLIM's steps gain less than 1e-4. Bar: .15.
 *
 * libigl is no package: give CMake the folder of a copy as LIBIGL_INCLUDE_DIR. */
#include "../flat_mesh.h"
#include <icc/icc.h>

#include <igl/boundary_loop.h>
#include <igl/slim.h>

#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <ctime>
#include <fstream>
#include <string>
#include <vector>

static const int RUNS = 9, MOST_STEPS = 60;
static const double TOLERANCE = 1e-4, WEIGHT = 1e6;

static double processor_seconds()
{
    timespec t;
    clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &t);
    return static_cast<double>(t.tv_sec) + 1e-9 * static_cast<double>(t.tv_nsec);
}

static void check(icc_status status)
{
    if (status != ICC_OK) {
        std::fprintf(stderr, "%s\n", icc_status_name(status));
        std::exit(EXIT_FAILURE);
    }
}

static icc_domain *read_domain(const char *path)
{
    std::ifstream file(path);
    std::vector<double> xy;
    for (double x; file >> x;)
        xy.push_back(x);
    icc_domain *domain;
    check(icc_domain_create(&domain, 2, xy.size() / 2, xy.data(), 0, nullptr, nullptr, nullptr));
    return domain;
}

struct mesh {
    Eigen::MatrixXd points, images; /* the former with a third coordinate, as SLIM wants them */
    Eigen::MatrixXi corners;
};

static double area(const Eigen::MatrixXd &p, const Eigen::MatrixXi &corners)
{
    double sum = 0;
    for (Eigen::Index t = 0; t < corners.rows(); ++t) {
        const Eigen::RowVector2d u = (p.row(corners(t, 1)) - p.row(corners(t, 0))).head<2>();
        const Eigen::RowVector2d v = (p.row(corners(t, 2)) - p.row(corners(t, 0))).head<2>();
        sum += (u(0) * v(1) - u(1) * v(0)) / 2;
    }
    return sum;
}

/* Both sides scaled to an area of 1. */
static mesh take_mesh(const icc_map *map)
{
    icc_map_info info = {};
    info.size = sizeof info;
    check(icc_map_get_info(map, &info));
    std::vector<double> points(2 * info.n_vertices), images(points.size());
    std::vector<uint32_t> corners(3 * info.n_simplices);
    check(flat_get_mesh(map, points.data(), images.data(), corners.data()));
    const Eigen::Index n = static_cast<Eigen::Index>(info.n_vertices);
    mesh m;
    m.points = Eigen::MatrixXd::Zero(n, 3);
    m.images.resize(n, 2);
    m.corners.resize(static_cast<Eigen::Index>(info.n_simplices), 3);
    for (Eigen::Index v = 0; v < n; ++v)
        for (Eigen::Index d = 0; d < 2; ++d) {
            m.points(v, d) = points[static_cast<size_t>(2 * v + d)];
            m.images(v, d) = images[static_cast<size_t>(2 * v + d)];
        }
    for (Eigen::Index t = 0; t < m.corners.rows(); ++t)
        for (Eigen::Index k = 0; k < 3; ++k)
            m.corners(t, k) = static_cast<int>(corners[static_cast<size_t>(3 * t + k)]);
    m.points /= std::sqrt(area(m.points, m.corners));
    m.images /= std::sqrt(area(m.images, m.corners));
    return m;
}

/* Mean over the source of |J|^2 + |J^-1|^2; infinite where something is inverted. */
static double energy_of(const mesh &m, const Eigen::MatrixXd &images)
{
    double sum = 0;
    for (Eigen::Index t = 0; t < m.corners.rows(); ++t) {
        Eigen::Matrix2d before, after;
        for (int k = 0; k < 2; ++k) {
            before.col(k) = (m.points.row(m.corners(t, k + 1)) - m.points.row(m.corners(t, 0)))
                                .head<2>()
                                .transpose();
            after.col(k) =
                (images.row(m.corners(t, k + 1)) - images.row(m.corners(t, 0))).transpose();
        }
        const Eigen::Matrix2d j = after * before.inverse();
        if (!(j.determinant() > 0))
            return HUGE_VAL;
        sum += before.determinant() / 2 * (j.squaredNorm() + j.inverse().squaredNorm());
    }
    return sum;
}

struct result {
    double seconds, energy, drift; /* the last: of the boundary, for an area of 1 */
    int steps;
};

/* Until the energy is `goal`, or a step gains next to nothing. */
static result run_slim(const mesh &m, double goal)
{
    std::vector<std::vector<int>> loops;
    igl::boundary_loop(m.corners, loops);
    std::vector<int> rim;
    for (const std::vector<int> &loop : loops)
        rim.insert(rim.end(), loop.begin(), loop.end());
    const Eigen::VectorXi fixed =
        Eigen::Map<const Eigen::VectorXi>(rim.data(), static_cast<Eigen::Index>(rim.size()));
    Eigen::MatrixXd there(fixed.size(), 2);
    for (Eigen::Index k = 0; k < fixed.size(); ++k)
        there.row(k) = m.images.row(fixed(k));
    Eigen::MatrixXd points = m.points, images = m.images;
    Eigen::MatrixXi corners = m.corners;
    Eigen::VectorXi b = fixed;
    Eigen::MatrixXd bc = there;
    igl::SLIMData data;
    result r = {0, energy_of(m, images), 0, 0};
    double begin = processor_seconds();
    igl::slim_precompute(points, corners, images, data, igl::MappingEnergyType::SYMMETRIC_DIRICHLET,
                         b, bc, WEIGHT);
    r.seconds = processor_seconds() - begin;
    for (double gain = HUGE_VAL;
         r.steps < MOST_STEPS && r.energy > goal && gain >= TOLERANCE * r.energy; ++r.steps) {
        begin = processor_seconds();
        igl::slim_solve(data, 1);
        r.seconds += processor_seconds() - begin;
        const Eigen::MatrixXd now = data.V_o.leftCols(2);
        const double energy = energy_of(m, now);
        gain = r.energy - energy;
        r.energy = energy;
        for (Eigen::Index k = 0; k < fixed.size(); ++k)
            r.drift = std::max(r.drift, (now.row(fixed(k)) - there.row(k)).norm());
    }
    return r;
}

/* With at most so many steps; 0: as many as it takes. */
static result run_ours(const icc_map *map, int steps)
{
    icc_improve_options options = {};
    icc_improve_report report = {};
    options.size = sizeof options;
    report.size = sizeof report;
    options.levels = -1;
    options.tolerance = TOLERANCE;
    options.iterations = steps;
    icc_map *better;
    const double begin = processor_seconds();
    check(icc_map_improve(&better, map, &options, &report, nullptr, nullptr));
    const double seconds = processor_seconds() - begin;
    icc_map_free(better);
    return {seconds, report.energy, 0, static_cast<int>(report.n_iterations)};
}

static double median(std::vector<double> x)
{
    std::sort(x.begin(), x.end());
    return x[x.size() / 2];
}

/* How many steps ours take to an energy. */
static int steps_to(const icc_map *map, double goal)
{
    int steps = 1;
    while (steps < MOST_STEPS && run_ours(map, steps).energy > goal)
        ++steps;
    return steps;
}

static void measure(const char *name, const icc_map *map)
{
    const mesh m = take_mesh(map);
    const double goal[2] = {1.01 * run_ours(map, 0).energy, run_slim(m, 0).energy};
    std::printf("%-22.22s %7ld", name, static_cast<long>(m.corners.rows()));
    for (int k = 0; k < 2; ++k) {
        const int steps = steps_to(map, goal[k]);
        std::vector<double> seconds[2];
        result ours = {}, slim = {};
        for (int run = 0; run < RUNS; ++run) {
            ours = run_ours(map, steps);
            slim = run_slim(m, k == 0 ? goal[0] : 0);
            seconds[0].push_back(ours.seconds);
            seconds[1].push_back(slim.seconds);
        }
        const double a = median(seconds[0]), b = median(seconds[1]);
        std::printf(" | %2d %7.4f %8.2f  %2d %7.4f %8.2f %.0e  %.3f", ours.steps, ours.energy,
                    1e3 * a, slim.steps, slim.energy, 1e3 * b, slim.drift, a / b);
    }
    std::printf("\n");
    std::fflush(stdout);
}

int main(int argc, char **argv)
{
    std::printf(
        "steps, energy, ms of ours, of SLIM, by how far its boundary is off, and the ratio: "
        "to our end + 1 %% | to SLIM's end\n");
    for (int k = 1; k + 1 < argc; k += 2) {
        icc_domain *source = read_domain(argv[k]), *target = read_domain(argv[k + 1]);
        icc_map_options options = {};
        options.size = sizeof options;
        options.iterations = -1;
        icc_map *map;
        check(icc_map_create(&map, source, target, &options, nullptr, nullptr));
        const std::string path = argv[k];
        measure(path.substr(path.find_last_of('/') + 1).c_str(), map);
        icc_map_free(map);
        icc_domain_free(source);
        icc_domain_free(target);
    }
    return EXIT_SUCCESS;
}
