!> A train goes over a beam: every change of the working scheme at its exact place.
!>
!> While one scheme acts and the train is in one reach (gapbeam_train), reactions and openings are polynomials in its place: a
!> few solves give them. They say where the scheme ceases to be right: the way on is tried with those supports changed that
!> have come to zero there; where that does not do, since several meet, or loads come onto the beam at once, the scheme a
!> little further on is found by the search, and taken if its polynomials say that it is right from here on; else nearer.
!> With laws that never fall there is but one state at every place, so a scheme whose signs are all right is the right one. Where
!> no scheme is found since the beam moves, the work of the loads along the motion is a polynomial as well.
!>
!> A change that is nearer to the last one than least_share of the reach is not told apart from it; where even that does not lead
!> on, the share grows, so that every reach comes to an end.
module gapbeam_train_path
    use gapbeam_kinds, only: wp
    use gapbeam_error, only: error_type, fatal_error, no_memory, gapbeam_solved, gapbeam_no_equilibrium, gapbeam_indeterminate, &
        gapbeam_not_converged
    use gapbeam_bernstein, only: sample_points, to_coefficients, halve, first_below, crossing, highest_degree
    use gapbeam_band, only: band_ok
    use gapbeam_law, only: find_margins, may_change
    use gapbeam_model, only: beam_type
    use gapbeam_kinematics, only: work_of_loads
    use gapbeam_workspace, only: workspace_type, new_workspace, set_loads
    use gapbeam_rules, only: first_width
    use gapbeam_system, only: solve_and_refine
    use gapbeam_search, only: rule_block
    use gapbeam_scheme, only: find_scheme, outcome_type
    use gapbeam_redundancy, only: find_redundancy
    use gapbeam_referee, only: decide_scheme, detail_type
    use gapbeam_words, only: shown
    use gapbeam_lowered, only: lowered_type
    use gapbeam_solution, only: state_type, new_state, close_all
    use gapbeam_state, only: solve_along_axis
    use gapbeam_train, only: train_type, track_type, reach_type, find_reaches, enter_reach, place_train, degree_of, least_distance
    implicit none
    private
    public :: passage_type, pass_train, not_unique

    !> Beside gapbeam_solved and gapbeam_no_equilibrium: the beam can move freely without work of the loads
    integer, parameter :: not_unique = 2
    !> Where the scheme is looked for first, and nearest, as shares of what is left of the reach; the largest share that is left
    !> out where nothing else leads on
    real(wp), parameter :: first_share = 2.0_wp**(-20), least_share = 2.0_wp**(-42), largest_share = 2.0_wp**(-24)
    !> What is a sliver of a reach
    real(wp), parameter :: sliver = 2.0_wp**(-16)
    !> Changes of the scheme in a reach at most: so many, and so many a support
    integer, parameter :: most_changes = 200, most_of_each = 20

    !> The way of a train over a beam: stretches of places, on each of which one scheme acts, in ascending order
    type :: passage_type
        !> How many there are
        integer :: number = 0
        !> First and last place, and gapbeam_solved, gapbeam_no_equilibrium, not_unique, or where there is no unique answer the code
        !> of the error, gapbeam_indeterminate or gapbeam_not_converged
        real(wp), allocatable :: from(:), to(:)
        integer, allocatable :: status(:)
        !> Number of the reach
        integer, allocatable :: reach(:)
        !> Scheme, and supports at zero all the way, shape (size(supports), number at least)
        logical, allocatable :: closed(:, :), at_zero(:, :)
        !> Where there is no equilibrium the free motion, shape (0:n, number of such), and the number of that of each stretch; 0
        !> where the beam slides along its axis
        real(wp), allocatable :: motion(:, :)
        integer, allocatable :: motion_of(:)
        !> The reaches
        type(reach_type), allocatable :: reaches(:)
        !> Linear solves
        integer :: solves = 0
    end type passage_type

    !> Reactions and openings over a stretch, or work along a motion: all are right where none is below its rounding error
    type :: margins_type
        !> Coefficients over the rest of the reach, shape (0:degree, m), and rounding errors
        real(wp), allocatable :: b(:, :), slack(:)
        !> Which are looked at, the first `count` of them
        integer :: count = 0
    end type margins_type

