"""Sample files of other packages, opened by Lumen and by a peer: alike, refused, or not alike.

    python samples.py [FOLDER...]

Python is one with samples.txt; LUMEN_PROGRAM names the program if it is not target/release/lumen. The packages' own files
come from PyPI into target/samples; each FOLDER, such as a checkout of pynrrd, trimesh, assimp or Khronos' glTF-Sample-Models,
is one package more. The peers are pydicom, GDCM (in SimpleITK) and nibabel, pynrrd, VTK, and trimesh for STL, PLY, OBJ and
glTF. A line for each file that is not alike, then the counts of each package and the sentences of what is refused. A volume is
alike if size, place, range of values and the triangles of the surfaces at a quarter, a half and three quarters of the range
are; a surface if triangles, bounds and area are. Of a picture in DICOM two slices are made, 1 mm apart, in its own encoding;
its values are pydicom's, or GDCM's where pydicom fails, and a table counts where GDCM has the same size, least, largest value
and sum. glTF is given its data. "Nothing for Lumen" are lines, points, colours, plans and the like, refused; "not compared"
opens, and the peer has no volume to compare. Nonzero exit status if a file is not alike, or Lumen fails or hangs.
"""
import base64
import collections
import json
import os
import re
import subprocess
import sys
import tarfile
import tempfile
import warnings
import zipfile
from pathlib import Path

import meshoptimizer
import nibabel
import nrrd
import numpy as np
import pydicom
import SimpleITK as sitk
import trimesh
import vtk
from pydicom.pixels import apply_modality_lut
from vtk.util.numpy_support import numpy_to_vtk, vtk_to_numpy

ROOT = Path(__file__).resolve().parents[2]
PROGRAM = os.environ.get("LUMEN_PROGRAM", ROOT / "target" / "release" / "lumen")
PACKAGES = ["pydicom", "pydicom-data", "nibabel", "meshio", "pyvista"]
OF_TRIMESH = (".stl", ".ply", ".obj", ".glb", ".gltf")
FLIP = np.diag([-1.0, -1, 1, 1])
OF_VTK = {".vtp": vtk.vtkXMLPolyDataReader, ".vtu": vtk.vtkXMLUnstructuredGridReader, ".vti": vtk.vtkXMLImageDataReader,
          ".vtk": vtk.vtkGenericDataObjectReader}


class Alone(Exception):
    """The peer opens the file, and finds nothing in it that Lumen is for, or nothing to compare."""


def lumen(*arguments):
    """What Lumen prints, and the sentence with which it refuses."""
    try:
        done = subprocess.run([PROGRAM, *map(str, arguments)], capture_output=True, text=True, timeout=120)
    except subprocess.TimeoutExpired:
        return None, "HANGS"
    if done.returncode not in (0, 1, 2):
        return None, f"FAILS {done.returncode}: {done.stderr.strip()[-300:]}"
    sentence = next((line for line in reversed(done.stderr.splitlines()) if line.startswith("lumen: ")), done.stderr)
    return (done.stdout, None) if done.returncode == 0 else (None, re.sub(r"^lumen: /?\S+: ", "", sentence))


def near(a, b, tolerance):
    a, b = np.asarray(a, float), np.asarray(b, float)
    return a.shape == b.shape and bool((abs(a - b) <= tolerance).all())


# Volumes: numbers by column, row and slice, and the matrix from indices to mm.


def of_nibabel(path):
    image = nibabel.load(path)
    values = np.asarray(image.dataobj)
    if not isinstance(image, (nibabel.Nifti1Image, nibabel.Nifti1Pair, nibabel.AnalyzeImage)):
        raise Alone
    return values.reshape(values.shape + (1,) * (3 - values.ndim)), FLIP @ image.affine


