#include "trivalent/dual/walls.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <numbers>
#include <numeric>
#include <sstream>

#include "trivalent/dual/error.h"
#include "trivalent/dual/graphene.h"
#include "trivalent/dual/ideal_structures.h"
#include "trivalent/formats/lammps_data.h"
#include "trivalent/potentials/airebo.h"
#include "trivalent/remesh/error.h"
#include "trivalent/remesh/mesh_components.h"
#include "trivalent/remesh/shapes.h"
#include "trivalent/shell/build.h"
#include "trivalent/shell/certify.h"
#include "trivalent/shell/relax.h"
#include "trivalent/shell/wall_energies.h"

namespace trivalent {
namespace {

using dual::Structure;
using std::numbers::pi;

/// Three walls of a sphere of radius 6 Å, quickly.
dual::ShellOptions three_walls(dual::WallSide side = dual::WallSide::outwards) {
  return {.size = dual::Scale{1.0},
          .method = remesh::CrystalOptions{.effort = remesh::Effort::quick},
          .walls = {.count = 3, .side = side}};
}

remesh::TriMesh sphere(double radius) {
  return remesh::make_shape("sphere", {{"radius", radius}}, 0.1 * radius);
}

TEST(Walls, AreKnownByTheirColumn) {
  const Structure onion = dual::icosahedral_onion(3);
  EXPECT_EQ(dual::walls_of(onion).size(), onion.atoms.size());
  EXPECT_TRUE(dual::walls_of(dual::icosahedral_onion(1)).empty());  // one is none
  Structure other = onion;  // a column that counts something else
  std::get<std::vector<int>>(other.columns.front().values)[0] = 1000000000;
  EXPECT_TRUE(dual::walls_of(other).empty());
  Structure plain = onion;
  plain.columns.clear();
  EXPECT_TRUE(dual::walls_of(plain).empty());
  EXPECT_TRUE(dual::check_walls(plain).empty());
}

TEST(Walls, OfAnOnionAreCagesAtTheirDistance) {
  const std::vector<dual::WallReport> walls = dual::check_walls(dual::icosahedral_onion(3));
  ASSERT_EQ(walls.size(), 3U);
  for (const dual::WallReport& wall : walls) {
    EXPECT_EQ(wall.network.atoms, 60 * (wall.wall + 1) * (wall.wall + 1));
    EXPECT_EQ(wall.network.ring_sizes.at(5), 12);
    EXPECT_EQ(wall.network.ring_excess, 12);
    EXPECT_EQ(wall.gap.has_value(), wall.wall > 0);
    ASSERT_TRUE(wall.closest);
    EXPECT_GT(wall.closest->distance, 3.0);
    if (wall.gap) {
      EXPECT_NEAR(*wall.gap, 3.6, 0.2);  // of spheres 3.54 Å apart
    }
  }
}

TEST(Walls, CountBondsBetweenThem) {
  Structure onion = dual::icosahedral_onion(2);
  EXPECT_EQ(dual::bonds_between_walls(onion), 0);
  onion.bonds.push_back({.first = 0, .second = 60});
  EXPECT_EQ(dual::bonds_between_walls(onion), 1);
}

TEST(Walls, AreMoleculesOfLammps) {
  std::ostringstream file;
  dual::write_lammps_data(file, dual::icosahedral_onion(2), {.style = dual::AtomStyle::molecular});
  EXPECT_NE(file.str().find("\n60 1 1 "), std::string::npos);
  EXPECT_NE(file.str().find("\n61 2 1 "), std::string::npos);
}

TEST(WallEnergies, AreWhatTheWholeHasBeyondItsParts) {
  const Structure onion = dual::icosahedral_onion(2);
  potentials::Airebo airebo;
  const potentials::EnergyForces whole = airebo.evaluate(onion.atoms);
  const std::vector<double> gained = shell::wall_energies(onion, whole.energies, airebo);
  const double inner = airebo.evaluate(dual::icosahedral_fullerene(60).atoms).energy;
  const double outer = airebo.evaluate(dual::icosahedral_fullerene(240).atoms).energy;
  const double sum = std::accumulate(gained.begin(), gained.end(), 0.0);
  EXPECT_NEAR(sum, whole.energy - inner - outer, 1e-9);
  EXPECT_LT(sum, -5.0);
  // Half of each pair's energy is on either side.
  EXPECT_NEAR(std::accumulate(gained.begin(), gained.begin() + 60, 0.0), 0.5 * sum, 1e-9);
  EXPECT_TRUE(shell::wall_energies(dual::icosahedral_onion(1), whole.energies, airebo).empty());
}

TEST(Relax, FindsTheBindingOfAnIcosahedralOnion) {
  // C60 in C240 in C540 in C960.
  const shell::RelaxOptions options = {.potential = {.name = "airebo"}};
  const Structure onion = shell::relax(dual::icosahedral_onion(4), options).structure;
  potentials::Airebo airebo;
  double binding = airebo.evaluate(onion.atoms).energy;
  for (const int atoms : {60, 240, 540, 960}) {
    const auto cage = shell::relax(dual::icosahedral_fullerene(atoms), options);
    binding -= cage.relaxed.result.energy;
  }
  EXPECT_NEAR(binding, -55.764, 2e-3);
  std::array<double, 4> radius = {};
  const std::vector<int> walls = dual::walls_of(onion);
  for (std::size_t i = 0; i < walls.size(); ++i) {
    const int wall = walls[i];
    radius[static_cast<std::size_t>(wall)] +=
        onion.atoms.positions[i].norm() / (60.0 * (wall + 1) * (wall + 1));
  }
  EXPECT_NEAR(radius[1] - radius[0], 3.399, 2e-3);
  EXPECT_NEAR(radius[2] - radius[1], 3.410, 2e-3);
  EXPECT_NEAR(radius[3] - radius[2], 3.443, 2e-3);
}

TEST(BuildShell, EstimatesTheAtomsOfAllWalls) {
  const remesh::TriMesh mesh = sphere(10.0);
  const double face_area = 0.75 * std::sqrt(3.0) * 1.42 * 1.42;
  for (const dual::WallSide side : {dual::WallSide::outwards, dual::WallSide::inwards}) {
    const double step = side == dual::WallSide::outwards ? 3.4 : -3.4;
    double area = 0.0;
    for (int wall = 0; wall < 3; ++wall) area += 4.0 * pi * std::pow(10.0 + wall * step, 2);
    const dual::ShellEstimate estimate = dual::estimate_shell(mesh, three_walls(side));
    EXPECT_NEAR(estimate.atoms / (area / face_area), 1.0, 0.01);
    // The number of atoms leads back to the scale.
    dual::ShellOptions of_count = three_walls(side);
    of_count.size = dual::AtomCount{static_cast<int>(std::lround(estimate.atoms))};
    EXPECT_NEAR(dual::estimate_shell(mesh, of_count).scale, 1.0, 1e-3);
  }
}

TEST(BuildShell, MakesClosedWallsAroundEachOther) {
  for (const dual::WallSide side : {dual::WallSide::outwards, dual::WallSide::inwards}) {
    const double radius = side == dual::WallSide::outwards ? 6.0 : 13.0;
    const dual::Shell shell = dual::build_shell(sphere(radius), three_walls(side));
    const remesh::MeshComponents components = remesh::find_components(shell.surface.mesh);
    ASSERT_EQ(components.parts.size(), 3U);
    for (std::size_t k = 0; k < 3; ++k) {
      EXPECT_EQ(components.parts[k].euler_characteristic(), 2);
      // The innermost comes first.
      EXPECT_EQ(components.parts[k].inside_of.value_or(99), k < 2 ? static_cast<int>(k) + 1 : 99);
    }
    EXPECT_EQ(shell.wall_of_atom, components.of_face);
    EXPECT_EQ(shell.given_wall, side == dual::WallSide::outwards ? 0 : 2);
    EXPECT_TRUE(dual::check_network(shell.structure).is_trivalent());
  }
}

TEST(BuildShell, MakesWallsOfSurfacesWithAnEdge) {
  const remesh::TriMesh tube =
      remesh::make_shape("open-tube", {{"radius", 6.0}, {"length", 20.0}}, 1.0);
  const dual::Shell shell = dual::build_shell(tube, three_walls());
  const auto& positions = shell.structure.atoms.positions;
  ASSERT_EQ(shell.wall_of_atom.size(), positions.size());
  std::array<double, 3> radius = {};
  std::array<double, 3> count = {};
  for (std::size_t i = 0; i < positions.size(); ++i) {
    const auto wall = static_cast<std::size_t>(shell.wall_of_atom[i]);
    radius[wall] += positions[i].head<2>().norm();
    count[wall] += 1.0;
  }
  for (std::size_t wall = 0; wall < 3; ++wall) {
    // Atoms lie inside the net of triangles on the surface. A tube without defects is a whole
    // number of edges around, in steps of 0.39 Å of its radius.
    EXPECT_NEAR(radius[wall] / count[wall], 6.0 + 3.4 * static_cast<double>(wall), 0.3);
  }
  const dual::ShellEstimate estimate = dual::estimate_shell(tube, three_walls());
  EXPECT_NEAR(static_cast<double>(positions.size()) / estimate.atoms, 1.0, 0.1);
}

TEST(BuildShell, SaysHowManyWallsFit) {
  const auto message_of = [](const remesh::TriMesh& mesh, dual::ShellOptions options) {
    try {
      static_cast<void>(dual::build_shell(mesh, options));
    } catch (const remesh::InvalidMesh& error) {
      return std::string(error.what());
    }
    return std::string("no error");
  };
  dual::ShellOptions options = three_walls(dual::WallSide::inwards);
  EXPECT_NE(message_of(sphere(7.5), options).find("only 2 walls fit"), std::string::npos);
  // The hole of a torus closes.
  options = three_walls();
  options.walls.spacing = 8.0;
  const remesh::TriMesh torus = remesh::make_shape("torus", {{"R", 14.0}, {"r", 6.0}}, 1.0);
  EXPECT_NE(message_of(torus, options).find("only 1 wall fits"), std::string::npos);
  const remesh::TriMesh open =
      remesh::make_shape("open-tube", {{"radius", 6.0}, {"length", 20.0}}, 1.0);
  options = three_walls(dual::WallSide::inwards);
  EXPECT_NE(message_of(open, options).find("only 2 walls fit"), std::string::npos);
  for (const dual::WallOptions& wrong :
       {dual::WallOptions{.count = 0}, dual::WallOptions{.count = 101},
        dual::WallOptions{.count = 2, .spacing = 0.0}}) {
    EXPECT_THROW(static_cast<void>(dual::build_shell(sphere(6.0), {.walls = wrong})),
                 dual::InvalidOption);
  }
}

TEST(Build, RefusesPotentialsWithoutBonds) {
  const shell::BuildOptions options = {.shell = three_walls(),
                                       .potential = shell::PotentialChoice{.name = "lj"}};
  EXPECT_THROW(static_cast<void>(shell::build({.mesh = sphere(6.0)}, options)),
               dual::InvalidOption);
}

TEST(Build, RelaxesWallsTogetherUnderAirebo) {
  shell::BuildOptions options = {.shell = three_walls()};
  options.shell.bond = 1.397;
  const shell::BuildResult result = shell::build({.mesh = sphere(6.0)}, options);
  EXPECT_EQ(result.potential.name, "airebo");
  ASSERT_TRUE(result.relaxed);
  EXPECT_TRUE(result.relaxed->converged);
  EXPECT_EQ(result.walls.size(), 3U);
  EXPECT_LT(std::accumulate(result.wall_energies.begin(), result.wall_energies.end(), 0.0), -20.0);
  for (const dual::WallReport& wall : result.walls) {
    EXPECT_EQ(wall.network.ring_excess, 12);
    if (wall.gap) {
      EXPECT_NEAR(*wall.gap, 3.45, 0.15);
    }
    EXPECT_GT(wall.closest->distance, 2.5);
  }
  const Structure structure = result.structure();
  EXPECT_EQ(dual::walls_of(structure), result.shell.wall_of_atom);
  EXPECT_EQ(dual::bonds_between_walls(structure), 0);
  const shell::Certificate certificate =
      shell::certify(structure, {.potential = {.name = "airebo"}});
  EXPECT_TRUE(certificate.is_sound());
  EXPECT_EQ(certificate.walls.size(), 3U);
}

TEST(Certify, FindsBondsBetweenWalls) {
  Structure onion = dual::icosahedral_onion(2);
  // An atom of the outer wall is put beside one of the inner.
  onion.atoms.positions[60] = 1.35 * onion.atoms.positions[0];
  const shell::Certificate certificate = shell::certify(onion, {.max_force = 1e9});
  const bool is_found = std::ranges::any_of(certificate.problems, [](const std::string& problem) {
    return problem.find("from one wall to another") != std::string::npos;
  });
  EXPECT_TRUE(is_found);
}

TEST(PotentialChoice, ComparesWithGrapheneAtRest) {
  EXPECT_NEAR(shell::graphene_reference({.name = "airebo"}), -7.42658, 1e-5);
  const double bond = shell::usual_bond_length({.name = "airebo"});
  const potentials::Atoms cell = dual::graphene_cell(bond);
  EXPECT_NEAR(potentials::airebo(cell).energy / static_cast<double>(cell.size()), -7.42658, 1e-4);
}

}  // namespace
}  // namespace trivalent
