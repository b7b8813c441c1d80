#include "trivalent/formats/lammps_data.h"

#include <gtest/gtest.h>
#include <zlib.h>

#include <sstream>

#include "small_structures.h"
#include "temporary_folder.h"
#include "trivalent/dual/build_dual.h"
#include "trivalent/dual/padded_box.h"

namespace trivalent::dual {
namespace {

using potentials::Species;
using testing_support::message_of;
using testing_support::TemporaryFolder;

std::string data_text_of(const Structure& data, const LammpsDataOptions& options = {}) {
  std::ostringstream out;
  write_lammps_data(out, data, options);
  return out.str();
}

StructureFile data_file_of(const std::string& text) {
  const TemporaryFolder folder;
  return read_lammps_data(folder.file("shell.data", text));
}

Structure read_data_back(const std::string& text) { return data_file_of(text).structure; }

std::string complaint_about_data(const std::string& text) {
  return message_of<FileError>([&] { static_cast<void>(read_data_back(text)); });
}

TEST(WriteLammpsData, FollowsTheFormat) {
  Structure data;
  data.atoms.positions = {{1, 2, 3}};
  data.atoms.species = {Species::carbon};
  EXPECT_EQ(data_text_of(data, {.title = "one atom"}),
            "LAMMPS data file: one atom\n\n1 atoms\n1 atom types\n\n"
            "-9 11 xlo xhi\n-8 12 ylo yhi\n-7 13 zlo zhi\n\n"
            "Masses\n\n1 12.011 # C\n\nAtoms # atomic\n\n"
            "1 1 1.0000000000 2.0000000000 3.0000000000\n");
}

TEST(WriteLammpsData, ReadsBackToTheSameBits) {
  for (const AtomStyle style : {AtomStyle::atomic, AtomStyle::molecular}) {
    Structure data = testing_support::boxed_c20();
    data.atoms.species[3] = Species::hydrogen;
    const auto [copy, notes] =
        data_file_of(data_text_of(data, {.style = style, .digits = Digits::seventeen_significant}));
    EXPECT_EQ(copy.atoms.positions, data.atoms.positions);
    EXPECT_EQ(copy.atoms.species, data.atoms.species);
    EXPECT_EQ(copy.bonds.size(), style == AtomStyle::molecular ? data.bonds.size() : 0u);
    EXPECT_TRUE(notes.empty());
  }
}

TEST(WriteLammpsData, KeepsATiltedBox) {
  Structure data = testing_support::boxed_c20();
  data.atoms.box.cell << 4, 1, 0.5, 0, 5, 0.25, 0, 0, 6;
  data.atoms.box.periodic = {true, true, true};
  const Structure copy = read_data_back(data_text_of(data));
  EXPECT_EQ(copy.atoms.box.cell, data.atoms.box.cell);
  EXPECT_EQ(copy.atoms.box.origin, data.atoms.box.origin);
}

TEST(WriteLammpsData, HoldsAtomsThatLeftABoxWhereItIsNotPeriodic) {
  Structure data;
  data.atoms.positions = {{1, 2, 3}, {2, 2, -5}, {-1, 2, 4}};
  data.atoms.species.assign(3, Species::carbon);
  data.atoms.box.cell.diagonal() = Eigen::Vector3d(4, 5, 6);
  data.atoms.box.periodic = {true, false, false};
  const std::string text = data_text_of(data);
  EXPECT_NE(text.find("\n0 4 xlo xhi\n"), std::string::npos);    // periodic: atoms are wrapped
  EXPECT_NE(text.find("\n0 5 ylo yhi\n"), std::string::npos);    // all are inside
  EXPECT_NE(text.find("\n-15 6 zlo zhi\n"), std::string::npos);  // the lowest, and 10 Å
}

TEST(WriteLammpsData, ThrowsOnABoxThatLammpsCannotHave) {
  Structure data = testing_support::boxed_c20();
  data.atoms.box.cell(1, 0) = 1.0;
  EXPECT_THROW(data_text_of(data), InvalidOption);
  data = testing_support::boxed_c20();
  data.atoms.box.cell(0, 1) = 0.6 * data.atoms.box.cell(0, 0);
  EXPECT_THROW(data_text_of(data), InvalidOption);
  data = testing_support::boxed_c20();
  data.atoms.box.cell(2, 2) = -1.0;
  EXPECT_THROW(data_text_of(data), InvalidOption);
}

TEST(WriteLammpsData, ThrowsOnATitleOfTwoLines) {
  EXPECT_THROW(data_text_of(testing_support::boxed_c20(), {.title = "a\nb"}), InvalidOption);
  EXPECT_THROW(data_text_of(testing_support::boxed_c20(), {.title = std::string(300, 'a')}),
               InvalidOption);
}

TEST(WriteLammpsData, ThrowsOnABondToAMissingAtom) {
  Structure data = testing_support::boxed_c20();
  data.bonds.push_back({0, 20});
  EXPECT_THROW(data_text_of(data), InvalidNetwork);
}

TEST(WriteLammpsData, ThrowsOnMissingSpeciesAndInfiniteCoordinates) {
  Structure data = testing_support::boxed_c20();
  data.atoms.species.pop_back();
  EXPECT_THROW(data_text_of(data), InvalidNetwork);
  data = testing_support::boxed_c20();
  data.atoms.positions[0].x() = HUGE_VAL;
  EXPECT_THROW(data_text_of(data), InvalidNetwork);
}

TEST(WriteLammpsData, ThrowsWhereNoFileCanBe) {
  EXPECT_THROW(write_lammps_data("/nonexistent/folder/a.data", testing_support::boxed_c20()),
               FileError);
}

const std::string data_header =
    "title\n\n2 atoms\n1 atom types\n0 5 xlo xhi\n0 5 ylo yhi\n0 5 zlo zhi\n";
const std::string masses = "\nMasses\n\n1 12.0107\n";

TEST(ReadLammpsData, ReadsAllStylesWithAndWithoutHintAndImageFlags) {
  const std::vector<std::string> sections = {
      "\nAtoms # atomic\n\n2 1 1 2 3\n1 1 0 0 0\n",
      "\nAtoms\n\n2 1 1 2 3 0 0 -1 # here\n1 1 0 0 0 0 0 0\n",
      "\nAtoms # charge\n\n2 1 0.5 1 2 3\n1 1 0 0 0 0\n",
      "\nAtoms # molecular\n\n2 7 1 1 2 3\n1 7 1 0 0 0\n",
      "\nAtoms  # full\n\n2 7 1 0.5 1 2 3\n1 7 1 0 0 0 0\n",
      "\nAtoms\n\n2 7 1 0.5 1 2 3 0 0 0\n1 7 1 0 0 0 0 0 0 0\n\nVelocities\n\n1 0 0 0\n2 0 0 0\n"};
  for (const std::string& section : sections) {
    const Structure data = read_data_back(data_header + masses + section);
    ASSERT_EQ(data.atoms.size(), 2u) << section;
    EXPECT_EQ(data.atoms.positions[1], Eigen::Vector3d(1, 2, 3)) << section;
    EXPECT_EQ(data.atoms.species[0], Species::carbon);
    EXPECT_TRUE(data.atoms.box.is_periodic());
    EXPECT_EQ(data.atoms.box.cell.diagonal(), Eigen::Vector3d(5, 5, 5));
  }
}

TEST(ReadLammpsData, ReadsGeneralTriclinicBoxes) {
  const Structure data = read_data_back(
      "title\n1 atoms\n1 atom types\n0 2 0 avec\n-3 0 0 bvec\n0 1 4 cvec\n5 6 7 abc origin\n" +
      masses + "\nAtoms # atomic\n\n1 1 5 6 7\n");
  EXPECT_EQ(data.atoms.box.cell.col(0), Eigen::Vector3d(0, 2, 0));
  EXPECT_EQ(data.atoms.box.cell.col(1), Eigen::Vector3d(-3, 0, 0));
  EXPECT_EQ(data.atoms.box.cell.col(2), Eigen::Vector3d(0, 1, 4));
  EXPECT_EQ(data.atoms.box.origin, Eigen::Vector3d(5, 6, 7));
}

TEST(ReadLammpsData, ReadsTypeLabels) {
  const std::string labels = "\nAtom Type Labels\n\n1 carbon_a\n";
  const Structure data =
      read_data_back(data_header + labels +
                     "\nMasses\n\ncarbon_a 12.011\n\nPair Coeffs\n\ncarbon_a 1 2\n"
                     "\nAtoms # atomic\n\n1 carbon_a 0 0 0\n2 1 1 2 3\n");
  EXPECT_EQ(data.atoms.species, (std::vector<Species>{Species::carbon, Species::carbon}));
  const Structure by_label =
      read_data_back(data_header + "\nAtom Type Labels\n\n1 H\n\nAtoms\n\n1 H 0 0 0\n2 H 0 0 1\n");
  EXPECT_EQ(by_label.atoms.species[1], Species::hydrogen);
}

TEST(ReadLammpsData, ReadsStylesThatHaveTheColumnsOfOthers) {
  for (const std::string style : {"bond", "angle", "molecular"}) {
    EXPECT_EQ(read_data_back(data_header + masses + "\nAtoms # " + style +
                             "\n\n1 9 1 0 0 0\n2 9 1 1 2 3\n")
                  .atoms.size(),
              2u);
  }
}

TEST(ReadLammpsData, TellsChargeFromMolecularByTheTypes) {
  // The third field is no type: charge. The second is none: molecular.
  for (const std::string rows : {"1 1 0 0 0 0\n2 1 0 1 2 3\n", "1 7 1 0 0 0\n2 7 1 1 2 3\n",
                                 "1 1 -0.25 0 0 0\n2 1 0.25 1 2 3\n"}) {
    const Structure data = read_data_back(data_header + masses + "\nAtoms\n\n" + rows);
    EXPECT_EQ(data.atoms.positions[1], Eigen::Vector3d(1, 2, 3)) << rows;
  }
  const TemporaryFolder folder;
  const auto path = folder.file("open.data",
                                "title\n1 atoms\n2 atom types\n\nMasses\n\n1 12.011\n2 1.008\n\n"
                                "Atoms\n\n1 1 2 0 0 0\n");
  EXPECT_EQ(read_lammps_data(path, {.atom_style = AtomStyle::charge}).structure.atoms.species[0],
            Species::carbon);
  EXPECT_EQ(read_lammps_data(path, {.atom_style = AtomStyle::molecular}).structure.atoms.species[0],
            Species::hydrogen);
}

TEST(ReadLammpsData, TakesElementsFromTheCallerOrNotesItsGuess) {
  const TemporaryFolder folder;
  const auto path = folder.file("a.data", data_header + "\nAtoms\n\n1 1 0 0 0\n2 1 1 2 3\n");
  const auto [guessed, notes] = read_lammps_data(path);
  EXPECT_EQ(guessed.atoms.species[0], Species::carbon);
  ASSERT_EQ(notes.size(), 1u);
  EXPECT_NE(notes[0].find("type 1 has no mass; it is taken as C"), std::string::npos);
  const auto [told, no_notes] = read_lammps_data(path, {.elements = {Species::hydrogen}});
  EXPECT_EQ(told.atoms.species[0], Species::hydrogen);
  EXPECT_TRUE(no_notes.empty());
}

TEST(ReadLammpsData, LeavesOutBondsWhoseImagesAreOpen) {
  const auto [data, notes] = data_file_of(
      "title\n2 bonds\n" + data_header.substr(6) + masses +
      "\nAtoms # molecular\n\n1 1 1 0 0 0\n2 1 1 2.5 0 0\n\nBonds\n\n1 1 1 2\n2 1 2 1\n");
  EXPECT_TRUE(data.bonds.empty());
  EXPECT_EQ(notes.size(), 1u);
}

TEST(ReadLammpsData, RenumbersIdsWithGaps) {
  const auto [data, notes] =
      data_file_of("title\n1 bonds\n" + data_header.substr(6) + masses +
                   "\nAtoms # atomic\n\n90 1 1 2 3\n7 1 0 0 0\n\nBonds\n\n1 1 90 7\n");
  ASSERT_EQ(data.bonds.size(), 1u);
  EXPECT_EQ(data.bonds[0].first, 1u);
  EXPECT_EQ(data.bonds[0].second, 0u);
  EXPECT_EQ(notes.size(), 1u);
}

TEST(ReadLammpsData, ReadsGzip) {
  const TemporaryFolder folder;
  const auto path = folder.path() / "shell.data.gz";
  const std::string text = data_text_of(testing_support::boxed_c20());
  gzFile file = gzopen(path.c_str(), "wb");
  gzwrite(file, text.data(), static_cast<unsigned>(text.size()));
  gzclose(file);
  EXPECT_EQ(read_lammps_data(path).structure.atoms.size(), 20u);

  std::filesystem::resize_file(path, std::filesystem::file_size(path) / 2);
  EXPECT_THROW(static_cast<void>(read_lammps_data(path)), FileError);
}

TEST(ReadLammpsData, NamesTheLineOfEveryFault) {
  const std::string atoms = "\nAtoms # atomic\n\n1 1 0 0 0\n";
  const std::vector<std::array<std::string, 2>> cases = {
      {"", "line 0"},
      {"title\n", "line 1"},
      {"title\nx atoms\n", "line 2"},
      {"title\n2000000000 atoms\n", "cut short"},
      {"title\n1 atoms\n5 0 xlo xhi\n", "line 3"},
      {"title\n1 atoms\n0 nan xlo xhi\n", "line 3"},
      {data_header + masses + "\nVelocities\n\n1 0 0 0\n2 0 0 0\n", "no section Atoms"},
      {data_header + masses + atoms, "after 1 of 2 rows"},
      {data_header + masses + atoms + "1 1 1 1 1\n", "line 16: atom 1 appears a second time"},
      {data_header + masses + atoms + "2 1 1 1 1\n3 1 1 1 1\n", "line 17"},
      {data_header + masses + atoms + "2 1 1 1 nan\n", "line 16"},
      {data_header + masses + atoms + "2 1 1 1\n", "line 16"},
      {data_header + masses + atoms + "0 1 1 1 1\n", "line 16"},
      {data_header + masses + atoms + "2 2 1 1 1\n", "line 16: atom 2 is of type '2'"},
      {data_header + masses + "\nAtoms # sphere\n\n", "atom_style 'sphere'"},
      {data_header + "\nMasses\n\n1 15.999\n" + atoms + "2 1 1 1 1\n", "no mass of C or H"},
      {data_header + "\nMasses\n\n2 12.011\n" + atoms, "line 11"},
      {"title\n2 atoms\n2 atom types\n" + atoms + "2 1 1 1 1\n", "no mass of C or H"},
      {"title\n1 bonds\n" + data_header.substr(6) + masses + atoms + "2 1 1 1 1\n",
       "no section Bonds"},
      {"title\n1 bonds\n" + data_header.substr(6) + masses + atoms +
           "2 1 1 1 1\nBonds\n\n1 1 1 3\n",
       "names atom 3"},
      {data_header + masses + atoms + "2 1 1 1 1\n" + atoms, "second section Atoms"},
      {data_header + "5 walls\n" + masses + atoms, "line 8: line of the header"},
      {data_header + "0 5 xlo xhi\n" + masses + atoms, "second line xlo xhi"},
      {data_header + "1 0 0 avec\n" + masses + atoms, "both avec"},
      {data_header + "0 0 0 abc origin\n" + masses + atoms, "abc origin goes with"},
      {"title\n1 atoms\n1 atom types\n1 0 0 avec\n0 1 0 bvec\n0 0 -1 cvec\n" + masses + atoms,
       "not right-handed"},
      {"title\n1 atoms\n1 atom types\n1 0 0 avec\n" + masses + atoms, "lacks one of avec"},
      {"title\n1 ellipsoids\n" + data_header.substr(6) + masses + atoms, "ellipsoids"},
      {data_header + "\nMasses\n\n1 12.011 # H\n" + atoms + "2 1 1 1 1\n", "line 11: the mass"},
      {data_header + "\nAtom Type Labels\n\n1 H\n" + masses + atoms + "2 1 1 1 1\n", "the mass"},
      {data_header + "\nMasses\n\n1 0\n" + atoms, "mass must be > 0"},
      {"LAMMPS data file via write_data, timestep = 0, units = lj\n" + data_header.substr(6) +
           masses + atoms + "2 1 1 1 1\n",
       "line 1: the file is in units lj"},
      {"title\n1 bonds\n" + data_header.substr(6) + masses + atoms +
           "2 1 1 1 1\nBonds\n\n1 1 2 2\n",
       "joins atom 2 to itself"},
      {"title\n2 atoms\n2 atom types\n\nMasses\n\n1 12.011\n2 1.008\n\nAtoms\n\n1 1 2 0 0 0\n"
       "2 2 1 1 1 1\n",
       "line 12: atom_style may be molecular or charge"}};
  for (const auto& [text, part] : cases) {
    EXPECT_NE(complaint_about_data(text).find(part), std::string::npos)
        << text << "\n-> " << complaint_about_data(text);
  }
}

TEST(ReadLammpsData, ThrowsOnAMissingFile) {
  EXPECT_THROW(static_cast<void>(read_lammps_data("/nonexistent.data")), FileError);
}

}  // namespace
}  // namespace trivalent::dual
