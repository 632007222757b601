!> Tension that deflections make in a beam held along its axis at two places (cable effect).
!>
!> A bar whose axis is at the slope w' is longer by int w'**2/2 (slopes are small). Between two supports along the axis its tension
!> follows from the sum of that, and falls with it: e(N) = N int 1/EA - int w'**2/2 - what makes it longer otherwise = 0 grows with
!> N (the derivative of the least energy by N is int w'**2/2). The sum of a state, over the one assumed, is a power of that wherever
!> the beam is a cable or stiff, so its root is found in logarithms, by secants.
module gapbeam_stretching
    use gapbeam_kinds, only: wp
    use gapbeam_limits, only: most_stretchings
    use gapbeam_path_tolerances, only: narrow_bracket, clear_jump
    use gapbeam_quadrature, only: panels_type, cut_into_panels, points_of, most_points
    use gapbeam_element, only: field_type
    use gapbeam_ground_solution, only: ground_solution_type
    use gapbeam_ground_fields, only: inside_type, prepare_inside, field_inside
    use gapbeam_stretch_audit, only: rates_of, least_rate
    use gapbeam_scene, only: gapbeam_axial
    use gapbeam_assembled_model, only: assembled_type
    use gapbeam_axial_tension, only: tensions_of_loads
    use gapbeam_ground_query, only: stretch_of
    implicit none
    private
    public :: stretching_type, lengthening, lengthening_to, begin_stretching, bound_stretching, guess_stretching

    !> A search for the sum
    type :: stretching_type
        !> Of the bars, in the units of the axial system, shape (n): at first all in one bar, as tensions are those of the sum; that
        !> of the state found at the end
        real(wp), allocatable :: stretched(:)
        !> First and last bar between the two supports
        integer :: first = 1, last = 0
        !> Is the search over; is the sum of the last state another one than was assumed; is there no state, however great the sum
        logical :: ends = .false., jumps = .false., fails = .false.
        integer, private :: number = 0
        !> Logarithms of the least sum that is too great, of the greatest that is too small, and of the next guess
        real(wp), private :: high = 0.0_wp, low = 0.0_wp, guess = 0.0_wp
        logical, private :: has_high = .false., has_low = .false., has_last = .false., slow = .false.
        !> Logarithms of the last sum with a state, of what that had over it, and how long the bracket was some steps ago
        real(wp), private :: last_at = 0.0_wp, last_excess = 0.0_wp, width = huge(1.0_wp)
        !> A sum to begin with where a beam has no state without one, and one that is too small, 0: not known
        real(wp), private :: first_guess = 0.0_wp, least_guess = 0.0_wp
        !> Logarithm of the length of the beam: slopes are no longer small
        real(wp), private :: most = 0.0_wp
    end type stretching_type

contains

    !> By what the deflections of a state lengthen every bar of the axial system, each of which is a piece of the beam, in its units
    pure function lengthening(assembled, solution) result(longer)
        type(assembled_type), intent(in) :: assembled
        type(ground_solution_type), intent(in) :: solution
        real(wp) :: longer(size(assembled%pieces))
        integer :: i

        longer(:) = 0.0_wp
        do i = 1, size(solution%piece)
            associate (j => solution%piece(i))
                longer(j) = longer(j) + of_stretch(assembled, solution, i, 1.0_wp)
            end associate
        end do
    end function lengthening

    !> The same of a part of a piece
    pure function lengthening_to(assembled, solution, piece, distance) result(longer)
        type(assembled_type), intent(in) :: assembled
        type(ground_solution_type), intent(in) :: solution
        !> The piece, and how far the part goes from its left end, in the engine's units
        integer, intent(in) :: piece
        real(wp), intent(in) :: distance
        real(wp) :: longer
        integer :: i

        longer = 0.0_wp
        do i = stretch_of(solution, piece, 0.0_wp), size(solution%piece)
            if (solution%piece(i) /= piece .or. solution%from(i) >= distance) exit
            longer = longer + of_stretch(assembled, solution, i, min(1.0_wp, (distance - solution%from(i)) &
                                                                     /(solution%to(i) - solution%from(i))))
        end do
    end function lengthening_to

    !> The same of a stretch, to a share of its length
    pure function of_stretch(assembled, solution, i, share) result(longer)
        type(assembled_type), intent(in) :: assembled
        type(ground_solution_type), intent(in) :: solution
        integer, intent(in) :: i
        real(wp), intent(in) :: share
        real(wp) :: longer
        type(inside_type) :: inside
        type(field_type) :: field
        type(panels_type) :: panels
        real(wp) :: rate(2), fade(2), points(most_points), weights(most_points)
        integer :: number, p, t

        associate (j => solution%piece(i), s => solution%stretches(i))
            associate (layers => assembled%layers(assembled%layer_first(j):assembled%layer_first(j + 1) - 1))
                call prepare_inside(layers, assembled%law_pieces, assembled%pieces(j)%length, solution, i, inside)
            end associate
            call rates_of(solution, i, rate, fade)
            ! Squares change and fade twice as fast; of slopes under a linear load they have degree 8
            call cut_into_panels(max(2*share*rate, least_rate), 2*share*fade, panels)
            longer = 0.0_wp
            do p = 1, panels%number
                call points_of(panels, p, number, points, weights)
                do t = 1, number
                    call field_inside(inside, share*points(t), field)
                    longer = longer + weights(t)*(field%rotation + s%shear_flexibility*field%shear)**2
                end do
            end do
            longer = scale(longer*share*s%length/2, 2*assembled%units%deflection - assembled%units%length &
                           - assembled%axial%units%deflection)
        end associate
    end function of_stretch

    !> Begin the search
    pure subroutine begin_stretching(assembled, stretching)
        !> Held along its axis at two places, every piece a bar
        type(assembled_type), intent(in) :: assembled
        type(stretching_type), intent(out) :: stretching
        integer :: held(2), k, n

        held = 0
        n = 0
        do k = 1, size(assembled%model%supports)
            if (assembled%model%supports(k)%direction /= gapbeam_axial) cycle
            n = n + 1
            if (n <= 2) held(n) = assembled%axial%node(k)
        end do
        stretching%first = minval(held) + 1
        stretching%last = maxval(held)
        allocate (stretching%stretched(size(assembled%axial%flexibility)), source=0.0_wp)
        ! Slopes of a millionth
        stretching%first_guess = scale(1e-12_wp*sum(assembled%pieces%length), assembled%units%length &
                                       - assembled%axial%units%deflection)
        stretching%most = log(1e12_wp*stretching%first_guess)
    end subroutine begin_stretching

    !> Take it that a beam without stretching buckles: sums below which it does, and with which nothing presses it
    pure subroutine bound_stretching(assembled, factor, share, stretching)
        type(assembled_type), intent(in) :: assembled
        !> Load factor, and share of its axial forces that the beam bears
        real(wp), intent(in) :: factor, share
        type(stretching_type), intent(inout) :: stretching
        real(wp), dimension(2, size(assembled%pieces)) :: without, with
        real(wp) :: pressed, softer
        integer :: j

        associate (s => stretching)
            without(:, :) = tensions_of_loads(assembled)
            s%stretched(s%first) = 1.0_wp
            with(:, :) = tensions_of_loads(assembled, s%stretched)
            s%stretched(s%first) = 0.0_wp
            j = s%first - 1 + minloc(without(1, s%first:s%last) + factor*without(2, s%first:s%last), 1)
            pressed = -(assembled%pieces(j)%tension + without(1, j) + factor*without(2, j))
            softer = with(1, j) - without(1, j)
            if (.not. (pressed > 0.0_wp .and. softer > 0.0_wp .and. share < 1.0_wp)) return
            s%least_guess = (1 - share)*pressed/softer
            s%first_guess = pressed/softer
        end associate
    end subroutine bound_stretching

    !> Take a state, and guess the next sum, or end
    pure subroutine guess_stretching(stretching, found)
        !> With the sum that was assumed for it in, the next one out, or that of the state
        type(stretching_type), intent(inout) :: stretching
        !> By what its deflections lengthen the bars; none where the beam has no state, so that it has to be pulled more
        real(wp), intent(in), optional :: found(:)
        real(wp) :: assumed, sum_found, excess

        associate (s => stretching)
            s%number = s%number + 1
            assumed = sum(s%stretched)
            if (.not. present(found)) then
                s%ends = s%number >= most_stretchings
                s%fails = s%ends .or. (s%has_low .and. .not. s%has_high .and. s%low > s%most)
                s%ends = s%fails
                if (assumed > 0.0_wp) then
                    s%has_low = .true.
                    s%low = log(assumed)
                    call choose_next(s, .false.)
                else
                    s%has_low = s%least_guess > 0.0_wp
                    if (s%has_low) s%low = log(s%least_guess)
                    s%stretched(s%first) = s%first_guess
                end if
                return
            end if
            sum_found = sum(found(s%first:s%last))
            if (.not. assumed > 0.0_wp) then
                ! More than that it is not, as what pulls makes deflections less
                s%ends = .not. sum_found > 0.0_wp
                s%stretched(s%first) = sum_found
                if (s%ends) s%stretched(:) = found
                return
            end if
            excess = -1.0_wp
            if (sum_found > 0.0_wp) excess = log(sum_found/assumed)
            call narrow(s, log(assumed), excess)
            s%ends = s%number >= most_stretchings .or. abs(s%guess - s%last_at) <= 2*spacing(max(1.0_wp, abs(s%last_at)))
            if (s%has_low .and. s%has_high) then
                s%ends = s%ends .or. s%high - s%low <= 4*spacing(max(abs(s%low), abs(s%high))) &
                    .or. (s%high - s%low <= narrow_bracket*max(1.0_wp, abs(s%low)) .and. abs(excess) > clear_jump)
            end if
            if (s%ends) then
                ! Half of the digits are there where nothing jumps
                s%jumps = abs(excess) > sqrt(epsilon(excess))
                s%stretched(:) = found*(assumed/sum_found)
            else
                call choose_next(s, .true.)
            end if
        end associate
    end subroutine guess_stretching

    !> Narrow the bracket, and guess by the secant through the last two states; halve the bracket where that leaves it, or where it
    !> has not become half as long in three steps (Dekker 1969)
    pure subroutine narrow(stretching, at, excess)
        type(stretching_type), intent(inout) :: stretching
        !> Logarithms of the sum assumed, and of what the state has over it
        real(wp), intent(in) :: at, excess
        real(wp) :: slope

        associate (s => stretching)
            ! Of a cable, whose sum is the cube root of what it would have at 1; of the stiffest beams it is -1
            slope = -3.0_wp
            if (s%has_last) slope = (excess - s%last_excess)/(at - s%last_at)
            if (.not. slope < 0.0_wp) slope = -3.0_wp
            s%guess = at - excess/slope
            s%has_last = .true.
            s%last_at = at
            s%last_excess = excess
            if (excess < 0.0_wp) then
                s%high = at
                s%has_high = .true.
            else
                s%low = at
                s%has_low = .true.
            end if
        end associate
    end subroutine narrow

    !> The logarithm of the next sum
    pure subroutine choose_next(stretching, known)
        type(stretching_type), intent(inout) :: stretching
        !> Is there a guess
        logical, intent(in) :: known
        real(wp) :: next

        associate (s => stretching)
            if (s%has_low .and. s%has_high) then
                next = s%low + (s%high - s%low)/2
                if (modulo(s%number, 4) == 0) then
                    s%slow = s%high - s%low > s%width/2
                    s%width = s%high - s%low
                end if
                if (known .and. .not. s%slow .and. s%guess > s%low .and. s%guess < s%high) next = s%guess
                s%slow = .false.
            else if (known) then
                next = s%guess
            else
                ! A hundred times as much
                next = s%low + log(100.0_wp)
            end if
            s%stretched(:) = 0.0_wp
            s%stretched(s%first) = exp(next)
        end associate
    end subroutine choose_next

end module gapbeam_stretching
