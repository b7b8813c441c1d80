#include <algorithm>
#include <cmath>
#include <ostream>

#include "columns_of_text.h"
#include "species_data.h"
#include "trivalent/dual/check_atoms.h"
#include "trivalent/dual/network_checks.h"
#include "trivalent/dual/padded_box.h"
#include "trivalent/dual/walls.h"
#include "trivalent/formats/lammps_data.h"
#include "trivalent/formats/lammps_frame.h"
#include "trivalent/formats/text_file.h"
#include "trivalent/remesh/whole_file.h"

namespace trivalent::dual {
namespace {

using potentials::Atoms;
using potentials::Box;

int type_of(potentials::Species species) { return species == potentials::Species::carbon ? 1 : 2; }

bool writes_bonds(const Structure& structure, const LammpsDataOptions& options) {
  return options.style == AtomStyle::molecular && !structure.bonds.empty();
}

void check_style(const LammpsDataOptions& options) {
  if (options.style == AtomStyle::atomic || options.style == AtomStyle::molecular) return;
  throw InvalidOption("write_lammps_data: atom_style must be atomic or molecular");
}

void check_box(const Box& box) {
  if (fits_lammps(box)) return;
  throw InvalidOption(
      "write_lammps_data: the box must have its first vector along x, the second in the xy plane, "
      "be right-handed, and tilted by at most half a side, only where it is periodic; "
      "lammps_frame() makes it so");
}

void check_part(const Structure& structure, const LammpsDataOptions& options) {
  if (!options.part) return;
  if (options.part->begin > options.part->end || options.part->end > structure.atoms.size()) {
    throw InvalidOption(concat("write_lammps_data: the part ", options.part->begin, " to ",
                               options.part->end, " is not within the ", structure.atoms.size(),
                               " atoms"));
  }
  if (options.style == AtomStyle::molecular) {
    throw InvalidOption(
        "write_lammps_data: bonds cannot be written in parts; use atomic style, or one file");
  }
}

AtomRange range_of(const Structure& structure, const LammpsDataOptions& options) {
  return options.part.value_or(AtomRange{0, structure.atoms.size()});
}

// All pairs of bonds at an atom, with the atom in the middle; ordered by that atom.
std::vector<std::array<int, 3>> angles_of(const Structure& structure) {
  std::vector<std::vector<int>> neighbors(structure.atoms.size());
  for (const potentials::Bond& bond : structure.bonds) {
    neighbors[bond.first].push_back(static_cast<int>(bond.second));
    neighbors[bond.second].push_back(static_cast<int>(bond.first));
  }
  std::vector<std::array<int, 3>> angles;
  for (std::size_t middle = 0; middle < neighbors.size(); ++middle) {
    const std::vector<int>& ends = neighbors[middle];
    for (std::size_t a = 0; a < ends.size(); ++a) {
      for (std::size_t b = a + 1; b < ends.size(); ++b) {
        angles.push_back({ends[a], static_cast<int>(middle), ends[b]});
      }
    }
  }
  return angles;
}

void check_title(const std::string& title) {
  // LAMMPS reads lines of up to 254 characters.
  if (title.size() <= 200 && title.find_first_of("\r\n") == std::string::npos) return;
  throw InvalidOption("write_lammps_data: the title must be one line of at most 200 characters");
}

void write_counts(std::ostream& out, const Structure& structure, const LammpsDataOptions& options,
                  std::size_t n_angles) {
  const auto [begin, end] = range_of(structure, options);
  out << "LAMMPS data file: " << options.title << "\n\n";
  out << end - begin << " atoms\n";
  if (writes_bonds(structure, options)) out << structure.bonds.size() << " bonds\n";
  if (n_angles > 0) out << n_angles << " angles\n";
  out << (has_hydrogen(structure.atoms) ? 2 : 1) << " atom types\n";
  if (writes_bonds(structure, options)) out << "1 bond types\n";
  if (n_angles > 0) out << "1 angle types\n";
  out << '\n';
}

/// A tilt of half a side must not become more than that because the side, as hi - lo, is rounded.
double written_tilt(const Box& box, int row, int column) {
  const double low = box.origin[row];
  const double half = 0.5 * ((low + box.cell(row, row)) - low);
  return std::clamp(box.cell(row, column), -half, half);
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
    for (const auto [row, column] : {std::array{0, 1}, std::array{0, 2}, std::array{1, 2}}) {
      append_real(line, written_tilt(box, row, column), Digits::seventeen_significant);
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

void write_atoms(std::ostream& out, const Structure& structure, const LammpsDataOptions& options) {
  const Atoms& atoms = structure.atoms;
  const bool is_molecular = options.style == AtomStyle::molecular;
  out << "Atoms # " << (is_molecular ? "molecular" : "atomic") << "\n\n";
  const std::vector<int> walls = is_molecular ? walls_of(structure) : std::vector<int>{};
  std::string line;
  const auto [begin, end] = range_of(structure, options);
  for (std::size_t i = begin; i < end; ++i) {
    line.clear();
    append_integer(line, static_cast<std::int64_t>(i) + 1);
    if (is_molecular) {
      line += ' ';
      append_integer(line, walls.empty() ? 1 : walls[i] + 1);
    }
    line += ' ';
    append_integer(line, type_of(atoms.species[i]));
    append_vector(line, atoms.positions[i], options.digits);
    line += '\n';
    out.write(line.data(), static_cast<std::streamsize>(line.size()));
  }
}

std::vector<std::array<int, 2>> pairs_of(const std::vector<potentials::Bond>& bonds) {
  std::vector<std::array<int, 2>> pairs;
  for (const potentials::Bond& bond : bonds) {
    pairs.push_back({static_cast<int>(bond.first), static_cast<int>(bond.second)});
  }
  return pairs;
}

// Bonds or angles, all of type 1.
template <typename Group>
void write_groups(std::ostream& out, std::string_view section, const std::vector<Group>& groups) {
  out << '\n' << section << "\n\n";
  std::string line;
  for (std::size_t i = 0; i < groups.size(); ++i) {
    line.clear();
    append_integer(line, static_cast<std::int64_t>(i) + 1);
    line += " 1";
    for (const int atom : groups[i]) {
      line += ' ';
      append_integer(line, std::int64_t{atom} + 1);
    }
    line += '\n';
    out.write(line.data(), static_cast<std::streamsize>(line.size()));
  }
}

}  // namespace

void require_lammps_ids(std::uint64_t atoms) {
  if (atoms <= max_lammps_atoms) return;
  throw InvalidNetwork(concat("write_lammps_data: ", atoms,
                              " atoms; LAMMPS counts them with 32 bits "
                              "unless it is built with -DLAMMPS_SIZES=bigbig, up to ",
                              max_lammps_atoms, "; make the shell smaller"));
}

void write_lammps_data(std::ostream& out, const Structure& structure,
                       const LammpsDataOptions& options) {
  require_lammps_ids(structure.atoms.size());
  const Box box = box_to_write(structure.atoms);
  check_atoms("write_lammps_data", structure.atoms);
  check_bonds(structure.atoms, structure.bonds);
  check_style(options);
  check_box(box);
  check_title(options.title);
  check_part(structure, options);
  const bool has_angles = options.angles && writes_bonds(structure, options);
  const auto angles = has_angles ? angles_of(structure) : std::vector<std::array<int, 3>>{};
  write_counts(out, structure, options, angles.size());
  write_box(out, box);
  write_masses(out, structure.atoms);
  write_atoms(out, structure, options);
  if (writes_bonds(structure, options)) write_groups(out, "Bonds", pairs_of(structure.bonds));
  if (!angles.empty()) write_groups(out, "Angles", angles);
}

void write_lammps_data(const std::filesystem::path& path, const Structure& structure,
                       const LammpsDataOptions& options) {
  remesh::write_whole_file(path,
                           [&](std::ostream& out) { write_lammps_data(out, structure, options); });
}

}  // namespace trivalent::dual
