#pragma once

#include <zlib.h>

#include <array>
#include <ostream>
#include <streambuf>

namespace trivalent::dual {

/// Compresses what is written to it with gzip, into another stream. finish() comes last.
class GzipBuffer : public std::streambuf {
 public:
  explicit GzipBuffer(std::ostream& out);
  ~GzipBuffer() override;
  GzipBuffer(const GzipBuffer&) = delete;
  GzipBuffer& operator=(const GzipBuffer&) = delete;

  /// Writes the end of the file; without it the file is cut short.
  void finish();

 protected:
  int_type overflow(int_type character) override;

 private:
  void compress(int flush);

  std::ostream& out_;
  z_stream stream_ = {};
  std::array<char, 1 << 16> text_;
  std::array<char, 1 << 16> compressed_;
};

}  // namespace trivalent::dual
