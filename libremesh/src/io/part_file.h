#pragma once

#include <filesystem>
#include <string>
#include <string_view>
#include <utility>

namespace trivalent::remesh {

/// Owns a file descriptor; close() reports what the destructor cannot.
class Descriptor {
 public:
  explicit Descriptor(int number) : number_(number) {}
  Descriptor(const Descriptor&) = delete;
  Descriptor(Descriptor&&) = delete;
  Descriptor& operator=(const Descriptor&) = delete;
  Descriptor& operator=(Descriptor&&) = delete;
  ~Descriptor();
  [[nodiscard]] int number() const { return number_; }
  [[nodiscard]] bool close();

 private:
  int number_;
};

/// A place among the names that remove_part_files() knows; without a free one it does nothing.
class ShownName {
 public:
  ShownName();
  ShownName(const ShownName&) = delete;
  ShownName(ShownName&&) = delete;
  ShownName& operator=(const ShownName&) = delete;
  ShownName& operator=(ShownName&&) = delete;
  ~ShownName();
  void show(const std::string& name);

 private:
  std::size_t slot_;
};

/// When a part file gets a name.
enum class Naming {
  late,    ///< once it is whole, so that even a killed program leaves nothing; not on every disk
  at_once  ///< when it is opened
};

/// A new file in the folder of the wanted one; it becomes that one by keep(), or disappears.
class PartFile {
 public:
  /// Where late names are not possible, files are named at once.
  explicit PartFile(std::filesystem::path target, Naming naming = Naming::late);
  PartFile(const PartFile&) = delete;
  PartFile(PartFile&&) = delete;
  PartFile& operator=(const PartFile&) = delete;
  PartFile& operator=(PartFile&&) = delete;
  ~PartFile();

  [[nodiscard]] const Descriptor& file() const { return file_; }

  /// Brings the bytes to the disk, then replaces the wanted file by this one.
  void keep();

 private:
  [[nodiscard]] int open(Naming naming);
  /// Calls make(name) with names that nobody has until it returns a number, not -1.
  template <typename Make>
  int make_with_new_name(const Make& make);

  std::filesystem::path target_;
  std::filesystem::path name_;  ///< on the disk; empty without one
  ShownName shown_;             ///< the same, for remove_part_files()
  Descriptor file_;
};

/// Throws FileError about a file that write_whole_file() cannot write.
[[noreturn]] void fail_to_write(const std::filesystem::path& path, std::string_view what,
                                int error_number);

}  // namespace trivalent::remesh
