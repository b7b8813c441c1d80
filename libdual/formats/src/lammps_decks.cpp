#include <algorithm>
#include <cctype>
#include <cmath>
#include <ostream>

#include "trivalent/formats/lammps_deck.h"
#include "trivalent/formats/text_file.h"

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
      concat("write_lammps_deck: LAMMPS cannot read a file called ", in_quotes(name)));
}

void check_arguments(std::string_view arguments) {
  std::vector<std::string_view> words;
  split_fields(arguments, words);  // at blanks and tabs: a line break is trouble
  if (words.empty()) throw InvalidOption("write_lammps_deck: a pair_style or pair_coeff is empty");
  for (const std::string_view word : words) check_file_name(word);
}

void check_options(const LammpsDeckOptions& options) {
  if (options.data_files.empty()) {
    throw InvalidOption("write_lammps_deck: there is no data file to read");
  }
  for (const std::string& name : options.data_files) check_file_name(name);
  check_file_name(options.potential_file);
  if (!options.pair_style) return;
  check_arguments(options.pair_style->style);
  for (const std::string& coefficients : options.pair_style->coefficients) {
    check_arguments(coefficients);
  }
}

void write_head(std::ostream& out, std::string_view purpose, const LammpsDeckOptions& options) {
  out << "# " << purpose << "\n# Run in this folder:  lmp -in THIS_FILE\n";
  if (!options.pair_style) {
    out << "# If the potential file is elsewhere, add:  -var potential FILE\n";
  }
  const bool has_one_file = options.data_files.size() == 1;
  if (has_one_file) out << "# To read other data, add:  -var data FILE\n";
  out << '\n';
  if (!options.pair_style) {
    out << "variable     potential index " << options.potential_file << '\n';
  }
  if (has_one_file) out << "variable     data index " << options.data_files.front() << '\n';
  out << '\n';
}

void write_data_commands(std::ostream& out, const LammpsDeckOptions& options) {
  if (options.data_files.size() == 1) {
    out << "read_data    ${data}\n";
    return;
  }
  for (const std::string& name : options.data_files) {
    const bool is_first = &name == &options.data_files.front();
    out << "read_data    " << name << (is_first ? "\n" : " add merge\n");
  }
}

// Units, boundaries, the atoms and the potential.
void write_system(std::ostream& out, const LammpsDeckOptions& options) {
  const bool is_molecular = options.style == AtomStyle::molecular;
  const bool has_angles = is_molecular && options.angles;
  out << "units        metal\n"
      << "boundary    ";
  // Where free, the box grows with the atoms, so that none is lost; it does not shrink to nothing
  // around a flat sheet.
  for (const bool is_periodic : options.periodic) out << ' ' << (is_periodic ? 'p' : 'm');
  out << "\natom_style   " << (is_molecular ? "molecular" : "atomic") << '\n';
  if (is_molecular) {
    // By default LAMMPS leaves out pair forces between bonded atoms, which is all there is here.
    out << "special_bonds lj/coul 1.0 1.0 1.0\n"
        << "bond_style   zero\n";
  }
  if (has_angles) out << "angle_style  zero\n";
  write_data_commands(out, options);
  if (is_molecular) out << "bond_coeff   *\n";
  if (has_angles) out << "angle_coeff  *\n";
  if (options.pair_style) {
    out << "pair_style   " << options.pair_style->style << '\n';
    for (const std::string& coefficients : options.pair_style->coefficients) {
      out << "pair_coeff   " << coefficients << '\n';
    }
    out << '\n';
    return;
  }
  const bool is_rebo = options.potential == LammpsPotential::rebo;
  out << "pair_style   " << (is_rebo ? "rebo" : "airebo 3.0 1 1") << "\n"
      << "pair_coeff   * * ${potential} C" << (options.has_hydrogen ? " H" : "") << "\n\n";
}

