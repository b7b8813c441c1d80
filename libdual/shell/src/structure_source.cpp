#include "trivalent/shell/structure_source.h"

#include "trivalent/remesh/mesh_io.h"
#include "trivalent/shell/ideal_source.h"
#include "trivalent/shell/mesh_dual.h"

namespace trivalent::shell {
namespace {

dual::StructureFile read_mesh_dual(const std::filesystem::path& path, const dual::DualSize& size) {
  remesh::MeshFile file = remesh::read_mesh(path);
  return {.structure = structure_of(std::move(file.mesh), size), .notes = std::move(file.notes)};
}

/// The format that is asked for; none: the file is a mesh.
const dual::StructureFormat* choose_format(const std::filesystem::path& path,
                                           const StructureOptions& options) {
  if (options.format) return &dual::structure_format(*options.format);
  if (path == "-") {
    throw dual::InvalidOption("standard input has no name that tells its format; --format does");
  }
  return dual::find_structure_format(path);
}

bool is_given(const dual::ReadOptions& reading) {
  return !reading.elements.empty() || reading.frame || reading.atom_style;
}

void refuse_size(const std::filesystem::path& path, const StructureOptions& options) {
  if (!options.size) return;
  throw dual::InvalidOption(path.string() +
                            " holds atoms, which have their size: bond, length and scale belong to "
                            "the duals of meshes");
}

dual::StructureFile read_file(const std::filesystem::path& path, const StructureOptions& options) {
  if (!options.format && is_ideal_structure(path.string())) {
    if (is_given(options.reading)) {
      throw dual::InvalidOption(path.string() +
                                " is made, not read: elements, atom style and frame mean nothing");
    }
    refuse_size(path, options);
    return {.structure = make_ideal_structure(path.string())};
  }
  const dual::StructureFormat* format = choose_format(path, options);
  if (format != nullptr && format->read != nullptr) {
    refuse_size(path, options);
    return format->read(path, options.reading);
  }
  if (format != nullptr) {
    throw dual::InvalidOption("the format " + format->name + " can only be written");
  }
  if (is_given(options.reading)) {
    throw dual::InvalidOption(path.string() +
                              " is not a file of atoms by its name: elements, atom style and frame "
                              "mean nothing for a mesh (--format names the format)");
  }
  return read_mesh_dual(path, options.size.value_or(dual::MeanBond()));
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
  dual::StructureFile file = read_file(path, options);
  if (options.periodic) set_periodic(file.structure, *options.periodic);
  return file;
}

}  // namespace trivalent::shell
