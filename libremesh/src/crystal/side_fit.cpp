#include "crystal/side_fit.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>

#include "crystal/defect_moves.h"
#include "trivalent/remesh/mesh.h"

namespace trivalent::remesh {

namespace {

constexpr double hot = 1.5;   // of the misfit
constexpr double cold = 0.1;  // of the misfit
constexpr int trials_per_side = 60000;
constexpr int chains = 4;    // of annealings, side by side
constexpr int heatings = 3;  // of each, one after the other: one long annealing comes less near
constexpr int max_trials = 8'000'000;
constexpr double stiffness_of_faces = 20.0;

/// What sides and faces cost, kept from trial to trial.
class SideFit {
 public:
  SideFit(ConeNet& cones, const WantedSides& wanted)
      : cones_(cones), wanted_(wanted), faces_(static_cast<double>(cones.n_faces())) {
    for (int h = 0; h < cones.n_halfedges(); ++h) costs_.push_back(cost(h));
    for (int h = 0; h < cones.n_halfedges(); h += 3) areas_.push_back(area(h));
  }

  /// Moves a disclination, unless the cost rises by more than max_rise.
  void try_move(int h, const LatticeVector& by, double max_rise) {
    if (!cones_.move(h, by)) return;
    double faces = faces_;
    double rise = 0.0;
    for (const int x : cones_.sides_moved_with(h)) rise += 0.5 * (cost(x) - costs_[index(x)]);
    for (const int x : cones_.triangles_moved_with(h)) faces += area(x) - areas_[index(x / 3)];
    if (rise + cost_of_faces(faces) - cost_of_faces(faces_) > max_rise) {
      static_cast<void>(cones_.move(h, -by));
      return;
    }
    for (const int x : cones_.sides_moved_with(h)) costs_[index(x)] = cost(x);
    for (const int x : cones_.triangles_moved_with(h)) areas_[index(x / 3)] = area(x);
    faces_ = faces;
  }

  [[nodiscard]] double misfit() const {
    double sum = cost_of_faces(faces_);
    for (const double each : costs_) sum += 0.5 * each;
    return sum;
  }

 private:
  [[nodiscard]] double cost(int h) const {
    const double difference = length_of(cones_.side(h)) - wanted_.lengths[index(h)];
    return difference * difference;
  }
  /// Of the half-edge's triangle.
  [[nodiscard]] double area(int h) const {
    return static_cast<double>(area_of(cones_.side(h), cones_.side(ConeNet::next(h))));
  }
  [[nodiscard]] double cost_of_faces(double faces) const {
    const double excess = faces - wanted_.faces;
    return stiffness_of_faces * excess * excess / wanted_.faces;
  }

  ConeNet& cones_;
  const WantedSides& wanted_;
  double faces_;
  std::vector<double> costs_;  // of every half-edge
  std::vector<double> areas_;  // of every large triangle
};

/// A net that was fitted.
struct Fitted {
  ConeNet cones;
  double misfit;
};

/// @param first  Of the random numbers.
Fitted anneal(const ConeNet& start, const WantedSides& wanted, std::uint64_t first) {
  ConeNet cones = start;
  SideFit fit(cones, wanted);
  const int halfedges = cones.n_halfedges();
  const int trials = std::min(max_trials, trials_per_side / 2 * halfedges) / (chains * heatings);
  Fitted best{cones, fit.misfit()};
  std::uint64_t count = first;
  for (int heating = 0; heating < heatings; ++heating) {
    if (wanted.should_stop && wanted.should_stop()) break;
    for (int k = 0; k < trials; ++k) {
      const double temperature = hot * std::pow(cold / hot, static_cast<double>(k) / trials);
      const std::uint64_t random = hashed(wanted.seed, ++count);
      const int h = static_cast<int>(random % static_cast<std::uint64_t>(halfedges));
      const LatticeVector by = turned(LatticeVector(1, 0), static_cast<int>((random >> 40U) % 6U));
      fit.try_move(h, by, largest_rise(temperature, hashed(random, 1), 0.0));
    }
    if (fit.misfit() < best.misfit) best = {cones, fit.misfit()};
  }
  return best;
}

}  // namespace

void fit_sides(ConeNet& cones, const WantedSides& wanted) {
  std::array<std::optional<Fitted>, chains> found;
  tbb::parallel_for(std::size_t{0}, found.size(), [&](std::size_t k) {
    found[k] = anneal(cones, wanted, k * static_cast<std::uint64_t>(max_trials));
  });
  const auto best = std::ranges::min_element(
      found, {}, [](const std::optional<Fitted>& each) { return each->misfit; });
  cones = std::move((*best)->cones);
}

}  // namespace trivalent::remesh
