#include "structure.h"

#include "files.h"
#include "shell_files.h"
#include "size_options.h"
#include "trivalent/dual/build_dual.h"
#include "trivalent/formats/lammps_data.h"

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

Structure read_mesh_dual(const std::string& path, const Session& session) {
  remesh::TriMesh mesh = read_mesh_file(path, session.terminal);
  remesh::scale(mesh, dual::scale_for_size(mesh, dual_size(session)));
  Structure structure;
  structure.network = dual::build_dual(mesh);
  structure.frame = shell_frame(structure.network);
  return structure;
}

Structure read_file(const std::string& path, const Session& session) {
  const std::string extension = extension_of(path);
  Structure structure;
  if (extension == ".extxyz" || extension == ".xyz") {
    structure.frame = dual::read_xyz(path);
  } else if (extension == ".data" || extension == ".lmp") {
    dual::LammpsData data = dual::read_lammps_data(path);
    structure.frame = {.atoms = std::move(data.atoms), .notes = std::move(data.notes)};
    structure.network.bonds = std::move(data.bonds);
  } else {
    return read_mesh_dual(path, session);
  }
  session.terminal.notes(structure.frame.notes);
  structure.network.positions = structure.frame.atoms.positions;
  return structure;
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

Structure read_structure(const std::string& path, const Session& session) {
  Structure structure = read_file(path, session);
  if (const auto periodic = session.find<std::string>("periodic")) {
    structure.frame.atoms.box.periodic = periodic_directions(*periodic);
  }
  return structure;
}

dual::ShellState state_of(const Structure& structure) {
  if (structure.network.rings.empty()) return dual::atoms_state("atoms", structure.frame.atoms);
  return dual::network_state("dual", structure.network);
}

}  // namespace trivalent::apps
