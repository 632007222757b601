!> Roots and peaks of the fields of a stretch on elastic ground.
!>
!> The stretch is cut to pieces on which the field is a polynomial to rounding, whose zeros are isolated (gapbeam_foundation_zeros).
module gapbeam_foundation_roots
    use gapbeam_kinds, only: wp
    use gapbeam_tolerances, only: no_decay_left, root_piece_length, most_root_pieces
    use gapbeam_foundation, only: stretch_type, stretch_load_type, stretch_ends_type, decay_lengths
    use gapbeam_curved, only: curved_type, cut_into_steps
    use gapbeam_foundation_question, only: question_type, over_line, slope_of_w, has_middle, is_string
    use gapbeam_foundation_pieces, only: series_type, piece_type, fading, series_between, piece_of, middle_piece, string_piece
    use gapbeam_foundation_zeros, only: zeros_type, add_zeros, drop_doubtful
    implicit none
    private
    public :: find_crossings, find_limits, find_peaks

contains

    !> Where the deflection crosses straight lines: all zeros of w - line inside the stretch at which it changes its sign, by more
    !> than rounding
    pure subroutine find_crossings(stretch, load, ends, lines, xi, curved)
        !> The stretch, its load, deflections and moments of its ends
        type(stretch_type), intent(in) :: stretch
        type(stretch_load_type), intent(in) :: load
        type(stretch_ends_type), intent(in) :: ends
        !> Lines at the left and right end, down, shape (2, lines)
        real(wp), intent(in) :: lines(:, :)
        !> The places in parts of the length, rising, in (0, 1), line after line
        real(wp), allocatable, intent(out) :: xi(:)
        !> The stretch where ground acts on it by curves
        type(curved_type), intent(in), optional :: curved
        type(question_type) :: question
        integer :: k, numbers(size(lines, 2))

        question = asked(stretch, load, ends, curved)
        call find_zeros(question, [(over_line, k=1, size(lines, 2))], lines, xi, numbers)
    end subroutine find_crossings

    !> Where ground reaches its limit: all zeros of stiffness side (w - line) - limit at which that changes its sign
    pure subroutine find_limits(stretch, load, ends, line, side, stiffness, limit, xi, curved)
        !> As for find_crossings
        type(stretch_type), intent(in) :: stretch
        type(stretch_load_type), intent(in) :: load
        type(stretch_ends_type), intent(in) :: ends
        !> The line at both ends, the side from which the ground pushes (1: below), its stiffness and limit at both ends, 0 or more
        real(wp), intent(in) :: line(2), stiffness(2), limit(2)
        integer, intent(in) :: side
        !> As for find_crossings
        real(wp), allocatable, intent(out) :: xi(:)
        type(curved_type), intent(in), optional :: curved
        type(question_type) :: question
        integer :: numbers(1)

        question = asked(stretch, load, ends, curved)
        question%is_limit = .true.
        question%side = side
        question%stiffness_a = stiffness(1)
        question%stiffness_b = stiffness(2)
        question%limit_a = limit(1)
        question%limit_b = limit(2)
        call find_zeros(question, [over_line], reshape(line, [2, 1]), xi, numbers)
    end subroutine find_limits

    !> A question, but for what and the line
    pure function asked(stretch, load, ends, curved) result(question)
        type(stretch_type), intent(in) :: stretch
        type(stretch_load_type), intent(in) :: load
        type(stretch_ends_type), intent(in) :: ends
        type(curved_type), intent(in), optional :: curved
        type(question_type) :: question

        question%stretch = stretch
        question%load = load
        question%ends = ends
        if (.not. present(curved)) return
        allocate (question%curved)
        question%curved = curved
    end function asked

    !> Where fields have peaks inside the stretch: their slopes change sign
    pure subroutine find_peaks(stretch, load, ends, fields, xi, slope, curved, numbers)
        !> As for find_crossings
        type(stretch_type), intent(in) :: stretch
        type(stretch_load_type), intent(in) :: load
        type(stretch_ends_type), intent(in) :: ends
        !> 1 deflection, 2 rotation, 3 moment, 4 shear, 5 transverse force, 6 curvature
        integer, intent(in) :: fields(:)
        !> The places in parts of the length, rising, in (0, 1), field after field
        real(wp), allocatable, intent(out) :: xi(:)
        !> Slope dw/dx of a line from which the deflection is reckoned; default 0
        real(wp), intent(in), optional :: slope
        !> As for find_crossings
        type(curved_type), intent(in), optional :: curved
        !> How many there are of each
        integer, intent(out), optional :: numbers(:)
        type(question_type) :: question
        real(wp) :: lines(2, size(fields))
        integer :: found(size(fields))

        lines(:, :) = 0.0_wp
        if (present(slope)) lines(:, :) = slope*stretch%length
        question = asked(stretch, load, ends, curved)
        call find_zeros(question, fields, lines, xi, found)
        if (present(numbers)) numbers(:) = found
    end subroutine find_peaks

    !> Zeros of functions, piece by piece
    pure subroutine find_zeros(question, whats, lines, xi, numbers)
        !> What is asked, but for function and line
        type(question_type), intent(inout) :: question
        !> The functions (gapbeam_foundation_question), and the line of each as for find_crossings
        integer, intent(in) :: whats(:)
        real(wp), intent(in) :: lines(:, :)
        !> Their places, function after function, and how many there are of each
        real(wp), allocatable, intent(out) :: xi(:)
        integer, intent(out) :: numbers(:)
        type(zeros_type) :: zeros(size(lines, 2))
        type(series_type) :: series
        type(piece_type) :: piece
        real(wp), allocatable :: places(:), middles(:, :)
        real(wp) :: length, left, right, part
        integer :: n, i, k

        length = decay_lengths(question%stretch)
        n = max(1, ceiling(min(length/root_piece_length, most_root_pieces)))
        if (allocated(question%curved)) then
            call cut_into_steps(question%curved, places, middles)
            do i = 1, size(middles, 2)
                call series_between(question, places(i - 1), places(i), any(whats <= slope_of_w), series, middles(:, i))
                do k = 1, size(zeros)
                    question%what = whats(k)
                    question%line(:) = lines(:, k)
                    call piece_of(question, series, piece)
                    call add_zeros(question, piece, zeros(k))
                end do
            end do
        else if (length > 2*no_decay_left + 4*root_piece_length .and. (decays(question) .or. is_string(question%stretch))) then
            part = no_decay_left/length
            n = ceiling(no_decay_left/root_piece_length)
            do i = 1, n
                call add_piece(question, whats, lines, (i - 1)*part/n, i*part/n, zeros)
            end do
            do k = 1, size(zeros)
                question%what = whats(k)
                question%line(:) = lines(:, k)
                if (is_string(question%stretch)) then
                    call string_piece(question, part, 1 - part, piece)
                else
                    call middle_piece(question, part, 1 - part, piece)
                end if
                call add_zeros(question, piece, zeros(k))
            end do
            do i = n, 1, -1
                call add_piece(question, whats, lines, 1 - i*part/n, 1 - (i - 1)*part/n, zeros)
            end do
        else
            left = 0.0_wp
            do i = 1, n
                right = real(i, wp)/n
                call add_piece(question, whats, lines, left, right, zeros)
                left = right
            end do
        end if
        do k = 1, size(zeros)
            question%what = whats(k)
            question%line(:) = lines(:, k)
            if (zeros(k)%number > 0) call drop_doubtful(question, zeros(k))
        end do
        numbers(:) = zeros%number
        allocate (xi(sum(numbers)))
        do k = 1, size(zeros)
            if (numbers(k) > 0) xi(sum(numbers(:k - 1)) + 1:sum(numbers(:k))) = zeros(k)%list(1, :numbers(k))
        end do
    end subroutine find_zeros

    !> Is nothing left of the ends in the middle of a long stretch, but what the load makes there
    pure function decays(question)
        type(question_type), intent(in) :: question
        logical :: decays

        decays = has_middle(question%stretch) .and. .not. question%is_limit .and. .not. allocated(question%curved)
    end function decays

    !> Zeros between two places
    pure subroutine add_piece(question, whats, lines, left, right, zeros)
        type(question_type), intent(inout) :: question
        !> As for find_zeros
        integer, intent(in) :: whats(:)
        real(wp), intent(in) :: lines(:, :), left, right
        type(zeros_type), intent(inout) :: zeros(:)
        type(series_type) :: series
        type(piece_type) :: piece
        logical :: is_long, known
        integer :: k

        is_long = decay_lengths(question%stretch) > 4.0_wp .and. decays(question)
        known = .false.
        do k = 1, size(zeros)
            question%what = whats(k)
            question%line(:) = lines(:, k)
            ! Long stretches first: is the line further from the load's own deflection than what is left of the ends
            if (is_long .and. whats(k) == over_line) then
                call middle_piece(question, left, right, piece)
                if (abs(piece%a(0)) > abs(piece%a(1)) + abs(piece%a(2)) + piece%noise + fading(question, left, right)) then
                    if (.not. zeros(k)%begun .or. (zeros(k)%positive .eqv. piece%a(0) > 0.0_wp)) then
                        zeros(k)%begun = .true.
                        zeros(k)%positive = piece%a(0) > 0.0_wp
                        cycle
                    end if
                end if
            end if
            if (.not. known) call series_between(question, left, right, any(whats <= slope_of_w), series)
            known = .true.
            call piece_of(question, series, piece)
            call add_zeros(question, piece, zeros(k))
        end do
    end subroutine add_piece

end module gapbeam_foundation_roots
