// What it costs to make a domain of a surface, beside does_self_intersect() of CGAL's Polygon Mesh
// Processing, which only says whether triangles meet: nanoseconds a triangle, the least of some runs
// by turns. To be built with optimisation and NDEBUG, which CGAL needs to be fast.
// usage: bench_surface [NAME.obj ...]
#include <icc/icc.h>

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Polygon_mesh_processing/self_intersections.h>
#include <CGAL/Surface_mesh.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <ctime>
#include <fstream>
#include <sstream>
#include <string>
#include <vector>

typedef CGAL::Exact_predicates_inexact_constructions_kernel kernel;
typedef CGAL::Surface_mesh<kernel::Point_3> cgal_mesh;

struct surface {
    std::vector<double> vertices;
    std::vector<uint32_t> faces;
};

static double now()
{
    return static_cast<double>(std::clock()) / CLOCKS_PER_SEC; // of the processor
}

static surface read_obj(const char *path)
{
    surface s;
    std::ifstream file(path);
    for (std::string line; std::getline(file, line);) {
        std::istringstream words(line);
        std::string kind, corner;
        words >> kind;
        for (double x; kind == "v" && words >> x;)
            s.vertices.push_back(x);
        while (kind == "f" && words >> corner)
            s.faces.push_back(static_cast<uint32_t>(std::atoi(corner.c_str()) - 1));
    }
    return s;
}

// A ball with bumps: n rings of 2 n vertices between two poles.
static surface make_ball(uint32_t n, double bumps)
{
    surface s;
    const double half_turn = std::acos(-1.0);
    const auto put = [&](double theta, double phi) {
        const double r = 1 + bumps * std::sin(7 * theta) * std::cos(5 * phi);
        s.vertices.insert(s.vertices.end(), {r * std::sin(theta) * std::cos(phi),
                                             r * std::sin(theta) * std::sin(phi),
                                             r * std::cos(theta)});
    };
    for (uint32_t i = 0; i < n; ++i)
        for (uint32_t j = 0; j < 2 * n; ++j)
            put(half_turn * (i + 1) / (n + 1), half_turn * j / n);
    put(0, 0);
    put(half_turn, 0);
    for (uint32_t j = 0; j < 2 * n; ++j) {
        const uint32_t k = (j + 1) % (2 * n), last = 2 * n * (n - 1), top = 2 * n * n;
        s.faces.insert(s.faces.end(), {top, j, k, top + 1, last + k, last + j});
        for (uint32_t a = 0; a < last; a += 2 * n)
            s.faces.insert(s.faces.end(), {a + j, a + 2 * n + j, a + 2 * n + k, //
                                           a + j, a + 2 * n + k, a + k});
    }
    return s;
}

static cgal_mesh to_cgal(const surface &s)
{
    cgal_mesh mesh;
    for (size_t i = 0; i < s.vertices.size(); i += 3)
        mesh.add_vertex(kernel::Point_3(s.vertices[i], s.vertices[i + 1], s.vertices[i + 2]));
    for (size_t i = 0; i < s.faces.size(); i += 3)
        mesh.add_face(cgal_mesh::Vertex_index(s.faces[i]), cgal_mesh::Vertex_index(s.faces[i + 1]),
                      cgal_mesh::Vertex_index(s.faces[i + 2]));
    return mesh;
}

static void measure(const std::string &name, const surface &s)
{
    const cgal_mesh mesh = to_cgal(s);
    const size_t n = s.faces.size() / 3;
    double ours = HUGE_VAL, theirs = HUGE_VAL;
    bool valid = false, valid_cgal = false;
    for (int run = 0; run < 15; ++run) {
        icc_domain *domain;
        const double start = now();
        valid = icc_domain_create(&domain, 3, s.vertices.size() / 3, s.vertices.data(), n,
                                  s.faces.data(), nullptr, nullptr) == ICC_OK;
        icc_domain_free(domain);
        const double middle = now();
        valid_cgal = !CGAL::Polygon_mesh_processing::does_self_intersect(mesh);
        ours = std::min(ours, middle - start);
        theirs = std::min(theirs, now() - middle);
    }
    std::printf("%-28s %7zu %-10s %9.1f %9.1f %7.3f%s\n", name.c_str(), n,
                valid ? "simple" : "not simple", 1e9 * ours / static_cast<double>(n),
                1e9 * theirs / static_cast<double>(n), ours / theirs,
                valid == valid_cgal ? "" : "  (CGAL says otherwise)");
    std::fflush(stdout);
}

int main(int argc, char **argv)
{
    std::printf("%-28s %7s %-10s %9s %9s %7s\n", "", "faces", "", "ours ns", "CGAL ns", "ratio");
    for (int i = 1; i < argc; ++i) {
        const std::string path = argv[i];
        measure(path.substr(path.find_last_of('/') + 1), read_obj(argv[i]));
    }
    for (uint32_t n = 20; n <= 160; n *= 2) {
        measure("ball", make_ball(n, 0));
        measure("ball with bumps", make_ball(n, 0.3));
    }
    return 0;
}
