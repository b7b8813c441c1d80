#include "trivalent/shell/mesh_dual.h"

#include "trivalent/dual/build_dual.h"
#include "trivalent/dual/columns.h"
#include "trivalent/dual/padded_box.h"

namespace trivalent::shell {

dual::Structure structure_of(remesh::TriMesh mesh, const dual::DualSize& size) {
  remesh::scale(mesh, dual::scale_for_size(mesh, size));
  dual::Structure structure = dual::build_dual(mesh);
  if (!structure.atoms.box.is_periodic()) {
    structure.atoms.box = dual::padded_box(structure.atoms.positions);
  }
  dual::replace_columns(structure, dual::network_columns(structure));
  return structure;
}

}  // namespace trivalent::shell
