!> Solutions kept up to date while supports change, and the queue of events
program test_update
    use testing, only: check, check_close, finish
    use gapbeam_kinds, only: wp
    use gapbeam_band, only: band_ok, hinge
    use gapbeam_link, only: piece_type, piece_load_type, condense_link
    use gapbeam_model, only: beam_type, node_support_type, new_beam, both, below
    use gapbeam_workspace, only: workspace_type, new_workspace, set_loads
    use gapbeam_system, only: solve_and_refine
    use gapbeam_update, only: start_updates, update_scheme
    use gapbeam_queue, only: queue_type, new_queue, set_key, first_key, all_up_to
    implicit none
    integer :: status

    call changes_one_by_one(rigid=.true., hinges=.false.)
    call changes_one_by_one(rigid=.false., hinges=.false.)
    call changes_one_by_one(rigid=.true., hinges=.true.)
    call mechanism()
    call keys_in_order()
    call finish(status)
    if (status /= 0) stop 1, quiet=.true.

contains

    !> Spans of different lengths with a support at every node, held at both ends
    subroutine make(n, rigid, hinges, beam)
        use, intrinsic :: ieee_arithmetic, only: ieee_value, ieee_positive_inf
        integer, intent(in) :: n
        logical, intent(in) :: rigid, hinges
        type(beam_type), intent(out) :: beam
        type(piece_type) :: piece(1)
        type(piece_load_type) :: dead(1), live(1)
        type(node_support_type) :: supports(0:n)
        real(wp) :: work(1), none(2, 0:n)
        integer :: kind(0:n), i
        type(beam_type) :: spans

        allocate (spans%links(n))
        do i = 1, n
            piece = piece_type(1.0_wp + modulo(7*i, 5)/4.0_wp, 1e-3_wp*(1 + modulo(i, 3)), 0.0_wp)
            dead = piece_load_type(0, 0, 1.0_wp + modulo(3*i, 7), 0, 0)
            live = piece_load_type(0, 0, 0, 0, 0)
            call condense_link(piece, dead, live, work, spans%links(i))
        end do
        kind = 0
        ! Two supported spans follow every hinge, so single supports can open
        if (hinges) kind(5:n - 5:4) = hinge
        none = 0.0_wp
        do i = 0, n
            supports(i) = node_support_type(i, below, merge(ieee_value(1.0_wp, ieee_positive_inf), 1e3_wp, rigid), &
                                            1e-3_wp*modulo(5*i, 3))
        end do
        supports([0, n])%side = both
        call new_beam(spans%links, kind, [(0.0_wp, i=0, n)], none, none, supports, beam)
    end subroutine make

    !> Every other support opens, one after the other from the middle outward, and closes again
    subroutine changes_one_by_one(rigid, hinges)
        logical, intent(in) :: rigid, hinges
        integer, parameter :: n = 600
        type(beam_type) :: beam
        type(workspace_type) :: kept, anew
        logical :: acting(n + 1), solved, follows
        integer :: k, round, window(2), state, place, most

        call make(n, rigid, hinges, beam)
        acting = .true.
        call new_workspace(beam, kept)
        call set_loads(beam, 1.0_wp, kept)
        call start_updates(beam, acting, kept, solved, follows)
        call check(solved .and. follows, "solved as a whole")
        most = 0
        do round = 1, 2
            do k = 3, n - 2, 4
                acting(k) = .not. acting(k)
                call update_scheme(beam, acting, [k - 1, k - 1], .true., kept, window, state)
                call check(state == band_ok, "up to date")
                most = max(most, window(2) - window(1) + 1)
            end do
            call new_workspace(beam, anew)
            call set_loads(beam, 1.0_wp, anew)
            call solve_and_refine(beam, acting, anew, state, place)
            call check_close(kept%answers%deflection, anew%answers%deflection, "deflections", 1e-15_wp)
            call check_close(kept%answers%moment_left, anew%answers%moment_left, "moments", 1e-15_wp)
            call check_close(kept%reaction, anew%reaction, "reactions", 1e-15_wp)
            call check_close(kept%deflection_size, anew%deflection_size, "sizes", 1e-13_wp)
        end do
        call check(most < n/3, "a change stays near its support")
    end subroutine changes_one_by_one

    !> A scheme that is a mechanism is reported, not answered
    subroutine mechanism()
        integer, parameter :: n = 12
        type(beam_type) :: beam
        type(workspace_type) :: work
        logical :: acting(n + 1), solved, follows
        integer :: window(2), state

        call make(n, .true., .true., beam)
        acting = .true.
        call new_workspace(beam, work)
        call set_loads(beam, 1.0_wp, work)
        call start_updates(beam, acting, work, solved, follows)
        acting(2:n + 1) = .false.
        call update_scheme(beam, acting, [1, n], .true., work, window, state)
        call check(state /= band_ok, "mechanism")
    end subroutine mechanism

    !> The queue against a plain search
    subroutine keys_in_order()
        integer, parameter :: n = 37
        type(queue_type) :: queue
        real(wp) :: keys(n)
        integer :: i, k
        logical :: right

        call new_queue(n, queue)
        keys = huge(1.0_wp)
        right = size(all_up_to(queue, 1.0_wp)) == 0
        do i = 1, 500
            k = 1 + modulo(i*i, n)
            keys(k) = real(modulo(7919*i, 101), wp)
            call set_key(queue, k, keys(k))
            right = right .and. abs(first_key(queue) - minval(keys)) <= 0.0_wp
            associate (found => all_up_to(queue, 50.0_wp))
                right = right .and. size(found) == count(keys <= 50.0_wp)
                right = right .and. all(keys(found) <= 50.0_wp)
            end associate
        end do
        call check(right, "queue")
    end subroutine keys_in_order

end program test_update
