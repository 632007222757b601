!> Roots and peaks of the fields of a stretch on elastic ground.
!>
!> The stretch is cut to pieces on which the field is a polynomial to rounding; signs of Bernstein coefficients isolate its
!> zeros (Descartes' rule, Collins and Akritas 1976; by subdivision, Lane and Riesenfeld 1981). No coefficient is believed
!> beyond its rounding error: what crosses by no more than that, as at an end that is itself a zero, does not count.
module gapbeam_foundation_roots
    use gapbeam_kinds, only: wp
    use gapbeam_tolerances, only: no_decay_left, root_piece_length, most_root_pieces, root_place
    use gapbeam_foundation, only: stretch_type, stretch_load_type, stretch_ends_type, decay_lengths
    use gapbeam_curved, only: curved_type, cut_into_steps
    use gapbeam_foundation_pieces, only: question_type, piece_type, over_line, has_middle, is_string, fading, &
        piece_between, middle_piece, string_piece, evaluate
    implicit none
    private
    public :: find_crossings, find_limits, find_peaks

    !> Zeros found so far, in rising order
    type :: zeros_type
        integer :: number = 0
        !> The place, slope there (in xi), rounding error of the value, shape (3, at least number)
        real(wp), allocatable :: list(:, :)
        !> Sign of the function where the last piece ended
        logical :: begun = .false., positive = .true.
    end type zeros_type

contains

    !> Where the deflection crosses a straight line: all zeros of w - line inside the stretch at which it changes its sign,
    !> by more than rounding
    pure subroutine find_crossings(stretch, load, ends, line_a, line_b, xi, number, curved)
        !> The stretch, its load, deflections and moments of its ends
        type(stretch_type), intent(in) :: stretch
        type(stretch_load_type), intent(in) :: load
        type(stretch_ends_type), intent(in) :: ends
        !> The line at the left and right end, down
        real(wp), intent(in) :: line_a, line_b
        !> The places in parts of the length, rising, in (0, 1), shape (number)
        real(wp), allocatable, intent(out) :: xi(:)
        !> How many there are
        integer, intent(out) :: number
        !> The stretch where ground acts on it by curves
        type(curved_type), intent(in), optional :: curved

        call find_zeros(asked(stretch, load, ends, over_line, line_a, line_b, curved), xi, number)
    end subroutine find_crossings

    !> Where ground reaches its limit: all zeros of stiffness side (w - line) - limit at which that changes its sign
    pure subroutine find_limits(stretch, load, ends, line, side, stiffness, limit, xi, number, curved)
        !> As for find_crossings
        type(stretch_type), intent(in) :: stretch
        type(stretch_load_type), intent(in) :: load
        type(stretch_ends_type), intent(in) :: ends
        !> The line at both ends, the side from which the ground pushes (1: below), its stiffness and limit at both ends, 0 or more
        real(wp), intent(in) :: line(2), stiffness(2), limit(2)
        integer, intent(in) :: side
        !> As for find_crossings
        real(wp), allocatable, intent(out) :: xi(:)
        integer, intent(out) :: number
        type(curved_type), intent(in), optional :: curved
        type(question_type) :: question

        question = asked(stretch, load, ends, over_line, line(1), line(2), curved)
        question%is_limit = .true.
        question%side = side
        question%stiffness_a = stiffness(1)
        question%stiffness_b = stiffness(2)
        question%limit_a = limit(1)
        question%limit_b = limit(2)
        call find_zeros(question, xi, number)
    end subroutine find_limits

    !> A question
    pure function asked(stretch, load, ends, what, line_a, line_b, curved) result(question)
        type(stretch_type), intent(in) :: stretch
        type(stretch_load_type), intent(in) :: load
        type(stretch_ends_type), intent(in) :: ends
        integer, intent(in) :: what
        real(wp), intent(in) :: line_a, line_b
        type(curved_type), intent(in), optional :: curved
        type(question_type) :: question

        question%stretch = stretch
        question%load = load
        question%ends = ends
        question%what = what
        question%line_a = line_a
        question%line_b = line_b
        if (.not. present(curved)) return
        allocate (question%curved)
        question%curved = curved
    end function asked

    !> Where a field has a peak inside the stretch: its slope changes sign
    pure subroutine find_peaks(stretch, load, ends, what, xi, number, slope, curved)
        !> As for find_crossings
        type(stretch_type), intent(in) :: stretch
        type(stretch_load_type), intent(in) :: load
        type(stretch_ends_type), intent(in) :: ends
        !> 1 deflection, 2 rotation, 3 moment, 4 shear, 5 transverse force, 6 curvature
        integer, intent(in) :: what
        !> As for find_crossings
        real(wp), allocatable, intent(out) :: xi(:)
        integer, intent(out) :: number
        !> Slope dw/dx of a line from which the deflection is reckoned; default 0
        real(wp), intent(in), optional :: slope
        !> As for find_crossings
        type(curved_type), intent(in), optional :: curved
        real(wp) :: rise

        rise = 0.0_wp
        if (present(slope)) rise = slope*stretch%length
        call find_zeros(asked(stretch, load, ends, what, rise, rise, curved), xi, number)
    end subroutine find_peaks

    !> Zeros of a function, piece by piece
    pure subroutine find_zeros(question, xi, number)
        type(question_type), intent(in) :: question
        real(wp), allocatable, intent(out) :: xi(:)
        integer, intent(out) :: number
        type(zeros_type) :: zeros
        type(piece_type) :: piece
        real(wp), allocatable :: places(:), middles(:, :)
        real(wp) :: length, left, right, part
        integer :: n, i

        length = decay_lengths(question%stretch)
        n = max(1, ceiling(min(length/root_piece_length, most_root_pieces)))
        if (allocated(question%curved)) then
            call cut_into_steps(question%curved, places, middles)
            do i = 1, size(middles, 2)
                call piece_between(question, places(i - 1), places(i), piece, middles(:, i))
                call add_zeros(question, piece, zeros)
            end do
        else if (length > 2*no_decay_left + 4*root_piece_length .and. (decays(question) .or. is_string(question%stretch))) then
            part = no_decay_left/length
            n = ceiling(no_decay_left/root_piece_length)
            do i = 1, n
                call add_piece(question, (i - 1)*part/n, i*part/n, zeros)
            end do
            if (is_string(question%stretch)) then
                call string_piece(question, part, 1 - part, piece)
            else
                call middle_piece(question, part, 1 - part, piece)
            end if
            call add_zeros(question, piece, zeros)
            do i = n, 1, -1
                call add_piece(question, 1 - i*part/n, 1 - (i - 1)*part/n, zeros)
            end do
        else
            left = 0.0_wp
            do i = 1, n
                right = real(i, wp)/n
                call add_piece(question, left, right, zeros)
                left = right
            end do
        end if
        if (zeros%number > 0) call drop_doubtful(question, zeros)
        number = zeros%number
        allocate (xi(number))
        if (number > 0) xi = zeros%list(1, 1:number)
    end subroutine find_zeros

    !> Is nothing left of the ends in the middle of a long stretch, but what the load makes there
    pure function decays(question)
        type(question_type), intent(in) :: question
        logical :: decays

        decays = has_middle(question%stretch) .and. .not. question%is_limit .and. .not. allocated(question%curved)
    end function decays

    !> Zeros between two places
    pure subroutine add_piece(question, left, right, zeros)
        type(question_type), intent(in) :: question
        real(wp), intent(in) :: left, right
        type(zeros_type), intent(inout) :: zeros
        type(piece_type) :: piece

        ! Long stretches first: is the line further from the load's own deflection than what is left of the ends
        if (question%what == over_line .and. decay_lengths(question%stretch) > 4.0_wp .and. decays(question)) then
            call middle_piece(question, left, right, piece)
            if (abs(piece%a(0)) > abs(piece%a(1)) + abs(piece%a(2)) + piece%noise + fading(question, left, right)) then
                if (.not. zeros%begun .or. (zeros%positive .eqv. piece%a(0) > 0.0_wp)) then
                    zeros%begun = .true.
                    zeros%positive = piece%a(0) > 0.0_wp
                    return
                end if
            end if
        end if
        call piece_between(question, left, right, piece)
        call add_zeros(question, piece, zeros)
    end subroutine add_piece

    !> Zeros of the function on a piece
    pure subroutine add_zeros(question, piece, zeros)
        type(question_type), intent(in) :: question
        type(piece_type), intent(in) :: piece
        type(zeros_type), intent(inout) :: zeros
        real(wp) :: b(0:piece%degree), rest
        integer :: n

        n = piece%degree
        rest = sum(abs(piece%a(1:n))) + piece%noise
        if (abs(piece%a(0)) > rest .and. zeros%begun .and. (zeros%positive .eqv. piece%a(0) > 0.0_wp)) return
        if (abs(piece%a(0)) > rest .and. .not. zeros%begun) then
            zeros%begun = .true.
            zeros%positive = piece%a(0) > 0.0_wp
            return
        end if
        b = bernstein(piece%a(0:n), -1.0_wp)
        call add_half(question, piece, b(n:0:-1), -1.0_wp, 0.0_wp, zeros)
        b = bernstein(piece%a(0:n), 1.0_wp)
        call add_half(question, piece, b, 0.0_wp, 1.0_wp, zeros)
    end subroutine add_zeros

    !> Zeros on a half of a piece
    pure subroutine add_half(question, piece, b, left, right, zeros)
        type(question_type), intent(in) :: question
        type(piece_type), intent(in) :: piece
        !> Bernstein coefficients
        real(wp), intent(in) :: b(0:)
        !> Where the half begins and ends, in t
        real(wp), intent(in) :: left, right
        type(zeros_type), intent(inout) :: zeros
        real(wp) :: own(0:ubound(b, 1))

        ! Two pieces share one sign where they meet, whatever rounding made of it
        own = b
        if (zeros%begun .and. (zeros%positive .neqv. b(0) >= 0.0_wp)) own(0) = merge(0.0_wp, -tiny(1.0_wp), zeros%positive)
        call isolate(question, piece, own, left, right, zeros)
        zeros%begun = .true.
        zeros%positive = own(ubound(b, 1)) >= 0.0_wp
    end subroutine add_half

    !> Isolate zeros by the signs of Bernstein coefficients: none, or one, or cut in half
    pure recursive subroutine isolate(question, piece, b, left, right, zeros)
        type(question_type), intent(in) :: question
        type(piece_type), intent(in) :: piece
        real(wp), intent(in) :: b(0:)
        real(wp), intent(in) :: left, right
        type(zeros_type), intent(inout) :: zeros
        real(wp) :: first(0:ubound(b, 1)), second(0:ubound(b, 1)), middle
        integer :: n, changes, i

        n = ubound(b, 1)
        changes = count(b(1:) >= 0.0_wp .neqv. b(:n - 1) >= 0.0_wp)
        if (changes == 0) return
        middle = left + (right - left)/2
        if (changes > 1 .and. all(abs(b) <= piece%noise) .or. .not. (middle > left .and. middle < right)) then
            ! Nothing is known but the signs at the ends
            if (b(0) >= 0.0_wp .neqv. b(n) >= 0.0_wp) changes = 1
            if (changes > 1) return
        end if
        if (changes == 1) then
            call add_zero(question, piece, left, right, b(0) >= 0.0_wp, zeros)
            return
        end if
        second = b
        do i = 0, n
            first(i) = second(0)
            second(0:n - i - 1) = (second(0:n - i - 1) + second(1:n - i))/2
        end do
        call isolate(question, piece, first, left, middle, zeros)
        call isolate(question, piece, second, middle, right, zeros)
    end subroutine isolate

    !> The one zero between two places
    pure subroutine add_zero(question, piece, left, right, falling, zeros)
        type(question_type), intent(in) :: question
        type(piece_type), intent(in) :: piece
        real(wp), intent(in) :: left, right
        !> Is the function positive at the left place
        logical, intent(in) :: falling
        type(zeros_type), intent(inout) :: zeros
        real(wp), allocatable :: more(:, :)
        real(wp) :: low, high, t, f, slope, next, xi
        integer :: step, k

        low = left
        high = right
        t = low + (high - low)/2
        do step = 1, 2*digits(1.0_wp)
            f = piece%a(piece%degree)
            slope = 0.0_wp
            do k = piece%degree - 1, 0, -1
                slope = f + t*slope
                f = piece%a(k) + t*f
            end do
            if (f >= 0.0_wp .eqv. falling) then
                low = t
            else
                high = t
            end if
            next = low + (high - low)/2
            if (abs(slope)*(high - low) > abs(f)) then
                if (t - f/slope >= low .and. t - f/slope <= high) next = t - f/slope
            end if
            if (abs(next - t) <= root_place) exit
            t = next
        end do
        ! One step by the fields themselves: their rounding is less than the polynomial's
        xi = piece%middle + piece%half*next
        call evaluate(question, xi, f, slope)
        if (abs(slope)*piece%half > abs(f)) then
            next = xi - f/slope
            if (next >= piece%middle + piece%half*left .and. next <= piece%middle + piece%half*right) xi = next
        end if
        if (.not. allocated(zeros%list)) allocate (zeros%list(3, 8))
        if (zeros%number == size(zeros%list, 2)) then
            allocate (more(3, 2*zeros%number))
            more(:, 1:zeros%number) = zeros%list
            call move_alloc(more, zeros%list)
        end if
        zeros%number = zeros%number + 1
        zeros%list(:, zeros%number) = [xi, slope, piece%noise]
    end subroutine add_zero

    !> Leave out what is no crossing to rounding: two zeros with no more than that between them, or one beside an end
    pure subroutine drop_doubtful(question, zeros)
        type(question_type), intent(in) :: question
        type(zeros_type), intent(inout) :: zeros
        real(wp), allocatable :: kept(:, :)
        integer :: i, n

        allocate (kept(3, zeros%number))
        n = 0
        do i = 1, zeros%number
            if (zeros%list(1, i) <= 0.0_wp .or. zeros%list(1, i) >= 1.0_wp) cycle
            if (n == 0) then
                if (is_flat(question, [0.0_wp, 0.0_wp, 0.0_wp], zeros%list(:, i))) cycle
            else if (is_flat(question, kept(:, n), zeros%list(:, i))) then
                n = n - 1
                cycle
            end if
            n = n + 1
            kept(:, n) = zeros%list(:, i)
        end do
        do while (n > 0)
            if (.not. is_flat(question, kept(:, n), [1.0_wp, 0.0_wp, 0.0_wp])) exit
            n = n - 1
        end do
        zeros%number = n
        zeros%list = kept
    end subroutine drop_doubtful

    !> Is the function zero to rounding between two neighbouring zeros (or an end, whose slope and rounding are given as 0)
    pure function is_flat(question, a, b) result(flat)
        type(question_type), intent(in) :: question
        real(wp), intent(in) :: a(:), b(:)
        logical :: flat
        real(wp) :: noise, slope, near, places(3), f, ignored
        integer :: i, k

        noise = max(a(3), b(3))
        slope = min(abs(a(2)), abs(b(2)))
        if (a(3) <= 0.0_wp .or. b(3) <= 0.0_wp) slope = max(abs(a(2)), abs(b(2)))
        flat = .false.
        if (slope*(b(1) - a(1)) > 64*noise) return
        do i = 1, 3
            ! What decays from an end of a long stretch is seen beside that end only
            near = min((b(1) - a(1))/8, 4.0_wp**(i - 2)/max(decay_lengths(question%stretch), 1.0_wp))
            places(:) = [a(1) + (b(1) - a(1))*i/4, a(1) + near, b(1) - near]
            do k = 1, 3
                call evaluate(question, places(k), f, ignored)
                if (abs(f) > noise) return
            end do
        end do
        flat = .true.
    end function is_flat

    !> Bernstein coefficients on 0..1 of a polynomial in direction times t
    pure function bernstein(a, direction) result(b)
        !> Coefficients of the powers
        real(wp), intent(in) :: a(0:)
        !> 1 or -1
        real(wp), intent(in) :: direction
        real(wp) :: b(0:ubound(a, 1))
        real(wp) :: binomial
        integer :: n, i, j

        n = ubound(a, 1)
        binomial = 1.0_wp
        do i = 0, n
            b(i) = a(i)/binomial
            binomial = direction*binomial*(n - i)/(i + 1)
        end do
        do j = 1, n
            do i = n, j, -1
                b(i) = b(i) + b(i - 1)
            end do
        end do
    end function bernstein

end module gapbeam_foundation_roots
