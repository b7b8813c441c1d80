// Remeshes a sphere so that its edges come close to one length, and writes it as a mesh file.
#include <cmath>
#include <cstdio>
#include <exception>

#include "trivalent/remesh/mesh_io.h"
#include "trivalent/remesh/mesh_quality.h"
#include "trivalent/remesh/remesh.h"
#include "trivalent/remesh/shapes.h"

namespace remesh = trivalent::remesh;

int run() {
  // Any mesh will do; remesh::read_mesh("scan.ply").mesh reads one from a file.
  const remesh::TriMesh sphere = remesh::make_shape("sphere", {{"radius", 10.0}}, 0.8);

  remesh::RemeshOptions options;
  options.target_edge_length = 1.0;  // in the unit of the mesh
  const remesh::RemeshResult result = remesh::remesh(sphere, options);
  remesh::write_mesh(result.mesh, "sphere.off");

  const remesh::MeshQuality quality = remesh::measure_quality(result.mesh);
  std::printf("%d vertices, mean edge %.4f, spread %.1f %%, valence 6 at %.1f %%\n",
              quality.vertices, quality.edge_length.mean, 100.0 * quality.edge_length.relative(),
              100.0 * quality.regular_fraction);
  const bool is_good = std::abs(quality.edge_length.mean - options.target_edge_length) < 0.03 &&
                       quality.euler_characteristic == 2;
  return is_good ? 0 : 1;
}

int main() {
  try {
    return run();
  } catch (const std::exception& error) {
    std::fprintf(stderr, "%s\n", error.what());
    return 1;
  }
}
