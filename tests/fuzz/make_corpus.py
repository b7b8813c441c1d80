#!/usr/bin/env python3
"""Writes the seeds of every fuzz target into a folder each: small shapes and legal oddities.

usage: make_corpus.py PROGRAM FOLDER
"""
import os
import subprocess
import sys

POINTS = '0 0 0\n1 0 0\n0 1 0\n'
PLY = 'element vertex 3\nproperty {0} x\nproperty {0} y\nproperty {0} z\nelement face 1\nproperty list {1} {2} vertex_indices\nend_header\n'
SEEDS = {
    'off': ['OFF # a\n# b\n\n3 1 0\n' + POINTS + '3 0 1 2\n',
            ('3 1 0\n' + POINTS + '3 0 1 2\n').replace('\n', '\r\n'),
            'COFF\n4 1 0\n0 0 0 1 2 3 4\n1 0 0 1 2 3 4\n1 1 0 1 2 3 4\n0 1 0 1 2 3 4\n4 0 1 2 3 0.1 0.2\n',
            'STNOFF 3 1 0 0 0 0 1 0 0 0 1 0 3 0 1 2',
            'OFF\n4 1 0\n' + POINTS + '1 1 0\n6 0 1 3 2 1 3\n',  # a finding: a corner that comes again
            'OFF5 2 0\n0 0 0\n.5 0 .2\n1 0 0\n.5 2 0\n.5 -2 0\n4 0 1 2 3\n4 0 4 2 1\n',
            'OFF BINARY\n\0\0\0\3\0\0\0\1\0\0\0\3' + 6 * '\0\0\0\1' + '\0\0\1\0' + 2 * '\0\0\0\1'
            + '\0\0\0\3\0\0\0\0\0\0\0\1\0\0\0\2\0\0\0\0'],
    'obj': ['v 0 0 0\nv 1 0 0\nv 0 1 0\nf -3 -2 -1\n',
            'mtllib m\nv 0 0 0 1\nv 1 0 0\nv 0 1 0\nvt 0 0\nvn 0 0 1\nf 1/1/1 2//1 \\\n 3/1\nl 1 2\n',
            'v 0 0 0\nv 2 0 0\nv 2 2 0\nv 1 .5 0\nv 0 2 0\nf 1 2 3 4 5\n'],
    'ply': ['ply\nformat ascii 1.0\ncomment a\n' + PLY.format('double', 'uchar', 'int') + POINTS + '3 0 1 2\n',
            'ply\nformat binary_big_endian 1.0\n' + PLY.format('char', 'char', 'char') + '123456789\3\0\1\2',
            'ply\nformat binary_little_endian 1.0\n' + PLY.format('short', 'uchar', 'ushort')
            + '\0\0\0\0\0\0\1\0\0\0\0\0\0\0\1\0\0\0\3\0\0\1\0\2\0',
            'ply\nformat ascii 1.0\nelement vertex 3\nproperty int x\nproperty int y\nproperty int z\nelement tristrips 1\n'
            'property list int int vertex_indices\nend_header\n' + POINTS + '5 0 1 2 -1 0\n',
            ('ply\nformat binary_big_endian 1.0\n' + PLY.format('char', 'char', 'char')).replace('\n', '\n\r') + '123456789\3\0\1\2'],
    'stl': ['solid a\nfacet normal 0 0 1\nouter loop\nvertex 0 0 0\nvertex 1 0 0\nvertex 0 1 0\nendloop\nendfacet\nendsolid a\n',
            'solid a\nfacet normal -1.#IND 0 1 outer loop vertex 0 0 0 vertex 1 0 0 vertex 0 1 0 endloop endfacet facet normal 0 0 1 '
            'outer loop vertex 1e-9 0 0 vertex 0 1 0 vertex -1 0 0 endloop endfacet end solid a\n',
            'streamed'.ljust(80) + '\0\0\0\0' + 12 * '\0' + ''.join(36 * 'a') + '\0\0'],
    'vtk': ['# vtk DataFile Version 3.0\nt\nASCII\nDATASET POLYDATA\nPOINTS 3 float\n' + POINTS
            + 'LINES 1 3\n2 0 1\nPOLYGONS 1 4\n3 0 1 2\nPOINT_DATA 3\n',
            '# vtk DataFile Version 5.1\nt\nASCII\nDATASET UNSTRUCTURED_GRID\nFIELD f 1\na 1 1 int\n1\nMETADATA\nINFORMATION 0\n\n'
            'POINTS 3 double\n' + POINTS + 'CELLS 2 3\nOFFSETS vtktypeint64\n0 3\nCONNECTIVITY vtktypeint64\n0 1 2\nCELL_TYPES 1\n5\n',
            '# vtk DataFile Version 2.0\nt\nBINARY\nDATASET POLYDATA\nPOINTS 3 char\n123456789\nTRIANGLE_STRIPS 1 4\n'
            '\0\0\0\3\0\0\0\0\0\0\0\1\0\0\0\2\n'],
    'vtu': ['<VTKFile type="UnstructuredGrid" compressor="vtkLZ4DataCompressor" byte_order="LittleEndian"><UnstructuredGrid>'
            '<Piece NumberOfPoints="4" NumberOfCells="2"><Points><DataArray type="UInt8" format="appended" offset="0"/></Points><Cells>'
            '<DataArray Name="connectivity">0 1 2 0 1 3 2</DataArray><DataArray Name="offsets">3 7</DataArray>'
            '<DataArray Name="types">5 8</DataArray></Cells></Piece></UnstructuredGrid><AppendedData encoding="raw">'
            '_\1\0\0\0\14\0\0\0\0\0\0\0\15\0\0\0\300abcdefghijkl</AppendedData></VTKFile>'],
    'vtp': ['<VTKFile type="PolyData"><PolyData><Piece NumberOfPoints="3" NumberOfPolys="1"><Points><DataArray type="Float32">'
            '0 0 0 1 0 0 0 1 0</DataArray></Points><Polys><DataArray Name="connectivity">0 1 2</DataArray>'
            '<DataArray Name="offsets">3</DataArray></Polys></Piece></PolyData></VTKFile>',
            '<VTKFile type="PolyData" compressor="vtkZLibDataCompressor"><PolyData><Piece NumberOfPoints="1" NumberOfStrips="1"><Points>'
            '<DataArray type="UInt8" format="binary">AQAAAAMAAAADAAAACwAAAA==eJxjZGIGAAANAAc=</DataArray></Points><Strips><DataArray '
            'type="Int64" Name="connectivity" format="appended" offset="0"/><DataArray Name="offsets" format="appended" offset="8"/>'
            '</Strips></Piece></PolyData><AppendedData encoding="raw">_\0\0\0\0\4\0\0\0\1\0\0\0</AppendedData></VTKFile>'],
    'xyz': ['2\n0 0 0 0 0 1\n1 0 0 0 0 1 # last\n'],
    'atoms': ['2\nenergy=1 pbc="F F F"\nC 0 0 0\nH 0 0 1.1\n',
              '2\nlattice = [[2, 0, 0], [0, 3d0, 0], [0, 0, 4]] pbc=[T, true, F] "key"={1 2} d="_JSON {\\"a\\": 1}" Properties='
              'Z:I:1:pos:R:3:bonded_atoms:I:1:bonded_images:I:3\n6 0 0 0 1 0 0 0\n1 0 0 1 0 0 0 0\n',
              'c\n\n2 atoms\n1 bonds\n1 atom types\n2 0 0 avec\n0 2 0 bvec\n0 0 2 cvec\n1 1 1 abc origin\n\nAtom Type Labels\n\n1 C\n'
              '\nMasses\n\nC 12.011 # C\n\nAtoms # full\n\n1 1 C 0 0 0 0 1 0 0\n3 1 1 0 1 1 1 0 0 0\n\nBonds\n\n1 C-C 1 3\n',
              't\n2.0\n1 0 0\n0 1 0\n0 0 1\nC H\n1 1\nSelective\nDirect\n0 0 .5 T T F\n.5 0 0 F F F\n',
                '2 F\nC H\n1 1 0 0 0\n2 2 .5 .5 .5\n0 0 0\n2 0 0\n0 2 0\n0 0 2\n',
                't\n1\n    1CNT     C1    1   0.100   0.200   0.300\n   1.0 1.0 2.0 0 0 0.1 0 0 0\n',
                'CRYST1    9.000    9.000    9.000  90.00  90.00  90.00 P 1           1\nMODEL 1\nHETATM    1  C   UNL A   1       '
                '1.000   2.000   3.000  1.00  0.00           C\nHETATMA0000  H   UNL A   1       1.000   2.000   4.000\n'
                'CONECT    1A0000\nENDMDL\n',
                '@<TRIPOS>MOLECULE\nm\n2 1\nSMALL\nNO_CHARGES\n@<TRIPOS>ATOM\n1 C1 0 0 0 C.ar\n2 H 0 0 1 H\n@<TRIPOS>BOND\n1 1 2 1\n'
                '@<TRIPOS>CRYSIN\n9 9 9 90 90 120 1 1\n',
                '&system\nibrav=0, celldm(1) = 2.0, nat=1\n/\nCELL_PARAMETERS {alat}\n5 0 0\n0 5 0\n0 0 5\nATOMIC_POSITIONS crystal\n'
                'C1 0.5 0 0 ! a\n',
                '&CELL\nABC [bohr] 9 9 9\nALPHA_BETA_GAMMA 90 90 120\nPERIODIC XY\n&END CELL\n&COORD\nSCALED\nC .5 0 0\n&END COORD\n',
                "data_a\n_cell_length_a 4\n_cell_length_b 4\n_cell_length_c 4\n_cell_angle_alpha 90\n_cell_angle_beta 90\n"
                "_cell_angle_gamma 90\n_space_group_name_H-M_alt 'P -1'\nloop_\n_atom_site_label\n_atom_site_fract_x\n_atom_site_fract_y\n"
                "_atom_site_fract_z\nC1 0.1 .2(1) 0\n"],
    'options': ['sphere:radius=2\n--method\npaper\n--rings\n1\n--sigma=0.4\n', '--method\ncrystal\n-\n--effort=quick\n--seed=3\n--json\n',
                'a.off\n--method\npaper\n--restriction\nleast-squares\n--iterations\n3\n--feature-angle\n40\n--quiet\n'],
    'repair': ['\1\0\2\6\0\2\7\2\6\0', '\0' + ''.join(chr(k) for k in range(54))],
}
SHAPES = ['sphere', 'torus', 'open-tube']


def main(program, root):
    for target, texts in SEEDS.items():
        folder = os.path.join(root, target)
        os.makedirs(folder, exist_ok=True)
        for k, text in enumerate(texts):
            with open(os.path.join(folder, f'seed-{k}'), 'wb') as file:
                file.write(text.encode('latin-1'))
    for shape in SHAPES:
        paths = [os.path.join(root, kind, f'{shape}.{kind}') for kind in ('off', 'obj', 'ply', 'stl')]
        for path in paths:
            subprocess.run([program, 'shape', shape, path, '--edge', '0.9'], check=True, stdout=subprocess.DEVNULL)
        for kind in ('extxyz', 'data'):
            out = os.path.join(root, 'atoms', f'{shape}.{kind}')
            subprocess.run([program, 'dual', paths[0], out, '--atom-style', 'molecular'], check=True,
                           stdout=subprocess.DEVNULL)


if __name__ == '__main__':
    main(*sys.argv[1:])
