#include <algorithm>
#include <cctype>
#include <ostream>

#include "text_file.h"
#include "trivalent/dual/lammps_data.h"
#include "trivalent/remesh/whole_file.h"

namespace trivalent::dual {
namespace {

/// LAMMPS expands $, ends words at blanks and quotes, and knows no escapes for them.
void check_file_name(std::string_view name) {
  const auto is_trouble = [](unsigned char c) {
    return c == '"' || c == '\'' || c == '$' || c == '&' || c == '#' || c == ' ' ||
           std::iscntrl(c) != 0;
  };
  if (!name.empty() && std::none_of(name.begin(), name.end(), is_trouble)) return;
  throw InvalidOption(
      concat("write_lammps_check: LAMMPS cannot read a file called ", quoted(name)));
}

void write_setup(std::ostream& out, const LammpsCheckOptions& options) {
  const bool is_molecular = options.style == AtomStyle::molecular;
  out << "units        metal\n"
      << "boundary    ";
  // Shrink-wrapped where free: no atom can be lost.
  for (const bool is_periodic : options.periodic) out << ' ' << (is_periodic ? 'p' : 's');
  out << "\natom_style   " << (is_molecular ? "molecular" : "atomic") << '\n';
  if (is_molecular) {
    // By default LAMMPS leaves out pair forces between bonded atoms, which is all there is here.
    out << "special_bonds lj/coul 1.0 1.0 1.0\n"
        << "bond_style   zero\n";
  }
  out << "read_data    " << options.data_file << '\n';
  if (is_molecular) out << "bond_coeff   *\n";
}

void write_energy(std::ostream& out, const LammpsCheckOptions& options) {
  out << "pair_style   rebo\n"
      << "pair_coeff   * * ${potential} C" << (options.has_hydrogen ? " H" : "") << "\n\n"
      << "compute      energies all pe/atom\n"
      << "compute      total all reduce sum c_energies\n"
      << "thermo_style custom step atoms pe c_total\n"
      << "fix          motion all nve  # nothing moves in 0 steps, but LAMMPS warns without\n"
      << "run          0\n\n"
      << "variable     energy equal pe\n"
      << "variable     energy_per_atom equal pe/atoms\n"
      << "print        \"energy $(v_energy:%.15g) eV, $(v_energy_per_atom:%.15g) eV/atom\"\n";
}

void write_comparison(std::ostream& out, double expected_energy) {
  std::string expected;
  append_real(expected, expected_energy, Digits::seventeen_significant);
  out << "variable     expected equal " << expected << '\n'
      << "variable     difference equal abs(pe-v_expected)/atoms\n"
      // Where atoms all but coincide, energies and their errors from rounded coordinates are huge.
      << "variable     tolerance equal 1e-8+1e-9*abs(v_expected)/atoms\n"
      << "print        \"expected $(v_expected:%.15g) eV; difference $(v_difference:%.3g) "
         "eV/atom\"\n"
      << "if \"$(v_difference) > $(v_tolerance)\" then &\n"
      << "  \"print 'FAILED: LAMMPS finds another energy'\" &\n"
      << "  \"quit 1\"\n"
      << "print        \"passed\"\n";
}

}  // namespace

void write_lammps_check(std::ostream& out, const LammpsCheckOptions& options) {
  check_file_name(options.data_file);
  check_file_name(options.potential_file);
  out << "# Computes the REBO energy of " << options.data_file << ". Run in its folder:\n"
      << "#   lmp -in THIS_FILE\n"
      << "# If the potential file is elsewhere, add: -var potential FILE\n\n"
      << "variable     potential index " << options.potential_file << "\n\n";
  write_setup(out, options);
  write_energy(out, options);
  if (options.expected_energy) write_comparison(out, *options.expected_energy);
}

void write_lammps_check(const std::filesystem::path& path, const LammpsCheckOptions& options) {
  remesh::write_whole_file(path, [&](std::ostream& out) { write_lammps_check(out, options); });
}

}  // namespace trivalent::dual
