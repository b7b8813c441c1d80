#include <gtest/gtest.h>

#include <Eigen/LU>
#include <nlohmann/json.hpp>
#include <numbers>

#include "small_meshes.h"
#include "small_structures.h"
#include "temporary_folder.h"
#include "trivalent/dual/build_dual.h"
#include "trivalent/dual/dual_size.h"
#include "trivalent/dual/energy_summary.h"
#include "trivalent/dual/error.h"
#include "trivalent/remesh/error.h"
#include "trivalent/remesh/mesh_io.h"
#include "trivalent/shell/atom_groups.h"
#include "trivalent/shell/build.h"
#include "trivalent/shell/build_files.h"
#include "trivalent/shell/certify.h"
#include "trivalent/shell/evaluate.h"
#include "trivalent/shell/inspect.h"
#include "trivalent/shell/names.h"
#include "trivalent/shell/plan.h"
#include "trivalent/shell/relax.h"
#include "trivalent/shell/structure_source.h"

namespace trivalent::shell {
namespace {

BuildOptions small_build() {
  BuildOptions options;
  options.shell.size = dual::AtomCount{240};
  remesh::CrystalOptions method;
  method.effort = remesh::Effort::quick;
  options.shell.method = method;
  return options;
}

TEST(Names, LeadBothWays) {
  enum class Fruit { apple, pear, plum };
  constexpr Names<Fruit, 3> names = {
      {{"apple", Fruit::apple}, {"pear", Fruit::pear}, {"plum", Fruit::plum}}};
  for (const auto& [name, value] : names) {
    EXPECT_EQ(name_of(value, names), name);
    EXPECT_EQ(value_named(name, names), value);
  }
  EXPECT_EQ(value_named("nut", names), std::nullopt);
  EXPECT_EQ(list_of(names), "apple, pear or plum");
}

TEST(ParseShape, ReadsNameAndParameters) {
  const ShapeCall call = parse_shape("torus:R=3,r=1.5");
  EXPECT_EQ(call.name, "torus");
  ASSERT_EQ(call.arguments.size(), 2u);
  EXPECT_EQ(call.arguments[1].name, "r");
  EXPECT_EQ(call.arguments[1].value, 1.5);
  EXPECT_THROW(static_cast<void>(parse_shape("torus:R=wide")), remesh::InvalidOption);
  EXPECT_TRUE(is_built_in("sphere:radius=2"));
  EXPECT_FALSE(is_built_in("sphere.off"));
}

TEST(AtomsInGroups, JoinsGroupsInAscendingOrder) {
  const dual::Structure structure = testing_support::c20();
  using Atoms = std::vector<std::uint32_t>;
  EXPECT_EQ(atoms_in_groups({"ids:3-4", "ids:1,4"}, structure.atoms, structure.bonds),
            (Atoms{0, 2, 3}));
  EXPECT_EQ(atoms_in_groups({"sphere:0,0,0,100"}, structure.atoms, structure.bonds).size(), 20u);
  // A closed cage has no edge, and a box with swapped corners holds nothing.
  for (const char* group : {"ids:21", "ids:0", "ids:2-1", "rim", "sphere:1,2,3", "box:1,2", "edge",
                            "box:5,5,5,-5,-5,-5"}) {
    EXPECT_THROW(atoms_in_groups({group}, structure.atoms, structure.bonds), dual::InvalidOption)
        << group;
  }
}

TEST(Potentials, AreFoundByTheirNames) {
  for (const KnownPotential& potential : known_potentials()) {
    const PotentialChoice choice = {.name = std::string(potential.name)};
    EXPECT_TRUE(std::isfinite(graphene_reference(choice))) << potential.name;
  }
  EXPECT_THROW(static_cast<void>(make_potential({.name = "tersoff"})), dual::InvalidOption);
  EXPECT_NE(exact_text({.name = "lj"}),
            exact_text({.name = "lj", .lennard_jones = {.sigma = 3.0}}));
}

TEST(Plan, RefusesMoreAtomsThanCanBeCounted) {
  const Surface sphere = read_surface("sphere", {});
  EXPECT_NO_THROW(plan(sphere.mesh, {}).require_feasible());
  const Plan large = plan(sphere.mesh, {.size = dual::AtomCount{100'000'000}});
  ASSERT_FALSE(large.obstacles.empty());
  EXPECT_THROW(large.require_feasible(), remesh::InvalidMesh);
  EXPECT_EQ(large.json()["obstacles"].size(), large.obstacles.size());
}

TEST(Inspect, SaysWhyAFileCannotBeRead) {
  const Inspection inspection = inspect("/nonexistent/a.off", {});
  EXPECT_EQ(inspection.verdict, Verdict::hopeless);
  EXPECT_FALSE(inspection.is_read);
  EXPECT_NE(inspection.reason.find("/nonexistent/a.off"), std::string::npos);
  EXPECT_EQ(inspection.json()["verdict"], "hopeless");
}

TEST(Build, GivesAShellAtRestThatIsSound) {
  BuildOptions options = small_build();
  std::vector<BuildStep> steps;
  options.on_step = [&](BuildStep step) { steps.push_back(step); };
  const BuildResult result = build(read_surface("sphere", options.shell), options);
  EXPECT_FALSE(result.stopped);
  EXPECT_EQ(steps, (std::vector{BuildStep::remesh_and_dual, BuildStep::measure, BuildStep::energies,
                                BuildStep::relax}));
  EXPECT_EQ(result.seconds.size(), steps.size());
  const Certificate certificate = certify(result.structure());
  EXPECT_TRUE(certificate.is_sound()) << certificate.json().dump(2);
  EXPECT_TRUE(certificate.shell.is_closed());
  EXPECT_NEAR(certificate.energy.energy, result.energy.energy, 1e-9);
}

TEST(Build, SaysWhereTheEnergySitsAndHowFarTheShellIs) {
  const BuildOptions options = small_build();
  const BuildResult result = build(read_surface("sphere", options.shell), options);
  const auto atoms = static_cast<double>(result.energy.energies.size());
  const EnergyBudget& budget = result.budget;
  EXPECT_NEAR(budget.total, result.energy.energy - atoms * dual::graphene_energy, 1e-6);
  EXPECT_EQ(budget.defects.lone_5 - budget.defects.lone_7, 12);
  ASSERT_TRUE(budget.sphere);
  EXPECT_GT(budget.total, 0.95 * *budget.sphere);  // a law for large spheres
  // No closed surface bends less than a sphere [Willmore1965]: κ/2 · 16π; a net sees it coarsely.
  EXPECT_GT(budget.bending, 0.9 * 0.5 * 1.4 * 16.0 * std::numbers::pi);
  ASSERT_TRUE(result.distance_at_rest);
  EXPECT_NEAR(result.distance_at_rest->max(), result.distance.max(),
              result.relaxation.displacement_largest);
  EXPECT_EQ(result.json()["relaxation"]["distance"]["max"], result.distance_at_rest->max());
  EXPECT_EQ(result.json()["energy"]["budget"]["total"], budget.total);
}

TEST(Build, AFlatCellBecomesGraphene) {
  // 12 edges by 14 rows of triangles.
  BuildOptions options = small_build();
  options.shell.size = dual::AtomCount{336};
  const std::string cell = "plane:a=12,b=12.12435565";
  const BuildResult result = build(read_surface(cell, options.shell), options);
  EXPECT_EQ(result.network.ring_excess, 0);
  EXPECT_NEAR(result.energy.energy, 336.0 * dual::graphene_energy, 336.0 * 1e-6);
  EXPECT_LT(result.network.bond_max - result.network.bond_min, 1e-3);
  EXPECT_NEAR(result.network.bond_mean, 1.42039, 1e-4);
  const Certificate certificate = certify(result.structure());
  EXPECT_TRUE(certificate.is_sound()) << certificate.json().dump(2);
  const Json json = result.json();
  EXPECT_EQ(json["cell"]["periodic"], Json({true, true, false}));
  EXPECT_EQ(json["cell"]["genus"], 1);
  EXPECT_TRUE(json["cell"]["density"].is_null());
}

TEST(Build, TubesAtTheEndsOfAJunctionSetItsSize) {
  BuildOptions options = small_build();
  options.shell.size.reset();
  const std::string shape = "y-junction:open=1,length=3,n=7,m=0";
  const Surface surface = read_surface(shape, options.shell);
  const BuildResult result = build(surface, options);
  // A (7,0) tube of edges √3·1.42 Å around.
  const double radius = 7.0 * std::numbers::sqrt3 * options.shell.bond / (2.0 * std::numbers::pi);
  EXPECT_NEAR(result.shell.scale, radius, 0.01 * radius);
  EXPECT_EQ(result.tube_ends, std::vector(3, std::optional(remesh::ChiralIndices{7, 0})));
  EXPECT_EQ(result.json()["tube_ends"], Json({{7, 0}, {7, 0}, {7, 0}}));
  EXPECT_EQ(result.network.ring_sizes.at(7), 6);
  options.shell.size = dual::AtomCount{500};
  EXPECT_THROW(static_cast<void>(build(surface, options)), dual::InvalidOption);
  options.shell.size = dual::Scale{2.0 * radius};
  EXPECT_THROW(static_cast<void>(build(surface, options)), remesh::InvalidOption);
  options.shell.size.reset();
  options.shell.walls.count = 2;
  EXPECT_THROW(static_cast<void>(build(surface, options)), dual::InvalidOption);
  options.shell.walls.count = 1;
  options.shell.method = remesh::RemeshOptions{};
  EXPECT_THROW(static_cast<void>(build(surface, options)), dual::InvalidOption);
}

TEST(Build, ASchwarziteGoesOnThroughItsCell) {
  BuildOptions options = small_build();
  options.shell.size = dual::AtomCount{432};
  const BuildResult result = build(read_surface("schwarz-p", options.shell), options);
  EXPECT_EQ(result.network.ring_excess, -24);  // 6 χ
  EXPECT_TRUE(result.network.is_trivalent());
  EXPECT_TRUE(result.relaxation.bonds.broken.empty());
  EXPECT_TRUE(result.relaxation.bonds.formed.empty());
  const dual::Structure structure = result.structure();
  for (const bool along : structure.atoms.box.periodic) EXPECT_TRUE(along);
  // Bonds and rings are those that distances give.
  const Certificate certificate = certify(structure);
  EXPECT_TRUE(certificate.is_sound()) << certificate.json().dump(2);
  EXPECT_EQ(certificate.shell.euler_characteristic(), -4);
  // The cell itself is at rest: no stress is left.
  EXPECT_LT(result.energy.virial.norm() / structure.atoms.box.cell.determinant(), 1e-3);
}

TEST(ReadSurface, TakesFormulasInACell) {
  const dual::ShellOptions shell = {.size = dual::AtomCount{432}};
  CellOptions cell = {.lattice = remesh::Lattice(parse_cell("2*pi"), {true, true, true})};
  const auto euler = [](const remesh::TriMesh& mesh) {
    return static_cast<int>(mesh.n_vertices() + mesh.n_faces()) - static_cast<int>(mesh.n_edges());
  };
  const std::string formula = "formula:cos(x)+cos(y)+cos(z)";
  const Surface surface = read_surface(formula, shell, {}, cell);
  EXPECT_EQ(euler(surface.mesh), -4);
  EXPECT_TRUE(surface.notes.empty());
  cell.supercell = {2, 1, 1};
  EXPECT_EQ(euler(read_surface(formula, shell, {}, cell).mesh), -8);
  cell.supercell = {1, 1, 1};
  const auto expect_refusal = [&](const std::string& source, const std::string& part) {
    try {
      static_cast<void>(read_surface(source, shell, {}, cell));
      ADD_FAILURE() << source;
    } catch (const std::runtime_error& error) {
      EXPECT_NE(std::string(error.what()).find(part), std::string::npos) << error.what();
    }
  };
  expect_refusal("formula:cos(x)+*y", "position 7");
  expect_refusal("formula:cos(x)+9", "no surface");
  expect_refusal("formula:7", "same everywhere");
  expect_refusal("formula:cos(x),cos(y)", "2 values");
  expect_refusal("formula:sqrt(x-1)", "must be finite");
  expect_refusal("formula:cos(x)+cos(y)+cos(1.1*z)", "does not repeat along cell vector 3");
  expect_refusal("schwarz-p", "belong to mesh files and formulas");
  cell.lattice = remesh::Lattice(parse_cell("1.5"), {false, false, false});
  cell.level = 1.0;
  expect_refusal("formula:x^2+y^2+z^2", "leaves the box");
  cell.lattice = remesh::Lattice(parse_cell("3"), {false, false, false});
  EXPECT_EQ(euler(read_surface("formula:x^2+y^2+z^2", shell, {}, cell).mesh), 2);
  expect_refusal("formula:1/(x^2+y^2+z^2-0.26)", "as at a pole");
  cell.lattice.reset();
  expect_refusal("formula:x^2+y^2+z^2", "--cell");
}

TEST(ParseCell, TakesLengthsAnglesAndFormulas) {
  const Eigen::Matrix3d cube = parse_cell("2*pi");
  EXPECT_TRUE(cube.isApprox(2.0 * std::numbers::pi * Eigen::Matrix3d::Identity()));
  Eigen::Matrix3d vectors;
  vectors << 1, 4, 7, 2, 5, 8, 3, 6, 10;
  EXPECT_EQ(parse_cell("1,2,3,4,5,6,7,8,10"), vectors);
  const Eigen::Matrix3d hexagonal = parse_cell("3,3,5,90,90,120");
  EXPECT_NEAR(hexagonal.determinant(), 45.0 * std::sqrt(0.75), 1e-9);
  for (const char* wrong : {"", "1,2", "1,-1,1", "1,1,1,90,90", "a", "1,1,1,10,10,90", "x"}) {
    EXPECT_THROW(static_cast<void>(parse_cell(wrong)), remesh::InvalidOption) << wrong;
  }
}

TEST(InCell, JoinsWhatMeetsAcrossTheCellsFaces) {
  const remesh::TriMesh shape = remesh::make_shape("schwarz-p", {}, 0.05);
  const testing_support::TemporaryFolder folder;
  remesh::write_mesh(shape, folder.path() / "p.stl");
  const auto read = [&](const std::string& cell) {
    return read_surface((folder.path() / "p.stl").string(), {}, {},
                        {.lattice = remesh::Lattice(parse_cell(cell), {true, true, true})});
  };
  const Surface surface = read("1");
  EXPECT_EQ(surface.mesh.n_faces(), shape.n_faces());
  EXPECT_EQ(surface.mesh.n_vertices(), shape.n_vertices());
  EXPECT_NEAR(remesh::surface_area(surface.mesh), remesh::surface_area(shape), 1e-5);
  try {
    static_cast<void>(read("1.1"));
    FAIL();
  } catch (const remesh::InvalidMesh& error) {
    EXPECT_NE(std::string(error.what()).find("is 0.1 away"), std::string::npos) << error.what();
  }
  EXPECT_THROW(static_cast<void>(read("1e-5")), remesh::InvalidMesh);
  EXPECT_THROW(static_cast<void>(in_cell({.mesh = shape}, {.lattice = remesh::Lattice()})),
               remesh::InvalidOption);
}

TEST(Build, StopsTheRelaxationWhereItIs) {
  BuildOptions options = small_build();
  options.on_relax = [](const potentials::RelaxProgress&) { return false; };
  const BuildResult result = build(read_surface("sphere", options.shell), options);
  EXPECT_TRUE(result.stopped);
  ASSERT_TRUE(result.relaxed);
  EXPECT_FALSE(result.relaxed->converged);
}

TEST(WriteBuild, LeavesAShellThatReadsBackTheSame) {
  const testing_support::TemporaryFolder folder;
  BuildOptions options = small_build();
  options.relaxation = Relaxation::none;
  const BuildResult result = build(read_surface("sphere", options.shell), options);
  write_build(folder.path(), result, {.digits = dual::Digits::seventeen_significant});
  const auto file = read_structure(folder.path() / "shell.extxyz");
  EXPECT_EQ(file.structure.atoms.positions, result.shell.structure.atoms.positions);
  for (const char* name : {"surface.off", "shell.data", "in.check", "energy.ply", "energy.vtp"}) {
    EXPECT_TRUE(std::filesystem::exists(folder.path() / name)) << name;
  }
}

TEST(Certify, FindsAtomsThatAreNotAtRest) {
  const Certificate certificate = certify(testing_support::c20());
  EXPECT_FALSE(certificate.is_sound());
  EXPECT_EQ(certificate.json()["sound"], false);
  EXPECT_TRUE(certificate.shell.is_closed());
  EXPECT_TRUE(certify(relax(testing_support::c20()).structure).shell.is_closed());
  EXPECT_THROW(static_cast<void>(certify(testing_support::c20(), {.max_force = 0.0})),
               dual::InvalidOption);
  EXPECT_THROW(static_cast<void>(certify(testing_support::c20(),
                                         {.potential = {.name = "lj"}, .lammps = LammpsOptions{}})),
               dual::InvalidOption);
}

TEST(Relax, BringsAtomsToRestAndSaysHowFarTheyMoved) {
  const dual::Structure start = testing_support::c20();
  const RelaxedStructure result = relax(start);
  EXPECT_TRUE(result.relaxed.converged);
  const Evaluation after = evaluate(result.structure, {.forces = ForceReport::all});
  EXPECT_LE(after.json()["largest_force"].get<double>(), RelaxOptions().max_force * (1.0 + 1e-9));
  const auto column =
      std::ranges::find(result.structure.columns, "displacement", &dual::Column::name);
  ASSERT_NE(column, result.structure.columns.end());
  const auto& moved = std::get<std::vector<Eigen::Vector3d>>(column->values);
  for (std::size_t i = 0; i < moved.size(); ++i) {
    EXPECT_LT((start.atoms.positions[i] + moved[i] - result.structure.atoms.positions[i]).norm(),
              1e-12);
  }
}

TEST(Relax, RefusesOptionsOutOfTheirRange) {
  EXPECT_THROW(static_cast<void>(relax(testing_support::c20(), {.max_force = 0.0})),
               dual::InvalidOption);
  EXPECT_THROW(static_cast<void>(relax(testing_support::c20(), {.max_steps = 0})),
               dual::InvalidOption);
  EXPECT_THROW(static_cast<void>(
                   relax(testing_support::c20(), {.lammps = LammpsRelaxation{.style = "newton"}})),
               dual::InvalidOption);
}

}  // namespace
}  // namespace trivalent::shell
