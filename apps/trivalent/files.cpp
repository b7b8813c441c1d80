#include "files.h"

#include <unistd.h>

#include <algorithm>
#include <charconv>
#include <sstream>

#include "session.h"
#include "trivalent/remesh/error.h"
#include "trivalent/remesh/mesh_io.h"

namespace trivalent::apps {
namespace {

remesh::ShapeArgument parse_argument(std::string_view text) {
  const std::size_t equals = std::min(text.find('='), text.size());
  const std::string_view number = text.substr(std::min(equals + 1, text.size()));
  double value = 0.0;
  const auto [end, error] = std::from_chars(number.data(), number.data() + number.size(), value);
  if (error != std::errc{} || end != number.data() + number.size()) {
    throw UsageError("a shape's parameter is name=number, not '" + std::string(text) + "'");
  }
  return {.name = std::string(text.substr(0, equals)), .value = value};
}

}  // namespace

std::string extension_of(const std::filesystem::path& path) {
  std::string extension = path.extension().string();
  std::transform(extension.begin(), extension.end(), extension.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return extension == ".gz" ? extension_of(path.stem()) : extension;
}

void check_output(const std::filesystem::path& path, std::span<const std::string_view> extensions) {
  const std::string extension = path.extension().string();
  if (std::find(extensions.begin(), extensions.end(), extension) == extensions.end()) {
    std::string known;
    for (const auto& each : extensions) known += (known.empty() ? "" : ", ") + std::string(each);
    throw UsageError("cannot write '" + path.string() + "': its extension must be one of " + known);
  }
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

void make_folder(const std::filesystem::path& folder) {
  std::error_code error;
  std::filesystem::create_directories(folder, error);
  if (!error && std::filesystem::is_directory(folder, error)) return;
  throw remesh::FileError("cannot make the folder " + folder.string() + ": " +
                          (error ? error.message() : "something else is called so"));
}

ShapeCall parse_shape(std::string_view text) {
  const std::size_t colon = std::min(text.find(':'), text.size());
  ShapeCall call = {.name = std::string(text.substr(0, colon)), .arguments = {}};
  std::string_view rest = text.substr(std::min(colon + 1, text.size()));
  while (!rest.empty()) {
    const std::size_t comma = std::min(rest.find(','), rest.size());
    call.arguments.push_back(parse_argument(rest.substr(0, comma)));
    rest.remove_prefix(std::min(comma + 1, rest.size()));
  }
  return call;
}

std::string shapes_help() {
  std::ostringstream text;
  text << "Built-in shapes, with parameters as in torus:R=3,r=1 (defaults in brackets):\n";
  for (const remesh::ShapeDescription& shape : remesh::built_in_shapes()) {
    text << "  " << shape.name << ": " << shape.meaning << '\n';
    for (const remesh::ShapeParameter& parameter : shape.parameters) {
      text << "      " << parameter.name << " [" << parameter.default_value
           << "]: " << parameter.meaning << '\n';
    }
  }
  return text.str();
}

bool is_built_in(std::string_view name) {
  const auto& shapes = remesh::built_in_shapes();
  return std::any_of(shapes.begin(), shapes.end(),
                     [&](const remesh::ShapeDescription& shape) { return shape.name == name; });
}

remesh::TriMesh read_mesh_file(const std::string& path, const Terminal& terminal) {
  remesh::MeshFile file = remesh::read_mesh(path);
  terminal.notes(file.notes);
  return std::move(file.mesh);
}

}  // namespace trivalent::apps