void write_energy(std::ostream& out) {
  out << "compute      energies all pe/atom\n"
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

// Counts the neighbors that REBO takes for bonded: the middle of its switching range [Brenner2002].
void write_coordination(std::ostream& out) {
  out << "compute      bonds all coord/atom cutoff 1.85\n"
      << "compute      fewest all reduce min c_bonds\n"
      << "compute      most all reduce max c_bonds\n";
}

bool is_cluster(const LammpsDeckOptions& options) {
  return std::ranges::find(options.periodic, true) == options.periodic.end();
}

void write_warm_up(std::ostream& out, const LammpsDeckOptions& options) {
  out << "variable     temperature index 300  # [K]\n"
      << "variable     warm_up index 1000     # steps\n"
      << "variable     steps index 2000\n"
      << "variable     seed index 4711\n"
      << "timestep     0.0005                 # [ps]\n"
      << "thermo       100\n"
      << "thermo_style custom step temp pe ke etotal press c_fewest c_most\n"
      << "thermo_modify lost error\n"
      << "compute      energies all pe/atom\n"
      << "dump         positions all custom 500 md.dump id type x y z c_energies\n"
      << "restart      1000 md.restart.1 md.restart.2\n\n"
      // Atoms at rest share what they are given between motion and bonds.
      << "velocity     all create $(2.0*v_temperature) ${seed} mom yes rot "
      << (is_cluster(options) ? "yes" : "no") << " dist gaussian\n"
      << "fix          motion all nvt temp ${temperature} ${temperature} 0.05\n"
      << "run          ${warm_up}\n"
      << "unfix        motion\n\n";
}

void write_dynamics(std::ostream& out) {
  out << "variable     begin equal $(etotal:%.15g)\n"
      << "fix          motion all nve\n"
      << "run          ${steps}\n"
      << "variable     drift equal (etotal-v_begin)/atoms/(v_steps*dt)\n"
      << "print        \"energy drift $(v_drift:%.3g) eV/atom/ps over ${steps} steps at constant "
         "energy\"\n"
      << "print        \"neighbors of an atom: $(c_fewest) to $(c_most)\"\n"
      << "write_restart md.restart\n";
}

// Ids from 1, consecutive ones as first:last.
void write_fixed_atoms(std::ostream& out, const std::vector<std::uint32_t>& fixed) {
  if (fixed.empty()) return;
  for (std::size_t begin = 0; begin < fixed.size();) {
    std::size_t end = begin + 1;
    while (end < fixed.size() && fixed[end] == fixed[end - 1] + 1) ++end;
    out << "group        fixed id " << fixed[begin] + 1 << ':' << fixed[end - 1] + 1 << '\n';
    begin = end;
  }
  out << "fix          hold fixed setforce 0.0 0.0 0.0\n";
}

void write_box_relaxation(std::ostream& out, const std::array<bool, 3>& periodic, bool has_tilts) {
  out << "fix          box all box/relax";
  for (const std::size_t axis : {0, 1, 2}) {
    if (periodic[axis]) out << ' ' << "xyz"[axis] << " 0.0";
  }
  // A tilt leads from its second axis towards the first.
  if (has_tilts && periodic[1]) out << " xy 0.0";
  if (has_tilts && periodic[2]) out << " xz 0.0 yz 0.0";
  out << "\n";
}

void write_minimize(std::ostream& out, const LammpsDeckOptions& options,
                    const LammpsMinimization& minimization) {
  write_fixed_atoms(out, minimization.fixed);
  if (minimization.relax_box) {
    write_box_relaxation(out, options.periodic, minimization.has_tilts);
  }
  std::string force;
  // LAMMPS looks at components.
  append_real(force, minimization.max_force / std::sqrt(3.0), Digits::seventeen_significant);
  out << "min_style    " << minimization.style << '\n'
      << "min_modify   dmax 0.1 norm max\n"
      << "minimize     0.0 " << force << ' ' << minimization.max_steps << ' '
      << 10 * static_cast<std::int64_t>(minimization.max_steps) << '\n';
  if (minimization.relax_box) out << "unfix        box\n";
  if (!minimization.fixed.empty()) out << "unfix        hold\n";
}

void write_handover(std::ostream& out) {
  out << "dump         result all custom 1 result.dump id xu yu zu fx fy fz c_energies\n"
      << "dump_modify  result sort id format float %.17g\n"
      << "run          0 post no\n"
      << "print        \"box $(xlo:%.17g) $(ylo:%.17g) $(zlo:%.17g) $(xhi:%.17g) $(yhi:%.17g) "
         "$(zhi:%.17g) $(xy:%.17g) $(xz:%.17g) $(yz:%.17g)\"\n";
}

}  // namespace

std::string file_name_of(LammpsPotential potential) {
  return potential == LammpsPotential::airebo ? "CH.airebo" : "CH.rebo";
}

void write_lammps_check(std::ostream& out, const LammpsDeckOptions& options) {
  check_options(options);
  write_head(out,
             options.expected_energy
                 ? "Computes the energy and compares it with the one found by trivalent."
                 : "Computes the energy once.",
             options);
  write_system(out, options);
  write_energy(out);
  if (options.expected_energy) write_comparison(out, *options.expected_energy);
}

void write_lammps_relaxation(std::ostream& out, const LammpsDeckOptions& options) {
  check_options(options);
  write_head(out, "Relaxes the atoms; writes relaxed.data.", options);
  write_system(out, options);
  write_coordination(out);
  out << "thermo       100\n"
      << "thermo_style custom step pe fnorm fmax c_fewest c_most\n"
      << "min_style    cg\n"
      << "min_modify   dmax 0.05 line quadratic norm max\n"
      << "minimize     0.0 1e-3 10000 100000  # until no force is above 1e-3 eV/Å\n\n"
      << "print        \"energy $(pe/atoms:%.10g) eV/atom, largest force component $(fmax:%.3g) "
         "eV/Å\"\n"
      << "print        \"neighbors of an atom: $(c_fewest) to $(c_most)\"\n"
      << "write_data   relaxed.data nocoeff\n";
}

void write_lammps_dynamics(std::ostream& out, const LammpsDeckOptions& options) {
  check_options(options);
  write_head(out, "Molecular dynamics: warms up to a temperature, then keeps the energy.", options);
  write_system(out, options);
  write_coordination(out);
  write_warm_up(out, options);
  write_dynamics(out);
}

void write_lammps_minimization(std::ostream& out, const LammpsDeckOptions& options,
                               const LammpsMinimization& minimization) {
  check_options(options);
  write_head(out, "Minimizes the energy and writes the result for trivalent.", options);
  write_system(out, options);
  if (minimization.ranks > 1) out << "comm_style   tiled\nbalance      1.1 rcb\n";
  out << "compute      energies all pe/atom\n"
      << "thermo       10\n"
      << "thermo_style custom step pe fmax\n"
      << "thermo_modify norm no format float %.15g\n";
  if (minimization.max_steps > 0) write_minimize(out, options, minimization);
  write_handover(out);
}

}  // namespace trivalent::dual
