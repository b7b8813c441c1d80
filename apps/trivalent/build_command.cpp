#include <filesystem>
#include <optional>
#include <ostream>

#include "build_input.h"
#include "build_report.h"
#include "command.h"
#include "files.h"
#include "relax_report.h"
#include "remesh_options.h"
#include "report_page.h"
#include "reports.h"
#include "session.h"
#include "shell_files.h"
#include "size_options.h"
#include "surface_input.h"
#include "trivalent/dual/columns.h"
#include "trivalent/dual/energy_summary.h"
#include "trivalent/dual/hydrogen.h"
#include "trivalent/formats/lammps_package.h"
#include "trivalent/formats/xyz.h"
#include "trivalent/potentials/error.h"
#include "trivalent/potentials/rebo.h"
#include "trivalent/potentials/relax.h"
#include "trivalent/remesh/mesh_components.h"
#include "trivalent/remesh/mesh_io.h"
#include "trivalent/remesh/mesh_quality.h"
#include "trivalent/remesh/whole_file.h"
#include "trivalent/shell/build_shell.h"
#include "trivalent/view/energy_ply.h"
#include "trivalent/view/shell_page.h"
#include "trivalent/view/vtp.h"

namespace trivalent::apps {
namespace {

// A shell that is not at rest by then is caught somewhere: `trivalent relax` can go on.
constexpr int most_relaxation_steps = 3000;

Grammar grammar_of_build() {
  Grammar grammar = {.arguments = {"SHAPE"},
                     .options = po::options_description("Size of the shell")};
  add_shell_size_options(grammar.options);
  po::options_description mending("Reading");
  add_repair_options(mending);
  po::options_description remeshing("Remeshing");
  add_remesh_options(remeshing);
  po::options_description files("Output");
  files.add_options()                                                                  //
      ("output,o", po::value<std::string>(), "folder for the results; must be given")  //
      ("cap", with_default(std::string("none")),
       "hydrogen: puts H on the atoms at the edge of an open shell")  //
      ("no-relax", "leave the atoms where the dual puts them")        //
      ("dry-run", "only tell what would be built, and whether it can be");
  add_file_options(files);
  grammar.options.add(mending).add(remeshing).add(files);
  grammar.epilog =
      "SHAPE is a mesh file (OFF, OBJ, PLY, STL, VTP, or points in XYZ; - is standard input) or a\n"
      "built-in shape.\n"
      "Writes surface.off, shell.extxyz, the files of `trivalent lammps`, energy.ply, energy.vtp,\n"
      "report.json and report.html (open it in a browser).\n\n" +
      shapes_help();
  return grammar;
}

/// The dual of the surface as it came, at the same mean bond. Such a dual may be beyond any
/// potential (atoms on top of each other); that is a finding, not a failure of the build.
void measure_energy_before(BuildRecord& record) {
  try {
    remesh::TriMesh original = record.original;
    remesh::scale(original,
                  dual::scale_for_size(original, dual::MeanBond{record.network.bond_mean}));
    dual::ShellState state = dual::shell_state("dual of the input", dual::build_dual(original));
    dual::add_energies(state, potentials::rebo(state.structure.atoms).energies,
                       dual::graphene_energy);
    record.before = std::move(state);
  } catch (const dual::InvalidNetwork& error) {
    record.notes.push_back(std::string("the input has no dual to compare with: ") + error.what());
  } catch (const potentials::InvalidAtoms& error) {
    record.notes.push_back(std::string("the input's dual has no energy: ") + error.what());
  }
}

/// --cap: none or hydrogen.
bool caps_edges(const Session& session) {
  const auto& cap = session.get<std::string>("cap");
  if (cap == "none" || cap == "hydrogen") return cap == "hydrogen";
  throw UsageError("--cap is none or hydrogen, not '" + cap + "'");
}

/// Hydrogen belongs to the component of its carbon atom.
void cap_edges(BuildRecord& record) {
  dual::Structure& structure = record.shell.structure;
  record.caps = dual::cap_with_hydrogen(structure);
  auto& component = record.components.of_face;
  component.resize(structure.atoms.size());
  for (const potentials::Bond& bond : structure.bonds) {
    component[bond.second] = component[bond.first];
  }
  record.notes.push_back("capped the edge with " + std::to_string(record.caps.hydrogens) +
                         " hydrogen atoms");
  if (record.caps.bare_atoms > 0) {
    record.notes.push_back(std::to_string(record.caps.bare_atoms) +
                           " atoms without any bond are not capped");
  }
}

/// What is to be seen of the shell as it is now.
dual::ShellState shell_state(std::string name, const BuildRecord& record) {
  const dual::Structure& structure = record.shell.structure;
  dual::ShellState state = dual::shell_state(std::move(name), structure);
  dual::add_energies(state, record.energy.energies, dual::graphene_energy);
  state.maps.push_back(
      dual::distance_map("surface_distance", "distance to the input surface",
                         remesh::distances_to_surface(structure.atoms.positions, record.original)));
  return state;
}

void measure_energy_after(BuildRecord& record) {
  try {
    record.energy = potentials::rebo(record.shell.structure.atoms);
  } catch (const potentials::InvalidAtoms& error) {
    throw potentials::InvalidAtoms(potentials::concat(
        "build: the shell meets itself (", error.what(),
        "); mend the mesh there, or put a new surface around it: --repair wrap"));
  }
  record.after = shell_state("shell", record);
}

/// Brings the atoms of the shell to rest under REBO. A stop keeps them where they have come.
void relax_shell(const StopRequest& stop, const Session& session, BuildRecord& record) {
  dual::Structure& structure = record.shell.structure;
  const std::vector<Eigen::Vector3d> before = structure.atoms.positions;
  potentials::Rebo rebo;
  RelaxLine line(session.terminal);
  record.relaxed = potentials::relax(structure.atoms, rebo,
                                     {.max_steps = most_relaxation_steps,
                                      .bonds = structure.bonds,
                                      .on_progress = [&](const potentials::RelaxProgress& state) {
                                        line.show(state);
                                        return !stop.is_made();
                                      }});
  record.unrelaxed = std::move(record.after);
  record.unrelaxed->name = "dual, not relaxed";
  record.relaxation = report_relaxation(before, structure.bonds, *record.relaxed);
  for (std::string& note : relax_notes(record.relaxation, *record.relaxed)) {
    record.notes.push_back(std::move(note));
  }
  structure.atoms.positions = record.relaxed->atoms.positions;
  record.network = dual::check_network(dual::without_hydrogen(structure));
  record.energy = record.relaxed->result;
  record.after = shell_state("relaxed shell", record);
  record.after.maps.push_back(dual::displacement_map(before, structure.atoms.positions));
}

std::string crossing_remedy(const BuildRecord& record) {
  if (record.wrap_offset > 0.0) {
    return "a larger shell can follow thin parts of the wrap, a larger --wrap-offset makes them "
           "thicker";
  }
  return record.input_quality.self_intersections > 0
             ? "the input does too: --repair wrap mends that"
             : "the input does not: a larger shell can follow thin parts, --feature-angle keeps "
               "sharp creases";
}

/// Where the shell is not what was asked for.
void note_misses(const dual::ShellSize& size, BuildRecord& record) {
  const auto* asked = std::get_if<dual::AtomCount>(&size);
  const int atoms = record.network.atoms;
  if (asked != nullptr &&
      std::abs(atoms - asked->atoms) > dual::atom_count_tolerance * asked->atoms) {
    record.notes.push_back("the shell has " + std::to_string(atoms) + " atoms, not the " +
                           std::to_string(asked->atoms) +
                           " asked for: no edge length that was tried came nearer");
  }
  // The net lies half inside and half outside, and rounds off what is sharp.
  constexpr double farthest_covered = 1.5;  // edges
  const double edge = record.quality.edge_length.mean;
  const double distance = record.distance.from_original.max;
  if (distance > farthest_covered * edge) {
    record.notes.push_back("a part of the surface is left out, up to " + decimals(distance, 1) +
                           " Å (" + decimals(distance / edge, 1) +
                           " edges) from the shell: more atoms can follow thin parts, "
                           "--feature-angle keeps sharp creases");
  }
}

void note_findings(BuildRecord& record) {
  const auto& network = record.network;
  if (record.quality.boundary_loops == 0 && !network.is_trivalent()) {
    record.notes.push_back("not every atom has three bonds");
  }
  if (record.quality.boundary_loops > 0 && record.caps.hydrogens == 0) {
    record.notes.push_back(
        "the surface is open: atoms at its edge have fewer than three bonds; --cap "
        "hydrogen saturates them");
  }
  if (record.quality.self_intersections > 0) {
    record.notes.push_back("the remeshed surface intersects itself in " +
                           crossings_text(record.quality.self_intersections) +
                           " pairs of triangles; " + crossing_remedy(record));
  }
}

dual::ShellOptions shell_options(const Session& session, std::optional<StopRequest>& stop) {
  return {.size = shell_size(session),
          .bond = session.get<double>("bond"),
          .method = remesh_method(session, stop)};
}

BuildRecord build(const Session& session) {
  BuildRecord record;
  std::optional<StopRequest> stop;
  const dual::ShellOptions options = shell_options(session, stop);
  BuildInput input = read_build_input(session, options);
  check_plan(plan_build(input.mesh, options));
  record.notes = std::move(input.notes);
  record.input_quality = remesh::measure_quality(input.mesh);
  record.stopwatch.finish("read");

  record.shell = dual::build_shell(input.mesh, options);
  if (record.shell.surface.stopped) {
    record.notes.push_back(stopped_note(record.shell.surface));
    record.exit_code = stop->exit_code();
  }
  record.stopwatch.finish("remesh_and_dual");
  record.wrap_offset = input.wrap_offset * record.shell.scale;
  record.components = remesh::find_components(record.shell.surface.mesh);

  record.original = std::move(input.mesh);
  remesh::scale(record.original, record.shell.scale);
  record.quality = remesh::measure_quality(record.shell.surface.mesh);
  record.distance = remesh::measure_distance(record.shell.surface.mesh, record.original);
  record.network = dual::check_network(record.shell.structure);
  if (caps_edges(session)) cap_edges(record);
  record.stopwatch.finish("measure");

  measure_energy_after(record);
  measure_energy_before(record);
  record.stopwatch.finish("energies");
  note_misses(options.size, record);
  note_findings(record);
  if (session.has("no-relax")) return record;
  if (!stop) stop.emplace();
  stop->keep_results();
  relax_shell(*stop, session, record);
  record.exit_code = stop->exit_code();
  record.stopwatch.finish("relax");
  return record;
}

void write_files(const std::filesystem::path& folder, const BuildRecord& record,
                 const Session& session) {
  remesh::write_mesh(record.shell.surface.mesh, folder / "surface.off");

  dual::Structure structure = record.shell.structure;
  structure.columns = dual::network_columns(structure);
  structure.columns.push_back({.name = "component", .values = record.components.of_face});
  dual::add_energies(structure, record.energy);
  if (record.unrelaxed) {
    dual::add_displacements(structure, record.unrelaxed->structure.atoms.positions);
  }
  dual::write_xyz(folder / "shell.extxyz", structure, digits(session));

  const dual::AtomStyle style = atom_style(session);
  dual::write_lammps_package(folder, structure, record.energy.energy,
                             {.data = {.style = style, .digits = digits(session)}});

  dual::write_energy_ply(folder / "energy.ply", structure, record.energy.energies,
                         {.scale = record.after.find("energy")->scale});
  dual::write_vtp(folder / "energy.vtp", record.after);
}

/// Tells what a build would come to.
int plan_only(const Session& session) {
  std::optional<StopRequest> stop;
  const dual::ShellOptions options = shell_options(session, stop);
  const BuildInput input = read_build_input(session, options);
  session.terminal.notes(input.notes);
  const BuildPlan plan = plan_build(input.mesh, options);
  session.terminal.print({.table = plan_rows(plan), .json = plan_json(plan)});
  return plan.obstacles.empty() ? done : failed;
}

int run(const Command& self, std::span<const std::string> arguments) {
  const auto session = start(self, arguments, grammar_of_build());
  if (!session) return done;
  if (session->has("dry-run")) return plan_only(*session);
  if (!session->has("output")) throw UsageError("-o must say into which folder the results go");
  static_cast<void>(digits(*session));
  static_cast<void>(atom_style(*session));
  static_cast<void>(shell_size(*session));
  static_cast<void>(caps_edges(*session));
  static_cast<void>(repair_options(*session));
  const std::filesystem::path folder = session->get<std::string>("output");
  check_folder(folder);

  BuildRecord record = build(*session);
  make_folder(folder);
  write_files(folder, record, *session);
  record.stopwatch.finish("write");
  const Json report = report_json(record, *session);
  remesh::write_whole_file(folder / "report.json",
                           [&](std::ostream& out) { out << json_text(report); });

  session->terminal.notes(record.notes);
  Result result = {.table = summary_rows(record), .json = report};
  write_page(folder / "report.html", report_page(record, *session));
  result.table.push_back({"results"});
  result.table.push_back({"folder", folder.string()});
  session->terminal.print(result);
  return record.exit_code;
}

}  // namespace

const Command build_command = {
    .name = "build",
    .synopsis = "SHAPE -o DIR [--atoms N | --length L | --scale s] [options]",
    .meaning = "Turns a shape into a carbon shell with energies and LAMMPS files: the whole way",
    .run = run};

}  // namespace trivalent::apps
