#include <filesystem>

#include "command.h"
#include "file_options.h"
#include "files.h"
#include "lammps_options.h"
#include "potential_options.h"
#include "session.h"
#include "structure_options.h"
#include "trivalent/dual/columns.h"
#include "trivalent/formats/lammps_package.h"
#include "trivalent/potentials/bonds.h"
#include "trivalent/shell/number_text.h"
#include "trivalent/shell/potential_choice.h"
#include "trivalent/shell/relax_report.h"

namespace trivalent::apps {
namespace {

Grammar grammar_of_lammps() {
  Grammar grammar = {.arguments = {"NETWORK"}, .options = po::options_description("Options")};
  const dual::LammpsPackageOptions defaults;
  grammar.options.add_options()                                                          //
      ("output,o", po::value<std::string>(), "folder for the results; made if missing")  //
      ("angles", "write angles too; with --atom-style molecular")                        //
      ("gzip", "compress the data file")                                                 //
      ("atoms-per-file", with_default(defaults.atoms_per_file),
       "write data of more atoms in parts, >= 1")  //
      ("potential", with_default(std::string("rebo")),
       "rebo, or airebo, which has forces between walls")  //
      ("potential-file", po::value<std::string>(),
       "CH.rebo or CH.airebo; default: LAMMPS finds it");
  add_pair_options(grammar.options);
  add_file_options(grammar.options);
  add_structure_options(grammar.options, input_style);
  return grammar;
}

shell::PotentialChoice named_potential(const Session& session) {
  return {.name = session.get<std::string>("potential")};
}

dual::LammpsPackageOptions package_options(const Session& session) {
  const bool has_angles = session.has("angles");
  if (has_angles && atom_style(session) != dual::AtomStyle::molecular) {
    throw UsageError("--angles needs --atom-style molecular");
  }
  const shell::KnownPotential& potential = shell::find_potential(named_potential(session));
  if (!potential.lammps) throw UsageError("--potential: LAMMPS is given rebo or airebo");
  shell::LammpsOptions lammps = {.potential = *potential.lammps};
  if (const auto file = session.find<std::string>("potential-file")) lammps.potential_file = *file;
  const auto compression = session.has("gzip") ? dual::Compression::gzip : dual::Compression::none;
  return {.data = {.style = atom_style(session), .angles = has_angles, .digits = digits(session)},
          .potential = lammps.potential,
          .potential_file = potential_file(session, lammps),
          .pair_style = pair_style(session),
          .compression = compression,
          .atoms_per_file = session.get<std::size_t>("atoms-per-file")};
}

/// Molecular data need bonds; those that the file does not tell are found by distance.
void find_bonds(dual::Structure& structure, const Terminal& terminal) {
  if (!structure.bonds.empty()) return;
  potentials::GuessedBonds guess = potentials::guess_bonds(structure.atoms);
  terminal.note(shell::guess_note(guess));
  structure.bonds = std::move(guess.bonds);
}

Result result_of(const std::filesystem::path& folder, std::size_t n_atoms, double energy,
                 const dual::LammpsPackage& package) {
  std::string list;
  for (const std::string& name : package.files) list += (list.empty() ? "" : ", ") + name;
  Result result = {.table = {{"atoms", std::to_string(n_atoms)},
                             {"energy", shell::decimals(energy, 8) + " eV"},
                             {"folder", folder.string()},
                             {"files", list}},
                   .json = {{"atoms", n_atoms},
                            {"energy", energy},
                            {"folder", folder.string()},
                            {"files", package.files}}};
  const Eigen::Matrix3d& r = package.rotation;
  result.json["rotation"] = {
      {r(0, 0), r(0, 1), r(0, 2)}, {r(1, 0), r(1, 1), r(1, 2)}, {r(2, 0), r(2, 1), r(2, 2)}};
  if (!r.isIdentity(0.0)) {
    result.table.push_back({"rotated", "to the box that LAMMPS takes; README.md says how"});
  }
  result.table.push_back({"next", "cd " + folder.string() + " && lmp -in in.check"});
  return result;
}

int run_lammps(const Command& self, std::span<const std::string> arguments) {
  const auto session = start(self, arguments, grammar_of_lammps());
  if (!session) return done;
  if (!session->has("output")) throw UsageError("-o must say into which folder the files go");
  const shell::StructureOptions reading = structure_options(*session, input_style);
  const dual::LammpsPackageOptions options = package_options(*session);
  const std::filesystem::path folder = session->get<std::string>("output");
  check_folder(folder);
  if (options.pair_style && !shell::has_pair_style(options.pair_style->style)) {
    session->terminal.note("note: the LAMMPS of this machine has no pair_style " +
                           options.pair_style->style + "; the scripts need one that has it");
  }

  dual::Structure structure =
      read_structure(session->get<std::string>("NETWORK"), reading, session->terminal);
  if (dual::find_column<std::array<int, 3>>(structure, dual::selective_dynamics) != nullptr) {
    session->terminal.notes(
        {"the scripts let all atoms move, also those that the file's selective "
         "dynamics hold; `relax` obeys them"});
  }
  if (options.data.style == dual::AtomStyle::molecular) find_bonds(structure, session->terminal);
  const double energy =
      shell::make_potential(named_potential(*session))->evaluate(structure.atoms).energy;
  const OutputFolder made(folder);
  const auto package = dual::write_lammps_package(folder, structure, energy, options);
  session->terminal.print(result_of(folder, structure.atoms.size(), energy, package));
  return done;
}

}  // namespace

const Command lammps_command = {
    .name = "lammps",
    .synopsis =
        "NETWORK -o DIR [--atom-style molecular [--angles]] [--gzip] [--pair-style STYLE "
        "--pair-coeff ARGUMENTS] [options]",
    .meaning =
        "Writes a folder with which LAMMPS can start: data, and input scripts that check, "
        "relax and run it",
    .run = run_lammps};

}  // namespace trivalent::apps
