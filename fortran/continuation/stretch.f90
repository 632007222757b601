!> An interval of the load path (no stretch of the beam) with one contact state, updated while supports change.
!> The solution as lines over the load factor, and the queue of the factors at which they reach zero.
module gapbeam_stretch
    use gapbeam_kinds, only: wp
    use gapbeam_path_tolerances, only: agreement, same_factor
    use gapbeam_band, only: band_ok
    use gapbeam_polyline, only: last_breakpoint
    use gapbeam_unloading, only: holds_both_ways
    use gapbeam_law_margins, only: is_watched_in
    use gapbeam_model, only: beam_type
    use gapbeam_update, only: start_updates, update_scheme, find_groups
    use gapbeam_affine_response, only: lines_type, new_lines, response_type, response_of, value_at, width_at, zero_of, &
        falls, rises, stays_at_zero
    use gapbeam_queue, only: queue_type, new_queue, set_key, first_key, all_up_to
    use gapbeam_model_quad, only: fine_beam_type => beam_type
    use gapbeam_linear_region, only: region_type
    implicit none
    private
    public :: stretch_type, new_stretch, start_stretch, change_supports, queue_all, add_those_at_zero, next_in_queue
    public :: response_in, unloads_from_here, tell_reactions, take_reactions

    !> What is known on a stretch of the path. Where the load falls, factors and lines are those of its negative
    type, extends(lines_type) :: stretch_type
        !> Direction in which the load goes, 1 or -1
        real(wp) :: direction = 1.0_wp
        !> Share of its factor by which an event may be off in doubles
        real(wp) :: share_off = agreement
        !> Which supports unload in a way of their own from wherever they are, if any do, shape (size(supports)); does one of them
        !> turn back, or may it
        logical, allocatable :: keeps_set(:)
        logical :: turns_back = .false.
        !> Are v0 and v1 those of the scheme at hand
        logical :: current = .false.
        !> Factors at which supports come near zero
        type(queue_type) :: queue
        !> At which factor a support has changed last
        real(wp), allocatable :: last_change(:)
        !> The beam in quadruple precision, and the stretch as found so, if it was
        type(fine_beam_type) :: fine
        logical :: has_fine = .false., by_region = .false.
        type(region_type) :: region
        !> Linear solves of the whole beam; nodes at which the solution was made anew besides
        integer :: solves = 0, nodes = 0
        !> Was there a support of which doubles cannot tell whether it moves away from zero; are all stretches found in quadruple
        !> precision because of that
        logical :: in_doubt = .false., closely = .false.
        !> Stretches on which the beam stays free to move
        integer :: indifferent = 0
        !> First and last nodes between which reactions have other lines than were taken last, shape (2, *), and how many of these
        !> windows are told; not allocated where nobody asks
        integer, allocatable :: touched(:, :)
        integer :: told = 0
        !> What is told: breakpoints there, and their reactions at factor 0 and by a unit of the factor, shape (2, size(pressed))
        integer, allocatable :: pressed(:)
        real(wp), allocatable :: reactions(:, :)
    end type stretch_type

