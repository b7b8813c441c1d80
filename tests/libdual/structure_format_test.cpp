#include "trivalent/formats/structure_format.h"

#include <gtest/gtest.h>
#include <zlib.h>

#include <fstream>
#include <sstream>

#include "small_structures.h"
#include "temporary_folder.h"
#include "trivalent/dual/build_dual.h"
#include "trivalent/dual/dual_size.h"
#include "trivalent/formats/text_file.h"
#include "trivalent/shell/build.h"
#include "trivalent/shell/build_files.h"
#include "trivalent/shell/evaluate.h"
#include "trivalent/shell/relax.h"
#include "trivalent/shell/structure_source.h"
#include "trivalent/view/shell_page.h"

namespace trivalent::dual {
namespace {

using testing_support::contents_of;
using testing_support::TemporaryFolder;

// A format as somebody may add it: one atom of carbon a line, nothing else.
StructureFile read_toy(const std::filesystem::path& path, const ReadOptions&) {
  const TextSource source = {.reader = "read_toy", .path = path};
  const std::string text = read_text(source);
  LineReader lines(text, source);
  StructureFile file;
  std::vector<std::string_view> fields;
  while (const auto line = lines.next()) {
    split_fields(*line, fields);
    if (fields.size() != 3) lines.fail("expected x, y and z");
    file.structure.atoms.positions.emplace_back(lines.real(fields[0]), lines.real(fields[1]),
                                                lines.real(fields[2]));
    file.structure.atoms.species.push_back(potentials::Species::carbon);
  }
  return file;
}

std::vector<std::string> write_toy(std::ostream& out, const Structure& structure,
                                   const WriteOptions& options) {
  for (const Eigen::Vector3d& x : structure.atoms.positions) {
    std::string line;
    for (int i = 0; i < 3; ++i) {
      append_real(line, x[i], options.digits);
      line += i < 2 ? ' ' : '\n';
    }
    out << line;
  }
  return {};
}

class ToyFormat : public testing::Test {
 protected:
  ToyFormat() {
    structure_formats().push_back(
        {.name = "toy", .extensions = {".toy"}, .read = read_toy, .write = write_toy});
  }
  ~ToyFormat() override { structure_formats().pop_back(); }

