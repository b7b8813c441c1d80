#pragma once

#include <cstddef>
#include <cstdint>

// Only plain types here: the files that include this are compiled for newer instruction sets, and
// an inline function of a library compiled along with them could end up in code that runs
// everywhere.
namespace trivalent::potentials::rebo_detail {

/// Coefficients of REBO for a regular atom: a carbon with three carbon neighbors.
struct RegularParameters {
  double Q, A, alpha;
  double B[3];
  double beta[3];
  double knots[3];    ///< ends of all but the last piece of the angular function
  double g[4][6];     ///< its pieces
  double T;           ///< dihedral factor at full conjugation
  double p_constant;  ///< P_CC at two carbon neighbors
};

/// What the kernel reads and writes; arrays as in Candidates.
struct RegularArguments {
  const RegularParameters* parameters;
  const double* positions;       ///< four per point: x, y, z [Å] and one unused
  const std::uint32_t* first;    ///< per atom
  const std::uint32_t* point;    ///< per link
  const std::uint32_t* reverse;  ///< per link
  const std::uint32_t* bonded;   ///< per atom: its three bonds, see pack_bonds
  const std::uint8_t* states;    ///< per atom, see atom_state
  const std::uint32_t* homes;    ///< of points from atom_count on
  std::uint32_t atom_count;
  double* slopes;  ///< four per link: dE/d(separation) [eV/Å] and energy due to the other end [eV]
  double* energies;          ///< per atom, its own share [eV]
  std::uint32_t first_link;  ///< what slopes begins with
  std::uint32_t first_atom;  ///< what energies begins with
};

/// Offsets of an atom's three bonds from its first link, eight bits each.
[[nodiscard]] constexpr std::uint32_t pack_bonds(std::uint32_t a, std::uint32_t b,
                                                 std::uint32_t c) {
  return a | b << 8 | c << 16;
}

/// What is known about an atom, as bits.
namespace atom_state {
constexpr std::uint8_t irregular = 1;  ///< not a carbon with three carbons at full bonds
constexpr std::uint8_t unconjugated =
    2;  ///< irregular, or a neighbor has more than three neighbors
constexpr std::uint8_t has_other_pi = 4;  ///< at the end of a bond from or to an unconjugated atom
}  // namespace atom_state

/// Evaluates `count` regular atoms; adds to the virial (xx, yy, zz, xy, xz, yz) [eV].
using RegularKernel = void (*)(const RegularArguments& arguments, const std::uint32_t* atoms,
                               std::size_t count, double* virial);

/// The kernels of all instruction sets that this machine has, the best one last.
struct RegularKernels {
  RegularKernel kernels[3];
  int count;
};
[[nodiscard]] RegularKernels usable_regular_kernels();

/// The kernel for the best instruction set that this machine has.
[[nodiscard]] RegularKernel best_regular_kernel();

}  // namespace trivalent::potentials::rebo_detail
