#include "lammps_lines.h"

#include <algorithm>
#include <array>

namespace trivalent::dual {
namespace {

/// All that LAMMPS's read_data knows, but for those that a fix adds.
constexpr std::array<std::string_view, 31> section_names = {"Atoms",
                                                            "Velocities",
                                                            "Masses",
                                                            "Ellipsoids",
                                                            "Lines",
                                                            "Triangles",
                                                            "Bodies",
                                                            "Bonds",
                                                            "Angles",
                                                            "Dihedrals",
                                                            "Impropers",
                                                            "Atom Type Labels",
                                                            "Bond Type Labels",
                                                            "Angle Type Labels",
                                                            "Dihedral Type Labels",
                                                            "Improper Type Labels",
                                                            "Pair Coeffs",
                                                            "PairIJ Coeffs",
                                                            "Bond Coeffs",
                                                            "Angle Coeffs",
                                                            "Dihedral Coeffs",
                                                            "Improper Coeffs",
                                                            "BondBond Coeffs",
                                                            "BondAngle Coeffs",
                                                            "MiddleBondTorsion Coeffs",
                                                            "EndBondTorsion Coeffs",
                                                            "AngleTorsion Coeffs",
                                                            "AngleAngleTorsion Coeffs",
                                                            "BondBond13 Coeffs",
                                                            "AngleAngle Coeffs",
                                                            "Molecules"};

}  // namespace

bool LammpsLines::advance() {
  while (const auto line = lines_.next()) {
    const std::size_t hash = std::min(line->find('#'), line->size());
    comment_ = line->substr(std::min(hash + 1, line->size()));
    split_fields(line->substr(0, hash), fields_);
    if (!fields_.empty()) return true;
  }
  return false;
}

std::string LammpsLines::words_from(std::size_t first) const {
  std::string words;
  for (std::size_t i = first; i < fields_.size(); ++i) {
    words += concat(i > first ? " " : "", fields_[i]);
  }
  return words;
}

bool LammpsLines::is_section_name() const {
  return begins_with_letter() &&
         std::ranges::find(section_names, words_from(0)) != section_names.end();
}

}  // namespace trivalent::dual
