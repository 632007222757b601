!> A beam held where it touches rigid ground, and its solution.
module gapbeam_rigid_held
    use, intrinsic :: ieee_arithmetic, only: ieee_value, ieee_positive_inf
    use gapbeam_kinds, only: wp
    use gapbeam_error, only: error_type, gapbeam_solved
    use gapbeam_band, only: hinge, restrained
    use gapbeam_law, only: both, is_rigid
    use gapbeam_model, only: node_support_type, order_supports
    use gapbeam_workspace, only: new_workspace, set_loads
    use gapbeam_contact_state, only: find_contact_state, outcome_type
    use gapbeam_foundation_taylor, only: transverse_of
    use gapbeam_zone_fields, only: fields_at_ends
    use gapbeam_ground, only: ground_type, grounded_type, place_stretches
    use gapbeam_rigid_contact, only: hold_type, lay_out
    use gapbeam_rigid_state, only: rigid_type, is_zone
    implicit none
    private
    public :: solve_held

contains

    !> Solve the beam held at its contacts
    subroutine solve_held(ground, factor, rule, rigid, closed, outcome, error, start)
        type(ground_type), intent(in) :: ground
        !> Load factor, and rule for the supports (gapbeam_search)
        real(wp), intent(in) :: factor
        integer, intent(in) :: rule
        !> Contacts in; stretches, holds and the solution out. The beam has the holds behind its own supports, but those that a
        !> support stands for. A slope that is known is fixed as by a clamp, while it is solved as zero: the links beside take it in
        type(rigid_type), intent(inout) :: rigid
        !> States of the supports: start in, found out
        logical, intent(inout) :: closed(:)
        type(outcome_type), intent(out) :: outcome
        !> As for find_contact_state
        type(error_type), allocatable, intent(out) :: error
        !> Which contacts touch where the search begins, one hold each; default: all
        logical, intent(in), optional :: start(:)
        logical, allocatable :: acting(:)
        integer, allocatable :: number(:)
        integer :: ns

        call lay_out(ground, rigid%contacts, rigid%zones, rigid%holds, rigid%place)
        call place_stretches(ground, rigid%zones, factor, rigid%grounded)
        ns = size(closed)
        call add_holds(rigid, ns, number)
        allocate (acting(size(rigid%grounded%beam%supports)), source=.true.)
        acting(:ns) = closed
        if (present(start)) acting(ns + 1:) = pack(start, number > 0)
        call new_workspace(rigid%grounded%beam, rigid%work)
        call set_loads(rigid%grounded%beam, factor, rigid%work)
        call find_contact_state(rigid%grounded%beam, factor, rule, acting, rigid%work, outcome, error)
        rigid%solves = rigid%solves + rigid%work%solves
        closed(:) = acting(:ns)
        call read_holds(rigid, factor, acting, ns, number, .not. allocated(error) .and. outcome%status == gapbeam_solved)
    end subroutine solve_held

    !> Holds as supports behind those that the beam has
    subroutine add_holds(rigid, ns, number)
        type(rigid_type), intent(inout) :: rigid
        !> Supports that it has
        integer, intent(in) :: ns
        !> Support for every hold, 0: another one stands for it
        integer, allocatable, intent(out) :: number(:)
        type(node_support_type), allocatable :: supports(:)
        integer :: h, s

        associate (holds => rigid%holds, beam => rigid%grounded%beam)
            allocate (supports(ns + size(holds)), number(size(holds)))
            supports(:ns) = beam%supports
            number(:) = 0
            s = ns
            do h = 1, size(holds)
                if (holds(h)%compliance >= 0.0_wp) call fix_slope(rigid%grounded, holds(h))
                if (stops_before(supports(:ns), holds(h))) cycle
                s = s + 1
                number(h) = s
                supports(s) = node_support_type(holds(h)%border, merge(both, holds(h)%side, holds(h)%follows), &
                                                ieee_value(1.0_wp, ieee_positive_inf), holds(h)%level)
            end do
            call order_supports(supports(:s), beam)
        end associate
    end subroutine add_holds

    !> Do the holds touch, and how do they push
    subroutine read_holds(rigid, factor, acting, ns, number, solved)
        type(rigid_type), intent(inout) :: rigid
        real(wp), intent(in) :: factor
        !> States of all supports; as for add_holds
        logical, intent(in) :: acting(:)
        integer, intent(in) :: ns, number(:)
        logical, intent(in) :: solved
        integer :: h

        if (allocated(rigid%touching)) deallocate (rigid%touching, rigid%push)
        allocate (rigid%touching(size(rigid%holds)), rigid%push(size(rigid%holds)))
        do h = 1, size(rigid%holds)
            associate (hold => rigid%holds(h), touches => rigid%touching(h), push => rigid%push(h))
                if (hold%compliance >= 0.0_wp) call turn_links(rigid%grounded, hold, -1)
                touches = is_held_there(rigid%grounded%beam%supports(:ns), acting, hold)
                push = 0.0_wp
                if (number(h) == 0) cycle
                touches = acting(number(h))
                if (hold%follows .and. solved) then
                    push = balance(rigid, factor, ns, hold%border)
                else if (touches) then
                    push = rigid%work%reaction(number(h))
                end if
            end associate
        end do
    end subroutine read_holds

    !> What is missing for equilibrium at an end of a zone, in which there is no shear, and a transverse force by its axial force
    !> only. What the solution has there is more: where pieces of one line meet, their slopes differ by rounding, which stiff beams
    !> feel
    function balance(rigid, factor, ns, border) result(missing)
        type(rigid_type), intent(in) :: rigid
        real(wp), intent(in) :: factor
        integer, intent(in) :: ns, border
        real(wp) :: missing, transverse(2)
        integer :: k

        associate (beam => rigid%grounded%beam)
            missing = beam%force(1, border) + factor*beam%force(2, border)
            if (border > 0) then
                transverse = forces_of(border)
                missing = missing - transverse(2)
            end if
            if (border < size(rigid%zones%piece)) then
                transverse = forces_of(border + 1)
                missing = missing + transverse(1)
            end if
            do k = 1, ns
                if (beam%supports(k)%node == border) missing = missing - rigid%work%reaction(k)
            end do
        end associate

    contains

        !> Transverse forces at the ends of a stretch
        function forces_of(i) result(forces)
            integer, intent(in) :: i
            real(wp) :: forces(2), rotation(2), shear(2)

            call fields_at_ends(rigid%grounded, factor, rigid%work, i, rotation, shear)
            if (is_zone(rigid, i)) shear(:) = 0.0_wp
            forces = transverse_of(rigid%grounded%stretches(i), [0.0_wp, 1.0_wp], rotation, shear)
        end function forces_of

    end function balance

    !> Does a rigid support hold the beam just where the ground is
    pure function is_held_there(supports, acting, hold) result(held)
        type(node_support_type), intent(in) :: supports(:)
        logical, intent(in) :: acting(:)
        type(hold_type), intent(in) :: hold
        logical :: held

        held = any(supports%node == hold%border .and. is_rigid(supports) .and. acting(:size(supports)) .and. &
                   supports%side /= -hold%side .and. .not. abs(supports%contact - hold%level) > 0.0_wp)
    end function is_held_there

    !> Does a rigid support stop the beam there before the ground does, or where that does
    pure function stops_before(supports, hold) result(does)
        type(node_support_type), intent(in) :: supports(:)
        type(hold_type), intent(in) :: hold
        logical :: does

        does = any(supports%node == hold%border .and. is_rigid(supports) .and. (supports%side == both .or. &
                   (supports%side == hold%side .and. hold%side*(supports%contact - hold%level) <= 0.0_wp)))
    end function stops_before

    !> Fix the slope where a zone begins or ends, and reckon rotations from it. At a single place a spring turns the beam there:
    !> where a push P goes on by a way e, that is a couple P e, and the slope beside the ground changes by the curvature times e. So
    !> the couple over P is how far the place has to go (Newton's method)
    pure subroutine fix_slope(grounded, hold)
        type(grounded_type), intent(inout) :: grounded
        type(hold_type), intent(in) :: hold

        call turn_links(grounded, hold, 1)
        associate (beam => grounded%beam, i => hold%border)
            if (beam%kind(i) == hinge) return
            beam%kind(i) = restrained
            beam%compliance(i) = hold%compliance
        end associate
    end subroutine fix_slope

    !> Let the links beside a border take in the slope there, or give it back
    pure subroutine turn_links(grounded, hold, way)
        type(grounded_type), intent(inout) :: grounded
        type(hold_type), intent(in) :: hold
        !> 1, or -1
        integer, intent(in) :: way

        associate (links => grounded%beam%links, i => hold%border)
            if (grounded%beam%kind(i) == hinge) return
            if (i > 0) links(i)%turn_b(1) = links(i)%turn_b(1) + way*hold%slope
            if (i < size(links)) links(i + 1)%turn_a(1) = links(i + 1)%turn_a(1) - way*hold%slope
        end associate
    end subroutine turn_links

end module gapbeam_rigid_held
