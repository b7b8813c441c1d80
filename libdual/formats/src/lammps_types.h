#pragma once

#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "lammps_lines.h"
#include "trivalent/formats/elements.h"

namespace trivalent::dual {

/// The atom types of a LAMMPS data file: their labels, masses and elements.
class LammpsTypes {
 public:
  /// @param n_types   as the header says
  /// @param elements  of types 1, 2, ..., whatever the file says; may be empty
  LammpsTypes(std::int64_t n_types, const std::vector<potentials::Species>& elements)
      : n_types_(n_types), elements_(elements) {}

  /// A row of the section Atom Type Labels.
  void read_label(const LammpsLines& lines);
  /// A row of the section Masses.
  void read_mass(const LammpsLines& lines);

  /// The type of a number from 1 to n_types or a label; none for anything else.
  [[nodiscard]] std::optional<int> find(std::string_view text) const;
  /// The element that the caller, the mass or the label names; a single type without any is carbon.
  [[nodiscard]] std::optional<potentials::Species> element(int type) const;
  [[nodiscard]] std::int64_t size() const { return n_types_; }
  /// What was assumed or cannot be used.
  [[nodiscard]] std::vector<std::string> notes() const;

 private:
  std::int64_t n_types_;
  const std::vector<potentials::Species>& elements_;
  std::map<std::string, int, std::less<>> labels_;
  std::map<int, double> masses_;
};

}  // namespace trivalent::dual
