"""What eyeray raises. The native module raises these, too."""

from typing import NamedTuple


class Diagnostic(NamedTuple):
    """What is wrong, or doubtful, and where. Lines and columns count from 1; 0 where unknown."""

    message: str
    file: str
    line: int
    column: int
    is_error: bool


class Error(Exception):
    """What eyeray raises. `diagnostics` are there for scenes and shaders."""

    def __init__(self, message, diagnostics=()):
        super().__init__(message)
        self.diagnostics = tuple(Diagnostic(*each) for each in diagnostics)

    @property
    def file(self):
        """Where the first fault is, or None."""
        return self.diagnostics[0].file if self.diagnostics else None

    @property
    def line(self):
        return self.diagnostics[0].line if self.diagnostics else None

    @property
    def column(self):
        return self.diagnostics[0].column if self.diagnostics else None


class InputError(Error, ValueError):
    """A scene, a shader or an option is wrong."""


class DeviceError(Error, RuntimeError):
    """There is no usable Vulkan device, or it was lost; or there is no memory."""


class FileError(Error, OSError):
    """A file cannot be read or written."""


class DeviceTimeout(Error, TimeoutError):
    """The device took longer than Renderer(timeout=…)."""


class CancelledError(Error):
    """verify() was cancelled."""


class InternalError(Error, RuntimeError):
    """eyeray has a bug; please report it."""


# By the numbers of the native module.
_kinds = (InputError, DeviceError, FileError, DeviceTimeout, CancelledError, InternalError)
