#include "lammps_engine.h"

#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cstdio>
#include <cstdlib>
#include <fstream>
#include <functional>
#include <sstream>
#include <stdexcept>

#include "trivalent/dual/check_atoms.h"
#include "trivalent/formats/lammps_data.h"
#include "trivalent/formats/lammps_deck.h"
#include "trivalent/remesh/whole_file.h"

namespace trivalent::apps {
namespace {

namespace fs = std::filesystem;

bool is_installed(const std::string& program) {
  const char* path = std::getenv("PATH");
  std::istringstream folders(path != nullptr ? path : "");
  for (std::string folder; std::getline(folders, folder, ':');) {
    if (::access((fs::path(folder) / program).c_str(), X_OK) == 0) return true;
  }
  return false;
}

void require_program(const std::string& program, const std::string& package) {
  if (is_installed(program)) return;
  throw std::runtime_error("LAMMPS is to be run, but its program " + program +
                           " is not in the path (Debian: apt install " + package + ")");
}

bool is_airebo(const Session& session) { return session.get<std::string>("potential") == "airebo"; }

std::string usual_potential_file(const Session& session) {
  return is_airebo(session) ? "CH.airebo" : "CH.rebo";
}

/// A word of a shell's command line.
std::string shell_word(const std::string& text) {
  std::string word = "'";
  for (const char c : text) word += c == '\'' ? std::string("'\\''") : std::string(1, c);
  return word + "'";
}

/// Runs a command line and hands over what it says, line by line; returns its exit code.
int run_and_listen(const std::string& command,
                   const std::function<void(const std::string&)>& hear) {
  FILE* pipe = ::popen(command.c_str(), "r");
  if (pipe == nullptr) throw std::runtime_error("cannot start: " + command);
  std::string line;
  for (int c = std::fgetc(pipe); c != EOF; c = std::fgetc(pipe)) {
    if (c != '\n') {
      line += static_cast<char>(c);
      continue;
    }
    hear(line);
    line.clear();
  }
  const int status = ::pclose(pipe);
  return WIFEXITED(status) ? WEXITSTATUS(status) : failed;
}

/// Understands what LAMMPS says while it works.
class LammpsOutput {
 public:
  LammpsOutput(const LammpsTask& task, const Terminal& terminal)
      : task_(task), terminal_(terminal) {}

  void hear(const std::string& line) {
    if (first_error_.empty() && line.find("ERROR") != std::string::npos) first_error_ = line;
    const bool is_crash_report = line.starts_with('[');  // by Open MPI
    if (!line.empty() && !is_crash_report) last_ = line;
    if (line.starts_with("box ")) box_ = line.substr(4);
    std::sscanf(line.c_str(), " Iterations, force evaluations = %d %d", &steps_, &evaluations_);
    hear_thermo(line);
  }

  [[nodiscard]] int steps() const { return steps_; }
  [[nodiscard]] int evaluations() const { return std::max(evaluations_, 1); }
  /// Of a run that failed.
  [[nodiscard]] std::string complaint() const {
    return first_error_.empty() ? "it ended after '" + last_ + "'" : first_error_;
  }

  /// The box as it is in the end.
  void read_box(potentials::Box& box) const {
    std::istringstream in(box_);
    Eigen::Vector3d low;
    Eigen::Vector3d high;
    std::array<double, 3> tilts{};
    for (double* value : {&low[0], &low[1], &low[2], &high[0], &high[1], &high[2]}) in >> *value;
    for (double& tilt : tilts) in >> tilt;
    if (!in) throw std::runtime_error("LAMMPS said nothing about its box");
    box.origin = low;
    box.cell = (high - low).asDiagonal();
    box.cell(0, 1) = tilts[0];
    box.cell(0, 2) = tilts[1];
    box.cell(1, 2) = tilts[2];
  }

 private:
  void hear_thermo(const std::string& line) {
    std::istringstream in(line);
    int step = 0;
    double energy = 0.0;
    double force = 0.0;
    if (!(in >> step >> energy >> force) || !(in >> std::ws).eof()) return;
    if (task_.max_steps == 0) return;
    terminal_.progress("relaxing (LAMMPS, " + task_.style + "): step " + std::to_string(step) +
                       ", energy " + decimals(energy, 4) + " eV, largest force component " +
                       significant(force) + " eV/Å");
  }

