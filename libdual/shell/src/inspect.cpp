#include "trivalent/shell/inspect.h"

#include <tbb/parallel_invoke.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "trivalent/dual/error.h"
#include "trivalent/remesh/error.h"
#include "trivalent/shell/number_text.h"
#include "trivalent/shell/surface_source.h"

namespace trivalent::shell {
namespace {

/// Radius of C60 in bond lengths: 3.55 Å to 1.42 Å. Hardly any sp2 carbon bends more tightly.
constexpr double smallest_radius = 2.5;

/// Beyond these, squares and cubes of lengths leave the range of double-precision numbers.
constexpr double smallest_size = 1e-90;
constexpr double largest_size = 1e90;

void measure(const dual::ShellOptions& options, Inspection& result) {
  const remesh::TriMesh& mesh = *result.mesh;
  tbb::parallel_invoke([&] { result.quality = remesh::measure_quality(mesh); },
                       [&] {
                         result.components = remesh::find_components(mesh);
                         result.features = remesh::find_feature_lines(
                             mesh, inspected_feature_angle * std::numbers::pi / 180.0);
                         result.plan = shell::plan(mesh, result.components, options);
                         result.tight_fraction = remesh::tightly_curved_fraction(
                             mesh, smallest_radius * options.bond / result.plan->shell.scale);
                       });
}

/// Sets the mesh, or the reason why there is none.
void repair(const remesh::TriangleSoup& soup, const InspectOptions& options, Inspection& result) {
  remesh::RepairOptions mending = options.repair;
  mending.edge_length_on = [&options](const remesh::TriMesh& mesh) {
    return dual::estimate_shell(mesh, options.shell).edge_length;
  };
  try {
    remesh::RepairResult repaired = remesh::repair(soup, mending, result.diagnosis);
    Surface joined = in_cell({.mesh = std::move(repaired.mesh)}, options.cell);
    result.mesh = std::move(joined.mesh);
    result.reading_notes.insert(result.reading_notes.end(), joined.notes.begin(),
                                joined.notes.end());
    result.repair_notes.assign(
        repaired.notes.begin() + static_cast<std::ptrdiff_t>(soup.notes.size()),
        repaired.notes.end());
  } catch (const remesh::InvalidMesh& error) {
    result.reason = error.what();
  }
}

bool has_size(const Inspection& result) {
  const double size = result.box.diagonal();
  return size >= smallest_size && size <= largest_size;
}

void judge(Inspection& result) {
  if (result.diagnosis.points == 0) {
    result.verdict = Verdict::hopeless;
    result.reason = "it holds neither points nor faces; is it the right file?";
    return;
  }
  if (!has_size(result)) {
    result.verdict = Verdict::hopeless;
    result.reason = "the points span a diagonal of " + significant(result.box.diagonal()) +
                    "; scale them to ordinary numbers";
    return;
  }
  const bool is_clean = result.diagnosis.findings.empty() && result.repair_notes.empty();
  result.verdict = is_clean && result.mesh ? Verdict::sound : Verdict::mendable;
  const bool has_far_points = std::ranges::any_of(
      result.diagnosis.findings,
      [](const remesh::Finding& finding) { return finding.problem == remesh::Problem::far_point; });
  if (has_far_points && result.mesh) {
    result.reason = "points lie far off; remove them unless they are meant";
  } else if (result.verdict == Verdict::sound) {
    result.reason = "it is an oriented surface without self-intersections";
  } else if (result.mesh && result.quality.self_intersections > 0) {
    result.reason = "it intersects itself, and so will its shell; --repair wrap mends that";
  } else if (result.mesh) {
    result.reason = "build mends it without changing the shape";
  }
}

}  // namespace

Inspection inspect(const remesh::TriangleSoup& soup, const InspectOptions& options) {
  Inspection result;
  result.is_read = true;
  result.reading_notes = soup.notes;
  result.box = soup.points.empty() ? remesh::BoundingBox{} : remesh::bounding_box(soup.points);
  result.diagnosis = remesh::diagnose(soup);
  if (has_size(result)) repair(soup, options, result);
  if (result.mesh) measure(options.shell, result);
  if (!result.mesh || result.quality.self_intersections > 0) {
    const remesh::Finding crossing = remesh::find_crossing_faces(soup);
    if (crossing.count > 0) result.diagnosis.findings.push_back(crossing);
  }
  judge(result);
  return result;
}

Inspection inspect(const std::string& path, const InspectOptions& options) {
  remesh::TriangleSoup soup;
  try {
    soup = read_soup(path);
  } catch (const remesh::Error& error) {
    return {.reason = error.what()};
  }
  return inspect(soup, options);
}

}  // namespace trivalent::shell
