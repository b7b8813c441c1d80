#include "trivalent/remesh/whole_file.h"

#include <fcntl.h>
#include <unistd.h>

#include <cerrno>
#include <ostream>
#include <streambuf>
#include <system_error>
#include <vector>

#include "io/part_file.h"
#include "trivalent/remesh/error.h"

namespace trivalent::remesh {

namespace {

namespace fs = std::filesystem;

/// Stream buffer over a descriptor that remembers why writing failed.
class DescriptorBuffer : public std::streambuf {
 public:
  explicit DescriptorBuffer(int descriptor) : descriptor_(descriptor), bytes_(1 << 18) {
    setp(bytes_.data(), bytes_.data() + bytes_.size());
  }
  [[nodiscard]] int error_number() const { return error_number_; }

 protected:
  int_type overflow(int_type next) override {
    if (!drain()) return traits_type::eof();
    if (!traits_type::eq_int_type(next, traits_type::eof())) sputc(traits_type::to_char_type(next));
    return traits_type::not_eof(next);
  }
  int sync() override { return drain() ? 0 : -1; }

 private:
  bool drain() {
    const char* from = pbase();
    while (error_number_ == 0 && from < pptr()) {
      const ssize_t written = ::write(descriptor_, from, static_cast<std::size_t>(pptr() - from));
      if (written >= 0)
        from += written;
      else if (errno != EINTR)
        error_number_ = errno;
    }
    setp(bytes_.data(), bytes_.data() + bytes_.size());
    return error_number_ == 0;
  }

  int descriptor_;
  std::vector<char> bytes_;
  int error_number_ = 0;
};

/// Calls `write` on the open file and makes sure that all of it arrived.
void write_through(const fs::path& path, const Descriptor& file,
                   const std::function<void(std::ostream&)>& write) {
  DescriptorBuffer buffer(file.number());
  std::ostream out(&buffer);
  write(out);
  out.flush();
  if (buffer.error_number() != 0) fail_to_write(path, "cannot be written", buffer.error_number());
  if (!out) throw FileError(concat("write_whole_file: ", path.string(), ": cannot be written"));
}

void write_directly(const fs::path& path, const std::function<void(std::ostream&)>& write) {
  Descriptor file(::open(path.c_str(), O_WRONLY | O_CLOEXEC));
  if (file.number() < 0) fail_to_write(path, "cannot be opened for writing", errno);
  write_through(path, file, write);
  if (!file.close()) fail_to_write(path, "cannot be written", errno);
}

/// Where a chain of symbolic links ends, whether anything exists there or not.
fs::path end_of_links(fs::path path) {
  constexpr int max_links = 40;  // as many as Linux follows
  std::error_code ignored;
  for (int i = 0; i < max_links && fs::is_symlink(path, ignored); ++i) {
    const fs::path next = fs::read_symlink(path, ignored);
    path = next.is_absolute() ? next : path.parent_path() / next;
  }
  return path;
}

}  // namespace

void write_whole_file(const fs::path& path, const std::function<void(std::ostream&)>& write) {
  std::error_code ignored;
  const fs::file_status status = fs::status(path, ignored);
  if (fs::is_directory(status)) fail_to_write(path, "cannot be written", EISDIR);
  if (fs::exists(status) && !fs::is_regular_file(status)) return write_directly(path, write);
  // Replacing a file needs no permission to write into it, so ask.
  if (fs::exists(status) && ::access(path.c_str(), W_OK) != 0)
    fail_to_write(path, "cannot be replaced", errno);
  const fs::path target = end_of_links(path);
  PartFile part(target);
  write_through(target, part.file(), write);
  part.keep();
}

}  // namespace trivalent::remesh
