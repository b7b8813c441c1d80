#include "io/part_file.h"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <array>
#include <atomic>
#include <cerrno>
#include <climits>
#include <cstring>
#include <string>
#include <system_error>

#include "trivalent/remesh/error.h"
#include "trivalent/remesh/whole_file.h"

namespace trivalent::remesh {

namespace {

namespace fs = std::filesystem;

// ---- names of part files -----------------------------------------------------------------------

/// A name where a handler of signals can read it at any moment.
struct NameSlot {
  std::atomic<bool> is_taken = false;
  std::atomic<bool> holds_name = false;
  std::array<char, PATH_MAX> name = {};
};

/// As many files may be written at a time and still be removed by a handler.
constexpr std::size_t n_slots = 16;

// A handler of signals cannot be told anything in another way.
// NOLINTNEXTLINE(cppcoreguidelines-avoid-non-const-global-variables)
std::array<NameSlot, n_slots> slots;

std::size_t take_slot() {
  for (std::size_t i = 0; i < n_slots; ++i) {
    if (!slots[i].is_taken.exchange(true)) return i;
  }
  return n_slots;
}

// ---- files without a name ----------------------------------------------------------------------

/// -1 where the file system knows no such files, or the way by which they get a name is missing.
int open_nameless(const fs::path& folder) {
  if (::access("/proc/self/fd", X_OK) != 0) return -1;
  return ::open(folder.c_str(), O_WRONLY | O_TMPFILE | O_CLOEXEC, 0666);
}

int link_nameless(int descriptor, const fs::path& name) {
  const std::string file = concat("/proc/self/fd/", descriptor);
  return ::linkat(AT_FDCWD, file.c_str(), AT_FDCWD, name.c_str(), AT_SYMLINK_FOLLOW);
}

fs::path folder_of(const fs::path& target) {
  return target.has_parent_path() ? target.parent_path() : ".";
}

}  // namespace

ShownName::ShownName() : slot_(take_slot()) {}

ShownName::~ShownName() {
  if (slot_ == n_slots) return;
  slots[slot_].holds_name = false;
  slots[slot_].is_taken = false;
}

void ShownName::show(const std::string& name) {
  if (slot_ == n_slots || name.size() >= PATH_MAX) return;
  std::memcpy(slots[slot_].name.data(), name.c_str(), name.size() + 1);
  slots[slot_].holds_name = true;
}

Descriptor::~Descriptor() {
  if (number_ >= 0) ::close(number_);
}

bool Descriptor::close() { return ::close(std::exchange(number_, -1)) == 0; }

PartFile::PartFile(fs::path target, Naming naming)
    : target_(std::move(target)), file_(open(naming)) {}

PartFile::~PartFile() {
  if (!name_.empty()) ::unlink(name_.c_str());
}

void PartFile::keep() {
  const int number = file_.number();
  if (::fsync(number) != 0 && errno != EINVAL) fail_to_write(target_, "cannot be written", errno);
  if (name_.empty()) {
    make_with_new_name([&](const fs::path& name) { return link_nameless(number, name); });
  }
  if (!file_.close()) fail_to_write(target_, "cannot be written", errno);
  if (::rename(name_.c_str(), target_.c_str()) != 0) {
    fail_to_write(target_, "cannot be replaced", errno);
  }
  name_.clear();
}

int PartFile::open(Naming naming) {
  if (naming == Naming::late) {
    const int number = open_nameless(folder_of(target_));
    if (number >= 0) return number;
  }
  return make_with_new_name([](const fs::path& name) {
    return ::open(name.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, 0666);
  });
}

template <typename Make>
int PartFile::make_with_new_name(const Make& make) {
  for (int attempt = 0;; ++attempt) {
    const fs::path name =
        folder_of(target_) / concat(".trivalent-", ::getpid(), '-', attempt, ".part");
    const int number = make(name);
    if (number >= 0) {
      name_ = name;
      shown_.show(name.string());
      return number;
    }
    if (errno != EEXIST) fail_to_write(target_, "no file can be made in its folder", errno);
  }
}

void remove_part_files() noexcept {
  for (const NameSlot& slot : slots) {
    if (slot.holds_name) ::unlink(slot.name.data());
  }
}

void fail_to_write(const fs::path& path, std::string_view what, int error_number) {
  throw FileError(concat("write_whole_file: ", path.string(), ": ", what, ": ",
                         std::generic_category().message(error_number)));
}

}  // namespace trivalent::remesh
