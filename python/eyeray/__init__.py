"""eyeray: scenes, pictures as numpy arrays, and the proof that they are right (docs/python.md)."""

import atexit
import operator
import os

from eyeray._eyeray import Cancellation, Picture, Renderer, Report, Scene, version
from eyeray.errors import (
    CancelledError, DeviceError, Diagnostic, DeviceTimeout, Error, FileError, InputError, InternalError)

__version__ = version()
__all__ = [
    "Cancellation", "CancelledError", "DeviceError", "DeviceTimeout", "Diagnostic", "Error", "FileError",
    "InputError", "InternalError", "Picture", "Renderer", "Report", "Scene", "render", "verify", "version"]

_renderer = None


def _shared_renderer():
    global _renderer
    if _renderer is None:
        _renderer = Renderer()
    return _renderer


@atexit.register
def _close():
    """A driver wants to be closed before the process tears itself down."""
    global _renderer
    _renderer = None


def _whole(value, wanted):
    if isinstance(value, bool) or not hasattr(value, "__index__"):
        raise TypeError(f"{wanted} from 1 on, not {type(value).__name__}")
    number = operator.index(value)
    if number < 1:
        raise InputError(f"{wanted} from 1 on, not {number}")
    return number


def _scene_of(scene, size, spp):
    """A Scene as it is, or that of a file or of dicts, with `size` and `spp` laid over it."""
    if isinstance(scene, Scene):
        if size is not None or spp is not None:
            raise TypeError("size and spp need a file or a dict: a Scene has its own")
        return scene
    defines = {}
    if size is not None:
        if isinstance(size, (str, bytes)) or not hasattr(size, "__len__") or len(size) != 2:
            raise TypeError(f"size must be (width, height), not {size!r}")
        for key, value in zip(("image.width", "image.height"), size):
            defines[key] = _whole(value, "size: width and height must be whole numbers")
    if spp is not None:
        defines["image.samples"] = _whole(spp, "spp: the samples a pixel must be a whole number")
    if isinstance(scene, dict):
        return Scene.build(scene, defines=defines)
    if isinstance(scene, (str, os.PathLike)):
        return Scene.read(scene, defines=defines)
    raise TypeError(f"a scene must be an eyeray.Scene, the name of a file, or a dict, not {type(scene).__name__}")


def render(scene, *, size=None, spp=None, backend="gpu", aovs=(), crop=None, noise=0.0, clamp=0.0,
           reject_fireflies=False, denoise=False, progress=None, cancellation=None):
    """The picture of a scene, of a scene file or of a dict as Scene.build takes it.

    size=(width, height) and spp, samples a pixel, are laid over a file or a dict. The other options are
    Renderer.render's. All calls share a renderer.
    """
    return _shared_renderer().render(
        _scene_of(scene, size, spp), backend=backend, aovs=aovs, crop=crop, noise=noise, clamp=clamp,
        reject_fireflies=reject_fireflies, denoise=denoise, progress=progress, cancellation=cancellation)


def verify(scene, *, size=None, spp=None, backends=("gpu", "twin"), crop=None, evidence=None, progress=None,
           cancellation=None):
    """Whether this machine renders a scene right: a Report. Scene, size and spp are as render() takes them.

    The other options are Renderer.verify's. All calls share a renderer.
    """
    return _shared_renderer().verify(
        _scene_of(scene, size, spp), backends=backends, crop=crop, evidence=evidence, progress=progress,
        cancellation=cancellation)
