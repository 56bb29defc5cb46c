"""An oblique ball, written by ITK, VTK and pydicom in every format that Lumen reads, and what `lumen surface` makes of it.

    python scans.py

Python is one with vtk, SimpleITK and pydicom; LUMEN_PROGRAM names the program if it is not target/release/lumen. A line
for each file: the farthest that a vertex of the surface is from the ball in mm, and the volume that its triangles enclose
(negative if they faced inwards) over the ball's. Nonzero exit status if a file is refused or its surface is 0.03 mm off.
"""
import os
import subprocess
import sys
import tempfile
from pathlib import Path

import numpy as np
import pydicom
import SimpleITK as sitk
import vtk
from pydicom.uid import ExplicitVRBigEndian, ImplicitVRLittleEndian, RLELossless
from vtk.util.numpy_support import numpy_to_vtk, vtk_to_numpy

ROOT = Path(__file__).resolve().parents[2]
PROGRAM = os.environ.get("LUMEN_PROGRAM", ROOT / "target" / "release" / "lumen")
CENTRE, RADIUS, TOLERANCE = np.array([12.0, -30.0, 145.0]), 9.0, 0.03
SIZE, SPACING = (40, 44, 36), np.array([0.7, 0.6, 0.9])


def turn(hand):
    """Directions that are no axis' own, of the right hand or (-1) the left."""
    a, b, c = 0.3, -0.5, 0.9
    x = np.array([[1, 0, 0], [0, np.cos(a), -np.sin(a)], [0, np.sin(a), np.cos(a)]])
    y = np.array([[np.cos(b), 0, np.sin(b)], [0, 1, 0], [-np.sin(b), 0, np.cos(b)]])
    z = np.array([[np.cos(c), -np.sin(c), 0], [np.sin(c), np.cos(c), 0], [0, 0, 1]])
    return x @ y @ z @ np.diag([1, 1, hand])


def ball(direction, kind):
    """The ball as an image of ITK: 300 at its wall, 100 less for each mm outwards."""
    origin = CENTRE - direction @ (SPACING * [19.3, 22.1, 17.6])
    index = np.stack(np.meshgrid(*map(np.arange, SIZE), indexing="ij"), axis=-1)
    distance = np.linalg.norm(origin + (index * SPACING) @ direction.T - CENTRE, axis=-1)
    values = np.clip(300 - 100 * (distance - RADIUS), -1000, 3000).astype(kind)
    image = sitk.GetImageFromArray(values.transpose(2, 1, 0))
    image.SetSpacing(SPACING.tolist())
    image.SetOrigin(origin.tolist())
    image.SetDirection(direction.ravel().tolist())
    return image


def check(path, what):
    out = Path(path).parent / "surface.ply"
    done = subprocess.run([PROGRAM, "surface", path, "--threshold", "300", "-o", out], capture_output=True, text=True)
    if done.returncode:
        print(f"{what}: {done.stderr.strip()}")
        return False
    reader = vtk.vtkPLYReader()
    reader.SetFileName(str(out))
    reader.Update()
    points = vtk_to_numpy(reader.GetOutput().GetPoints().GetData()).astype(float) - CENTRE
    corners = vtk_to_numpy(reader.GetOutput().GetPolys().GetConnectivityArray()).reshape(-1, 3)
    a, b, c = (points[corners[:, n]] for n in range(3))
    volume = np.einsum("ij,ij->i", a, np.cross(b, c)).sum() / 6
    off = abs(np.linalg.norm(points, axis=1) - RADIUS).max()
    ratio = volume / (4 / 3 * np.pi * RADIUS**3)
    print(f"{what}: {off:.4f} mm, {ratio:.4f}")
    return off < TOLERANCE and abs(ratio - 1) < 0.01


def of_itk(folder):
    for hand in [1, -1]:
        for kind in [np.int16, np.float32]:
            for extension in ["mha", "mhd", "nrrd", "nhdr", "nii", "nii.gz", "hdr"]:
                for packed in [False, True]:
                    path = folder / f"itk.{extension}"
                    sitk.WriteImage(ball(turn(hand), kind), str(path), packed)
                    yield path, f"ITK {extension}, {np.dtype(kind).name}, hand {hand}, packed {packed}"


def of_vtk(folder):
    image = ball(turn(1), np.int16)
    data = vtk.vtkImageData()
    data.SetDimensions(image.GetSize())
    data.SetSpacing(image.GetSpacing())
    data.SetOrigin(image.GetOrigin())
    data.SetDirectionMatrix(image.GetDirection())
    values = numpy_to_vtk(sitk.GetArrayFromImage(image).ravel(), deep=1)
    values.SetName("CT")
    data.GetPointData().SetScalars(values)
    for mode in ["Ascii", "Binary", "Appended"]:
        for compressor, name in enumerate(["none", "zlib", "LZ4", "LZMA"]):
            writer = vtk.vtkXMLImageDataWriter()
            writer.SetInputData(data)
            getattr(writer, f"SetDataModeTo{mode}")()
            writer.SetCompressorType(compressor)
            path = folder / "vtk.vti"
            writer.SetFileName(str(path))
            writer.Write()
            yield path, f"VTK vti, {mode}, {name}"


def of_dicom(folder):
    image = ball(turn(1), np.int16)
    plain = folder / "plain"
    for compressor in [None, "JPEG"]:
        series = folder / (compressor or "plain")
        series.mkdir()
        writer = sitk.ImageFileWriter()
        writer.KeepOriginalImageUIDOn()
        for k in range(SIZE[2]):
            piece = image[:, :, k : k + 1]
            tags = {"0008|0060": "CT", "0020|000e": "1.2.3.4", "0020|0013": str(k + 1), "0010|0010": "Nobody"}
            for tag, value in tags.items():
                piece.SetMetaData(tag, value)
            if compressor:
                writer.SetUseCompression(True)
                writer.SetCompressor(compressor)
            writer.SetFileName(str(series / f"{k * 7 % SIZE[2]:03}.dcm"))
            writer.Execute(piece)
        yield series, f"ITK DICOM, {compressor or 'plain'}"
    for syntax in [ImplicitVRLittleEndian, ExplicitVRBigEndian, RLELossless]:
        series = folder / syntax.name.replace(" ", "")
        series.mkdir()
        for path in sorted(plain.glob("*.dcm")):
            piece = pydicom.dcmread(path)
            if syntax == RLELossless:
                piece.compress(RLELossless)
                piece.save_as(series / path.name)
                continue
            is_big = syntax == ExplicitVRBigEndian
            if is_big:
                piece.PixelData = np.frombuffer(piece.PixelData, "<i2").astype(">i2").tobytes()
            piece.file_meta.TransferSyntaxUID = syntax
            pydicom.dcmwrite(
                series / path.name, piece, implicit_vr=not is_big, little_endian=not is_big, enforce_file_format=True
            )
        yield series, f"pydicom, {syntax.name}"


def main():
    with tempfile.TemporaryDirectory() as folder:
        kinds = [of_itk, of_vtk, of_dicom]
        results = [check(path, what) for kind in kinds for path, what in kind(Path(folder))]
    print(f"{sum(results)} of {len(results)}")
    sys.exit(not all(results))


main()
