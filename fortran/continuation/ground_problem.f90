!> Load path of a beam on the ground: its states (gapbeam_ground_states), and where they end.
!>
!> The last factor below which there is equilibrium is where loads begin to do work along the motion that begins there; where laws
!> are curves, limit analysis knows it.
module gapbeam_ground_problem
    use gapbeam_kinds, only: wp
    use gapbeam_path_tolerances, only: missing_of_limit
    use gapbeam_error, only: error_type, gapbeam_buckles, gapbeam_no_equilibrium
    use gapbeam_kinematics, only: work_of_loads
    use gapbeam_piece, only: is_compressed
    use gapbeam_laws, only: law_bound
    use gapbeam_layers, only: has_limit, has_curves
    use gapbeam_ground, only: ground_type
    use gapbeam_moved_ground, only: move_ground
    use gapbeam_filled_ground, only: any_falls
    use gapbeam_refined_ground, only: refine_ground, refine_links
    use gapbeam_ground_limit, only: find_limit
    use gapbeam_ground_quad, only: fine_ground_type => ground_type
    use gapbeam_assembled_model, only: assembled_type
    use gapbeam_smooth_laws, only: smooth_supports
    use gapbeam_solution, only: state_type
    use gapbeam_loaded_ground, only: ground_of
    use gapbeam_state, only: detail_of
    use gapbeam_ground_states, only: ground_states_type
    use gapbeam_path_problem, only: point_type
    use gapbeam_ground_events, only: held_type
    implicit none
    private
    public :: ground_problem_type, new_ground_problem

    !> Next to the limit of laws that are curves states take long: there parameters as near as this are neighbours
    real(wp), parameter :: near_on_curves = 2.0_wp**(-20)
    !> So near to the factor at which the loads begin to do work there is equilibrium, and none; at least so near to it that a path
    !> ends; that many times farther; and how often that factor is computed
    real(wp), parameter :: next_to_limit = 2.0_wp**(-50), near_limit = 2.0_wp**(-44), wider = 64.0_wp
    integer, parameter :: most_guesses = 8
    !> So far below that factor a beam may stand on an edge, which nothing settles
    real(wp), parameter :: edge_share = 2.0_wp**(-20)
    !> How far below the end of a path a state is looked for to which axial forces lead that are put on last, and how often what is
    !> between is halved then
    real(wp), parameter :: farthest_back = 2.0_wp**(-2)
    integer, parameter :: most_halvings_back = 20
    !> Powers of 2, as shares of the factor at which falling ground gives way, by which states are looked for beside it
    integer, parameter :: next_to_fall = -44, far_from_fall = -24

    !> With what it takes to end it
    type, extends(ground_states_type) :: ground_problem_type
        !> Does some ground, or a curve of a support, carry no more than so much, and does it come to that on a curve
        logical :: yields = .false., levels_off = .false.
        !> The greatest load factor at which the loads begin to do work along a motion that was found
        real(wp) :: by_work = 0.0_wp
    contains
        procedure :: approach_end
        procedure :: take_end
    end type ground_problem_type