  const LammpsTask& task_;
  const Terminal& terminal_;
  std::string first_error_;
  std::string last_;
  std::string box_;
  int steps_ = 0;
  int evaluations_ = 0;
};

bool has_tilts(const potentials::Box& box) {
  return box.cell(0, 1) != 0.0 || box.cell(0, 2) != 0.0 || box.cell(1, 2) != 0.0;
}

/// A new folder whose name begins so.
fs::path make_folder_of_our_own(const fs::path& name) {
  std::string path = name.string() + "-XXXXXX";
  if (::mkdtemp(path.data()) == nullptr) {
    throw std::runtime_error("cannot make the folder " + path + " for LAMMPS's files");
  }
  return path;
}

void write_input(const potentials::Atoms& atoms, const LammpsTask& task, const fs::path& folder,
                 const Session& session) {
  dual::write_lammps_data(folder / "atoms.data", {.atoms = atoms},
                          {.digits = dual::Digits::seventeen_significant});
  const dual::LammpsDeckOptions deck = {
      .data_files = {"atoms.data"},
      .periodic = atoms.box.periodic,
      .has_hydrogen = dual::has_hydrogen(atoms),
      .potential = is_airebo(session) ? dual::LammpsPotential::airebo : dual::LammpsPotential::rebo,
      .potential_file = potential_file(session, usual_potential_file(session))};
  const dual::LammpsMinimization minimization = {.style = task.style,
                                                 .max_force = task.max_force,
                                                 .max_steps = task.max_steps,
                                                 .fixed = task.fixed,
                                                 .relax_box = task.relax_box,
                                                 .has_tilts = has_tilts(atoms.box),
                                                 .ranks = session.get<int>("ranks")};
  remesh::write_whole_file(folder / "in.minimize", [&](std::ostream& out) {
    dual::write_lammps_minimization(out, deck, minimization);
  });
}

std::string command_line(const fs::path& folder, int ranks) {
  std::string command = "cd " + shell_word(folder.string()) + " && exec ";
  if (ranks > 1) {
    // Open MPI wants to be asked twice before it works for root or shares processors.
    command +=
        "env OMPI_ALLOW_RUN_AS_ROOT=1 OMPI_ALLOW_RUN_AS_ROOT_CONFIRM=1 "
        "OMPI_MCA_rmaps_base_oversubscribe=1 mpirun -np " +
        std::to_string(ranks) + ' ';
  }
  return command + "lmp -in in.minimize -log log.lammps 2>&1 < /dev/null";
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
      throw std::runtime_error("LAMMPS lost atom " + std::to_string(i + 1) + "; see " +
                               path.string());
    }
    energy.energy += energy.energies[i];
  }
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

void add_lammps_options(po::options_description& options) {
  options.add_options()                                            //
      ("ranks", with_default(1), "MPI processes of LAMMPS, >= 1")  //
      ("potential-file", po::value<std::string>(),
       "CH.rebo or CH.airebo for LAMMPS; default: it finds them itself");
}

void add_engine_options(po::options_description& options) {
  options.add_options()("engine", with_default(std::string("own")),
                        "who computes: own, or lammps (its program lmp)");
  add_lammps_options(options);
}

bool uses_lammps(const Session& session) {
  const auto& engine = session.get<std::string>("engine");
  if (engine == "own" || engine == "lammps") return engine == "lammps";
  throw UsageError("--engine is own or lammps, not '" + engine + "'");
}

void check_lammps(const Session& session) {
  const int ranks = session.get<int>("ranks");
  if (ranks < 1) throw UsageError("--ranks must be at least 1");
  if (session.get<std::string>("potential") == "lj") {
    throw UsageError("LAMMPS is asked for the potentials rebo and airebo only, not lj");
  }
  require_program("lmp", "lammps");
  if (ranks > 1) require_program("mpirun", "openmpi-bin");
}

void check_engine(const Session& session) {
  if (uses_lammps(session)) {
    check_lammps(session);
  } else if (session.get<int>("ranks") != 1 || session.has("potential-file")) {
    throw UsageError("--ranks and --potential-file go with --engine lammps");
  }
}

std::string potential_file(const Session& session, const std::string& usual_name) {
  if (const auto named = session.find<std::string>("potential-file")) {
    if (!fs::is_regular_file(*named)) {
      throw UsageError("--potential-file: there is no file '" + *named + "'");
    }
    return fs::absolute(*named).lexically_normal().string();
  }
  const char* folder = std::getenv("LAMMPS_POTENTIALS");
  for (const fs::path place : {folder != nullptr ? folder : ".", "/usr/share/lammps/potentials"}) {
    if (fs::exists(place / usual_name)) return usual_name;
  }
  session.terminal.note(usual_name +
                        " is not on this machine; it comes with LAMMPS (Debian: lammps-data). Set "
                        "LAMMPS_POTENTIALS to its folder, or name it with --potential-file");
  return usual_name;
}

potentials::RelaxResult run_lammps(const potentials::Atoms& atoms, const LammpsTask& task,
                                   const fs::path& name, const Session& session) {
  const fs::path folder = make_folder_of_our_own(name);
  write_input(atoms, task, folder, session);
  LammpsOutput output(task, session.terminal);
  const int exit_code = run_and_listen(command_line(folder, session.get<int>("ranks")),
                                       [&](const std::string& line) { output.hear(line); });
  if (exit_code != 0) {
    throw std::runtime_error("LAMMPS failed: " + output.complaint() + " (its files are in " +
                             folder.string() + ")");
  }
  potentials::RelaxResult result;
  result.atoms = atoms;
  result.steps = output.steps();
  result.evaluations = output.evaluations();
  read_dump(folder / "result.dump", result);
  if (task.relax_box) output.read_box(result.atoms.box);
  result.largest_force = largest_force(result.result.forces, task.fixed);
  result.converged = result.largest_force <= task.max_force;
  result.end = result.converged ? potentials::RelaxEnd::at_rest : potentials::RelaxEnd::no_descent;
  fs::remove_all(folder);
  return result;
}

}  // namespace trivalent::apps