def of_pynrrd(path):
    values, header = nrrd.read(str(path))
    matrix = np.eye(4)
    directions = header.get("space directions")
    if directions is not None:
        matrix[:3, :3] = np.asarray([row for row in directions if row is not None and not np.isnan(row).any()]).T
    elif "spacings" in header:
        np.fill_diagonal(matrix[:3, :3], header["spacings"][:3])
    matrix[:3, 3] = header.get("space origin", [0, 0, 0])
    space = str(header.get("space", "")).lower()
    turn = {"right": [-1, -1, 1], "ras": [-1, -1, 1], "left-anterior": [1, -1, 1], "las": [1, -1, 1]}
    sign = next((np.diag(signs + [1.0]) for words, signs in turn.items() if space.startswith(words)), np.eye(4))
    return (values.reshape(values.shape[:3]) if set(values.shape[3:]) == {1} else values), sign @ matrix


def of_vtk(image):
    scalars = image.GetPointData().GetScalars()
    on_cells = scalars is None
    scalars = image.GetCellData().GetScalars() if on_cells else scalars
    size = np.array(image.GetDimensions()) - on_cells
    if scalars is None or scalars.GetNumberOfComponents() != 1:
        raise Alone
    matrix = np.array([image.GetIndexToPhysicalMatrix().GetElement(i, j) for i in range(4) for j in range(4)]).reshape(4, 4)
    first = np.array(image.GetExtent()[::2]) + 0.5 * on_cells
    matrix[:3, 3] += matrix[:3, :3] @ first
    return vtk_to_numpy(scalars).reshape(size[::-1]).transpose(2, 1, 0), matrix


def of_pydicom(path, folder):
    """The volume of a file, and the files that hold it: those of two slices if it is a picture."""
    data = pydicom.dcmread(path, force=True)
    if "PixelData" not in data or data.get("SamplesPerPixel", 1) != 1 or "SegmentationType" in data \
            or not data.get("PhotometricInterpretation", "").startswith("MONOCHROME"):
        raise Alone
    if "TransferSyntaxUID" not in data.file_meta:
        data.file_meta.TransferSyntaxUID = (
            pydicom.uid.ImplicitVRLittleEndian if data.original_encoding[0] else pydicom.uid.ExplicitVRLittleEndian)
    frames = int(data.get("NumberOfFrames", 1) or 1)
    if "PerFrameFunctionalGroupsSequence" in data:
        places = {tuple(frame.PlanePositionSequence[0].ImagePositionPatient)
                  for frame in data.PerFrameFunctionalGroupsSequence if "PlanePositionSequence" in frame}
        if 0 < len(places) < frames:
            # Several volumes, which GDCM stacks.
            raise Alone
        return *of_gdcm([path]), [path]
    try:
        values = apply_modality_lut(data.pixel_array, data).astype(float)
    except Exception:  # noqa: BLE001: whatever a peer may raise, it does not open the file
        values = None
    data.ImageOrientationPatient = [1, 0, 0, 0, 1, 0]
    data.PixelSpacing = [1, 1]
    data.SliceThickness = data.SpacingBetweenSlices = 1
    names = []
    for k in range(1 if frames > 1 else 2):
        data.ImagePositionPatient, data.InstanceNumber = [0, 0, k], k + 1
        data.SOPInstanceUID = data.file_meta.MediaStorageSOPInstanceUID = f"1.2.3.{k + 1}"
        names.append(folder / f"{k}.dcm")
        with warnings.catch_warnings():
            warnings.simplefilter("ignore")
            data.save_as(names[-1])
    if values is not None:
        values = (values if frames > 1 else np.stack([values, values])).transpose(2, 1, 0)
    try:
        other = of_gdcm(names)[0]
    except RuntimeError:
        GDCM["pydicom alone" if values is not None else "neither"] += 1
        if values is None:
            raise
        return values, np.eye(4), names
    if values is None:
        GDCM["GDCM alone"] += 1
        return other, np.eye(4), names
    sums = [[of.shape, of.min(), of.max(), of.sum()] for of in (values, other)]
    is_alike = values.shape == other.shape
    if is_alike and np.allclose(sums[0][1:], sums[1][1:], rtol=1e-9):
        GDCM["both alike"] += 1
    elif is_alike and data.PhotometricInterpretation == "MONOCHROME1" and np.ptp(values + other) < 1e-6 * sums[0][2]:
        GDCM["both alike but that GDCM turns MONOCHROME1 over"] += 1
    else:
        GDCM["both, not alike"] += 1
        print(f"{path.name}: pydicom {sums[0]}, GDCM {sums[1]}", flush=True)
    return values, np.eye(4), names


