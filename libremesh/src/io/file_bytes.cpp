#include "io/file_bytes.h"

#define ZLIB_CONST  // zlib reads what it unpacks, and no more
#include <zlib.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstdio>
#include <memory>
#include <new>
#include <system_error>

#include "io/mesh_readers.h"
#include "trivalent/remesh/error.h"

namespace trivalent::remesh {

namespace fs = std::filesystem;

namespace {

struct EndInflating {
  void operator()(z_stream* stream) const { inflateEnd(stream); }
};

}  // namespace

std::string read_bytes(const fs::path& path) {
  const auto complain = [&path](int error_number) {
    return FileError(concat("read_mesh: ", path.string(),
                            ": cannot be read: ", std::generic_category().message(error_number)));
  };
  std::error_code ignored;
  if (fs::is_directory(path, ignored)) throw complain(EISDIR);
  const std::unique_ptr<std::FILE, int (*)(std::FILE*)> file(std::fopen(path.c_str(), "rb"),
                                                             std::fclose);
  if (!file) throw complain(errno);
  std::string bytes;
  const auto size = fs::file_size(path, ignored);
  if (!ignored) bytes.reserve(size);
  std::array<char, 1 << 16> chunk{};
  while (const std::size_t got = std::fread(chunk.data(), 1, chunk.size(), file.get())) {
    bytes.append(chunk.data(), got);
  }
  if (std::ferror(file.get()) != 0) throw complain(errno);
  return bytes;
}

bool is_gzipped(std::string_view bytes) { return bytes.substr(0, 2) == "\x1f\x8b"; }

std::string unpack(const Source& source, std::size_t best_compression) {
  constexpr std::size_t surely_harmless = 1 << 20;
  z_stream stream{};
  constexpr int any_window_and_gzip_header = 15 + 32;
  if (inflateInit2(&stream, any_window_and_gzip_header) != Z_OK) throw std::bad_alloc();
  const std::unique_ptr<z_stream, EndInflating> ending(&stream);
  std::string unpacked;
  const std::string_view input = source.bytes;
  std::array<char, 1 << 16> chunk{};
  std::size_t at = 0;
  for (;;) {
    const std::size_t given = std::min<std::size_t>(input.size() - at, 1 << 30);
    stream.next_in = reinterpret_cast<const Bytef*>(input.data() + at);
    stream.avail_in = static_cast<uInt>(given);
    stream.next_out = reinterpret_cast<Bytef*>(chunk.data());
    stream.avail_out = chunk.size();
    const int status = inflate(&stream, Z_NO_FLUSH);
    at += given - stream.avail_in;
    unpacked.append(chunk.data(), chunk.size() - stream.avail_out);
    if (unpacked.size() > surely_harmless && unpacked.size() / best_compression > at) {
      fail(source, concat("its first ", at, " bytes unpack to more than ", best_compression,
                          " times as many; if they are sound, unpack them first"));
    }
    // Several packed parts may follow each other.
    if (status == Z_STREAM_END && at < input.size() && inflateReset(&stream) == Z_OK) continue;
    if (status == Z_STREAM_END) break;
    if (status != Z_OK)
      fail(source, concat("damaged gzip data near byte ", at, "; is it cut short?"));
  }
  // Once only: there are files that unpack to themselves.
  if (is_gzipped(unpacked)) fail(source, "is gzipped twice; unpack it once");
  return unpacked;
}

std::string extension_of(const Source& source) {
  fs::path name = source.name;
  if (name.extension() == ".gz") name = name.stem();
  return lower_case(name.extension().string());
}

}  // namespace trivalent::remesh
