!> Quantities along the beam, declared once: number, words, unit, and how each comes from the state of a section.
!>
!> The state is deflection, rotation, moment and shear. A derived quantity is a sum of shares of these and of the imposed
!> curvature; shares are the same all along a piece. So values, extremes, cases side by side and trains follow from the shares.
!> Python has the same list in gapbeam/engine/quantities.py.
module gapbeam_quantities
    use gapbeam_kinds, only: wp
    implicit none
    private
    public :: of_deflection, of_rotation, of_moment, of_shear, of_axial_force, of_axial_displacement, of_pressure, of_curvature, &
        of_transverse
    public :: quantity_count, state_count, derived_count, bending_count, bounded_count, bending, quantity_names, &
        quantity_remedies, quantity_units, needs_axial, needs_ground
    public :: shares_of, terms_of_derived, with_derived

    !> Numbers of the quantities, which stay: callers from C and Fortran 77 ask by them. New ones come at the end
    integer, parameter :: of_deflection = 1, of_rotation = 2, of_moment = 3, of_shear = 4, of_axial_force = 5, &
        of_axial_displacement = 6, of_pressure = 7, of_curvature = 8, of_transverse = 9
    integer, parameter :: quantity_count = 9

    !> Those of every beam, in the order of arrays of bending: first the state, then what is derived from it
    integer, parameter :: bending(*) = [of_deflection, of_rotation, of_moment, of_shear, of_curvature]
    integer, parameter :: bending_count = size(bending), state_count = 4, derived_count = bending_count - state_count
    !> The first so many of these have error bounds
    integer, parameter :: bounded_count = state_count

    !> Those that a beam has with axial loads, and on the ground
    integer, parameter :: needs_axial(*) = [of_axial_force, of_axial_displacement], needs_ground(*) = [of_pressure]

    character(len=*), parameter :: quantity_names(quantity_count) = [character(len=24) :: &
        "deflection", "rotation", "moment", "shear", "axial force", "axial displacement", "pressure of the ground", "curvature", &
        "transverse force"]
    !> What helps where the numbers are too great
    character(len=*), parameter :: quantity_remedies(quantity_count) = [character(len=40) :: &
        "choose a greater unit of length", "give a stiffer beam or smaller loads", "choose a greater unit of force", &
        "choose a greater unit of force", "choose a greater unit of force", "choose a greater unit of length", &
        "choose a greater unit of force", "choose a smaller unit of length", "choose a greater unit of force"]
    !> Units: powers of force, length, deflection
    integer, parameter :: quantity_units(3, quantity_count) = reshape([ &
        0, 0, 1, &
        0, -1, 1, &
        1, 1, 0, &
        1, 0, 0, &
        1, 0, 0, &
        0, 0, 1, &
        1, -1, 0, &
        0, -2, 1, &
        1, 0, 0], [3, quantity_count])

contains

    !> Shares of deflection, rotation, moment, shear and imposed curvature in the derived quantities, all along a piece; they do not
    !> get smaller where 1/EI or 1/GA gets larger
    pure function shares_of(softness) result(share)
        !> 1/EI and 1/GA of the piece
        real(wp), intent(in) :: softness(2)
        real(wp) :: share(state_count + 1, derived_count)

        share(:, :) = 0.0_wp
        ! Curvature, with the sign of the moment, -psi': M/EI less what is imposed
        share(of_moment, 1) = softness(1)
        share(state_count + 1, 1) = -1.0_wp
    end function shares_of

    !> Which of deflection, rotation, moment, shear the derived quantities are made of, shape (state_count, derived_count)
    pure function terms_of_derived() result(are_terms)
        logical :: are_terms(state_count, derived_count)
        real(wp) :: share(state_count + 1, derived_count)

        share(:, :) = shares_of([1.0_wp, 1.0_wp])
        are_terms(:, :) = abs(share(1:state_count, :)) > 0.0_wp
    end function terms_of_derived

    !> The state, followed by the derived quantities
    pure function with_derived(state, softness, kappa) result(values)
        !> Deflection, rotation, moment, shear
        real(wp), intent(in) :: state(state_count)
        !> 1/EI, 1/GA, and the curvature imposed on the piece
        real(wp), intent(in) :: softness(2), kappa
        real(wp) :: values(bending_count), share(state_count + 1, derived_count)
        integer :: d, k

        values(1:state_count) = state
        share(:, :) = shares_of(softness)
        do d = 1, derived_count
            values(state_count + d) = 0.0_wp
            do k = 1, state_count
                ! No share of what may be no number is nothing
                if (abs(share(k, d)) > 0.0_wp) values(state_count + d) = values(state_count + d) + share(k, d)*state(k)
            end do
            values(state_count + d) = values(state_count + d) + share(state_count + 1, d)*kappa
        end do
    end function with_derived

end module gapbeam_quantities
