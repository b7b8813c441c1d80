#include <algorithm>
#include <cmath>
#include <ostream>

#include "check_atoms.h"
#include "species_data.h"
#include "text_file.h"
#include "trivalent/dual/lammps_data.h"
#include "trivalent/remesh/whole_file.h"

namespace trivalent::dual {
namespace {

using potentials::Atoms;
using potentials::Box;

bool has_hydrogen(const Atoms& atoms) {
  return std::find(atoms.species.begin(), atoms.species.end(), potentials::Species::hydrogen) !=
         atoms.species.end();
}

int type_of(potentials::Species species) { return species == potentials::Species::carbon ? 1 : 2; }

bool writes_bonds(const LammpsData& data, const LammpsDataOptions& options) {
  return options.style == AtomStyle::molecular && !data.bonds.empty();
}

void check_box(const Box& box) {
  const Eigen::Matrix3d& cell = box.cell;
  const bool is_finite = cell.allFinite() && box.origin.allFinite();
  const bool is_upper_triangular = cell(1, 0) == 0.0 && cell(2, 0) == 0.0 && cell(2, 1) == 0.0;
  if (!is_finite || !is_upper_triangular || cell.diagonal().minCoeff() <= 0.0) {
    throw InvalidOption(
        "write_lammps_data: the box must have its first vector along x, the second in "
        "the xy plane, and be right-handed; rotate atoms and box first");
  }
  const bool has_large_tilt = std::abs(cell(0, 1)) > 0.5 * cell(0, 0) ||
                              std::abs(cell(0, 2)) > 0.5 * cell(0, 0) ||
                              std::abs(cell(1, 2)) > 0.5 * cell(1, 1);
  if (has_large_tilt) {
    throw InvalidOption(
        "write_lammps_data: a tilt is more than half a box side; choose shorter, "
        "equivalent cell vectors");
  }
}

void check_bonds(const LammpsData& data) {
  const int n_atoms = static_cast<int>(data.atoms.size());
  for (const auto& [first, second] : data.bonds) {
    if (std::min(first, second) >= 0 && std::max(first, second) < n_atoms) continue;
    throw InvalidNetwork(concat("write_lammps_data: a bond joins atoms ", first, " and ", second,
                                "; there are the atoms 0 to ", n_atoms - 1));
  }
}

void check_title(const std::string& title) {
  // LAMMPS reads lines of up to 254 characters.
  if (title.size() <= 200 && title.find_first_of("\r\n") == std::string::npos) return;
  throw InvalidOption("write_lammps_data: the title must be one line of at most 200 characters");
}

void write_counts(std::ostream& out, const LammpsData& data, const LammpsDataOptions& options) {
  out << "LAMMPS data file: " << options.title << "\n\n";
  out << data.atoms.size() << " atoms\n";
  if (writes_bonds(data, options)) out << data.bonds.size() << " bonds\n";
  out << (has_hydrogen(data.atoms) ? 2 : 1) << " atom types\n";
  if (writes_bonds(data, options)) out << "1 bond types\n";
  out << '\n';
}

void write_box(std::ostream& out, const Box& box) {
  constexpr std::array axes = {'x', 'y', 'z'};
  std::string line;
  for (int i = 0; i < 3; ++i) {
    append_real(line, box.origin[i], Digits::seventeen_significant);
    line += ' ';
    append_real(line, box.origin[i] + box.cell(i, i), Digits::seventeen_significant);
    line += concat(' ', axes[i], "lo ", axes[i], "hi\n");
  }
  const bool is_tilted = box.cell(0, 1) != 0.0 || box.cell(0, 2) != 0.0 || box.cell(1, 2) != 0.0;
  if (is_tilted) {
    for (const double tilt : {box.cell(0, 1), box.cell(0, 2), box.cell(1, 2)}) {
      append_real(line, tilt, Digits::seventeen_significant);
      line += ' ';
    }
    line += "xy xz yz\n";
  }
  out << line << '\n';
}

void write_masses(std::ostream& out, const Atoms& atoms) {
  out << "Masses\n\n";
  for (const SpeciesData& known : known_species) {
    const int type = type_of(known.species);
    // Exactly as many rows as atom types, or LAMMPS refuses the file.
    if (type == 2 && !has_hydrogen(atoms)) continue;
    out << type << ' ' << known.mass << " # " << known.symbol << '\n';
  }
  out << '\n';
}

void write_atoms(std::ostream& out, const Atoms& atoms, const LammpsDataOptions& options) {
  const bool is_molecular = options.style == AtomStyle::molecular;
  out << "Atoms # " << (is_molecular ? "molecular" : "atomic") << "\n\n";
  std::string line;
  for (std::size_t i = 0; i < atoms.size(); ++i) {
    line.clear();
    append_integer(line, static_cast<std::int64_t>(i) + 1);
    if (is_molecular) line += " 1";
    line += ' ';
    append_integer(line, type_of(atoms.species[i]));
    for (const double coordinate : atoms.positions[i]) {
      line += ' ';
      append_real(line, coordinate, options.digits);
    }
    line += '\n';
    out.write(line.data(), static_cast<std::streamsize>(line.size()));
  }
}

void write_bonds(std::ostream& out, const std::vector<std::array<int, 2>>& bonds) {
  out << "\nBonds\n\n";
  std::string line;
  for (std::size_t i = 0; i < bonds.size(); ++i) {
    line.clear();
    append_integer(line, static_cast<std::int64_t>(i) + 1);
    line += " 1 ";
    append_integer(line, bonds[i][0] + 1);
    line += ' ';
    append_integer(line, bonds[i][1] + 1);
    line += '\n';
    out.write(line.data(), static_cast<std::streamsize>(line.size()));
  }
}

}  // namespace

void write_lammps_data(std::ostream& out, const LammpsData& data,
                       const LammpsDataOptions& options) {
  const Box box = box_to_write(data.atoms);
  check_atoms("write_lammps_data", data.atoms);
  check_bonds(data);
  check_box(box);
  check_title(options.title);
  write_counts(out, data, options);
  write_box(out, box);
  write_masses(out, data.atoms);
  write_atoms(out, data.atoms, options);
  if (writes_bonds(data, options)) write_bonds(out, data.bonds);
}

void write_lammps_data(const std::filesystem::path& path, const LammpsData& data,
                       const LammpsDataOptions& options) {
  remesh::write_whole_file(path, [&](std::ostream& out) { write_lammps_data(out, data, options); });
}

}  // namespace trivalent::dual
