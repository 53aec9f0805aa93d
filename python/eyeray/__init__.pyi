from collections.abc import Callable, Sequence
from os import PathLike
from typing import Any, Literal

from eyeray._eyeray import (
    Backend, Cancellation as Cancellation, Picture as Picture, Renderer as Renderer, Report as Report,
    Scene as Scene, version as version)
from eyeray.errors import (
    CancelledError as CancelledError, DeviceError as DeviceError, DeviceTimeout as DeviceTimeout,
    Diagnostic as Diagnostic, Error as Error, FileError as FileError, InputError as InputError,
    InternalError as InternalError)

__version__: str

def render(scene: Scene | str | PathLike[str] | dict[str, Any], *, size: tuple[int, int] | None = ...,
           spp: int | None = ..., backend: Backend = ..., aovs: Sequence[str] = ...,
           crop: tuple[int, int, int, int] | None = ..., noise: float = ..., clamp: float = ...,
           reject_fireflies: bool = ..., denoise: bool | Literal["oidn"] = ...,
           progress: Callable[[float], bool | None] | None = ...,
           cancellation: Cancellation | None = ...) -> Picture: ...
def verify(scene: Scene | str | PathLike[str] | dict[str, Any], *, size: tuple[int, int] | None = ...,
           spp: int | None = ..., backends: Sequence[Backend] = ..., crop: tuple[int, int, int, int] | None = ...,
           evidence: str | PathLike[str] | None = ..., progress: Callable[[float], bool | None] | None = ...,
           cancellation: Cancellation | None = ...) -> Report: ...
