#include "structure.h"

#include "files.h"
#include "size_options.h"
#include "trivalent/dual/build_dual.h"
#include "trivalent/dual/columns.h"
#include "trivalent/dual/padded_box.h"
#include "trivalent/formats/lammps_data.h"
#include "trivalent/formats/xyz.h"

namespace trivalent::apps {
namespace {

std::array<bool, 3> periodic_directions(const std::string& text) {
  if (text == "none") return {false, false, false};
  if (text.empty() || text.find_first_not_of("xyz") != std::string::npos) {
    throw UsageError("--periodic is made of x, y and z, or none, not '" + text + "'");
  }
  const auto has = [&](char axis) { return text.find(axis) != std::string::npos; };
  return {has('x'), has('y'), has('z')};
}

dual::Structure read_mesh_dual(const std::string& path, const Session& session) {
  remesh::TriMesh mesh = read_mesh_file(path, session.terminal);
  remesh::scale(mesh, dual::scale_for_size(mesh, dual_size(session)));
  dual::Structure structure = dual::build_dual(mesh);
  structure.atoms.box = dual::padded_box(structure.atoms.positions);
  dual::replace_columns(structure, dual::network_columns(structure));
  return structure;
}

dual::Structure read_file(const std::string& path, const Session& session) {
  const std::string extension = extension_of(path);
  dual::StructureFile file;
  if (extension == ".extxyz" || extension == ".xyz") {
    file = dual::read_xyz(path);
  } else if (extension == ".data" || extension == ".lmp") {
    file = dual::read_lammps_data(path);
  } else {
    return read_mesh_dual(path, session);
  }
  session.terminal.notes(file.notes);
  return std::move(file.structure);
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

void add_structure_options(po::options_description& options) {
  options.add_options()  //
      ("periodic", po::value<std::string>(),
       "periodic directions as in xyz, x, none; default: as the file says; LAMMPS data: xyz");
  po::options_description sizes("Size of the dual, if the file is a mesh");
  add_dual_size_options(sizes);
  options.add(sizes);
}

void check_structure_options(const Session& session) {
  static_cast<void>(dual_size(session));
  if (const auto periodic = session.find<std::string>("periodic")) {
    static_cast<void>(periodic_directions(*periodic));
  }
}

dual::Structure read_structure(const std::string& path, const Session& session) {
  dual::Structure structure = read_file(path, session);
  if (const auto periodic = session.find<std::string>("periodic")) {
    set_periodic(structure, periodic_directions(*periodic));
  }
  return structure;
}

}  // namespace trivalent::apps
