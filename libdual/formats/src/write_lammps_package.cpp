#include <ostream>

#include "gzip_stream.h"
#include "trivalent/dual/check_atoms.h"
#include "trivalent/formats/lammps_deck.h"
#include "trivalent/formats/lammps_frame.h"
#include "trivalent/formats/lammps_package.h"
#include "trivalent/formats/text_file.h"
#include "trivalent/remesh/whole_file.h"

namespace trivalent::dual {
namespace {

namespace fs = std::filesystem;

void write_data_file(const fs::path& path, const Structure& structure,
                     const LammpsDataOptions& options, Compression compression) {
  if (compression == Compression::none) {
    write_lammps_data(path, structure, options);
    return;
  }
  remesh::write_whole_file(path, [&](std::ostream& file) {
    GzipBuffer buffer(file);
    std::ostream out(&buffer);
    write_lammps_data(out, structure, options);
    buffer.finish();
  });
}

std::vector<std::string> write_data_files(const fs::path& folder, const Structure& structure,
                                          const LammpsPackageOptions& options) {
  const std::size_t n_atoms = structure.atoms.size();
  const std::string extension = options.compression == Compression::gzip ? ".data.gz" : ".data";
  if (n_atoms <= options.atoms_per_file) {
    write_data_file(folder / (options.name + extension), structure, options.data,
                    options.compression);
    return {options.name + extension};
  }
  std::vector<std::string> names;
  for (std::size_t begin = 0; begin < n_atoms; begin += options.atoms_per_file) {
    LammpsDataOptions part = options.data;
    part.part = AtomRange{begin, std::min(begin + options.atoms_per_file, n_atoms)};
    names.push_back(concat(options.name, '.', names.size() + 1, extension));
    write_data_file(folder / names.back(), structure, part, options.compression);
  }
  return names;
}

void write_rotation(std::ostream& out, const Eigen::Matrix3d& rotation) {
  out << "LAMMPS takes boxes with the first cell vector along x and the second in the xy plane. "
         "The "
         "atoms\nwere rotated to it; a vector x of the original is R x here:\n\n";
  for (int row = 0; row < 3; ++row) {
    std::string line = "    ";
    for (int column = 0; column < 3; ++column) {
      line += column > 0 ? " " : "";
      append_real(line, rotation(row, column), Digits::seventeen_significant);
    }
    out << line << '\n';
  }
  out << '\n';
}

void write_readme(std::ostream& out, const LammpsDeckOptions& deck, const LammpsFrame& frame) {
  const std::size_t n_atoms = frame.atoms.size();
  out << "# " << n_atoms << " atoms for LAMMPS\n\n"
      << "| file | what it does |\n|---|---|\n| ";
  for (const std::string& name : deck.data_files) {
    out << (&name == &deck.data_files.front() ? "`" : ", `") << name << '`';
  }
  out << " | the atoms |\n"
      << "| `in.check` | computes the energy"
      << (deck.expected_energy ? " and compares it with the one found by trivalent; ends with "
                                 "status 1 if they differ |\n"
                               : " once |\n")
      << "| `in.relax` | minimizes the energy, writes `relaxed.data` |\n"
      << "| `in.md` | 300 K: 1,000 steps to warm up, 2,000 at constant energy; writes `md.dump` "
         "and "
         "restart files |\n\n"
      << "One process, or several with MPI:\n\n"
      << "    lmp -in in.check\n    mpirun -np 4 lmp -in in.check\n\n";
  if (frame.is_rotated()) write_rotation(out, frame.rotation);
  if (deck.data_files.size() == 1) {
    out << "From the relaxed atoms, hotter and longer:\n\n"
        << "    lmp -in in.md -var data relaxed.data -var temperature 1000 -var steps 100000\n\n";
  }
  if (deck.pair_style) {
    out << "The potential is `pair_style " << deck.pair_style->style
        << "`. LAMMPS looks for its files here and in the folder `LAMMPS_POTENTIALS`; `lmp -help` "
           "lists the pair styles that it was built with.\n\n";
  } else {
    out << "The potential file `" << deck.potential_file
        << "` comes with LAMMPS. LAMMPS looks for it here and in the "
           "folder "
           "`LAMMPS_POTENTIALS`\n(Debian: `/usr/share/lammps/potentials`); `-var potential FILE` "
           "names "
           "another place.\n\n";
  }
  out << "Relax before dynamics: bonds of an unrelaxed shell scatter, and start with much too much "
         "energy.\n\n"
      << "## Many processes\n\n"
      << "- One process reads the data file. Read it once, `write_restart`, and go on from there "
         "with `read_restart`.\n"
      << "- A shell is hollow: `comm_style tiled` and `balance 1.1 rcb` after `read_data` give "
         "every "
         "process its share.\n"
      << "- `pair_style rebo` and `airebo` have no KOKKOS variant. Where LAMMPS has the packages "
         "OPENMP or "
         "INTEL, "
         "`-sf omp` or\n  `-sf intel` use them; otherwise one MPI process per core.\n"
      << "- Hydrogen vibrates twice as fast as carbon: halve the time step in `in.md`.\n";
}

}  // namespace

LammpsPackage write_lammps_package(const fs::path& folder, const Structure& structure,
                                   double energy, const LammpsPackageOptions& options) {
  if (options.atoms_per_file == 0) {
    throw InvalidOption("write_lammps_package: atoms_per_file is 0; it must be >= 1");
  }
  if (options.data.style == AtomStyle::molecular && structure.bonds.empty()) {
    throw InvalidOption("write_lammps_package: atom_style molecular needs bonds; there are none");
  }
  const LammpsFrame frame = lammps_frame(structure.atoms);
  const Structure turned = {.atoms = frame.atoms, .bonds = structure.bonds};
  std::vector<std::string> names = write_data_files(folder, turned, options);
  LammpsDeckOptions deck = {
      .data_files = names,
      .style = options.data.style,
      .angles = options.data.angles,
      .periodic = structure.atoms.box.periodic,
      .has_hydrogen = has_hydrogen(structure.atoms),
      .potential = options.potential,
      .potential_file = options.potential_file.value_or(file_name_of(options.potential)),
      .pair_style = options.pair_style};
  if (!options.pair_style) deck.expected_energy = energy;
  const auto write = [&](const std::string& name, const auto& contents) {
    remesh::write_whole_file(folder / name, contents);
    names.push_back(name);
  };
  write("in.check", [&](std::ostream& out) { write_lammps_check(out, deck); });
  write("in.relax", [&](std::ostream& out) { write_lammps_relaxation(out, deck); });
  write("in.md", [&](std::ostream& out) { write_lammps_dynamics(out, deck); });
  write("README.md", [&](std::ostream& out) { write_readme(out, deck, frame); });
  return {.files = std::move(names), .rotation = frame.rotation};
}

}  // namespace trivalent::dual
