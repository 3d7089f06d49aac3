"""The part of an output that is a sum of functions of one input each: it has no second-order index."""

import numpy as np

DEGREE = 4
"""Degree of the polynomials, in an input's place among its values."""


def ranks(values: np.ndarray) -> np.ndarray:
    """Return values by their places among all, from -1 to 1, equal ones alike.

    Parameters
    ----------
    values
        Values, of any shape.

    Returns
    -------
    ndarray
        Their places, of the same shape.
    """
    distinct, places = np.unique(values, return_inverse=True)
    return (2 * places / max(1, len(distinct) - 1) - 1).reshape(values.shape)


class Additive:
    """Sums of a polynomial of each input.

    Parameters
    ----------
    inputs
        Inputs (..., number of them) of the runs; without them sums are 0.
    """

    def __init__(self, inputs: np.ndarray | None):
        """Make a basis (runs, polynomials), the constant among them, and its products."""
        self.basis: np.ndarray | None = None
        if inputs is not None:
            columns = np.moveaxis(inputs, -1, 0)
            of_each = [np.polynomial.legendre.legvander(ranks(one).ravel(), DEGREE)[:, 1:] for one in columns]
            self.basis = np.concatenate([np.ones((columns[0].size, 1)), *of_each], axis=1)
            self.products = np.linalg.pinv(np.einsum("ri,rj->ij", self.basis, self.basis))

    def of(self, outputs: np.ndarray) -> np.ndarray:
        """Return the sums that fit outputs best, by least squares.

        Parameters
        ----------
        outputs
            Outputs of the runs, in their shape, or with more axes behind.

        Returns
        -------
        ndarray
            Sums of the same shape.
        """
        if self.basis is None:
            return np.zeros_like(outputs)
        rows = outputs.reshape(len(self.basis), -1)
        return (self.basis @ (self.products @ (self.basis.T @ rows))).reshape(outputs.shape)
