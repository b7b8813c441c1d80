#include "trivalent/shell/build_files.h"

#include <algorithm>

#include "trivalent/formats/lammps_package.h"
#include "trivalent/formats/xyz.h"
#include "trivalent/remesh/mesh_io.h"
#include "trivalent/view/energy_ply.h"
#include "trivalent/view/shell_page.h"
#include "trivalent/view/vtp.h"

namespace trivalent::shell {

void write_build(const std::filesystem::path& folder, const BuildResult& result,
                 const BuildFileOptions& options) {
  remesh::write_mesh(result.shell.surface.mesh, folder / "surface.off");
  const dual::Structure structure = result.structure();
  dual::write_xyz(folder / "shell.extxyz", structure, options.digits);
  dual::write_lammps_package(
      folder, structure, result.energy.energy,
      {.data = {.style = options.atom_style, .digits = options.digits},
       .potential = find_potential(result.potential).lammps.value_or(dual::LammpsPotential::rebo)});
  for (const std::string& name : options.formats) {
    const dual::StructureFormat& format = dual::structure_format(name);
    dual::write_structure(folder / ("shell" + format.extensions.front()), structure,
                          {.digits = options.digits, .atom_style = options.atom_style});
  }
  dual::write_energy_ply(folder / "energy.ply", result.shell.structure, result.energy.energies,
                         {.scale = result.after.find("energy")->scale});
  dual::write_vtp(folder / "energy.vtp", result.after);
}

void write_build_page(const std::filesystem::path& path, BuildResult&& result,
                      const BuildPageOptions& options) {
  dual::ShellPage page = {.title = options.title,
                          .program = options.program,
                          .notes = result.notes,
                          .parameters = options.parameters,
                          .results = result.rows()};
  // A dual much larger than the shell would only weigh the page down.
  constexpr std::size_t always_shown = 250000;
  const std::size_t n_atoms = result.after.structure.atoms.size();
  if (result.before && result.before->structure.atoms.size() <= std::max(always_shown, n_atoms)) {
    page.states.push_back(std::move(*result.before));
  } else if (result.before) {
    page.notes.push_back("the dual of the input has " +
                         std::to_string(result.before->structure.atoms.size()) +
                         " atoms, too many to be shown beside the shell");
  }
  // Three states of a large shell would make the page slow to open.
  constexpr std::size_t max_unrelaxed = 100000;
  if (result.unrelaxed && n_atoms <= max_unrelaxed) {
    page.states.push_back(std::move(*result.unrelaxed));
  } else if (result.unrelaxed) {
    page.notes.push_back("the shell is too large for its page to show it before relaxation too");
  }
  page.states.push_back(std::move(result.after));
  page.surface = std::move(result.original);
  dual::write_shell_page(path, page, options.viewer);
}

}  // namespace trivalent::shell
