#include "crystal/search_watch.h"

#include "crystal/spring_relaxation.h"
#include "equalize/paper_loop.h"

namespace trivalent::remesh {

bool SearchWatch::goes_on(const TriMesh& mesh, double length, double scale) {
  constexpr int rounds_per_report = 25;
  ++rounds_done_;
  should_stop();
  const bool reports = rounds_done_ % rounds_per_report == 0 || rounds_done_ == rounds_;
  if (options_.on_progress && reports) {
    RemeshProgress progress = measure_progress(mesh);
    progress.mean_edge_length *= scale;
    progress.iteration = rounds_done_;
    progress.iterations = rounds_;
    progress.strain = spring_strain(mesh, length);
    options_.on_progress(progress);
  }
  return !stopped_;
}

}  // namespace trivalent::remesh
