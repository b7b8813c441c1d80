#include "io/part_file.h"

#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "temporary_folder.h"
#include "trivalent/remesh/error.h"
#include "trivalent/remesh/whole_file.h"

namespace trivalent::remesh {
namespace {

namespace fs = std::filesystem;
using testing_support::contents_of;
using testing_support::TemporaryFolder;

void write(const PartFile& part, std::string_view text) {
  ASSERT_EQ(::write(part.file().number(), text.data(), text.size()),
            static_cast<ssize_t>(text.size()));
}

TEST(PartFile, ReplacesTheOldFileOnlyWhenKept) {
  for (const Naming naming : {Naming::late, Naming::at_once}) {
    const TemporaryFolder folder;
    const fs::path path = folder.file("a", "old");
    {
      PartFile part(path, naming);
      write(part, "new");
      EXPECT_EQ(contents_of(path), "old");
      part.keep();
      EXPECT_EQ(contents_of(path), "new");
    }
    { write(PartFile(path, naming), "half"); }
    EXPECT_EQ(contents_of(path), "new");
    EXPECT_EQ(folder.count_files(), 1);
  }
}

TEST(PartFile, WithALateNameIsNowhereUntilKept) {
  const TemporaryFolder folder;
  const PartFile part(folder.path() / "a", Naming::late);
  write(part, "half");
  // File systems that know no such files have it under a name.
  EXPECT_LE(folder.count_files(), 1);
  if (folder.count_files() == 1) GTEST_SKIP() << "this file system names files at once";
}

TEST(PartFile, ManyAreWrittenAtATime) {
  const TemporaryFolder folder;
  constexpr int many = 40;  // more than there are places for a handler of signals to look
  std::vector<std::unique_ptr<PartFile>> parts;
  for (int k = 0; k < many; ++k) {
    parts.push_back(std::make_unique<PartFile>(folder.path() / std::to_string(k), Naming::at_once));
  }
  for (const auto& part : parts) part->keep();
  parts.clear();
  EXPECT_EQ(folder.count_files(), many);
}

TEST(RemovePartFiles, LeavesNoPartsAndNoDamage) {
  const TemporaryFolder folder;
  const fs::path path = folder.file("a", "old");
  {
    PartFile part(path, Naming::at_once);
    write(part, "half");
    EXPECT_EQ(folder.count_files(), 2);
    remove_part_files();
    EXPECT_EQ(folder.count_files(), 1);
    // What goes on writing fails.
    EXPECT_THROW(part.keep(), FileError);
  }
  EXPECT_EQ(contents_of(path), "old");
  // Nothing of it is remembered.
  PartFile(path, Naming::at_once).keep();
  remove_part_files();
  EXPECT_TRUE(fs::exists(path));
}

}  // namespace
}  // namespace trivalent::remesh
