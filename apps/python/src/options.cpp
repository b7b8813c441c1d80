#include "options.h"

#include <numbers>

#include "trivalent/shell/build.h"
#include "trivalent/shell/option_names.h"

namespace trivalent::python {
namespace {

enum class Method { crystal, paper };
constexpr shell::Names<Method, 2> method_names = {
    {{"crystal", Method::crystal}, {"paper", Method::paper}}};

remesh::CrystalOptions crystal_options(const Options& options) {
  options.refuse({"iterations", "rings", "sigma", "restriction"}, "goes with method='paper'");
  remesh::CrystalOptions crystal;
  options.set("effort", crystal.effort, shell::effort_names);
  if (options.has("follow") && !options.is_text("follow")) {
    crystal.stiffness = options.find<double>("follow");
  } else {
    options.set("follow", crystal.follow, shell::follow_names);
  }
  options.set("seed", crystal.seed);
  return crystal;
}

remesh::RemeshOptions paper_options(const Options& options) {
  options.refuse({"effort", "follow", "seed"}, "goes with method='crystal'");
  remesh::RemeshOptions paper;
  options.set("iterations", paper.iterations);
  options.set("rings", paper.rings);
  options.set("sigma", paper.tolerance);
  options.set("restriction", paper.restriction, shell::restriction_names);
  return paper;
}

std::optional<double> feature_angle(const Options& options) {
  const auto degrees = options.find<double>("feature_angle");
  if (!degrees) return std::nullopt;
  if (!(*degrees > 0.0 && *degrees < 180.0)) {
    throw WrongOption("feature_angle must lie between 0 and 180 degrees");
  }
  return *degrees * std::numbers::pi / 180.0;
}

}  // namespace

void Options::allow_one(std::initializer_list<const char*> names) const {
  std::string given;
  int count = 0;
  for (const char* name : names) {
    if (!has(name)) continue;
    given += (count++ > 0 ? " and " : "") + std::string(name);
  }
  if (count > 1) throw WrongOption(given + " both say how large the shell is; give one");
}

void Options::refuse(std::initializer_list<const char*> names, const std::string& reason) const {
  for (const char* name : names) {
    if (has(name)) throw WrongOption(std::string(name) + ' ' + reason);
  }
}

void Options::refuse_type(const char* name) const {
  throw WrongOption(std::string(name) + " has the wrong type or is out of range: " +
                    py::repr(values_[name]).cast<std::string>());
}

dual::ShellOptions shell_options(const Options& options) {
  options.allow_one({"atoms", "length", "scale"});
  dual::ShellOptions shell;
  if (const auto atoms = options.find<int>("atoms")) shell.size = dual::AtomCount{*atoms};
  if (const auto length = options.find<double>("length")) shell.size = dual::LongestSide{*length};
  if (const auto scale = options.find<double>("scale")) shell.size = dual::Scale{*scale};
  shell.method = remesh_method(options);
  options.set("walls", shell.walls.count);
  options.set("spacing", shell.walls.spacing);
  options.set("side", shell.walls.side, shell::wall_side_names);
  shell.bond = shell::usual_bond_length(shell::BuildOptions{.shell = shell}.used_potential());
  options.set("bond", shell.bond);
  return shell;
}

std::optional<dual::DualSize> dual_size(const Options& options) {
  options.allow_one({"bond", "length", "scale"});
  if (const auto length = options.find<double>("length")) return dual::LongestSide{*length};
  if (const auto scale = options.find<double>("scale")) return dual::Scale{*scale};
  if (const auto bond = options.find<double>("bond")) return dual::MeanBond{*bond};
  return std::nullopt;
}

remesh::RemeshMethod remesh_method(const Options& options) {
  Method method = Method::crystal;
  options.set("method", method, method_names);
  if (method == Method::crystal) {
    remesh::CrystalOptions crystal = crystal_options(options);
    crystal.feature_angle = feature_angle(options);
    return crystal;
  }
  remesh::RemeshOptions paper = paper_options(options);
  paper.feature_angle = feature_angle(options);
  return paper;
}

remesh::RepairOptions repair_options(const Options& options) {
  remesh::RepairOptions repair;
  options.set("repair", repair.method, shell::repair_names);
  options.set("holes", repair.holes, shell::hole_names);
  options.set("components", repair.components, shell::component_names);
  repair.wrap_alpha = options.find<double>("wrap_alpha");
  repair.wrap_offset = options.find<double>("wrap_offset");
  return repair;
}

namespace {

std::optional<remesh::Lattice::Cell> cell_vectors(const Options& options, const char* name) {
  if (!options.has(name)) return std::nullopt;
  if (options.is_text(name)) return shell::parse_cell(*options.find<std::string>(name));
  const auto rows = *options.find<std::array<std::array<double, 3>, 3>>(name);
  remesh::Lattice::Cell cell;
  for (Eigen::Index k = 0; k < 3; ++k) {
    cell.col(k) = Eigen::Vector3d::Map(rows[static_cast<std::size_t>(k)].data());
  }
  return cell;
}

}  // namespace

shell::CellOptions cell_options(const Options& options) {
  options.allow_one({"cell", "box"});
  shell::CellOptions cell;
  if (const auto vectors = cell_vectors(options, "cell")) {
    cell.lattice = remesh::Lattice(*vectors, {true, true, true});
  }
  if (const auto vectors = cell_vectors(options, "box")) {
    cell.lattice = remesh::Lattice(*vectors, {false, false, false});
  }
  options.set("level", cell.level);
  options.set("pbc", cell.periodic);
  if (options.has("pbc") && options.has("cell") && cell.periodic == remesh::Lattice::Periodic{}) {
    throw WrongOption("pbc=False leaves no use for cell; give one or the other");
  }
  if (const auto raw = options.find<std::string>("raw")) cell.raw = shell::parse_raw_layout(*raw);
  options.set("supercell", cell.supercell);
  return cell;
}

shell::PotentialChoice potential_choice(const Options& options) {
  shell::PotentialChoice choice;
  options.set("potential", choice.name);
  options.set("lj_epsilon", choice.lennard_jones.epsilon);
  options.set("lj_sigma", choice.lennard_jones.sigma);
  options.set("lj_cutoff", choice.lennard_jones.cutoff);
  options.set("lj_shift", choice.lennard_jones.shift);
  for (const char* name : {"lj_epsilon", "lj_sigma", "lj_cutoff", "lj_shift"}) {
    if (options.has(name) && choice.name != "lj") {
      throw WrongOption(std::string(name) + " belongs to the potential lj");
    }
  }
  return choice;
}

}  // namespace trivalent::python
