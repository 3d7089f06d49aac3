"""One step in the plane, as work on rows of ny x nx square cells (y first), numbered as drawn in `arrays`.

Row j without ghosts is the padded row j + GHOSTS. Loops over columns start..stop-1 count from the smallest index that
they need.
"""

from subslide.kernels.active import joint, joint_wet
from subslide.kernels.arrays import GHOSTS, is_general
from subslide.kernels.boundary import WALL, copied_after, copied_before
from subslide.kernels.edge.stuck import is_stuck
from subslide.kernels.friction import COULOMB
from subslide.kernels.friction.coulomb import head
from subslide.kernels.hyperbolicity import RUB, rub
from subslide.kernels.jit import inlined, part, unsigned
from subslide.kernels.positivity import limit, reference, share
from subslide.kernels.printed import braking
from subslide.kernels.slowing import first_reach, law_left, left_of
from subslide.kernels.velocity import norm, velocity
from subslide.kernels.waves import chosen_bounds, water_speeds


@inlined
def copy_cell(c, j, i, ghost_j, ghost_i, flip_u, flip_v):
    """Copy a cell's state into a ghost, with the velocity along x or y reversed."""
    c.h1[ghost_j, ghost_i] = c.h1[j, i]
    c.h2[ghost_j, ghost_i] = c.h2[j, i]
    c.u1[ghost_j, ghost_i] = -c.u1[j, i] if flip_u else c.u1[j, i]
    c.u2[ghost_j, ghost_i] = -c.u2[j, i] if flip_u else c.u2[j, i]
    c.v1[ghost_j, ghost_i] = -c.v1[j, i] if flip_v else c.v1[j, i]
    c.v2[ghost_j, ghost_i] = -c.v2[j, i] if flip_v else c.v2[j, i]


@inlined
def fill_ghosts(c, walls):
    """Set the ghost cells; `walls` says what (left, right, bottom, top) are, see `boundary`."""
    ny, nx = c.h1.shape
    left, right, bottom, top = walls
    for g in range(GHOSTS):
        for j in range(GHOSTS, ny - GHOSTS):
            copy_cell(c, j, copied_before(left, g, nx), j, GHOSTS - 1 - g, left == WALL, False)
            copy_cell(c, j, copied_after(right, g, nx), j, nx - GHOSTS + g, right == WALL, False)
    for g in range(GHOSTS):
        for i in range(nx):
            copy_cell(c, copied_before(bottom, g, ny), i, GHOSTS - 1 - g, i, False, bottom == WALL)
            copy_cell(c, copied_after(top, g, ny), i, ny - GHOSTS + g, i, False, top == WALL)


@inlined
def cell_speeds(s, c, start, stop):
    """Fill what a step derives from the state of a row: sums, squares, wave speeds and the pace."""
    first, count = part(start, stop)
    for k in range(count):
        i = k + first
        h1 = c.h1[i]
        h2 = c.h2[i]
        c.eta[i] = h1 + h2
        c.head2[i] = head(s.r, h1 + h2, h2)
        c.square2[i] = c.u2[i] * c.u2[i] + c.v2[i] * c.v2[i]
        slow_x, fast_x = chosen_bounds(s, h1, c.u1[i], h2, c.u2[i])
        slow_y, fast_y = chosen_bounds(s, h1, c.v1[i], h2, c.v2[i])
        c.slow_x[i] = slow_x
        c.fast_x[i] = fast_x
        c.slow_y[i] = slow_y
        c.fast_y[i] = fast_y
        c.pace[i] = max(fast_x, -slow_x) + max(fast_y, -slow_y)


