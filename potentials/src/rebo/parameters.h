#pragma once

#include <array>
#include <span>

#include "rebo/splines.h"
#include "trivalent/potentials/atoms.h"

/// Numbers of the second-generation REBO potential and of the bonded part of AIREBO as they are
/// printed, except pi_splines and dihedral_spline: these hold half of the printed values, as LAMMPS
/// does, since they are added to the bond order outside of its factor 1/2.
///
/// Units: Å, eV, and their powers. Sources: [Brenner2002] and [Stuart2000] as they are evaluated by
/// LAMMPS [LAMMPS], whose digits are kept where print and program differ.
namespace trivalent::potentials::rebo_detail {

/// Where a switching function goes from one to zero.
struct Range {
  double begin;  ///< 1 up to here
  double end;    ///< 0 from here on
};

/// Constants of the bonds between two elements [Brenner2002, Tables 2, 6, 7].
struct BondParameters {
  Range cutoff;                ///< D_min, D_max [Å]
  Range dihedral_cutoff;       ///< the same in the dihedral term [Stuart2000]
  double Q;                    ///< screening length [Å]
  double A;                    ///< [eV]
  double alpha;                ///< [1/Å]
  std::array<double, 3> B;     ///< [eV]
  std::array<double, 3> beta;  ///< [1/Å]
  double preferred_length;     ///< ρ in the exponent λ of angles at a hydrogen [Å]
};

/// One stretch of an angular function: Σ c[n] cosθ^n up to `end`.
struct AngularPiece {
  double end;  ///< largest cosθ
  std::array<double, 6> c;
};

/// Everything that differs between the parameterizations.
struct Parameters {
  std::array<BondParameters, 3> bonds;  ///< CC, CH, HH
  BicubicSpline p_cc;                   ///< P of a carbon with a carbon at the other end
  BicubicSpline p_ch;                   ///< P of a carbon with a hydrogen at the other end

  [[nodiscard]] const BondParameters& bond(Species a, Species b) const {
    return bonds[static_cast<std::size_t>(a) + static_cast<std::size_t>(b)];
  }
};

/// [Brenner2002], as LAMMPS `pair_style rebo` has it.
extern const Parameters brenner_2002;
/// Bonded part of [Stuart2000], as LAMMPS `pair_style airebo` has it.
extern const Parameters stuart_2000;

/// Constants between two elements that are not bonded [Stuart2000, Tables 2, 3].
struct NonbondedParameters {
  double epsilon;    ///< [eV]
  double sigma;      ///< [Å]
  Range approach;    ///< where Lennard-Jones depends on the bond order the two would have [Å]
  Range bond_order;  ///< where that bond order turns it off
  double torsion;    ///< depth of the torsion between ends of these elements [eV]
};

/// CC, CH, HH.
extern const std::array<NonbondedParameters, 3> nonbonded_2000;
/// Lennard-Jones energies are switched off here, in units of σ (LAMMPS).
constexpr Range nonbonded_end = {2.16, 3.0};

/// Longest cutoff of all bonds [Å].
constexpr double longest_bond = 2.0;

/// Angular functions of carbon, [Brenner2002, Table 3]: few neighbors (γ_C) and many (G_C).
extern const std::array<AngularPiece, 4> g_carbon_few;
extern const std::array<AngularPiece, 4> g_carbon_many;
/// Angular function of hydrogen, [Brenner2002, Table 6].
extern const std::array<AngularPiece, 3> g_hydrogen;
/// Coordination from which on carbon's angular function is that of many neighbors.
constexpr Range g_carbon_switch = {3.2, 3.7};
/// Coordination of a neighbor from which on it is not conjugated.
constexpr Range conjugation_switch = {2.0, 3.0};
/// Steepness of the exponent λ at a hydrogen [1/Å].
constexpr double hydrogen_lambda = 4.0;

/// π of CC, CH and HH bonds, [Brenner2002, Tables 4, 9, 10]; half of what is printed there.
extern const std::array<TricubicSpline, 3> pi_splines;
/// T of the dihedral term of CC bonds, [Brenner2002, Table 5]; half of what is printed there.
extern const TricubicSpline dihedral_spline;
/// The dihedral term leaves out angles whose cosine is below `end`, smoothly down to `begin`.
constexpr Range straight_angle = {-1.0, -0.995};

}  // namespace trivalent::potentials::rebo_detail
