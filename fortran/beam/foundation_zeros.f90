!> Zeros of a function along a stretch on elastic ground that is a polynomial to rounding, piece by piece.
!>
!> Signs of Bernstein coefficients isolate them (Descartes' rule, Collins and Akritas 1976; by subdivision, Lane and Riesenfeld
!> 1981). No coefficient is believed beyond its rounding error: what crosses by no more than that, as at an end that is itself a
!> zero, does not count.
module gapbeam_foundation_zeros
    use gapbeam_kinds, only: wp
    use gapbeam_tolerances, only: root_place
    use gapbeam_foundation, only: decay_lengths
    use gapbeam_foundation_question, only: question_type, evaluate
    use gapbeam_foundation_pieces, only: piece_type
    implicit none
    private
    public :: zeros_type, add_zeros, drop_doubtful

    !> Zeros found so far, in rising order
    type :: zeros_type
        integer :: number = 0
        !> The place, slope there (in xi), rounding error of the value, shape (3, at least number)
        real(wp), allocatable :: list(:, :)
        !> Sign of the function where the last piece ended
        logical :: begun = .false., positive = .true.
    end type zeros_type

contains

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
        real(wp), intent(in) :: b(0:), left, right
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
        if (zeros%number == size(zeros%list, 2)) zeros%list = reshape([zeros%list, zeros%list], [3, 2*zeros%number])
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
        real(wp) :: b(0:ubound(a, 1)), binomial
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

end module gapbeam_foundation_zeros
