#include "gzip_stream.h"

#include <new>

namespace trivalent::dual {

GzipBuffer::GzipBuffer(std::ostream& out) : out_(out) {
  constexpr int gzip_header = 16;  // instead of zlib's own
  constexpr int memory_level = 8;
  // The fastest level: coordinates hardly get smaller at higher ones.
  if (deflateInit2(&stream_, Z_BEST_SPEED, Z_DEFLATED, MAX_WBITS + gzip_header, memory_level,
                   Z_DEFAULT_STRATEGY) != Z_OK) {
    throw std::bad_alloc();
  }
  setp(text_.data(), text_.data() + text_.size());
}

GzipBuffer::~GzipBuffer() { deflateEnd(&stream_); }

void GzipBuffer::finish() { compress(Z_FINISH); }

GzipBuffer::int_type GzipBuffer::overflow(int_type character) {
  compress(Z_NO_FLUSH);
  if (!traits_type::eq_int_type(character, traits_type::eof())) {
    *pptr() = traits_type::to_char_type(character);
    pbump(1);
  }
  return traits_type::not_eof(character);
}

void GzipBuffer::compress(int flush) {
  stream_.next_in = reinterpret_cast<Bytef*>(pbase());
  stream_.avail_in = static_cast<uInt>(pptr() - pbase());
  do {
    stream_.next_out = reinterpret_cast<Bytef*>(compressed_.data());
    stream_.avail_out = static_cast<uInt>(compressed_.size());
    deflate(&stream_, flush);
    out_.write(compressed_.data(),
               static_cast<std::streamsize>(compressed_.size() - stream_.avail_out));
  } while (stream_.avail_out == 0);
  setp(text_.data(), text_.data() + text_.size());
}

}  // namespace trivalent::dual
