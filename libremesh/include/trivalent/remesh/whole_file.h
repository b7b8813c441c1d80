#pragma once

#include <filesystem>
#include <functional>
#include <iosfwd>

namespace trivalent::remesh {

/// Writes a file so that it appears whole or not at all.
///
/// Writes beside the path, brings the bytes to the disk, then renames over the path; an old file
/// stays as it was until then. A symbolic link is followed, also to where no file is yet. Devices
/// and pipes, such as /dev/stdout, are written directly.
///
/// @param write  Writes the contents; what it throws is passed on after cleaning up.
/// @throws FileError if the path is a directory, the folder is missing or not writable, or the disk
///   is full; the message says which.
void write_whole_file(const std::filesystem::path& path,
                      const std::function<void(std::ostream&)>& write);

/// Removes the unfinished files of write_whole_file(), whose calls then fail. For a signal handler
/// that is about to end the program; safe to call at any moment.
void remove_part_files() noexcept;

}  // namespace trivalent::remesh
