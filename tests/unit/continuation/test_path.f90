!> Paths over the load: turning through clearances, coincident events, where equilibrium ends, beams free to move
program test_path
    use testing, only: check, check_close, finish
    use beams, only: sample_type, make_beam, detail_of, infinite
    use gapbeam_kinds, only: wp
    use gapbeam_error, only: error_type, gapbeam_solved, gapbeam_no_equilibrium
    use gapbeam_model, only: node_support_type, below, above, both
    use gapbeam_workspace, only: workspace_type, new_workspace, set_loads
    use gapbeam_search, only: rule_block
    use gapbeam_contact_state, only: outcome_type
    use gapbeam_extended_precision, only: decide_scheme
    use gapbeam_path, only: follow_path, path_type
    use gapbeam_pieces, only: gapbeam_opens, gapbeam_closes, gapbeam_turns
    implicit none
    !> A path on its way
    type :: walk_type
        !> Events, and how it ended
        type(path_type) :: path
        type(outcome_type) :: outcome
        type(error_type), allocatable :: error
        !> Scheme and factor at the end
        logical, allocatable :: closed(:)
        real(wp) :: factor = 0.0_wp
    end type walk_type
    integer :: status

    call seesaw()
    call seesaw_without_weight()
    call shaft_with_clearance()
    call coincident_events()
    call one_by_one()
    call tipping()
    call free_to_move()
    call finish(status)
    if (status /= 0) stop 1, quiet=.true.

