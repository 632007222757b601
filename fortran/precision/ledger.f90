!> Record of an audit: imbalances of sums that ought to be zero, in roundings of their terms.
module gapbeam_ledger
    use gapbeam_kinds, only: wp
    use gapbeam_tolerances, only: audit_allows
    implicit none
    private
    public :: ledger_type, note, words_for
    public :: of_bending, of_equilibrium, of_parts, of_resultants, of_zone_ends, of_contact, of_supports, of_restraints, of_places
    public :: deflections, rotations, moments, forces, beyond, pulls, kinds

    !> What may be wrong
    integer, parameter :: of_bending = 1, of_equilibrium = 2, of_parts = 3, of_resultants = 4, of_zone_ends = 5, of_contact = 6, &
                          of_supports = 7, of_restraints = 8, of_places = 9
    !> The same in words that follow "at x = ..."
    character(len=*), parameter :: words_for(of_places) = [character(len=72) :: &
        "deflection and rotation do not fit the moments", &
        "forces or moments do not balance", &
        "forces or moments of the part of the beam left of it do not balance", &
        "the pressure of the ground does not add up to its force", &
        "a zone of the ground does not end where the beam leaves it", &
        "the ground is not in the state that the deflection asks for", &
        "a support is not on its law", &
        "a rotational restraint is not on its law", &
        "stretches do not cover the beam"]
    !> Of what something can be left over: of each of them the most is kept; beyond: distance past the line at which a state
    !> ends; pulls: force of a support that ought to push
    integer, parameter :: deflections = 1, rotations = 2, moments = 3, forces = 4, beyond = 5, pulls = 6, kinds = 6

    !> The notes
    type :: ledger_type
        !> What is wrong most, 0: nothing; in which piece of the beam, and how far from its left end
        integer :: wrong = 0, piece = 0
        real(wp) :: distance = 0.0_wp
        !> The most that is left over, in roundings of the terms
        real(wp) :: excess = 0.0_wp
        !> The same of every kind
        real(wp) :: excesses(kinds) = 0.0_wp
    end type ledger_type

contains

    !> Note what is left over of a sum
    pure subroutine note(ledger, what, kind, left, terms, piece, distance)
        type(ledger_type), intent(inout) :: ledger
        !> What is wrong if it is too much; deflections, rotations, ..., 0: of no kind
        integer, intent(in) :: what, kind
        !> What is left over, and the sizes of the terms together
        real(wp), intent(in) :: left, terms
        !> Where
        integer, intent(in) :: piece
        real(wp), intent(in) :: distance
        real(wp) :: excess

        if (abs(left) <= 0.0_wp) return
        excess = huge(excess)
        if (abs(left) < huge(left)*epsilon(left)*min(terms, 1.0_wp)) excess = abs(left)/(epsilon(left)*terms)
        if (kind > 0) ledger%excesses(kind) = max(ledger%excesses(kind), excess)
        if (excess <= ledger%excess) return
        ledger%excess = excess
        if (excess <= audit_allows) return
        ledger%wrong = what
        ledger%piece = piece
        ledger%distance = distance
    end subroutine note

end module gapbeam_ledger
