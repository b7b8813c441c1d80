#include "surface.h"

#include <memory>

#include "arrays.h"
#include "errors.h"
#include "json.h"
#include "module.h"
#include "options.h"
#include "trivalent/dual/error.h"
#include "trivalent/remesh/error.h"
#include "trivalent/remesh/mesh_io.h"
#include "trivalent/remesh/tube_ends.h"
#include "trivalent/shell/inspect.h"
#include "trivalent/shell/mesh_dual.h"
#include "trivalent/shell/remesh_surface.h"
#include "watch.h"

namespace trivalent::python {
namespace {

using shell::Surface;

/// As meshes of OpenMesh, and the sizes that pages and files can hold.
constexpr std::int64_t max_rows = 1'000'000'000;

void append_faces(const py::handle& faces, remesh::PolygonSoup& soup) {
  const IndexRows rows = index_rows(faces, "faces", static_cast<std::int64_t>(soup.points.size()));
  if (rows.size() == 0) return;
  if (rows.shape(1) < 3 || rows.size() > max_rows) {
    throw InvalidArray(dual::concat("faces: the shape must be (n, 3) or (n, 4), not (",
                                    rows.shape(0), ", ", rows.shape(1), ")"));
  }
  const auto width = static_cast<std::size_t>(rows.shape(1));
  for (py::ssize_t i = 0; i < rows.size(); ++i) {
    soup.corners.push_back(static_cast<int>(rows.data()[i]));
  }
  for (py::ssize_t i = 0; i < rows.shape(0); ++i) {
    soup.ends.push_back((soup.ends.empty() ? 0 : soup.ends.back()) + width);
  }
}

remesh::TriangleSoup soup_of_arrays(const py::tuple& arrays) {
  remesh::PolygonSoup soup;
  soup.points = vectors(arrays[0], "vertices");
  for (const py::handle faces : arrays[1]) append_faces(faces, soup);
  const py::gil_scoped_release released;
  return remesh::triangulate(soup);
}

remesh::TriangleSoup soup_of_mesh(const Surface& surface) {
  const auto* points = surface.mesh.points();
  return {.points = {points, points + surface.mesh.n_vertices()},
          .triangles = remesh::triangles_of(surface.mesh),
          .notes = surface.notes};
}

py::array faces_of(const Surface& surface) {
  const auto triangles = remesh::triangles_of(surface.mesh);
  py::array_t<int> faces({static_cast<py::ssize_t>(triangles.size()), py::ssize_t{3}});
  if (!triangles.empty()) {
    std::copy_n(triangles[0].data(), 3 * triangles.size(), faces.mutable_data());
  }
  return faces;
}

std::shared_ptr<Surface> repair(const py::object& object, const py::dict& values) {
  const Options options(values);
  const dual::ShellOptions shell = shell_options(options);
  const remesh::RepairOptions repair = repair_options(options);
  const SurfaceSource source = surface_source(object);
  const py::gil_scoped_release released;
  return std::make_shared<Surface>(make_surface(source, shell, repair));
}

std::shared_ptr<Surface> make_shape(const std::string& text, double edge_length) {
  const shell::ShapeCall call = shell::parse_shape(text);
  const py::gil_scoped_release released;
  return std::make_shared<Surface>(
      Surface{.mesh = remesh::make_shape(call.name, call.arguments, edge_length)});
}

py::tuple remesh_surface(const py::object& object, double edge_length, const py::dict& values,
                         Watch& watch) {
  const Options options(values);
  remesh::RemeshMethod method = remesh_method(options);
  watch.observe(method);
  const remesh::RepairOptions repair = repair_options(options);
  const SurfaceSource source = surface_source(object);
  std::shared_ptr<Surface> surface;
  shell::Json json;
  {
    const py::gil_scoped_release released;
    shell::RemeshedSurface result = shell::remesh_surface(
        soup_of(source), {.target_edge_length = edge_length, .method = method, .repair = repair});
    json = result.json();
    surface = std::make_shared<Surface>(Surface{.mesh = std::move(result.net.mesh),
                                                .notes = std::move(result.notes),
                                                .wrap_offset = result.wrap_offset});
  }
  return py::make_tuple(std::move(surface), to_python(json));
}

py::object inspect(const py::object& object, const py::dict& values) {
  const Options options(values);
  const shell::InspectOptions inspecting = {.shell = shell_options(options),
                                            .repair = repair_options(options)};
  const SurfaceSource source = surface_source(object);
  shell::Json json;
  {
    const py::gil_scoped_release released;
    const auto* path = std::get_if<std::string>(&source);
    json = (path != nullptr ? shell::inspect(*path, inspecting)
                            : shell::inspect(soup_of(source), inspecting))
               .json();
  }
  return to_python(json);
}

std::shared_ptr<dual::Structure> dual_of(const Surface& surface, const py::dict& values) {
  const dual::DualSize size = dual_size(Options(values)).value_or(dual::MeanBond());
  const py::gil_scoped_release released;
  return std::make_shared<dual::Structure>(shell::structure_of(surface.mesh, size));
}

}  // namespace

SurfaceSource surface_source(const py::object& source) {
  if (py::isinstance<py::str>(source)) return source.cast<std::string>();
  if (py::isinstance<Surface>(source)) {
    const auto& surface = source.cast<const Surface&>();
    if (surface.mesh.lattice.is_periodic()) return surface;
    if (!remesh::wanted_tube_ends(surface.mesh).empty()) {  // which triangles do not hold
      throw remesh::InvalidOption(
          "a junction with chiral indices is taken by its name, as 'y-junction:open=1,n=10,m=10'");
    }
    return soup_of_mesh(surface);
  }
  return soup_of_arrays(source.cast<py::tuple>());
}

remesh::TriangleSoup soup_of(const SurfaceSource& source) {
  if (std::holds_alternative<Surface>(source)) {
    throw remesh::InvalidOption("a periodic surface is taken by build, plan and dual only");
  }
  const auto* path = std::get_if<std::string>(&source);
  return path != nullptr ? shell::read_soup(*path) : std::get<remesh::TriangleSoup>(source);
}

shell::Surface make_surface(const SurfaceSource& source, const dual::ShellOptions& shell,
                            const remesh::RepairOptions& repair, const shell::CellOptions& cell) {
  if (const auto* surface = std::get_if<Surface>(&source)) {
    if (cell.lattice) throw remesh::InvalidOption("the surface has a cell of its own");
    return shell::in_cell(*surface, cell);
  }
  const auto* path = std::get_if<std::string>(&source);
  if (path != nullptr) return shell::read_surface(*path, shell, repair, cell);
  const auto& soup = std::get<remesh::TriangleSoup>(source);
  return shell::in_cell(shell::repair_surface(soup, shell, repair), cell);
}

void add_surface(py::module_& module) {
  py::class_<Surface, std::shared_ptr<Surface>>(module, "Surface", "A sound triangle mesh")
      .def_property_readonly(
          "vertices",
          [](const py::object& self) {
            const auto& mesh = self.cast<const Surface&>().mesh;
            return view(mesh.n_vertices() == 0 ? nullptr : mesh.points()[0].data(),
                        {static_cast<py::ssize_t>(mesh.n_vertices()), 3},
                        {sizeof(Eigen::Vector3d), sizeof(double)}, self);
          },
          "Positions, shape (n, 3)")
      .def_property_readonly("faces", &faces_of, "Corners of each triangle, shape (m, 3)")
      .def_property_readonly(
          "cell",
          [](const Surface& surface) {
            const Eigen::Matrix3d& cell = surface.mesh.lattice.cell();
            py::array_t<double> rows({3, 3});
            for (py::ssize_t i = 0; i < 3; ++i) {
              for (py::ssize_t k = 0; k < 3; ++k) rows.mutable_at(i, k) = cell(k, i);
            }
            return rows;
          },
          "Cell vectors, shape (3, 3), one per row")
      .def_property_readonly(
          "pbc", [](const Surface& surface) { return surface.mesh.lattice.periodic(); },
          "Whether it is periodic along each cell vector")
      .def_readonly("notes", &Surface::notes, "What was changed on the way in")
      .def_readonly("wrap_offset", &Surface::wrap_offset, "From the input to its wrap")
      .def(
          "write",
          [](const Surface& surface, const std::filesystem::path& path) {
            const py::gil_scoped_release released;
            remesh::write_mesh(surface.mesh, path);
          },
          py::arg("path"), "Writes OFF, OBJ, PLY or STL");
  module.def("repair", &repair, py::arg("source"), py::arg("options"));
  module.def("shape", &make_shape, py::arg("name"), py::arg("edge"));
  module.def("remesh", &remesh_surface, py::arg("source"), py::arg("edge"), py::arg("options"),
             py::arg("watch"));
  module.def("inspect", &inspect, py::arg("source"), py::arg("options"));
  module.def("dual", &dual_of, py::arg("surface"), py::arg("options"));
}

}  // namespace trivalent::python
