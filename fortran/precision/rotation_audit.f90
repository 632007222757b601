!> Audit of supports that hold rotations: their laws, the couples with which they do, and the moments that pass by them.
!>
!> What a support makes of its node (gapbeam_turning) is not used: rotations are those of the ends of the links beside the node, and
!> where a hinge has no law of its own, no moment passes it.
module gapbeam_rotation_audit
    use gapbeam_kinds, only: wp
    use gapbeam_nodes, only: is_hinge
    use gapbeam_law, only: force_by_spring
    use gapbeam_law_margins, only: margin_in_scheme, is_watched_in
    use gapbeam_model, only: beam_type, of_node, left_of_hinge, is_of_hinge
    use gapbeam_ledger, only: ledger_type, note, of_bending, of_equilibrium, of_supports, rotations, moments, beyond, pulls
    implicit none
    private
    public :: turned_type, ends_type, find_turned, audit_rotations

    !> A rotation that supports hold, as it was found
    type :: turned_type
        !> The rotation, and the size of its terms
        real(wp) :: rotation = 0.0_wp, rotation_size = 0.0_wp
        !> Of the terms of the couple, and what else may be missing of that where supports give none
        real(wp) :: couple_size = 0.0_wp, left_out = 0.0_wp
    end type turned_type

    !> What ends at a node
    type :: ends_type
        !> Rotations of what is left and right of it, and the size of their terms
        real(wp) :: rotation(2) = 0.0_wp, rotation_size = 0.0_wp
        !> Moments left and right of it, the couple that acts there, and the size of the terms
        real(wp) :: moment(2) = 0.0_wp, couple = 0.0_wp, moment_size = 0.0_wp
        !> Is there something left and right
        logical :: is_there(2) = .false.
    end type ends_type

contains

    !> The rotations of every node that supports hold
    pure subroutine find_turned(beam, numbers)
        type(beam_type), intent(in) :: beam
        !> That of the hinge and that of the node or of one side of it, as numbers in beam%turning, 0: none, shape (2, 0:n)
        integer, allocatable, intent(out) :: numbers(:, :)
        integer :: j

        allocate (numbers(2, 0:size(beam%links)), source=0)
        if (.not. allocated(beam%turning)) return
        do j = 1, size(beam%turning)
            numbers(merge(1, 2, is_of_hinge(beam%turned(j))), beam%turning(j)) = j
        end do
    end subroutine find_turned

    !> Do moments balance at a node whose rotations supports hold, do its ends turn as they are held, and is every support on its
    !> law, in the right state
    subroutine audit_rotations(beam, node, numbers, closed, undecided, leeway, ends, turned, reaction, ledger)
        type(beam_type), intent(in) :: beam
        !> The node, and its rotations by find_turned
        integer, intent(in) :: node, numbers(2)
        !> The scheme, and which supports may have either state, shape (m)
        logical, intent(in) :: closed(:), undecided(:)
        !> So many times rounding signs may be wrong
        real(wp), intent(in) :: leeway
        !> The beam beside the node
        type(ends_type), intent(in) :: ends
        !> All rotations that supports hold, shape (r), and what supports give, shape (m)
        type(turned_type), intent(in) :: turned(:)
        real(wp), intent(in) :: reaction(:)
        type(ledger_type), intent(inout) :: ledger
        real(wp) :: errors(size(closed))
        integer :: held, at

        at = max(node, 1)
        held = of_node
        if (numbers(2) > 0) held = beam%turned(numbers(2))
        associate (m => ends%moment, turns => ends%rotation)
            if (numbers(2) == 0) then
                call balance((m(1) - m(2)) + ends%couple)
            else
                call audit_one(numbers(2), merge(turns(1), turns(2), held == left_of_hinge .or. .not. ends%is_there(2)), &
                               (m(1) - m(2)) + ends%couple)
            end if
            if (numbers(1) > 0) then
                call audit_one(numbers(1), turns(1) - turns(2), merge(m(2), m(1), held == left_of_hinge))
            else if (is_hinge(beam%kind(node))) then
                call balance(merge(m(2), m(1), held == left_of_hinge))
            else if (all(ends%is_there)) then
                call note(ledger, of_bending, rotations, turns(2) - turns(1), ends%rotation_size, at, 0.0_wp)
            end if
        end associate

    contains

        !> Note what is left over of moments
        subroutine balance(rest)
            real(wp), intent(in) :: rest

            call note(ledger, of_equilibrium, moments, rest, ends%moment_size, at, 0.0_wp)
        end subroutine balance

        !> The supports of one rotation
        subroutine audit_one(j, rotation, couple)
            !> Its number
            integer, intent(in) :: j
            !> As the ends of the links have them
            real(wp), intent(in) :: rotation, couple
            real(wp) :: terms
            integer :: s

            associate (found => turned(j), first => beam%first(size(beam%links) + j), &
                       last => beam%first(size(beam%links) + j + 1) - 1)
                terms = found%couple_size
                if (.not. abs(sum(reaction(beam%order(first:last)))) > 0.0_wp) terms = terms + found%left_out
                call note(ledger, of_bending, rotations, found%rotation - rotation, found%rotation_size + ends%rotation_size, &
                          at, 0.0_wp)
                call note(ledger, of_equilibrium, moments, couple - sum(reaction(beam%order(first:last))), &
                          terms + sum(abs(reaction(beam%order(first:last)))), at, 0.0_wp)
                errors(beam%order(first:last)) = epsilon(1.0_wp)*terms
                do s = first, last
                    call audit_law(beam%order(s), found, terms)
                end do
            end associate
        end subroutine audit_one

        !> One of the supports
        subroutine audit_law(k, found, terms)
            integer, intent(in) :: k
            type(turned_type), intent(in) :: found
            !> Of the couple
            real(wp), intent(in) :: terms
            real(wp) :: force, rounding, margin
            logical :: acts, rigid, by_force

            associate (supports => beam%supports)
                call force_by_spring(supports, closed, k, found%rotation, found%rotation_size, acts, rigid, force, rounding)
                if (acts .and. rigid) then
                    call note(ledger, of_supports, rotations, found%rotation - supports(k)%contact, &
                              found%rotation_size + abs(supports(k)%contact), at, 0.0_wp)
                else
                    call note(ledger, of_supports, moments, reaction(k) - force, terms + rounding/epsilon(1.0_wp), at, 0.0_wp)
                end if
                if (undecided(k) .or. .not. is_watched_in(supports, closed, k)) return
                ! A breakpoint that is none: either state is right
                if (supports(k)%breakpoint > 0 .and. .not. abs(supports(k)%stiffness - supports(k)%before) > 0.0_wp) return
                call margin_in_scheme(supports, closed, k, found%rotation, found%rotation_size, reaction, errors, margin, &
                                      rounding, by_force)
                if (margin < 0.0_wp) call note(ledger, of_supports, merge(pulls, beyond, by_force), margin, &
                                               leeway*merge(terms, rounding/epsilon(1.0_wp), by_force), at, 0.0_wp)
            end associate
        end subroutine audit_law

    end subroutine audit_rotations

end module gapbeam_rotation_audit
