#include "cell_options.h"

#include <algorithm>

#include "structure_options.h"

namespace trivalent::apps {

namespace {

remesh::Lattice::Periodic directions_of_cell(const std::string& text) {
  const remesh::Lattice::Periodic periodic = periodic_directions(text);
  if (periodic == remesh::Lattice::Periodic{}) {
    throw UsageError("--periodic none leaves no use for --cell; give one or the other");
  }
  return periodic;
}

}  // namespace

void add_mesh_cell_options(po::options_description& options) {
  options.add_options()  //
      ("cell", po::value<std::string>(),
       "a[,b,c[,alpha,beta,gamma]]: the periodic cell; the mesh shows one and is open where it "
       "goes "
       "on in the next; lengths in its unit, angles in degree, formulas allowed: 2*pi; or the nine "
       "coordinates of the cell vectors")  //
      ("periodic", po::value<std::string>(),
       "cell vectors along which it repeats, as in xy; default: xyz; with fewer, other edges stay "
       "open");
}

shell::CellOptions mesh_cell_options(const Session& session) {
  shell::CellOptions options;
  if (const auto cell = session.find<std::string>("cell")) {
    options.lattice = remesh::Lattice(shell::parse_cell(*cell), {true, true, true});
  }
  if (const auto periodic = session.find<std::string>("periodic")) {
    if (!options.lattice) throw UsageError("--periodic belongs to --cell");
    options.periodic = directions_of_cell(*periodic);
  }
  return options;
}

void add_cell_options(po::options_description& options) {
  const shell::CellOptions defaults;
  options.add_options()  //
      ("cell", po::value<std::string>(),
       "a[,b,c[,alpha,beta,gamma]]: the periodic cell of a formula, or of a mesh file that shows "
       "one cell and is open where it goes on in the next; lengths in the input's unit, angles in "
       "degree, formulas allowed: 2*pi; or the nine coordinates of the cell vectors")  //
      ("formula", po::value<std::string>(),
       "in place of SHAPE: the surface where a function of x, y and z has the value --level, such "
       "as \"cos(x)+cos(y)+cos(z)\"")  //
      ("level", with_default(defaults.level),
       "value of the formula or volume on the surface; it is lower inside, but for a volume that "
       "is not periodic")  //
      ("periodic", po::value<std::string>(),
       "axes along which a volume repeats, as in xyz or z; default: none. For a mesh with --cell: "
       "cell vectors along which it repeats; default: xyz; with fewer, other edges stay open")  //
      ("raw", po::value<std::string>(),
       "nx,ny,nz,type[,spacing]: what a .raw volume holds, as in 64,64,64,uint16,0.5; the first "
       "axis runs fastest")  //
      ("box", po::value<std::string>(),
       "a[,b,c]: box around the origin that holds the closed surface of a formula")  //
      ("supercell", po::value<std::vector<int>>()->multitoken(),
       "a b c: build so many cells along each cell vector");
}

shell::CellOptions cell_options(const Session& session) {
  shell::CellOptions options;
  const auto cell = session.find<std::string>("cell");
  const auto box = session.find<std::string>("box");
  if (cell && box) throw UsageError("--cell is for periodic surfaces, --box for closed ones");
  if (box && !session.has("formula")) throw UsageError("--box belongs to --formula");
  const auto shape = session.find<std::string>("SHAPE");
  const bool has_level = session.has("formula") || (shape && remesh::is_volume_file(*shape));
  if (!session.values["level"].defaulted() && !has_level) {
    throw UsageError("--level belongs to --formula or a volume");
  }
  if (cell) options.lattice = remesh::Lattice(shell::parse_cell(*cell), {true, true, true});
  if (box) options.lattice = remesh::Lattice(shell::parse_cell(*box), {false, false, false});
  options.level = session.get<double>("level");
  if (const auto periodic = session.find<std::string>("periodic")) {
    options.periodic = cell ? directions_of_cell(*periodic) : periodic_directions(*periodic);
  }
  if (const auto raw = session.find<std::string>("raw")) {
    options.raw = shell::parse_raw_layout(*raw);
  }
  if (const auto times = session.find<std::vector<int>>("supercell")) {
    if (times->size() != options.supercell.size()) {
      throw UsageError("--supercell takes three numbers, one for each cell vector");
    }
    std::ranges::copy(*times, options.supercell.begin());
  }
  return options;
}

std::string surface_name(const Session& session) {
  const auto shape = session.find<std::string>("SHAPE");
  const auto formula = session.find<std::string>("formula");
  if (shape && formula) throw UsageError("give SHAPE or --formula, not both");
  if (formula) return std::string(shell::formula_prefix) + *formula;
  if (!shape) throw UsageError("missing SHAPE, or --formula");
  return *shape;
}

}  // namespace trivalent::apps
