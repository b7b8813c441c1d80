"""Reads an energy map with VTK's own reader and compares it with what `trivalent energy --json` said.

Usage: python3 read_with_vtk.py MAP.vtp RESULT.json
"""
import json
import sys

from vtkmodules.util.numpy_support import vtk_to_numpy
from vtkmodules.vtkIOXML import vtkXMLPolyDataReader

result = json.load(open(sys.argv[2]))
reader = vtkXMLPolyDataReader()
reader.SetFileName(sys.argv[1])
reader.Update()
assert reader.GetErrorCode() == 0
data = reader.GetOutput()
points = {data.GetPointData().GetArrayName(i): vtk_to_numpy(data.GetPointData().GetArray(i))
          for i in range(data.GetPointData().GetNumberOfArrays())}
cells = {data.GetCellData().GetArrayName(i): vtk_to_numpy(data.GetCellData().GetArray(i))
         for i in range(data.GetCellData().GetNumberOfArrays())}

n_atoms = result["atoms"]
n_rings = sum(result["ring_sizes"].values())
assert data.GetNumberOfPoints() == data.GetNumberOfVerts() == n_atoms
assert data.GetNumberOfPolys() == n_rings
assert data.GetPointData().GetScalars().GetName() == "energy"
assert abs(points["energy"].sum() - result["energy"]) < 1e-9 * n_atoms
assert list(points["id"]) == list(range(1, n_atoms + 1))
assert set(points) == {"id", "atomic_number", "energy", "excess_energy", "ring_size", "coordination",
                       "bond_strain", "pyramidalization"}
for worst in result["worst"]:
    assert abs(points["energy"][worst["id"] - 1] - worst["energy"]) < 1e-12
    position = data.GetPoint(worst["id"] - 1)
    assert max(abs(a - b) for a, b in zip(position, worst["position"])) < 1e-12

# Cells come as vertices, lines, polygons.
n_bonds = data.GetNumberOfLines()
assert n_bonds * 2 == sum(int(n) * count for n, count in result["coordinations"].items())
lengths = cells["bond_length"][n_atoms:n_atoms + n_bonds]
assert (lengths > 0.5).all() and (lengths < 2.5).all()
sizes = cells["ring_size"][n_atoms + n_bonds:]
for index, size in enumerate(sizes):
    assert data.GetCell(n_atoms + n_bonds + index).GetNumberOfPoints() == size
assert {str(size): int((sizes == size).sum()) for size in set(sizes)} == result["ring_sizes"]
print("VTK agrees")