@inlined
def water_cell_speeds(s, c, start, stop):
    """Fill the same for cells without grains."""
    first, count = part(start, stop)
    for k in range(count):
        i = k + first
        h1 = c.h1[i]
        c.eta[i] = h1
        c.head2[i] = s.r * h1
        slow_x, fast_x = water_speeds(h1, c.u1[i])
        slow_y, fast_y = water_speeds(h1, c.v1[i])
        c.slow_x[i] = slow_x
        c.fast_x[i] = fast_x
        c.slow_y[i] = slow_y
        c.fast_y[i] = fast_y
        c.pace[i] = max(fast_x, -slow_x) + max(fast_y, -slow_y)


@inlined
def slow_down(s, c, time):
    """Advance the moving grains of a row by friction alone for a time, before a step."""
    for i in range(c.h2.shape[0]):
        factor = left_of(s, time, c.h2[i], norm(c.u2[i], c.v2[i]))
        c.u2[i] *= factor
        c.v2[i] *= factor
        c.square2[i] = c.u2[i] * c.u2[i] + c.v2[i] * c.v2[i]


@inlined
def central_jump(c, j, i, step_j, step_i):
    """Return the driving jump between the cells either side of (j, i)."""
    return c.head2[j + step_j, unsigned(i + step_i)] - c.head2[j - step_j, unsigned(i - step_i)]


@inlined
def fill_stuck(s, c, stuck, rows, shift, step, start, stop, dt):
    """Fill a row of `stuck`, 1 for edges that friction holds, columns start..stop-1 of it.

    Edge k lies between the cell k + shift of the padded row rows[0] and the cell k + shift + step of row rows[1]; step
    is 1 for edges along x and 0 along y. The driving force is a vector: its part along the edge is the mean of the
    central slopes in both cells. (With the normal part alone a cell on a slope across the grid could be too steep to
    stop, yet pass nothing on.)
    """
    quarter = type(s.r)(0.25)
    p, n = rows
    across = 1 - step
    first, count = part(start, stop)
    for m in range(count):
        k = m + first
        i = k + shift
        here = unsigned(i)
        there = unsigned(i + step)
        normal = c.head2[n, there] - c.head2[p, here]
        along = quarter * (central_jump(c, p, i, step, across) + central_jump(c, n, i + step, step, across))
        push = normal * normal + along * along
        stuck[unsigned(k)] = is_stuck(s, dt, s.dx, c.square2[p, here], c.square2[n, there], push)


@inlined
def outflow(fx, fy, j, k):
    """Return what leaves cell (j, k) through its four edges, given the mass fluxes along x and y."""
    zero = type(fx[0, 0])(0)
    along_x = max(zero, fx[j, k + 1]) - min(zero, fx[j, k])
    return along_x + (max(zero, fy[j + 1, k]) - min(zero, fy[j, k]))


@inlined
def fill_terms(s, c, fx, fy, terms, spans, j, dt):
    """Fill `CellTerms` of row j, without ghosts; those of grains where there are any."""
    ratio = dt / s.dx
    p = j + GHOSTS
    start, stop = joint(spans, p, p, -GHOSTS, -GHOSTS, fy.f1.shape[1])
    low, high = joint_wet(spans, p, p, -GHOSTS, -GHOSTS, start, stop)
    first, count = part(start, stop)
    for m in range(count):
        k = m + first
        i = k + GHOSTS
        terms.keep1[p, i] = share(c.h1[p, i], ratio * outflow(fx.f1, fy.f1, j, k), s.dry_depth)
    first, count = part(low, high)
    for m in range(count):
        k = m + first
        i = k + GHOSTS
        terms.keep2[p, i] = share(c.h2[p, i], ratio * outflow(fx.f2, fy.f2, j, k), s.dry_depth)
        along_x, along_y = min(fx.stuck[j, k], fx.stuck[j, k + 1]), min(fy.stuck[j, k], fy.stuck[j + 1, k])
        terms.held[p, i] = min(along_x, along_y)


