"""Types in annotations. Only type checkers import them: numpy.typing is slow to import."""

from typing import Any, Union

import numpy as np
from numpy.typing import ArrayLike, NDArray

from ._domain import Domain

Floats = NDArray[np.float64]
Ints = NDArray[np.int32]
Indices = NDArray[np.uint32]
Bools = NDArray[np.bool_]
Array = NDArray[Any]

ShapeLike = Union[Domain, ArrayLike, Any]
"""What `as_domain` takes: also polygons of shapely and meshes of meshio."""

__all__ = ["Array", "ArrayLike", "Bools", "Floats", "Indices", "Ints", "ShapeLike"]
