#include "command.h"
#include "file_options.h"
#include "files.h"
#include "session.h"
#include "structure_options.h"
#include "trivalent/formats/structure_format.h"
#include "trivalent/potentials/bonds.h"
#include "trivalent/shell/relax_report.h"

namespace trivalent::apps {
namespace {

Grammar grammar_of_convert() {
  Grammar grammar = {.arguments = {"IN", "OUT"}, .options = po::options_description("Options")};
  grammar.options.add_options()  //
      ("guess-bonds",
       "find the bonds by distance where the file has none, for formats that hold bonds")  //
      ("symmetry", po::value<double>(),
       "of CIF: look for a space group whose places the atoms meet to this distance [Å], > 0, and "
       "write one atom of each kind");
  add_file_options(grammar.options);
  add_structure_options(grammar.options, input_style);
  return grammar;
}

dual::WriteOptions write_options(const Session& session) {
  dual::WriteOptions options = {.digits = digits(session),
                                .atom_style = atom_style(session),
                                .symmetry_tolerance = session.find<double>("symmetry")};
  if (options.symmetry_tolerance && !(*options.symmetry_tolerance > 0.0)) {
    throw UsageError("--symmetry must be > 0");
  }
  return options;
}

int run_convert(const Command& self, std::span<const std::string> arguments) {
  const auto session = start(self, arguments, grammar_of_convert());
  if (!session) return done;
  const dual::WriteOptions options = write_options(*session);
  const auto& output = session->get<std::string>("OUT");
  check_structure_output(output);
  if (options.symmetry_tolerance && dual::find_structure_format(output)->name != "cif") {
    throw UsageError("--symmetry belongs to CIF; OUT must end in .cif");
  }
  dual::Structure structure = read_structure(
      session->get<std::string>("IN"), structure_options(*session, input_style), session->terminal);
  if (session->has("guess-bonds") && structure.bonds.empty()) {
    potentials::GuessedBonds guess = potentials::guess_bonds(structure.atoms);
    session->terminal.note(shell::guess_note(guess));
    structure.bonds = std::move(guess.bonds);
  }
  const std::vector<std::string> notes = dual::write_structure(output, structure, options);
  session->terminal.notes(notes);
  session->terminal.print(describe_written(output, structure, notes));
  return done;
}

}  // namespace

const Command convert_command = {
    .name = "convert",
    .synopsis = "IN OUT [--guess-bonds] [--symmetry TOLERANCE] [options]",
    .meaning =
        "Writes atoms in another format: LAMMPS data, POSCAR, CIF, mmCIF, PDB, GRO, MOL2, inputs "
        "of DFTB+, Quantum ESPRESSO and CP2K",
    .run = run_convert};

}  // namespace trivalent::apps
