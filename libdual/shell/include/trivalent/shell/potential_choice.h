#pragma once

#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>

#include "trivalent/dual/structure.h"
#include "trivalent/formats/lammps_deck.h"
#include "trivalent/potentials/lennard_jones.h"
#include "trivalent/potentials/potential.h"
#include "trivalent/shell/lammps_run.h"

namespace trivalent::shell {

/// A potential by its name, with the parameters of those that take any.
struct PotentialChoice {
  std::string name = "rebo";  ///< one of known_potentials()
  potentials::LennardJonesOptions lennard_jones = {};
  std::optional<dual::PairStyle> pair_style = {};  ///< instead: one that only LAMMPS computes

  /// As results name it.
  [[nodiscard]] std::string title() const {
    return pair_style ? "pair_style " + pair_style->style : name;
  }
};

/// What can be chosen.
struct KnownPotential {
  std::string_view name;
  std::string_view meaning;
  std::unique_ptr<potentials::Potential> (*make)(const PotentialChoice& choice);
  std::optional<dual::LammpsPotential> lammps;  ///< the same in LAMMPS, if we ask it for that
};

/// The first is the default.
[[nodiscard]] std::span<const KnownPotential> known_potentials();

/// @throws dual::InvalidOption if there is no such potential.
[[nodiscard]] const KnownPotential& find_potential(const PotentialChoice& choice);

/// @throws dual::InvalidOption, potentials::InvalidOption if there is no such potential, a
///   parameter is out of its range, or only LAMMPS computes it.
[[nodiscard]] std::unique_ptr<potentials::Potential> make_potential(const PotentialChoice& choice);

/// Options with which LAMMPS computes the same.
///
/// @param caller  for the message
/// @throws dual::InvalidOption if LAMMPS is not asked for the potential.
[[nodiscard]] LammpsOptions lammps_options(std::string_view caller, const PotentialChoice& choice,
                                           LammpsOptions options);

/// Name and parameters with every bit: equal for equal potentials.
[[nodiscard]] std::string exact_text(const PotentialChoice& choice);

/// Energy of an atom of graphene at rest under the potential [eV]; under lj, which makes no bonds,
/// at REBO's bond length; 0 if only LAMMPS computes it.
[[nodiscard]] double graphene_reference(const PotentialChoice& choice);

/// Mean bond length to build shells with [Å]: about that of graphene under the potential.
[[nodiscard]] double usual_bond_length(const PotentialChoice& choice);

/// Whether energies may be compared with those of graphene under REBO.
[[nodiscard]] bool is_rebo(const PotentialChoice& choice);

/// Says in the header entry `potential` what a structure's energies are of. REBO, which is taken
/// where nothing is said, is not named.
///
/// @param title  PotentialChoice::title()
void set_potential(dual::Structure& structure, const std::string& title);

/// Title of the potential that a structure's header names; none if it names none.
[[nodiscard]] std::optional<std::string> potential_title(const dual::Structure& structure);

/// The potential that a structure's header names, if that says all about it: rebo or airebo.
[[nodiscard]] std::optional<PotentialChoice> named_potential(const dual::Structure& structure);

}  // namespace trivalent::shell
