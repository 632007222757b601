!> Where the path on smooth laws turns round, comes to a load factor, begins to give way, or passes an end of another support's
!> piece: roots of functions of the place along an arc.
module gapbeam_arc_roots
    use gapbeam_kinds, only: wp
    use gapbeam_path_tolerances, only: arc_settled, no_zero, longest_beyond, farthest_beyond
    use gapbeam_error, only: error_type
    use gapbeam_polyline, only: last_breakpoint
    use gapbeam_smooth_arc, only: arc_type, or_one, lose, is_lost
    use gapbeam_arc_states, only: find_on_arc, eigenvalues_at
    implicit none
    private
    public :: arc_test_type, of_factor, of_rate, of_eigenvalue, of_breakpoint, test_value, find_root, find_roots

    !> What is zero: the load factor less a given one; its rate along the arc; an eigenvalue of the tangent stiffness; how far a
    !> support is from an end of its piece
    integer, parameter :: of_factor = 1, of_rate = 2, of_eigenvalue = 3, of_breakpoint = 4
    !> Intervals between two states at whose ends signs are compared
    integer, parameter :: intervals = 16

    !> A function of the place along an arc
    type :: arc_test_type
        integer :: kind = of_factor
        !> The eigenvalue, in ascending order, or the support of the engine
        integer :: number = 0
        !> The load factor that is given; or of that support the end of its piece, in the engine's units, and whether the force
        !> tells how far it is
        real(wp) :: level = 0.0_wp, force = 0.0_wp
        logical :: by_force = .false.
    end type arc_test_type

