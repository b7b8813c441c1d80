#include "shell_files.h"

#include <algorithm>

#include "trivalent/dual/carbon_atoms.h"

namespace trivalent::apps {

void add_file_options(po::options_description& options) {
  options.add_options()  //
      ("digits", with_default(std::string("decimals")),
       "decimals: 10 decimals; 17: 17 significant digits, which keep every bit")  //
      ("atom-style", with_default(std::string("atomic")),
       "of LAMMPS data: atomic, or molecular with the bonds");
}

dual::Digits digits(const Session& session) {
  const auto& name = session.get<std::string>("digits");
  if (name == "decimals") return dual::Digits::ten_decimals;
  if (name == "17") return dual::Digits::seventeen_significant;
  throw UsageError("--digits is decimals or 17, not '" + name + "'");
}

dual::AtomStyle atom_style(const Session& session) {
  const auto& name = session.get<std::string>("atom-style");
  if (name == "atomic") return dual::AtomStyle::atomic;
  if (name == "molecular") return dual::AtomStyle::molecular;
  throw UsageError("--atom-style is atomic or molecular, not '" + name + "'");
}

dual::XyzFrame shell_frame(const dual::Network& network) {
  return {.atoms = dual::carbon_atoms(network), .columns = dual::network_columns(network)};
}

void replace_columns(dual::XyzFrame& frame, std::vector<dual::Column> columns) {
  for (dual::Column& column : columns) {
    std::erase_if(frame.columns, [&](const dual::Column& old) { return old.name == column.name; });
    frame.columns.push_back(std::move(column));
  }
}

void add_energies(dual::XyzFrame& frame, const potentials::EnergyForces& result) {
  replace_columns(frame, dual::energy_columns(result));
  std::erase_if(frame.header, [](const dual::HeaderEntry& old) { return old.key == "energy"; });
  frame.header.push_back({.key = "energy", .value = result.energy});
}

void add_displacements(dual::XyzFrame& frame, std::span<const Eigen::Vector3d> before) {
  std::vector<Eigen::Vector3d> ways(before.size());
  for (std::size_t i = 0; i < before.size(); ++i) ways[i] = frame.atoms.positions[i] - before[i];
  replace_columns(frame, {{.name = "displacement", .values = std::move(ways)}});
}

}  // namespace trivalent::apps
