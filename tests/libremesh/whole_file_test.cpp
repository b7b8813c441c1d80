#include "trivalent/remesh/whole_file.h"

#include <gtest/gtest.h>

#include <filesystem>
#include <ostream>
#include <stdexcept>
#include <string>

#include "temporary_folder.h"
#include "trivalent/remesh/error.h"

namespace trivalent::remesh {
namespace {

namespace fs = std::filesystem;
using testing_support::contents_of;
using testing_support::message_of;
using testing_support::TemporaryFolder;

void write_hello(std::ostream& out) { out << "hello\n"; }

TEST(WriteWholeFile, WritesAllBytesAndNothingElse) {
  const TemporaryFolder folder;
  const std::string many(3'000'000, 'x');
  write_whole_file(folder.path() / "a", [&](std::ostream& out) { out << many << 'y'; });
  EXPECT_EQ(contents_of(folder.path() / "a"), many + 'y');
  EXPECT_EQ(folder.count_files(), 1);
}

TEST(WriteWholeFile, ReplacesAFile) {
  const TemporaryFolder folder;
  const fs::path path = folder.file("a", "old");
  write_whole_file(path, write_hello);
  EXPECT_EQ(contents_of(path), "hello\n");
}

TEST(WriteWholeFile, LeavesTheOldFileWhenTheWriterThrows) {
  const TemporaryFolder folder;
  const fs::path path = folder.file("a", "old");
  const auto broken = [](std::ostream& out) {
    out << "half";
    throw std::out_of_range("no more");
  };
  EXPECT_THROW(write_whole_file(path, broken), std::out_of_range);
  EXPECT_EQ(contents_of(path), "old");
  EXPECT_EQ(folder.count_files(), 1);
}

TEST(WriteWholeFile, LeavesTheOldFileWhenTheStreamFails) {
  const TemporaryFolder folder;
  const fs::path path = folder.file("a", "old");
  EXPECT_THROW(write_whole_file(path, [](std::ostream& out) { out.setstate(std::ios::failbit); }),
               FileError);
  EXPECT_EQ(contents_of(path), "old");
  EXPECT_EQ(folder.count_files(), 1);
}

TEST(WriteWholeFile, FollowsASymbolicLink) {
  const TemporaryFolder folder;
  const fs::path path = folder.file("a", "old");
  fs::create_symlink("a", folder.path() / "link");
  write_whole_file(folder.path() / "link", write_hello);
  EXPECT_EQ(contents_of(path), "hello\n");
  EXPECT_TRUE(fs::is_symlink(folder.path() / "link"));
}

TEST(WriteWholeFile, FollowsLinksToWhereNoFileIsYet) {
  const TemporaryFolder folder;
  fs::create_directory(folder.path() / "results");
  fs::create_symlink("results/later", folder.path() / "second");
  fs::create_symlink(folder.path() / "second", folder.path() / "first");
  write_whole_file(folder.path() / "first", write_hello);
  EXPECT_TRUE(fs::is_symlink(folder.path() / "first"));
  EXPECT_TRUE(fs::is_symlink(folder.path() / "second"));
  EXPECT_EQ(contents_of(folder.path() / "results" / "later"), "hello\n");
}

TEST(WriteWholeFile, ThrowsOnAMissingFolder) {
  const TemporaryFolder folder;
  const auto message =
      message_of<FileError>([&] { write_whole_file(folder.path() / "none" / "a", write_hello); });
  EXPECT_NE(message.find("No such file or directory"), std::string::npos) << message;
}

TEST(WriteWholeFile, ThrowsOnADirectory) {
  const TemporaryFolder folder;
  EXPECT_THROW(write_whole_file(folder.path(), write_hello), FileError);
  EXPECT_TRUE(fs::is_directory(folder.path()));
}

TEST(WriteWholeFile, ThrowsOnAFullDisk) {
  if (!fs::exists("/dev/full")) GTEST_SKIP() << "no /dev/full on this system";
  const auto message = message_of<FileError>([] { write_whole_file("/dev/full", write_hello); });
  EXPECT_NE(message.find("No space left on device"), std::string::npos) << message;
  EXPECT_TRUE(fs::is_character_file("/dev/full"));
}

}  // namespace
}  // namespace trivalent::remesh
