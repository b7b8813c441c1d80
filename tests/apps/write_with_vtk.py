"""Writes a mesh with VTK's own writer, in every way that it knows and we read.

Usage: python3 write_with_vtk.py MESH.ply FOLDER
"""
import itertools
import os
import sys

from vtkmodules.vtkFiltersCore import vtkAppendFilter, vtkStripper
from vtkmodules.vtkIOLegacy import vtkPolyDataWriter, vtkUnstructuredGridWriter
from vtkmodules.vtkIOPLY import vtkPLYReader
from vtkmodules.vtkIOXML import vtkXMLPolyDataWriter, vtkXMLUnstructuredGridWriter

reader = vtkPLYReader()
reader.SetFileName(sys.argv[1])
reader.Update()
stripper = vtkStripper()
stripper.SetInputData(reader.GetOutput())
stripper.Update()

MODES = {'ascii': lambda w: w.SetDataModeToAscii(), 'binary': lambda w: w.SetDataModeToBinary(),
         'raw': lambda w: (w.SetDataModeToAppended(), w.EncodeAppendedDataOff()),
         'base64': lambda w: (w.SetDataModeToAppended(), w.EncodeAppendedDataOn())}
COMPRESSORS = {'plain': lambda w: w.SetCompressorTypeToNone(), 'zlib': lambda w: w.SetCompressorTypeToZLib(),
               'lz4': lambda w: w.SetCompressorTypeToLZ4()}
ORDERS = {'little': lambda w: w.SetByteOrderToLittleEndian(), 'big': lambda w: w.SetByteOrderToBigEndian()}
HEADERS = {'32': lambda w: w.SetHeaderTypeToUInt32(), '64': lambda w: w.SetHeaderTypeToUInt64()}

for names in itertools.product(MODES, COMPRESSORS, ORDERS, HEADERS, ('polygons', 'strips')):
    writer = vtkXMLPolyDataWriter()
    for ways, name in zip((MODES, COMPRESSORS, ORDERS, HEADERS), names):
        ways[name](writer)
    writer.SetBlockSize(4096)  # so that there are several
    writer.SetInputData(stripper.GetOutput() if names[-1] == 'strips' else reader.GetOutput())
    writer.SetFileName(os.path.join(sys.argv[2], '-'.join(names) + '.vtp'))
    assert writer.Write() == 1

grid = vtkAppendFilter()
grid.SetInputData(reader.GetOutput())
grid.Update()


def write(writer, data, name):
    writer.SetInputData(data)
    writer.SetFileName(os.path.join(sys.argv[2], name))
    assert writer.Write() == 1


for mode, version in itertools.product(('ASCII', 'Binary'), (42, 51)):
    for kind, data in (('polygons', reader.GetOutput()), ('strips', stripper.GetOutput()), ('grid', grid.GetOutput())):
        legacy = vtkUnstructuredGridWriter() if kind == 'grid' else vtkPolyDataWriter()
        getattr(legacy, f'SetFileTypeTo{mode}')()
        legacy.SetFileVersion(version)
        write(legacy, data, f'{mode}-{version}-{kind}.vtk')
for mode in MODES:
    writer = vtkXMLUnstructuredGridWriter()
    MODES[mode](writer)
    write(writer, grid.GetOutput(), f'{mode}.vtu')
