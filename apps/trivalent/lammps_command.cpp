#include <filesystem>

#include "command.h"
#include "file_options.h"
#include "files.h"
#include "lammps_options.h"
#include "session.h"
#include "structure_options.h"
#include "trivalent/formats/lammps_package.h"
#include "trivalent/potentials/rebo.h"
#include "trivalent/shell/number_text.h"

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
      ("potential-file", po::value<std::string>(), "CH.rebo; default: LAMMPS finds it");
  add_file_options(grammar.options);
  add_structure_options(grammar.options);
  return grammar;
}

dual::LammpsPackageOptions package_options(const Session& session) {
  const bool has_angles = session.has("angles");
  if (has_angles && atom_style(session) != dual::AtomStyle::molecular) {
    throw UsageError("--angles needs --atom-style molecular");
  }
  shell::LammpsOptions lammps;
  if (const auto file = session.find<std::string>("potential-file")) lammps.potential_file = *file;
  const auto compression = session.has("gzip") ? dual::Compression::gzip : dual::Compression::none;
  return {.data = {.style = atom_style(session), .angles = has_angles, .digits = digits(session)},
          .potential_file = potential_file(session, lammps),
          .compression = compression,
          .atoms_per_file = session.get<std::size_t>("atoms-per-file")};
}

int run(const Command& self, std::span<const std::string> arguments) {
  const auto session = start(self, arguments, grammar_of_lammps());
  if (!session) return done;
  if (!session->has("output")) throw UsageError("-o must say into which folder the files go");
  const shell::StructureOptions reading = structure_options(*session);
  const dual::LammpsPackageOptions options = package_options(*session);
  const std::filesystem::path folder = session->get<std::string>("output");
  check_folder(folder);

  const dual::Structure structure =
      read_structure(session->get<std::string>("NETWORK"), reading, session->terminal);
  const double energy = potentials::rebo(structure.atoms).energy;
  const OutputFolder made(folder);
  const auto names = dual::write_lammps_package(folder, structure, energy, options);
  std::string list;
  for (const std::string& name : names) list += (list.empty() ? "" : ", ") + name;
  session->terminal.print({.table = {{"atoms", std::to_string(structure.atoms.size())},
                                     {"energy", shell::decimals(energy, 8) + " eV"},
                                     {"folder", folder.string()},
                                     {"files", list},
                                     {"next", "cd " + folder.string() + " && lmp -in in.check"}},
                           .json = {{"atoms", structure.atoms.size()},
                                    {"energy", energy},
                                    {"folder", folder.string()},
                                    {"files", names}}});
  return done;
}

}  // namespace

const Command lammps_command = {
    .name = "lammps",
    .synopsis = "NETWORK -o DIR [--atom-style molecular [--angles]] [--gzip] [options]",
    .meaning =
        "Writes a folder with which LAMMPS can start: data, and input scripts that check, "
        "relax and run it",
    .run = run};

}  // namespace trivalent::apps