contains

    !> Value of a function at a state
    subroutine test_value(arc, test, number, value, error)
        type(arc_type), intent(in) :: arc
        type(arc_test_type), intent(in) :: test
        !> Of a state of the arc
        integer, intent(in) :: number
        real(wp), intent(out) :: value
        !> As for eigenvalues_at
        type(error_type), allocatable, intent(out) :: error
        real(wp), allocatable :: values(:)

        value = 0.0_wp
        associate (found => arc%known(number)%one)
            select case (test%kind)
            case (of_factor)
                value = found%point(size(found%point)) - test%level
            case (of_rate)
                value = found%rate(size(found%rate))
            case (of_eigenvalue)
                allocate (values(size(found%slope)))
                call eigenvalues_at(arc, found%slope, values, error)
                value = values(test%number)
            case default
                value = distance()
            end select
        end associate

    contains

        !> How far a support is from the end of its piece, as a share of the largest reaction or deflection
        pure function distance()
            real(wp) :: distance
            integer :: first, side

            associate (state => arc%known(number)%one%state, support => arc%assembled%normal(test%number))
                if (test%by_force) then
                    first = arc%assembled%beam_support(support)
                    side = arc%assembled%model%supports(support)%side
                    distance = merge(1, side, side == 0)*sum(state%reaction(first:last_breakpoint(arc%laws, first))) - test%force
                    distance = distance/or_one(maxval(abs(state%reaction)))
                else
                    distance = state%deflection(arc%laws(test%number)%node) - test%level
                    distance = distance/or_one(maxval(abs(state%deflection)))
                end if
            end associate
        end function distance

    end subroutine test_value

    !> Find a state, and the value of a function there
    subroutine look(arc, test, place, number, value, error)
        type(arc_type), intent(inout) :: arc
        type(arc_test_type), intent(in) :: test
        real(wp), intent(in) :: place
        integer, intent(out) :: number
        real(wp), intent(out) :: value
        !> There is none
        type(error_type), allocatable, intent(out) :: error

        value = 0.0_wp
        call find_on_arc(arc, place, number, error)
        if (.not. allocated(error)) call test_value(arc, test, number, value, error)
    end subroutine look

    !> Find where a function is zero, near the two states
    subroutine find_root(arc, test, least, most, first, number, error)
        type(arc_type), intent(inout) :: arc
        type(arc_test_type), intent(in) :: test
        !> Places beyond which not to look, and the one at which to begin
        real(wp), intent(in) :: least, most, first
        !> Of the state
        integer, intent(out) :: number
        !> Nowhere
        type(error_type), allocatable, intent(out) :: error
        real(wp), allocatable :: places(:), values(:)
        real(wp) :: low, high, beyond, step, length
        logical :: done

        low = least
        high = most
        number = 0
        allocate (places(0), values(0))
        done = .false.
        call try_place(first)
        call try_place(1.0_wp)
        ! Beyond the two states, farther and farther
        length = sqrt(arc%length)
        beyond = 0.0_wp
        step = 0.25_wp
        do while (.not. done .and. beyond*length < max(farthest_beyond, 4*length))
            beyond = beyond + step
            call try_place(1 + beyond)
            call try_place(-beyond)
            step = max(min(2*step, longest_beyond/length), 0.25_wp)
        end do
        if (.not. done) call lose(error)

    contains

        !> Look at a place, and between it and those next to it that were looked at
        subroutine try_place(place)
            real(wp), intent(in) :: place
            real(wp) :: value
            integer :: k

            if (done .or. place < low .or. place > high) return
            call look(arc, test, place, number, value, error)
            if (is_lost(error)) then
                deallocate (error)
                if (place > 0.5_wp) high = place
                if (.not. place > 0.5_wp) low = place
                return
            end if
            done = allocated(error) .or. .not. abs(value) > 0.0_wp
            if (done) return
            k = count(places < place)
            if (k > 0) done = values(k)*value < 0.0_wp
            if (done) then
                call find_between(arc, test, places(k), place, number, error)
                return
            end if
            if (k < size(places)) done = value*values(k + 1) < 0.0_wp
            if (done) then
                call find_between(arc, test, place, places(k + 1), number, error)
                return
            end if
            places = [places(:k), place, places(k + 1:)]
            values = [values(:k), value, values(k + 1:)]
        end subroutine try_place

    end subroutine find_root

    !> Find all places between the two states where a function is zero
    subroutine find_roots(arc, test, numbers, error)
        type(arc_type), intent(inout) :: arc
        type(arc_test_type), intent(in) :: test
        !> Of the states, in their order
        integer, allocatable, intent(out) :: numbers(:)
        !> The path is not there all along
        type(error_type), allocatable, intent(out) :: error
        real(wp) :: values(0:intervals)
        integer :: states(0:intervals), number, k

        allocate (numbers(0))
        do k = 0, intervals
            call look(arc, test, real(k, wp)/intervals, states(k), values(k), error)
            if (allocated(error)) return
        end do
        associate (a => arc%known(states(intervals - 1))%one, b => arc%known(states(intervals))%one)
            ! No path from one to the other
            if (maxval(abs((a%point + (b%at - a%at)*a%rate - b%point)/arc%weights)) > longest_beyond) call lose(error)
        end associate
        if (allocated(error)) return
        do k = 1, intervals
            if (.not. values(k - 1)*values(k) < 0.0_wp) cycle
            call find_between(arc, test, real(k - 1, wp)/intervals, real(k, wp)/intervals, number, error)
            if (is_lost(error)) then
                ! At the end of a law the sign may change without a zero
                deallocate (error)
                cycle
            end if
            if (allocated(error)) return
            numbers = [numbers, number]
        end do
    end subroutine find_roots

    !> Find where a function is zero between two places at which it has not the same sign (Chandrupatla, Advances in Engineering
    !> Software 28, 1997)
    subroutine find_between(arc, test, from, to, number, error)
        type(arc_type), intent(inout) :: arc
        type(arc_test_type), intent(in) :: test
        real(wp), intent(in) :: from, to
        integer, intent(out) :: number
        !> No zero, but another path, or none
        type(error_type), allocatable, intent(out) :: error
        real(wp) :: a, b, c, at_a, at_b, at_c, share, most, place, value, best, least, x, y

        a = to
        b = from
        call look(arc, test, a, number, at_a, error)
        if (.not. allocated(error)) call look(arc, test, b, number, at_b, error)
        if (allocated(error)) return
        share = 0.5_wp
        most = max(abs(at_a), abs(at_b))
        do
            place = a + share*(b - a)
            call look(arc, test, place, number, value, error)
            if (allocated(error)) return
            if ((value > 0.0_wp) .eqv. (at_a > 0.0_wp)) then
                c = a
                at_c = at_a
            else
                c = b
                at_c = at_b
                b = a
                at_b = at_a
            end if
            a = place
            at_a = value
            best = merge(a, b, abs(at_a) < abs(at_b))
            least = 1.0_wp
            if (abs(b - a) > 0.0_wp) least = arc_settled*max(abs(best), 1.0_wp)/abs(b - a)
            if (least > 0.5_wp .or. .not. abs(at_a) > 0.0_wp .or. .not. abs(at_b) > 0.0_wp) exit
            x = (a - b)/(c - b)
            y = (at_a - at_b)/(at_c - at_b)
            share = 0.5_wp
            if (y*y < x .and. (1 - y)**2 < 1 - x) then
                share = at_a/(at_b - at_a)*at_c/(at_b - at_c) + (c - a)/(b - a)*at_a/(at_c - at_a)*at_b/(at_c - at_b)
            end if
            share = min(max(share, least), 1 - least)
        end do
        if (min(abs(at_a), abs(at_b)) > no_zero*most) then
            call lose(error)
            return
        end if
        if (.not. abs(at_b) > 0.0_wp) best = b
        if (.not. abs(at_a) > 0.0_wp) best = a
        call find_on_arc(arc, best, number, error)
    end subroutine find_between

end module gapbeam_arc_roots