  const TemporaryFolder folder_;
};

TEST_F(ToyFormat, IsReadEvaluatedRelaxedAndShown) {
  const auto path = folder_.path() / "c20.toy";
  write_structure(path, testing_support::c20(), {.digits = Digits::seventeen_significant});
  Structure read = shell::read_structure(path).structure;
  EXPECT_EQ(read.atoms.positions, testing_support::c20().atoms.positions);

  shell::Evaluation evaluation = shell::evaluate(read);
  EXPECT_EQ(evaluation.energy.energy, shell::evaluate(testing_support::c20()).energy.energy);
  const shell::RelaxedStructure relaxed = shell::relax(read);
  write_structure(folder_.path() / "relaxed.toy.gz", relaxed.structure);
  EXPECT_EQ(shell::read_structure(folder_.path() / "relaxed.toy.gz").structure.atoms.size(), 20u);

  ShellPage page = {.title = "toy"};
  page.states.push_back(std::move(evaluation.state));
  write_shell_page(folder_.path() / "toy.html", page, "<html><!--shell-data--></html>");
  EXPECT_TRUE(std::filesystem::exists(folder_.path() / "toy.html"));
}

TEST_F(ToyFormat, IsWrittenByABuild) {
  shell::BuildOptions options = {.relaxation = shell::Relaxation::none};
  options.shell.size = AtomCount{120};
  options.shell.method = remesh::CrystalOptions{.effort = remesh::Effort::quick};
  const auto result = shell::build(shell::read_surface("sphere", options.shell), options);
  shell::write_build(folder_.path(), result, {.formats = {"toy"}});
  EXPECT_EQ(shell::read_structure(folder_.path() / "shell.toy").structure.atoms.size(),
            result.shell.structure.atoms.size());
}

TEST(StructureFormats, AreFoundByTheNameOfTheFile) {
  const auto name_of = [](const char* path) {
    const StructureFormat* format = find_structure_format(path);
    return format == nullptr ? std::string("none") : format->name;
  };
  EXPECT_EQ(name_of("a/b.extxyz"), "extxyz");
  EXPECT_EQ(name_of("b.XYZ"), "extxyz");
  EXPECT_EQ(name_of("b.xyz.gz"), "extxyz");
  EXPECT_EQ(name_of("b.data"), "lammps-data");
  EXPECT_EQ(name_of("b.lmp.GZ"), "lammps-data");
  EXPECT_EQ(name_of("x/data.graphene"), "lammps-data");
  EXPECT_EQ(name_of("data.c60.gz"), "lammps-data");
  EXPECT_EQ(name_of("data.xyz"), "extxyz");
  EXPECT_EQ(name_of("data.ply"), "none");
  EXPECT_EQ(name_of("b.off"), "none");
  EXPECT_EQ(name_of("database"), "none");
}

TEST(StructureFormats, ReadBackWhatTheyWrite) {
  const TemporaryFolder folder;
  for (const StructureFormat& format : structure_formats()) {
    if (format.read == nullptr) continue;
    for (const std::string& extension : format.extensions) {
      const auto path = folder.path() / ("c20" + extension);
      write_structure(path, testing_support::c20(), {.digits = Digits::seventeen_significant});
      const Structure back = shell::read_structure(path).structure;
      ASSERT_EQ(back.atoms.size(), 20u);
      for (std::size_t i = 0; i < 20; ++i) {  // some put a corner of the cell at the origin
        const Eigen::Vector3d moved = back.atoms.positions[i] - back.atoms.positions[0];
        const Eigen::Vector3d expected =
            testing_support::c20().atoms.positions[i] - testing_support::c20().atoms.positions[0];
        EXPECT_LE((moved - expected).norm(), format.name == "pdb" ? 2e-3 : 1e-8) << format.name;
      }
      const auto renamed = folder.path() / "renamed";
      std::filesystem::rename(path, renamed);
      EXPECT_EQ(shell::read_structure(renamed, {.format = format.name}).structure.atoms.size(),
                20u);
    }
  }
}

TEST(StructureFormats, WriteAnyBoxForLammps) {
  const TemporaryFolder folder;
  Structure turned = testing_support::c20();
  turned.atoms.box.cell << 0, 30, 0, 0, 0, 30, 30, 0, 0;
  turned.atoms.box.cell.col(0) *= -1.0;
  turned.atoms.box.periodic = {true, true, true};
  const auto path = folder.path() / "turned.data";
  const std::vector<std::string> notes =
      write_structure(path, turned, {.digits = Digits::seventeen_significant});
  ASSERT_EQ(notes.size(), 2u);
  EXPECT_NE(notes[0].find("rotated"), std::string::npos);
  EXPECT_NE(notes[1].find("cell vectors"), std::string::npos);
  EXPECT_TRUE(write_structure(folder.path() / "turned.extxyz", turned).empty());
  EXPECT_NE(contents_of(path).find("rotated by"), std::string::npos);
  EXPECT_NEAR(shell::evaluate(shell::read_structure(path).structure).energy.energy,
              shell::evaluate(turned).energy.energy, 1e-9);
}

TEST(StructureFormats, RefuseOptionsOfOthers) {
  const TemporaryFolder folder;
  write_structure(folder.path() / "a.extxyz", testing_support::c20());
  write_structure(folder.path() / "a.data", testing_support::c20());
  EXPECT_THROW(static_cast<void>(shell::read_structure(
                   folder.path() / "a.extxyz", {.reading = {.atom_style = AtomStyle::full}})),
               InvalidOption);
  EXPECT_THROW(
      static_cast<void>(shell::read_structure(folder.path() / "a.data", {.reading = {.frame = 2}})),
      InvalidOption);
}

TEST(StructureFormats, SayWhatTheyDoNotKnow) {
  EXPECT_THROW(static_cast<void>(structure_format("docx")), InvalidOption);
  EXPECT_THROW(write_structure("a.docx", testing_support::c20()), InvalidOption);
  EXPECT_THROW(static_cast<void>(shell::read_structure("-")), InvalidOption);
  EXPECT_THROW(static_cast<void>(shell::read_structure("a.off", {.reading = {.frame = 2}})),
               InvalidOption);
}

}  // namespace
}  // namespace trivalent::dual