contains

    !> Follow a beam from factor 0 to 1
    subroutine follow(sample, walk)
        type(sample_type), intent(in), target :: sample
        type(walk_type), intent(out) :: walk
        type(workspace_type) :: work
        logical, allocatable :: marginal(:)

        allocate (walk%closed(size(sample%beam%supports)))
        walk%closed(:) = .true.
        call new_workspace(sample%beam, work)
        call set_loads(sample%beam, 0.0_wp, work)
        call decide_scheme(sample%beam, detail_of(sample), 0.0_wp, rule_block, walk%closed, work, walk%outcome, walk%error)
        marginal = walk%outcome%undecided
        call follow_path(sample%beam, detail_of(sample), 1.0_wp, 1000, walk%factor, walk%closed, marginal, walk%path, &
                         walk%outcome, walk%error)
    end subroutine follow

    !> Are these the events, at one factor
    subroutine check_events(walk, supports, events, factor, name)
        type(walk_type), intent(in) :: walk
        integer, intent(in) :: supports(:), events(:)
        real(wp), intent(in) :: factor
        character(len=*), intent(in) :: name

        associate (path => walk%path)
            call check(path%count == size(events), name//": how many")
            if (path%count /= size(events)) return
            call check(all(path%support(:path%count) == supports), name//": of which supports")
            call check(all(path%event(:path%count) == events), name//": what happens")
            call check_close(path%factor(:path%count), spread(factor, 1, size(events)), name//": where", 1e-15_wp)
        end associate
    end subroutine check_events

    !> A beam balanced on its middle with a weight at the left end turns at half of the load at the right end, to a support that
    !> it has not touched before
    subroutine seesaw()
        type(sample_type), target :: sample
        type(walk_type) :: walk

        call make_beam([4.0_wp, 4.0_wp], [1e4_wp, 1e4_wp], [0.0_wp, 0.0_wp], [0.0_wp, 0.0_wp], &
                       [node_support_type(1, both, infinite(), 0.0_wp), node_support_type(0, below, infinite(), 0.0_wp), &
                        node_support_type(2, below, infinite(), 0.1_wp)], sample)
        sample%beam%force(1, 0) = 10.0_wp
        sample%beam%force(2, 2) = 20.0_wp
        call follow(sample, walk)
        call check(.not. allocated(walk%error) .and. walk%outcome%status == gapbeam_solved, "the seesaw is followed")
        call check_events(walk, [2, 3, 3], [gapbeam_opens, gapbeam_turns, gapbeam_closes], 0.5_wp, "seesaw")
        call check(all(walk%closed .eqv. [.true., .false., .true.]), "it rests on the other side")
        call check_close(walk%factor, 1.0_wp, "to the end", 0.0_wp)
    end subroutine seesaw

    !> Without a weight it turns as soon as there is any load
    subroutine seesaw_without_weight()
        type(sample_type), target :: sample
        type(walk_type) :: walk

        call make_beam([4.0_wp, 4.0_wp], [1e4_wp, 1e4_wp], [0.0_wp, 0.0_wp], [0.0_wp, 0.0_wp], &
                       [node_support_type(1, both, infinite(), 0.0_wp), node_support_type(0, below, infinite(), 0.01_wp), &
                        node_support_type(2, below, infinite(), 0.01_wp)], sample)
        sample%beam%force(2, 2) = 20.0_wp
        call follow(sample, walk)
        call check(.not. allocated(walk%error) .and. walk%outcome%status == gapbeam_solved, "followed from no load on")
        call check(all(walk%closed .eqv. [.true., .false., .true.]), "it rests on the loaded side")
        call check(all(abs(walk%path%factor(:walk%path%count)) <= 0.0_wp), "and turns at factor 0")
    end subroutine seesaw_without_weight

    !> A shaft that is lifted off its bearings through their clearance, both ends at once
    subroutine shaft_with_clearance()
        type(sample_type), target :: sample
        type(walk_type) :: walk
        real(wp), parameter :: weight = 0.151_wp*800, lift = 3000.0_wp

        call make_beam([400.0_wp, 400.0_wp], spread(6.32e10_wp, 1, 2), spread(0.151_wp, 1, 2), [0.0_wp, 0.0_wp], &
                       [node_support_type(0, below, infinite(), 0.06_wp), node_support_type(0, above, infinite(), -0.06_wp), &
                        node_support_type(2, below, infinite(), 0.06_wp), node_support_type(2, above, infinite(), &
                                    -0.06_wp)], sample)
        sample%beam%force(2, 1) = -lift
        call follow(sample, walk)
        call check(.not. allocated(walk%error) .and. walk%outcome%status == gapbeam_solved, "the shaft is followed")
        call check_events(walk, [1, 3, 2, 2, 4], [gapbeam_opens, gapbeam_opens, gapbeam_turns, gapbeam_closes, gapbeam_closes], &
                          weight/lift, "shaft")
        call check(all(walk%closed .eqv. [.false., .true., .false., .true.]), "it is held from above")
    end subroutine shaft_with_clearance

    !> Two stops that are reached at once
    subroutine coincident_events()
        type(sample_type), target :: sample
        type(walk_type) :: walk
        real(wp), parameter :: l = 1.0_wp, ei = 100.0_wp, q = 40.0_wp
        real(wp) :: reach, x

        ! A simple beam of four spans; its deflection at the quarters is q x (L**3 - 2 L x**2 + x**3)/24 EI
        x = l
        reach = q*x*((4*l)**3 - 2*(4*l)*x**2 + x**3)/(24*ei)/2
        call make_beam(spread(l, 1, 4), spread(ei, 1, 4), spread(0.0_wp, 1, 4), spread(q, 1, 4), &
                       [node_support_type(0, both, infinite(), 0.0_wp), node_support_type(1, below, infinite(), reach), &
                        node_support_type(3, below, infinite(), reach), node_support_type(4, both, infinite(), 0.0_wp)], sample)
        call follow(sample, walk)
        call check_events(walk, [2, 3], [gapbeam_closes, gapbeam_closes], 0.5_wp, "two stops")
        call check(all(walk%closed), "all act in the end")
    end subroutine coincident_events

    !> Two stops of which the second is reached a little later: each has its own factor
    subroutine one_by_one()
        type(sample_type), target :: sample
        type(walk_type) :: walk
        real(wp), parameter :: l = 1.0_wp, ei = 100.0_wp, q = 40.0_wp, apart = 1e-9_wp
        real(wp) :: reach

        reach = q*l*((4*l)**3 - 2*(4*l)*l**2 + l**3)/(24*ei)/2
        call make_beam(spread(l, 1, 4), spread(ei, 1, 4), spread(0.0_wp, 1, 4), spread(q, 1, 4), &
                       [node_support_type(0, both, infinite(), 0.0_wp), node_support_type(1, below, infinite(), reach), &
                        node_support_type(3, below, infinite(), reach*(1 + apart)), node_support_type(4, both, &
                                    infinite(), 0.0_wp)], &
                       sample)
        call follow(sample, walk)
        call check(walk%path%count == 2, "two events")
        if (walk%path%count /= 2) return
        call check(all(walk%path%support(:2) == [2, 3]), "one stop after the other")
        call check_close(walk%path%factor(1), 0.5_wp, "the first where it is alone", 1e-15_wp)
        call check(walk%path%factor(2) > walk%path%factor(1), "the second later")
    end subroutine one_by_one

    !> A beam with an overhang that tips, from the factor on at which its far end carries nothing
    subroutine tipping()
        type(sample_type), target :: sample
        type(walk_type) :: walk

        call make_beam([4.0_wp, 2.0_wp], [1e4_wp, 1e4_wp], [1.0_wp, 1.0_wp], [0.0_wp, 0.0_wp], &
                       [node_support_type(0, below, infinite(), 0.0_wp), node_support_type(1, below, infinite(), 0.0_wp)], sample)
        sample%beam%force(2, 2) = 10.0_wp
        call follow(sample, walk)
        call check(.not. allocated(walk%error), "an answer")
        call check(walk%outcome%status == gapbeam_no_equilibrium, "no equilibrium further up")
        call check_close(walk%factor, 0.3_wp, "than 1.5/5", epsilon(1.0_wp))
        call check_close(walk%outcome%motion, [-1.0_wp, 0.0_wp, 0.5_wp], "it tips about the support beside the load")
    end subroutine tipping

    !> Loads that balance each other bend a beam on its ends until it touches a stop in the middle, and then push it up: it is free
    !> to move without work, and its position is not unique. As long as that makes no events without end it is followed
    subroutine free_to_move()
        type(sample_type), target :: sample
        type(walk_type) :: walk

        call make_beam([1.0_wp, 1.0_wp], [1.0_wp, 1.0_wp], [0.0_wp, 0.0_wp], [0.0_wp, 0.0_wp], &
                       [node_support_type(0, below, infinite(), 0.0_wp), node_support_type(1, below, infinite(), 0.1_wp), &
                        node_support_type(2, below, infinite(), 0.0_wp)], sample)
        sample%beam%force(2, :) = [-1.0_wp, 2.0_wp, -1.0_wp]
        call follow(sample, walk)
        call check(.not. allocated(walk%error) .and. walk%outcome%status == gapbeam_solved, "a beam free to move is followed")
        call check_close(walk%factor, 1.0_wp, "to the end", 0.0_wp)
        call check(walk%path%count >= 2, "over events")
        if (walk%path%count < 2) return
        call check(all(walk%path%support(:2) == [1, 3] .and. walk%path%event(:2) == gapbeam_opens), "its ends lift")
        call check_close(walk%path%factor(:2), [0.3_wp, 0.3_wp], "where the deflection F L**3/48 EI is the gap", 1e-14_wp)
    end subroutine free_to_move

end program test_path
