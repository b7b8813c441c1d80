#pragma once

#include <array>
#include <filesystem>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "terminal.h"
#include "trivalent/dual/structure.h"
#include "trivalent/remesh/mesh.h"

namespace trivalent::apps {

/// What remesh::write_mesh can write.
inline constexpr std::array<std::string_view, 4> mesh_extensions = {".off", ".obj", ".ply", ".stl"};

/// The path's extension in lower case; of "a.data.gz" it is ".data".
[[nodiscard]] std::string extension_of(const std::filesystem::path& path);

/// Refuses, before any work, an output that could not be written afterwards.
///
/// @throws UsageError        if the extension is none of the given.
/// @throws remesh::FileError if its folder does not exist or it is a folder itself.
void check_output(const std::filesystem::path& path, std::span<const std::string_view> extensions);

/// The same for a file of atoms: any of dual::structure_formats(), or one of further extensions.
///
/// @throws as check_output.
void check_structure_output(const std::filesystem::path& path,
                            std::span<const std::string_view> further = {});

/// Refuses, before any work, a folder that could not be made or filled afterwards.
///
/// @throws remesh::FileError if something else is called so or it is not writable.
void check_folder(const std::filesystem::path& folder);

/// A folder to write into, made if it is missing; if nothing comes into it, it is removed again.
class OutputFolder {
 public:
  /// @throws remesh::FileError if the folder is not there and cannot be made.
  explicit OutputFolder(std::filesystem::path folder);
  OutputFolder(const OutputFolder&) = delete;
  OutputFolder& operator=(const OutputFolder&) = delete;
  ~OutputFolder();

 private:
  std::filesystem::path folder_;
  bool is_new_;
};

/// Names and parameters of all built-in shapes, for --help.
[[nodiscard]] std::string shapes_help();

/// The ideal structures and their parameters, for help texts.
[[nodiscard]] std::string ideal_structures_help();

/// What a command says that has written atoms.
[[nodiscard]] Result describe_written(const std::string& output, const dual::Structure& structure,
                                      const std::vector<std::string>& notes);

/// Reads a mesh file, tells the terminal what was changed on the way in.
[[nodiscard]] remesh::TriMesh read_mesh_file(const std::string& path, const Terminal& terminal);

}  // namespace trivalent::apps