contains

    !> Move a train over a beam
    subroutine pass_train(lowered, track, train, from, to, passage, error)
        !> The beam, and the same ready for trains
        type(lowered_type), intent(in) :: lowered
        type(track_type), intent(inout) :: track
        !> The train, and its places
        type(train_type), intent(in) :: train
        real(wp), intent(in) :: from, to
        type(passage_type), intent(out) :: passage
        !> No unique state, not settled, not finite, or no memory
        type(error_type), allocatable, intent(out) :: error
        type(workspace_type) :: work
        type(margins_type) :: margins
        type(state_type) :: along
        type(reach_type) :: reach
        logical, allocatable :: closed(:)
        logical :: changes, known
        integer :: m, r, stat

        m = size(track%beam%supports)
        call find_reaches(track, train, from, to, passage%reaches, error)
        if (allocated(error)) return
        allocate (closed(m), margins%b(0:highest_degree, max(m, 1)), margins%slack(max(m, 1)), &
                  passage%motion(0:size(track%beam%links), 0), stat=stat)
        if (stat == 0) call lengthen(passage, m, size(passage%reaches) + 64, stat)
        if (stat /= 0) then
            call no_memory(error)
            return
        end if
        call close_all(lowered, closed)
        call new_state(lowered, along, error)
        if (allocated(error)) return
        along%factor = 1.0_wp
        call solve_along_axis(lowered, along, error)
        if (allocated(error)) return
        if (along%slides) then
            passage%number = 1
            passage%from(1) = from
            passage%to(1) = to
            passage%status(1) = gapbeam_no_equilibrium
            passage%reach(1) = 1
            passage%motion_of(1) = 0
            passage%closed(:, 1) = closed
            passage%at_zero(:, 1) = .false.
            return
        end if
        call new_workspace(track%beam, work)
        known = .false.
        changes = any(may_change(track%beam%supports))
        do r = 1, size(passage%reaches)
            if (known .and. .not. changes) then
                ! It holds everywhere, and need not be looked at
                reach = passage%reaches(r)
            else
                call enter_reach(track, train, passage%reaches(r), reach)
            end if
            call cross_reach(track, train, r, reach, closed, changes, known, margins, work, passage, error)
            if (allocated(error)) return
        end do
    end subroutine pass_train

    !> Move a train through a reach
    subroutine cross_reach(track, train, r, reach, closed, changes, known, margins, work, passage, error)
        type(track_type), intent(inout) :: track
        type(train_type), intent(in) :: train
        !> Number of the reach, and the reach by enter_reach, but where a scheme is known that holds everywhere
        integer, intent(in) :: r
        type(reach_type), intent(in) :: reach
        !> Scheme so far, whether supports can change, and whether it may be tried as it is
        logical, intent(inout) :: closed(:)
        logical, intent(in) :: changes
        logical, intent(inout) :: known
        type(margins_type), intent(inout) :: margins
        type(workspace_type), intent(inout) :: work
        type(passage_type), intent(inout) :: passage
        type(error_type), allocatable, intent(out) :: error
        logical, allocatable :: at_end(:)
        real(wp) :: now, begin, end, skipped
        logical :: solved
        integer :: changed, searches

        allocate (at_end(size(closed)))
        now = reach%from
        changed = 0
        searches = 0
        skipped = least_share
        do
            if (known .and. .not. changes) then
                call accept(gapbeam_solved, 1.0_wp)
                return
            else if (known) then
                call sample_margins(track, train, reach, now, closed, margins, work, solved)
                passage%solves = passage%solves + degree_of(train) + 1
                if (solved) call find_interval(margins, degree_of(train), resolution(), begin, end, at_end)
                if (solved .and. end > 2*resolution()) then
                    call accept(gapbeam_solved, end)
                    if (allocated(error) .or. now >= reach%to) return
                    closed(:) = closed .neqv. at_end
                    changed = changed + 1
                    if (changed <= most_changes + most_of_each*size(closed)) cycle
                    call too_near(now)
                    return
                end if
                ! What was tried is not right
                closed(:) = passage%closed(:, max(passage%number, 1))
            end if
            skipped = max(skipped, resolution())
            call look_further(skipped)
            if (allocated(error) .or. now >= reach%to) return
            searches = searches + 1
            if (searches > most_changes + most_of_each*size(closed)) call too_near(now)
            if (allocated(error)) return
        end do

    contains

        !> The share of the rest of the reach that cannot be told from here: events are known to the last digits of positions only
        pure function resolution() result(share)
            real(wp) :: share

            share = 0.0_wp
            if (reach%to > now) share = min(0.25_wp, max(least_share, least_distance(track, train)/(reach%to - now)))
        end function resolution

        !> Give up
        subroutine too_near(position)
            real(wp), intent(in) :: position

            call fatal_error(error, gapbeam_not_converged, "so many supports open and close so near to each other that "// &
                             "rounding decides, about position "//trim(shown(position))//": give the beam some weight, "// &
                             "or move a support")
        end subroutine too_near

        !> Take a stretch from here to a share of the rest
        subroutine accept(status, share)
            integer, intent(in) :: status
            real(wp), intent(in) :: share
            real(wp) :: to
            integer :: k, stat, node

            to = reach%to
            if (share < 1.0_wp) to = min(now + share*(reach%to - now), reach%to)
            if (reach%to - to <= least_distance(track, train)) to = reach%to
            stat = 0
            if (passage%number == size(passage%from)) call lengthen(passage, size(closed), 2*passage%number, stat)
            if (stat /= 0) then
                call no_memory(error)
                return
            end if
            passage%number = passage%number + 1
            k = passage%number
            passage%from(k) = now
            passage%to(k) = to
            passage%status(k) = status
            passage%reach(k) = r
            passage%closed(:, k) = closed
            ! All that is asked of supports that cannot change is zero
            passage%at_zero(:, k) = status == gapbeam_solved .and. .not. changes
            passage%motion_of(k) = 0
            if (status == gapbeam_solved .and. changes) then
                passage%at_zero(:, k) = are_zero(margins, degree_of(train), size(closed))
                call find_redundancy(track%beam, closed, passage%at_zero(:, k), node)
                if (node >= 0) passage%status(k) = gapbeam_indeterminate
            end if
            now = to
            known = status == gapbeam_solved
        end subroutine accept

        !> Is the rest of a reach but a sliver beside positions at which the beam can move freely: what is loaded by next to nothing
        !> there rounding alone tells
        function nearly_all_free() result(so)
            logical :: so

            so = passage%number > 0
            if (so) so = passage%status(max(passage%number, 1)) == not_unique
            so = so .and. now > reach%from .and. reach%to - now <= sliver*(reach%to - reach%from)
        end function nearly_all_free

        !> Find the scheme that acts from here on
        subroutine look_further(least)
            !> Shares that are left out; grows where nothing else leads on
            real(wp), intent(inout) :: least
            type(workspace_type) :: trial_work
            type(outcome_type) :: outcome
            type(detail_type) :: links_only
            logical, allocatable :: before(:)
            real(wp) :: share, place
            logical :: closely, right
            integer :: code

            allocate (before(size(closed)))
            before(:) = closed
            if (nearly_all_free()) then
                call accept(not_unique, 1.0_wp)
                return
            end if
            share = merge(first_share, 0.0_wp, reach%to > reach%from)
            closely = .false.
            do
                place = now + share*(reach%to - now)
                closed(:) = before
                call place_train(track, train, reach, place)
                if (closely) call new_workspace(track%beam, trial_work)
                if (.not. allocated(trial_work%nodes)) call new_workspace(track%beam, trial_work)
                call set_loads(track%beam, 1.0_wp, trial_work)
                if (closely) then
                    call decide_scheme(track%beam, links_only, 1.0_wp, rule_block, closed, trial_work, outcome, error)
                else
                    call find_scheme(track%beam, 1.0_wp, rule_block, closed, trial_work, outcome, error)
                end if
                passage%solves = passage%solves + trial_work%solves
                right = .not. allocated(error)
                if (right .and. .not. closely) right = .not. outcome%in_doubt
                if (right .and. outcome%status == gapbeam_solved .and. .not. outcome%indifferent) then
                    call sample_margins(track, train, reach, now, closed, margins, work, right)
                    passage%solves = passage%solves + degree_of(train) + 1
                    if (right) call find_interval(margins, degree_of(train), share, begin, end, at_end)
                else if (right .and. outcome%status == gapbeam_no_equilibrium) then
                    call sample_work(track, train, reach, now, outcome%motion, margins)
                    call find_interval(margins, degree_of(train), share, begin, end, at_end)
                else if (right) then
                    begin = 0.0_wp
                    end = so_until(track, train, reach, now, share, before, not_unique)
                end if
                if (right) right = end > 0.0_wp .or. .not. reach%to > reach%from
                if (.not. right .and. .not. closely) then
                    closely = .true.
                    if (allocated(error)) deallocate (error)
                    cycle
                end if
                if (allocated(error)) then
                    code = error%code
                    if (all(code /= [gapbeam_indeterminate, gapbeam_not_converged])) return
                    deallocate (error)
                    closed(:) = before
                    if (reach%to > reach%from) share = so_until(track, train, reach, now, share, before, code)
                    call accept(code, max(share, 2*resolution()))
                    return
                end if
                if (.not. reach%to > reach%from) exit
                if (right .and. begin <= least) exit
                if (share <= least) then
                    if (least > max(largest_share, 64*resolution())) then
                        call too_near(place)
                        return
                    end if
                    ! Rounding decides here: leave out what it hides
                    least = 4*least
                    end = max(end, 2*share)
                    exit
                end if
                share = max(min(share/2, begin/2), least)
            end do
            if (.not. reach%to > reach%from) end = 1.0_wp
            end = max(end, 2*resolution())
            if (outcome%status == gapbeam_no_equilibrium) then
                closed(:) = before
                call accept(gapbeam_no_equilibrium, end)
                if (.not. allocated(error)) call keep_motion(passage, outcome%motion, error)
            else if (outcome%indifferent) then
                closed(:) = before
                call accept(not_unique, end)
            else
                call accept(gapbeam_solved, end)
                if (now < reach%to) closed(:) = closed .neqv. at_end
            end if
        end subroutine look_further

    end subroutine cross_reach

    !> Reactions and openings of a scheme from here to the end of a reach
    subroutine sample_margins(track, train, reach, now, closed, margins, work, solved)
        type(track_type), intent(inout) :: track
        type(train_type), intent(in) :: train
        type(reach_type), intent(in) :: reach
        real(wp), intent(in) :: now
        logical, intent(in) :: closed(:)
        type(margins_type), intent(inout) :: margins
        type(workspace_type), intent(inout) :: work
        !> Has the scheme a solution
        logical, intent(out) :: solved
        real(wp) :: points(0:degree_of(train)), values(0:degree_of(train), size(closed)), rounding(size(closed))
        real(wp) :: matrix(0:degree_of(train), 0:degree_of(train))
        integer :: k, p, n, state, place

        n = degree_of(train)
        points(:) = sample_points(n)
        matrix(:, :) = to_coefficients(n)
        margins%count = size(closed)
        margins%slack(:) = 0.0_wp
        solved = .false.
        do p = 0, n
            call place_train(track, train, reach, now + points(p)*(reach%to - now))
            call set_loads(track%beam, 1.0_wp, work)
            call solve_and_refine(track%beam, closed, work, state, place)
            if (state /= band_ok) return
            if (.not. all(abs(work%answers%deflection) <= huge(1.0_wp))) return
            call find_margins(track%beam%supports, closed, work%answers, work%deflection_size, work%reaction, &
                              work%reaction_error, values(p, :), rounding)
            margins%slack(:size(closed)) = max(margins%slack(:size(closed)), first_width*rounding)
        end do
        do k = 1, size(closed)
            margins%b(0:n, k) = matmul(matrix, values(:, k))
        end do
        solved = .true.
    end subroutine sample_margins

    !> Work of the loads along a motion from here to the end of a reach
    subroutine sample_work(track, train, reach, now, motion, margins)
        type(track_type), intent(inout) :: track
        type(train_type), intent(in) :: train
        type(reach_type), intent(in) :: reach
        real(wp), intent(in) :: now
        real(wp), intent(in) :: motion(0:)
        type(margins_type), intent(inout) :: margins
        real(wp) :: points(0:degree_of(train)), values(0:degree_of(train)), parts
        integer :: p, n

        n = degree_of(train)
        points(:) = sample_points(n)
        margins%count = 1
        margins%slack(1) = 0.0_wp
        do p = 0, n
            call place_train(track, train, reach, now + points(p)*(reach%to - now))
            call work_of_loads(track%beam, 1.0_wp, motion, [0, ubound(motion, 1)], values(p), parts)
            margins%slack(1) = max(margins%slack(1), first_width*epsilon(1.0_wp)*parts)
        end do
        margins%b(0:n, 1) = matmul(to_coefficients(n), values)
    end subroutine sample_work

    !> The interval about a place on which nothing is below its rounding error
    subroutine find_interval(margins, n, u, begin, end, at_end)
        type(margins_type), intent(in) :: margins
        !> Degree, and the place, all as shares of what is left of the reach
        integer, intent(in) :: n
        real(wp), intent(in) :: u
        !> Ends of the interval; the second one 0 if there is none
        real(wp), intent(out) :: begin, end
        !> What comes to zero at its end
        logical, intent(inout) :: at_end(:)
        real(wp) :: left(0:highest_degree), right(0:highest_degree), lost, zero
        real(wp) :: zeros(margins%count)
        integer :: k

        begin = 0.0_wp
        end = 1.0_wp
        zeros(:) = 2.0_wp
        do k = 1, margins%count
            associate (b => margins%b(0:n, k), slack => margins%slack(k))
                if (all(b >= -slack)) cycle
                right(0:n) = b
                if (u > 0.0_wp) then
                    call halve(b, u, left(0:n), right(0:n))
                    if (right(0) < -slack) then
                        end = 0.0_wp
                        exit
                    end if
                    left(0:n) = left(n:0:-1)
                    lost = first_below(left(0:n), -slack)
                    if (lost <= 1.0_wp) begin = max(begin, u*(1 - lost))
                end if
                lost = first_below(right(0:n), -slack)
                if (lost > 1.0_wp) cycle
                zero = 0.0_wp
                if (right(0) > 0.0_wp) zero = crossing(right(0:n), min(first_below(right(0:n), 0.0_wp), lost), lost)
                zeros(k) = u + (1 - u)*zero
                end = min(end, zeros(k))
            end associate
        end do
        at_end(:) = .false.
        do k = 1, min(margins%count, size(at_end))
            at_end(k) = zeros(k) <= end + least_share .and. margins%count == size(at_end)
        end do
    end subroutine find_interval

    !> What is zero all the way
    pure function are_zero(margins, n, m) result(zero)
        type(margins_type), intent(in) :: margins
        integer, intent(in) :: n, m
        logical :: zero(m)
        integer :: k

        do k = 1, m
            zero(k) = all(abs(margins%b(0:n, k)) <= margins%slack(k))
        end do
    end function are_zero

    !> How far a beam that can move freely without work of the loads, or has no unique answer, stays so: tried at a few places up to
    !> the end of the reach, else half as far, and so on
    function so_until(track, train, reach, now, least, start, status) result(share)
        type(track_type), intent(inout) :: track
        type(train_type), intent(in) :: train
        type(reach_type), intent(in) :: reach
        real(wp), intent(in) :: now
        !> Known to be so up to this share of what is left
        real(wp), intent(in) :: least
        logical, intent(in) :: start(:)
        !> not_unique, or the code of the error
        integer, intent(in) :: status
        real(wp) :: share
        type(workspace_type) :: work
        type(detail_type) :: links_only
        type(outcome_type) :: outcome
        type(error_type), allocatable :: error
        logical :: closed(size(start)), stays
        integer :: k

        call new_workspace(track%beam, work)
        share = 1.0_wp
        do while (share > least)
            stays = .true.
            do k = 3, 1, -1
                closed(:) = start
                call place_train(track, train, reach, now + share*(k/3.0_wp - first_share)*(reach%to - now))
                call set_loads(track%beam, 1.0_wp, work)
                if (status == not_unique) then
                    call find_scheme(track%beam, 1.0_wp, rule_block, closed, work, outcome, error)
                    stays = .not. allocated(error) .and. outcome%indifferent
                else
                    call decide_scheme(track%beam, links_only, 1.0_wp, rule_block, closed, work, outcome, error)
                    stays = allocated(error)
                    if (stays) stays = error%code == status
                end if
                if (.not. stays) exit
            end do
            if (stays) return
            share = share/2
        end do
        share = least
    end function so_until

    !> Keep the motion of the last stretch, joined to that before where it is the same
    subroutine keep_motion(passage, motion, error)
        type(passage_type), intent(inout) :: passage
        real(wp), intent(in) :: motion(0:)
        type(error_type), allocatable, intent(out) :: error
        real(wp), allocatable :: longer(:, :)
        integer :: count, stat

        count = size(passage%motion, 2)
        if (count > 0) then
            if (maxval(abs(passage%motion(:, count) - motion)) <= 1e-9_wp) then
                passage%motion_of(passage%number) = count
                return
            end if
        end if
        allocate (longer(0:ubound(motion, 1), count + 1), stat=stat)
        if (stat /= 0) then
            call no_memory(error)
            return
        end if
        longer(:, :count) = passage%motion
        longer(:, count + 1) = motion
        call move_alloc(longer, passage%motion)
        passage%motion_of(passage%number) = count + 1
    end subroutine keep_motion

    !> Make room for more stretches
    subroutine lengthen(passage, m, count, stat)
        type(passage_type), intent(inout) :: passage
        !> Supports, and stretches
        integer, intent(in) :: m, count
        integer, intent(out) :: stat
        type(passage_type) :: longer
        integer :: n

        n = passage%number
        allocate (longer%from(count), longer%to(count), longer%status(count), longer%reach(count), longer%motion_of(count), &
                  longer%closed(m, count), longer%at_zero(m, count), stat=stat)
        if (stat /= 0) return
        if (n > 0) then
            longer%from(:n) = passage%from(:n)
            longer%to(:n) = passage%to(:n)
            longer%status(:n) = passage%status(:n)
            longer%reach(:n) = passage%reach(:n)
            longer%motion_of(:n) = passage%motion_of(:n)
            longer%closed(:, :n) = passage%closed(:, :n)
            longer%at_zero(:, :n) = passage%at_zero(:, :n)
        end if
        call move_alloc(longer%from, passage%from)
        call move_alloc(longer%to, passage%to)
        call move_alloc(longer%status, passage%status)
        call move_alloc(longer%reach, passage%reach)
        call move_alloc(longer%motion_of, passage%motion_of)
        call move_alloc(longer%closed, passage%closed)
        call move_alloc(longer%at_zero, passage%at_zero)
    end subroutine lengthen

end module gapbeam_train_path
