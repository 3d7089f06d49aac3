! Returns in q the initial state of one patch: both layers' masses per area (density times depth), all at rest.
!
! column.txt holds the number of cells along each side of the box, the level of the water (m), the depth of the
! grains (m) in the column, and the fraction of each cell that the column covers, x fastest: the same fractions
! that subslide starts from.
subroutine qinit(meqn, mbc, mx, my, xlow, ylow, dx, dy, q, maux, aux)

    use amr_module, only: xlower, ylower
    use geoclaw_module, only: rho

    implicit none

    integer, intent(in) :: meqn, mbc, mx, my, maux
    real(kind=8), intent(in) :: xlow, ylow, dx, dy
    real(kind=8), intent(inout) :: q(meqn, 1-mbc:mx+mbc, 1-mbc:my+mbc)
    real(kind=8), intent(inout) :: aux(maux, 1-mbc:mx+mbc, 1-mbc:my+mbc)

    real(kind=8), allocatable, save :: depth(:, :)
    real(kind=8), save :: level
    real(kind=8) :: column
    integer :: cells, unit, first_x, first_y

    if (.not. allocated(depth)) then
        open(newunit=unit, file='column.txt', status='old', action='read')
        read(unit, *) cells, level, column
        allocate(depth(cells, cells))
        read(unit, *) depth
        close(unit)
        depth = column * depth
    end if

    first_x = nint((xlow - xlower) / dx) + 1
    first_y = nint((ylow - ylower) / dy) + 1
    q = 0.d0
    q(4, 1:mx, 1:my) = rho(2) * depth(first_x:first_x+mx-1, first_y:first_y+my-1)
    q(1, 1:mx, 1:my) = rho(1) * level - q(4, 1:mx, 1:my) * rho(1) / rho(2)

end subroutine qinit
