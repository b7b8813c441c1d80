#pragma once

#include <pybind11/pybind11.h>

#include <string>
#include <variant>

#include "trivalent/remesh/polygon_soup.h"
#include "trivalent/shell/surface_source.h"

namespace trivalent::python {

/// A path or the name of a built-in shape, points and triangles, or a periodic surface.
using SurfaceSource = std::variant<std::string, remesh::TriangleSoup, shell::Surface>;

/// Takes a str, a Surface, or a tuple of points (n, 3) and a list of arrays of faces (m, k).
///
/// @throws InvalidArray if shapes or types of arrays differ from that, a point is not finite, or an
///   index is out of range.
[[nodiscard]] SurfaceSource surface_source(const pybind11::object& source);

/// The soup of a source; needs no GIL.
///
/// @throws remesh::InvalidOption if it is periodic.
[[nodiscard]] remesh::TriangleSoup soup_of(const SurfaceSource& source);

/// A sound surface for a shell; needs no GIL.
[[nodiscard]] shell::Surface make_surface(const SurfaceSource& source,
                                          const dual::ShellOptions& shell,
                                          const remesh::RepairOptions& repair,
                                          const shell::CellOptions& cell = {});

}  // namespace trivalent::python
