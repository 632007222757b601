!> Ground that holds a beam along its axis by springs and, up to its limit, by sliders in series with them (t-z curves, elastic and
!> ideally plastic): displacements and forces where it is known what slides.
!>
!> Lengths are shares of bars. Where the springs of a bar have the stiffness K and the sliders have gone s, ground pushes with
!> -K (u - s), and with -way t where it slides; t is linear along the bar, p a load along it, c its length/EA and g what it would be
!> longer without force:
!>     N = (u' - g)/c,   N' = K (u - s) - p   or   way t - p,
!> so u is a polynomial, and two exponentials with the rate sqrt(c K) where ground holds (Winkler, along the axis). In quadruple
!> precision: what springs give way may be small beside what sliders went.
module gapbeam_axial_bedding
    use gapbeam_kinds, only: wp, qp
    use gapbeam_exponential_curve, only: curve_type, new_curve, value_of, derivative, scaled
    implicit none
    private
    public :: memory_type, cell_type, bedding_type, loads_type, no_limit
    public :: solve_cells, give_way, settled_push, pulling, force_at, friction_on, is_bedded

    !> More than any limit; infinite ones would have differences that are none
    real(qp), parameter :: no_limit = huge(1.0_wp)

    !> A part of a bar, and how far sliders have gone there: coefficients of powers of the share
    type :: memory_type
        integer :: bar
        real(qp) :: from = 0.0_qp, to = 1.0_qp, slid(0:3) = 0.0_qp
    end type memory_type

    !> A part of a memory over which the beam slides to the right (1), to the left (-1), or is held (0), and its displacement
    type :: cell_type
        integer :: memory, bar, way = 0
        real(qp) :: from, to
        type(curve_type) :: displacement
    end type cell_type

    !> Loads at a load factor: forces at the nodes, to the right, shape (0:n), on the bars, and elongations of these without
    !> force, shape (n)
    type :: loads_type
        real(qp), allocatable :: node(:), along(:), longer(:)
    end type loads_type

    !> The bars, their ground, and how they are
    type :: bedding_type
        !> Length/EA of every bar, above 0; stiffness of the ground along it, and its limit at both ends times the length, 0: no
        !> ground, `no_limit`: it never slides; shapes (n) and (2, n)
        real(qp), allocatable :: softness(:), stiffness(:), limit(:, :)
        !> Stiffness of the support of every node, infinite: rigid, shape (0:n)
        real(wp), allocatable :: support(:)
        type(memory_type), allocatable :: memory(:)
        !> From left to right; and the loads that they are for
        type(cell_type), allocatable :: cells(:)
        type(loads_type) :: loads
        !> To the right, shape (0:n)
        real(qp), allocatable :: displacement(:)
    end type bedding_type

    !> A cell as a bar between its ends: forces there are stiffnesses times displacements, and what is without these
    type :: element_type
        real(qp) :: between, to_ground, without(2)
        !> Displacement as its loads alone make it, a polynomial, and the rate of what its ends add to that
        type(curve_type) :: loaded
        real(qp) :: rate
    end type element_type

contains

    !> Has a bar ground
    pure function is_bedded(bedding, bar) result(it_is)
        type(bedding_type), intent(in) :: bedding
        integer, intent(in) :: bar
        logical :: it_is

        it_is = any(bedding%limit(:, bar) > 0.0_qp)
    end function is_bedded

    !> Displacements of a chain whose cells are known, under its loads
    pure subroutine solve_cells(bedding, lost)
        type(bedding_type), intent(inout) :: bedding
        !> Does nothing hold it
        logical, intent(out) :: lost
        type(element_type) :: element(size(bedding%cells))
        real(qp) :: seen(0:size(bedding%cells)), load(0:size(bedding%cells)), at(0:size(bedding%cells)), share
        logical :: rigid(0:size(bedding%cells))
        integer :: k, m, node

        m = size(bedding%cells)
        seen(:) = 0.0_qp
        load(:) = 0.0_qp
        rigid(:) = .false.
        do k = 1, m
            element(k) = element_of(bedding, bedding%cells(k))
            seen(k - 1:k) = seen(k - 1:k) + element(k)%to_ground
            load(k - 1:k) = load(k - 1:k) + [element(k)%without(1), -element(k)%without(2)]
        end do
        node = 0
        do k = 0, m
            if (k > 0) then
                if (bedding%cells(k)%to < 1.0_qp) cycle
            end if
            load(k) = load(k) + bedding%loads%node(node)
            rigid(k) = bedding%support(node) > huge(1.0_wp)
            if (.not. rigid(k)) seen(k) = seen(k) + bedding%support(node)
            node = node + 1
        end do
        ! From the left, without differences
        do k = 1, m
            if (rigid(k - 1)) then
                seen(k) = seen(k) + element(k)%between
            else
                share = element(k)%between/(element(k)%between + seen(k - 1))
                seen(k) = seen(k) + seen(k - 1)*share
                load(k) = load(k) + load(k - 1)*share
            end if
        end do
        lost = .not. (rigid(m) .or. seen(m) > 0.0_qp)
        if (lost) return
        at(m) = 0.0_qp
        if (.not. rigid(m)) at(m) = load(m)/seen(m)
        do k = m - 1, 0, -1
            at(k) = 0.0_qp
            if (.not. rigid(k)) at(k) = (load(k) + element(k + 1)%between*at(k + 1))/(seen(k) + element(k + 1)%between)
        end do
        node = 0
        bedding%displacement(0) = at(0)
        do k = 1, m
            associate (c => bedding%cells(k), e => element(k))
                c%displacement = new_curve(c%from, c%to, e%loaded%power, e%rate, at(k - 1) - value_of(e%loaded, c%from), &
                                           at(k) - value_of(e%loaded, c%to))
                if (c%to < 1.0_qp) cycle
                node = node + 1
                bedding%displacement(node) = at(k)
            end associate
        end do
    end subroutine solve_cells

    !> A cell as a bar
    pure function element_of(bedding, cell) result(element)
        type(bedding_type), intent(in) :: bedding
        type(cell_type), intent(in) :: cell
        type(element_type) :: element
        real(qp) :: decay, stiff, ends(2), slopes(2)

        associate (j => cell%bar, c => bedding%softness(cell%bar), K => bedding%stiffness(cell%bar), power => &
                   element%loaded%power, p => bedding%loads%along(cell%bar), t => bedding%limit(:, cell%bar))
            element%rate = 0.0_qp
            if (cell%way == 0 .and. is_bedded(bedding, j)) element%rate = sqrt(c*K)
            if (element%rate > 0.0_qp) then
                power(:) = bedding%memory(cell%memory)%slid + [settled_push(bedding, cell)/K, 0.0_qp, 0.0_qp]
                decay = exp(-element%rate*(cell%to - cell%from))
                stiff = element%rate*2*decay/(1 - decay**2)
                element%to_ground = element%rate*(1 - decay)/(1 + decay)/c
            else
                power(:) = [0.0_qp, 0.0_qp, -c*p/2, 0.0_qp]
                if (cell%way /= 0) power(2:) = power(2:) + cell%way*c*[t(1)/2, (t(2) - t(1))/6]
                stiff = 1/(cell%to - cell%from)
                element%to_ground = 0.0_qp
            end if
            element%between = stiff/c
            ends(:) = [value_of(element%loaded, cell%from), value_of(element%loaded, cell%to)]
            slopes(:) = [value_of(derivative(element%loaded), cell%from), value_of(derivative(element%loaded), cell%to)]
            element%without(1) = element%between*(ends(1) - ends(2)) + element%to_ground*ends(1) &
                + (slopes(1) - bedding%loads%longer(j))/c
            element%without(2) = element%between*(ends(1) - ends(2)) - element%to_ground*ends(2) &
                + (slopes(2) - bedding%loads%longer(j))/c
        end associate
    end function element_of

    !> What pushes the ground of a cell to the right as far as its springs are concerned, K (u - s)
    pure function give_way(bedding, cell) result(curve)
        type(bedding_type), intent(in) :: bedding
        type(cell_type), intent(in) :: cell
        type(curve_type) :: curve

        curve = cell%displacement
        curve%power(:) = curve%power - bedding%memory(cell%memory)%slid
        curve = scaled(curve, bedding%stiffness(cell%bar))
        ! Not as a difference: what springs give way where they hold is what the exponentials and the loads do
        if (cell%way == 0) curve%power(:) = [settled_push(bedding, cell), 0.0_qp, 0.0_qp]
    end function give_way

    !> Force of the ground on the beam along a cell over which it slides, to the right
    pure function friction_on(bedding, cell) result(force)
        type(bedding_type), intent(in) :: bedding
        type(cell_type), intent(in) :: cell
        real(qp) :: force

        associate (t => bedding%limit(:, cell%bar))
            force = -cell%way*(cell%to - cell%from)*(t(1) + (t(2) - t(1))*(cell%from + cell%to)/2)
        end associate
    end function friction_on

    !> That far from the ends of cells that are held, where no part pulls at another: coefficients of powers 0 and 1 of the share
    pure function settled_push(bedding, cell) result(power)
        type(bedding_type), intent(in) :: bedding
        type(cell_type), intent(in) :: cell
        real(qp) :: power(2)

        associate (slid => bedding%memory(cell%memory)%slid, c => bedding%softness(cell%bar))
            power(:) = [bedding%loads%along(cell%bar) + 2*slid(2)/c, 6*slid(3)/c]
        end associate
    end function settled_push

    !> Axial force along a cell
    pure function pulling(bedding, cell) result(curve)
        type(bedding_type), intent(in) :: bedding
        type(cell_type), intent(in) :: cell
        type(curve_type) :: curve

        curve = derivative(cell%displacement)
        curve%power(0) = curve%power(0) - bedding%loads%longer(cell%bar)
        curve = scaled(curve, 1/bedding%softness(cell%bar))
    end function pulling

    !> Axial force at a place in a cell
    pure function force_at(bedding, cell, share) result(force)
        type(bedding_type), intent(in) :: bedding
        type(cell_type), intent(in) :: cell
        real(qp), intent(in) :: share
        real(qp) :: force

        force = value_of(pulling(bedding, cell), share)
    end function force_at

end module gapbeam_axial_bedding
