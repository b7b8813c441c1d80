#pragma once

#include <Eigen/Core>
#include <array>
#include <vector>

namespace trivalent::remesh {

/// The translations that map a periodic surface onto itself: sums of whole multiples of up to three
/// cell vectors. A free surface has none.
///
/// Points that differ by a translation are images of each other. Whatever belongs together on a
/// surface is nearer than half of the shortest translation, so that the nearest image is the right
/// one.
class Lattice {
 public:
  using Cell = Eigen::Matrix3d;          ///< cell vectors as columns
  using Periodic = std::array<bool, 3>;  ///< along each cell vector
  using Image = std::array<int, 3>;      ///< so many cell vectors

  /// Of a free surface.
  Lattice() = default;

  /// @param cell  Vectors along which nothing is periodic frame the surface; they may be zero.
  /// @throws InvalidOption if a number is not finite, the periodic vectors lie in one plane (or on
  ///   one line, or are zero), or three of them are left-handed.
  Lattice(const Cell& cell, const Periodic& periodic);

  [[nodiscard]] bool is_periodic() const { return shortest_squared_ > 0.0; }
  [[nodiscard]] const Cell& cell() const { return cell_; }
  [[nodiscard]] const Periodic& periodic() const { return periodic_; }

  /// Length of the shortest translation; 0 of a free surface.
  [[nodiscard]] double shortest() const;

  /// The shortest image of a separation.
  [[nodiscard]] Eigen::Vector3d nearest(const Eigen::Vector3d& separation) const {
    if (separation.squaredNorm() <= 0.25 * shortest_squared_ || !is_periodic()) return separation;
    return nearest_image(separation);
  }

  /// Whether no image of a separation is shorter.
  [[nodiscard]] bool is_nearest(const Eigen::Vector3d& separation) const {
    return nearest(separation) == separation;
  }

  /// The image of p that is nearest to a place.
  [[nodiscard]] Eigen::Vector3d near(const Eigen::Vector3d& place, const Eigen::Vector3d& p) const {
    return is_periodic() ? Eigen::Vector3d(place + nearest(p - place)) : p;
  }

  /// The translation by so many cell vectors.
  [[nodiscard]] Eigen::Vector3d translation(const Image& image) const;

  /// How many cell vectors a translation consists of.
  [[nodiscard]] Image image_of(const Eigen::Vector3d& translation) const;

  /// The image of a point within the cell that begins at the origin.
  [[nodiscard]] Eigen::Vector3d wrapped(const Eigen::Vector3d& p) const;

  /// Translations but for zero after which the cell holds all points that are at most so far
  /// outside of it.
  [[nodiscard]] std::vector<Eigen::Vector3d> translations_within(double reach) const;

  /// No point is farther than this from the nearest image of another one, along the periodic
  /// directions.
  [[nodiscard]] double covering_radius() const;

  /// The same lattice with the shortest cell vectors that are right-handed; three directions must
  /// be periodic.
  [[nodiscard]] Lattice reduced() const;

  /// The same directions, with cell vectors longer by a factor > 0.
  [[nodiscard]] Lattice scaled(double factor) const;

 private:
  [[nodiscard]] Eigen::Vector3d nearest_image(const Eigen::Vector3d& separation) const;

  Cell cell_ = Cell::Zero();
  Periodic periodic_ = {false, false, false};
  Cell inverse_ = Cell::Zero();  // of the periodic vectors, the others being zero
  Cell short_ = Cell::Zero();    // a basis of short vectors; zero where not periodic
  Cell inverse_short_ = Cell::Zero();
  std::vector<Eigen::Vector3d> around_;  // translations that may come nearer than rounding does
  double shortest_squared_ = 0.0;
};

}  // namespace trivalent::remesh