#: How many pictures in DICOM pydicom and GDCM open.
GDCM = collections.Counter()


def of_gdcm(names):
    image = sitk.ReadImage([str(name) for name in names] if len(names) > 1 else str(names[0]), imageIO="GDCMImageIO")
    if image.GetNumberOfComponentsPerPixel() != 1:
        raise Alone
    matrix = np.eye(4)
    matrix[:3, :3] = np.array(image.GetDirection()).reshape(3, 3) @ np.diag(image.GetSpacing())
    matrix[:3, 3] = image.GetOrigin()
    values = sitk.GetArrayFromImage(image).astype(float).transpose(2, 1, 0)
    if np.linalg.det(matrix) < 0:
        # Lumen has slices in the order of a right hand.
        matrix[:3, 3] += (values.shape[2] - 1) * matrix[:3, 2]
        matrix[:3, 2], values = -matrix[:3, 2], values[:, :, ::-1]
    return values, matrix


def contour(values, matrix, level):
    """Triangles of VTK's surface of a volume."""
    image = vtk.vtkImageData()
    image.SetDimensions(values.shape)
    image.GetPointData().SetScalars(numpy_to_vtk(np.ascontiguousarray(values.transpose(2, 1, 0)).ravel().astype(float), deep=1))
    made = vtk.vtkFlyingEdges3D()
    made.SetInputData(image)
    made.SetValue(0, level)
    made.ComputeNormalsOff()
    made.Update()
    points = made.GetOutput()
    if not points.GetNumberOfPolys():
        return 0, None
    placed = vtk_to_numpy(points.GetPoints().GetData()) @ matrix[:3, :3].T + matrix[:3, 3]
    return points.GetNumberOfPolys(), [np.nanmin(placed, 0), np.nanmax(placed, 0)]


def volume_differs(values, matrix, files, folder, loss=0.0):
    """Why Lumen's volume is another; its refusal comes second."""
    source = files[0] if len(files) == 1 else folder
    printed, refusal = lumen("inspect", "--json", source)
    if refusal:
        return None, refusal
    found = json.loads(printed)
    if "dimensions" not in found:
        return "opened as a surface", None
    low, high = float(np.nanmin(values)), float(np.nanmax(values))
    steps = np.array(found["directions"]).T * found["spacing_mm"]
    reach = 1e-4 * (1 + abs(matrix).max())
    for what, a, b, tolerance in [
        ("size", found["dimensions"], values.shape, 0), ("steps", steps, matrix[:3, :3], reach),
        ("origin", found["origin_mm"], matrix[:3, 3], reach), ("range", found["range"], [low, high], loss + 1e-5 * np.nanmax(abs(values))),
    ]:
        if not near(a, b, tolerance):
            return f"{what} {np.round(a, 4).tolist()}, not {np.round(b, 4).tolist()}", None
    if high - low < 1e-9 or min(values.shape) < 2:
        return None, None
    for part in [0.25, 0.5, 0.75]:
        # Between two values that occur: no point is on the level itself.
        level = low + (high - low) * (part + 1.234e-5)
        triangles, bounds = contour(values, matrix, level)
        out = folder / "surface.ply"
        if not triangles:
            continue
        printed, refusal = lumen("surface", *files, f"--threshold={level!r}", "-o", out)
        if refusal:
            return f"no surface: {refusal}", None
        count = int(next(line for line in printed.splitlines() if line.startswith("triangles")).split()[-1])
        if loss == 0 and count != triangles:
            return f"{count} triangles, not {triangles}", None
        made = trimesh.load(out, process=False).bounds
        # Beside a voxel without a value VTK's vertices have no place.
        if not np.isnan(values).any() and not near(made, bounds, 1e-3 * (1 + loss) + reach):
            return f"bounds {made.tolist()}, not {bounds}", None
    return None, None


