#include <optional>

#include "command.h"
#include "files.h"
#include "lammps_options.h"
#include "potential_options.h"
#include "session.h"
#include "structure_options.h"
#include "trivalent/shell/certify.h"
#include "trivalent/shell/reports.h"

namespace trivalent::apps {
namespace {

Grammar grammar_of_check() {
  Grammar grammar = {
      .arguments = {}, .options = po::options_description("Options"), .list = "FILE"};
  grammar.options.add_options()  //
      ("max-force", with_default(0.01),
       "atoms are at rest if none has a larger force [eV/Å], > 0; inf: not looked at")  //
      ("open", "the shell has an edge: atoms with two bonds are meant")                 //
      ("surface", po::value<std::string>(),
       "mesh, in Å, from which the atoms' distances are measured (surface.off of a build)")  //
      ("lammps", "let LAMMPS compute energies and forces too, and compare them atom by atom");
  add_lammps_options(grammar.options);
  add_potential_options(grammar.options);
  add_structure_options(grammar.options);
  grammar.epilog =
      "FILE is extended XYZ, LAMMPS data or a mesh, whose dual is meant. Atoms are bonded if they\n"
      "are nearer than 1.85 Å (C-C), 1.55 Å (C-H), 1.4 Å (H-H). The potential is rebo or airebo\n"
      "if the file names it, else rebo. Exit code 1 if something is wrong: an atom without its\n"
      "three bonds, a bond outside 1.25 to 1.75 Å, an angle outside 85° to 155°, other atoms\n"
      "nearer than 2 Å, a ring missing, atoms not at rest, or bonds, energies or forces in the\n"
      "file that are not those of its atoms.\n";
  return grammar;
}

shell::CertifyOptions certify_options(const Session& session) {
  if (!(session.get<double>("max-force") > 0.0)) throw UsageError("--max-force must be > 0");
  shell::CertifyOptions options = {
      .potential = potential_choice(session),
      .max_force = session.get<double>("max-force"),
      .edge = session.has("open") ? shell::ShellEdge::allowed : shell::ShellEdge::none};
  if (session.has("lammps")) {
    options.lammps = lammps_options(session, options.potential);
  } else {
    if (options.potential.pair_style) throw UsageError("--pair-style goes with --lammps");
    refuse_lammps_options(session, "--lammps");
  }
  return options;
}

/// The options with the potential that the file names, unless the command line names one.
shell::CertifyOptions with_potential_of(const dual::Structure& structure,
                                        shell::CertifyOptions options, const Session& session) {
  if (!session.values["potential"].defaulted() || options.potential.pair_style) return options;
  const auto title = shell::potential_title(structure);
  if (!title) return options;
  const auto named = shell::named_potential(structure);
  if (!named) {
    session.terminal.notes({"the file's energies are of " + *title + ", but " +
                            options.potential.title() +
                            " is used; --potential and --pair-style choose another"});
    return options;
  }
  session.terminal.notes({"potential " + named->name + ", as the file says"});
  options.potential = *named;
  if (options.lammps) options.lammps = lammps_options(session, options.potential);
  return options;
}

int run_check(const Command& self, std::span<const std::string> arguments) {
  const auto session = start(self, arguments, grammar_of_check());
  if (!session) return done;
  shell::CertifyOptions options = certify_options(*session);
  const shell::StructureOptions reading = structure_options(*session);
  if (const auto path = session->find<std::string>("surface")) {
    options.surface = read_mesh_file(*path, session->terminal);
  }
  Result printed = {.table = {}, .json = {{"sound", true}, {"files", Json::array()}}};
  bool is_sound = true;
  for (const auto& file : session->get<std::vector<std::string>>("FILE")) {
    const dual::StructureFile content = shell::read_structure(file, reading);
    session->terminal.notes(content.notes);
    options.notes = content.notes;
    const shell::Certificate certificate =
        shell::certify(content.structure, with_potential_of(content.structure, options, *session));
    is_sound = is_sound && certificate.is_sound();
    printed.table.push_back({file});
    shell::append(printed.table, certificate.rows());
    Json json = {{"file", file}};
    json.update(certificate.json());
    printed.json["files"].push_back(std::move(json));
  }
  printed.json["sound"] = is_sound;
  session->terminal.print(printed);
  return is_sound ? done : failed;
}

}  // namespace

const Command check_command = {
    .name = "check",
    .synopsis = "FILE... [--surface MESH] [--lammps [--ranks N]] [options]",
    .meaning = "Certifies shells: topology, bonds, rings, energies, forces; also against LAMMPS",
    .run = run_check};

}  // namespace trivalent::apps
