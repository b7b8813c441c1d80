"""Writes a mesh with VTK's own writer, in every way that it knows and we read.

Usage: python3 write_with_vtk.py MESH.ply FOLDER
"""
import itertools
import os
import sys

from vtkmodules.vtkFiltersCore import vtkStripper
from vtkmodules.vtkIOPLY import vtkPLYReader
from vtkmodules.vtkIOXML import vtkXMLPolyDataWriter

reader = vtkPLYReader()
reader.SetFileName(sys.argv[1])
reader.Update()
stripper = vtkStripper()
stripper.SetInputData(reader.GetOutput())
stripper.Update()

MODES = {'ascii': lambda w: w.SetDataModeToAscii(), 'binary': lambda w: w.SetDataModeToBinary(),
         'raw': lambda w: (w.SetDataModeToAppended(), w.EncodeAppendedDataOff()),
         'base64': lambda w: (w.SetDataModeToAppended(), w.EncodeAppendedDataOn())}
COMPRESSORS = {'plain': lambda w: w.SetCompressorTypeToNone(), 'zlib': lambda w: w.SetCompressorTypeToZLib()}
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
