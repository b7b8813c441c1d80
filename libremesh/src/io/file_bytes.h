#pragma once

#include <cstddef>
#include <filesystem>
#include <string>
#include <string_view>

#include "io/text_scanner.h"

namespace trivalent::remesh {

/// All bytes of a file, or of a stream such as /dev/stdin.
///
/// @throws FileError if it is missing, a folder or cannot be read.
[[nodiscard]] std::string read_bytes(const std::filesystem::path& path);

[[nodiscard]] bool is_gzipped(std::string_view bytes);

/// Unpacks gzipped bytes, of one packed part or several after each other.
///
/// @param best_compression  What packs better, beyond the first megabyte, is made to fill the
///   memory.
/// @throws FileError if they are damaged, cut short, packed twice or too well.
[[nodiscard]] std::string unpack(const Source& source, std::size_t best_compression);

/// Extension of a file's name in lower case, with its point; of what is packed if that is ".gz".
[[nodiscard]] std::string extension_of(const Source& source);

}  // namespace trivalent::remesh
