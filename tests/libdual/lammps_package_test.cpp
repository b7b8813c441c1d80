#include "trivalent/formats/lammps_package.h"

#include <gtest/gtest.h>

#include <sstream>

#include "small_structures.h"
#include "temporary_folder.h"
#include "trivalent/dual/build_dual.h"
#include "trivalent/dual/padded_box.h"

namespace trivalent::dual {
namespace {

using testing_support::contents_of;
using testing_support::TemporaryFolder;

TEST(LammpsPackage, WritesEveryFileItNames) {
  const TemporaryFolder folder;
  const auto names = write_lammps_package(folder.path(), testing_support::boxed_c20(), -1.0).files;
  EXPECT_EQ(names,
            (std::vector<std::string>{"shell.data", "in.check", "in.relax", "in.md", "README.md"}));
  for (const std::string& name : names) {
    EXPECT_GT(std::filesystem::file_size(folder.path() / name), 100u) << name;
  }
}

TEST(LammpsPackage, CompressedDataIsTheSameData) {
  const TemporaryFolder folder;
  const Structure data = testing_support::boxed_c20();
  const auto names =
      write_lammps_package(folder.path(), data, -1.0, {.compression = Compression::gzip}).files;
  ASSERT_EQ(names.front(), "shell.data.gz");
  EXPECT_EQ(contents_of(folder.path() / names.front()).substr(0, 2), "\x1f\x8b");
  const Structure back = read_lammps_data(folder.path() / names.front()).structure;
  ASSERT_EQ(back.atoms.size(), data.atoms.size());
  for (std::size_t i = 0; i < data.atoms.size(); ++i) {
    EXPECT_LT((back.atoms.positions[i] - data.atoms.positions[i]).norm(), 1e-9);
  }
}

TEST(LammpsPackage, PartsHoldEveryAtomOnce) {
  const TemporaryFolder folder;
  const Structure data = testing_support::boxed_c20();
  (void)write_lammps_package(folder.path(), data, -1.0);
  (void)write_lammps_package(folder.path(), data, -1.0, {.name = "part", .atoms_per_file = 7});
  const auto rows = [&](const std::string& name) {
    const std::string text = contents_of(folder.path() / name);
    return text.substr(text.find("Atoms # atomic\n\n") + 16);
  };
  EXPECT_EQ(rows("part.1.data") + rows("part.2.data") + rows("part.3.data"), rows("shell.data"));
  EXPECT_NE(contents_of(folder.path() / "part.3.data").find("\n6 atoms\n"), std::string::npos);
}

TEST(LammpsPackage, WritesThreeAnglesAtEveryAtom) {
  const TemporaryFolder folder;
  const LammpsDataOptions options = {.style = AtomStyle::molecular, .angles = true};
  (void)write_lammps_package(folder.path(), testing_support::boxed_c20(), -1.0, {.data = options});
  const std::string text = contents_of(folder.path() / "shell.data");
  EXPECT_NE(text.find("\n30 bonds\n60 angles\n"), std::string::npos);
  std::istringstream rows(text.substr(text.find("Angles\n\n") + 8));
  std::vector<int> middles(20, 0);
  int id = 0, type = 0, first = 0, middle = 0, last = 0;
  while (rows >> id >> type >> first >> middle >> last) ++middles.at(middle - 1);
  EXPECT_EQ(middles, std::vector<int>(20, 3));
}

TEST(LammpsPackage, SaysHowAtomsWereRotated) {
  const TemporaryFolder folder;
  Structure data = testing_support::boxed_c20();
  data.atoms.box.cell.setZero();
  data.atoms.box.cell.col(2) = Eigen::Vector3d(30, 0, 0);
  data.atoms.box.periodic = {false, false, true};
  const LammpsPackage package = write_lammps_package(folder.path(), data, -1.0);
  EXPECT_NEAR((package.rotation * Eigen::Vector3d::UnitX() - Eigen::Vector3d::UnitZ()).norm(), 0.0,
              1e-14);
  EXPECT_NE(contents_of(folder.path() / "README.md").find("rotated"), std::string::npos);
  const Structure back = read_lammps_data(folder.path() / "shell.data").structure;
  for (std::size_t i = 0; i < data.atoms.size(); ++i) {
    const Eigen::Vector3d there = package.rotation * data.atoms.positions[i];
    EXPECT_LT((back.atoms.positions[i] - there).norm(), 1e-9);
  }
}

TEST(LammpsPackage, ThrowsOnWhatCannotBeWritten) {
  const TemporaryFolder folder;
  const LammpsDataOptions molecular = {.style = AtomStyle::molecular};
  EXPECT_THROW(write_lammps_package(folder.path(), testing_support::boxed_c20(), -1.0,
                                    {.atoms_per_file = 0}),
               InvalidOption);
  EXPECT_THROW(write_lammps_package(folder.path(), testing_support::boxed_c20(), -1.0,
                                    {.data = molecular, .atoms_per_file = 7}),
               InvalidOption);
  Structure bare = testing_support::boxed_c20();
  bare.bonds.clear();
  EXPECT_THROW(write_lammps_package(folder.path(), bare, -1.0, {.data = molecular}), InvalidOption);
  EXPECT_THROW(write_lammps_package("/nonexistent/folder", testing_support::boxed_c20(), -1.0),
               FileError);
}

TEST(LammpsPackage, ThrowsBeyondTheIdsOfLammps) {
  EXPECT_NO_THROW(require_lammps_ids(max_lammps_atoms));
  EXPECT_THROW(require_lammps_ids(max_lammps_atoms + 1), InvalidNetwork);
}

}  // namespace
}  // namespace trivalent::dual
