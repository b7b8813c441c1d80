// Reads bytes as triangles between the points of a small grid, so that faces repeat, cross, pinch
// and lie flat more often than not. Safe repair ends in a sound surface or a refusal.

#include <array>
#include <cstdint>
#include <cstdlib>

#include "trivalent/remesh/error.h"
#include "trivalent/remesh/mesh_components.h"
#include "trivalent/remesh/mesh_diagnosis.h"
#include "trivalent/remesh/mesh_repair.h"

namespace {

using namespace trivalent::remesh;  // NOLINT(google-build-using-namespace)

TriangleSoup soup_of(const std::uint8_t* data, std::size_t size) {
  TriangleSoup soup;
  // Three steps along each axis, and every point twice.
  constexpr int n_points = 2 * 27;
  for (int k = 0; k < n_points; ++k) {
    const int place = k / 2;
    soup.points.emplace_back(place % 3, place / 3 % 3, place / 9);
  }
  constexpr std::size_t max_bytes = 3 * 200;
  for (std::size_t i = 0; i + 3 <= std::min(size, max_bytes); i += 3) {
    const std::array<int, 3> t = {data[i] % n_points, data[i + 1] % n_points,
                                  data[i + 2] % n_points};
    if (t[0] != t[1] && t[1] != t[2] && t[2] != t[0]) soup.triangles.push_back(t);
  }
  return soup;
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  if (size == 0) return 0;
  const TriangleSoup soup = soup_of(data + 1, size - 1);
  const RepairOptions options = {
      .holes = (data[0] & 1) != 0 ? HolePolicy::fill : HolePolicy::keep,
      .components = (data[0] & 2) != 0 ? ComponentPolicy::keep_largest : ComponentPolicy::keep_all};
  try {
    const TriMesh mesh = repair(soup, options).mesh;
    TriangleSoup repaired{{}, triangles_of(mesh), {}};
    for (const auto v : mesh.vertices()) repaired.points.push_back(mesh.point(v));
    const MeshDiagnosis diagnosis = diagnose(repaired);
    if (!diagnosis.is_oriented_manifold()) std::abort();
    if (options.holes == HolePolicy::fill && diagnosis.boundary_edges != 0) std::abort();
    if (find_components(mesh).of_face.size() != mesh.n_faces()) std::abort();
  } catch (const InvalidMesh&) {
  }
  return 0;
}
