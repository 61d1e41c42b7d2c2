"""Loads ∫φq of the shapes of plates on ψ in a volume, over the triangles of their faces."""

from __future__ import annotations

from collections.abc import Iterator

import basix
import numpy as np
from numpy.typing import NDArray

from hydroelastic.fem.facets import FacetGroup, facet_groups
from hydroelastic.fem.liquid import LiquidSpace
from hydroelastic.fem.plan.plan_pencil import PlanPlate
from hydroelastic.fem.shape_loads import potential_basis

# Degrees of the quadrature beyond that of ψ.
_SPARE_DEGREES = 8
# Values of shapes that are held at once.
_AT_ONCE = 4_000_000


def plate_loads(liquid: LiquidSpace, plate: PlanPlate) -> Iterator[NDArray[np.float64]]:
    """Yield ∫φq of each shape, owned entries, shape (owned unknowns,) (collective).

    Together they would take more memory than the matrices: of all shapes they are kept on the cells at the plate alone.
    An integral that is not exact costs frequencies their bound from above, so the points follow the shortest shape.
    """
    groups = list(facet_groups(liquid, plate.body.surface))
    cells = np.concatenate([np.empty(0, np.int32), *(group.cells for group in groups)])
    touched = np.unique(liquid.space.dofmap.list[cells])
    place_of = np.zeros(len(liquid.layer_of), dtype=np.int64)
    place_of[touched] = np.arange(len(touched))
    loads = np.zeros((plate.body.size, len(touched)))
    for group in groups:
        corners = group.physical_points(group.reference_corners)
        sizes = np.linalg.norm(corners - np.roll(corners, 1, axis=1), axis=2).max(axis=1)
        # Small cells at the edges need fewer points than the longest ones.
        orders = liquid.degree + _SPARE_DEGREES + 2 * np.ceil(0.5 * plate.wavenumber * sizes).astype(int)
        for order in np.unique(orders):
            _add(liquid, plate, group.subset(orders == order), int(order), place_of, loads)
    for values in loads:
        whole = np.zeros((1, len(liquid.layer_of)))
        whole[0, touched] = values
        yield liquid.numbering.summed(whole)[0]


def _add(
    liquid: LiquidSpace,
    plate: PlanPlate,
    group: FacetGroup,
    order: int,
    place_of: NDArray[np.int64],
    loads: NDArray[np.float64],
) -> None:
    local, weights = basix.make_quadrature(group.facet_type, order)
    reference = group.reference_points(local)
    basis = potential_basis(liquid, reference)
    _, measures = group.normals(reference)
    facets = len(group.cells)
    step = max(1, _AT_ONCE // (len(weights) * plate.body.size))
    for first in range(0, facets, step):
        some = slice(first, first + step)
        part = group.subset(np.isin(np.arange(facets), np.arange(facets)[some]))
        places = part.physical_points(reference)
        values = plate.deflection(places.reshape(-1, 3)[:, :2].T).reshape(plate.body.size, -1, len(weights))
        dofs = place_of[liquid.space.dofmap.list[part.cells]]
        parts = (values * np.broadcast_to(measures * weights, (facets, len(weights)))[some]) @ basis
        for number in range(plate.body.size):
            np.add.at(loads[number], dofs, parts[number])