# Surfaces: corners of triangles in mm.


def of_polydata(data):
    if isinstance(data, vtk.vtkUnstructuredGrid):
        kept = vtk.vtkPolyData()
        kept.SetPoints(data.GetPoints())
        faces = vtk.vtkCellArray()
        for at in range(data.GetNumberOfCells()):
            cell = data.GetCell(at)
            if cell.GetCellDimension() == 2:
                corners = [cell.GetPointId(n) for n in range(cell.GetNumberOfEdges())]
                if data.GetCellType(at) == vtk.VTK_PIXEL:
                    corners[2:] = corners[:1:-1]
                faces.InsertNextCell(len(corners), corners)
        kept.SetPolys(faces)
        data = kept
    if not isinstance(data, vtk.vtkPolyData):
        raise Alone
    cut = vtk.vtkTriangleFilter()
    cut.SetInputData(data)
    cut.PassVertsOff()
    cut.PassLinesOff()
    cut.Update()
    data = cut.GetOutput()
    if not data.GetNumberOfPolys():
        raise Alone
    corners = vtk_to_numpy(data.GetPolys().GetConnectivityArray()).reshape(-1, 3)
    return vtk_to_numpy(data.GetPoints().GetData()).astype(float)[corners]


def of_trimesh(path, folder):
    scene = trimesh.load_scene(unpacked(path, folder), process=False)
    meshes = [mesh for mesh in scene.dump() if isinstance(mesh, trimesh.Trimesh)]
    if not meshes:
        raise Alone
    triangles = np.concatenate([mesh.triangles for mesh in meshes])
    if path.suffix.lower() not in (".glb", ".gltf"):
        return triangles
    # Metres, y upwards.
    return 1000 * np.stack([triangles[..., 0], -triangles[..., 2], triangles[..., 1]], axis=-1)


def embedded(path, folder):
    """A glTF file that holds its data itself, of one that may keep them beside it."""
    data = json.loads(path.read_bytes())
    for buffer in data.get("buffers", []):
        # One without an address stands for data that are packed in another.
        if not buffer.get("uri", "data:").startswith("data:"):
            there = (path.parent / buffer["uri"]).read_bytes()
            buffer["uri"] = "data:application/octet-stream;base64," + base64.b64encode(there).decode()
    (folder / path.name).write_text(json.dumps(data))
    return folder / path.name


