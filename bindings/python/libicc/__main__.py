"""``python -m libicc``: see `libicc.front`."""

from .front import main

if __name__ == "__main__":
    raise SystemExit(main())
