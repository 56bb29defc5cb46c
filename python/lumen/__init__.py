"""Lumen: opens a blood-vessel surface, smooths it, reduces it to a progressive mesh, and says what became of its calibre.

    import lumen
    result = lumen.read("aorta.stl").optimise(pass_band=0.01, iterations=100)
    result.levels[0.9].save("aorta90.stl")
    print(result.verdict["head"])

Not for clinical decisions.
"""
import os

import numpy

from ._lumen import (Centrelines, Error, Guidewire, Levels, Optimised, Surface, __version__, _forked, read, settings, write)

__all__ = ["Centrelines", "Error", "Guidewire", "Levels", "Optimised", "Surface", "__version__", "from_voxels", "read", "settings",
           "write"]

if hasattr(os, "register_at_fork"):
    # A fork copies no threads: what waits for those of the parent would wait forever.
    os.register_at_fork(after_in_child=_forked)

#: What NRRD calls the kinds of numbers, by numpy's names.
_KINDS = {"bool": "uint8", "uint8": "uint8", "int8": "int8", "int16": "int16", "uint16": "uint16", "int32": "int32", "uint32": "uint32",
          "float32": "float", "float64": "double"}


def from_voxels(voxels, spacing=(1.0, 1.0, 1.0), origin=(0.0, 0.0, 0.0), *, threshold=None, label=None, seed=None):
    """The surface in an array of voxels: of a mask, or with `threshold` of a scan; the rest as `read` has it.

    `voxels[i, j, k]` lies at `origin + (i, j, k) * spacing` mm, to the left, back and top of the patient.
    """
    voxels = numpy.asarray(voxels)
    if voxels.dtype.name == "int64" and (voxels.astype(numpy.int32) == voxels).all():
        voxels = voxels.astype(numpy.int32)
    kind = _KINDS.get(voxels.dtype.name)
    if voxels.ndim != 3 or kind is None:
        raise ValueError(f"voxels have three axes and are numbers of up to 32 bits, not {voxels.ndim} of {voxels.dtype}")
    spacing, origin = [[float(along) for along in vector] for vector in (spacing, origin)]
    directions = " ".join(f"({','.join(map(repr, row))})" for row in numpy.diag(spacing).tolist())
    head = (f"NRRD0004\ntype: {kind}\ndimension: 3\nspace: left-posterior-superior\nsizes: {' '.join(map(str, voxels.shape))}\n"
            f"space directions: {directions}\nspace origin: ({','.join(map(repr, origin))})\nendian: little\nencoding: raw\n\n")
    little = voxels.astype(voxels.dtype.newbyteorder("<"), copy=False)
    return read(head.encode() + little.tobytes(order="F"), "voxels.nrrd", threshold=threshold, label=label, seed=seed)
