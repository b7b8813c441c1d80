#include "crystal/search_watch.h"

#include "crystal/spring_relaxation.h"
#include "equalize/paper_loop.h"

namespace trivalent::remesh {

bool SearchWatch::goes_on(const TriMesh& mesh, double length, double scale) {
  constexpr int rounds_per_report = 25;
  const int done = ++rounds_done_;
  should_stop();
  const bool is_due = done / rounds_per_report > rounds_reported_ / rounds_per_report;
  if (options_.on_progress && is_at_home() && (is_due || done == rounds_)) {
    rounds_reported_ = done;
    RemeshProgress progress = measure_progress(mesh);
    progress.mean_edge_length *= scale;
    progress.iteration = done;
    progress.iterations = rounds_;
    progress.strain = spring_strain(mesh, length);
    options_.on_progress(progress);
  }
  return !stopped_;
}

}  // namespace trivalent::remesh
