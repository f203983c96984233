"""The state of a first-order mode from sample to sample."""

import numpy as np
from numpy.typing import NDArray
from scipy.linalg.lapack import dtbtrs, ztbtrs


def first_order(b: NDArray, r: complex) -> NDArray:
    """x_j = r x_(j-1) + b_j, x before the first sample 0.

    This is a triangular system with 1 on the diagonal and -r below it, which LAPACK solves term by term.

    Parameters
    ----------
    b : array, shape (n,) or (n, m)
        The terms, real or complex.
    r : float or complex
        What is kept of x from one sample to the next.

    Returns
    -------
    array
        x, of the shape of b.

    Examples
    --------
    >>> import numpy as np
    >>> [float(x) for x in first_order(np.ones(3), 0.5)]
    [1.0, 1.5, 1.75]
    """
    is_complex = np.iscomplexobj(b) or isinstance(r, complex)
    band = np.empty((2, len(b)), dtype=complex if is_complex else float)
    band[0], band[1] = 1.0, -r
    solve = ztbtrs if is_complex else dtbtrs
    x, _ = solve(band, b if b.ndim == 2 else b[:, None], uplo="L", diag="U")
    return x if b.ndim == 2 else x[:, 0]
