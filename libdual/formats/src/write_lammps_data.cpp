#include <algorithm>
#include <cmath>
#include <ostream>

#include "species_data.h"
#include "trivalent/dual/check_atoms.h"
#include "trivalent/formats/lammps_data.h"
#include "trivalent/formats/text_file.h"
#include "trivalent/remesh/whole_file.h"

namespace trivalent::dual {
namespace {

using potentials::Atoms;
using potentials::Box;

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

void check_part(const LammpsData& data, const LammpsDataOptions& options) {
  if (!options.part) return;
  if (options.part->begin > options.part->end || options.part->end > data.atoms.size()) {
    throw InvalidOption(concat("write_lammps_data: the part ", options.part->begin, " to ",
                               options.part->end, " is not within the ", data.atoms.size(),
                               " atoms"));
  }
  if (options.style == AtomStyle::molecular) {
    throw InvalidOption(
        "write_lammps_data: bonds cannot be written in parts; use atomic style, or one file");
  }
}

AtomRange part_of(const LammpsData& data, const LammpsDataOptions& options) {
  return options.part.value_or(AtomRange{0, data.atoms.size()});
}

// All pairs of bonds at an atom, with the atom in the middle; ordered by that atom.
std::vector<std::array<int, 3>> angles_of(const LammpsData& data) {
  std::vector<std::vector<int>> neighbors(data.atoms.size());
  for (const auto& [first, second] : data.bonds) {
    neighbors[static_cast<std::size_t>(first)].push_back(second);
    neighbors[static_cast<std::size_t>(second)].push_back(first);
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

void write_counts(std::ostream& out, const LammpsData& data, const LammpsDataOptions& options,
                  std::size_t n_angles) {
  const auto [begin, end] = part_of(data, options);
  out << "LAMMPS data file: " << options.title << "\n\n";
  out << end - begin << " atoms\n";
  if (writes_bonds(data, options)) out << data.bonds.size() << " bonds\n";
  if (n_angles > 0) out << n_angles << " angles\n";
  out << (has_hydrogen(data.atoms) ? 2 : 1) << " atom types\n";
  if (writes_bonds(data, options)) out << "1 bond types\n";
  if (n_angles > 0) out << "1 angle types\n";
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

void write_atoms(std::ostream& out, const LammpsData& data, const LammpsDataOptions& options) {
  const Atoms& atoms = data.atoms;
  const bool is_molecular = options.style == AtomStyle::molecular;
  out << "Atoms # " << (is_molecular ? "molecular" : "atomic") << "\n\n";
  std::string line;
  const auto [begin, end] = part_of(data, options);
  for (std::size_t i = begin; i < end; ++i) {
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
  if (atoms <= most_lammps_atoms) return;
  throw InvalidNetwork(concat("write_lammps_data: ", atoms,
                              " atoms; LAMMPS counts them with 32 bits "
                              "unless it is built with -DLAMMPS_SIZES=bigbig, up to ",
                              most_lammps_atoms, "; make the shell smaller"));
}

void write_lammps_data(std::ostream& out, const LammpsData& data,
                       const LammpsDataOptions& options) {
  require_lammps_ids(data.atoms.size());
  const Box box = box_to_write(data.atoms);
  check_atoms("write_lammps_data", data.atoms);
  check_bonds(data);
  check_box(box);
  check_title(options.title);
  check_part(data, options);
  const bool has_angles = options.angles && writes_bonds(data, options);
  const auto angles = has_angles ? angles_of(data) : std::vector<std::array<int, 3>>{};
  write_counts(out, data, options, angles.size());
  write_box(out, box);
  write_masses(out, data.atoms);
  write_atoms(out, data, options);
  if (writes_bonds(data, options)) write_groups(out, "Bonds", data.bonds);
  if (!angles.empty()) write_groups(out, "Angles", angles);
}

void write_lammps_data(const std::filesystem::path& path, const LammpsData& data,
                       const LammpsDataOptions& options) {
  remesh::write_whole_file(path, [&](std::ostream& out) { write_lammps_data(out, data, options); });
}

}  // namespace trivalent::dual
