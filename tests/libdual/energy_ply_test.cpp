#include "trivalent/view/energy_ply.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstring>
#include <sstream>

#include "small_meshes.h"
#include "trivalent/dual/build_dual.h"

namespace trivalent::dual {
namespace {

std::string text_of(const Structure& network, const std::vector<double>& energies, PlyKind kind) {
  std::ostringstream out;
  write_energy_ply(out, network, energies,
                   {.scale = diverging_scale(energies, -7.0), .kind = kind});
  return out.str();
}

TEST(WriteEnergyPly, DeclaresWhatItHolds) {
  const Structure network = build_dual(testing_support::icosahedron());
  const std::string text = text_of(network, std::vector<double>(20, -7.0), PlyKind::text);
  EXPECT_NE(text.find("element vertex 20\n"), std::string::npos);
  EXPECT_NE(text.find("property double energy\nelement face 12\n"), std::string::npos);
  const std::string body = text.substr(text.find("end_header\n") + 11);
  EXPECT_EQ(std::count(body.begin(), body.end(), '\n'), 32);
  EXPECT_NE(body.find(" 247 247 247 -7.0000000000\n"), std::string::npos);
  EXPECT_NE(body.find("\n5 "), std::string::npos);
}

TEST(WriteEnergyPly, WritesTheSameInBinary) {
  const Structure network = build_dual(testing_support::icosahedron());
  const std::string text = text_of(network, std::vector<double>(20, -7.0), PlyKind::binary);
  const std::string body = text.substr(text.find("end_header\n") + 11);
  const std::size_t vertex_size = 4 * sizeof(double) + 3;
  ASSERT_EQ(body.size(), 20 * vertex_size + 12 * 6 * sizeof(std::int32_t));
  double y = 0.0;
  std::memcpy(&y, body.data() + vertex_size + sizeof(double), sizeof(double));
  EXPECT_EQ(y, network.atoms.positions[1].y());
  std::int32_t size = 0;
  std::memcpy(&size, body.data() + 20 * vertex_size, sizeof size);
  EXPECT_EQ(size, 5);
}

TEST(WriteEnergyPly, ThrowsOnEnergiesThatDoNotFit) {
  const Structure network = build_dual(testing_support::icosahedron());
  EXPECT_THROW(text_of(network, std::vector<double>(19, -7.0), PlyKind::text), InvalidNetwork);
  std::ostringstream out;
  EXPECT_THROW(write_energy_ply(out, network, std::vector<double>(20, NAN), {}), InvalidNetwork);
  EXPECT_THROW(write_energy_ply(out, network, std::vector<double>(20, -7.0), {}), InvalidOption);
}

TEST(WriteEnergyPly, ThrowsWhereNoFileCanBe) {
  const Structure network = build_dual(testing_support::icosahedron());
  EXPECT_THROW(
      write_energy_ply("/nonexistent/folder/a.ply", network, std::vector<double>(20, -7.0), {}),
      FileError);
}

}  // namespace
}  // namespace trivalent::dual
