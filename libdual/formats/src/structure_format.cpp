#include "trivalent/formats/structure_format.h"

#include <algorithm>
#include <array>
#include <cstdio>
#include <ostream>

#include "gzip_stream.h"
#include "trivalent/dual/columns.h"
#include "trivalent/formats/cif.h"
#include "trivalent/formats/cp2k.h"
#include "trivalent/formats/dftb_gen.h"
#include "trivalent/formats/elements.h"
#include "trivalent/formats/espresso.h"
#include "trivalent/formats/gro.h"
#include "trivalent/formats/gromacs_topology.h"
#include "trivalent/formats/lammps_data.h"
#include "trivalent/formats/lammps_frame.h"
#include "trivalent/formats/mol2.h"
#include "trivalent/formats/pdb.h"
#include "trivalent/formats/poscar.h"
#include "trivalent/formats/xyz.h"
#include "trivalent/remesh/polygon_soup.h"
#include "trivalent/remesh/whole_file.h"

namespace trivalent::dual {
namespace {

/// The name of the file in lower case, without .gz.
std::string plain_name(const std::filesystem::path& path) {
  std::string name = lower_case(path.filename().string());
  if (name.ends_with(".gz")) name.resize(name.size() - 3);
  return name;
}

bool is_compressed(const std::filesystem::path& path) {
  return lower_case(path.extension().string()) == ".gz";
}

/// The rows of a rotation, for the title of a file.
std::string rotation_text(const Eigen::Matrix3d& rotation) {
  std::string text;
  for (int row = 0; row < 3; ++row) {
    for (int column = 0; column < 3; ++column) {
      std::array<char, 16> number = {};
      std::snprintf(number.data(), number.size(), "%.8f", rotation(row, column));
      text += concat(text.empty() ? "" : " ", number.data());
    }
  }
  return text;
}

std::vector<std::string> write_extended_xyz(std::ostream& out, const Structure& structure,
                                            const WriteOptions& options) {
  write_xyz(out, structure, options.digits);
  return {};
}

std::vector<std::string> write_data(std::ostream& out, const Structure& structure,
                                    const WriteOptions& options) {
  std::vector<std::string> notes;
  LammpsDataOptions data = {.style = options.atom_style, .digits = options.digits};
  LammpsFrame frame = lammps_frame(structure.atoms);
  if (frame.is_rotated()) {
    data.title += ", rotated by " + rotation_text(frame.rotation);
    notes.emplace_back(
        "the atoms were rotated to the frame of LAMMPS; the title of the file "
        "gives the rotation");
  }
  if (!frame.combination.isIdentity(0.0)) {
    notes.emplace_back("the cell vectors were replaced by equivalent ones that LAMMPS takes");
  }
  write_lammps_data(out, {.atoms = std::move(frame.atoms), .bonds = structure.bonds}, data);
  return notes;
}

}  // namespace

std::vector<StructureFormat>& structure_formats() {
  static std::vector<StructureFormat> formats = {
      {.name = "extxyz",
       .extensions = {".extxyz", ".xyz"},
       .read = read_xyz,
       .write = write_extended_xyz,
       .holds_selective_dynamics = true},
      {.name = "lammps-data",
       .extensions = {".data", ".lmp", ".lammps-data"},
       .prefixes = {"data."},
       .read = read_lammps_data,
       .write = write_data},
      {.name = "poscar",
       .extensions = {".poscar", ".vasp"},
       .prefixes = {"poscar", "contcar"},
       .read = read_poscar,
       .write = write_poscar,
       .holds_selective_dynamics = true},
      {.name = "cif", .extensions = {".cif"}, .read = read_cif, .write = write_cif},
      {.name = "mmcif", .extensions = {".mmcif"}, .read = read_cif, .write = write_mmcif},
      {.name = "pdb", .extensions = {".pdb", ".ent"}, .read = read_pdb, .write = write_pdb},
      {.name = "gro", .extensions = {".gro"}, .read = read_gro, .write = write_gro},
      {.name = "gromacs-topology", .extensions = {".top"}, .write = write_gromacs_topology},
      {.name = "mol2", .extensions = {".mol2"}, .read = read_mol2, .write = write_mol2},
      {.name = "dftb-gen", .extensions = {".gen"}, .read = read_dftb_gen, .write = write_dftb_gen},
      {.name = "quantum-espresso",
       .extensions = {".pwi"},
       .read = read_espresso,
       .write = write_espresso,
       .holds_selective_dynamics = true},
      {.name = "cp2k", .extensions = {".inp"}, .read = read_cp2k, .write = write_cp2k},
  };
  return formats;
}

const StructureFormat& structure_format(const std::string& name) {
  std::string known;
  for (const StructureFormat& format : structure_formats()) {
    if (format.name == name) return format;
    known += (known.empty() ? "" : ", ") + format.name;
  }
  throw InvalidOption(concat("there is no format '", name, "' of atoms; known are ", known));
}

const StructureFormat* find_structure_format(const std::filesystem::path& path) {
  const std::string name = plain_name(path);
  const auto ends = [&](const std::string& extension) { return name.ends_with(extension); };
  const auto begins = [&](const std::string& prefix) { return name.starts_with(prefix); };
  for (const StructureFormat& format : structure_formats()) {
    if (std::ranges::any_of(format.extensions, ends)) return &format;
  }
  if (remesh::has_mesh_extension(path)) return nullptr;  // data.ply is a mesh
  for (const StructureFormat& format : structure_formats()) {
    if (std::ranges::any_of(format.prefixes, begins)) return &format;
  }
  return nullptr;
}

std::vector<std::string> structure_extensions() {
  std::vector<std::string> extensions;
  for (const StructureFormat& format : structure_formats()) {
    if (format.write == nullptr) continue;
    extensions.insert(extensions.end(), format.extensions.begin(), format.extensions.end());
  }
  return extensions;
}

std::vector<std::string> write_structure(const std::filesystem::path& path,
                                         const Structure& structure, const WriteOptions& options) {
  const StructureFormat* format = find_structure_format(path);
  if (format == nullptr || format->write == nullptr) {
    throw InvalidOption(
        concat("write_structure: no format of atoms has the name of ", path.string()));
  }
  std::vector<std::string> notes;
  remesh::write_whole_file(path, [&](std::ostream& file) {
    if (!is_compressed(path)) {
      notes = format->write(file, structure, options);
      return;
    }
    GzipBuffer buffer(file);
    std::ostream out(&buffer);
    notes = format->write(out, structure, options);
    buffer.finish();
  });
  const auto* flags = find_column<std::array<int, 3>>(structure, selective_dynamics);
  if (flags != nullptr && !format->holds_selective_dynamics) {
    notes.emplace_back("the flags of selective dynamics are not written: the format has none");
  }
  return notes;
}

}  // namespace trivalent::dual
