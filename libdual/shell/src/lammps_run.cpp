#include "trivalent/shell/lammps_run.h"

#include <unistd.h>

#include <algorithm>
#include <array>
#include <boost/process/args.hpp>
#include <boost/process/child.hpp>
#include <boost/process/env.hpp>
#include <boost/process/exe.hpp>
#include <boost/process/io.hpp>
#include <boost/process/pipe.hpp>
#include <boost/process/search_path.hpp>
#include <boost/process/start_dir.hpp>
#include <cstdlib>
#include <fstream>
#include <sstream>
#include <utility>

#include "lammps_output.h"
#include "trivalent/dual/check_atoms.h"
#include "trivalent/dual/error.h"
#include "trivalent/formats/lammps_data.h"
#include "trivalent/formats/lammps_frame.h"
#include "trivalent/remesh/whole_file.h"

namespace trivalent::shell {
namespace {

namespace bp = boost::process;
namespace fs = std::filesystem;

std::string require_program(const std::string& program, const std::string& package) {
  std::string path = bp::search_path(program).string();
  if (!path.empty()) return path;
  throw dual::Error("LAMMPS is to be run, but its program " + program +
                    " is not in the path (Debian: apt install " + package + ")");
}

/// A new folder whose name begins so.
fs::path make_folder_of_our_own(const fs::path& name) {
  std::string path = name.string() + "-XXXXXX";
  if (::mkdtemp(path.data()) == nullptr) {
    throw dual::FileError("cannot make the folder " + path + " for LAMMPS's files");
  }
  return path;
}

bool has_tilts(const potentials::Box& box) {
  return box.cell(0, 1) != 0.0 || box.cell(0, 2) != 0.0 || box.cell(1, 2) != 0.0;
}

/// LAMMPS works in a folder of its own: files that are here are named by their whole path.
std::optional<dual::PairStyle> with_whole_paths(std::optional<dual::PairStyle> pair_style) {
  if (!pair_style) return pair_style;
  for (std::string& coefficients : pair_style->coefficients) {
    std::istringstream words(std::exchange(coefficients, {}));
    for (std::string word; words >> word;) {
      std::error_code error;
      if (fs::is_regular_file(word, error)) word = fs::absolute(word).lexically_normal().string();
      coefficients += (coefficients.empty() ? "" : " ") + word;
    }
  }
  return pair_style;
}

void write_input(const potentials::Atoms& atoms, const LammpsTask& task, const fs::path& folder,
                 const LammpsOptions& options) {
  dual::write_lammps_data(folder / "atoms.data", {.atoms = atoms},
                          {.digits = dual::Digits::seventeen_significant});
  const dual::LammpsDeckOptions deck = {.data_files = {"atoms.data"},
                                        .periodic = atoms.box.periodic,
                                        .has_hydrogen = dual::has_hydrogen(atoms),
                                        .potential = options.potential,
                                        .potential_file = find_potential_file(options).name,
                                        .pair_style = with_whole_paths(options.pair_style)};
  const dual::LammpsMinimization minimization = {.style = task.style,
                                                 .max_force = task.max_force,
                                                 .max_steps = task.max_steps,
                                                 .fixed = task.fixed,
                                                 .relax_box = task.relax_box,
                                                 .has_tilts = has_tilts(atoms.box),
                                                 .ranks = options.ranks};
  remesh::write_whole_file(folder / "in.minimize", [&](std::ostream& out) {
    dual::write_lammps_minimization(out, deck, minimization);
  });
}

/// Runs LAMMPS in the folder and hands over what it says, line by line; returns its exit code.
int run_and_listen(const fs::path& folder, int ranks, LammpsOutput& output) {
  std::string program = require_program("lmp", "lammps");
  std::vector<std::string> arguments = {"-in", "in.minimize", "-log", "log.lammps"};
  bp::environment environment = boost::this_process::environment();
  if (ranks > 1) {
    // Open MPI must be asked twice before it works for root or shares processors.
    environment["OMPI_ALLOW_RUN_AS_ROOT"] = "1";
    environment["OMPI_ALLOW_RUN_AS_ROOT_CONFIRM"] = "1";
    environment["OMPI_MCA_rmaps_base_oversubscribe"] = "1";
    arguments.insert(arguments.begin(), {"-np", std::to_string(ranks), program});
    program = require_program("mpirun", "openmpi-bin");
  }
  bp::ipstream lines;
  bp::child lammps(bp::exe = program, bp::args = arguments, bp::start_dir = folder.string(),
                   environment, (bp::std_out & bp::std_err) > lines, bp::std_in < bp::null);
  for (std::string line; std::getline(lines, line);) output.hear(line);
  lammps.wait();
  return lammps.exit_code();
}

/// Positions, forces and energies from LAMMPS's dump.
void read_dump(const fs::path& path, potentials::RelaxResult& result) {
  std::ifstream in(path);
  std::string line;
  while (std::getline(in, line) && !line.starts_with("ITEM: ATOMS")) {
  }
  potentials::Atoms& atoms = result.atoms;
  potentials::EnergyForces& energy = result.result;
  energy.energies.resize(atoms.size());
  energy.forces.resize(atoms.size());
  for (std::size_t i = 0; i < atoms.size(); ++i) {
    std::size_t id = 0;
    Eigen::Vector3d& x = atoms.positions[i];
    Eigen::Vector3d& f = energy.forces[i];
    in >> id >> x.x() >> x.y() >> x.z() >> f.x() >> f.y() >> f.z() >> energy.energies[i];
    if (!in || id != i + 1) {
      throw dual::Error("LAMMPS lost atom " + std::to_string(i + 1) + "; see " + path.string());
    }
    energy.energy += energy.energies[i];
  }
}

/// From LAMMPS's frame to the one of the atoms that were given.
void take_back(const dual::LammpsFrame& frame, const potentials::Box& before,
               potentials::RelaxResult& result) {
  result.atoms.box = frame.back(result.atoms.box, before);
  if (!frame.is_rotated()) return;
  for (Eigen::Vector3d& x : result.atoms.positions) x = frame.back(x);
  for (Eigen::Vector3d& force : result.result.forces) force = frame.back(force);
}

/// What would mend a complaint, if that is known.
std::string hint_for(const std::string& complaint) {
  if (complaint.find("cannot open") != std::string::npos) {
    return "; name the file by its path, or its folder in LAMMPS_POTENTIALS (Debian: "
           "/usr/share/lammps/potentials of lammps-data)";
  }
  if (complaint.find("nrecognized pair style") != std::string::npos) {
    return "; lmp -help lists the pair styles of this LAMMPS";
  }
  return "";
}

double largest_force(const std::vector<Eigen::Vector3d>& forces,
                     const std::vector<std::uint32_t>& fixed) {
  double largest = 0.0;
  auto next = fixed.begin();
  for (std::uint32_t i = 0; i < forces.size(); ++i) {
    if (next != fixed.end() && *next == i) {
      ++next;
    } else {
      largest = std::max(largest, forces[i].norm());
    }
  }
  return largest;
}

}  // namespace

void require_lammps(const LammpsOptions& options) {
  if (options.ranks < 1) throw dual::InvalidOption("LAMMPS needs at least 1 rank");
  require_program("lmp", "lammps");
  if (options.ranks > 1) require_program("mpirun", "openmpi-bin");
}

bool has_pair_style(const std::string& style) {
  const std::string program = bp::search_path("lmp").string();
  if (program.empty()) return false;
  bp::ipstream help;
  bp::child lammps(bp::exe = program, bp::args = {"-help"}, bp::std_out > help,
                   bp::std_err > bp::null, bp::std_in < bp::null);
  bool is_known = false;
  bool is_list = false;
  for (std::string line; std::getline(help, line);) {
    if (line.starts_with("* ")) is_list = line.starts_with("* Pair styles");
    std::istringstream words(line);
    for (std::string word; is_list && words >> word;) {
      is_known = is_known || word == style.substr(0, style.find(' '));
    }
  }
  lammps.wait();
  return is_known;
}

LammpsPotentialFile find_potential_file(const LammpsOptions& options) {
  if (const auto& named = options.potential_file) {
    if (!fs::is_regular_file(*named)) {
      throw dual::InvalidOption("there is no potential file '" + named->string() + "'");
    }
    return {.name = fs::absolute(*named).lexically_normal().string()};
  }
  const std::string name = dual::file_name_of(options.potential);
  const char* folder = std::getenv("LAMMPS_POTENTIALS");
  for (const fs::path place : {folder != nullptr ? folder : ".", "/usr/share/lammps/potentials"}) {
    if (fs::exists(place / name)) return {.name = name};
  }
  return {.name = name,
          .warning = name +
                     " is not on this machine; it comes with LAMMPS (Debian: lammps-data). "
                     "Set LAMMPS_POTENTIALS to its folder, or name it with "
                     "--potential-file"};
}

potentials::RelaxResult run_lammps(const potentials::Atoms& atoms, const LammpsTask& task,
                                   const LammpsOptions& options) {
  const fs::path folder =
      make_folder_of_our_own(task.folder.value_or(fs::temp_directory_path() / "trivalent-lammps"));
  const dual::LammpsFrame frame = dual::lammps_frame(atoms);
  write_input(frame.atoms, task, folder, options);
  LammpsOutput output(task);
  if (run_and_listen(folder, options.ranks, output) != 0) {
    throw dual::Error("LAMMPS failed: " + output.complaint() + hint_for(output.complaint()) +
                      " (its files are in " + folder.string() + ")");
  }
  potentials::RelaxResult result;
  result.atoms = frame.atoms;
  result.steps = output.steps();
  result.evaluations = output.evaluations();
  read_dump(folder / "result.dump", result);
  if (task.relax_box) output.read_box(result.atoms.box);
  take_back(frame, atoms.box, result);
  result.largest_force = largest_force(result.result.forces, task.fixed);
  result.converged = result.largest_force <= task.max_force;
  result.end = result.converged ? potentials::RelaxEnd::at_rest : potentials::RelaxEnd::no_descent;
  fs::remove_all(folder);
  return result;
}

}  // namespace trivalent::shell