def unpacked(path, folder):
    """The same glTF file without meshopt compression, which trimesh does not read: its views by meshoptimizer itself."""
    whole = path.read_bytes()
    if not any(name in whole for name in [b"EXT_meshopt_compression", b"KHR_meshopt_compression"]):
        return path
    is_binary = whole.startswith(b"glTF")
    length = int.from_bytes(whole[12:16], "little")
    data = json.loads(whole[20:20 + length] if is_binary else whole)
    stored = [base64.b64decode(uri.split(",")[1]) if (uri := buffer.get("uri", "")).startswith("data:")
              else (path.parent / uri).read_bytes() if uri else whole[28 + length:] for buffer in data["buffers"]]
    plain = b""
    for view in data["bufferViews"]:
        extensions = view.pop("extensions", {})
        packed = extensions.get("KHR_meshopt_compression", extensions.get("EXT_meshopt_compression", view))
        at = packed.get("byteOffset", 0)
        piece = stored[packed["buffer"]][at:at + packed["byteLength"]]
        if packed is not view:
            count, stride = packed["count"], packed["byteStride"]
            decode = {"ATTRIBUTES": meshoptimizer.decode_vertex_buffer, "TRIANGLES": meshoptimizer.decode_index_buffer,
                      "INDICES": meshoptimizer.decode_index_sequence}[packed["mode"]]
            piece = np.ascontiguousarray(decode(count, stride, piece))
            if packed.get("filter") == "EXPONENTIAL":
                piece = meshoptimizer.decode_filter_exp(piece, count, stride)
            piece = piece.tobytes()
        plain += b"\0" * (-len(plain) % 4)
        view.update(buffer=0, byteOffset=len(plain), byteLength=len(piece))
        plain += piece
    # Whole numbers that stand for -1 to 1, which trimesh takes as they are.
    for number in {part["attributes"]["POSITION"] for mesh in data["meshes"] for part in mesh["primitives"]}:
        places = data["accessors"][number]
        if places.get("normalized"):
            view = data["bufferViews"][places["bufferView"]]
            kind = {5120: "i1", 5121: "u1", 5122: "<i2", 5123: "<u2"}[places["componentType"]]
            size, at = np.dtype(kind).itemsize, view["byteOffset"] + places.get("byteOffset", 0)
            numbers = np.ndarray((places["count"], 3), kind, plain, at, (view.get("byteStride", 3 * size), size))
            floats = np.maximum(numbers / np.iinfo(kind).max, -1).astype("<f4").tobytes()
            plain += b"\0" * (-len(plain) % 4)
            data["bufferViews"].append({"buffer": 0, "byteOffset": len(plain), "byteLength": len(floats)})
            data["accessors"][number] = {"bufferView": len(data["bufferViews"]) - 1, "componentType": 5126,
                                         "count": places["count"], "type": "VEC3"}
            plain += floats
    data["buffers"] = [{"byteLength": len(plain), "uri": "data:;base64," + base64.b64encode(plain).decode()}]
    data.pop("extensionsRequired", None)
    (folder / "plain.gltf").write_text(json.dumps(data))
    return folder / "plain.gltf"


def surface_differs(corners, path):
    unit = "m" if path.suffix.lower() in (".glb", ".gltf") else "mm"
    printed, refusal = lumen("inspect", "--json", "--unit", unit, path)
    if refusal:
        return None, refusal
    found = json.loads(printed)
    if "triangles" not in found:
        return "opened as a volume", None
    moved = np.array(found["moved_mm"])
    bounds = [np.array([found["bounds_mm"][end][axis] for axis in range(3)] if isinstance(found["bounds_mm"][end], list)
                       else list(found["bounds_mm"][end].values())) - moved for end in ["min", "max"]]
    area = np.linalg.norm(np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0]), axis=1).sum() / 2
    size = abs(corners).max()
    held = corners.reshape(-1, 3)
    # Quadrilaterals that are not flat may be cut either way, and the fans that trimesh makes of concave polygons overlap.
    loose = 2e-2 if found["polygons_triangulated"] else 1e-4
    area = min(area, found["area_mm2"]) if found["polygons_triangulated"] else area
    if path.suffix.lower() in (".glb", ".gltf") and any(word in path.read_bytes() for word in [b'"skins"', b'"sparse"']):
        # trimesh leaves out the pose of skinned meshes, and sparse accessors.
        return (None if found["triangles"] == len(corners) else "triangles"), None
    for what, a, b, tolerance in [
        ("triangles", found["triangles"], len(corners), 0), ("bounds", bounds, [held.min(0), held.max(0)], 1e-5 * size),
        ("area", found["area_mm2"], area, loose * area),
    ]:
        if not near(a, b, tolerance):
            return f"{what} {np.round(a, 4).tolist()}, not {np.round(b, 4).tolist()}", None
    return None, None


