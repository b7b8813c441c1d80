#include <zlib.h>

#include <cstdlib>
#include <ostream>
#include <string>

#include "trivalent/dual/error.h"
#include "trivalent/remesh/whole_file.h"
#include "trivalent/view/picture.h"

namespace trivalent::dual {
namespace {

void append_big_endian(std::string& bytes, std::uint32_t value) {
  for (int shift = 24; shift >= 0; shift -= 8) bytes += static_cast<char>(value >> shift & 0xff);
}

/// Length, name, data and checksum [PNG, section 5].
void write_chunk(std::ostream& out, const std::string& name, const std::string& data) {
  std::string chunk;
  append_big_endian(chunk, static_cast<std::uint32_t>(data.size()));
  chunk += name + data;
  const auto* start = reinterpret_cast<const Bytef*>(chunk.data()) + 4;
  const auto checksum = crc32(0, start, static_cast<uInt>(chunk.size() - 4));
  append_big_endian(chunk, static_cast<std::uint32_t>(checksum));
  out.write(chunk.data(), static_cast<std::streamsize>(chunk.size()));
}

std::string header(const Picture& picture) {
  std::string data;
  append_big_endian(data, static_cast<std::uint32_t>(picture.width));
  append_big_endian(data, static_cast<std::uint32_t>(picture.height));
  data +=
      std::string("\x08\x02\x00\x00\x00", 5);  // 8 bits, red green blue, deflate, not interlaced
  return data;
}

/// The neighbor nearest to what a plane through all three would have [PNG, section 9.4].
int paeth(int left, int above, int corner) {
  const int plane = left + above - corner;
  const int to_left = std::abs(plane - left);
  const int to_above = std::abs(plane - above);
  const int to_corner = std::abs(plane - corner);
  if (to_left <= to_above && to_left <= to_corner) return left;
  return to_above <= to_corner ? above : corner;
}

/// A row as differences to what a filter expects: nothing, the pixel to the left, the one above,
/// the mean of both, or paeth; its number comes first.
std::string filtered_row(const Picture& picture, std::size_t at, int filter) {
  const std::size_t row_size = 3 * static_cast<std::size_t>(picture.width);
  std::string row(1, static_cast<char>(filter));
  for (std::size_t i = 0; i < row_size; ++i) {
    const int left = i >= 3 ? picture.pixels[at + i - 3] : 0;
    const int above = at > 0 ? picture.pixels[at + i - row_size] : 0;
    const int corner = i >= 3 && at > 0 ? picture.pixels[at + i - row_size - 3] : 0;
    const int expected[] = {0, left, above, (left + above) / 2, paeth(left, above, corner)};
    row += static_cast<char>(picture.pixels[at + i] - expected[filter]);
  }
  return row;
}

/// Every row by the filter that leaves the smallest differences, which deflate best.
std::string best_row(const Picture& picture, std::size_t at) {
  constexpr int n_filters = 5;
  std::string best;
  long smallest = 0;
  for (int filter = 0; filter < n_filters; ++filter) {
    std::string row = filtered_row(picture, at, filter);
    long sum = 0;
    for (const char difference : row) sum += std::abs(static_cast<signed char>(difference));
    if (!best.empty() && sum >= smallest) continue;
    smallest = sum;
    best = std::move(row);
  }
  return best;
}

std::string compressed_rows(const Picture& picture) {
  const std::size_t row_size = 3 * static_cast<std::size_t>(picture.width);
  std::string rows;
  for (std::size_t at = 0; at < picture.pixels.size(); at += row_size)
    rows += best_row(picture, at);
  uLongf size = compressBound(static_cast<uLong>(rows.size()));
  std::string data(size, '\0');
  constexpr int level = 9;
  if (compress2(reinterpret_cast<Bytef*>(data.data()), &size,
                reinterpret_cast<const Bytef*>(rows.data()), static_cast<uLong>(rows.size()),
                level) != Z_OK) {
    throw Error("write_png: zlib cannot compress the picture");
  }
  data.resize(size);
  return data;
}

}  // namespace

void write_png(const std::filesystem::path& path, const Picture& picture) {
  remesh::write_whole_file(path, [&](std::ostream& out) {
    out << "\x89PNG\r\n\x1a\n";
    write_chunk(out, "IHDR", header(picture));
    write_chunk(out, "IDAT", compressed_rows(picture));
    write_chunk(out, "IEND", "");
  });
}

}  // namespace trivalent::dual
