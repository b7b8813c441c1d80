#include "trivalent/formats/xyz.h"

#include <gtest/gtest.h>
#include <zlib.h>

#include <algorithm>
#include <limits>
#include <sstream>

#include "small_meshes.h"
#include "temporary_folder.h"
#include "trivalent/dual/bonding.h"
#include "trivalent/dual/build_dual.h"
#include "trivalent/dual/columns.h"
#include "trivalent/dual/padded_box.h"
#include "trivalent/potentials/bonds.h"
#include "xyz_text.h"

namespace trivalent::dual {
namespace {

using potentials::Species;
using testing_support::message_of;
using testing_support::TemporaryFolder;

Structure two_atoms() {
  Structure frame;
  frame.atoms.positions = {{0.0, 0.1, -1.0 / 3.0}, {1.42, 0.0, 1e-7}};
  frame.atoms.species = {Species::carbon, Species::hydrogen};
  frame.columns = {
      {.name = "energies", .values = std::vector<double>{-7.25, 1.0 / 7.0}},
      {.name = "coordination", .values = std::vector<int>{3, -2}},
      {.name = "forces", .values = std::vector<Eigen::Vector3d>{{1, 2, 3}, {-1, 0, 0.5}}},
      {.name = "rings", .values = std::vector<std::array<int, 3>>{{7, 6, 5}, {6, 0, 0}}}};
  frame.header = {{.key = "energy", .value = -7.1},
                  {.key = "title", .value = "two \"atoms\" \\ x"}};
  return frame;
}

Structure read_back(const std::string& text) { return xyz_file_of(text).structure; }

std::string complaint_about(const std::string& text) {
  return message_of<FileError>([&] { static_cast<void>(read_back(text)); });
}

TEST(WriteXyz, WritesLatticePropertiesAndPbcTogether) {
  const std::string text = xyz_text_of(two_atoms());
  const std::string header = text.substr(0, text.find('\n', 2));
  EXPECT_NE(header.find("Lattice=\""), std::string::npos);
  EXPECT_NE(header.find(" Properties=species:S:1:pos:R:3:energies:R:1:coordination:I:1:forces:R:3:"
                        "rings:I:3"),
            std::string::npos);
  EXPECT_NE(header.find(" pbc=\"F F F\""), std::string::npos);
  EXPECT_NE(header.find(" energy=-7.0999999999999996"), std::string::npos);
}

TEST(WriteXyz, UsesTenDecimals) {
  const std::string text = xyz_text_of(two_atoms());
  EXPECT_NE(text.find("\nC 0.0000000000 0.1000000000 -0.3333333333 -7.2500000000 3 1.0000000000"),
            std::string::npos);
}

TEST(WriteXyz, KeepsEveryBitWithSeventeenDigits) {
  const Structure frame = two_atoms();
  const auto [copy, notes] = xyz_file_of(xyz_text_of(frame, Digits::seventeen_significant));
  EXPECT_EQ(copy.atoms.positions, frame.atoms.positions);
  EXPECT_EQ(copy.atoms.species, frame.atoms.species);
  ASSERT_EQ(copy.columns.size(), frame.columns.size());
  for (std::size_t i = 0; i < frame.columns.size(); ++i) {
    EXPECT_EQ(copy.columns[i].name, frame.columns[i].name);
    EXPECT_TRUE(copy.columns[i].values == frame.columns[i].values) << frame.columns[i].name;
  }
  ASSERT_EQ(copy.header.size(), 2u);
  EXPECT_EQ(std::get<double>(copy.header[0].value), -7.1);
  EXPECT_EQ(std::get<std::string>(copy.header[1].value), "two \"atoms\" \\ x");
  EXPECT_TRUE(notes.empty());
}

TEST(WriteXyz, PadsTheBoxOfACluster) {
  const Structure copy = read_back(xyz_text_of(two_atoms()));
  EXPECT_FALSE(copy.atoms.box.is_periodic());
  const Eigen::Vector3d upper = copy.atoms.box.origin + copy.atoms.box.cell.diagonal();
  for (const Eigen::Vector3d& position : copy.atoms.positions) {
    EXPECT_GE((position - copy.atoms.box.origin).minCoeff(), default_padding - 1e-9);
    EXPECT_GE((upper - position).minCoeff(), default_padding - 1e-9);
  }
}

TEST(WriteXyz, KeepsAPeriodicBox) {
  Structure frame = two_atoms();
  frame.atoms.box.cell << 4, 1, 0.5, 0, 5, 0.25, 0, 0, 6;
  frame.atoms.box.origin = {-1, -2, -3};
  frame.atoms.box.periodic = {true, false, true};
  const Structure copy = read_back(xyz_text_of(frame));
  EXPECT_EQ(copy.atoms.box.cell, frame.atoms.box.cell);
  EXPECT_EQ(copy.atoms.box.origin, frame.atoms.box.origin);
  EXPECT_EQ(copy.atoms.box.periodic, frame.atoms.box.periodic);
}

TEST(WriteXyz, ThrowsOnACoordinateThatIsNotFinite) {
  Structure frame = two_atoms();
  frame.atoms.positions[1].y() = std::numeric_limits<double>::quiet_NaN();
  EXPECT_THROW(xyz_text_of(frame), InvalidNetwork);
}

TEST(WriteXyz, ThrowsOnAColumnOfTheWrongLength) {
  Structure frame = two_atoms();
  frame.columns[0].values = std::vector<double>{1.0};
  EXPECT_THROW(xyz_text_of(frame), InvalidNetwork);
}

TEST(WriteXyz, ThrowsOnMissingSpecies) {
  Structure frame = two_atoms();
  frame.atoms.species.pop_back();
  EXPECT_THROW(xyz_text_of(frame), InvalidNetwork);
}

TEST(WriteXyz, ThrowsOnNamesThatAreTakenOrHaveBlanks) {
  for (const std::string name : {"pos", "energies", "two words", "", "a:b", "a=b"}) {
    Structure frame = two_atoms();
    frame.columns.back().name = name;
    EXPECT_THROW(xyz_text_of(frame), InvalidOption) << name;
  }
  Structure frame = two_atoms();
  frame.header.back().key = "Lattice";
  EXPECT_THROW(xyz_text_of(frame), InvalidOption);
}

TEST(WriteXyz, ThrowsWhereNoFileCanBe) {
  EXPECT_THROW(write_xyz("/nonexistent/folder/a.extxyz", two_atoms()), FileError);
}

TEST(AddEnergies, RemovesTheResultsOfFormerCalculations) {
  Structure frame = read_back(
      "1\nProperties=species:S:1:pos:R:3:forces:R:3:charge:R:1:magmoms:R:1:tag:I:1 energy=-1 "
      "free_energy=-2 stress=[1, 0, 0, 0, 1, 0, 0, 0, 1] virial=\"1 0 0 0 1 0 0 0 1\" "
      "dipole=[0.1, 0.2, 0.3] config_type=x\nC 0 0 0 1 1 1 2 3 4\n");
  add_energies(frame, {.energy = -7.0, .energies = {-7.0}, .forces = {{0, 0, 0}}});
  ASSERT_EQ(frame.header.size(), 2u);
  EXPECT_EQ(frame.header[0].key, "config_type");
  EXPECT_EQ(std::get<double>(frame.header[1].value), -7.0);
  std::vector<std::string> names;
  for (const Column& column : frame.columns) names.push_back(column.name);
  EXPECT_EQ(names, (std::vector<std::string>{"tag", "energies", "forces"}));
}

TEST(NetworkColumns, DescribeAShell) {
  const Structure network = build_dual(testing_support::icosahedron());
  const Structure frame = {.atoms = network.atoms, .columns = network_columns(network)};
  const std::string text = xyz_text_of(frame);
  EXPECT_NE(text.find("coordination:I:1:rings:I:3"), std::string::npos);
  EXPECT_NE(text.find(" 3 5 5 5\n"), std::string::npos);
}

TEST(ReadXyz, ReadsPlainXyzWithFurtherColumns) {
  const Structure frame = read_back("2\nany text, \"even this\nC 0 0 0 0.5\nH 1e0 +2 3. x y\n\n");
  ASSERT_EQ(frame.atoms.size(), 2u);
  EXPECT_EQ(frame.atoms.positions[1], Eigen::Vector3d(1, 2, 3));
  EXPECT_FALSE(frame.atoms.box.is_periodic());
  EXPECT_TRUE(frame.columns.empty());
}

TEST(ReadXyz, TakesALatticeWithoutPbcAsPeriodic) {
  const Structure frame = read_back("1\nLattice=\"2 0 0 0 3 0 0 0 4\"\r\nC 0 0 0\r\n");
  EXPECT_EQ(frame.atoms.box.periodic, (std::array<bool, 3>{true, true, true}));
  EXPECT_EQ(frame.atoms.box.cell.diagonal(), Eigen::Vector3d(2, 3, 4));
}

TEST(ReadXyz, NotesWhatItLeavesOut) {
  const auto [frame, notes] = xyz_file_of(
      "1\nProperties=id:I:1:species:S:1:pos:R:3:label:S:1:stress:R:9 flag key={1 2}\n"
      "7 C 0 0 0 abc 1 2 3 4 5 6 7 8 9\n");
  EXPECT_EQ(notes.size(), 2u);
  ASSERT_EQ(frame.columns.size(), 1u);
  EXPECT_EQ(std::get<std::vector<int>>(frame.columns[0].values), std::vector<int>{7});
  ASSERT_EQ(frame.header.size(), 2u);
  EXPECT_EQ(std::get<std::string>(frame.header[1].value), "1 2");
}

TEST(ReadXyz, ReadsTheLastStructureOrTheOneThatIsNamed) {
  const TemporaryFolder folder;
  const auto path = folder.file("three.xyz", "1\n\nC 1 0 0\n1\n\nC 2 0 0\n\n1\n\nC 3 0 0\n\n");
  const auto [last, notes] = read_xyz(path);
  EXPECT_EQ(last.atoms.positions[0].x(), 3.0);
  ASSERT_EQ(notes.size(), 1u);
  EXPECT_NE(notes[0].find("3 structures; the last is read"), std::string::npos);
  for (const int frame : {1, 2, 3}) {
    const auto [structure, no_notes] = read_xyz(path, {.frame = frame});
    EXPECT_EQ(structure.atoms.positions[0].x(), frame);
    EXPECT_TRUE(no_notes.empty());
  }
  const auto message =
      message_of<FileError>([&] { static_cast<void>(read_xyz(path, {.frame = 4})); });
  EXPECT_NE(message.find("3 structures; there is no number 4"), std::string::npos) << message;
}

TEST(ReadXyz, ReadsEverySpellingOfTheHeader) {
  const std::string properties = "Properties=species:S:1:pos:R:3";
  const std::string lattice = "Lattice=\"4 0 0 1 5 0 0 0 6\"";
  const std::string pbc = "pbc=\"T T F\"";
  const std::vector<std::string> headers = {
      lattice + ' ' + properties + ' ' + pbc,
      "lattice=\"4 0 0 1 5 0 0 0 6\" properties=species:S:1:pos:R:3 PBC=\"T T F\"",
      "Lattice = \"4 0 0 1 5 0 0 0 6\" Properties = species:S:1:pos:R:3 pbc\t=\t\"T T F\"",
      "Lattice=[[4, 0, 0], [1, 5, 0], [0, 0, 6]] " + properties + " pbc=[T, T, F]",
      "Lattice=[4,0,0,1,5,0,0,0,6] " + properties + " pbc=[true,True,FALSE]",
      "Lattice={4 0 0 1 5 0 0 0 6} " + properties + " pbc={1 1 0}",
      "Lattice='4 0 0 1 5 0 0 0 6' " + properties + " pbc=\"true TRUE false\"",
      "Lattice=\"4.0D0 0 0 1d0 .5E+1 0 0 0 +6.\" " + properties + ' ' + pbc,
      "\"Lattice\"=\"4 0 0 1 5 0 0 0 6\" \"Properties\"=species:S:1:pos:R:3 \"pbc\"=\"T T F\"",
      pbc + "  " + properties + "   " + lattice + "  "};
  for (const std::string& header : headers) {
    const Structure frame = read_back("1\n" + header + "\nC 1 2 3.0D0\n");
    EXPECT_EQ(frame.atoms.box.periodic, (std::array<bool, 3>{true, true, false})) << header;
    EXPECT_EQ(frame.atoms.box.cell.col(1), Eigen::Vector3d(1, 5, 0)) << header;
    EXPECT_EQ(frame.atoms.box.cell(2, 2), 6.0) << header;
    EXPECT_EQ(frame.atoms.positions[0], Eigen::Vector3d(1, 2, 3)) << header;
    EXPECT_TRUE(frame.header.empty()) << header;
  }
}

TEST(ReadXyz, ReadsFilesOfEveryLineEndAndMark) {
  const std::string rows = "1\nProperties=species:S:1:pos:R:3\nC 1 2 3\n";
  std::string old = rows;
  std::ranges::replace(old, '\n', '\r');
  for (const std::string& text : {rows, "\xEF\xBB\xBF" + rows, old}) {
    EXPECT_EQ(read_back(text).atoms.positions[0], Eigen::Vector3d(1, 2, 3));
  }
}

TEST(ReadXyz, ReadsElementsByEveryName) {
  for (const std::string properties :
       {"Z:I:1:pos:R:3", "numbers:I:1:positions:R:3", "Z:I:1:pos:R:3:tag:I:1",
        "species:S:1:pos:R:3:Z:I:1", "symbols:S:1:pos:R:3", "element:S:1:pos:R:3"}) {
    const bool has_symbol = properties[0] != 'Z' && properties[0] != 'n';
    const bool has_more = properties.ends_with("I:1") && properties.size() > 15;
    std::string text = "2\nProperties=" + properties + '\n';
    for (const auto& [symbol, number] : {std::pair{"C", "6"}, std::pair{"H", "1"}}) {
      text += std::string(has_symbol ? symbol : number) + " 0 0 0" +
              (has_more ? std::string(" ") + number : "") + '\n';
    }
    EXPECT_EQ(read_back(text).atoms.species,
              (std::vector<Species>{Species::carbon, Species::hydrogen}))
        << properties;
  }
}

TEST(ReadXyz, TakesTypesOfLammpsOnlyWithTheirElements) {
  const TemporaryFolder folder;
  const auto path = folder.file("dump.xyz", "2\nAtoms. Timestep: 0\n1 0 0 0\n2 0 0 1\n");
  EXPECT_NE(message_of<FileError>([&] { static_cast<void>(read_xyz(path)); }).find("--elements"),
            std::string::npos);
  const auto file = read_xyz(path, {.elements = {Species::hydrogen, Species::carbon}});
  EXPECT_EQ(file.structure.atoms.species,
            (std::vector<Species>{Species::hydrogen, Species::carbon}));
  const auto ones = folder.file("ones.xyz", "1\nAtoms. Timestep: 0\n1 0 0 0\n");
  EXPECT_NE(message_of<FileError>([&] { static_cast<void>(read_xyz(ones)); }).find("line 3"),
            std::string::npos);
}

TEST(Xyz, KeepsArraysOfTheHeaderWhole) {
  for (const std::string array : {"[1, 0, 0]", "[[1, 2], [3, 4]]", "[a, b]"}) {
    const Structure frame =
        read_back("1\nProperties=species:S:1:pos:R:3 key=" + array + " next=5\nC 0 0 0\n");
    ASSERT_EQ(frame.header.size(), 2u) << array;
    EXPECT_EQ(std::get<std::string>(frame.header[0].value), array);
    EXPECT_NE(xyz_text_of(frame).find(" key=" + array + " next=5"), std::string::npos) << array;
  }
}

TEST(ReadXyz, NamesTheLineOfEveryFault) {
  const std::string extended = "Properties=species:S:1:pos:R:3 ";
  const std::vector<std::array<std::string, 2>> cases = {
      {"", "line 0"},
      {"x\n\n", "line 1"},
      {"-1\n\n", "line 1"},
      {"1 2\n\nC 0 0 0\n", "line 1"},
      {"1\n", "line 1"},
      {"2\n\nC 0 0 0.000000\nC 0 0\n", "line 4"},
      {"2\n\nC 0 0 0 filler filler\n", "line 3"},
      {"1\n\nC 0 0 nan\n", "line 3"},
      {"1\n\nC 0 0 inf\n", "line 3"},
      {"1\n\nC 0 0 1.0x\n", "line 3"},
      {"1\n\nSi 0 0 0\n", "line 3"},
      {"1\n" + extended + "\nC 0 0 0 0\n", "line 3"},
      {"1\n" + extended + "pbc=\"T T T\"\nC 0 0 0\n", "line 2"},
      {"1\n" + extended + "pbc=\"T T\"\nC 0 0 0\n", "line 2"},
      {"1\n" + extended + "Lattice=\"1 2 3\"\nC 0 0 0\n", "line 2"},
      {"1\n" + extended + "Lattice=\"1 2 3\nC 0 0 0\n", "line 2"},
      {"1\nProperties=species:S\nC 0 0 0\n", "line 2"},
      {"1\nProperties=species:S:1\nC\n", "line 2"},
      {"1\nProperties=pos:R:3\n0 0 0\n", "line 2"},
      {"1\nProperties=species:S:1:pos:R:3:x:R:2000000000\nC 0 0 0\n", "line 2"},
      {"1\nProperties=species:S:1:pos:R:3:n:I:1\nC 0 0 0 99999999999\n", "line 3"},
      {"1\nLattice=[[1, 2, 3], [4, 5, 6] " + extended + "\nC 0 0 0\n", "no closing ]"},
      {"1\nLattice=[1, 2, 3} " + extended + "\nC 0 0 0\n", "no closing ]"},
      {"1\n" + extended + "pbc=\"T maybe F\"\nC 0 0 0\n", "line 2: pbc"},
      {"1\n" + extended + "Latice=\"2 0 0 0 2 0 0 0 2\"\nC 0 0 0\n", "'latice' is not known"},
      {"1\nLattices=\"2 0 0 0 2 0 0 0 2\"\nC 0 0 0\n", "'lattices' is not known"},
      {"1\n" + extended + "cell=\"2 0 0 0 2 0 0 0 2\"\nC 0 0 0\n", "the cell is Lattice"},
      {"1\n" + extended + "Lattice=\"2 0 0 0 2 0 0 0 2\" lattice=\"\"\nC 0 0 0\n", "second time"},
      {"1\n" + extended + "Lattice=\"0 0 0 0 2 0 0 0 2\"\nC 0 0 0\n", "that is zero"},
      {"1\n" + extended + "Lattice=\nC 0 0 0\n", "has no value"},
      {"1\n" + extended + "=5\nC 0 0 0\n", "no key"},
      {"1\nProperties=species:S:1:pos:X:3\nC 0 0 0\n", "type of 'pos'"},
      {"1\nProperties=species:S:1:pos:R:2\nC 0 0\n", "pos:R:3"},
      {"2\n\nC 0 0 0.000000\nC 0 0 0\n1\n", "line 5"},
      {"1\n\nC 0 0 0\nC 1 0 0\n", "line 4"}};
  for (const auto& [text, line] : cases) {
    EXPECT_NE(complaint_about(text).find(line), std::string::npos)
        << text << "\n-> " << complaint_about(text);
  }
}

TEST(ReadXyz, RefusesACountThatTheFileCannotHold) {
  EXPECT_NE(complaint_about("2000000000\n\nC 0 0 0\n").find("cut short"), std::string::npos);
}

TEST(ReadXyz, RefusesAPackedFileThatWouldFillTheMemory) {
  const TemporaryFolder folder;
  const auto path = folder.path() / "bomb.xyz.gz";
  gzFile file = gzopen(path.c_str(), "wb1");
  const std::string blanks(std::size_t{1} << 20, '\n');
  for (int k = 0; k < 70; ++k) gzwrite(file, blanks.data(), static_cast<unsigned>(blanks.size()));
  gzclose(file);
  const auto message = message_of<FileError>([&] { static_cast<void>(read_xyz(path)); });
  EXPECT_NE(message.find("bomb.xyz.gz: it unpacks to more than 200 times its size"),
            std::string::npos)
      << message;
}

TEST(ReadXyz, ThrowsOnAMissingFileAndOnAFolder) {
  EXPECT_THROW(static_cast<void>(read_xyz("/nonexistent.extxyz")), FileError);
  EXPECT_THROW(static_cast<void>(read_xyz("/tmp")), FileError);
}

}  // namespace
}  // namespace trivalent::dual
