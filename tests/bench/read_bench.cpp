// Times how a mesh file is read, mended, checked and indexed: read_bench FILE. Prints seconds (wall
// and processor) of every step, and the peak memory.

#include <sys/resource.h>

#include <chrono>
#include <cstdio>
#include <ctime>
#include <string_view>
#include <utility>

#include "mesh/surface_projector.h"
#include "trivalent/remesh/mesh_components.h"
#include "trivalent/remesh/mesh_repair.h"

namespace {

using namespace trivalent::remesh;  // NOLINT(google-build-using-namespace)

/// Calls a step and prints what it took.
template <typename Step>
auto timed(std::string_view name, const Step& step) {
  const auto begin = std::chrono::steady_clock::now();
  const std::clock_t processor_begin = std::clock();
  auto result = step();
  const std::chrono::duration<double> seconds = std::chrono::steady_clock::now() - begin;
  std::printf("%-10.*s %7.2f s, processor %7.2f s\n", static_cast<int>(name.size()), name.data(),
              seconds.count(),
              static_cast<double>(std::clock() - processor_begin) / CLOCKS_PER_SEC);
  return result;
}

}  // namespace

int main(int argc, char** argv) {
  if (argc != 2) return 2;
  TriangleSoup soup = timed("read", [&] { return triangulate(read_polygon_soup(argv[1])); });
  const TriMesh mesh = timed("mend", [&] { return repair(std::exchange(soup, {})).mesh; });
  const auto components = timed("components", [&] { return find_components(mesh); });
  const SurfaceProjector index = timed("index", [&] { return SurfaceProjector(mesh); });
  rusage usage = {};
  getrusage(RUSAGE_SELF, &usage);
  std::printf("%zu faces, %zu components, peak memory %.2f GB\n", mesh.n_faces(),
              components.parts.size(), static_cast<double>(usage.ru_maxrss) / 1e6);
}
