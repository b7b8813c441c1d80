#include "structure_options.h"

#include "size_options.h"

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

}  // namespace

void add_structure_options(po::options_description& options) {
  options.add_options()  //
      ("periodic", po::value<std::string>(),
       "periodic directions as in xyz, x, none; default: as the file says; LAMMPS data: xyz");
  po::options_description sizes("Size of the dual, if the file is a mesh");
  add_dual_size_options(sizes);
  options.add(sizes);
}

shell::StructureOptions structure_options(const Session& session) {
  shell::StructureOptions options = {.size = dual_size(session)};
  if (const auto periodic = session.find<std::string>("periodic")) {
    options.periodic = periodic_directions(*periodic);
  }
  return options;
}

dual::Structure read_structure(const std::string& path, const shell::StructureOptions& options,
                               const Terminal& terminal) {
  dual::StructureFile file = shell::read_structure(path, options);
  terminal.notes(file.notes);
  return std::move(file.structure);
}

}  // namespace trivalent::apps
