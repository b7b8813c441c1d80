#include "mesh/numbered_positions.h"

#include <algorithm>
#include <bit>

#include "trivalent/remesh/mesh.h"

namespace trivalent::remesh {

namespace {

/// Numbers positions in the order of their first points. Open addressing: with millions of points a
/// node for each takes most of the reading.
class PositionTable {
 public:
  int number_of(const Eigen::Vector3d& p) {
    if (2 * positions_.size() >= slots_.size()) grow();
    int& slot = slot_of(p);
    if (slot == empty) {
      slot = static_cast<int>(positions_.size());
      positions_.push_back(p);
    }
    return slot;
  }
  [[nodiscard]] std::vector<Eigen::Vector3d> take() { return std::move(positions_); }

 private:
  static constexpr int empty = -1;

  static std::uint64_t hash(const Eigen::Vector3d& p) {
    std::uint64_t hash = 0;
    for (const double x : p) hash = spread_bits(hash ^ std::bit_cast<std::uint64_t>(x));
    return hash;
  }

  /// That of the position, or the empty one where it belongs.
  int& slot_of(const Eigen::Vector3d& p) {
    std::size_t i = hash(p) & (slots_.size() - 1);
    while (slots_[i] != empty && positions_[index(slots_[i])] != p) {
      i = (i + 1) & (slots_.size() - 1);
    }
    return slots_[i];
  }

  void grow() {
    slots_.assign(std::max<std::size_t>(64, 2 * slots_.size()), empty);
    for (std::size_t i = 0; i < positions_.size(); ++i)
      slot_of(positions_[i]) = static_cast<int>(i);
  }

  std::vector<Eigen::Vector3d> positions_;
  std::vector<int> slots_;  // a power of two
};

}  // namespace

NumberedPositions number_positions(std::span<const Eigen::Vector3d> points) {
  PositionTable table;
  NumberedPositions result;
  result.number_of.reserve(points.size());
  // + 0.0 turns -0.0 into 0.0.
  for (const Eigen::Vector3d& p : points) {
    result.number_of.push_back(table.number_of(p + Eigen::Vector3d::Zero()));
  }
  result.positions = table.take();
  return result;
}

}  // namespace trivalent::remesh
