"""Lumen: opens a blood-vessel surface, smooths it, reduces it to a progressive mesh, and says what became of its calibre.

    import lumen
    result = lumen.read("aorta.stl").optimise(pass_band=0.01, iterations=100)
    result.levels[0.9].save("aorta90.stl")
    print(result.verdict["head"])

Not for clinical decisions.
"""
from ._lumen import (Centrelines, Error, Guidewire, Levels, Optimised, Surface, __version__, read, settings, write)

__all__ = ["Centrelines", "Error", "Guidewire", "Levels", "Optimised", "Surface", "__version__", "read", "settings", "write"]
