"""One edge: the fluctuation D-(w_i, w_j) of Eq. (8), split into what radial geometry needs apart.

States beside an edge are normal to it and scaled (g = 1); layer 1 is water, layer 2 grains; i is before the edge, j
after it. Each function of this folder's files returns, for each layer it knows, the flux of mass, the flux of momentum
(advection and viscosity), and the pressure product, which acts half on each side:

    D- + F(w_i) = (flux of mass, flux of momentum + half the pressure product)
"""