contains

    !> Make ready
    subroutine new_ground_problem(assembled, last, rule, state, problem)
        type(assembled_type), intent(in), target :: assembled
        !> The last factor, and the rule
        real(wp), intent(in) :: last
        integer, intent(in) :: rule
        !> With the scheme that every search starts from
        type(state_type), intent(in) :: state
        type(ground_problem_type), intent(out) :: problem
        integer, allocatable :: curves(:)
        integer :: k

        problem%assembled => assembled
        problem%ground = ground_of(assembled, last)
        call move_ground(problem%ground, 0.0_wp)
        call refine_ground(problem%ground, problem%fine)
        problem%rule = rule
        problem%parameter = "load factor"
        problem%last = last
        problem%state = state
        curves = smooth_supports(assembled)
        problem%on_curves = size(curves) > 0
        allocate (problem%start, source=state%closed)
        do k = 1, size(assembled%layers)
            associate (layer => assembled%layers(k))
                if (.not. has_limit(layer, assembled%law_pieces)) cycle
                problem%yields = .true.
                problem%levels_off = problem%levels_off .or. has_curves(layer)
            end associate
        end do
        do k = 1, size(curves)
            associate (support => assembled%model%supports(curves(k)))
                problem%levels_off = problem%levels_off .or. law_bound(support%law, support%parameter) <= huge(last)
            end associate
        end do
        problem%yields = problem%yields .or. problem%levels_off
        problem%falls = any_falls(problem%ground)
        problem%yields = problem%yields .or. problem%falls
        problem%levels_off = problem%levels_off .and. .not. problem%falls
        if (problem%levels_off) problem%neighbours_at_end = near_on_curves
        allocate (problem%path%events(8), problem%path%segment(8))
        problem%path%beyond = last
    end subroutine new_ground_problem

    !> Nearer to the factor above which there is no equilibrium: by limit analysis where laws are curves, else by work of the loads
    subroutine approach_end(problem, below, above, ended, error)
        class(ground_problem_type), intent(inout) :: problem
        class(point_type), allocatable, intent(inout) :: below, above
        logical, intent(out) :: ended
        type(error_type), allocatable, intent(out) :: error

        ended = .false.
        if (problem%falls) call go_to_fall(problem, below, above, ended, error)
        if (problem%levels_off) call go_to_limit(problem, below, above, ended, error)
        if (allocated(error) .or. ended .or. problem%falls) return
        if (.not. above%stands) call approach_by_work(problem, below, above, ended, error)
    end subroutine approach_end

    !> Where laws are curves limit analysis knows the limit load: end the path there, or look next to it for what changes before
    subroutine go_to_limit(problem, below, above, ended, error)
        !> As for approach_end
        class(ground_problem_type), intent(inout) :: problem
        class(point_type), allocatable, intent(in) :: below
        class(point_type), allocatable, intent(inout) :: above
        logical, intent(inout) :: ended
        type(error_type), allocatable, intent(out) :: error
        class(point_type), allocatable :: point
        type(fine_ground_type) :: fine
        real(wp) :: bears, beyond
        logical :: found
        integer :: k

        bears = below%at
        beyond = above%at
        call refine_ground(problem%ground, fine)
        call refine_links(detail_of(problem%assembled), fine)
        call find_limit(fine, bears, beyond, found)
        if (.not. found) return
        do k = 1, size(missing_of_limit)
            associate (last => bears*(1 - missing_of_limit(k)))
                if (last <= below%at) return
                call problem%find(last, point, error, below)
            end associate
            if (allocated(error)) return
            if (point%stands) exit
        end do
        if (.not. point%stands) return
        if (.not. problem%alike(below, point)) then
            call move_alloc(point, above)
            return
        end if
        problem%path%last = point%at
        problem%path%at_limit = .true.
        ended = .true.
        problem%path%beyond = beyond
        call problem%find(beyond, point, error)
        if (allocated(error)) return
        if (allocated(point%trouble)) call go_beyond(problem, beyond, point%trouble, error)
    end subroutine go_to_limit

    !> Where the force of ground falls the search for a state says how far there is one: end the path there, or look next to it for
    !> what changes before
    subroutine go_to_fall(problem, below, above, ended, error)
        !> As for approach_end
        class(ground_problem_type), intent(inout) :: problem
        class(point_type), allocatable, intent(inout) :: below, above
        logical, intent(inout) :: ended
        type(error_type), allocatable, intent(out) :: error
        class(point_type), allocatable :: point
        real(wp) :: reached
        integer :: power

        if (allocated(above%trouble)) return
        reached = above%at
        select type (above)
        type is (held_type)
            reached = above%reached
        end select
        ! Next to the end states have fewer digits
        do power = next_to_fall, far_from_fall, 4
            if (.not. reached*(1 - 2.0_wp**power) > below%at) exit
            call problem%find(reached*(1 - 2.0_wp**power), point, error, below)
            if (allocated(error)) return
            if (.not. point%stands) cycle
            if (.not. problem%alike(below, point)) then
                call move_alloc(point, above)
                return
            end if
            call move_alloc(point, below)
            exit
        end do
        if (.not. below%at >= reached*(1 - 2.0_wp**far_from_fall)) return
        problem%path%last = below%at
        problem%path%at_limit = problem%path%last > 0.0_wp
        ended = .true.
        do power = next_to_fall, far_from_fall, 4
            problem%path%beyond = min(above%at, reached*(1 + 2.0_wp**power))
            call problem%find(problem%path%beyond, point, error, below)
            if (allocated(error)) return
            if (.not. point%stands .and. .not. allocated(point%trouble)) return
        end do
        problem%path%beyond = above%at
        call problem%find(above%at, point, error, below)
        if (.not. allocated(error) .and. allocated(point%trouble)) error = point%trouble
    end subroutine go_to_fall

    !> Find a factor just above one at which there is no equilibrium for sure, and how the beam moves there
    subroutine go_beyond(problem, from, trouble, error)
        class(ground_problem_type), intent(inout) :: problem
        real(wp), intent(in) :: from
        !> What keeps a state there from being found
        type(error_type), intent(in) :: trouble
        !> As for find, or that
        type(error_type), allocatable, intent(out) :: error
        class(point_type), allocatable :: point
        real(wp), allocatable :: factors(:)
        integer :: k

        allocate (factors, source=[limit_by_work(problem, from), from*(1 + [(2.0_wp**k, k=-50, -9, 4)])])
        do k = 1, size(factors)
            if (.not. factors(k) > from) cycle
            problem%path%beyond = factors(k)
            call problem%find(problem%path%beyond, point, error)
            if (allocated(error)) return
            if (.not. point%stands .and. .not. allocated(point%trouble)) return
        end do
        allocate (error, source=trouble)
    end subroutine go_beyond

    !> Nearer to where the loads begin to do work along the motion at the upper of two factors; so near to it that the path ends
    subroutine approach_by_work(problem, below, above, ended, error)
        !> As for approach_end
        class(ground_problem_type), intent(inout) :: problem
        class(point_type), allocatable, intent(inout) :: below, above
        logical, intent(inout) :: ended
        type(error_type), allocatable, intent(out) :: error
        class(point_type), allocatable :: between, unsettled
        real(wp) :: guess, reach
        integer :: guesses
        logical :: goes_on

        reach = next_to_limit
        do guesses = 1, most_guesses
            if (above%stands) return
            guess = factor_without_work(problem, above)
            problem%by_work = max(problem%by_work, guess)
            ! States may end before, where they are told from others
            if (guess*(1 - reach) >= above%at .and. guess*(1 - wider*reach) < above%at) reach = wider*reach
            if (.not. (guess*(1 - reach) > below%at .and. guess*(1 - reach) < above%at)) return
            call problem%find(guess*(1 - reach), between, error, below)
            if (allocated(error)) return
            if (problem%alike(below, between)) exit
            if (allocated(between%trouble) .or. (between%stands .and. reach < near_limit)) then
                ! Next to the end next to nothing may hold the beam, and rounding tells what: farther away it is settled
                call move_alloc(between, unsettled)
                reach = wider*reach
                cycle
            end if
            call move_alloc(between, above)
        end do
        if (.not. allocated(between)) return
        call move_alloc(between, below)
        if (allocated(unsettled) .and. reach > near_limit) then
            call move_alloc(unsettled, above)
            return
        end if
        if (guess*(1 + reach) >= above%at) return
        call problem%find(guess*(1 + reach), between, error)
        if (allocated(error) .or. between%stands) return
        call move_alloc(between, above)
        if (allocated(above%trouble) .or. problem%state%status /= gapbeam_no_equilibrium) return
        if (.not. allocated(unsettled) .or. reach > near_limit) return
        call problem%take_end(below, above, goes_on, error)
        ended = .true.
    end subroutine approach_by_work

    !> The load factor at which the loads do no work along the motion at a factor at which they do; below zero if there is none
    pure function factor_without_work(problem, above) result(guess)
        type(ground_problem_type), intent(in) :: problem
        class(point_type), intent(in) :: above
        real(wp) :: guess, of_dead, of_all, size_of_parts

        guess = -1.0_wp
        select type (above)
        type is (held_type)
            if (.not. allocated(above%motion)) return
            associate (all_nodes => [0, ubound(above%motion, 1)], beam => problem%ground%beam)
                call work_of_loads(beam, 0.0_wp, above%motion, all_nodes, of_dead, size_of_parts)
                call work_of_loads(beam, above%at, above%motion, all_nodes, of_all, size_of_parts)
            end associate
            if (abs(of_dead - of_all) > 0.0_wp) guess = above%at*(of_dead/(of_dead - of_all))
        end select
    end function factor_without_work

    !> A load factor just above that at which loads begin to do work, if it is just above one that stands, or below zero
    pure function limit_by_work(problem, last) result(limit)
        type(ground_problem_type), intent(in) :: problem
        real(wp), intent(in) :: last
        real(wp) :: limit

        limit = problem%by_work*(1 + next_to_limit)
        if (limit > last*(1 + edge_share)) limit = -1.0_wp
    end function limit_by_work

    !> End the path, and find how the beam moves just above
    subroutine take_end(problem, below, above, goes_on, error)
        class(ground_problem_type), intent(inout) :: problem
        class(point_type), intent(in) :: below, above
        logical, intent(out) :: goes_on
        type(error_type), allocatable, intent(out) :: error
        class(point_type), allocatable :: point

        goes_on = .false.
        associate (path => problem%path)
            path%last = below%at
            path%beyond = below%at
            if (feels_axial_force(problem%ground)) call step_back(problem, path%last, error)
            if (allocated(error)) return
            path%at_limit = problem%yields .and. path%last > 0.0_wp
            if (.not. allocated(above%trouble)) then
                if (abs(problem%state%factor - above%at) > 0.0_wp) call problem%find(above%at, point, error)
                if (allocated(point)) then
                    if (allocated(point%trouble)) error = point%trouble
                end if
                ! A beam that stands on an edge is told to tip before the loads do any work
                path%beyond = max(path%beyond, limit_by_work(problem, path%last))
                ! Where it buckles there may be a state at the factor below
                if (problem%levels_off .or. problem%state%status == gapbeam_buckles) path%beyond = above%at
                return
            end if
        end associate
        call go_beyond(problem, below%at, above%trouble, error)
    end subroutine take_end

    !> Are there states to which axial forces lead that are put on last: those of a compressed beam, or of one whose forces grow
    pure function feels_axial_force(ground) result(it_does)
        type(ground_type), intent(in) :: ground
        logical :: it_does

        it_does = any(is_compressed(ground%pieces))
        if (.not. it_does .and. allocated(ground%moving)) it_does = allocated(ground%moving%tension)
    end function feels_axial_force

    !> Where axial forces are put on last, under all other loads, there may be no way to a state to which they grow with these: the
    !> path ends where there is
    subroutine step_back(problem, last, error)
        class(ground_problem_type), intent(inout) :: problem
        real(wp), intent(inout) :: last
        type(error_type), allocatable, intent(out) :: error
        class(point_type), allocatable :: point
        real(wp) :: share, lost
        integer :: halving

        share = 0.0_wp
        lost = 0.0_wp
        do
            call problem%find(last*(1 - share), point, error)
            if (allocated(error)) return
            if (point%stands) exit
            lost = share
            share = max(near_limit, 8*share)
            if (share > farthest_back) return
        end do
        do halving = 1, merge(most_halvings_back, 0, share > near_limit)
            call problem%find(last*(1 - (lost + share)/2), point, error)
            if (allocated(error)) return
            if (point%stands) share = (lost + share)/2
            if (.not. point%stands) lost = (lost + share)/2
        end do
        last = last*(1 - share)
    end subroutine step_back

end module gapbeam_ground_problem
