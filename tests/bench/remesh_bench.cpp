// remesh_bench peers MESH EDGE [ROUNDS]: remesh() against CGAL's isotropic_remeshing, 20 iterations
// each on
//   the same mesh and target, in turns, ours on all threads and on one; medians and ratios.
// remesh_bench growth: time and memory for about 10,000, 100,000 and 1,000,000 vertices on a torus.

#include <CGAL/Polygon_mesh_processing/remesh.h>
#include <CGAL/Simple_cartesian.h>
#include <CGAL/Surface_mesh.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <tbb/global_control.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <string>

#include "trivalent/remesh/mesh_io.h"
#include "trivalent/remesh/mesh_quality.h"
#include "trivalent/remesh/remesh.h"
#include "trivalent/remesh/shapes.h"

namespace {

namespace remesh = trivalent::remesh;
using CgalMesh = CGAL::Surface_mesh<CGAL::Simple_cartesian<double>::Point_3>;

constexpr int iterations = 20;

double seconds_of(const auto& work) {
  const auto start = std::chrono::steady_clock::now();
  work();
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

double median(std::vector<double> values) {
  std::ranges::sort(values);
  return values[values.size() / 2];
}

CgalMesh to_cgal(const remesh::TriMesh& mesh) {
  CgalMesh copy;
  std::vector<CgalMesh::Vertex_index> vertices;
  for (const auto v : mesh.vertices()) {
    const Eigen::Vector3d& p = mesh.point(v);
    vertices.push_back(copy.add_vertex({p.x(), p.y(), p.z()}));
  }
  const auto vertex = [&](int v) { return vertices[static_cast<std::size_t>(v)]; };
  for (const auto& [a, b, c] : remesh::triangles_of(mesh))
    copy.add_face(vertex(a), vertex(b), vertex(c));
  return copy;
}

remesh::TriMesh from_cgal(CgalMesh& mesh) {
  mesh.collect_garbage();
  std::vector<Eigen::Vector3d> points;
  for (const auto v : mesh.vertices()) {
    const auto& p = mesh.point(v);
    points.emplace_back(p.x(), p.y(), p.z());
  }
  std::vector<std::array<int, 3>> triangles;
  for (const auto f : mesh.faces()) {
    std::array<int, 3> corners{};
    std::size_t k = 0;
    for (const auto v : vertices_around_face(mesh.halfedge(f), mesh)) {
      corners[k++] = static_cast<int>(static_cast<unsigned>(v));
    }
    triangles.push_back(corners);
  }
  return remesh::make_mesh(points, triangles);
}

void print_quality(const char* name, const remesh::TriMesh& mesh, double target) {
  const remesh::MeshQuality quality = remesh::measure_quality(mesh);
  std::printf("%-10s %7d vertices, mean/m %.4f, CV %.2f %%, valence 6 %.1f %%, intersections %d\n",
              name, quality.vertices, quality.edge_length.mean / target,
              100.0 * quality.edge_length.relative(), 100.0 * quality.regular_fraction,
              quality.self_intersections);
}

void compare_with_cgal(const std::string& path, double target, int rounds) {
  const remesh::TriMesh original = remesh::read_mesh(path).mesh;
  const CgalMesh cgal_original = to_cgal(original);
  remesh::TriMesh ours;
  CgalMesh theirs;
  std::vector<double> our_times;
  std::vector<double> our_times_on_one;
  std::vector<double> their_times;
  std::vector<double> ratios;
  std::vector<double> ratios_on_one;
  const auto run_ours = [&] {
    ours = remesh::remesh(original, {.target_edge_length = target, .iterations = iterations}).mesh;
  };
  for (int round = 0; round < rounds; ++round) {
    our_times.push_back(seconds_of(run_ours));
    theirs = cgal_original;
    their_times.push_back(seconds_of([&] {
      CGAL::Polygon_mesh_processing::isotropic_remeshing(
          faces(theirs), target, theirs,
          CGAL::Polygon_mesh_processing::parameters::number_of_iterations(iterations));
    }));
    const tbb::global_control one_thread(tbb::global_control::max_allowed_parallelism, 1);
    our_times_on_one.push_back(seconds_of(run_ours));
    ratios.push_back(our_times.back() / their_times.back());
    ratios_on_one.push_back(our_times_on_one.back() / their_times.back());
  }
  print_quality("trivalent", ours, target);
  print_quality("CGAL", from_cgal(theirs), target);
  std::printf("seconds, median of %d: trivalent %.3f, on one thread %.3f, CGAL %.3f\n", rounds,
              median(our_times), median(our_times_on_one), median(their_times));
  std::printf("ratio to CGAL, median of the turns: %.2f, on one thread %.2f\n", median(ratios),
              median(ratios_on_one));
}

/// CGAL's remeshing of a mesh file, for scripts/bench_crystal.sh.
void remesh_with_cgal(const std::string& in, double target, const std::string& out) {
  CgalMesh mesh = to_cgal(remesh::read_mesh(in).mesh);
  CGAL::Polygon_mesh_processing::isotropic_remeshing(
      faces(mesh), target, mesh,
      CGAL::Polygon_mesh_processing::parameters::number_of_iterations(iterations));
  remesh::write_mesh(from_cgal(mesh), out);
}

/// In a child process, so that the peak memory is that of this run alone.
void measure_run(double target) {
  std::fflush(stdout);
  const pid_t child = fork();
  if (child == 0) {
    const remesh::TriMesh torus = remesh::make_shape("torus", {}, target / 0.8);
    rusage before{};
    getrusage(RUSAGE_SELF, &before);
    std::size_t vertices = 0;
    const double seconds = seconds_of([&] {
      vertices = remesh::remesh(torus, {.target_edge_length = target, .iterations = iterations})
                     .mesh.n_vertices();
    });
    rusage after{};
    getrusage(RUSAGE_SELF, &after);
    const double bytes = 1024.0 * static_cast<double>(after.ru_maxrss);
    std::printf(
        "%9zu vertices  %8.2f s  %6.2f us per vertex and iteration  %6.0f bytes per vertex\n",
        vertices, seconds, 1e6 * seconds / iterations / static_cast<double>(vertices),
        bytes / static_cast<double>(vertices));
    std::fflush(stdout);
    _exit(0);
  }
  int status = 0;
  waitpid(child, &status, 0);
}

void measure_growth() {
  constexpr double area = 15.79;  // of the torus R = 1, r = 0.4: 4 π² R r
  for (const double vertices : {1e4, 1e5, 1e6}) {
    measure_run(std::sqrt(area / vertices * 2.0 / std::sqrt(3.0)));
  }
}

}  // namespace

int main(int argc, char** argv) {
  const std::vector<std::string> arguments(argv + 1, argv + argc);
  if (arguments.size() >= 3 && arguments[0] == "peers") {
    compare_with_cgal(arguments[1], std::stod(arguments[2]),
                      arguments.size() > 3 ? std::stoi(arguments[3]) : 5);
  } else if (arguments.size() == 4 && arguments[0] == "cgal") {
    remesh_with_cgal(arguments[1], std::stod(arguments[2]), arguments[3]);
  } else if (arguments.size() == 1 && arguments[0] == "growth") {
    measure_growth();
  } else {
    std::fprintf(stderr,
                 "usage: remesh_bench peers MESH EDGE [ROUNDS] | remesh_bench cgal IN EDGE OUT | "
                 "remesh_bench growth\n");
    return 2;
  }
  return 0;
}
