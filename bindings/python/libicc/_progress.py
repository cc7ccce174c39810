"""The bar that ``progress=True`` shows: tqdm's if it is installed, else a line on the standard error."""

from __future__ import annotations

import sys
from typing import Any


class Bar:
    def __init__(self) -> None:
        try:
            from tqdm.auto import tqdm
        except ImportError:
            self._tqdm: Any = None
        else:
            self._tqdm = tqdm(total=100, bar_format="{desc} {percentage:3.0f}%|{bar}| {elapsed}", leave=True)
        self._shown = -1

    def __call__(self, stage: str, share: float) -> None:
        percent = int(100 * share)
        if percent == self._shown:
            return
        if self._tqdm is None:
            sys.stderr.write(f"\r{stage:12} {percent:3} %")
        else:
            self._tqdm.set_description_str(stage, refresh=False)
            self._tqdm.update(percent - max(self._shown, 0))
        self._shown = percent

    def close(self) -> None:
        """Ends the bar."""
        if self._tqdm is not None:
            self._tqdm.close()
        elif self._shown >= 0:
            sys.stderr.write("\n")
