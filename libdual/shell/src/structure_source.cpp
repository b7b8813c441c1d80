#include "trivalent/shell/structure_source.h"

#include <algorithm>
#include <cctype>

#include "trivalent/dual/build_dual.h"
#include "trivalent/dual/columns.h"
#include "trivalent/dual/padded_box.h"
#include "trivalent/formats/lammps_data.h"
#include "trivalent/formats/xyz.h"
#include "trivalent/remesh/mesh_io.h"

namespace trivalent::shell {
namespace {

/// In lower case; of "a.data.gz" it is ".data".
std::string extension_of(const std::filesystem::path& path) {
  std::string extension = path.extension().string();
  std::transform(extension.begin(), extension.end(), extension.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return extension == ".gz" ? extension_of(path.stem()) : extension;
}

dual::StructureFile read_mesh_dual(const std::filesystem::path& path, const dual::DualSize& size) {
  remesh::MeshFile file = remesh::read_mesh(path);
  remesh::scale(file.mesh, dual::scale_for_size(file.mesh, size));
  dual::Structure structure = dual::build_dual(file.mesh);
  structure.atoms.box = dual::padded_box(structure.atoms.positions);
  dual::replace_columns(structure, dual::network_columns(structure));
  return {.structure = std::move(structure), .notes = std::move(file.notes)};
}

dual::StructureFile read_file(const std::filesystem::path& path, const dual::DualSize& size) {
  const std::string extension = extension_of(path);
  if (extension == ".extxyz" || extension == ".xyz") return dual::read_xyz(path);
  if (extension == ".data" || extension == ".lmp") return dual::read_lammps_data(path);
  return read_mesh_dual(path, size);
}

/// A bond does not lead across a boundary that is none.
void set_periodic(dual::Structure& structure, const std::array<bool, 3>& periodic) {
  structure.atoms.box.periodic = periodic;
  for (potentials::Bond& bond : structure.bonds) {
    for (std::size_t axis = 0; axis < 3; ++axis) {
      if (!periodic[axis]) bond.image[axis] = 0;
    }
  }
}

}  // namespace

dual::StructureFile read_structure(const std::filesystem::path& path,
                                   const StructureOptions& options) {
  dual::StructureFile file = read_file(path, options.size);
  if (options.periodic) set_periodic(file.structure, *options.periodic);
  return file;
}

}  // namespace trivalent::shell
