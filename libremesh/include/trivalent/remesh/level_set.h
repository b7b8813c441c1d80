#pragma once

#include <functional>
#include <memory>
#include <string>

#include "trivalent/remesh/mesh.h"

namespace trivalent::remesh {

/// A function of x, y and z given as text, such as "cos(x)+cos(y)+cos(z)": + - * / ^, comparisons,
/// sin cos tan exp log sqrt abs min max and others of muParser, and the constant pi.
class Formula {
 public:
  /// @throws InvalidOption if the text is no formula; the message says where and why.
  explicit Formula(const std::string& text);
  ~Formula();
  Formula(Formula&&) noexcept;
  Formula& operator=(Formula&&) noexcept;
  Formula(const Formula&) = delete;
  Formula& operator=(const Formula&) = delete;

  /// Not by several threads at once.
  [[nodiscard]] double operator()(const Eigen::Vector3d& p) const;

 private:
  struct Parser;
  std::unique_ptr<Parser> parser_;
};

/// The value of a formula without variables, such as "2*pi".
///
/// @throws InvalidOption if the text is no formula, or its value is not finite.
[[nodiscard]] double number_of_formula(const std::string& text);

using ScalarField = std::function<double(const Eigen::Vector3d&)>;

/// Triangulates the surface on which a smooth function has a value; it is lower inside.
///
/// @param lattice      Under which the function repeats. If nothing is periodic, the surface must
///   be closed within the box of the cell vectors around the origin.
/// @param edge_length  Mean edge length of the triangles, > 0; well below all features of the
///   surface.
/// @throws InvalidMesh if there is no such surface, a value is not finite, the function does not
///   repeat or jumps across the level, the surface leaves the box, or it touches itself.
[[nodiscard]] TriMesh level_set(const ScalarField& field, double level, const Lattice& lattice,
                                double edge_length);

}  // namespace trivalent::remesh
