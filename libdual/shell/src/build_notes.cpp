#include "build_notes.h"

#include <algorithm>
#include <cmath>

#include "trivalent/shell/number_text.h"
#include "trivalent/shell/reports.h"

namespace trivalent::shell {
namespace {

std::string crossing_remedy(const BuildResult& result) {
  if (result.wrap_offset > 0.0) {
    return "a larger shell can follow thin parts of the wrap, a larger --wrap-offset makes them "
           "thicker";
  }
  return result.input_quality.self_intersections > 0
             ? "the input does too: --repair wrap mends that"
             : "the input does not: a larger shell can follow thin parts, --feature-angle keeps "
               "sharp creases";
}

}  // namespace

void note_misses(const dual::ShellSize& size, BuildResult& result) {
  const auto* asked = std::get_if<dual::AtomCount>(&size);
  const int atoms = result.network.atoms;
  if (asked != nullptr &&
      std::abs(atoms - asked->atoms) > dual::atom_count_tolerance * asked->atoms) {
    result.notes.push_back("the shell has " + std::to_string(atoms) + " atoms, not the " +
                           std::to_string(asked->atoms) +
                           " asked for: no edge length that was tried came nearer");
  }
  const double edge = result.quality.edge_length.mean;
  const double distance = result.distance.from_original.max;
  // A net on the surface lies half inside and half outside, and rounds off what is sharp; one that
  // is at rest as a membrane is up to five edges away, and about one edge on average.
  constexpr double max_rms_on_surface = 0.25;  // edges
  const bool is_on_surface =
      result.distance.to_original.root_mean_square < max_rms_on_surface * edge;
  const double max_covered_distance = is_on_surface ? 1.5 : 6.0;  // edges
  if (distance > max_covered_distance * edge) {
    result.notes.push_back("a part of the surface is left out, up to " + decimals(distance, 1) +
                           " Å (" + decimals(distance / edge, 1) +
                           " edges) from the shell: more atoms can follow thin parts, "
                           "--feature-angle keeps sharp creases");
  }
}

namespace {

/// Tubes that the surface was to end in, and the net does not.
std::vector<remesh::ChiralIndices> missed_tubes(const BuildResult& result) {
  std::vector<std::optional<remesh::ChiralIndices>> left = result.tube_ends;
  std::vector<remesh::ChiralIndices> missed;
  for (const remesh::ChiralIndices& wanted : remesh::wanted_tube_ends(result.original)) {
    const auto found = std::ranges::find(left, std::optional(wanted));
    if (found == left.end()) {
      missed.push_back(wanted);
    } else {
      left.erase(found);
    }
  }
  return missed;
}

}  // namespace

void note_findings(BuildResult& result) {
  for (const remesh::ChiralIndices& tube : missed_tubes(result)) {
    result.notes.push_back("no open end is that of a " + tube_text(tube) +
                           " tube, as was asked for: another --seed, or --effort thorough");
  }
  const auto& network = result.network;
  if (result.quality.boundary_loops == 0 && !network.is_trivalent()) {
    result.notes.push_back("not every atom has three bonds");
  }
  if (result.quality.boundary_loops > 0 && result.caps.hydrogens == 0) {
    result.notes.push_back(
        "the surface is open: atoms at its edge have fewer than three bonds; --cap "
        "hydrogen saturates them");
  }
  if (const int copies = result.shell.surface.copies; copies > 1) {
    result.notes.push_back("the surface repeats itself " + std::to_string(copies) +
                           " times in its cell; so does the net, which was searched in one part");
  }
  if (result.quality.self_intersections > 0) {
    result.notes.push_back("the remeshed surface intersects itself in " +
                           crossings_text(result.quality.self_intersections) +
                           " pairs of triangles; " + crossing_remedy(result));
  }
}

}  // namespace trivalent::shell
