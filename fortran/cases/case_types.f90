!> Numbers and solutions of many cases of one beam: columns that belong to the caller.
!> What is null is not asked for, or as it is in the beam.
module gapbeam_case_types
    use gapbeam_kinds, only: wp
    implicit none
    private
    public :: case_numbers_type, case_solutions_type, remaining

    !> The numbers of cases. Contiguous, as compilers would copy all cases before they handed them on
    type :: case_numbers_type
        !> Factor of every load, shape (at least nload, ncase)
        real(wp), pointer, contiguous :: factors(:, :) => null()
        !> Settlement, gap and stiffness of every support of the scene, none of which has a law, shape (3, at least nsupport, ncase)
        real(wp), pointer, contiguous :: supports(:, :, :) => null()
        !> EI and GA of every span, shape (2, at least nspan, ncase)
        real(wp), pointer, contiguous :: spans(:, :, :) => null()
        !> Modulus of every foundation, negative: its own; shape (at least nfoundation, ncase)
        real(wp), pointer, contiguous :: moduli(:, :) => null()
        !> rule_block or rule_single of gapbeam_search
        integer :: rule = 0
    end type case_numbers_type

    !> The solutions of cases, in the scene's units
    type :: case_solutions_type
        !> Start of the search in, contact state out, 1 closed; shape (at least size(beam%supports), ncase): what is beyond stays
        integer, pointer, contiguous :: closed(:, :) => null()
        !> Deflections, moments left and right of the nodes, shape (n + 1, ncase)
        real(wp), pointer, contiguous :: w(:, :) => null(), ml(:, :) => null(), mr(:, :) => null()
        !> Forces on the beam, shape as of closed
        real(wp), pointer, contiguous :: reaction(:, :) => null()
        !> Linear solves; gapbeam_solved, gapbeam_no_equilibrium or the code of an error
        integer, pointer, contiguous :: solves(:) => null(), status(:) => null()
    end type case_solutions_type

contains

    !> Which cases are left
    pure function remaining(done) result(which)
        !> Which are done
        logical, intent(in) :: done(:)
        integer, allocatable :: which(:)
        integer :: i

        which = pack([(i, i=1, size(done))], .not. done)
    end function remaining

end module gapbeam_case_types
