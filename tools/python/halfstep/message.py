"""What all messages have in common."""

from __future__ import annotations

import ctypes
from typing import Any, TypeVar

import numpy as np
from numpy.typing import NDArray

M = TypeVar("M", bound="Message")


class Message(ctypes.Structure):
    """A message as it lies in shared memory: fixed size, no padding."""

    @classmethod
    def copy_of(cls: type[M], payload: Any) -> M:
        """A copy that stays when shared memory is given back."""
        return cls.from_buffer_copy(payload)

    def array(self, field: str) -> NDArray[np.float64]:
        """A field of several numbers as numpy; a view, so that writing to it changes the message."""
        return np.ctypeslib.as_array(getattr(self, field))

    def __repr__(self) -> str:
        def text(value: Any) -> str:
            return str(list(value)) if isinstance(value, ctypes.Array) else str(value)

        fields = ", ".join(f"{name}={text(getattr(self, name))}" for name, *_ in self._fields_)
        return f"{type(self).__name__}({fields})"
