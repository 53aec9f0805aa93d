"""eyeray: scenes, pictures as numpy arrays, and the proof that they are right (docs/python.md)."""

import atexit

from eyeray._eyeray import Cancellation, Picture, Renderer, Report, Scene, version
from eyeray.errors import (
    CancelledError, DeviceError, Diagnostic, DeviceTimeout, Error, FileError, InputError)

__version__ = version()
__all__ = [
    "Cancellation", "CancelledError", "DeviceError", "DeviceTimeout", "Diagnostic", "Error", "FileError",
    "InputError", "Picture", "Renderer", "Report", "Scene", "render", "verify", "version"]

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


def render(scene, **options):
    """The picture of a scene, by a renderer that all calls share. Options as Renderer.render's."""
    return _shared_renderer().render(scene, **options)


def verify(scene, **options):
    """Whether this machine renders a scene right, by the same. Options as Renderer.verify's."""
    return _shared_renderer().verify(scene, **options)
