#include "files.h"

#include <unistd.h>

#include <algorithm>
#include <sstream>

#include "session.h"
#include "trivalent/formats/structure_format.h"
#include "trivalent/remesh/error.h"
#include "trivalent/remesh/mesh_io.h"
#include "trivalent/remesh/shapes.h"
#include "trivalent/shell/ideal_source.h"

namespace trivalent::apps {

std::string extension_of(const std::filesystem::path& path) {
  std::string extension = path.extension().string();
  std::transform(extension.begin(), extension.end(), extension.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return extension == ".gz" ? extension_of(path.stem()) : extension;
}

namespace {

void check_place(const std::filesystem::path& path) {
  const auto folder = path.has_parent_path() ? path.parent_path() : std::filesystem::path(".");
  std::error_code error;
  if (!std::filesystem::is_directory(folder, error)) {
    throw remesh::FileError("cannot write " + path.string() + ": there is no folder " +
                            folder.string());
  }
  if (std::filesystem::is_directory(path, error)) {
    throw remesh::FileError("cannot write " + path.string() + ": it is a folder");
  }
}

}  // namespace

void check_output(const std::filesystem::path& path, std::span<const std::string_view> extensions) {
  const std::string extension = path.extension().string();
  if (std::find(extensions.begin(), extensions.end(), extension) == extensions.end()) {
    std::string known;
    for (const auto& each : extensions) known += (known.empty() ? "" : ", ") + std::string(each);
    throw UsageError("cannot write '" + path.string() + "': its extension must be one of " + known);
  }
  check_place(path);
}

void check_structure_output(const std::filesystem::path& path,
                            std::span<const std::string_view> further) {
  const dual::StructureFormat* format = dual::find_structure_format(path);
  if (format != nullptr && format->write != nullptr) {
    check_place(path);
    return;
  }
  const std::vector<std::string> known = dual::structure_extensions();
  std::vector<std::string_view> all(known.begin(), known.end());
  all.insert(all.end(), further.begin(), further.end());
  check_output(path, all);
}

void check_folder(const std::filesystem::path& folder) {
  std::error_code error;
  std::filesystem::path existing = std::filesystem::absolute(folder);
  while (!std::filesystem::exists(existing, error) && existing != existing.root_path()) {
    existing = existing.parent_path();
  }
  const bool is_folder = std::filesystem::is_directory(existing, error);
  if (is_folder && access(existing.c_str(), W_OK) == 0) return;
  throw remesh::FileError("cannot write into " + folder.string() + ": " + existing.string() +
                          (is_folder ? " is not writable" : " is not a folder"));
}

OutputFolder::OutputFolder(std::filesystem::path folder) : folder_(std::move(folder)) {
  std::error_code error;
  is_new_ = std::filesystem::create_directories(folder_, error);
  if (!error && std::filesystem::is_directory(folder_, error)) return;
  throw remesh::FileError("cannot make the folder " + folder_.string() + ": " +
                          (error ? error.message() : "something else is called so"));
}

OutputFolder::~OutputFolder() {
  std::error_code error;
  if (is_new_) std::filesystem::remove(folder_, error);  // refused if it holds anything
}

namespace {

std::string list_of(const std::vector<remesh::ShapeDescription>& descriptions) {
  std::ostringstream text;
  for (const remesh::ShapeDescription& shape : descriptions) {
    text << "  " << shape.name << ": " << shape.meaning << '\n';
    for (const remesh::ShapeParameter& parameter : shape.parameters) {
      text << "      " << parameter.name;
      if (!parameter.is_list) text << " [" << parameter.default_value << ']';
      text << ": " << parameter.meaning << '\n';
    }
  }
  return text.str();
}

}  // namespace

std::string shapes_help() {
  return "Built-in shapes, with parameters as in torus:R=3,r=1 (defaults in brackets):\n" +
         list_of(remesh::built_in_shapes());
}

std::string ideal_structures_help() {
  return "Ideal structures, which stand for a file of atoms in every command "
         "(nanotube:n=5,m=5):\n" +
         list_of(shell::ideal_structures());
}

Result describe_written(const std::string& output, const dual::Structure& structure,
                        const std::vector<std::string>& notes) {
  return {.table = {{"wrote", output},
                    {"atoms", std::to_string(structure.atoms.size())},
                    {"bonds", std::to_string(structure.bonds.size())}},
          .json = {{"file", output},
                   {"atoms", structure.atoms.size()},
                   {"bonds", structure.bonds.size()},
                   {"notes", notes}}};
}

remesh::TriMesh read_mesh_file(const std::string& path, const Terminal& terminal) {
  remesh::MeshFile file = remesh::read_mesh(path);
  terminal.notes(file.notes);
  return std::move(file.mesh);
}

}  // namespace trivalent::apps
