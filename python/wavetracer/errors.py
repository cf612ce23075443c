# SPDX-License-Identifier: Apache-2.0
"""The errors of wavetracer: messages are those of the program, and say what is wrong, where, and what to do about it."""
from __future__ import annotations


class Error(Exception):
    """The base of all errors. `code` is the exit code that the program `wavetracer` would have."""

    code: int = 1

    def __init__(self, message: str, code: int | None = None):
        super().__init__(message)
        if code is not None:
            self.code = code


class RunError(Error, RuntimeError):
    """Memory or the disk is full, or a limit was met (code 1)."""

    code = 1


class ConfigError(Error, ValueError):
    """A configuration or an argument is wrong (code 2)."""

    code = 2


class ArgumentError(ConfigError, TypeError):
    """An argument has a type that the call does not take (code 2)."""


class InputError(Error, ValueError):
    """A scene, antenna, trajectory or result file is wrong (code 3)."""

    code = 3


class DeviceError(Error, RuntimeError):
    """There is no OpenCL device, no memory on it, or a kernel does not build (code 4)."""

    code = 4


class FrameStopped(Error):
    """The caller's progress function has stopped the frame (code 130)."""

    code = 130


def error_of(code: int, message: str) -> Error:
    """The exception of an exit code."""
    classes = (RunError, ConfigError, InputError, DeviceError, FrameStopped)
    return next((kind(message) for kind in classes if kind.code == code), Error(message, code))
