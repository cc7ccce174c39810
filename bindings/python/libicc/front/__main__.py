"""``python -m libicc.front``, the same as ``python -m libicc``."""

from . import main

if __name__ == "__main__":
    raise SystemExit(main())