def compare(path):
    """How Lumen and the peer open a file: whether the peer does, what differs, and the refusal."""
    name, kind = path.name.lower(), path.suffix.lower()
    with tempfile.TemporaryDirectory() as folder:
        folder = Path(folder)
        try:
            if name.endswith((".nii", ".nii.gz", ".hdr")):
                return True, *volume_differs(*of_nibabel(path), [path], folder)
            if kind in (".nrrd", ".nhdr"):
                return True, *volume_differs(*of_pynrrd(path), [path], folder)
            if kind in OF_TRIMESH:
                corners = of_trimesh(path, folder)
                return True, *surface_differs(corners, embedded(path, folder) if kind == ".gltf" else path)
            if kind in OF_VTK:
                reader, failed = OF_VTK[kind](), []
                reader.AddObserver("ErrorEvent", lambda *_: failed.append(1))
                reader.SetFileName(str(path))
                reader.Update()
                data = reader.GetOutput()
                if failed or data is None:
                    raise ValueError("VTK fails")
                if isinstance(data, vtk.vtkImageData):
                    return True, *volume_differs(*of_vtk(data), [path], folder)
                return True, *surface_differs(of_polydata(data), path)
            values, matrix, names = of_pydicom(path, folder)
            lossy = pydicom.dcmread(path, force=True).file_meta.get("TransferSyntaxUID", "") in LOSSY
            return True, *volume_differs(values, matrix, names, folder, 3.0 if lossy else 0.0)
        except Alone:
            opens = None
        except Exception as error:  # noqa: BLE001: whatever a peer may raise, it does not open the file
            opens = False
            why = f"{type(error).__name__}: {error}"[:120]
        printed, refusal = lumen("inspect", path)
        if printed is not None:
            return opens, None if opens is None else f"opened where the peer fails ({why})", None
        return opens, None, refusal


#: JPEG baseline and extended, JPEG 2000.
LOSSY = {f"1.2.840.10008.1.2.4.{end}" for end in [50, 51, 91]}
KINDS = (".nii", ".nii.gz", ".hdr", ".nrrd", ".nhdr", ".dcm", *OF_TRIMESH, *OF_VTK)


def samples(arguments):
    """Name and folder of each package."""
    store = ROOT / "target" / "samples"
    store.mkdir(parents=True, exist_ok=True)
    for package in PACKAGES:
        folder = store / package
        if not folder.exists():
            whole = ["--no-binary", package] if package != "pydicom-data" else []
            subprocess.run([sys.executable, "-m", "pip", "download", "-q", "--no-deps", *whole, "-d", store / "packed", package],
                           check=True)
            packed = next((store / "packed").glob(f"{package.replace('-', '_')}-[0-9]*"))
            opener = zipfile.ZipFile if packed.suffix == ".whl" else tarfile.open
            with opener(packed) as archive:
                archive.extractall(folder)
        yield package, folder
    for folder in map(Path, arguments):
        yield folder.resolve().name, folder


def main():
    np.seterr(all="ignore")
    warnings.simplefilter("ignore")
    trimesh.util.log.setLevel("CRITICAL")
    counts, is_bad = {}, False
    reasons = collections.Counter()
    for package, folder in samples(sys.argv[1:]):
        count = counts[package] = collections.Counter()
        for path in sorted(folder.rglob("*")):
            is_dicom = path.is_file() and path.stat().st_size > 132 and path.open("rb").read(132)[128:] == b"DICM"
            if not path.is_file() or not (path.name.lower().endswith(KINDS) or is_dicom):
                continue
            opens, differs, refusal = compare(path)
            if refusal:
                result = "refused, as by the peer" if opens is False else "refused" if opens else "nothing for Lumen"
                reasons[refusal] += 1
                is_bad |= refusal.startswith(("FAILS", "HANGS"))
                print(f"{package}: {path.relative_to(folder)}: {result}: {refusal}", flush=True)
            elif opens is None:
                result = "not compared"
            elif differs:
                result = "differs" if opens else "opened alone"
                is_bad |= opens
                print(f"{package}: {path.relative_to(folder)}: {result}: {differs}", flush=True)
            else:
                result = "alike"
            count[result] += 1
    columns = ["alike", "differs", "refused", "refused, as by the peer", "nothing for Lumen", "opened alone", "not compared"]
    print("\n| package | " + " | ".join(columns) + " |\n|---|" + "---:|" * len(columns))
    for package, count in counts.items():
        print(f"| {package} | " + " | ".join(str(count[column]) for column in columns) + " |")
    print("\nPictures in DICOM: " + ", ".join(f"{count} {which}" for which, count in GDCM.most_common()))
    for sentence, count in reasons.most_common():
        print(f"{count}: {sentence}")
    sys.exit(is_bad)


main()
