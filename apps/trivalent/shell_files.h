#pragma once

#include <filesystem>
#include <span>
#include <string>

#include "session.h"
#include "trivalent/dual/network.h"
#include "trivalent/formats/lammps_data.h"
#include "trivalent/formats/xyz.h"
#include "trivalent/potentials/energy_forces.h"

namespace trivalent::apps {

/// --digits and --atom-style.
void add_file_options(po::options_description& options);

/// --digits: decimals or 17.
///
/// @throws UsageError on anything else.
[[nodiscard]] dual::Digits digits(const Session& session);

/// --atom-style: atomic or molecular.
///
/// @throws UsageError on anything else.
[[nodiscard]] dual::AtomStyle atom_style(const Session& session);

/// A network with its coordinations and rings, and its energies and forces where there are any.
[[nodiscard]] dual::XyzFrame shell_frame(const dual::Network& network);
/// What a file brought along under the same names is outdated and goes.
void replace_columns(dual::XyzFrame& frame, std::vector<dual::Column> columns);
void add_energies(dual::XyzFrame& frame, const potentials::EnergyForces& result);

/// Adds the column `displacement` [Å]: from where the atoms were to where they are.
void add_displacements(dual::XyzFrame& frame, std::span<const Eigen::Vector3d> before);

}  // namespace trivalent::apps
