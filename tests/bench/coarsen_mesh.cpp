// coarsen_mesh IN.off OUT.off VERTICES: CGAL's edge-collapse simplification down to a number of
// vertices. Makes the irregular start mesh of the paper's Table 1 from a scan with more vertices.

#include <CGAL/Simple_cartesian.h>
#include <CGAL/Surface_mesh.h>
#include <CGAL/Surface_mesh_simplification/Policies/Edge_collapse/Count_stop_predicate.h>
#include <CGAL/Surface_mesh_simplification/edge_collapse.h>
#include <CGAL/boost/graph/IO/polygon_mesh_io.h>

#include <cstdio>
#include <string>

using Mesh = CGAL::Surface_mesh<CGAL::Simple_cartesian<double>::Point_3>;

int main(int argc, char** argv) {
  Mesh mesh;
  if (argc != 4 || !CGAL::IO::read_polygon_mesh(argv[1], mesh)) {
    std::fprintf(stderr, "usage: coarsen_mesh IN.off OUT.off VERTICES\n");
    return 2;
  }
  // Every collapse takes one vertex and, on a closed surface, three edges.
  const auto vertices = static_cast<Mesh::size_type>(std::stoul(argv[3]));
  const auto edges = mesh.number_of_edges() - 3 * (mesh.number_of_vertices() - vertices);
  CGAL::Surface_mesh_simplification::edge_collapse(
      mesh, CGAL::Surface_mesh_simplification::Count_stop_predicate<Mesh>(edges + 1));
  mesh.collect_garbage();
  const auto digits = CGAL::parameters::stream_precision(17);
  return CGAL::IO::write_polygon_mesh(argv[2], mesh, digits) ? 0 : 1;
}