@inlined
def advance_layer(ratio, h, u, v, x, y, keep, inner_x, inner_y, j, k):
    """Return a layer's depth and momenta in cell (j, k) after a step (Eq. 6), from its fluxes x and y: (f, m, t, p)."""
    half = type(ratio)(0.5)
    fx, mx, tx, px = x
    fy, my, ty, py = y
    p = j + GHOSTS
    i = k + GHOSTS
    west = ratio * limit(fx[j, k], keep[p, i - 1], keep[p, i])
    east = ratio * limit(fx[j, k + 1], keep[p, i], keep[p, i + 1])
    south = ratio * limit(fy[j, k], keep[p - 1, i], keep[p, i])
    north = ratio * limit(fy[j + 1, k], keep[p, i], keep[p + 1, i])
    old = h[p, i]
    new = old + ((west * fx[j, k] - east * fx[j, k + 1]) + (south * fy[j, k] - north * fy[j + 1, k]))
    gain_x = (west * mx[j, k] - east * mx[j, k + 1]) + (south * ty[j, k] - north * ty[j + 1, k])
    gain_y = (south * my[j, k] - north * my[j + 1, k]) + (west * tx[j, k] - east * tx[j, k + 1])
    push_x = ratio * (half * (px[j, k] + px[j, k + 1]) + inner_x[p, i])
    push_y = ratio * (half * (py[j, k] + py[j + 1, k]) + inner_y[p, i])
    return new, old * u[p, i] + (gain_x - push_x), old * v[p, i] + (gain_y - push_y)


@inlined
def update(s, c, fx, fy, terms, spans, j, dt, acts):
    """Advance row j, without ghosts, by dt: fluxes, pressure, then friction; see `axial.update`."""
    still_reach, reach = first_reach(s, dt), first_reach(s, acts)
    ratio = dt / s.dx
    p = j + GHOSTS
    start, stop = joint(spans, p, p, -GHOSTS, -GHOSTS, fy.f1.shape[1])
    low, high = joint_wet(spans, p, p, -GHOSTS, -GHOSTS, start, stop)
    x, y = (fx.f1, fx.m1, fx.t1, fx.p1), (fy.f1, fy.m1, fy.t1, fy.p1)
    first, count = part(start, stop)
    for m in range(count):
        k = m + first
        i = k + GHOSTS
        h, qx, qy = advance_layer(
            ratio, c.h1, c.u1, c.v1, x, y, terms.keep1, terms.inner_p1x, terms.inner_p1y, j, k
        )
        depth = reference(c.h1[p, i], h, terms.keep1[p, i])
        c.h1[p, i] = h
        c.u1[p, i] = velocity(qx, depth, s.dry_depth)
        c.v1[p, i] = velocity(qy, depth, s.dry_depth)
    x, y = (fx.f2, fx.m2, fx.t2, fx.p2), (fy.f2, fy.m2, fy.t2, fy.p2)
    first, count = part(low, high)
    for m in range(count):
        k = m + first
        i = k + GHOSTS
        h, qx, qy = advance_layer(
            ratio, c.h2, c.u2, c.v2, x, y, terms.keep2, terms.inner_p2x, terms.inner_p2y, j, k
        )
        u = velocity(qx, h, s.dry_depth)
        v = velocity(qy, h, s.dry_depth)
        taken = reach if c.square2[p, i] > type(dt)(0) else still_reach
        factor = braking(s, taken, norm(u, v), terms.held[p, i])
        c.h2[p, i] = h
        c.u2[p, i] = factor * u
        c.v2[p, i] = factor * v
    if is_general(s) and s.law != COULOMB:
        for i in range(low + GHOSTS, high + GHOSTS):
            time = acts if c.square2[p, i] > type(dt)(0) else dt
            factor = law_left(s, time, c.h2[p, i], norm(c.u2[p, i], c.v2[p, i]))
            c.u2[p, i] *= factor
            c.v2[p, i] *= factor
    if is_general(s) and s.treatment == RUB:
        rub(s, c.h1[p], c.u1[p], c.v1[p], c.h2[p], c.u2[p], c.v2[p])
