!> Values of modes: factors of axial forces at which a beam buckles, squares of circular frequencies.
!>
!> The number of modes below a value never falls as that grows, so the k-th value is where it reaches k, and none is missed. It is
!> narrowed down by the zero of the determinant, which the pivots of the count give (regula falsi as of Illinois; Dowell and Jarratt
!> 1971), and by halving where that does not get nearer; counts decide.
module gapbeam_mode_values
    use gapbeam_kinds, only: wp
    use gapbeam_limits, only: most_halvings, most_asides
    use gapbeam_tolerances, only: mode_digits, mode_width, no_mode_value
    use gapbeam_band, only: log_determinant
    use gapbeam_piece, only: is_compressed
    use gapbeam_ground, only: ground_type, zones_type, grounded_type
    use gapbeam_workspace, only: workspace_type
    use gapbeam_modes, only: by_axial_force, by_vibration, count_modes
    implicit none
    private
    public :: find_mode_values

    !> A value that is counted at: how many modes are below it, and of which size the determinant is there
    type :: counted_type
        real(wp) :: value = 0.0_wp
        integer :: number = 0
        !> Logarithm of that, and the number of stretches that it is of; 0: not known
        real(wp) :: size = 0.0_wp
        integer :: stretches = 0
    end type counted_type

contains

    !> The first values of modes, in rising order
    subroutine find_mode_values(ground, zones, acting, factor, what, first, values, found, lost, near)
        !> As for count_modes
        type(ground_type), intent(in) :: ground
        type(zones_type), intent(in) :: zones
        logical, intent(in) :: acting(:)
        real(wp), intent(in) :: factor
        integer, intent(in) :: what
        !> With which step to begin to look, above 0
        real(wp), intent(in) :: first
        !> Those that there are, shape (number wanted); 0 where the beam moves freely
        real(wp), intent(out) :: values(:)
        integer, intent(out) :: found
        !> Are there more that cannot be counted; not of those that crowd where shear itself gives way
        logical, intent(out) :: lost
        !> Values known to some digits, if any: the others are not looked for
        real(wp), intent(in), optional :: near(:)
        type(counted_type) :: low, high
        real(wp) :: step, limit
        integer :: k, doubling
        logical :: stopped, is_free

        found = 0
        stopped = .false.
        lost = .false.
        limit = greatest_value(ground, what)
        do k = 1, merge(size(near), size(values), present(near))
            is_free = .not. high%value > 0.0_wp .and. high%number >= k
            if (present(near)) is_free = .not. near(k) > 0.0_wp
            if (is_free) then
                values(k) = 0.0_wp
                found = k
                cycle
            end if
            step = min(first, limit/2)
            if (low%value > 0.0_wp) step = low%value/2
            if (present(near)) then
                step = mode_digits*near(k)
                low%value = near(k) - step
            end if
            do doubling = 1, most_halvings
                if (.not. low%value > 0.0_wp) exit
                if (present(near) .or. doubling > 1) call count_at(ground, zones, acting, factor, what, low%value, low, stopped)
                if (low%number < k) exit
                ! Another mode has that value too, or a known one is farther off
                if (.not. present(near)) exit
                low%value = max(0.0_wp, low%value - 2*step)
                step = 4*step
            end do
            if (.not. low%value > 0.0_wp) low = counted_type()
            high = low
            do doubling = 1, most_halvings
                if (high%value > 0.0_wp) then
                    if (doubling > 1) call count_at(ground, zones, acting, factor, what, high%value, high, stopped)
                    if (high%number >= k .or. stopped) exit
                end if
                low = high
                high%value = min(high%value + step, high%value + (limit - high%value)/2)
                if (.not. high%value > low%value) return
                step = 2*step
            end do
            lost = stopped .and. (what == by_vibration .or. .not. limit < huge(limit))
            if (stopped .or. doubling > most_halvings) return
            call narrow(ground, zones, acting, factor, what, k, merge(mode_width, mode_digits/4, present(near)), low, high, stopped)
            if (high%value < first*no_mode_value) high%value = 0.0_wp
            values(k) = high%value
            found = k
            low = high
        end do
    end subroutine find_mode_values

    !> Bring the bracket of mode k together
    subroutine narrow(ground, zones, acting, factor, what, k, width, low, high, stopped)
        !> As for find_mode_values
        type(ground_type), intent(in) :: ground
        type(zones_type), intent(in) :: zones
        logical, intent(in) :: acting(:)
        real(wp), intent(in) :: factor
        integer, intent(in) :: what, k
        !> How narrow, beside its value
        real(wp), intent(in) :: width
        !> Below fewer than k modes, and k at least
        type(counted_type), intent(inout) :: low, high
        !> As for count_at
        logical, intent(inout) :: stopped
        type(counted_type) :: one
        real(wp) :: before, trial, margin
        !> Evaluations in turn that replaced the same end; evaluations since the bracket was halved
        integer :: same, idle, step
        logical :: was_high

        same = 0
        idle = 0
        was_high = .false.
        before = high%value - low%value
        do step = 1, most_halvings
            trial = low%value + (high%value - low%value)/2
            if (.not. (trial > low%value .and. trial < high%value)) exit
            if (high%value - low%value <= width*high%value) exit
            if (2*(high%value - low%value) <= before) then
                before = high%value - low%value
                idle = 0
            else
                idle = idle + 1
            end if
            if (high%number - low%number == 1 .and. low%stretches == high%stretches .and. low%stretches > 0 .and. idle < 3) then
                ! Not so near to an end that this is all that is cut off
                margin = min(width*high%value*8.0_wp**same, high%value - low%value)/2
                trial = low%value + (high%value - low%value)/(1 + 2.0_wp**max(-99.0_wp, min(99.0_wp, high%size - low%size)))
                trial = min(max(trial, low%value + margin), high%value - margin)
            end if
            call count_at(ground, zones, acting, factor, what, trial, one, stopped)
            if ((one%number >= k .eqv. was_high) .and. step > 1) then
                same = same + 1
            else
                same = 0
            end if
            was_high = one%number >= k
            if (was_high) then
                high = one
                if (same > 0) low%size = low%size - 1
            else
                low = one
                if (same > 0) high%size = high%size - 1
            end if
        end do
    end subroutine narrow

    !> Modes at a value, or beside it: where what holds the beam and what moves it nearly cancel, pivots are rounding far around
    subroutine count_at(ground, zones, acting, factor, what, value, one, stopped)
        !> As for find_mode_values
        type(ground_type), intent(in) :: ground
        type(zones_type), intent(in) :: zones
        logical, intent(in) :: acting(:)
        real(wp), intent(in) :: factor
        integer, intent(in) :: what
        real(wp), value :: value
        type(counted_type), intent(out) :: one
        !> Becomes true where nothing can be counted
        logical, intent(inout) :: stopped
        type(workspace_type) :: work
        type(grounded_type) :: grounded
        integer :: trial

        one%value = value
        do trial = 0, most_asides
            call count_modes(ground, zones, acting, what, value*(1 + 8*(4.0_wp**trial - 1)*epsilon(value)), one%number, work, &
                             grounded, factor=factor)
            if (one%number < 0) cycle
            one%stretches = size(grounded%stretches)
            one%size = log_determinant(work%nodes(0:one%stretches), work%pivots)
            return
        end do
        stopped = .true.
        one%number = 0
    end subroutine count_at

    !> Above which value a beam would give way by shear alone: where its axial force takes all of GA (Engesser)
    pure function greatest_value(ground, what) result(limit)
        type(ground_type), intent(in) :: ground
        integer, intent(in) :: what
        real(wp) :: limit
        integer :: j

        limit = huge(limit)
        if (what == by_vibration .and. allocated(ground%mass)) then
            ! Far beyond the last mode where there are lumped masses alone, and products of it are within range
            limit = sqrt(sqrt(limit))/max(1.0_wp, maxval(ground%mass))
        end if
        if (what /= by_axial_force) return
        do j = 1, size(ground%pieces)
            associate (p => ground%pieces(j))
                if (is_compressed(p) .and. p%shear_flexibility > 0.0_wp) then
                    limit = min(limit, (1/p%shear_flexibility + p%slope_stiffness)/(p%slope_stiffness - p%tension))
                end if
            end associate
        end do
    end function greatest_value

end module gapbeam_mode_values