contains

    !> Room for what is known on a stretch of the path
    subroutine new_stretch(beam, stretch)
        type(beam_type), intent(in) :: beam
        !> Nothing solved yet
        type(stretch_type), intent(out) :: stretch

        call new_lines(beam, stretch%lines_type)
        call new_queue(size(beam%supports), stretch%queue)
        allocate (stretch%last_change(size(beam%supports)), source=-huge(1.0_wp))
    end subroutine new_stretch

    !> Solve v0 and v1 of a scheme; the stretch is not current if that takes more than a plain solve
    subroutine start_stretch(beam, closed, factor, stretch)
        !> The beam, the scheme, and the factor from which on it acts
        type(beam_type), intent(in) :: beam
        logical, intent(in) :: closed(:)
        real(wp), intent(in) :: factor
        type(stretch_type), intent(inout) :: stretch
        logical :: solved, follows, live_follows

        stretch%by_region = .false.
        call start_updates(beam, closed, stretch%dead, solved, follows)
        if (solved) call start_updates(stretch%incremental, closed, stretch%live, solved, live_follows)
        stretch%solves = stretch%solves + 2
        stretch%current = solved
        if (solved) stretch%current = follows .and. live_follows
        if (.not. stretch%current) return
        call queue_all(beam, closed, factor, stretch)
        if (.not. allocated(stretch%touched)) return
        stretch%touched = reshape([0, size(beam%links)], [2, 1])
        stretch%told = 0
    end subroutine start_stretch

    !> Put all supports into the queue
    pure subroutine queue_all(beam, closed, factor, stretch)
        !> The beam, its scheme, current in the stretch, and the factor
        type(beam_type), intent(in) :: beam
        logical, intent(in) :: closed(:)
        real(wp), intent(in) :: factor
        type(stretch_type), intent(inout) :: stretch
        integer :: k

        do k = 1, size(closed)
            call queue_support(beam, closed, k, factor, stretch)
        end do
    end subroutine queue_all

    !> Change supports in v0 and v1, and in the queue; afterwards the stretch is not current if that is not possible
    subroutine change_supports(beam, changed, factor, closed, stretch)
        !> The beam, the supports that change, the factor, and the scheme
        type(beam_type), intent(in) :: beam
        integer, intent(in) :: changed(:)
        real(wp), intent(in) :: factor
        logical, intent(inout) :: closed(:)
        type(stretch_type), intent(inout) :: stretch
        integer, allocatable :: groups(:, :)
        integer :: count, window(2), window_of_live(2), state, i, j

        closed(changed) = .not. closed(changed)
        allocate (groups(2, size(changed)))
        call find_groups(beam, changed, groups, count)
        do j = 1, count
            call update_scheme(beam, closed, groups(:, j), .true., stretch%dead, window, state)
            if (state == band_ok) call update_scheme(stretch%incremental, closed, groups(:, j), .true., stretch%live, &
                                                     window_of_live, state)
            stretch%current = state == band_ok
            if (.not. stretch%current) return
            window = [min(window(1), window_of_live(1)), max(window(2), window_of_live(2))]
            stretch%nodes = stretch%nodes + window(2) - window(1) + 1
            if (allocated(stretch%touched)) stretch%touched = reshape([stretch%touched, window], [2, size(stretch%touched, 2) + 1])
            do i = beam%first(window(1)), beam%first(window(2) + 1) - 1
                call queue_support(beam, closed, beam%order(i), factor, stretch)
            end do
        end do
    end subroutine change_supports

    !> Tell how reactions grow with the load factor where that is not taken yet
    pure subroutine tell_reactions(beam, stretch)
        type(beam_type), intent(in) :: beam
        !> Current
        type(stretch_type), intent(inout) :: stretch
        integer :: i

        if (.not. allocated(stretch%touched)) return
        stretch%told = size(stretch%touched, 2)
        stretch%pressed = [integer ::]
        do i = 1, stretch%told
            associate (first => beam%first(stretch%touched(1, i)), last => beam%first(stretch%touched(2, i) + 1) - 1)
                stretch%pressed = [stretch%pressed, beam%order(first:last)]
            end associate
        end do
        stretch%reactions = transpose(reshape([stretch%dead%reaction(stretch%pressed), stretch%live%reaction(stretch%pressed)], &
                                              [size(stretch%pressed), 2]))
    end subroutine tell_reactions

    !> Take what is told, or leave it for the next time
    pure subroutine take_reactions(stretch, taken, pressed, reactions)
        type(stretch_type), intent(inout) :: stretch
        logical, intent(in) :: taken
        !> As in stretch_type; not allocated where nothing is told
        integer, allocatable, intent(inout) :: pressed(:)
        real(wp), allocatable, intent(inout) :: reactions(:, :)

        if (.not. allocated(stretch%pressed)) return
        if (taken) then
            call move_alloc(stretch%pressed, pressed)
            call move_alloc(stretch%reactions, reactions)
            stretch%touched = stretch%touched(:, stretch%told + 1:)
        else
            deallocate (stretch%pressed, stretch%reactions)
        end if
        stretch%told = 0
    end subroutine take_reactions

    !> Reaction or opening of a support over the load factor
    pure function response_in(beam, closed, k, stretch) result(response)
        !> The beam and its scheme, and the number of the support
        type(beam_type), intent(in) :: beam
        logical, intent(in) :: closed(:)
        integer, intent(in) :: k
        type(stretch_type), intent(in) :: stretch
        type(response_type) :: response

        response = response_of(beam, closed, k, stretch%lines_type)
        response%v1 = stretch%direction*response%v1
    end function response_in

    !> Supports that are at zero at a factor
    subroutine add_those_at_zero(beam, closed, factor, limit, stretch, at_zero)
        !> The beam, its scheme, the factor, and the end of the path
        type(beam_type), intent(in) :: beam
        logical, intent(in) :: closed(:)
        real(wp), intent(in) :: factor, limit
        type(stretch_type), intent(inout) :: stretch
        !> Some of them in, all out
        integer, allocatable, intent(inout) :: at_zero(:)
        logical, allocatable :: there(:)
        type(response_type) :: response
        integer :: k

        allocate (there(size(closed)), source=.false.)
        there(at_zero) = .true.
        do k = 1, size(closed)
            if (.not. is_watched_in(beam%supports, closed, k)) cycle
            response = response_in(beam, closed, k, stretch)
            if (abs(value_at(response, factor)) > width_at(response, factor)) cycle
            there(k) = .true.
            stretch%in_doubt = stretch%in_doubt .or. apart(response, factor, limit)
        end do
        at_zero = pack([(k, k=1, size(closed))], there)
    end subroutine add_those_at_zero

    !> The next factor at which something is zero, and what is
    subroutine next_in_queue(beam, closed, factor, limit, stretch, at_zero, next)
        !> The beam and its scheme, current in the stretch
        type(beam_type), intent(in) :: beam
        logical, intent(in) :: closed(:)
        !> Where it is at hand, and the end of the path
        real(wp), intent(in) :: factor, limit
        type(stretch_type), intent(inout) :: stretch
        !> Supports that stay at zero in, all that are there then out
        integer, allocatable, intent(inout) :: at_zero(:)
        !> Huge if there is none
        real(wp), intent(out) :: next
        integer, allocatable :: near(:)
        logical, allocatable :: there(:)
        type(response_type) :: response
        integer :: j, round

        next = huge(next)
        if (.not. first_key(stretch%queue) < huge(next)) return
        ! The first to come near zero need not be the first that is there
        near = all_up_to(stretch%queue, first_key(stretch%queue))
        do round = 1, 2
            do j = 1, size(near)
                next = min(next, max(factor, zero_of(response_in(beam, closed, near(j), stretch))))
            end do
            near = all_up_to(stretch%queue, next)
        end do
        allocate (there(size(near)))
        do j = 1, size(near)
            response = response_in(beam, closed, near(j), stretch)
            there(j) = abs(value_at(response, next)) <= width_at(response, next)
            if (there(j)) stretch%in_doubt = stretch%in_doubt .or. apart(response, next, limit) &
                .or. width_at(response, next) > stretch%share_off*abs(next*response%v1)
        end do
        at_zero = [at_zero, pack(near, there)]
    end subroutine next_in_queue

    !> Is a falling line that counts as zero at a factor zero at another one, so that it may be another event
    pure function apart(response, factor, limit)
        type(response_type), intent(in) :: response
        real(wp), intent(in) :: factor, limit
        logical :: apart

        apart = falls(response)
        if (apart) apart = abs(zero_of(response) - factor) > same_factor*max(abs(factor), limit - factor)
    end function apart

    !> Put a support into the queue with the first factor at which it counts as zero
    pure subroutine queue_support(beam, closed, k, factor, stretch)
        type(beam_type), intent(in) :: beam
        logical, intent(in) :: closed(:)
        integer, intent(in) :: k
        real(wp), intent(in) :: factor
        type(stretch_type), intent(inout) :: stretch
        type(response_type) :: response
        real(wp) :: zero

        response = response_in(beam, closed, k, stretch)
        if (unloads_from_here(beam, closed, k, stretch)) then
            ! It would unload from where it is, not from the breakpoint
            call set_key(stretch%queue, k, huge(zero))
            stretch%turns_back = stretch%turns_back .or. .not. rises(response)
        else if (falls(response)) then
            zero = max(factor, zero_of(response))
            call set_key(stretch%queue, k, zero - width_at(response, zero)/abs(response%v1))
        else
            call set_key(stretch%queue, k, huge(zero))
            if (stays_at_zero(response, factor) .and. max(abs(response%v0), abs(response%v1)) > 0.0_wp) stretch%in_doubt = .true.
        end if
    end subroutine queue_support

    !> Is a breakpoint the last one passed of a support that keeps a set, so that it unloads from where it is; of those that have
    !> become one where it turned back the first
    pure function unloads_from_here(beam, closed, k, stretch) result(it_does)
        !> The beam and its scheme, and the number of the breakpoint
        type(beam_type), intent(in) :: beam
        logical, intent(in) :: closed(:)
        integer, intent(in) :: k
        type(stretch_type), intent(in) :: stretch
        logical :: it_does
        integer :: middle, last

        it_does = allocated(stretch%keeps_set)
        if (it_does) it_does = stretch%keeps_set(k)
        if (.not. it_does) return
        associate (s => beam%supports, number => beam%supports(k)%breakpoint)
            it_does = closed(k) .and. number > 1 .and. .not. s(k)%passed
            if (holds_both_ways(s(k - number + 1))) then
                middle = (last_breakpoint(s, k) - k + number)/2
                if (number <= middle) then
                    ! Below its lower limits: closing that one again
                    it_does = .not. closed(k)
                    if (it_does .and. number > 1) it_does = closed(k - 1)
                    return
                end if
                it_does = closed(k)
            end if
            last = k
            do while (s(last)%more)
                if (.not. s(last + 1)%passed) exit
                last = last + 1
            end do
            if (it_does .and. s(last)%more) it_does = .not. closed(last + 1)
        end associate
    end function unloads_from_here

end module gapbeam_stretch
