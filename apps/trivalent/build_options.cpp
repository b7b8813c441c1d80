#include "build_options.h"

#include "cell_options.h"
#include "file_options.h"
#include "files.h"
#include "remesh_options.h"
#include "repair_options.h"
#include "size_options.h"
#include "trivalent/formats/structure_format.h"
#include "trivalent/shell/option_names.h"

namespace trivalent::apps {
namespace {

std::vector<std::string> formats(const Session& session) {
  const auto names = session.find<std::vector<std::string>>("format");
  for (const std::string& name : names.value_or(std::vector<std::string>{})) {
    const dual::StructureFormat& format = dual::structure_format(name);
    if (format.write == nullptr) throw UsageError("--format: " + name + " can only be read");
  }
  return names.value_or(std::vector<std::string>{});
}

void add_wall_options(po::options_description& options) {
  const dual::WallOptions defaults;
  options.add_options()  //
      ("walls", with_default(defaults.count),
       "so many shells around each other; --atoms counts those of all, --length and --scale are of "
       "the given surface")                                                 //
      ("spacing", with_default(defaults.spacing), "from wall to wall [Å]")  //
      ("outwards", "SHAPE is the innermost wall (default)")                 //
      ("inwards", "SHAPE is the outermost wall");
}

dual::WallOptions wall_options(const Session& session) {
  if (session.has("inwards") && session.has("outwards")) {
    throw UsageError("further walls are either --inwards or --outwards");
  }
  return {.count = session.get<int>("walls"),
          .spacing = session.get<double>("spacing"),
          .side = session.has("inwards") ? dual::WallSide::inwards : dual::WallSide::outwards};
}

std::optional<shell::PotentialChoice> potential(const Session& session) {
  const auto name = session.find<std::string>("potential");
  if (!name) return std::nullopt;
  if (*name != "rebo" && *name != "airebo") {
    throw UsageError("--potential: a shell is built under rebo or airebo, not '" + *name + "'");
  }
  return shell::PotentialChoice{.name = *name};
}

}  // namespace

Grammar grammar_of_build() {
  Grammar grammar = {.arguments = {"SHAPE"},
                     .options = po::options_description("Size of the shell"),
                     .optional_argument = "SHAPE"};
  add_shell_size_options(grammar.options);
  po::options_description walls("Several walls");
  add_wall_options(walls);
  po::options_description cell("Periodic surfaces, formulas and volumes");
  add_cell_options(cell);
  po::options_description repair("Reading");
  add_repair_options(repair);
  po::options_description remeshing("Remeshing");
  add_remesh_options(remeshing);
  po::options_description files("Output");
  files.add_options()                                                                  //
      ("output,o", po::value<std::string>(), "folder for the results; must be given")  //
      ("cap", with_default_name(shell::EdgeCap::none, shell::cap_names),
       "hydrogen: puts H on the atoms at the edge of an open shell")  //
      ("potential", po::value<std::string>(),
       "rebo or airebo, under which the atoms relax and have their energies; default: rebo, of "
       "several walls airebo")                                                //
      ("no-relax", "leave the atoms where the dual puts them")                //
      ("fix-box", "keep the cell of a periodic shell while its atoms relax")  //
      ("dry-run", "only tell what would be built, and whether it can be");
  add_file_options(files);
  files.add_options()("format", po::value<std::vector<std::string>>(),
                      "write the shell in this format of atoms too; may be given again");
  grammar.options.add(walls).add(cell).add(repair).add(remeshing).add(files);
  grammar.epilog =
      "SHAPE is a mesh file (OFF, OBJ, PLY, STL, VTP, or points in XYZ; - is standard input), a\n"
      "volume (VTI, cube, NRRD, MRC or CCP4, raw) or a built-in shape. Of periodic surfaces,\n"
      "--atoms and --length (the longest cell vector) are those of the cell, which is relaxed "
      "with\n"
      "the atoms.\n"
      "Writes surface.off, shell.extxyz, the files of `trivalent lammps`, energy.ply, energy.vtp,\n"
      "report.json and report.html (open it in a browser).\n\n" +
      shapes_help();
  return grammar;
}

BuildRequest build_request(const Session& session) {
  BuildRequest request = {
      .shape = surface_name(session),
      .repair = repair_options(session),
      .cell = cell_options(session),
      .build = {.shell = {.size = shell_size(session),
                          .method = remesh_method(session),
                          .walls = wall_options(session)},
                .cap = named_value(session, "cap", shell::cap_names),
                .potential = potential(session),
                .relaxation =
                    session.has("no-relax") ? shell::Relaxation::none : shell::Relaxation::at_rest,
                .box = session.has("fix-box") ? potentials::BoxPolicy::fixed
                                              : potentials::BoxPolicy::pressure_free},
      .files = {.digits = digits(session),
                .atom_style = atom_style(session),
                .formats = formats(session)}};
  request.build.shell.bond = session.find<double>("bond").value_or(
      shell::usual_bond_length(request.build.used_potential()));
  return request;
}

}  // namespace trivalent::apps
